// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/quadrature.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace wfpsf {
namespace {

double integral_of_wave(int n, double K) {
    const GaussLegendre rule(n);
    double sum = 0;
    for (size_t i = 0; i < rule.x.size(); ++i)
        sum += rule.w[i] * std::cos(K * rule.x[i]);
    return sum;
}

TEST(GaussLegendre, IsExactUpToDegreeTwoNMinusOne) {
    for (const int n : {1, 2, 5, 16, 33, 100}) {
        const GaussLegendre rule(n);
        for (int degree = 0; degree < 2 * n; ++degree) {
            double sum = 0;
            for (size_t i = 0; i < rule.x.size(); ++i)
                sum += rule.w[i] * std::pow(rule.x[i], degree);
            EXPECT_NEAR(sum, degree % 2 ? 0 : 2.0 / (degree + 1), 1e-13) << n << ' ' << degree;
        }
    }
}

TEST(GaussLegendre, WeightsAddUpToTheInterval) {
    for (int n = 1; n <= 300; ++n) {
        const GaussLegendre rule(n);
        EXPECT_NEAR(double(std::accumulate(rule.w.begin(), rule.w.end(), 0.0L) - 2), 0, 2e-15) << n;
    }
}

TEST(GaussLegendre, PointsForAWaveMeetTheToleranceWithoutWaste) {
    for (const double K : {0.01, 1.0, 7.0, 35.0, 120.0, 900.0})
        for (double eps = 1e-2; eps > 1e-13; eps /= 10) {
            const int n = gauss_legendre_points(K, eps);
            const double exact = 2 * std::sin(K) / K;
            EXPECT_LE(std::abs(integral_of_wave(n, K) - exact), 3 * eps) << K << ' ' << eps;
            EXPECT_LE(n, 0.5 * K + 4 + 3.2 * std::cbrt(K + 1) * std::pow(-std::log10(eps), 2. / 3))
                << K << ' ' << eps;
        }
}

} // namespace
} // namespace wfpsf
