/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file ipc.h
 * Interpixel capacitance: kernels and their application.
 *
 * K(d) is the response at distance d of a unit charge: kernels are applied by convolution,
 * out(p) = sum over d of K(d) in(p - d), the paper's Eq. 4, unless IPC_FORM says otherwise.
 *
 * Thread-safety: a kernel is immutable and may be shared.
 */
#ifndef WFPSF_IPC_H
#define WFPSF_IPC_H

#include <wfpsf/image.h>
#include <wfpsf/instrument.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_ipc_kernel wfpsf_ipc_kernel;

/** Which way a kernel is applied. */
enum { WFPSF_IPC_SCATTER = 0, WFPSF_IPC_GATHER = 1 };

/** What lies beyond the border of an image. */
enum {
    WFPSF_EDGE_ZERO = 0,      /**< no charge outside: charge is lost at the border */
    WFPSF_EDGE_REPLICATE = 1, /**< the nearest pixel */
    WFPSF_EDGE_WRAP = 2,      /**< the other side: charge is conserved */
    WFPSF_EDGE_CROP = 3, /**< pixels within the kernel's reach of the border keep their value */
    WFPSF_EDGE_FILL = 4, /**< such pixels get WFPSF_OPTION_IPC_FILL */
    WFPSF_EDGE_VALID = 5 /**< such pixels are left out: the output is smaller */
};

/**
 * The paper's 3 x 3 kernels (Eqs. 7-9): alpha to the four nearest neighbours, alpha_prime to the
 * four diagonal ones, and alpha_plus more along x, less along y.
 *
 * Given:    alpha, alpha_prime, alpha_plus  finite
 *           options  KERNEL_NEGATIVE
 * Returned: out      the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_KERNEL (a tap outside [0, 1]), ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create(double alpha, double alpha_prime,
                                                  double alpha_plus, const wfpsf_options *options,
                                                  wfpsf_ipc_kernel **out);

/**
 * A kernel from its taps. They must lie in [0, 1] and sum to 1 within 1e-12.
 *
 * Given:    nx, ny   odd
 *           taps     x fastest: taps[(dy + ny/2) * nx + dx + nx/2] = K(dx, dy)
 *           options  KERNEL_NEGATIVE, KERNEL_NORMALISE
 * Returned: out      the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_SIZE, ERROR_NOT_FINITE, ERROR_KERNEL, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_taps(int64_t nx, int64_t ny, const double *taps,
                                                       const wfpsf_options *options,
                                                       wfpsf_ipc_kernel **out);

/**
 * The kernel measured for WFC3/IR (paper, Eq. 11), divided by its printed sum of 0.9985.
 * Status as for wfpsf_ipc_kernel_create().
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_wfc3(wfpsf_ipc_kernel **out);

/**
 * The instrument's own default kernel, as a convolution.
 * Status as for wfpsf_ipc_kernel_create().
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_default(const wfpsf_instrument *instrument,
                                                          wfpsf_ipc_kernel **out);

/**
 * The first-order correction (paper, Eq. 12): every tap's sign reversed but for the centre, which
 * makes the sum 1. It undoes the kernel to second order in the coupling.
 * Status as for wfpsf_ipc_kernel_create().
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_correction(const wfpsf_ipc_kernel *kernel,
                                                             wfpsf_ipc_kernel **out);

/**
 * K(-d): convolution with it is correlation with K.
 * Status as for wfpsf_ipc_kernel_create().
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_flipped(const wfpsf_ipc_kernel *kernel,
                                                          wfpsf_ipc_kernel **out);

/**
 * A kernel from a FITS image of its taps: NAXIS1 runs along x, the middle pixel is K(0, 0).
 *
 * Given:    path, hdu  as for wfpsf_image_read_fits()
 *           options    KERNEL_NEGATIVE, KERNEL_NORMALISE
 * Returned: out        the handle; NULL on failure
 * Status:   those of wfpsf_image_read_fits() and wfpsf_ipc_kernel_create_taps()
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_read_fits(const char *path, const char *hdu,
                                                     const wfpsf_options *options,
                                                     wfpsf_ipc_kernel **out);

/**
 * One kernel that does what `first` does and then `second`, image borders aside. Its application is
 * recorded as that of both.
 * Status as for wfpsf_ipc_kernel_create(); ERROR_SIZE (more than 1023 taps along an axis)
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_composed(const wfpsf_ipc_kernel *first,
                                                           const wfpsf_ipc_kernel *second,
                                                           wfpsf_ipc_kernel **out);

/**
 * The correction of order n: the sum of (delta - K)^k, k = 0..n, Neumann's series. It undoes the
 * kernel to order n + 1 in the coupling; order 1 is wfpsf_ipc_kernel_create_correction().
 *
 * Given:    order  >= 0
 * Status:   as for wfpsf_ipc_kernel_create(); ERROR_RANGE, ERROR_SIZE (more than 1023 taps along
 *           an axis)
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_neumann(const wfpsf_ipc_kernel *kernel,
                                                          int64_t order, wfpsf_ipc_kernel **out);

/**
 * A(l) = sum over d of K(d) K(d + l): what white noise of variance 1 has as its covariance at lag l
 * after the kernel. Noise that enters before IPC and is corrected afterwards has that of the
 * composed kernel; read and quantisation noise, which enter after IPC, that of the correction.
 * Status as for wfpsf_ipc_kernel_create(); ERROR_SIZE (more than 1023 taps along an axis)
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_autocorrelation(const wfpsf_ipc_kernel *kernel,
                                                                  wfpsf_ipc_kernel **out);

/**
 * Standard deviations of the taps measured for WFC3/IR (paper, Eq. 11), divided as the kernel is.
 *
 * Given:    capacity    numbers that deviations has room for, >= 9
 * Returned: deviations  of the taps of wfpsf_ipc_kernel_create_wfc3(), in their order, shares too
 * Status:   ERROR_NULL, ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_wfc3_deviations(int64_t capacity, double *deviations);

/** Frees a kernel; NULL is allowed. */
WFPSF_EXPORT void wfpsf_ipc_kernel_destroy(wfpsf_ipc_kernel *kernel);

