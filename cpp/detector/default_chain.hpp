// SPDX-License-Identifier: GPL-3.0-or-later
// The chains of the instruments' own simulators.
#pragma once

#include "detector/chain.hpp"
#include "instrument/instrument.hpp"

namespace wfpsf {

// Poisson noise, reciprocity failure, rounding, dark current, persistence if the instrument has any
// (Fermi's model), nonlinearity, IPC, read noise, gain, rounding. roman-c9 clips negative pixels at
// the start and rounds before reciprocity failure. exposure_time in s.
Chain default_chain(const Instrument &instrument, double exposure_time);

} // namespace wfpsf
