// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/sky.hpp"

#include "funnel.hpp"
#include "handles.hpp"

using namespace wfpsf;

namespace {

void require_not_negative(double value, const char *argument) {
    require_finite(value, argument);
    if (value < 0)
        fail(WFPSF_ERROR_RANGE, "%s = %g: must be >= 0", argument, value);
}

} // namespace

wfpsf_status wfpsf_sky_level(const wfpsf_instrument *instrument, const char *band, double longitude,
                             double latitude, double *level) {
    return guarded([&] {
        require_pointer(instrument, "instrument");
        require_pointer(band, "band");
        require_pointer(level, "level");
        *level = sky_level(instrument->instrument, band, longitude, latitude);
    });
}

wfpsf_status wfpsf_sky_background(const wfpsf_instrument *instrument, const char *band,
                                  double longitude, double latitude, double exposure_time,
                                  double pixel_area, double *electrons) {
    return guarded([&] {
        require_pointer(instrument, "instrument");
        require_pointer(band, "band");
        require_pointer(electrons, "electrons");
        require_not_negative(exposure_time, "exposure_time");
        require_not_negative(pixel_area, "pixel_area");
        const Instrument &i = instrument->instrument;
        const double zodiacal = sky_level(i, band, longitude, latitude) * pixel_area;
        const double stray = i.constant("stray_light_fraction").value;
        *electrons = exposure_time * (zodiacal * (1 + stray) + i.band(band).thermal_background);
    });
}
