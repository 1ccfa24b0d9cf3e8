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
