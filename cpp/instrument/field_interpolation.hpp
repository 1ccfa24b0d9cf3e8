// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront errors between the field points of a detector.
#pragma once

#include "instrument/instrument.hpp"

#include <vector>

namespace wfpsf {

// Five points must be apart enough for both rules: about the centre, one towards each corner of the
// detector. WFPSF_ERROR_ARGUMENT if they are not.
void check_field_points(std::span<const FieldPoint> points);

// The Zernike coefficients at a position of a detector, from one field point (then they are the
// same everywhere) or from five, the centre first.
std::vector<double> interpolate_field(std::span<const FieldPoint> points, double x_pix,
                                      double y_pix, FieldRule rule);

} // namespace wfpsf
