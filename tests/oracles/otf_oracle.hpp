// SPDX-License-Identifier: GPL-3.0-or-later
// Optical transfer functions by quadrature over the overlap of a pupil with itself, one frequency
// at a time: exact to rounding, and slow.
#pragma once

#include "instrument/pupil.hpp"
#include "optics/lit_region.hpp"
#include "optics/roman_region.hpp"
#include "optics/wavefront.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace wfpsf::oracle {

using Regions = std::vector<LitRegion>; // that do not overlap

// The segments of a pupil whose corners are sharp.
inline Regions sharp_regions(const SegmentedPupil &pupil) {
    const auto disc = [](const Circle &c) { return Oval{c.x, c.y, c.radius, 0, c.radius}; };
    Regions regions;
    for (const PupilSegment &segment : pupil.segments) {
        const HalfPlane &a = segment.clockwise_edge, &b = segment.counterclockwise_edge;
        const double norm = std::hypot(a.nx + b.nx, a.ny + b.ny);
        const double nx = (a.nx + b.nx) / norm, ny = (a.ny + b.ny) / norm;
        regions.push_back({{disc(pupil.outer), a, b,
                            HalfPlane{nx, ny, nx * pupil.obscuration.x + ny * pupil.obscuration.y}},
                           {{disc(pupil.obscuration)}}});
    }
    return regions;
}

inline Bound moved(const Bound &bound, double x, double y) {
    if (const auto *h = std::get_if<HalfPlane>(&bound))
        return HalfPlane{h->nx, h->ny, h->d + h->nx * x + h->ny * y};
    Oval o = std::get<Oval>(bound);
    o.x += x;
    o.y += y;
    return o;
}

// Where both a and b, the latter moved, are lit.
inline LitRegion overlap(const LitRegion &a, const LitRegion &b, double x, double y) {
    LitRegion both = a;
    for (const Bound &bound : b.lit)
        both.lit.push_back(moved(bound, x, y));
    for (std::vector<Bound> shape : b.dark) {
        for (Bound &bound : shape)
            bound = moved(bound, x, y);
        both.dark.push_back(shape);
    }
    return both;
}

// Integral of f(u) conj f(u - shift), f = exp(2 pi i W) over the lit regions.
inline std::complex<double> autocorrelation(const Regions &regions, const Wavefront &wavefront,
                                            double x, double y) {
    std::complex<double> sum = 0;
    for (const LitRegion &a : regions)
        for (const LitRegion &b : regions) {
            const std::vector<Cell> cells = lit_cells(overlap(a, b, x, y));
            const PupilNodes nodes =
                pupil_nodes(cells, 2 * std::numbers::pi * 2 * wavefront.slope_bound() + 1, 1e-11);
            for (size_t i = 0; i < nodes.size(); ++i)
                sum += nodes.weight[i] *
                       std::polar(1.0, 2 * std::numbers::pi *
                                           (wavefront(nodes.x[i], nodes.y[i]) -
                                            wavefront(nodes.x[i] - x, nodes.y[i] - y)));
        }
    return sum;
}

} // namespace wfpsf::oracle
