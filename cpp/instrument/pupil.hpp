// SPDX-License-Identifier: GPL-3.0-or-later
// The pupil as geometry: metres from the optical axis, y up.
#pragma once

#include <array>

namespace wfpsf {

struct Circle {
    double x, y, radius;
};

// Lit where nx x + ny y >= d; (nx, ny) is a unit vector.
struct HalfPlane {
    double nx, ny, d;
};

// The light between two struts: inside the outer circle, outside the obscuration, on the lit side
// of both edges, and on that side of the obscuration's centre where the sum of the edges' normals
// points to. (The edges are not radial: some pairs let light through on the far side as well.)
struct PupilSegment {
    HalfPlane clockwise_edge, counterclockwise_edge;
};

// Primary mirror behind a secondary on six struts. Each of the 24 corners is rounded: a circle of
// corner_radius inside the lit segment touches the strut's edge and the arc.
struct SegmentedPupil {
    Circle outer, obscuration;
    double corner_radius;
    std::array<PupilSegment, 6> segments; // counterclockwise
    // Largest error of the unaberrated PSF against the mask that the geometry was fitted to, as a
    // fraction of the PSF's peak.
    double fit_error;
};

// No struts: an annulus about the optical axis.
struct AnnularPupil {
    double outer_radius, inner_radius;
};

} // namespace wfpsf
