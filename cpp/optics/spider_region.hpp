// SPDX-License-Identifier: GPL-3.0-or-later
// The lit area of an obscured disc behind struts, ready to be cut into cells.
#pragma once

#include "instrument/pupil.hpp"
#include "optics/lit_region.hpp"

namespace wfpsf {

// In metres from the optical axis.
LitRegion lit_region(const SpiderPupil &pupil);

} // namespace wfpsf
