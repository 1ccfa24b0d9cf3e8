/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file varying_psf.h
 * The PSF all over a detector: made once, then cheap at any place.
 *
 * By definition a PSF is what diffraction makes of the aberrations at its place, and aberrations
 * are interpolated between the instrument's field points (FIELD_RULE). The model interpolates the
 * resulting light, by polynomials of the place through as many exact PSFs as EPS needs, and keeps
 * the few images that they are sums of. Its error is measured at places that it was not made from.
 *
 * To interpolate PSFs between the field points themselves is another matter. Largest errors of any
 * pixel of J129's PSF in units of its peak, at 30 places of Roman's detectors 7 and 18: the PSF of
 * the nearest field point 2.1e-2 and 2.2e-2; PSFs bilinear between the corners 9.5e-3 and 1.9e-2;
 * the same with the centre's PSF 1.9e-3 and 9.7e-3; aberrations bilinear between the corners, the
 * centre's left out, 2.2e-3 and 9.7e-3.
 *
 * Thread-safety: immutable; many threads may use one, each with its own image.
 */
#ifndef WFPSF_VARYING_PSF_H
#define WFPSF_VARYING_PSF_H

#include <wfpsf/psf.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_varying_psf wfpsf_varying_psf;

/** X(NAME, key, text): what can be asked of a varying PSF. */
#define WFPSF_VARYING_PSF_PROPERTY_LIST(X)                                                         \
    X(ERROR_ESTIMATE, 10, "numerical error of any pixel at any place, in units of the peak pixel") \
    X(INTERPOLATION_ERROR, 20, "the part of it that comes from the interpolation")                 \
    X(DEGREE, 30, "degree of the polynomials in each coordinate")                                  \
    X(RANK, 40, "images that the PSFs of all places are sums of")                                  \
    X(EXACT_PSFS, 50, "PSFs that were made to make and to check it")                               \
    X(MEMORY_BYTES, 60, "memory that it holds, bytes")                                             \
    X(MARGIN, 70, "how far beyond the centres of the outermost pixels it reaches, pixels")

#define WFPSF_VARYING_PSF_PROPERTY_ENUM(name, key, text) WFPSF_VARYING_PSF_##name = (key),
enum { WFPSF_VARYING_PSF_PROPERTY_LIST(WFPSF_VARYING_PSF_PROPERTY_ENUM) };
#undef WFPSF_VARYING_PSF_PROPERTY_ENUM

/**
 * The PSF over one detector and 512 pixels around it. An instrument whose aberrations do not vary
 * over a detector ("wfirst-afta-c5") costs one PSF.
 *
 * Given:    instrument     may be freed afterwards
 *           band           such as "J129"
 *           sca            1..n_sca
 *           wavelength_nm  of one colour, 100..100000; 0: the band's effective wavelength,
 *                          tabulated
 *           sed            of many colours, seen through the band; wavelength_nm must be 0 then.
 *                          NULL: one colour
 *           options        as for wfpsf_psf_create_in_band(); EPS is of any pixel at any place; THREADS,
 *                          on which no bit depends
 * Returned: out            the handle; NULL on failure
 * Status:   as for wfpsf_psf_create_chromatic(); ERROR_ARGUMENT if both a wavelength and an SED are
 *           given; WARNING_NOT_CERTIFIED
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_psf_create(const wfpsf_instrument *instrument,
                                                   const char *band, int32_t sca,
                                                   double wavelength_nm, const wfpsf_sed *sed,
                                                   const wfpsf_options *options,
                                                   wfpsf_varying_psf **out);

/** Frees a varying PSF; NULL is allowed. PSFs taken from it stay. */
WFPSF_EXPORT void wfpsf_varying_psf_destroy(wfpsf_varying_psf *varying);

/**
 * The PSF at a place: one like those of wfpsf_psf_create_in_band(), in a tenth of the time or less.
 *
 * Given:    x, y  position on the detector, pixels, the first one's centre at (0, 0)
 * Returned: out   the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_RANGE (more than MARGIN off the detector)
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_psf_at(const wfpsf_varying_psf *varying, double x, double y,
                                               wfpsf_psf **out);

/**
 * Adds stars to an image as wfpsf_psf_add_stars() does, each with the PSF of its own place, to a
 * tenth of EPS. Thousands of stars share what is near them: microseconds each.
 *
 * Given:    x0, y0      position on the detector of the centre of the image's first native pixel
 *           others      as for wfpsf_psf_add_stars(); x and y in pixels of the image
 * Returned: image       pixels and record; untouched on failure, unless memory runs out on the way
 * Status:   as there; ERROR_RANGE if a star in reach of the image is more than MARGIN off the
 *           detector
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_psf_add_stars(const wfpsf_varying_psf *varying, double x0,
                                                      double y0, int64_t count, const double *x,
                                                      const double *y, const double *flux,
                                                      const wfpsf_options *options,
                                                      wfpsf_image *image);

/**
 * One property of a varying PSF.
 *
 * Given:    key    WFPSF_VARYING_PSF_*
 * Returned: value  in the unit that the list states
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_psf_get(const wfpsf_varying_psf *varying, int32_t key,
                                                double *value);

#ifdef __cplusplus
}
#endif

#endif
