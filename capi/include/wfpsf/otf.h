/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file otf.h
 * Optical transfer functions: PSFs in k space, for hosts that draw by Fourier transform.
 *
 *     OTF(k) = integral of I(theta) exp(-2 pi i k.theta) d2theta / the same at k = 0,
 *
 * I the image of a star that wfpsf_psf_draw() would draw at the origin, theta along the image's
 * axes in arcsec, k in cycles per arcsec. It is the autocorrelation of the pupil function P exp(2
 * pi i W) (Goodman, Introduction to Fourier Optics, section 6.3): no field is cut off anywhere, and
 * it is zero beyond the cut-off frequency. OTF(-k) is the conjugate of OTF(k).
 *
 * Thread-safety: an OTF is immutable; every function here is thread-safe.
 */
#ifndef WFPSF_OTF_H
#define WFPSF_OTF_H

#include <wfpsf/psf.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_otf wfpsf_otf;

/** X(NAME, key, text): what can be asked of an OTF. */
#define WFPSF_OTF_PROPERTY_LIST(X)                                                                 \
    X(ERROR_ESTIMATE, 10, "error of a PSF made of it, in units of the PSF's peak")                 \
    X(VALUE_ERROR, 20, "largest error of any value")                                               \
    X(CUTOFF, 30, "frequency above which nothing passes along x or y, cycles per arcsec")          \
    X(PIXELS, 40, "pixels across the pupil")

#define WFPSF_OTF_PROPERTY_ENUM(name, key, text) WFPSF_OTF_##name = (key),
enum { WFPSF_OTF_PROPERTY_LIST(WFPSF_OTF_PROPERTY_ENUM) };
#undef WFPSF_OTF_PROPERTY_ENUM

/** What acts on the image. */
enum {
    WFPSF_RESPONSE_DIFFRACTION = 1, /**< the telescope alone */
    WFPSF_RESPONSE_EFFECTIVE = 2    /**< and pixel, jitter, diffusion, as in wfpsf_psf_draw() */
};

/** Where k = 0 stands in a grid of nx by ny, and where the others. */
enum {
    /** At pixel (nx/2, ny/2), rounded down; k grows from pixel to pixel. */
    WFPSF_ORDER_CENTRED = 1,
    /** At the first pixel; the negative frequencies, from -(n/2), fill the second half of each
       axis: what FFTs take and give. */
    WFPSF_ORDER_WRAPPED = 2,
    /** The same along y; along x only 0, 1, ... nx-1: the half that transforms of real images
        take, nx = N/2 + 1. */
    WFPSF_ORDER_HALF = 3
};

/**
 * The OTF of a PSF.
 *
 * The pupil function is averaged on square pixels, as many as EPS takes up to 2048 across; a pupil
 * that was given as a mask is taken as it is and exactly. EPS bounds the integral of the OTF's
 * error over that of the OTF: the error of a PSF made of it, in units of the peak. Single values
 * are off by more, up to VALUE_ERROR, near k = 0 (not at it) and where k is parallel to a strut.
 * An EPS of 1e-4 takes about 0.1 s, 1e-5 0.2 s; 1e-6 takes seconds and, for a while, 120 bytes
 * for every pixel of the pupil's square, as a mask of as many pixels does.
 *
 * Given:    psf      may be freed afterwards
 *           options  EPS
 * Returned: out      the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_NO_MEMORY; WARNING_NOT_CERTIFIED if the error estimate stays above
 *           EPS
 */
WFPSF_EXPORT wfpsf_status wfpsf_otf_create(const wfpsf_psf *psf, const wfpsf_options *options,
                                           wfpsf_otf **out);

/** Frees an OTF; NULL is allowed. */
WFPSF_EXPORT void wfpsf_otf_destroy(wfpsf_otf *otf);

/**
 * Values at any frequencies.
 *
 * Given:    response  WFPSF_RESPONSE_*
 *           count     of frequencies, >= 0
 *           kx, ky    cycles per arcsec, count finite numbers each
 * Returned: re, im    count numbers each, dimensionless
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_SIZE, ERROR_NOT_FINITE; nothing is then written
 */
WFPSF_EXPORT wfpsf_status wfpsf_otf_values(const wfpsf_otf *otf, int32_t response, int64_t count,
                                           const double *kx, const double *ky, double *re,
                                           double *im);

/**
 * Values on a grid. Real and imaginary parts may lie side by side in one array of complex numbers:
 * two images of stride_x = 2, the second one begun an element later.
 *
 * For a star at theta0 multiply by exp(-2 pi i k.theta0). An image of N pixels of s arcsec a side
 * takes step = 1 / (N s).
 *
 * Given:    response  WFPSF_RESPONSE_*
 *           order     WFPSF_ORDER_*
 *           step      between neighbours, cycles per arcsec, > 0
 * Returned: re, im    pixels of two images of one size; their records are left alone
 * Status:   ERROR_NULL, ERROR_ARGUMENT (also if re and im are one image), ERROR_SIZE,
 *           ERROR_NOT_FINITE, ERROR_RANGE; nothing is then written
 */
WFPSF_EXPORT wfpsf_status wfpsf_otf_grid(const wfpsf_otf *otf, int32_t response, int32_t order,
                                         double step, wfpsf_image *re, wfpsf_image *im);

/**
 * One property of an OTF.
 *
 * Given:    key    WFPSF_OTF_*
 * Returned: value  in the unit that the list states
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_otf_get(const wfpsf_otf *otf, int32_t key, double *value);

#ifdef __cplusplus
}
#endif

#endif
