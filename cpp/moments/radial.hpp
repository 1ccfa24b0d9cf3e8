// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes from sums over pixels sorted by their distance from a point. Fast and rough: encircled.hpp
// has the exact radius of a band-limited image.
#pragma once

#include "image/view.hpp"

#include <optional>

namespace wfpsf {

// Radius of the smallest circle around (x, y) that holds at least `fraction` of `total` (default:
// of the sum of all pixels), each pixel counted at its centre: Kannawadi et al. 2016, Eq. 25.
template <class T>
double enclosing_radius(View<const T> image, double x, double y, double fraction = 0.5,
                        std::optional<double> total = {});

// The same with the enclosed flux interpolated linearly in r^2 between two pixels, as GalSim's
// Image.calculateHLR does.
template <class T>
double half_light_radius(View<const T> image, double x, double y, double fraction = 0.5,
                         std::optional<double> total = {});

// Twice the radius at which a pixel first falls below half of the largest pixel, interpolated
// linearly in r^2 between means of pixels at equal distance, as GalSim's Image.calculateFWHM does.
// Meant for a centre on the peak.
template <class T> double full_width_half_maximum(View<const T> image, double x, double y);

// All throw Error: SIZE_NOT_REACHED if the image has no such radius, MOMENTS_FLUX if no pixel is
// positive where a maximum is needed, NOT_FINITE on a pixel that is not finite, RANGE on a fraction
// outside (0, 1] or a total that is not positive. Pixels at equal distance are taken row by row.

} // namespace wfpsf
