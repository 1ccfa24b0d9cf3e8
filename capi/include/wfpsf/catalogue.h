/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file catalogue.h
 * Catalogues: the stars and small galaxies that a scene is made of.
 *
 *     wfpsf_catalogue_create(WFPSF_POSITIONS_SKY, WFPSF_BRIGHTNESS_AB_MAGNITUDE, &catalogue);
 *     wfpsf_catalogue_add_colour(catalogue, 0, sed, &colour);
 *     wfpsf_catalogue_add_stars(catalogue, count, ra, dec, magnitude, NULL, NULL);
 *
 * Thread-safety: a catalogue may be shared once nothing is added to it any more.
 */
#ifndef WFPSF_CATALOGUE_H
#define WFPSF_CATALOGUE_H

#include <wfpsf/instrument.h>
#include <wfpsf/sed.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_catalogue wfpsf_catalogue;

/** What positions are. */
enum {
    WFPSF_POSITIONS_DETECTOR = 1, /**< pixels of a detector, the first one's centre at (0, 0) */
    WFPSF_POSITIONS_SKY = 2       /**< x is RA and y is Dec, degrees, ICRS */
};

/** What brightness is. */
enum {
    WFPSF_BRIGHTNESS_ELECTRONS = 1,   /**< e- in the exposure, all of the source's light */
    WFPSF_BRIGHTNESS_AB_MAGNITUDE = 2 /**< in the band: wfpsf_instrument_ab_zero_rate() */
};

/**
 * An empty catalogue.
 *
 * Given:    positions   WFPSF_POSITIONS_*
 *           brightness  WFPSF_BRIGHTNESS_*
 * Returned: out         the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_catalogue_create(int32_t positions, int32_t brightness,
                                                 wfpsf_catalogue **out);

/** Frees a catalogue; NULL is allowed. Scenes made of it stay. */
WFPSF_EXPORT void wfpsf_catalogue_destroy(wfpsf_catalogue *catalogue);

/**
 * A colour that sources may have. Sources of one colour share PSFs, so a few that stand for all are
 * better than one for each. A catalogue without any has one, number 0: that of wavelength 0.
 *
 * Given:    wavelength_nm  of light of one wavelength, 100..100000; 0: the band's effective
 *                          wavelength, tabulated
 *           sed            of light of many wavelengths, seen through the band; wavelength_nm must
 *                          be 0 then. May be freed afterwards. NULL: one wavelength
 * Returned: colour         its number: 0, 1, ...; may be NULL
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_RANGE, ERROR_ARGUMENT, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_catalogue_add_colour(wfpsf_catalogue *catalogue,
                                                     double wavelength_nm, const wfpsf_sed *sed,
                                                     int32_t *colour);

/**
 * Adds stars. Those that lie far off any detector do no harm.
 *
 * Given:    count       of stars, >= 0
 *           x, y        count positions: pixels, -1e9..1e9; or RA -1e6..1e6 and Dec -90..90
 *           brightness  count numbers: e-, -1e18..1e18; or magnitudes, -20..100
 *           colour      count numbers of colours that the catalogue has; NULL: all 0
 * Status:   ERROR_NULL, ERROR_SIZE, ERROR_NOT_FINITE, ERROR_RANGE, ERROR_NO_MEMORY; nothing is then
 *           added
 */
WFPSF_EXPORT wfpsf_status wfpsf_catalogue_add_stars(wfpsf_catalogue *catalogue, int64_t count,
                                                    const double *x, const double *y,
                                                    const double *brightness,
                                                    const int32_t *colour);

/**
 * Adds galaxies: Sersic profiles, I(r) proportional to exp(-b (r / r_e)^(1/n)), sheared without
 * change of area. They are not cut off anywhere.
 *
 * Given:    count, x, y, brightness, colour  as for wfpsf_catalogue_add_stars(); the centres
 *           sersic_index  n, dimensionless, 0.3..6.2: 0.5 is a Gaussian, 1 exponential, 4 de Vaucouleurs
 *           half_light_radius_arcsec  r_e before the shear, 1e-6..1000
 *           e1, e2        dimensionless: (a - b) / (a + b) times cosine and sine of twice the angle of the major
 *                         axis from x towards y of the detector; up to 0.95 in all. NULL: round
 * Status:   as for wfpsf_catalogue_add_stars()
 */
WFPSF_EXPORT wfpsf_status wfpsf_catalogue_add_galaxies(
    wfpsf_catalogue *catalogue, int64_t count, const double *x, const double *y,
    const double *brightness, const int32_t *colour, const double *sersic_index,
    const double *half_light_radius_arcsec, const double *e1, const double *e2);

/**
 * How many sources there are.
 *
 * Returned: count
 * Status:   ERROR_NULL
 */
WFPSF_EXPORT wfpsf_status wfpsf_catalogue_size(const wfpsf_catalogue *catalogue, int64_t *count);

/**
 * Electrons a second that a source of AB magnitude 0, 3631 Jy at all frequencies, gives in a band:
 * the integral of collecting area * throughput * 3631 Jy / (h lambda) over wavelength.
 *
 * Given:    band  such as "J129"
 * Returned: rate  e-/s
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME (no such band, or no "collecting_area": a design's)
 */
WFPSF_EXPORT wfpsf_status wfpsf_instrument_ab_zero_rate(const wfpsf_instrument *instrument,
                                                        const char *band, double *rate);

#ifdef __cplusplus
}
#endif

#endif
