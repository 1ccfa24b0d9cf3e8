// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature over the lit area of Roman's pupils.
#pragma once

#include "instrument/pupil.hpp"
#include "optics/lit_region.hpp"
#include "optics/pupil_nodes.hpp"

namespace wfpsf {

// In metres from the optical axis.
LitRegion lit_region(const RomanPupil &pupil);

// The primary's larger extent along x or y, metres: nothing lit reaches beyond.
double extent(const RomanPupil &pupil);

// Nodes that integrate functions oscillating with up to `wavenumber` radians per metre to about
// `eps` of the lit area. The lit region's cells take as long to find as the nodes: who needs
// several sets of nodes keeps lit_cells(lit_region(pupil)).
PupilNodes pupil_nodes(const RomanPupil &pupil, double wavenumber, double eps);

} // namespace wfpsf
