// SPDX-License-Identifier: GPL-3.0-or-later
// Roman's Wide Field Instrument, Cycle 9. One table a file.
#pragma once

#include "instrument/detector.hpp"
#include "instrument/instrument.hpp"
#include "instrument/sky.hpp"

namespace wfpsf::roman_c9 {

Instrument instrument();

std::span<const Constant> constants();
std::span<const Band> bands();
std::span<const FieldPoint> field_points();
std::span<const SkyCurve> sky();
DetectorFigures detector();
WcsTables wcs();
std::span<const Pupil> pupils(); // by mask, then by SCA

inline constexpr double collecting_area_cm2 = 37570;
inline constexpr size_t short_wave = 0, long_wave = 1; // the pupil masks

} // namespace wfpsf::roman_c9
