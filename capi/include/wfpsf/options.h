/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file options.h
 * Options: typed values by pinned key, with defaults and bounds that can be asked for.
 *
 * Wherever a function takes a const wfpsf_options *, NULL means the defaults.
 * Thread-safety: an options handle is mutable; callers that share one lock it themselves.
 */
#ifndef WFPSF_OPTIONS_H
#define WFPSF_OPTIONS_H

#include <math.h>

#include <wfpsf/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_options wfpsf_options;

/** Stands for "chosen by the library" in the list below: a quiet NaN. */
#define WFPSF_AUTOMATIC NAN

/** Kinds of option values. */
enum { WFPSF_OPTION_REAL = 1, WFPSF_OPTION_INTEGER = 2 };

/**
 * X(NAME, key, KIND, default, smallest, largest, text). Keys are pinned and gapped.
 * A default of WFPSF_AUTOMATIC stands for "chosen by the library".
 */
#define WFPSF_OPTION_LIST(X)                                                                       \
    X(EPS, 100, REAL, 1e-6, 1e-12, 0.1,                                                            \
      "largest error of any PSF pixel, in units of the stamp's peak pixel")                        \
    X(STRUTS, 110, INTEGER, 1, 0, 1,                                                               \
      "1: the pupil with its struts; 0: the bare annulus of diameter and obscuration")             \
    X(PSF_RADIUS, 120, REAL, 16, 1, 512,                                                           \
      "half size of the field that a PSF makes in advance, native pixels")                         \
    X(PISTON_TILT, 130, INTEGER, 0, 0, 1,                                                          \
      "1: keep the instrument's Zernike terms 1 to 3, which are dropped otherwise")                \
    X(FRAME, 140, INTEGER, 0, 0, 1,                                                                \
      "axes of a PSF's image: 0, the detector's science coordinates; 1, those of the exit pupil")  \
    X(FIELD_RULE, 150, INTEGER, 0, 0, 1,                                                           \
      "aberrations between field points: 0, all points are met; 1, bilinear between the corners")  \
    X(JITTER_XX, 160, REAL, 0, 0, 1e4, "variance of the telescope's jitter along x, arcsec^2")     \
    X(JITTER_XY, 161, REAL, 0, -1e4, 1e4, "covariance of the jitter along x and y, arcsec^2")      \
    X(JITTER_YY, 162, REAL, 0, 0, 1e4, "variance of the jitter along y, arcsec^2")                 \
    X(CHARGE_DIFFUSION, 170, REAL, 0, 0, 16,                                                       \
      "standard deviation of the Gaussian that charge diffuses over, native pixels")               \
    X(MASK_POINTS, 180, INTEGER, 0, 0, 1,                                                          \
      "1: a mask's pixels are points at their centres, not squares")                               \
    X(PIXEL_RESPONSE, 190, INTEGER, 1, 0, 1,                                                       \
      "1: PSFs are averaged over the native pixel; 0: they are the light at the samples' centres") \
    X(FORCE, 200, INTEGER, 0, 0, 1,                                                                \
      "1: apply an effect even to an image that records it as applied")                            \
    X(IPC_FILL, 210, REAL, 0, -1.7976931348623157e308, 1.7976931348623157e308,                     \
      "value of the border pixels under WFPSF_EDGE_FILL")                                          \
    X(KERNEL_NEGATIVE, 220, INTEGER, 0, 0, 1,                                                      \
      "1: taps outside [0, 1] are allowed, as correction kernels need")                            \
    X(KERNEL_NORMALISE, 230, INTEGER, 0, 0, 1, "1: taps are divided by their sum")                 \
    X(IPC_FORM, 240, INTEGER, 0, 0, 1,                                                             \
      "0: scatter, a convolution with the kernel; 1: gather, a correlation")                       \
    X(IPC_LEAST_MARGIN, 250, REAL, 1e-3, 0, 1,                                                     \
      "min |K^| below which an exact correction is refused")                                       \
    X(IPC_TOLERANCE, 260, REAL, 1e-15, 1e-16, 0.1,                                                 \
      "residual of an exact correction to stop at, over the largest pixel")                        \
    X(IPC_MAX_PASSES, 270, INTEGER, 1000, 1, 1000000, "most passes of an exact correction")        \
    X(MOMENTS_TOLERANCE, 300, REAL, 1e-8, 1e-12, 1e-2,                                             \
      "largest whitened error of centroid and moments")                                            \
    X(MOMENTS_MAX_PASSES, 310, INTEGER, 200, 1, 100000, "most passes over the image")              \
    X(MOMENTS_GUESS_X, 320, REAL, WFPSF_AUTOMATIC, -1e15, 1e15,                                    \
      "first guess of the centroid, pixels of the image, first pixel at 0")                        \
    X(MOMENTS_GUESS_Y, 330, REAL, WFPSF_AUTOMATIC, -1e15, 1e15, "first guess of the centroid")     \
    X(MOMENTS_GUESS_SIGMA, 340, REAL, WFPSF_AUTOMATIC, 1e-3, 1e9,                                  \
      "first guess of the size sigma, pixels of the image")                                        \
    X(MOMENTS_METHOD, 350, INTEGER, 0, 0, 3,                                                       \
      "0: the adaptive weight; 1: least squares at pixel centres, for small stars; 2: a round "    \
      "weight; 3: as 1, with a constant background that is fitted")                                \
    X(MOMENTS_BACKGROUND, 360, REAL, 0, -1.7976931348623157e308, 1.7976931348623157e308,           \
      "constant that is taken off every pixel before adaptive moments")                            \
    X(MOMENTS_VARIANCE, 370, REAL, WFPSF_AUTOMATIC, 0, 1.7976931348623157e308,                     \
      "variance of every pixel's noise, for covariances; automatic: not known")                    \
    X(MOMENTS_RESTART, 380, INTEGER, 1, 0, 1,                                                      \
      "0: fail, rather than start elsewhere, if the first guess leads to no solution")             \
    X(MOMENTS_COVARIANCE_ORDER, 390, INTEGER, 1, 1, 2,                                             \
      "1: covariances to first order in the noise; 2: with the next terms, for S/N 10 to 50")      \
    X(SIZE_TOTAL_FLUX, 400, REAL, WFPSF_AUTOMATIC, 2.2250738585072014e-308,                        \
      1.7976931348623157e308, "flux that counts as 100%; automatic: the sum of all pixels")        \
    X(SIZE_BANDWIDTH, 410, REAL, 0.25, 1e-3, 0.45,                                                 \
      "highest frequency in the image, cycles per pixel of the image")                             \
    X(SIZE_EPS, 420, REAL, 1e-12, 1e-14, 0.1,                                                      \
      "error of a band-limited image's integral, per pixel, in units of the largest pixel")        \
    X(FITS_OVERWRITE, 500, INTEGER, 0, 0, 1, "1: replace an existing file")                        \
    X(THREADS, 600, INTEGER, 1, 1, 1024, "threads that a call may use, the caller's among them")   \
    X(MEMORY_LIMIT, 610, REAL, 4294967296.0, 1e3, 1e15,                                            \
      "bytes that a call may take, about, beside the caller's own images")                         \
    X(SEED, 700, INTEGER, 0, 0, 9007199254740991, "seed of the random numbers")                    \
    X(STREAM, 710, INTEGER, 0, 0, 4294967295, "stream of the seed, such as an exposure's number")  \
    X(ORIGIN_X, 720, INTEGER, 0, -2147483648, 2147483647,                                          \
      "column of the detector that an image's first pixel is in")                                  \
    X(ORIGIN_Y, 730, INTEGER, 0, -2147483648, 2147483647,                                          \
      "row of the detector that an image's first pixel is in")                                     \
    X(NOISE, 740, INTEGER, 1, 0, 1, "0: a chain adds means alone, no Poisson and read noise")      \
    X(WCS_RULE, 800, INTEGER, 0, 0, 1,                                                             \
      "0: the field's distortion inside each detector, the Sun of the ICRS; 1: as GalSim has "     \
      "them")                                                                                      \
    X(PA_OF_FPA, 810, INTEGER, 0, 0, 1,                                                            \
      "1: position angles that are given are the focal plane's, not the observatory's")            \
    X(SCENE_NOISE, 900, REAL, 0.01, 1e-6, 1e6,                                                     \
      "largest error of a scene's pixel, in units of its noise")                                   \
    X(SCENE_VARIANCE, 910, REAL, WFPSF_AUTOMATIC, 1e-12, 1e12,                                     \
      "variance of a pixel's noise beside the sources' own, e-^2; automatic: the instrument's "    \
      "dark current, read noise and SCENE_BACKGROUND")                                             \
    X(SCENE_FLUX, 920, REAL, 1, 1e-6, 1,                                                           \
      "largest share of a source's light left out of its stamp")                                   \
    X(SCENE_BACKGROUND, 930, REAL, 0, 0, 1e9, "mean background of a native pixel, e-")             \
    X(EXPOSURE_TIME, 940, REAL, WFPSF_AUTOMATIC, 1e-3, 1e9,                                        \
      "exposure time, s; automatic: the instrument's own")                                         \
    X(SCENE_EXPOSURES, 950, INTEGER, 1, 1, 1000000,                                                \
      "scenes of the same optics that are expected to share a scene store")

