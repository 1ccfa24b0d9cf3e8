// SPDX-License-Identifier: GPL-3.0-or-later
// The corners of a pupil: what edges send from where they end, far off their spikes' lines.
#pragma once

#include "optics/far_rims.hpp"
#include "optics/far_spikes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace wfpsf {

// Amplitudes as a RimPoint's.
struct Corner {
    // An edge that ends there.
    struct Piece {
        double nx, ny;   // outward normal
        double tx, ty;   // onto the edge
        double rounding; // times r: square of Fresnel's x at (tx, ty).u = 1; none of a straight one
    };
    double x, y;      // m
    double phase;     // wavefront there, waves at the mean wavelength
    double per_pixel; // k / r
    std::vector<Piece> pieces = {};
    std::vector<size_t> straight = {}; // straight edges that end there

    RimTable::Vector position(double, double) const { return {x, y}; }
    [[gnu::always_inline]] double place(double ux, double uy) const { return x * ux + y * uy; }
    [[gnu::always_inline]] RimPoint::Amplitude amplitude(double px, double py, double r) const {
        constexpr double least = 0.01; // nearer to a spike's line it is an edge's light
        double sum = 0;
        for (const Piece &piece : pieces) {
            const double t = (piece.tx * px + piece.ty * py) / r;
            const double share =
                piece.rounding > 0 ? corner_share(std::sqrt(piece.rounding * r) * std::abs(t)) : 1;
            sum += share * (piece.nx * px + piece.ny * py) / r * t / std::max(t * t, least);
        }
        return {0, sum / (2 * std::numbers::pi * std::sqrt(per_pixel * r)), phase};
    }
    double most(double ux, double uy, double r, double reach) const;
};

// Those where the outline turns.
std::vector<Corner> corners(const FarSource &source, const PupilEdges &edges);

} // namespace wfpsf
