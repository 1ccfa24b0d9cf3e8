// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_solve.hpp"
#include "error/error.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace wfpsf {
namespace {

const Edge invertible_edges[] = {Edge::zero, Edge::replicate, Edge::wrap};

Plane<double> noise(int64_t nx, int64_t ny) {
    Plane<double> image(nx, ny);
    uint32_t state = 12345;
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x) {
            state = state * 1664525U + 1013904223U;
            image(x, y) = static_cast<double>(state >> 16) / 65536.0;
        }
    return image;
}

double largest_difference(const Plane<double> &a, const Plane<double> &b) {
    double most = 0;
    for (int64_t y = 0; y < a.ny(); ++y)
        for (int64_t x = 0; x < a.nx(); ++x)
            most = std::max(most, std::fabs(a(x, y) - b(x, y)));
    return most;
}

// A kernel without symmetry; its taps beside the centre add up to `coupling`.
IpcKernel lopsided(double coupling) {
    double taps[9] = {.001, .015, .0012, .0146, 0, .0129, .0011, .0144, .0012}, sum = 0;
    for (const double tap : taps)
        sum += tap;
    for (double &tap : taps)
        tap *= coupling / sum;
    taps[4] = 1 - coupling;
    return IpcKernel::from_table({taps, 3, 3, 1, 3});
}

// alpha alone: min |K^| = 1 - 8 alpha at (1/2, 1/2).
IpcKernel with_margin(double margin) {
    return IpcKernel::parametric((1 - margin) / 8);
}

struct RoundTrip {
    Solution solution;
    double error; // of pixels in 0..1
};

RoundTrip round_trip(const IpcKernel &kernel, const Plane<double> &charge, Convolution how,
                     SolveLimits limits = {}) {
    Plane<double> seen(charge.nx(), charge.ny()), found(charge.nx(), charge.ny());
    convolve(kernel, charge.view(), how, seen.view());
    const Solution solution =
        solve_ipc(kernel, std::as_const(seen).view(), how, limits, found.view());
    return {solution, largest_difference(found, charge)};
}

TEST(IpcSolve, ForwardThenInverseIsTheIdentity) {
    const int64_t sizes[][2] = {{1, 1}, {1, 9}, {7, 1}, {2, 2}, {41, 30}};
    const double wide[25] = {0,    0, .001, 0,   0,    0, .002, .02, .002, 0, .001, .02, .908, .02,
                             .001, 0, .002, .02, .002, 0, 0,    0,   .001, 0, 0};
    const IpcKernel kernels[] = {IpcKernel::parametric(0.02, 0.002, 0.001),
                                 lopsided(0.06),
                                 IpcKernel::wfc3(),
                                 with_margin(0.05),
                                 with_margin(2e-3),
                                 IpcKernel::from_table({wide, 5, 5, 1, 5})};
    for (const auto &[nx, ny] : sizes)
        for (const IpcKernel &kernel : kernels)
            for (const Edge edge : invertible_edges)
                for (const int64_t tap_step : {1, 3}) {
                    const RoundTrip r = round_trip(kernel, noise(nx, ny), {edge, 0, tap_step});
                    EXPECT_TRUE(r.solution.converged);
                    EXPECT_LE(r.error, 1e-12) << nx << " x " << ny << ", edge "
                                              << static_cast<int>(edge) << ", step " << tap_step;
                    EXPECT_LE(r.error,
                              20 * std::max(r.solution.residual, 2e-16) / r.solution.margin);
                }
}

TEST(IpcSolve, ErrorGrowsAsOneOverTheMargin) {
    const Plane<double> charge = noise(32, 24); // even sizes: the worst frequency is on their grid
    for (const double margin : {1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11})
        for (const Edge edge : invertible_edges) {
            const RoundTrip r =
                round_trip(with_margin(margin), charge, {edge}, {.least_margin = 0});
            EXPECT_NEAR(r.solution.margin, margin, 1e-15);
            EXPECT_LE(r.error, 4e-15 / margin);
            EXPECT_LE(r.solution.residual, 1e-14);
        }
}

TEST(IpcSolve, RefusesNearlySingularKernels) {
    const Plane<double> in = noise(8, 8);
    Plane<double> out(8, 8);
    const auto status_of = [&](const IpcKernel &kernel, Edge edge, double least) {
        try {
            solve_ipc(kernel, in.view(), {edge}, {.least_margin = least}, out.view());
        } catch (const Error &error) {
            return error.status();
        }
        return wfpsf_status{WFPSF_OK};
    };
    EXPECT_EQ(status_of(with_margin(0.9e-3), Edge::wrap, 1e-3), WFPSF_ERROR_KERNEL_SINGULAR);
    EXPECT_EQ(status_of(with_margin(1.1e-3), Edge::wrap, 1e-3), WFPSF_OK);
    EXPECT_EQ(status_of(with_margin(0.9e-3), Edge::wrap, 1e-4), WFPSF_OK);
    EXPECT_EQ(status_of(with_margin(0.5), Edge::wrap, 0.6), WFPSF_ERROR_KERNEL_SINGULAR);
    EXPECT_EQ(status_of(with_margin(0.5), Edge::crop, 0), WFPSF_ERROR_ARGUMENT);
}

