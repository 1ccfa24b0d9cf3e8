// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/leja.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace wfpsf {
namespace {

// By its coefficients.
double value(const LejaPolynomials &polynomials, size_t k, double u, double v) {
    const auto along_u = chebyshev(u, polynomials.degree());
    const auto along_v = chebyshev(v, polynomials.degree());
    double sum = 0;
    size_t ij = 0;
    for (int degree = 0; degree <= polynomials.degree(); ++degree)
        for (int j = 0; j <= degree; ++j)
            sum += polynomials.coefficient(k, ij++) * along_u[static_cast<size_t>(degree - j)] *
                   along_v[static_cast<size_t>(j)];
    return sum;
}

LejaPolynomials of_degree(int degree) {
    LejaPolynomials polynomials;
    while (polynomials.degree() < degree)
        polynomials.raise();
    return polynomials;
}

TEST(LejaPolynomials, EachIsOneAtItsPlaceAndZeroAtThoseBefore) {
    const LejaPolynomials all = of_degree(largest_chebyshev_degree);
    for (size_t k = 0; k < LejaPolynomials::count(largest_chebyshev_degree); ++k)
        for (size_t other = 0; other < LejaPolynomials::count(largest_chebyshev_degree); ++other) {
            const double here = all.at_place_of(k, other);
            if (other <= k) {
                ASSERT_NEAR(here, other == k ? 1 : 0, 1e-12);
            }
            ASSERT_NEAR(value(all, k, all.u(other), all.v(other)), here, 1e-10);
            ASSERT_LE(std::abs(here), 3.5);
        }
}

// A smooth function through its values at ever more places: what those of the next degree have
// that the polynomials do not tell is about what they err by anywhere.
TEST(LejaPolynomials, NextDegreeTellsTheError) {
    const auto function = [](double u, double v) {
        return std::sin(1.3 * u + 0.8 * v + 0.4) * std::exp(0.5 * u * v);
    };
    LejaPolynomials polynomials;
    std::vector<double> part{function(0, 0)};
    for (int degree = 1; degree <= largest_chebyshev_degree; ++degree) {
        double error = 0;
        for (int i = 0; i <= 40; ++i)
            for (int j = 0; j <= 40; ++j) {
                const double u = i / 20.0 - 1, v = j / 20.0 - 1;
                double sum = 0;
                for (size_t k = 0; k < part.size(); ++k)
                    sum += part[k] * value(polynomials, k, u, v);
                error = std::max(error, std::abs(sum - function(u, v)));
            }
        polynomials.raise();
        double told = 0;
        for (size_t k = part.size(); k < LejaPolynomials::count(degree); ++k) {
            double rest = function(polynomials.u(k), polynomials.v(k));
            for (size_t before = 0; before < k; ++before)
                rest -= part[before] * polynomials.at_place_of(before, k);
            part.push_back(rest);
            told = std::max(told, std::abs(rest));
        }
        constexpr double rounding = 1e-13;
        EXPECT_LE(error, 4 * told + rounding) << degree;
        EXPECT_GE(error, 0.3 * told - rounding) << degree;
        if (degree == 12) {
            EXPECT_LE(error, 2e-7);
        }
    }
}

} // namespace
} // namespace wfpsf
