// SPDX-License-Identifier: GPL-3.0-or-later
// The curved edges of a pupil seen from far off the core: each oval that they lie on sends light
// from the two points where its normal points along the direction, by the method of stationary
// phase, with Fresnel's integrals where the edges end.
#pragma once

#include "optics/far_spikes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace wfpsf {

// Angles about a circle: 0..4 along a square that stands on its corner, quick to find.
[[gnu::always_inline]] inline double diamond(double x, double y) {
    const double p = y / (std::abs(x) + std::abs(y));
    return x < 0 ? 2 - p : y < 0 ? 4 + p : p;
}

// Where a table by direction and by sqrt(nearest / r) is read.
struct RimTable {
    static constexpr int directions = 1440, distances = 48;
    static constexpr ptrdiff_t columns = distances + 1;
    static constexpr size_t size = static_cast<size_t>(directions + 1) * columns;

    struct Vector {
        double x, y;
    };
    static Vector direction(int i); // of length one
    static double distance(int j, double nearest) {
        return nearest * std::pow(static_cast<double>(distances) / j, 2);
    }
    static size_t entry(int i, int j) { return static_cast<size_t>(i * columns + j); }
    // The direction and distance that bound the first row and column alike.
    static void close(std::vector<float> &table);

    struct Place {
        int32_t row, column;
        double s, t; // from there to the next ones
        [[gnu::always_inline]] double of(const float *table) const {
            const float *entry = table + row * columns + column;
            const double low = entry[0] + t * (entry[1] - entry[0]);
            entry += columns;
            const double high = entry[0] + t * (entry[1] - entry[0]);
            return low + s * (high - low);
        }
    };
    [[gnu::always_inline]] static double row_of(double x, double y) {
        return std::min(diamond(x, y) * (directions / 4.0), directions - 1e-6);
    }
    [[gnu::always_inline]] static double column_of(double nearest_over_r) {
        return std::min(std::sqrt(nearest_over_r) * distances, distances - 1e-6);
    }
    [[gnu::always_inline]] static Place place(double row, double column) {
        const auto j = static_cast<int32_t>(row), c = static_cast<int32_t>(column);
        return {j, c, row - j, column - c};
    }
};

// From the farthest on.
using Distances = std::array<double, RimTable::distances>;

// How much of what Fresnel's integral has from where an edge ends, x from the point, is a corner's
// light by itself.
[[gnu::always_inline]] inline double corner_share(double x) {
    constexpr double none = 2, whole = 5;
    const double s = std::clamp((x - none) / (whole - none), 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

// Some pixels: positions and distances from the star, native pixels.
struct PixelBlock {
    static constexpr size_t most = 32, lanes = 8;
    using Values = std::array<double, most>;
    size_t size; // a multiple of the lanes, so that loops are vector instructions alone
    Values x, y, r;
};

// What a point sends there.
struct AmplitudeBlock {
    PixelBlock::Values re, im, waves;
};

// One of an oval's two points, in front (towards the direction) or behind. Its amplitude is
// exp(2 pi i (k place + waves)) / k^(3/2) times the table's, the light per unit of solid angle that
// squared over (2 pi)^2; k = r / wavelength, in cycles per metre.
struct RimPoint {
    RimPoint() = default; // none
    RimPoint(const Oval &of, double on_side, double nearest_pixel)
        : oval(of), side(on_side), nearest(nearest_pixel), re(RimTable::size), im(RimTable::size),
          waves(RimTable::directions + 1) {}

    Oval oval{};
    double side = 0;           // +1: in front, -1: behind
    double nearest = 0;        // native pixels, of the tables
    std::vector<float> re, im; // by direction and distance
    std::vector<double> waves; // wavefront there by direction, at the mean wavelength
    // The one straight edge that it makes fringes with; none: all of them.
    std::optional<size_t> edge = {};

    RimTable::Vector position(double ux, double uy) const; // m
    // Along (x, y), times its length.
    [[gnu::always_inline]] double place(double x, double y) const {
        const double a = oval.half_width * x + oval.shear * y, b = oval.half_height * y;
        return oval.x * x + oval.y * y + side * std::sqrt(a * a + b * b);
    }
    [[gnu::always_inline]] void amplitudes(const PixelBlock &at, AmplitudeBlock &out) const {
        PixelBlock::Values row, column;
        for (size_t i = 0; i < at.size; ++i) {
            row[i] = RimTable::row_of(at.x[i], at.y[i]);
            column[i] = RimTable::column_of(nearest / at.r[i]);
        }
        for (size_t i = 0; i < at.size; ++i) {
            const auto place = RimTable::place(row[i], column[i]);
            const double *wave = waves.data() + place.row;
            out.re[i] = place.of(re.data());
            out.im[i] = place.of(im.data());
            out.waves[i] = wave[0] + place.s * (wave[1] - wave[0]);
        }
    }
    // Of all amplitudes at the distance r, up to `reach` aside from the direction.
    double most(double ux, double uy, double r, double reach) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.oval, self.side, self.nearest, self.re, self.im, self.waves, self.edge);
    }
};

// In pairs, the one in front first.
struct RimPoints {
    std::vector<RimPoint> own;
    std::vector<RimPoint> with_edges; // and what edges send that turn off from arcs' ends near by
};
RimPoints rim_points(const FarSource &source, const PupilEdges &edges);
// Of the ovals of those curved edges, but without them, for one straight edge.
std::vector<RimPoint> rim_points_without(const std::vector<size_t> &curved, size_t straight,
                                         const FarSource &source, const PupilEdges &edges);

} // namespace wfpsf
