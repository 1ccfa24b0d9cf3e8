// SPDX-License-Identifier: GPL-3.0-or-later
// The Sun, where the telescope may point because of it, and how it is best rolled.
#pragma once

#include "instrument/instrument.hpp"
#include "observation/sphere.hpp"

namespace wfpsf {

// Which Sun and which roll.
enum class SunRule {
    precise, // the Sun's direction from the Earth in the ICRS; position angles east of north
    galsim,  // GalSim's Sun of the equinox of date, and its roll, which runs the other way
};

// A Julian date (UTC) of a calendar date. WFPSF_ERROR_RANGE if there is no such date.
double julian_date(int year, int month, int day, int hour, int minute, double second);

// Years 1900..2100: WFPSF_ERROR_RANGE.
SkyPosition sun_position(double julian_date, SunRule rule);

struct Pointing {
    double sun_angle_deg;
    bool allowed; // the Sun's angle is within "max_sun_angle" of 90 degrees
};
Pointing check_pointing(const Instrument &instrument, const SkyPosition &line_of_sight,
                        double julian_date, SunRule rule);

// Position angle of the observatory's +Y axis that has the Sun in the plane of its X and Z axes:
// -180..180 degrees. WFPSF_ERROR_SUN_ANGLE where the pointing is not allowed.
double best_position_angle(const Instrument &instrument, const SkyPosition &line_of_sight,
                           double julian_date, SunRule rule);

} // namespace wfpsf
