// SPDX-License-Identifier: GPL-3.0-or-later
// Chebyshev's polynomials and their extreme points.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

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

} // namespace wfpsf
