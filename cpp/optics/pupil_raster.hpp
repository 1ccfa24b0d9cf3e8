// SPDX-License-Identifier: GPL-3.0-or-later
// A pupil given as geometry, drawn on square pixels: each one's value is the lit fraction of its
// area, in closed form. Shares no code with the quadrature nodes, so that the two check each other.
#pragma once

#include "image/view.hpp"
#include "instrument/pupil.hpp"
#include "optics/lit_region.hpp"

#include <vector>

namespace wfpsf {

// Inside all of `inside`, outside all of `outside`.
struct DarkShape {
    std::vector<Bound> inside, outside;
};

// Inside all of `lit`, one of them an oval at least, outside every dark shape.
struct LitPart {
    std::vector<Bound> lit;
    std::vector<DarkShape> dark;
};

// Parts that do not overlap.
std::vector<LitPart> lit_parts(const SegmentedPupil &pupil);
std::vector<LitPart> lit_parts(const AnnularPupil &pupil);
std::vector<LitPart> lit_parts(const LitRegion &region);

// Square pixels of `scale` metres; pixel position (axis_x, axis_y) is the optical axis.
struct PupilRaster {
    Plane<double> lit; // 0..1
    // Of each pixel's lit part, pixels from the pixel's centre. Empty where the pixels are the
    // pupil itself, each with the phase of its centre, and no drawing of it.
    Plane<double> centroid_x = {}, centroid_y = {};
    double scale = 0, axis_x = 0, axis_y = 0;

    bool is_pupil() const { return centroid_x.nx() == 0; }
};

// The pupil fills the shorter side of nx by ny pixels and stands in their middle. The coverage of a
// pixel is good to 1e-8.
PupilRaster raster(const std::vector<LitPart> &parts, int64_t nx, int64_t ny);

} // namespace wfpsf
