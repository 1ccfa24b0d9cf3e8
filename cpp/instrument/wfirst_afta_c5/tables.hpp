// SPDX-License-Identifier: GPL-3.0-or-later
// WFIRST-AFTA, Cycle 5 (2015): the configuration of Kannawadi et al. 2016. One table a file.
#pragma once

#include "instrument/detector.hpp"
#include "instrument/instrument.hpp"
#include "instrument/sky.hpp"

namespace wfpsf::wfirst_afta_c5 {

Instrument instrument();

std::span<const Constant> constants();
std::span<const Band> bands();
std::span<const FieldPoint> field_points();
std::span<const SkyCurve> sky();
DetectorFigures detector();
WcsTables wcs();
SegmentedPupil pupil();

} // namespace wfpsf::wfirst_afta_c5
