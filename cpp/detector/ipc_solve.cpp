// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_solve.hpp"

#include "detector/chebyshev.hpp"
#include "detector/ipc_sweep.hpp"
#include "error/error.hpp"
#include "image/interleave.hpp"
#include "numerics/fft.hpp"
#include "numerics/plane_filter.hpp"
#include "numerics/working_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace wfpsf {

namespace {

// K^ at every pair of two sets of frequencies: the rows' transforms first.
class Transform {
  public:
    Transform(const IpcKernel &kernel, const std::vector<double> &fx, std::vector<double> fy)
        : kernel_(kernel), fy_(std::move(fy)), rows_(static_cast<int64_t>(fx.size()), kernel.ny()) {
        for (int64_t dy = -kernel.reach_y(); dy <= kernel.reach_y(); ++dy)
            for (int64_t dx = -kernel.reach_x(); dx <= kernel.reach_x(); ++dx)
                for (size_t j = 0; j < fx.size(); ++j)
                    rows_(static_cast<int64_t>(j), dy + kernel.reach_y()) +=
                        kernel(dx, dy) * turn(fx[j], dx);
    }

    void operator()(int64_t k, std::complex<double> *values) const {
        std::fill_n(values, rows_.nx(), 0);
        for (int64_t dy = -kernel_.reach_y(); dy <= kernel_.reach_y(); ++dy) {
            const std::complex<double> phase = turn(fy_[static_cast<size_t>(k)], dy);
            for (int64_t j = 0; j < rows_.nx(); ++j)
                values[j] += phase * rows_(j, dy + kernel_.reach_y());
        }
    }

    int64_t nx() const { return rows_.nx(); }
    int64_t ny() const { return static_cast<int64_t>(fy_.size()); }

  private:
    static std::complex<double> turn(double frequency, int64_t d) {
        const double cycles = std::remainder(frequency * static_cast<double>(d), 1.0);
        return std::polar(1.0, -2 * std::numbers::pi * cycles);
    }

    const IpcKernel &kernel_;
    std::vector<double> fy_;
    Plane<std::complex<double>> rows_;
};

Transform transform_on_grid(const IpcKernel &kernel, int64_t n) {
    return {kernel, filter_frequencies(Continuation::periodic, n, true),
            filter_frequencies(Continuation::periodic, n, false)};
}

int64_t fine_grid(const IpcKernel &kernel) {
    return 2 * good_fft_length(std::max<int64_t>(16, 2 * std::max(kernel.nx(), kernel.ny())));
}

bool is_symmetric_3x3(const IpcKernel &kernel) {
    const KernelAsymmetry asymmetry = kernel.asymmetry();
    return std::max(kernel.nx(), kernel.ny()) <= 3 && asymmetry.left_right == 0 &&
           asymmetry.up_down == 0;
}

// The continuation beyond the border under which a transform has the inverse exactly.
std::optional<Continuation> continuation_of(const IpcKernel &kernel, Edge edge) {
    if (edge == Edge::wrap)
        return Continuation::periodic;
    if (!is_symmetric_3x3(kernel))
        return std::nullopt;
    return edge == Edge::zero ? Continuation::odd : Continuation::even;
}

template <class From, class To> void copy_pixels(View<From> from, View<To> to) {
    for (int64_t y = 0; y < to.ny; ++y)
        for (int64_t x = 0; x < to.nx; ++x)
            to(x, y) = static_cast<std::remove_const_t<To>>(from(x, y));
}

void divide(const IpcKernel &kernel, Continuation continuation, double step, View<double> image) {
    if (step == 1 && is_symmetric_3x3(kernel) && divide_by_sweeps(kernel, continuation, image))
        return;
    std::vector<double> fx = filter_frequencies(continuation, image.nx, true);
    std::vector<double> fy = filter_frequencies(continuation, image.ny, false);
    for (auto *frequencies : {&fx, &fy})
        for (double &f : *frequencies)
            f *= step;
    const Transform transform(kernel, fx, fy);
    filter_plane(image, continuation, [&](int64_t k, std::complex<double> *factors) {
        transform(k, factors);
        for (int64_t j = 0; j < transform.nx(); ++j)
            factors[j] = 1.0 / factors[j];
    });
}

// The phases of an oversampled image do not mix unless it is periodic.
void divide_by_phases(const IpcKernel &kernel, Continuation continuation, int64_t tap_step,
                      View<double> image) {
    if (continuation == Continuation::periodic) {
        divide(kernel, continuation, static_cast<double>(tap_step), image);
        return;
    }
    for (int64_t j = 0; j < std::min(tap_step, image.ny); ++j)
        for (int64_t i = 0; i < std::min(tap_step, image.nx); ++i) {
            const View<double> phase = phase_view(image, tap_step, tap_step, i, j);
            WorkingPlane<double> native(phase.nx, phase.ny);
            copy_pixels(phase, native.view());
            divide(kernel, continuation, 1, native.view());
            copy_pixels(native.view(), phase);
        }
}

void require_margin(const StabilityMargin &margin, double least) {
    if (!(margin.value >= least))
        fail(WFPSF_ERROR_KERNEL_SINGULAR,
             "min |K^| = %.3g at (%.4g, %.4g) cycles per pixel: must be at least %.3g, the least "
             "margin, for an inverse",
             margin.value, margin.frequency_x, margin.frequency_y, least);
}

// scale K + (0 or 1) delta
Plane<double> scaled(const IpcKernel &kernel, double scale, double delta) {
    Plane<double> taps(kernel.nx(), kernel.ny());
    for (int64_t y = 0; y < kernel.ny(); ++y)
        for (int64_t x = 0; x < kernel.nx(); ++x)
            taps(x, y) = scale * kernel.table()(x, y);
    taps(kernel.reach_x(), kernel.reach_y()) += delta;
    return taps;
}

template <class T>
Solution solve_any(const IpcKernel &kernel, View<const T> in, const Convolution &how,
                   const SolveLimits &limits, View<T> out) {
    require_invertible_edge(how.edge);
    if (in.nx != out.nx || in.ny != out.ny)
        fail(WFPSF_ERROR_SIZE, "out has %lld x %lld pixels: must have %lld x %lld",
             static_cast<long long>(out.nx), static_cast<long long>(out.ny),
             static_cast<long long>(in.nx), static_cast<long long>(in.ny));
    const StabilityMargin margin = kernel.margin();
    require_margin(margin, limits.least_margin);
    Solution solution;
    solution.noise_amplification = inverse_noise_amplification(kernel);
    solution.margin = margin.value;
    if (in.empty())
        return solution;

    WorkingPlane<double> charge(in.nx, in.ny), observed(in.nx, in.ny), scratch(in.nx, in.ny);
    const View<double> x = charge.view(), b = observed.view();
    for (int64_t j = 0; j < in.ny; ++j)
        for (int64_t i = 0; i < in.nx; ++i) {
            const bool finite = std::isfinite(in(i, j));
            x(i, j) = b(i, j) = finite ? static_cast<double>(in(i, j)) : 0;
            solution.not_finite += finite ? 0 : 1;
        }
    const double scale = std::max(largest_magnitude(b), std::numeric_limits<double>::min());
    const auto step = [&](double weight) {
        convolve_and_add(scaled(kernel, -weight, 1).view(), x, how, {b, weight}, x);
    };
    const auto residual = [&] {
        convolve_and_add(scaled(kernel, -1, 0).view(), x, how, {b, 1}, scratch.view());
        return largest_magnitude(scratch.view()) / scale;
    };

    const double tolerance = std::max(limits.tolerance, least_tolerance<T>);
    const SpectralInterval spectrum = real_spectrum(kernel);
    const bool is_positive = spectrum.lowest > 0;
    const auto continuation = continuation_of(kernel, how.edge);
    constexpr int64_t many_passes = 20; // cost what a transform does, at least
    if (continuation && !(is_positive && chebyshev_passes(spectrum, tolerance) <= many_passes)) {
        divide_by_phases(kernel, *continuation, how.tap_step, x);
        solution.residual = residual();
    } else if (is_positive) {
        const Iteration iteration =
            solve_by_chebyshev(step, residual, spectrum, tolerance, limits.most_passes);
        solution.residual = iteration.residual;
        solution.passes = iteration.passes;
        solution.converged = iteration.converged;
    } else {
        fail(WFPSF_ERROR_KERNEL_SINGULAR,
             "the kernel's transform is not positive: with this edge it has no inverse here; wrap "
             "has one");
    }
    for (int64_t j = 0; j < in.ny; ++j)
        for (int64_t i = 0; i < in.nx; ++i)
            out(i, j) = std::isfinite(in(i, j)) ? static_cast<T>(x(i, j)) : in(i, j);
    return solution;
}

} // namespace

