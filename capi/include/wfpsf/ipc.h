/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file ipc.h
 * Interpixel capacitance: kernels and their application.
 *
 * Kernels are applied by convolution, out(p) = sum over d of K(d) in(p - d): the paper's Eq. 4.
 * K(d) is the response at distance d of a unit charge. GalSim's applyIPC is a correlation: give it,
 * or take from it, the flipped kernel.
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

/** Frees a kernel; NULL is allowed. */
WFPSF_EXPORT void wfpsf_ipc_kernel_destroy(wfpsf_ipc_kernel *kernel);

/**
 * Size and taps of a kernel.
 *
 * Given:    capacity  numbers that taps has room for; 0 to ask for the size alone
 * Returned: nx, ny    may be NULL
 *           taps      nx * ny numbers, x fastest; untouched if capacity is 0
 * Status:   ERROR_NULL, ERROR_SIZE (capacity neither 0 nor at least nx * ny)
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_taps(const wfpsf_ipc_kernel *kernel, int64_t capacity,
                                                double *taps, int64_t *nx, int64_t *ny);

/**
 * Convolves an image with a kernel whose taps stand one native pixel apart: N samples of an image
 * with oversampling N. On the N x N interleaved dithers of native images that is the same as IPC in
 * each of them. float32 images are summed in double.
 *
 * Given:    kernel, in
 *           edge     WFPSF_EDGE_*
 *           options  IPC_FILL, FORCE
 * Returned: out      an image of the input's type and size (WFPSF_EDGE_VALID: smaller by the
 * kernel's reach, N times nx/2 and ny/2, on each side), sharing no memory with it; its record
 * becomes the input's with IPC (or its correction) added Status:   ERROR_NULL, ERROR_ARGUMENT,
 * ERROR_SIZE, ERROR_TYPE, ERROR_OVERLAP, ERROR_ALREADY_APPLIED
 */
WFPSF_EXPORT wfpsf_status wfpsf_ipc_apply(const wfpsf_ipc_kernel *kernel, const wfpsf_image *in,
                                          int32_t edge, const wfpsf_options *options,
                                          wfpsf_image *out);

#ifdef __cplusplus
}
#endif

#endif