/**
 * Size and taps of a kernel.
 *
 * Given:    capacity  numbers that taps has room for; 0 to ask for the size alone
 * Returned: nx, ny    may be NULL
 *           taps      nx * ny shares of a charge, x fastest; untouched if capacity is 0
 * Status:   ERROR_NULL, ERROR_SIZE (capacity neither 0 nor at least nx * ny)
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_taps(const wfpsf_ipc_kernel *kernel, int64_t capacity,
                                                double *taps, int64_t *nx, int64_t *ny);

/** X(NAME, key, text): what wfpsf_ipc_kernel_get() knows of a kernel. Keys are pinned and gapped.
 */
#define WFPSF_KERNEL_PROPERTY_LIST(X)                                                              \
    X(SUM, 10, "sum of the taps")                                                                  \
    X(CENTROID_X, 20, "centroid along x, pixels; it moves every image by as much")                 \
    X(CENTROID_Y, 30, "centroid along y, pixels")                                                  \
    X(MXX, 40, "second moment about the centroid, pixels^2; it adds to every image's")             \
    X(MXY, 50, "second moment about the centroid, pixels^2")                                       \
    X(MYY, 60, "second moment about the centroid, pixels^2")                                       \
    X(LEFT_RIGHT, 100, "largest difference between K(dx, dy) and K(-dx, dy)")                      \
    X(UP_DOWN, 110, "largest difference between K(dx, dy) and K(dx, -dy)")                         \
    X(HALF_TURN, 120, "largest difference between K(d) and K(-d): 0 if scatter is gather")         \
    X(TRANSPOSED, 130,                                                                             \
      "largest difference between K(dx, dy) and K(dy, dx); infinite unless square")                \
    X(MARGIN, 200, "min |K^| over all frequencies")                                                \
    X(MARGIN_FREQUENCY_X, 210, "where it is met, cycles per pixel")                                \
    X(MARGIN_FREQUENCY_Y, 220, "where it is met, cycles per pixel")                                \
    X(VARIANCE_RATIO, 300, "variance of white noise after the kernel over that before")            \
    X(CONVERSION_GAIN_BIAS, 310,                                                                   \
      "relative error of the conversion gain (signal per electron) from "                          \
      "mean and variance if the kernel is ignored")                                                \
    X(QUANTUM_EFFICIENCY_BIAS, 320, "relative error of the quantum efficiency that follows")       \
    X(INVERSE_NOISE, 330, "rms of white noise after the exact inverse over that before")

#define WFPSF_KERNEL_PROPERTY_ENUM(name, key, text) WFPSF_KERNEL_##name = (key),
enum { WFPSF_KERNEL_PROPERTY_LIST(WFPSF_KERNEL_PROPERTY_ENUM) };
#undef WFPSF_KERNEL_PROPERTY_ENUM

