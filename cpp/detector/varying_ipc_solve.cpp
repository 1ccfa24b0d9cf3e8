// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/random.hpp"
#include "detector/varying_ipc.hpp"
#include "error/error.hpp"
#include "numerics/working_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace wfpsf {

namespace {

// x with A x = b. It starts from what is in x.
Iteration solve(const VaryingIpc &ipc, const VaryingConvolution &how, View<const double> b,
                double tolerance, int64_t most_passes, View<double> x, View<double> scratch) {
    const double scale = std::max(largest_magnitude(b), std::numeric_limits<double>::min());
    const auto set_difference = [&] {
        convolve(ipc, View<const double>(x), how, scratch);
        for (int64_t j = 0; j < b.ny; ++j)
            for (int64_t i = 0; i < b.nx; ++i)
                scratch(i, j) = b(i, j) - scratch(i, j);
    };
    const auto step = [&](double weight) {
        set_difference();
        for (int64_t j = 0; j < b.ny; ++j)
            for (int64_t i = 0; i < b.nx; ++i)
                x(i, j) += weight * scratch(i, j);
    };
    const auto residual = [&] {
        set_difference();
        return largest_magnitude(scratch) / scale;
    };
    return solve_by_chebyshev(step, residual, ipc.spectrum(), tolerance, most_passes);
}

// The rms of what the inverse makes of random signs: in the mean over all signs it is that of any
// white noise. Small images are tried again and again.
double measured_noise(const VaryingIpc &ipc, const VaryingConvolution &how, int64_t most_passes,
                      View<double> signs, View<double> x, View<double> scratch) {
    constexpr int64_t enough = 1 << 16, most_trials = 64;
    const int64_t pixels = x.nx * x.ny;
    const int64_t trials = std::clamp<int64_t>(enough / pixels, 1, most_trials);
    constexpr double tolerance = 1e-4; // the sampling error is no smaller
    double sum = 0;
    for (int64_t trial = 0; trial < trials; ++trial) {
        const RandomSource random{.stream = static_cast<uint32_t>(trial)};
        for (int64_t j = 0; j < x.ny; ++j) {
            fill_normal(random, 0, j, x.nx, signs.row(j));
            for (int64_t i = 0; i < x.nx; ++i)
                x(i, j) = signs(i, j) = std::copysign(1.0, signs(i, j));
        }
        solve(ipc, how, signs, tolerance, most_passes, x, scratch);
        for (int64_t j = 0; j < x.ny; ++j)
            for (int64_t i = 0; i < x.nx; ++i)
                sum += x(i, j) * x(i, j);
    }
    return std::sqrt(sum / static_cast<double>(pixels * trials));
}

template <class T>
Solution solve_any(const VaryingIpc &ipc, View<const T> in, const VaryingConvolution &how,
                   const SolveLimits &limits, bool with_noise, View<T> out) {
    require_invertible_edge(how.edge);
    for (const auto &[nx, ny] : {std::pair(in.nx, in.ny), std::pair(out.nx, out.ny)})
        if (nx != ipc.nx() || ny != ipc.ny())
            fail(WFPSF_ERROR_SIZE,
                 "in and out have %lld x %lld pixels: the detector has %lld x %lld",
                 static_cast<long long>(nx), static_cast<long long>(ny),
                 static_cast<long long>(ipc.nx()), static_cast<long long>(ipc.ny()));
    const VaryingIpc::Weakest &weakest = ipc.weakest();
    if (!(weakest.margin >= limits.least_margin) || !(ipc.spectrum().lowest > 0))
        fail(WFPSF_ERROR_KERNEL_SINGULAR,
             "min |K^| = %.3g at pixel (%lld, %lld): must be at least %.3g, the least margin, and "
             "every transform positive, for an inverse",
             weakest.margin, static_cast<long long>(weakest.x), static_cast<long long>(weakest.y),
             limits.least_margin);
    Solution solution;
    solution.margin = weakest.margin;
    if (in.empty())
        return solution;

    WorkingPlane<double> charge(in.nx, in.ny), observed(in.nx, in.ny), scratch(in.nx, in.ny);
    const View<double> x = charge.view(), b = observed.view();
    if (with_noise)
        solution.noise_amplification =
            measured_noise(ipc, how, limits.most_passes, b, x, scratch.view());
    for (int64_t j = 0; j < in.ny; ++j)
        for (int64_t i = 0; i < in.nx; ++i) {
            const bool finite = std::isfinite(in(i, j));
            x(i, j) = b(i, j) = finite ? static_cast<double>(in(i, j)) : 0;
            solution.not_finite += finite ? 0 : 1;
        }
    const double tolerance = std::max(limits.tolerance, least_tolerance<T>);
    const Iteration iteration =
        solve(ipc, how, b, tolerance, limits.most_passes, x, scratch.view());
    solution.residual = iteration.residual;
    solution.passes = iteration.passes;
    solution.converged = iteration.converged;
    for (int64_t j = 0; j < in.ny; ++j)
        for (int64_t i = 0; i < in.nx; ++i)
            out(i, j) = std::isfinite(in(i, j)) ? static_cast<T>(x(i, j)) : in(i, j);
    return solution;
}

} // namespace

Solution solve_ipc(const VaryingIpc &ipc, View<const float> in, const VaryingConvolution &how,
                   const SolveLimits &limits, bool with_noise, View<float> out) {
    return solve_any(ipc, in, how, limits, with_noise, out);
}

Solution solve_ipc(const VaryingIpc &ipc, View<const double> in, const VaryingConvolution &how,
                   const SolveLimits &limits, bool with_noise, View<double> out) {
    return solve_any(ipc, in, how, limits, with_noise, out);
}

} // namespace wfpsf