#define WFPSF_OPTION_ENUM(name, key, kind, standard, smallest, largest, text)                      \
    WFPSF_OPTION_##name = (key),
enum { WFPSF_OPTION_LIST(WFPSF_OPTION_ENUM) };
#undef WFPSF_OPTION_ENUM

/**
 * New options, all at their defaults.
 *
 * Returned: out     the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_options_create(wfpsf_options **out);

/** Frees options; NULL is allowed. */
WFPSF_EXPORT void wfpsf_options_destroy(wfpsf_options *options);

/**
 * Sets one option.
 *
 * Given:    key     WFPSF_OPTION_*
 *           value   finite, within the option's bounds
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME (no such key, or an option of the other kind),
 *           ERROR_RANGE, ERROR_NOT_FINITE; the option then keeps its value
 */
WFPSF_EXPORT wfpsf_status wfpsf_options_set_real(wfpsf_options *options, int32_t key, double value);
WFPSF_EXPORT wfpsf_status wfpsf_options_set_integer(wfpsf_options *options, int32_t key,
                                                    int64_t value);

/**
 * Reads one option, whatever its kind, as a double.
 *
 * Given:    key     WFPSF_OPTION_*
 * Returned: value   in the option's own unit; NaN if it is left to the library
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_options_get(const wfpsf_options *options, int32_t key,
                                            double *value);

/**
 * Gives one option its default again.
 *
 * Given:    key     WFPSF_OPTION_*
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_options_reset(wfpsf_options *options, int32_t key);

/**
 * Extra aberrations, added to the instrument's own.
 *
 * Given:    count         0..231
 *           coefficients  Noll order from j = 1, waves rms over the full circle of the primary's
 *                         diameter, at the instrument's reference wavelength; copied
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE
 */
