// SPDX-License-Identifier: GPL-3.0-or-later
// The pupil of the paper, fitted to the Cycle 5 mask for the long-wave bands, which serves all
// bands: one circular primary, one circular obscuration off its centre, six tapered struts.
#include "instrument/wfirst_afta_c5/tables.hpp"

#include <cmath>
#include <numbers>

namespace wfpsf::wfirst_afta_c5 {
namespace {

// Lengths in pixels of the mask. The optical axis goes through the centre of pixel (2048, 2048),
// counted from 0: column, then row upwards. The mask carries no scale; as in GalSim 1.3.0, the lit
// pixel farthest from the axis stands at half the primary's diameter.
constexpr double axis_pix = 2048;
constexpr double metres_per_pixel = 1.18 / 849.0400461697905;

constexpr double outer_x = 2048.49085, outer_y = 2046.86994; // as the mask counts
constexpr double outer_radius = 847.74393;

// All that follows is relative to the outer circle's centre.
constexpr double obscuration_x = -35.00155, obscuration_y = 1.55058;
constexpr double obscuration_radius = 288.03483;
constexpr double corner_radius = 18.24378;

// Edge of a strut: azimuth of the normal that points into the light, and the edge's distance from
// the centre along it.
struct Edge {
    double normal_deg, d;
};
constexpr struct {
    Edge clockwise, counterclockwise;
} segments[] = {
    // clang-format off
    {{108.54800, -130.04089}, {-51.70706, -171.92231}},
    {{131.72906, 200.64708}, {42.96843, 172.57891}},
    {{-134.22647, -148.05416}, {69.30766, -158.81731}},
    {{-108.86264, 185.08814}, {166.79396, 208.23685}},
    {{-9.76444, -188.32759}, {-170.92778, -121.85152}},
    {{15.19772, 137.46742}, {-76.42050, 157.07732}},
    // clang-format on
};

constexpr double fit_error = 1.7e-5;

Circle circle(double x, double y, double radius) {
    return {x * metres_per_pixel, y * metres_per_pixel, radius * metres_per_pixel};
}

HalfPlane half_plane(const Edge &edge) {
    const double azimuth = edge.normal_deg * std::numbers::pi / 180;
    const double nx = std::cos(azimuth), ny = std::sin(azimuth);
    const double d = edge.d + nx * (outer_x - axis_pix) + ny * (outer_y - axis_pix);
    return {nx, ny, d * metres_per_pixel};
}

} // namespace

SegmentedPupil pupil() {
    const double x = outer_x - axis_pix, y = outer_y - axis_pix;
    SegmentedPupil pupil{.outer = circle(x, y, outer_radius),
                         .obscuration =
                             circle(x + obscuration_x, y + obscuration_y, obscuration_radius),
                         .corner_radius = corner_radius * metres_per_pixel,
                         .segments = {},
                         .fit_error = fit_error};
    for (size_t i = 0; i < pupil.segments.size(); ++i)
        pupil.segments[i] = {half_plane(segments[i].clockwise),
                             half_plane(segments[i].counterclockwise)};
    return pupil;
}

} // namespace wfpsf::wfirst_afta_c5