/**
 * A property of a kernel.
 *
 * Given:    key    WFPSF_KERNEL_*
 * Returned: value  in the unit that the list states
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_get(const wfpsf_ipc_kernel *kernel, int32_t key,
                                               double *value);

/**
 * The transform K^(f) = sum over d of K(d) exp(-2 pi i f . d).
 *
 * Given:    frequency_x, frequency_y  finite, cycles per pixel
 * Returned: real_part, imaginary_part  dimensionless; 1 and 0 at frequency 0
 * Status:   ERROR_NULL, ERROR_NOT_FINITE
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_transform(const wfpsf_ipc_kernel *kernel,
                                                     double frequency_x, double frequency_y,
                                                     double *real_part, double *imaginary_part);

/**
 * Applies a kernel whose taps stand one native pixel apart: N samples of an image with oversampling
 * N. On the N x N interleaved dithers of native images that is the same as IPC in each of them.
 *
 * IPC_FORM says which way: WFPSF_IPC_SCATTER, the default, spreads each charge by the kernel,
 * out(p) = sum of K(d) in(p - d), a convolution; WFPSF_IPC_GATHER collects by it, out(p) = sum of
 * K(d) in(p + d), a correlation, as GalSim's applyIPC does. wfpsf_ipc_kernel_self_test() shows it.
 *
 * Sums are double. In a float32 image, a 3 x 3 kernel whose neighbours add up to at most 1/8 has
 * their share, not the centre's, summed in single precision: its error stays below 2^-24 of the
 * largest neighbour. NaN and infinities spread to the pixels that they couple to and no further.
 *
 * Given:    kernel, in
 *           edge     WFPSF_EDGE_*
 *           options  IPC_FORM, IPC_FILL, FORCE, THREADS (the bits are the same for any number)
 * Returned: out      an image of the input's type and size (WFPSF_EDGE_VALID: smaller by the
 *                    kernel's reach, N times nx/2 and ny/2, on each side). It may be `in` itself,
 *                    else it shares no memory with it; its record becomes the input's with IPC (or
 *                    its correction) added
 *           not_finite  count of pixels of out that are NaN or infinite; may be NULL
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_SIZE, ERROR_TYPE, ERROR_OVERLAP,
 *           ERROR_ALREADY_APPLIED
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_apply(const wfpsf_ipc_kernel *kernel, const wfpsf_image *in,
                                          int32_t edge, const wfpsf_options *options,
                                          wfpsf_image *out, int64_t *not_finite);

/**
 * What wfpsf_ipc_apply() makes of one unit of charge: to be looked at before a kernel is believed.
 *
 * Given:    options   IPC_FORM
 *           capacity  numbers that response has room for, >= nx * ny of the kernel
 * Returned: response  shares of the charge: the signal dx right of it and dy above it stands at
 *                     [(dy + ny/2) * nx + dx + nx/2]
 * Status:   ERROR_NULL, ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_self_test(const wfpsf_ipc_kernel *kernel,
                                                     const wfpsf_options *options, int64_t capacity,
                                                     double *response);

/**
 * Undoes IPC exactly: out is the image that wfpsf_ipc_apply() turns into `in`, with the same edge.
 * Solved by Chebyshev's iteration, or by a transform where that would be slow and a transform has
 * the inverse exactly: WFPSF_EDGE_WRAP, or 3 x 3 kernels that are symmetric left-right and up-down.
 *
 * Pixels that are NaN or infinite count as 0 and stay as they are.
 *
 * Given:    kernel, in
 *           edge     WFPSF_EDGE_ZERO, _REPLICATE or _WRAP
 *           options  IPC_FORM, IPC_LEAST_MARGIN, IPC_TOLERANCE, IPC_MAX_PASSES, FORCE, THREADS
 * Returned: out                  an image of the input's type and size; it may be `in` itself
 *           residual             max |in - K out| / max |in|, before out is rounded to its type;
 *                                out is off by at most about residual / margin
 *           noise_amplification  rms of white noise in out over that in `in`
 *           passes               over the image; 0 if solved by a transform
 *           not_finite           count of pixels that are NaN or infinite
 *           All but out may be NULL.
 * Status:   as for wfpsf_ipc_apply(); ERROR_KERNEL_SINGULAR (min |K^| below IPC_LEAST_MARGIN, or a
 *           transform that is not positive and an edge that has none); WARNING_NOT_CONVERGED (the
 *           residual is above IPC_TOLERANCE and could still shrink)
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_correct(const wfpsf_ipc_kernel *kernel, const wfpsf_image *in,
                                            int32_t edge, const wfpsf_options *options,
                                            wfpsf_image *out, double *residual,
                                            double *noise_amplification, int64_t *passes,
                                            int64_t *not_finite);

/**
 * Covariance of two pixels after a kernel, for noise that is independent from pixel to pixel before
 * it: cov(p, p + lag) = sum over d of K(d) K(d + lag) variance(p - d). In a periodic image that is
 * smaller than the kernel, the lags that come to the same add up.
 *
 * Given:    kernel
 *           variance      per pixel, before the kernel; any record
 *           lag_x, lag_y  native pixels; (0, 0) for the map of the variance
 *           edge          WFPSF_EDGE_ZERO or _WRAP
 *           options       IPC_FORM, THREADS
 * Returned: out           the covariance, 0 where p + lag is not a pixel; as for wfpsf_ipc_apply(),
 *                         but its record is the input's
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_SIZE, ERROR_TYPE, ERROR_OVERLAP
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_covariance(const wfpsf_ipc_kernel *kernel,
                                               const wfpsf_image *variance, int64_t lag_x,
                                               int64_t lag_y, int32_t edge,
                                               const wfpsf_options *options, wfpsf_image *out);

#ifdef __cplusplus
}
#endif

#endif
