// SPDX-License-Identifier: GPL-3.0-or-later
// The lit part of a plane bounded by ellipses and straight lines, and quadrature over it: cut into
// cells with one smooth curve below and one above, on which Gauss-Legendre nodes converge
// exponentially.
#pragma once

#include "instrument/pupil.hpp"
#include "optics/pupil_nodes.hpp"

#include <array>
#include <cstddef>
#include <variant>
#include <vector>

namespace wfpsf {

// An ellipse's inside, as the image of the unit disc:
// x = x0 + half_width u, y = y0 + shear u + half_height v, u^2 + v^2 <= 1.
struct Oval {
    double x, y, half_width, shear, half_height;
    bool operator==(const Oval &) const = default;
};

// A convex set is the intersection of such bounds. A HalfPlane is its side nx x + ny y >= d.
using Bound = std::variant<Oval, HalfPlane>;

// Inside all of `lit`, one of them an oval at least, outside every intersection in `dark`.
struct LitRegion {
    std::vector<Bound> lit;
    std::vector<std::vector<Bound>> dark;
};

// The points x0 <= x <= x1, lower(x) <= y <= upper(x).
struct Cell {
    struct Curve {
        Bound bound;
        bool upper_half;           // of an oval
        double at(double x) const; // y
    };
    double x0, x1;
    Curve lower, upper;
};

// What bounds a strut: its two long sides, and the line through the origin where it begins.
std::array<HalfPlane, 3> sides(const Strut &strut);

std::vector<Cell> lit_cells(const LitRegion &region);

// Nodes that integrate functions oscillating with up to `wavenumber` radians per unit of length to
// about `eps` of the cells' area.
void pupil_nodes(const std::vector<Cell> &cells, double wavenumber, double eps,
                 const NodeSink &sink);

Box bounds(const std::vector<Cell> &cells);

} // namespace wfpsf
