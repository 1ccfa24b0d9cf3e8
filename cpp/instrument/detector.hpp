// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of the detectors beyond the instrument's constants.
#pragma once

#include "instrument/instrument.hpp"

#include <span>

namespace wfpsf {

struct DetectorFigures {
    std::span<const double> persistence_linear; // share of the latest exposure, of that before, ...
    std::span<const double> persistence_fermi;  // A, x0, dx, a, r, half_well; empty: none
    bool
        rounds_first; // negative pixels are set to 0 and all are rounded before reciprocity failure
};

DetectorFigures detector_figures(const Instrument &instrument);

} // namespace wfpsf
