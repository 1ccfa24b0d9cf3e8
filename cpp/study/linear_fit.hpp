// SPDX-License-Identifier: GPL-3.0-or-later
// Linear laws on a square grid of two parameters, as the paper fits them (sections 5.2 and 5.3).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace wfpsf {

inline constexpr size_t grid_side = 11; // the paper's

// The i-th of grid_side values from -half to half, exactly symmetric.
inline double grid_value(size_t i, double half) {
    return half * (static_cast<double>(i) - 5) / 5;
}

// A smooth function on the square grid from its values at 7 x 7 of the points: the polynomial of
// the fourth degree in each parameter that meets them. Column and row of the k-th: grid_nodes[k].
inline constexpr std::array<size_t, 7> grid_nodes{0, 1, 3, 5, 7, 9, 10}; // about Chebyshev's
using GridNodes = std::array<std::array<double, 7>, 7>;                  // [row][column]

inline double interpolate_grid(const GridNodes &values, size_t i, size_t j) {
    const auto weight = [](size_t k, size_t at) {
        double product = 1;
        for (const size_t other : grid_nodes)
            if (other != grid_nodes[k])
                product *= (static_cast<double>(at) - static_cast<double>(other)) /
                           (static_cast<double>(grid_nodes[k]) - static_cast<double>(other));
        return product;
    };
    double sum = 0;
    for (size_t row = 0; row < grid_nodes.size(); ++row)
        for (size_t column = 0; column < grid_nodes.size(); ++column)
            sum += weight(row, j) * weight(column, i) * values[row][column];
    return sum;
}

struct GridPoint {
    double a, b, value; // parameters, and the change from where both are 0
};

// Least squares of value = A a + B b.
inline std::array<double, 2> fit_linear(const std::vector<GridPoint> &points) {
    double aa = 0, ab = 0, bb = 0, va = 0, vb = 0;
    for (const GridPoint &p : points) {
        aa += p.a * p.a;
        ab += p.a * p.b;
        bb += p.b * p.b;
        va += p.value * p.a;
        vb += p.value * p.b;
    }
    const double det = aa * bb - ab * ab;
    return {(va * bb - vb * ab) / det, (vb * aa - va * ab) / det};
}

inline double largest_change(const std::vector<GridPoint> &points) {
    double most = 0;
    for (const GridPoint &p : points)
        most = std::max(most, std::abs(p.value));
    return most;
}

// Of value = A a + B b.
inline double largest_error(const std::vector<GridPoint> &points,
                            const std::array<double, 2> &slopes) {
    double most = 0;
    for (const GridPoint &p : points)
        most = std::max(most, std::abs(slopes[0] * p.a + slopes[1] * p.b - p.value));
    return most;
}

} // namespace wfpsf
