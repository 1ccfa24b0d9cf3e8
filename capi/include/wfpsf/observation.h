/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file observation.h
 * Observations: a telescope that points somewhere, where its detectors then are on the sky, and
 * where it may point because of the Sun.
 *
 *     wfpsf_observation_create(roman, 53.1, -27.8, 30, NULL, &observation);
 *     wfpsf_observation_find_sca(observation, 0, count, ra, dec, sca, x, y, &found);
 *
 * RA and Dec are degrees in the ICRS, position angles degrees east of north. Pixels count from the
 * first one's centre at (0, 0); a pixel is the square of side 1 about its centre. Each detector has
 * a TAN-SIP WCS of the FITS standard; docs/observation.md has the equations. It reaches 8192 pixels
 * beyond the detector's edges.
 *
 * By default the distortion inside a detector is that of the field. The tables of GalSim's
 * simulators leave it out, which moves positions by up to 26 pixels at a detector's corners;
 * WFPSF_OPTION_WCS_RULE = 1 reproduces them.
 *
 * Functions that take many positions do not fail over one of them: a position that has no answer
 * gets NaN and is counted in `undefined`. It has none if a number is not finite, |RA| > 1e6 or
 * |Dec| > 90, and if it is more than 8192 pixels off the detector or on the far side of the sky.
 * Outputs may be the inputs, element by element; they must not overlap in other ways.
 *
 * Thread-safety: an observation is immutable; every function here is thread-safe.
 */
#ifndef WFPSF_OBSERVATION_H
#define WFPSF_OBSERVATION_H

#include <wfpsf/instrument.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_observation wfpsf_observation;

/** What wfpsf_observation_get() tells. The first four are the same for every detector. */
enum {
    /** Pointing: the centre of the focal plane. Position angles are -180..180. */
    WFPSF_OBSERVATION_RA = 10,
    WFPSF_OBSERVATION_DEC = 20,
    /** Of the observatory's +Y axis and of the focal plane, at the pointing. */
    WFPSF_OBSERVATION_PA = 30,
    WFPSF_OBSERVATION_PA_FPA = 40,
    /** FITS keywords of the detector. CRPIX counts from 1, as FITS does. */
    WFPSF_OBSERVATION_CRPIX1 = 100,
    WFPSF_OBSERVATION_CRPIX2 = 110,
    WFPSF_OBSERVATION_CRVAL1 = 120,
    WFPSF_OBSERVATION_CRVAL2 = 130,
    WFPSF_OBSERVATION_CD1_1 = 140,
    WFPSF_OBSERVATION_CD1_2 = 150,
    WFPSF_OBSERVATION_CD2_1 = 160,
    WFPSF_OBSERVATION_CD2_2 = 170,
    WFPSF_OBSERVATION_ORIENTAT = 180
};

/**
 * An observation with a given roll.
 *
 * Given:    ra_deg, dec_deg  where the centre of the focal plane points; |RA| <= 1e6
 *           pa_deg           position angle of the observatory's +Y axis, or with
 *                            WFPSF_OPTION_PA_OF_FPA of the focal plane; |PA| <= 1e6
 *           options          WCS_RULE, PA_OF_FPA
 * Returned: out              the handle; NULL on failure. The instrument may be freed
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_RANGE, ERROR_NO_WCS (the instrument was made from a
 *           design), ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_observation_create(const wfpsf_instrument *instrument,
                                                   double ra_deg, double dec_deg, double pa_deg,
                                                   const wfpsf_options *options,
                                                   wfpsf_observation **out);

/**
 * An observation with the best roll of its date: wfpsf_pointing_best_pa().
 *
 * Given:    julian_date  UTC
 *           options      WCS_RULE
 * Status:   those of wfpsf_observation_create() and of wfpsf_pointing_best_pa()
 */
WFPSF_EXPORT wfpsf_status wfpsf_observation_create_on_date(const wfpsf_instrument *instrument,
                                                           double ra_deg, double dec_deg,
                                                           double julian_date,
                                                           const wfpsf_options *options,
                                                           wfpsf_observation **out);

