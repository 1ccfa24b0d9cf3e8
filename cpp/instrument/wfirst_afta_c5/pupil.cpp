// SPDX-License-Identifier: GPL-3.0-or-later
// The pupil of the paper, fitted to the Cycle 5 mask for the long-wave bands, which serves all
// bands: one circular primary, one circular obscuration off its centre, six tapered struts.
//
// The 31 figures are fitted to two things at once: the mask's boundary pixels, and the complex
// focal field of the mask within about lambda/D of the axis, which decides sizes and shapes; of
// several weights between the two, the one with the smallest PSF error against the mask. The
// boundary alone leaves e off by up to 2.7e-5, because the mask's pixels, lit or unlit, carry that
// much of an ellipticity of their own; here it is below 1e-5, and the PSF's largest error against
// the mask's falls from 1.7e-5 to 5.9e-6 of the peak (the sum of all errors, 2e-4 of the light,
// stays). No edge moves by more than half a pixel of the mask.
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

constexpr double outer_x = 2048.48748, outer_y = 2046.86613; // as the mask counts
constexpr double outer_radius = 847.74080;

// All that follows is relative to the outer circle's centre.
constexpr double obscuration_x = -35.00588, obscuration_y = 1.53997;
constexpr double obscuration_radius = 288.03055;
constexpr double corner_radius = 18.23520;

// Edge of a strut: azimuth of the normal that points into the light, and the edge's distance from
// the centre along it.
struct Edge {
    double normal_deg, d;
};
constexpr struct {
    Edge clockwise, counterclockwise;
} segments[] = {
    // clang-format off
    {{108.54251, -129.96353}, {-51.70423, -171.89658}},
    {{131.72966, 200.64207}, {42.96421, 172.56876}},
    {{-134.23576, -147.98849}, {69.31071, -158.78299}},
    {{-108.86732, 185.12451}, {166.80082, 208.26390}},
    {{-9.74772, -188.45726}, {-170.94658, -121.99587}},
    {{15.19118, 137.49898}, {-76.40539, 157.18560}},
    // clang-format on
};

constexpr double fit_error = 5.9e-6;

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
