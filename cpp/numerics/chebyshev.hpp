// SPDX-License-Identifier: GPL-3.0-or-later
// Chebyshev's polynomials, and polynomials through values at Chebyshev's points.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace wfpsf {

constexpr int largest_chebyshev_degree = 16;

// T_0(u), T_1(u), ... T_degree(u).
inline std::array<double, largest_chebyshev_degree + 1> chebyshev(double u, int degree) {
    std::array<double, largest_chebyshev_degree + 1> values{1, u};
    for (int k = 2; k <= degree; ++k) {
        const auto at = static_cast<size_t>(k);
        values[at] = 2 * u * values[at - 1] - values[at - 2];
    }
    return values;
}

// Chebyshev's extreme points: those of twice the degree hold those of the degree.
inline double chebyshev_node(int k, int degree) {
    return std::cos(std::numbers::pi * k / degree);
}

// From values at the extreme points (of degree 0: at 0) to the coefficients of the polynomials:
// [coefficient][node].
inline std::vector<std::vector<double>> chebyshev_coefficients(int degree) {
    if (degree == 0)
        return {{1.0}};
    const auto ends = [degree](int k) { return k == 0 || k == degree ? 0.5 : 1.0; };
    std::vector<std::vector<double>> matrix;
    for (int k = 0; k <= degree; ++k) {
        std::vector<double> &row = matrix.emplace_back();
        for (int j = 0; j <= degree; ++j)
            row.push_back(2.0 / degree * ends(k) * ends(j) *
                          std::cos(std::numbers::pi * j * k / degree));
    }
    return matrix;
}

} // namespace wfpsf
