// SPDX-License-Identifier: GPL-3.0-or-later
// The lit area of Roman's pupils, ready to be cut into cells and those into quadrature nodes.
#pragma once

#include "instrument/pupil.hpp"
#include "optics/lit_region.hpp"

namespace wfpsf {

// In metres from the optical axis.
LitRegion lit_region(const RomanPupil &pupil);

// The primary's larger extent along x or y, metres: nothing lit reaches beyond.
double extent(const RomanPupil &pupil);

} // namespace wfpsf
