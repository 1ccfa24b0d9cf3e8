// SPDX-License-Identifier: GPL-3.0-or-later
// The zodiacal light.
#pragma once

#include "instrument/instrument.hpp"

#include <span>
#include <string_view>

namespace wfpsf {

// A band's table over 46 longitudes and 42 latitudes.
struct SkyCurve {
    const char *name;
    std::span<const double> values;
};

// e-/s/arcsec2 at an ecliptic longitude counted from the Sun and a latitude, degrees; bilinear in
// the longitude and the sine of the latitude. Where the Sun is too close: WFPSF_ERROR_SKY_SUN.
double sky_level(const Instrument &instrument, std::string_view band, double longitude,
                 double latitude);

} // namespace wfpsf