WFPSF_EXPORT wfpsf_status wfpsf_options_set_zernikes(wfpsf_options *options, int64_t count,
                                                     const double *coefficients);

/**
 * A function that long work calls now and then, on the thread that asked for the work.
 *
 * Given:    part  how much is done, 0..1
 *           user  what was given to wfpsf_options_set_progress()
 * Returned: 0 to go on; any other number to stop: the work then fails with ERROR_CANCELLED
 */
typedef int32_t (*wfpsf_progress)(double part, void *user);

/**
 * Sets the progress function; NULL takes it away.
 *
 * Given:    progress  must not throw, nor leave by longjmp()
 *           user      passed on to it
 * Status:   ERROR_NULL
 */
WFPSF_EXPORT wfpsf_status wfpsf_options_set_progress(wfpsf_options *options,
                                                     wfpsf_progress progress, void *user);

/**
 * What is known of an option. Thread-safe.
 *
 * Given:    key                WFPSF_OPTION_*
 * Returned: name, text         static strings: such as "EPS", and what it is, with its unit
 *           kind               WFPSF_OPTION_REAL or WFPSF_OPTION_INTEGER
 *           standard           the default; NaN: chosen by the library
 *           smallest, largest  the bounds, both allowed
 *           Any output may be NULL.
 * Status:   ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_option_describe(int32_t key, const char **name, const char **text,
                                                int32_t *kind, double *standard, double *smallest,
                                                double *largest);

#ifdef __cplusplus
}
#endif

#endif