/**
 * The observation that has a pixel of a detector at a place on the sky, to 1e-12 degrees.
 *
 * Given:    sca              1..n_sca
 *           x, y             on the detector or within 8192 pixels of it
 *           ra_deg, dec_deg  the place
 *           pa_deg, options  as for wfpsf_observation_create()
 * Status:   those of wfpsf_observation_create(); ERROR_RANGE also if no such pointing was found, as
 *           may be within a degree of a pole
 */
WFPSF_EXPORT wfpsf_status wfpsf_observation_create_aimed(
    const wfpsf_instrument *instrument, int32_t sca, double x, double y, double ra_deg,
    double dec_deg, double pa_deg, const wfpsf_options *options, wfpsf_observation **out);

/** Frees an observation; NULL is allowed. */
WFPSF_EXPORT void wfpsf_observation_destroy(wfpsf_observation *observation);

/**
 * A number of the pointing or of a detector.
 *
 * Given:    sca    1..n_sca
 *           key    WFPSF_OBSERVATION_*
 * Returned: value
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_observation_get(const wfpsf_observation *observation, int32_t sca,
                                                int32_t key, double *value);

/**
 * Positions on the sky as pixels of one detector, on it or not.
 *
 * Given:    sca              1..n_sca
 *           count            of positions, >= 0
 *           ra_deg, dec_deg  any numbers
 * Returned: x, y             pixels, to 1e-8; NaN where there is no answer
 *           undefined        how many have none; may be NULL
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_observation_sky_to_pixel(const wfpsf_observation *observation,
                                                         int32_t sca, int64_t count,
                                                         const double *ra_deg,
                                                         const double *dec_deg, double *x,
                                                         double *y, int64_t *undefined);

/**
 * Pixels of a detector as positions on the sky.
 *
 * Returned: ra_deg, dec_deg  RA 0..360, 360 excluded; to 1e-9 arcsec; NaN where there is no answer
 *           undefined        how many have none; may be NULL
 * Status:   as for wfpsf_observation_sky_to_pixel()
 */
WFPSF_EXPORT wfpsf_status wfpsf_observation_pixel_to_sky(const wfpsf_observation *observation,
                                                         int32_t sca, int64_t count,
                                                         const double *x, const double *y,
                                                         double *ra_deg, double *dec_deg,
                                                         int64_t *undefined);

/**
 * Which detector each position falls on: the lowest, if by their gaps there are several.
 *
 * Given:    with_gaps        0: a detector is its active pixels; 1: they and its halves of the gaps
 *                            to its neighbours
 *           count            of positions, >= 0
 *           ra_deg, dec_deg  any numbers
 * Returned: sca              count integers, 1..n_sca; 0 if it falls on none
 *           x, y             where on it; NaN if it falls on none. May be NULL
 *           found            how many fall on one; may be NULL
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_observation_find_sca(const wfpsf_observation *observation,
                                                     int32_t with_gaps, int64_t count,
                                                     const double *ra_deg, const double *dec_deg,
                                                     int32_t *sca, double *x, double *y,
                                                     int64_t *found);

/**
 * The first and last pixels of a detector along each axis, with or without its halves of the gaps.
 *
 * Given:    sca        1..n_sca
 *           with_gaps  0 or 1
 * Returned: x_first, x_last, y_first, y_last  all belong to it; below 0 in the gaps
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_ARGUMENT
 */
WFPSF_EXPORT wfpsf_status wfpsf_observation_bounds(const wfpsf_observation *observation,
                                                   int32_t sca, int32_t with_gaps, int64_t *x_first,
                                                   int64_t *x_last, int64_t *y_first,
                                                   int64_t *y_last);

