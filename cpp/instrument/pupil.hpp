// SPDX-License-Identifier: GPL-3.0-or-later
// The pupil as geometry: metres from the optical axis, y up.
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

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

// (1 - p) dx^2 - 2 q dx dy + (1 + p) dy^2 <= radius^2, with (dx, dy) from the centre (x, y).
struct Ellipse {
    double x, y, radius, p, q;
};

// A dark bar: |nx X + ny Y - offset| <= width / 2, without end on the side that (-ny, nx) points to
// from the origin, absent on the other. (nx, ny) is a unit vector.
struct Strut {
    double nx, ny, offset, width;
};

// What the masks in the instrument's exit pupil add, by wavelength. Long: lit inside `outer`, dark
// inside `inner`. Short: dark inside two nearly concentric discs; the lower one is larger
// (`enlarged_radius`) between telescope struts 1 and 2, 3 and 4, 5 and 0.
struct LongWaveMask {
    Ellipse outer, inner;
};
struct ShortWaveMask {
    Circle upper, lower;
    double enlarged_radius;
};

struct ClipSquare {
    double low, high; // of x and of y alike, metres
};

// A pupil of Roman, as one detector sees it: the primary mirror, less what lies outside the
// vignetting edge, less the struts of the telescope and those of the mask, less the mask's own
// shapes. `primary` and `clip` are in metres from the optical axis. All other shapes are in
// normalised coordinates X: the map x = c + S X, S symmetric, makes `primary` of the unit disc.
struct RomanPupil {
    Ellipse primary;
    Ellipse vignetting;                                 // lit inside
    std::array<Strut, 6> telescope_struts, mask_struts; // counterclockwise from azimuth -119 deg
    std::variant<ShortWaveMask, LongWaveMask> mask;
    // The published masks are cut off where their images ended; the telescope is not.
    std::optional<ClipSquare> clip;
    double fit_error; // as in SegmentedPupil
};

// A circular primary about the optical axis, behind a circular obscuration and any number of
// struts.
struct SpiderPupil {
    double outer_radius, inner_radius; // the obscuration's may be 0
    std::vector<Strut> struts;
};

using Pupil = std::variant<SegmentedPupil, RomanPupil, SpiderPupil>;

// No struts: an annulus about the optical axis.
struct AnnularPupil {
    double outer_radius, inner_radius;
};

} // namespace wfpsf
