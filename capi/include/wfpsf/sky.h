/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file sky.h
 * The sky between the stars, as the instruments' simulators tabulate it.
 *
 * Thread-safety: every function here is thread-safe.
 */
#ifndef WFPSF_SKY_H
#define WFPSF_SKY_H

#include <wfpsf/instrument.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * Zodiacal light in a band, without stray light: bilinear in the longitude and the sine of the
 * latitude between tabulated points.
 *
 * Given:    instrument, band     a known instrument, and a band of it such as "J129"
 *           longitude, latitude  ecliptic, degrees; the longitude counts from the Sun
 * Returned: level                e-/s/arcsec^2
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME, ERROR_NOT_FINITE, ERROR_RANGE, ERROR_SKY_SUN (too close
 *           to the Sun)
 */
WFPSF_EXPORT wfpsf_status wfpsf_sky_level(const wfpsf_instrument *instrument, const char *band,
                                          double longitude, double latitude, double *level);

/**
 * Mean background of a pixel in an exposure: zodiacal light with the instrument's stray light, and
 * its thermal background. Dark current is not in it.
 *
 * Given:    instrument, band     as for wfpsf_sky_level()
 *           longitude, latitude  the same
 *           exposure_time        s, >= 0
 *           pixel_area           arcsec^2, >= 0
 * Returned: electrons            e- per pixel
 * Status:   as for wfpsf_sky_level()
 */
WFPSF_EXPORT wfpsf_status wfpsf_sky_background(const wfpsf_instrument *instrument, const char *band,
                                               double longitude, double latitude,
                                               double exposure_time, double pixel_area,
                                               double *electrons);

#ifdef __cplusplus
}
#endif

#endif