/**
 * How directions on the sky change with pixels, on the sphere and not in the tangent plane. The
 * angle tells how a detector's image, and with it a PSF in science coordinates, is turned.
 *
 * Given:    sca          1..n_sca
 *           count        of positions, >= 0
 *           x, y         pixels
 * Returned: jacobian     4 count numbers, position by position: the change to the east by x and by
 *                        y, to the north by x and by y, arcsec per pixel. May be NULL. Seen with
 *                        north up and east left, x runs clockwise of y if the determinant is < 0
 *           pixel_area   arcsec^2; may be NULL
 *           y_angle_deg  position angle of the y axis, east of north, -180..180; may be NULL
 *           undefined    how many have no answer and are NaN; may be NULL
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_observation_jacobian(const wfpsf_observation *observation,
                                                     int32_t sca, int64_t count, const double *x,
                                                     const double *y, double *jacobian,
                                                     double *pixel_area, double *y_angle_deg,
                                                     int64_t *undefined);

/**
 * The WCS keywords of a detector's FITS image, with the pointing's: cards of 80 characters, one
 * after another without line ends, no END card.
 *
 * Given:    sca       1..n_sca
 *           capacity  bytes that `text` has room for, >= 0
 * Returned: text      the first capacity - 1 characters, closed by NUL; may be NULL if capacity is 0
 *           length    of the whole text, without the NUL; may be NULL
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_observation_fits_header(const wfpsf_observation *observation,
                                                        int32_t sca, int64_t capacity, char *text,
                                                        int64_t *length);

/**
 * The Julian date of a UTC date and time, good to 4e-5 s.
 *
 * Given:    year, month, day, hour, minute, second  Gregorian, in the years 1900 to 2100
 * Returned: julian_date                             days, UTC
 * Status:   ERROR_NULL, ERROR_RANGE (there is no such date)
 */
WFPSF_EXPORT wfpsf_status wfpsf_julian_date(int32_t year, int32_t month, int32_t day, int32_t hour,
                                            int32_t minute, double second, double *julian_date);

/**
 * Where the Sun is: its geometric direction from the Earth's centre (ERFA's eraEpv00), without 20
 * arcsec of aberration. Seen from an orbit about L2 it is off by up to 0.3 degrees. With WCS_RULE =
 * 1, as GalSim has it: a low-precision Sun of the equinox of date, without the precession since
 * J2000, 0.3 to 0.5 degrees off in 2025 to 2032.
 *
 * Given:    julian_date      UTC, in the years 1900 to 2100
 *           options          WCS_RULE
 * Returned: ra_deg, dec_deg
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_RANGE
 */
WFPSF_EXPORT wfpsf_status wfpsf_sun_position(double julian_date, const wfpsf_options *options,
                                             double *ra_deg, double *dec_deg);

/**
 * Whether the Sun lets an instrument point somewhere: its angle to the line of sight must be within
 * the constant "max_sun_angle" (36 degrees) of 90.
 *
 * Given:    ra_deg, dec_deg  the line of sight
 *           julian_date      UTC, in the years 1900 to 2100
 *           options          WCS_RULE
 * Returned: sun_angle_deg    0..180; may be NULL
 *           allowed          0 or 1; may be NULL
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_RANGE, ERROR_UNKNOWN_NAME (the instrument was made
 *           from a design)
 */
WFPSF_EXPORT wfpsf_status wfpsf_pointing_allowed(const wfpsf_instrument *instrument, double ra_deg,
                                                 double dec_deg, double julian_date,
                                                 const wfpsf_options *options,
                                                 double *sun_angle_deg, int32_t *allowed);

/**
 * The roll that has the Sun in the plane of the observatory's X and Z axes, X being the line of
 * sight and Z on the Sun's side: the position angle of +Y, Z x X, east of north. GalSim's, which
 * WCS_RULE = 1 gives, has the other sign; 180 degrees are added to it for a Sun beyond 90 degrees.
 *
 * Returned: pa_deg           -180..180
 * Status:   those of wfpsf_pointing_allowed(), ERROR_SUN_ANGLE (the pointing is not allowed)
 */
WFPSF_EXPORT wfpsf_status wfpsf_pointing_best_pa(const wfpsf_instrument *instrument, double ra_deg,
                                                 double dec_deg, double julian_date,
                                                 const wfpsf_options *options, double *pa_deg);

#ifdef __cplusplus
}
#endif

#endif
