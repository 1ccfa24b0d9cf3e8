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
    [[gnu::always_inline]] void amplitudes(const PixelBlock &at, AmplitudeBlock &out) const {
        out.re.fill(0);
        out.im.fill(0);
        out.waves.fill(phase);
        for (const Piece &piece : pieces)
            add(piece, at, out.im);
        for (size_t i = 0; i < at.size; ++i)
            out.im[i] /= 2 * std::numbers::pi * std::sqrt(per_pixel * at.r[i]);
    }
    double most(double ux, double uy, double r, double reach) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.x, self.y, self.phase, self.per_pixel, self.pieces, self.straight);
    }

  private:
    [[gnu::always_inline]] static void add(const Piece &piece, const PixelBlock &at,
                                           PixelBlock::Values &sum) {
        constexpr double least = 0.01; // nearer to a spike's line it is an edge's light
        const auto [nx, ny, tx, ty, rounding] = piece;
        PixelBlock::Values share;
        share.fill(1);
        if (rounding > 0)
            for (size_t i = 0; i < at.size; ++i)
                share[i] = corner_share(std::abs(tx * at.x[i] + ty * at.y[i]) *
                                        std::sqrt(rounding / at.r[i]));
        for (size_t i = 0; i < at.size; ++i) {
            const double n = nx * at.x[i] + ny * at.y[i], t = tx * at.x[i] + ty * at.y[i];
            sum[i] += share[i] * n * t / std::max(t * t, least * at.r[i] * at.r[i]);
        }
    }
};

// Those where the outline turns.
std::vector<Corner> corners(const FarSource &source, const PupilEdges &edges);

} // namespace wfpsf
