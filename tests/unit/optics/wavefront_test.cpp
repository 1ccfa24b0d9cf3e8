// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "numerics/quadrature.hpp"
#include "optics/wavefront.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;

Wavefront single(int j, double radius = 1) {
    std::vector<double> coefficients(static_cast<size_t>(j));
    coefficients.back() = 1;
    return Wavefront(coefficients, radius);
}

// Noll 1976, Table 1.
TEST(Wavefront, FirstElevenAreNollsPolynomials) {
    const double r = 0.83, t = 0.71, r2 = r * r, r3 = r2 * r, r4 = r2 * r2;
    const double expected[] = {1,
                               2 * r * std::cos(t),
                               2 * r * std::sin(t),
                               std::sqrt(3.) * (2 * r2 - 1),
                               std::sqrt(6.) * r2 * std::sin(2 * t),
                               std::sqrt(6.) * r2 * std::cos(2 * t),
                               std::sqrt(8.) * (3 * r3 - 2 * r) * std::sin(t),
                               std::sqrt(8.) * (3 * r3 - 2 * r) * std::cos(t),
                               std::sqrt(8.) * r3 * std::sin(3 * t),
                               std::sqrt(8.) * r3 * std::cos(3 * t),
                               std::sqrt(5.) * (6 * r4 - 6 * r2 + 1)};
    for (int j = 1; j <= 11; ++j)
        EXPECT_NEAR(single(j)(r * std::cos(t), r * std::sin(t)), expected[j - 1], 1e-14) << j;
}

TEST(Wavefront, PolynomialsAreOrthonormalOverTheCircle) {
    const GaussLegendre rule(40);
    const int spokes = 90;
    for (int a = 1; a <= 66; a += 5)
        for (int b = 1; b <= 66; b += 3) {
            const Wavefront za = single(a), zb = single(b);
            double sum = 0;
            for (size_t i = 0; i < rule.x.size(); ++i) {
                const double r = (1 + rule.x[i]) / 2;
                for (int k = 0; k < spokes; ++k) {
                    const double x = r * std::cos(2 * pi * k / spokes);
                    const double y = r * std::sin(2 * pi * k / spokes);
                    sum += rule.w[i] / 2 * r * 2 / spokes * za(x, y) * zb(x, y);
                }
            }
            EXPECT_NEAR(sum, a == b, 1e-11) << a << ' ' << b;
        }
}

TEST(Wavefront, SlopeBoundHolds) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<double> coefficients(22);
        for (double &a : coefficients)
            a = normal(random);
        const double radius = 1.18, h = 1e-6;
        const Wavefront w(coefficients, radius);
        double steepest = 0;
        for (int i = 0; i <= 20; ++i)
            for (int k = 0; k < 60; ++k) {
                const double r = radius * i / 20 * (1 - 2 * h), t = 2 * pi * k / 60;
                const double x = r * std::cos(t), y = r * std::sin(t);
                steepest = std::max(
                    steepest,
                    std::hypot(w(x + h, y) - w(x - h, y), w(x, y + h) - w(x, y - h)) / (2 * h));
            }
        EXPECT_LE(steepest, w.slope_bound());
    }
}

TEST(Wavefront, ManyPointsGiveTheSameAsEachByItself) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<double> coefficients(231);
    for (double &a : coefficients)
        a = normal(random);
    const Wavefront w(coefficients, 1.18);
    for (const size_t count : {0, 1, 31, 32, 33, 100}) {
        std::vector<double> x(count), y(count), waves(count);
        for (size_t i = 0; i < count; ++i) {
            const double r = 1.18 * static_cast<double>(i) / static_cast<double>(count);
            x[i] = r * std::cos(static_cast<double>(i));
            y[i] = r * std::sin(static_cast<double>(i));
        }
        w.evaluate(x, y, waves.data());
        for (size_t i = 0; i < count; ++i)
            EXPECT_NEAR(waves[i], w(x[i], y[i]), 1e-9) << count << ' ' << i;
    }
}

TEST(Wavefront, BadCoefficientsAreRefused) {
    EXPECT_THROW(Wavefront(std::vector<double>(232), 1), Error);
    EXPECT_THROW(Wavefront(std::vector<double>{0, std::nan("")}, 1), Error);
    EXPECT_NO_THROW(single(231));
}

} // namespace
} // namespace wfpsf
