/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file moments.h
 * Moments of an image: adaptive (the best-fit elliptical Gaussian), under a fixed weight, and
 * unweighted; their noise, and their derivatives by the image.
 *
 * All lengths are in pixels of the image, positions count from the first pixel's centre at (0, 0).
 * sigma = det(M)^(1/4); e1 = (Mxx - Myy)/(Mxx + Myy), e2 = 2 Mxy/(Mxx + Myy) (paper, Eqs. 13-16).
 *
 * Thread-safety: a result is immutable; measuring is thread-safe if nobody writes to the image.
 */
#ifndef WFPSF_MOMENTS_H
#define WFPSF_MOMENTS_H

#include <wfpsf/image.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_moments wfpsf_moments;

/** X(NAME, key, text): what a result holds. What does not apply is NaN. */
#define WFPSF_MOMENTS_PROPERTY_LIST(X)                                                             \
    X(CENTROID_X, 10, "centroid")                                                                  \
    X(CENTROID_Y, 20, "centroid")                                                                  \
    X(MXX, 30, "second moment")                                                                    \
    X(MXY, 40, "second moment")                                                                    \
    X(MYY, 50, "second moment")                                                                    \
    X(SIGMA, 60, "size from the determinant, det(M)^(1/4)")                                        \
    X(SIGMA_TRACE, 70, "size from the trace, sqrt(Mxx + Myy)")                                     \
    X(E1, 80, "ellipticity along the axes")                                                        \
    X(E2, 90, "ellipticity along the diagonals")                                                   \
    X(E, 100, "|e|")                                                                               \
    X(BETA, 110, "position angle of the major axis from x towards y, radians")                     \
    X(FLUX, 120, "flux of the best-fit Gaussian; of the pixels for unweighted moments")            \
    X(RHO4, 130, "weighted fourth moment, 2 for a Gaussian")                                       \
    X(PASSES, 140, "passes over the image")                                                        \
    X(ERROR_ESTIMATE, 150, "whitened error of centroid and moments")                               \
    X(RESIDUAL, 160, "norm of the gradient at the end, whitened")                                  \
    X(CURVATURE, 170, "smallest eigenvalue of minus the Hessian, whitened; 1/8 for a Gaussian")    \
    X(EDGE_FRACTION, 180, "fraction of the weight that falls outside the image")                   \
    X(MISSING_FRACTION, 190, "fraction of the squared weight that falls on missing pixels")        \
    X(AMPLITUDE, 200, "central value of the best-fit Gaussian")                                    \
    X(LAST_STEP, 210, "length of the last step, whitened")                                         \
    X(PIXELS, 220, "pixels visited, all passes together")                                          \
    X(BACKGROUND, 230, "background: fitted, or as it was given")

#define WFPSF_MOMENTS_PROPERTY_ENUM(name, key, text) WFPSF_MOMENTS_##name = (key),
enum { WFPSF_MOMENTS_PROPERTY_LIST(WFPSF_MOMENTS_PROPERTY_ENUM) };
#undef WFPSF_MOMENTS_PROPERTY_ENUM

/**
 * Adaptive moments: centroid x0 and matrix M such that, with the weight
 * w = exp(-(x-x0)^T M^-1 (x-x0) / 2), x0 is the weighted mean and M twice the weighted second
 * moment (paper, Eqs. 13 and 18, whose text leaves the factor 2 out).
 *
 * MOMENTS_METHOD 1 fits A w to the pixels by least squares at their centres. Where pixels sample
 * the object finely it is the same; where they do not, it has solutions and method 0 ends with
 * ERROR_MOMENTS_UNRESOLVED, or WARNING_UNDERSAMPLED where the minor axis is below 0.9 pixels and
 * the result depends on where the pixels fall by some per cent. Method 2 keeps the weight
 * round: SIGMA is the weight's, E1 and E2 are the weighted moments', and M is the matrix of that
 * size and shape. Method 3 fits A w + b, a constant background b with it: every pixel of the image
 * that is not missing tells of b, so all must be finite, and MOMENTS_BACKGROUND is not used.
 *
 * Given:    image    any size and strides
 *           options  MOMENTS_*
 * Returned: out      the result, also when the measurement fails: it then holds the last iterate.
 *                    NULL only if the arguments are not valid or memory runs out
 * Status:   OK; WARNING_NOT_CONVERGED, WARNING_RESTARTED, WARNING_NEAR_DEGENERATE,
 *           WARNING_UNDERSAMPLED; ERROR_MOMENTS_* or ERROR_NOT_FINITE (a NaN under the weight) with
 *           a result; ERROR_NULL, ERROR_NO_MEMORY without
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_measure(const wfpsf_image *image,
                                                const wfpsf_options *options, wfpsf_moments **out);

/**
 * The same with missing pixels, which are solved for and not taken as zero: they count as filled by
 * the fit itself, or are left out of the squares of method 1. Their values may be anything.
 *
 * Given:    missing   image of the same size, not 0 where a pixel is missing; may be NULL
 *           variance  image of the same size: variance of each pixel's noise, independent from
 *                     pixel to pixel. May be NULL: MOMENTS_VARIANCE counts
 * Status:   as for wfpsf_moments_measure(); ERROR_SIZE (sizes differ); ERROR_RANGE,
 *           ERROR_NOT_FINITE (a variance that is negative or not finite): with a result that has no
 *           covariance
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_measure_masked(const wfpsf_image *image,
                                                       const wfpsf_image *missing,
                                                       const wfpsf_image *variance,
                                                       const wfpsf_options *options,
                                                       wfpsf_moments **out);

/**
 * Moments under a Gaussian weight that stays as it is (KSB's, for one): FLUX is the sum of I w, the
 * centroid the weighted mean, and M the weighted second moment about the weight's centre, without a
 * factor 2.
 *
 * Given:    image          any size and strides
 *           x, y           centre of the weight
 *           Mxx, Mxy, Myy  its matrix, pixels^2, positive definite
 * Returned: out            the result; NULL on failure
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_RANGE, ERROR_MOMENTS_NO_PIXELS,
 *           ERROR_MOMENTS_FLUX (the weighted sum is zero), ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_measure_weighted(const wfpsf_image *image, double x,
                                                         double y, double Mxx, double Mxy,
                                                         double Myy, wfpsf_moments **out);

/**
 * Sums of I w dx^j dy^k up to the fourth order, dx and dy from (x, y); w = 1 without a weight.
 *
 * Given:    image   any size and strides
 *           x, y    the point
 *           weight  Mxx, Mxy, Myy of a Gaussian weight about it; NULL: no weight
 *           count   how many are wanted, 0..15: 6 make the second order, 15 the fourth
 * Returned: sums    (j, k) = (0,0), (1,0), (0,1), (2,0), (1,1), (0,2), (3,0), ..., (0,4)
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_RANGE
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_sums(const wfpsf_image *image, double x, double y,
                                             const double *weight, int64_t count, double *sums);

/**
 * Unweighted moments over the whole image about a point, with compensated sums.
 *
 * Given:    x, y   the point; NaN for both: the centroid
 * Returned: out    the result; NULL on failure
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_MOMENTS_NO_PIXELS (an empty image),
 *           ERROR_MOMENTS_FLUX (the pixels sum to zero), ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_measure_unweighted(const wfpsf_image *image, double x,
                                                           double y, wfpsf_moments **out);

/** Frees a result; NULL is allowed. */
WFPSF_EXPORT void wfpsf_moments_destroy(wfpsf_moments *moments);

