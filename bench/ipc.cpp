// SPDX-License-Identifier: GPL-3.0-or-later
// The detector over 4088^2 pixels. IPC against a plain copy, a naive loop and a convolution by FFT;
// its corrections; noise against its closed form; a whole chain. Errors are in units of the largest
// pixel unless they say otherwise; those of IPC are against a long double sum over a sample.
#include "detector/default_chain.hpp"
#include "detector/ipc_covariance.hpp"
#include "detector/ipc_solve.hpp"
#include "detector/noise.hpp"
#include "detector/varying_ipc.hpp"
#include "harness.hpp"
#include "numerics/plane_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <random>

namespace wfpsf::bench {

namespace {

constexpr int64_t n = 4088;
constexpr double full = 1e5;

template <class T> Plane<T> charges() {
    Plane<T> in(n, n);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> charge(0, full);
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            in(x, y) = static_cast<T>(charge(random));
    return in;
}

template <class T> void copy(const Plane<T> &from, Plane<T> &to) {
    std::memcpy(to.view().data, from.view().data, sizeof(T) * static_cast<size_t>(n * n));
}

// As it is written down, border left out.
template <class T> void naive(const IpcKernel &kernel, const Plane<T> &in, Plane<T> &out) {
    for (int64_t y = 1; y < n - 1; ++y)
        for (int64_t x = 1; x < n - 1; ++x) {
            double sum = 0;
            for (int64_t dy = -1; dy <= 1; ++dy)
                for (int64_t dx = -1; dx <= 1; ++dx)
                    sum += kernel(dx, dy) * static_cast<double>(in(x - dx, y - dy));
            out(x, y) = static_cast<T>(sum);
        }
}

// A kernel that is symmetric left-right and up-down.
void by_fft(const IpcKernel &kernel, Plane<double> &image) {
    const auto cosines = [](bool first_axis) {
        std::vector<double> values = filter_frequencies(Continuation::periodic, n, first_axis);
        for (double &value : values)
            value = 2 * std::cos(2 * std::numbers::pi * value);
        return values;
    };
    const std::vector<double> cx = cosines(true), cy = cosines(false);
    filter_plane(image.view(), Continuation::periodic, [&](int64_t k, std::complex<double> *row) {
        const double c = cy[static_cast<size_t>(k)];
        for (size_t j = 0; j < cx.size(); ++j)
            row[j] =
                kernel(0, 0) + kernel(1, 0) * cx[j] + (kernel(0, 1) + kernel(1, 1) * cx[j]) * c;
    });
}

template <class T>
double sampled_error(const IpcKernel &kernel, int64_t tap_step, const Plane<T> &in,
                     const Plane<T> &out) {
    double largest = 0;
    for (int64_t y = 0; y < n; y += 97)
        for (int64_t x = 0; x < n; x += 89) {
            long double sum = 0;
            for (int64_t dy = -1; dy <= 1; ++dy)
                for (int64_t dx = -1; dx <= 1; ++dx) {
                    const int64_t i = x - tap_step * dx, j = y - tap_step * dy;
                    if (i >= 0 && i < n && j >= 0 && j < n)
                        sum += static_cast<long double>(kernel(dx, dy)) * in(i, j);
                }
            largest = std::max(largest, static_cast<double>(std::abs(sum - out(x, y))) / full);
        }
    return largest;
}

enum class Peer { copy, naive, fft };

template <class T>
Case ipc_case(const char *name, double target_time, const IpcKernel &kernel, Convolution how,
              Peer peer = Peer::copy, bool in_place = false) {
    return {name, "largest pixel error / largest pixel", target_time, sizeof(T) == 4 ? 1e-7 : 1e-15,
            [=] {
                const Plane<T> in = charges<T>();
                Plane<T> out = in;
                Measured m;
                if (peer == Peer::copy) {
                    m.baseline = "a plain copy";
                    m.baseline_s = time([&] { copy(in, out); }).median_s;
                } else if (peer == Peer::naive) {
                    m.baseline = "a naive loop";
                    m.baseline_s = time([&] { naive(kernel, in, out); }).median_s;
                } else if constexpr (sizeof(T) == sizeof(double)) {
                    m.baseline = "an FFT convolution";
                    m.baseline_s = time([&] { by_fft(kernel, out); }).median_s;
                }
                m.timing = time([&] {
                    convolve(kernel, in_place ? std::as_const(out).view() : in.view(), how,
                             out.view());
                });
                copy(in, out);
                convolve(kernel, in_place ? std::as_const(out).view() : in.view(), how, out.view());
                m.error = sampled_error(kernel, how.tap_step, in, out);
                return m;
            }};
}

Case inverse_case(const char *name, double alpha, Edge edge) {
    return {name, "largest pixel error / largest pixel", 1, 1e-12, [=] {
                const IpcKernel kernel = IpcKernel::parametric(alpha, alpha / 10);
                const Plane<double> in = charges<double>();
                Plane<double> seen(n, n), found(n, n);
                convolve(kernel, in.view(), {edge}, seen.view());
                Measured m;
                m.timing = time([&] {
                    solve_ipc(kernel, std::as_const(seen).view(), {edge}, {}, found.view());
                });
                for (int64_t y = 0; y < n; ++y)
                    for (int64_t x = 0; x < n; ++x)
                        m.error = std::max(m.error, std::abs(found(x, y) - in(x, y)) / full);
                return m;
            }};
}

// alpha rises over the detector, the rest is constant.
VaryingIpc varying() {
    return VaryingIpc::parametric(n, n,
                                  {SurfacePolynomial(1, std::array{0.02, 0.002, 0.001}),
                                   SurfacePolynomial(0, std::array{0.002}),
                                   {}});
}

// Against the definition, one pixel's kernel at a time.
Case varying_case(const char *name, IpcForm form) {
    return {name, "largest pixel error / largest pixel", 0, 1e-15, [=] {
                const VaryingIpc ipc = varying();
                const Plane<double> in = charges<double>();
                Plane<double> out = in;
                Measured m;
                m.baseline = "a plain copy";
                m.baseline_s = time([&] { copy(in, out); }).median_s;
                m.timing = time([&] { convolve(ipc, in.view(), {.form = form}, out.view()); });
                for (int64_t y = 1; y < n - 1; y += 97)
                    for (int64_t x = 1; x < n - 1; x += 389) {
                        const int sign = form == IpcForm::scatter ? -1 : 1;
                        long double sum = 0;
                        for (int64_t dy = -1; dy <= 1; ++dy)
                            for (int64_t dx = -1; dx <= 1; ++dx) {
                                const int64_t i = x + sign * dx, j = y + sign * dy;
                                const IpcKernel own =
                                    form == IpcForm::scatter ? ipc.kernel(i, j) : ipc.kernel(x, y);
                                sum += static_cast<long double>(own(dx, dy)) * in(i, j);
                            }
                        m.error = std::max(m.error,
                                           static_cast<double>(std::abs(sum - out(x, y))) / full);
                    }
                return m;
            }};
}

Case varying_inverse_case() {
    return {"inverse of varying IPC on 4088^2, alpha = 0.017..0.023",
            "largest pixel error / largest pixel", 0, 1e-12, [] {
                const VaryingIpc ipc = varying();
                const Plane<double> in = charges<double>();
                Plane<double> seen(n, n), found(n, n);
                convolve(ipc, in.view(), {}, seen.view());
                Measured m;
                m.timing = time([&] {
                    solve_ipc(ipc, std::as_const(seen).view(), {}, {}, false, found.view());
                });
                for (int64_t y = 0; y < n; ++y)
                    for (int64_t x = 0; x < n; ++x)
                        m.error = std::max(m.error, std::abs(found(x, y) - in(x, y)) / full);
                return m;
            }};
}

Case neumann_case(double alpha, int64_t order) {
    char name[80];
    std::snprintf(name, sizeof name, "IPC correction of order %d, alpha = %.2f, 512^2",
                  static_cast<int>(order), alpha);
    return {name, "largest pixel error / largest pixel", 0, 0, [=] {
                const IpcKernel kernel = IpcKernel::parametric(alpha, alpha / 10);
                const IpcKernel correction = kernel.neumann_correction(order);
                Plane<double> in(512, 512), seen(512, 512), found(512, 512);
                in(200, 300) = 1; // a point has every frequency
                convolve(kernel, std::as_const(in).view(), {Edge::wrap}, seen.view());
                Measured m;
                m.timing = time([&] {
                    convolve(correction, std::as_const(seen).view(), {Edge::wrap}, found.view());
                });
                for (int64_t y = 0; y < 512; ++y)
                    for (int64_t x = 0; x < 512; ++x)
                        m.error = std::max(m.error, std::abs(found(x, y) - in(x, y)));
                return m;
            }};
}

// The sample covariance at the lags 0 and 1, in units of its own standard error.
Case noise_case() {
    return {"correlated noise, 2048^2", "covariance, in its standard errors", 0, 5, [] {
                constexpr int64_t size = 2048;
                const IpcKernel kernel = IpcKernel::parametric(0.02, 0.002);
                const IpcKernel wanted = kernel.autocorrelation();
                Plane<double> image(size, size);
                Measured m;
                m.timing = time([&] { add_noise(1, &kernel, {.seed = 1}, 1, image.view()); });
                image = Plane<double>(size, size);
                add_noise(1, &kernel, {.seed = 2}, 1, image.view());
                for (const int64_t lag : {0, 1}) {
                    double sum = 0;
                    for (int64_t y = 0; y < size; ++y)
                        for (int64_t x = 0; x + lag < size; ++x)
                            sum += image(x, y) * image(x + lag, y);
                    const auto count = static_cast<double>(size * (size - lag));
                    const double error = std::sqrt(2 * wanted.sum_of_squares() / count);
                    m.error = std::max(m.error, std::abs(sum / count - wanted(lag, 0)) / error);
                }
                return m;
            }};
}

// The map of the variance, scattered, against realisations: the sum over pixels of squares, in its
// own standard error. 1 in 16 of a detector's pixels, so that the draws do not take all the time.
Case varying_noise_case() {
    return {"variance through varying IPC, 1022^2", "mean variance, in its standard errors", 0, 5,
            [] {
                constexpr int64_t size = n / 4;
                const VaryingIpc ipc = VaryingIpc::parametric(
                    size, size, {SurfacePolynomial(1, std::array{0.02, 0.005, 0.01}), {}, {}});
                Plane<double> variance(size, size), map(size, size), noise(size, size);
                for (int64_t y = 0; y < size; ++y) {
                    fill_normal({.seed = 3}, 0, y, size, noise.view().row(y));
                    for (int64_t x = 0; x < size; ++x) {
                        variance(x, y) = 100 + static_cast<double>(x + 2 * y);
                        noise(x, y) *= std::sqrt(variance(x, y));
                    }
                }
                Measured m;
                m.timing = time([&] {
                    covariance(ipc, std::as_const(variance).view(), {0, 0}, {}, map.view());
                });
                m.baseline = "varying IPC itself";
                m.baseline_s = time([&] {
                                   convolve(ipc, std::as_const(variance).view(), {}, map.view());
                               }).median_s;
                covariance(ipc, std::as_const(variance).view(), {0, 0}, {}, map.view());
                convolve(ipc, std::as_const(noise).view(), {}, noise.view());
                double off = 0, squares = 0;
                for (int64_t y = 0; y < size; ++y)
                    for (int64_t x = 0; x < size; ++x) {
                        off += noise(x, y) * noise(x, y) - map(x, y);
                        squares += map(x, y) * map(x, y);
                    }
                // Pixels are correlated: their squares vary together by the correlations' squares.
                const IpcKernel middle = IpcKernel::parametric(0.02).autocorrelation();
                const double share = middle.sum_of_squares() / std::pow(middle(0, 0), 2);
                m.error = std::abs(off) / std::sqrt(2 * squares * share);
                return m;
            }};
}

Case chain_case(const char *name, const char *instrument, bool with_noise, int threads = 1) {
    return {name, "none", 0, 0, [=] {
                Image image(PixelType::float32, n, n);
                const Plane<float> in = charges<float>();
                const View<float> pixels = std::get<View<float>>(image.pixels());
                const Chain chain = default_chain(Instrument::get(instrument), 139.8);
                Measured m;
                m.error = NAN;
                m.baseline = "a plain copy";
                const size_t bytes = sizeof(float) * static_cast<size_t>(n * n);
                m.baseline_s =
                    time([&] { std::memcpy(pixels.data, in.view().data, bytes); }).median_s;
                m.timing = time([&] {
                    chain.run({.with_noise = with_noise, .force = true, .threads = threads}, image);
                });
                return m;
            }};
}

} // namespace

std::vector<Case> ipc_cases() {
    const IpcKernel kernel = IpcKernel::parametric(0.02, 0.002, 0);
    std::vector<Case> cases{
        ipc_case<float>("IPC 3x3 on 4088^2, float32", 0, kernel, {}),
        ipc_case<float>("IPC 3x3 on 4088^2, float32, in place", 0, kernel, {}, Peer::copy, true),
        ipc_case<double>("IPC 3x3 on 4088^2, float64", 0, kernel, {}),
        ipc_case<double>("IPC 3x3 on 4088^2, float64, in place", 0, kernel, {}, Peer::copy, true),
        ipc_case<float>("IPC 3x3 on 4088^2, float32, two threads", 0, kernel, {.threads = 2}),
        ipc_case<double>("IPC 3x3 on 4088^2, float64, two threads", 0, kernel, {.threads = 2}),
        ipc_case<float>("IPC 3x3 on 4088^2, float32", 0, kernel, {}, Peer::naive),
        ipc_case<double>("IPC 3x3 on 4088^2, float64", 0, kernel, {}, Peer::fft),
        ipc_case<double>("IPC 3x3 on 4088^2, float64, taps 32 apart", 0, kernel, {.tap_step = 32}),
        inverse_case("exact IPC inverse on 4088^2, alpha = 0.02", 0.02, Edge::zero),
        inverse_case("exact IPC inverse on 4088^2, alpha = 0.12", 0.12, Edge::zero),
        inverse_case("exact IPC inverse on 4088^2, alpha = 0.12, periodic", 0.12, Edge::wrap),
        inverse_case("exact IPC inverse on 4088^2, alpha = 0.12, replicated", 0.12,
                     Edge::replicate),
        inverse_case("exact IPC inverse on 4088^2, alpha = 0.124", 0.124, Edge::zero),
        inverse_case("exact IPC inverse on 4088^2, alpha = 0.1248", 0.1248, Edge::zero),
        varying_case("varying IPC on 4088^2, float64, scatter", IpcForm::scatter),
        varying_case("varying IPC on 4088^2, float64, gather", IpcForm::gather),
        varying_inverse_case()};
    for (const double alpha : {0.01, 0.02, 0.05})
        for (const int64_t order : {1, 2, 4, 8})
            cases.push_back(neumann_case(alpha, order));
    cases.push_back(noise_case());
    cases.push_back(varying_noise_case());
    cases.push_back(chain_case("Roman's detector chain on 4088^2, float32", "roman-c9", true));
    cases.push_back(
        chain_case("Roman's detector chain on 4088^2, float32, two threads", "roman-c9", true, 2));
    cases.push_back(
        chain_case("Roman's detector chain on 4088^2, float32, means", "roman-c9", false));
    cases.push_back(
        chain_case("Cycle 5's detector chain on 4088^2, float32", "wfirst-afta-c5", true));
    cases.push_back(
        chain_case("Cycle 5's detector chain on 4088^2, float32, means", "wfirst-afta-c5", false));
    return cases;
}

} // namespace wfpsf::bench