SpectralInterval real_spectrum(const IpcKernel &kernel) {
    const Transform transform = transform_on_grid(kernel, fine_grid(kernel));
    std::vector<std::complex<double>> values(static_cast<size_t>(transform.nx()));
    SpectralInterval spectrum{HUGE_VAL, -HUGE_VAL};
    for (int64_t k = 0; k < transform.ny(); ++k) {
        transform(k, values.data());
        for (const std::complex<double> value : values) {
            spectrum.lowest = std::min(spectrum.lowest, value.real());
            spectrum.highest = std::max(spectrum.highest, value.real());
        }
    }
    return spectrum;
}

void require_invertible_edge(Edge edge) {
    if (edge != Edge::zero && edge != Edge::replicate && edge != Edge::wrap)
        fail(WFPSF_ERROR_ARGUMENT, "edge = %d: must be zero, replicate or wrap for an inverse",
             static_cast<int>(edge));
}

// The mean of 1 / |K^|^2 over a grid converges as fast as the inverse's taps decay; the grid is
// refined until it agrees.
double inverse_noise_amplification(const IpcKernel &kernel) {
    double before = 0;
    for (int64_t n = fine_grid(kernel);; n *= 2) {
        const Transform transform = transform_on_grid(kernel, n);
        std::vector<std::complex<double>> values(static_cast<size_t>(transform.nx()));
        double sum = 0;
        for (int64_t k = 0; k < n; ++k) {
            transform(k, values.data());
            for (size_t j = 0; j < values.size(); ++j) {
                const bool has_twin = j > 0 && 2 * static_cast<int64_t>(j) < n;
                sum += (has_twin ? 2 : 1) / std::norm(values[j]);
            }
        }
        const double mean = sum / (static_cast<double>(n) * static_cast<double>(n));
        if (std::fabs(mean - before) <= 1e-10 * mean || n > 2000 || !std::isfinite(mean))
            return std::sqrt(mean);
        before = mean;
    }
}

Solution solve_ipc(const IpcKernel &kernel, View<const float> in, const Convolution &how,
                   const SolveLimits &limits, View<float> out) {
    return solve_any(kernel, in, how, limits, out);
}

Solution solve_ipc(const IpcKernel &kernel, View<const double> in, const Convolution &how,
                   const SolveLimits &limits, View<double> out) {
    return solve_any(kernel, in, how, limits, out);
}

double largest_magnitude(View<const double> image) {
    double most = 0;
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x)
            most = std::max(most, std::fabs(image(x, y)));
    return most;
}

} // namespace wfpsf