/** The status with which the measurement ended; ERROR_NULL for NULL. */
WFPSF_EXPORT wfpsf_status wfpsf_moments_status(const wfpsf_moments *moments);

/**
 * One number of a result.
 *
 * Given:    key    WFPSF_MOMENTS_*
 * Returned: value  lengths in pixels of the image; NaN if it does not apply
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_get(const wfpsf_moments *moments, int32_t key,
                                            double *value);

/**
 * Covariance of two numbers of an adaptive result. MOMENTS_COVARIANCE_ORDER 1 is the first order in
 * the noise: standard deviations are good to 5% at a signal-to-noise ratio of 50; at 10 those of
 * second moments and BETA are too small by a fifth. Order 2 has the next terms too: good to 20% at
 * 10. It takes some 10 ms, and is NaN where the expansion fails, as of E and BETA where e is
 * far below its own error. At 7 and below second moments have tails that no expansion describes.
 * All this is of images without noise; of noisy ones at 10 it is true in the median, but a single
 * prediction scatters by a third or more, as the moments do that it is made of.
 *
 * The signal-to-noise ratio is that of the amplitude of the fit, its deviation being that at known
 * M. Noise must be normal for order 2.
 *
 * Given:    key_a, key_b  CENTROID_X to FLUX, or BACKGROUND; the same key twice for a variance
 * Returned: value         in the product of their units
 * Status:   ERROR_NULL; ERROR_UNKNOWN_NAME; ERROR_ARGUMENT: the result has no covariance, because
 *           no variance was given or there is no solution
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_covariance(const wfpsf_moments *moments, int32_t key_a,
                                                   int32_t key_b, double *value);

/**
 * Derivatives of a result by a change of its image, exactly (by implicit differentiation, without
 * steps): of I + t change at t = 0. Any parameter's derivative is that along the derivative of the
 * image by it: for a tap of an IPC kernel the image moved by that tap, less the image, times the
 * flux that the tap takes; for a Zernike coefficient the derivative of the PSF.
 *
 * Given:    moments  of wfpsf_moments_measure*(), a solution
 *           image    the image that was measured
 *           change   of the same size. Missing pixels count as zero
 *           second   NULL; or another change, for the mixed second derivative of
 *                    I + s change + t second by s and t. The same change twice gives the second
 *                    derivative along it, the term that a linear law neglects
 * Returned: out      a result whose properties CENTROID_X to FLUX and BACKGROUND are derivatives;
 *                    the others are NaN. E and BETA have none where e = 0
 * Status:   ERROR_NULL; ERROR_SIZE; ERROR_ARGUMENT (moments is no solution, or a derivative
 *           itself); ERROR_NOT_FINITE; ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_differentiate(const wfpsf_moments *moments,
                                                      const wfpsf_image *image,
                                                      const wfpsf_image *change,
                                                      const wfpsf_image *second,
                                                      wfpsf_moments **out);

/**
 * The influence function: the derivative of one number of a result by every pixel.
 *
 * Given:    moments, image  as for wfpsf_moments_differentiate()
 *           key             CENTROID_X to FLUX, or BACKGROUND
 * Returned: influence       float64 image of the same size
 * Status:   as for wfpsf_moments_differentiate(); ERROR_UNKNOWN_NAME, ERROR_TYPE
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_influence(const wfpsf_moments *moments,
                                                  const wfpsf_image *image, int32_t key,
                                                  wfpsf_image *influence);

#ifdef __cplusplus
}
#endif

#endif
