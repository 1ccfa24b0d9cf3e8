/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file moments.h
 * Moments of an image: adaptive (the best-fit elliptical Gaussian) and unweighted.
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
    X(EDGE_FRACTION, 180, "fraction of the weight that falls outside the image")

#define WFPSF_MOMENTS_PROPERTY_ENUM(name, key, text) WFPSF_MOMENTS_##name = (key),
enum { WFPSF_MOMENTS_PROPERTY_LIST(WFPSF_MOMENTS_PROPERTY_ENUM) };
#undef WFPSF_MOMENTS_PROPERTY_ENUM

/**
 * Adaptive moments: centroid x0 and matrix M such that, with the weight
 * w = exp(-(x-x0)^T M^-1 (x-x0) / 2), x0 is the weighted mean and M twice the weighted second
 * moment (paper, Eqs. 13 and 18, whose text leaves the factor 2 out).
 *
 * Given:    image    any size and strides
 *           options  MOMENTS_*
 * Returned: out      the result, also when the measurement fails: it then holds the last iterate.
 *                    NULL only if the arguments are not valid or memory runs out
 * Status:   OK; WARNING_NOT_CONVERGED, WARNING_RESTARTED, WARNING_NEAR_DEGENERATE;
 *           ERROR_MOMENTS_* or ERROR_NOT_FINITE (a NaN under the weight) with a result;
 *           ERROR_NULL, ERROR_NO_MEMORY without
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_measure(const wfpsf_image *image,
                                                const wfpsf_options *options, wfpsf_moments **out);

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
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_moments_get(const wfpsf_moments *moments, int32_t key,
                                            double *value);

#ifdef __cplusplus
}
#endif

#endif
