/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file size.h
 * Sizes that are no moments: encircled energy, EE50, FWHM (paper, section 3.2).
 *
 * Lengths are in pixels of the image, positions count from the first pixel's centre at (0, 0).
 * Thread-safe if nobody writes to the image.
 */
#ifndef WFPSF_SIZE_H
#define WFPSF_SIZE_H

#include <wfpsf/image.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How the light in a circle is counted. */
enum {
    /** The band-limited image integrated over the disc: no pixels, exponentially exact. */
    WFPSF_SIZE_BANDLIMITED = 1,
    /** Pixels whose centre lies in the circle: the paper's Eq. 25; the smallest circle that holds
       at least the fraction. */
    WFPSF_SIZE_PIXEL_SUM = 2,
    /** The same, with r^2 interpolated between the last two pixels: GalSim's calculateHLR. */
    WFPSF_SIZE_PIXEL_INTERPOLATED = 3
};

/**
 * Fraction of the light inside a circle, by the integral of the band-limited image.
 *
 * Given:    x, y     centre
 *           radius   >= 0; the circle must lie inside the image
 *           options  SIZE_TOTAL_FLUX, SIZE_BANDWIDTH
 * Returned: fraction
 *           error    estimate of its error; may be NULL
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE, ERROR_MOMENTS_FLUX, ERROR_SIZE_NOT_REACHED
 */
WFPSF_EXPORT wfpsf_status wfpsf_size_encircled_energy(const wfpsf_image *image, double x, double y,
                                                      double radius, const wfpsf_options *options,
                                                      double *fraction, double *error);

/**
 * Radius of the circle that holds a fraction of the light; EE50, the half-light radius, for 0.5.
 *
 * Given:    x, y      centre
 *           fraction  in (0, 1)
 *           method    WFPSF_SIZE_*
 *           options   SIZE_TOTAL_FLUX, SIZE_BANDWIDTH
 * Returned: radius
 *           error     estimate of its error; may be NULL; NaN for the pixel methods
 * Status:   as for wfpsf_size_encircled_energy(), ERROR_ARGUMENT; ERROR_RANGE also for the fraction
 */
WFPSF_EXPORT wfpsf_status wfpsf_size_ee_radius(const wfpsf_image *image, double x, double y,
                                               double fraction, int32_t method,
                                               const wfpsf_options *options, double *radius,
                                               double *error);

/**
 * Full width at half maximum from pixels sorted by distance, as GalSim's calculateFWHM.
 *
 * Given:    x, y  centre
 * Returned: fwhm
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_MOMENTS_FLUX, ERROR_SIZE_NOT_REACHED
 */
WFPSF_EXPORT wfpsf_status wfpsf_size_fwhm(const wfpsf_image *image, double x, double y,
                                          double *fwhm);

#ifdef __cplusplus
}
#endif

#endif
