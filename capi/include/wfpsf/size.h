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
 *           options  SIZE_TOTAL_FLUX, SIZE_BANDWIDTH, SIZE_EPS
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
 *           options   SIZE_TOTAL_FLUX, SIZE_BANDWIDTH, SIZE_EPS
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
 * Given:    image  of any size and strides
 *           x, y   centre
 * Returned: fwhm   pixels
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_MOMENTS_FLUX, ERROR_SIZE_NOT_REACHED
 */
WFPSF_EXPORT wfpsf_status wfpsf_size_fwhm(const wfpsf_image *image, double x, double y,
                                          double *fwhm);

/**
 * Derivative of wfpsf_size_ee_radius() (of the band-limited image) by a change of the image,
 * exactly: of I + t change at t = 0, about a centre that stays. Without SIZE_TOTAL_FLUX the total
 * changes too.
 *
 * Given:    change      image of the same size
 *           second      NULL; or another change, for the mixed second derivative of
 *                       I + s change + t second by s and t. The same change twice gives the second
 *                       derivative along it, the term that a linear law neglects
 *           x, y        centre
 *           fraction    in (0, 1)
 *           options     SIZE_TOTAL_FLUX, SIZE_BANDWIDTH, SIZE_EPS
 * Returned: derivative  pixels
 *           error       estimate of its error; may be NULL
 * Status:   as for wfpsf_size_ee_radius(), ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_size_ee_radius_derivative(
    const wfpsf_image *image, const wfpsf_image *change, const wfpsf_image *second, double x,
    double y, double fraction, const wfpsf_options *options, double *derivative, double *error);

/**
 * Radial profile: means of the band-limited image on circles.
 *
 * Given:    x, y     centre
 *           count    of radii, >= 0
 *           radii    pixels, >= 0; the circles must lie inside the image
 *           options  SIZE_BANDWIDTH, SIZE_EPS
 * Returned: profile  a mean for every radius
 *           errors   estimates of their errors; may be NULL
 * Status:   ERROR_NULL, ERROR_SIZE, ERROR_RANGE, ERROR_NOT_FINITE, ERROR_SIZE_NOT_REACHED
 */
WFPSF_EXPORT wfpsf_status wfpsf_size_profile(const wfpsf_image *image, double x, double y,
                                             int64_t count, const double *radii,
                                             const wfpsf_options *options, double *profile,
                                             double *errors);

/**
 * Full width at half maximum of that profile: twice the smallest radius at which it falls to half
 * of its value at the centre.
 *
 * Given:    image    of any size and strides
 *           x, y     centre, meant to be the peak
 *           options  SIZE_BANDWIDTH, SIZE_EPS
 * Returned: fwhm
 *           error    estimate of its error; may be NULL
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_MOMENTS_FLUX, ERROR_SIZE_NOT_REACHED
 */
WFPSF_EXPORT wfpsf_status wfpsf_size_profile_fwhm(const wfpsf_image *image, double x, double y,
                                                  const wfpsf_options *options, double *fwhm,
                                                  double *error);

#ifdef __cplusplus
}
#endif

#endif