TEST(IpcSolve, TheIterationAndTheTransformAgree) {
    const IpcKernel kernel = IpcKernel::parametric(0.05, 0.005);
    const IpcKernel slow = IpcKernel::parametric(0.12, 0.001); // solved by transform
    EXPECT_GT(round_trip(kernel, noise(50, 40), {}).solution.passes, 0);
    EXPECT_EQ(round_trip(slow, noise(50, 40), {}).solution.passes, 0);
}

// Large enough for the sweeps, of any parity; the kernel couples more along y.
TEST(IpcSolve, SweepsOverLargeImagesAreExact) {
    const int64_t sizes[][2] = {{331, 200}, {200, 331}, {512, 180}};
    for (const auto &[nx, ny] : sizes)
        for (const IpcKernel &kernel :
             {IpcKernel::parametric(0.115, 0.001), IpcKernel::parametric(0.1, 0.001, -0.015),
              IpcKernel::parametric(0.1, 0.02)})
            for (const Edge edge : invertible_edges) {
                const RoundTrip r = round_trip(kernel, noise(nx, ny), {edge});
                EXPECT_EQ(r.solution.passes, 0);
                EXPECT_LE(r.solution.residual, 3e-15);
                EXPECT_LE(r.error, 3e-15 / r.solution.margin);
            }
}

TEST(IpcSolve, ConservesChargeOnAPeriodicImage) {
    const Plane<double> in = noise(64, 48);
    Plane<double> out(64, 48);
    solve_ipc(lopsided(0.08), in.view(), {Edge::wrap}, {}, out.view());
    long double before = 0, after = 0;
    for (int64_t y = 0; y < 48; ++y)
        for (int64_t x = 0; x < 64; ++x)
            before += in(x, y), after += out(x, y);
    EXPECT_NEAR(static_cast<double>(after / before), 1, 1e-15);
}

TEST(IpcSolve, InPlaceOnManyThreadsGivesTheSameBits) {
    const Plane<double> in = noise(33, 29);
    Plane<double> expected(33, 29), both = in;
    solve_ipc(lopsided(0.06), in.view(), {}, {}, expected.view());
    solve_ipc(lopsided(0.06), std::as_const(both).view(), {.threads = 4}, {}, both.view());
    EXPECT_EQ(largest_difference(expected, both), 0);
}

TEST(IpcSolve, PixelsThatAreNotFiniteStayAndAreCounted) {
    Plane<float> in(9, 9), out(9, 9), clean(9, 9);
    for (int64_t y = 0; y < 9; ++y)
        for (int64_t x = 0; x < 9; ++x)
            in(x, y) = -1e30F;
    in(4, 4) = 0;
    solve_ipc(with_margin(0.8), std::as_const(in).view(), {}, {}, clean.view());
    in(4, 4) = std::numeric_limits<float>::quiet_NaN();
    const Solution solution =
        solve_ipc(with_margin(0.8), std::as_const(in).view(), {}, {}, out.view());
    EXPECT_EQ(solution.not_finite, 1);
    for (int64_t y = 0; y < 9; ++y)
        for (int64_t x = 0; x < 9; ++x)
            if (x == 4 && y == 4)
                EXPECT_TRUE(std::isnan(out(x, y)));
            else
                EXPECT_EQ(out(x, y), clean(x, y));
}

TEST(IpcSolve, NoiseAmplificationIsTheSumOfTheInverseTapsSquared) {
    for (const double margin : {0.84, 0.3, 0.05}) {
        Plane<double> point(256, 256), inverse(256, 256);
        point(0, 0) = 1;
        const Solution solution = solve_ipc(with_margin(margin), std::as_const(point).view(),
                                            {Edge::wrap}, {}, inverse.view());
        long double sum = 0;
        for (int64_t y = 0; y < 256; ++y)
            for (int64_t x = 0; x < 256; ++x)
                sum += static_cast<long double>(inverse(x, y)) * inverse(x, y);
        EXPECT_NEAR(solution.noise_amplification, std::sqrt(static_cast<double>(sum)),
                    1e-9 * solution.noise_amplification);
    }
    EXPECT_NEAR(inverse_noise_amplification(IpcKernel::parametric(0)), 1, 1e-15);
}

} // namespace
} // namespace wfpsf
