// SPDX-License-Identifier: GPL-3.0-or-later
// Moments, their derivatives, and EE50 of an obscured Airy pattern averaged over the native pixel.
// Errors are against the same star sampled at another rate and measured to the last digit: both
// sample a band-limited image finely enough to agree to rounding. The field's standard code (HSM,
// in GalSim 2.8.4) is no part of the run: its times are constants, measured once on another machine
// of this class with the same stars at an error of 3e-8, and say so.
#include "harness.hpp"
#include "instrument/instrument.hpp"
#include "moments/covariance.hpp"
#include "moments/encircled.hpp"
#include "optics/psf.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace wfpsf::bench {

namespace {

constexpr double pixel_scale = 0.11 * std::numbers::pi / 180 / 3600;

// A star of J129 on n^2 samples, N a native pixel, 0.3 samples off the centre.
Plane<double> star(int64_t n, int64_t N) {
    const double wavelength = 1292.11e-9;
    const Psf psf(make_aperture(Instrument::get("wfirst-afta-c5").annular_pupil()),
                  Wavefront({}, 1.18), {wavelength, pixel_scale, 1e-11, 16});
    Plane<double> image(n, n);
    const double centre = static_cast<double>(n - 1) / 2 + 0.3;
    psf.draw({centre, centre, 1}, N, image.view());
    return image;
}

Gaussian guess(int64_t n, int64_t N) {
    const double size = 0.6 * static_cast<double>(N);
    return {.x = static_cast<double>(n - 1) / 2,
            .y = static_cast<double>(n - 1) / 2,
            .Mxx = size * size,
            .Mxy = 0,
            .Myy = size * size};
}

double native_sigma(const Plane<double> &image, int64_t N, const AdaptiveOptions &options) {
    return adaptive_moments(image.view(), guess(image.nx(), N), options).sigma() /
           static_cast<double>(N);
}

double true_sigma() {
    return native_sigma(star(24 * 20, 20), 20, {.tolerance = 1e-12});
}

std::string name_of(const char *what, int64_t n, int64_t N, const char *how, double tolerance) {
    char name[96];
    std::snprintf(name, sizeof name, "%s %lld^2 (N = %lld), %s%.0e", what,
                  static_cast<long long>(n), static_cast<long long>(N), how, tolerance);
    return name;
}

// Of HSM's core, without Python and copies: time, or 0.
void compare(Measured &m, double core_s) {
    if (core_s > 0) {
        char name[64];
        std::snprintf(name, sizeof name, "HSM's core, %.3g us, measured elsewhere", 1e6 * core_s);
        m.baseline_s = core_s;
        m.baseline = name;
    }
}

struct Stamp {
    int64_t n, N;
    double target_s, core_s, cold_core_s; // at a tolerance of 1e-8
};
constexpr Stamp stamps[] = {{32, 4, 12e-6, 54e-6, 0},
                            {128, 4, 15e-6, 67e-6, 0},
                            {512, 16, 60e-6, 960e-6, 1030e-6},
                            {1024, 32, 0, 4095e-6, 0}};

Case adaptive_case(const Stamp &stamp, double tolerance) {
    const int64_t n = stamp.n, N = stamp.N;
    const bool aim = tolerance == 1e-8;
    return {name_of("adaptive moments", n, N, "tolerance ", tolerance), "relative error of sigma",
            aim ? stamp.target_s : 0, tolerance, [=] {
                const Plane<double> image = star(n, N);
                const AdaptiveOptions options{.tolerance = tolerance};
                Measured m;
                m.timing = time([&] { adaptive_moments(image.view(), guess(n, N), options); });
                m.error = std::abs(native_sigma(image, N, options) / true_sigma() - 1);
                if (aim)
                    compare(m, stamp.core_s);
                return m;
            }};
}

// Of more images in turn than the cache holds.
Case cold_case(const Stamp &stamp) {
    const int64_t n = stamp.n, N = stamp.N;
    return {name_of("adaptive moments", n, N, "cold cache, tolerance ", 1e-8),
            "relative error of sigma", 0, 1e-8, [=] {
                const Plane<double> image = star(n, N);
                const std::vector<Plane<double>> copies(
                    static_cast<size_t>(1 + 100000000 / (8 * n * n)), image);
                size_t next = 0;
                Measured m;
                m.timing = time([&] {
                    adaptive_moments(copies[next].view(), guess(n, N));
                    next = (next + 1) % copies.size();
                });
                m.error = std::abs(native_sigma(image, N, {}) / true_sigma() - 1);
                compare(m, stamp.cold_core_s);
                return m;
            }};
}

// A native star fitted at its pixels' centres, alone, and with a background that is fitted too.
Case fit_case(MomentsMethod method) {
    return {method == MomentsMethod::with_background
                ? "least squares 32^2 (N = 1), background fitted, tolerance 1e-08"
                : "least squares 32^2 (N = 1), tolerance 1e-08",
            "whitened, against 1e-12", 0, 1e-8, [=] {
                Plane<double> image = star(32, 1);
                for (int64_t y = 0; y < 32; ++y)
                    for (int64_t x = 0; x < 32; ++x)
                        image(x, y) += method == MomentsMethod::with_background ? 1e-2 : 0;
                const auto fitted = [&](double tolerance) {
                    return adaptive_moments(std::as_const(image).view(), guess(32, 1),
                                            {.tolerance = tolerance, .method = method});
                };
                Measured m;
                m.timing = time([&] { fitted(1e-8); });
                m.error = whitened_distance(fitted(1e-12).weight, fitted(1e-8).weight);
                return m;
            }};
}

// At a signal-to-noise ratio of 10. The error is that of the standard deviation of Mxx, against
// noisy images, which tell it to 2 %.
Case covariance_case(int order) {
    return {order == 1 ? "covariance of all moments 32^2 (N = 4), first order"
                       : "covariance of all moments 32^2 (N = 4), second order",
            "of the deviation of Mxx, S/N 10", 0, order == 1 ? 0 : 0.2, [=] {
                const Plane<double> image = star(32, 4);
                const AdaptiveMoments at = adaptive_moments(image.view(), guess(32, 4));
                const double amplitude = at.amplitude();
                const double variance =
                    amplitude * amplitude * std::numbers::pi * std::sqrt(at.weight.det()) / 100;
                MomentsCovariance predicted;
                Measured m;
                m.timing = time([&] {
                    predicted = covariance(image.view(), at, {}, {},
                                           View<const double>{&variance, 32, 32, 0, 0}, order);
                });
                std::mt19937 random(5);
                std::normal_distribution<double> noise(0, std::sqrt(variance));
                double count = 0, sum = 0, squares = 0;
                for (int trial = 0; trial < 3000; ++trial) {
                    Plane<double> noisy = image;
                    for (int64_t y = 0; y < 32; ++y)
                        for (int64_t x = 0; x < 32; ++x)
                            noisy(x, y) += noise(random);
                    const AdaptiveMoments found =
                        adaptive_moments(std::as_const(noisy).view(), guess(32, 4));
                    if (found.status != WFPSF_OK)
                        continue;
                    const double change = found.weight.Mxx - at.weight.Mxx;
                    ++count;
                    sum += change;
                    squares += change * change;
                }
                const double deviation = std::sqrt(squares / count - sum / count * (sum / count));
                m.error = std::abs(std::sqrt(predicted[2][2]) / deviation - 1);
                return m;
            }};
}

// With a pixel missing at the centre: the error is what it moves sigma by.
Case masked_case() {
    return {"adaptive moments 128^2 (N = 8), centre missing", "relative change of sigma", 0, 0, [] {
                const Plane<double> image = star(128, 8);
                Plane<float> missing(128, 128);
                missing(64, 64) = 1;
                const auto measured = [&] {
                    return adaptive_moments(image.view(), guess(128, 8), {}, missing.view());
                };
                Measured m;
                m.timing = time([&] { measured(); });
                m.error = std::abs(measured().sigma() / 8 / true_sigma() - 1);
                return m;
            }};
}

// Analytic derivatives along a change of the image, given the solution; the error is against
// central differences of whole measurements, extrapolated.
Case derivative_case(bool second) {
    return {second ? "second derivatives of all moments 512^2 (N = 32)"
                   : "derivatives of all moments 512^2 (N = 32)",
            "relative error, sigma", 0, 1e-8, [=] {
                const Plane<double> image = star(512, 32);
                Plane<double> change(512, 512); // to a neighbour, one native pixel away
                for (int64_t y = 0; y < 512; ++y)
                    for (int64_t x = 32; x < 512; ++x)
                        change(x, y) = image(x - 32, y);
                const AdaptiveOptions options{.tolerance = 1e-12};
                const auto measured = [&](double t) {
                    Plane<double> sum = image;
                    for (int64_t y = 0; y < 512; ++y)
                        for (int64_t x = 0; x < 512; ++x)
                            sum(x, y) += t * change(x, y);
                    return adaptive_moments(std::as_const(sum).view(), guess(512, 32), options);
                };
                const AdaptiveMoments at = measured(0);
                const auto derived = [&] {
                    const Sensitivity sensitivity(image.view(), at, options, {}, second);
                    const ImageChange along = sensitivity.change_of(std::as_const(change).view());
                    const HyperDual sigma = shape_of(sensitivity.along(along, along)).sigma;
                    return second ? sigma.dab : sigma.da;
                };
                const auto difference = [&](double h) {
                    const double up = measured(h).sigma(), down = measured(-h).sigma();
                    return second ? (up - 2 * at.sigma() + down) / (h * h) : (up - down) / (2 * h);
                };
                const double h = second ? 8e-3 : 2e-3;
                const double f1 = difference(h), f2 = difference(2 * h), f4 = difference(4 * h);
                const double expected = (16 * (4 * f1 - f2) / 3 - (4 * f2 - f4) / 3) / 15;
                Measured m;
                m.timing = time([&] { derived(); });
                m.error = std::abs(derived() / expected - 1);
                return m;
            }};
}

// The bandwidth is that of the image at this sampling, or the default, which is any image's that is
// sampled at twice Nyquist's rate.
Case ee50_case(double bandwidth, double eps) {
    char name[96];
    std::snprintf(name, sizeof name, "EE50 512^2 (N = 32), bandwidth %g, eps %.0e", bandwidth, eps);
    return {name, "relative error", 0, eps, [=] {
                const auto ee50 = [](const Plane<double> &image, int64_t N,
                                     const EncircledOptions &options) {
                    const double centre = static_cast<double>(image.nx() - 1) / 2 + 0.3;
                    return encircled_radius(image.view(), centre, centre, 0.5, 1, options).value /
                           static_cast<double>(N);
                };
                const Plane<double> image = star(512, 32);
                const EncircledOptions options{.bandwidth = bandwidth, .eps = eps};
                Measured m;
                m.timing = time([&] { ee50(image, 32, options); });
                m.error = std::abs(ee50(image, 32, options) / ee50(star(24 * 20, 20), 20, {}) - 1);
                return m;
            }};
}

Case width_case() {
    return {"FWHM of the profile 512^2 (N = 32), bandwidth 0.05, eps 1e-06", "relative error", 0,
            1e-6, [] {
                const auto fwhm = [](const Plane<double> &image, int64_t N, double eps) {
                    const double centre = static_cast<double>(image.nx() - 1) / 2 + 0.3;
                    return profile_fwhm(image.view(), centre, centre,
                                        {1.6 / static_cast<double>(N), eps})
                               .value /
                           static_cast<double>(N);
                };
                const Plane<double> image = star(512, 32);
                Measured m;
                m.timing = time([&] { fwhm(image, 32, 1e-6); });
                m.error = std::abs(fwhm(image, 32, 1e-6) / fwhm(star(24 * 20, 20), 20, 1e-12) - 1);
                return m;
            }};
}

} // namespace

std::vector<Case> moments_cases() {
    std::vector<Case> cases;
    for (const double tolerance : {1e-4, 1e-8, 1e-11})
        for (const Stamp &stamp : stamps)
            cases.push_back(adaptive_case(stamp, tolerance));
    for (const Stamp &stamp : stamps)
        if (stamp.n > 32)
            cases.push_back(cold_case(stamp));
    cases.push_back(masked_case());
    cases.push_back(fit_case(MomentsMethod::least_squares));
    cases.push_back(fit_case(MomentsMethod::with_background));
    cases.push_back(derivative_case(false));
    cases.push_back(derivative_case(true));
    cases.push_back(covariance_case(1));
    cases.push_back(covariance_case(2));
    for (const double bandwidth : {0.05, 0.25})
        for (const double eps : {1e-6, 1e-12})
            cases.push_back(ee50_case(bandwidth, eps));
    cases.push_back(width_case());
    return cases;
}

} // namespace wfpsf::bench
