// SPDX-License-Identifier: GPL-3.0-or-later
// Splines against the waves that they were made from.
#include "numerics/cubic_spline.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace wfpsf {
namespace {

double wave(double frequency, double x, double y) {
    return std::cos(2 * std::numbers::pi * frequency * x + 1) *
           std::sin(2 * std::numbers::pi * frequency * y + 2);
}

double spline_at(const Plane<float> &coefficients, double x, double y) {
    const auto i = static_cast<int64_t>(x), j = static_cast<int64_t>(y);
    const auto wx = spline_weights(x - static_cast<double>(i));
    const auto wy = spline_weights(y - static_cast<double>(j));
    double sum = 0;
    for (int64_t v = 0; v < 4; ++v)
        for (int64_t u = 0; u < 4; ++u)
            sum += wx[static_cast<size_t>(u)] * wy[static_cast<size_t>(v)] *
                   static_cast<double>(coefficients(i - 1 + u, j - 1 + v));
    return sum;
}

TEST(CubicSpline, GoesThroughItsSamplesAndIsAWaveBetween) {
    constexpr int64_t nx = 90, ny = 80;
    for (const double frequency : {0.02, 0.1, 0.2}) {
        Plane<float> plane(nx, ny);
        for (int64_t y = 0; y < ny; ++y)
            for (int64_t x = 0; x < nx; ++x)
                plane(x, y) = static_cast<float>(
                    wave(frequency, static_cast<double>(x), static_cast<double>(y)));
        to_spline_coefficients(plane);
        double at_samples = 0, between = 0;
        for (int64_t k = 0; k < 50; ++k) {
            // Away from the borders, beyond which the wave is mirrored.
            const double x = 20 + static_cast<double>(k), y = 70 - static_cast<double>(k);
            at_samples =
                std::max(at_samples, std::abs(spline_at(plane, x, y) - wave(frequency, x, y)));
            between = std::max(between, std::abs(spline_at(plane, x + 0.5, y + 0.3) -
                                                 wave(frequency, x + 0.5, y + 0.3)));
        }
        EXPECT_LE(at_samples, 2e-6);
        EXPECT_LE(between, 2 * 5 * std::pow(frequency, 4) + 2e-6) << frequency; // both axes
    }
}

TEST(CubicSpline, GivesItsSamplesBackAndIsTheSameWhenRefined) {
    constexpr int64_t nx = 90, ny = 81;
    Plane<float> plane(nx, ny);
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x)
            plane(x, y) = static_cast<float>((x * 7 + y * 13) % 11);
    const Plane<float> samples = plane;
    to_spline_coefficients(plane);
    const Plane<float> fine = refined_spline(plane);
    ASSERT_EQ(fine.nx(), 2 * nx - 1);
    ASSERT_EQ(fine.ny(), 2 * ny - 1);
    for (int64_t k = 0; k < 50; ++k) {
        const double x = 2.3 + 1.67 * static_cast<double>(k), y = 2.8 + static_cast<double>(k);
        EXPECT_NEAR(spline_at(fine, 2 * x, 2 * y), spline_at(plane, x, y), 3e-5);
    }
    to_spline_samples(plane);
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x)
            ASSERT_NEAR(plane(x, y), samples(x, y), 3e-5);
}

} // namespace
} // namespace wfpsf
