/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file varying_ipc.h
 * Interpixel capacitance whose kernel varies from pixel to pixel over a detector.
 *
 * K_q(d) is the kernel of pixel q, from maps of the paper's parameters, from polynomials over the
 * detector, or from regions with a kernel each. IPC_FORM says how kernels are applied:
 *   WFPSF_IPC_SCATTER, the default  out(p) = sum over d of K_(p-d)(d) in(p - d): each charge is
 *                                   spread by its own pixel's kernel; charge is conserved
 *   WFPSF_IPC_GATHER                out(p) = sum over d of K_p(d) in(p + d): each pixel collects by
 *                                   its own kernel, the transpose; charge is not conserved
 * If all kernels are one, both are what wfpsf_ipc_apply() makes of it, to rounding.
 *
 * Thread-safety: immutable; it may be shared.
 */
#ifndef WFPSF_VARYING_IPC_H
#define WFPSF_VARYING_IPC_H

#include <wfpsf/ipc.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_varying_ipc wfpsf_varying_ipc;

/**
 * The 3 x 3 kernels of wfpsf_ipc_kernel_create() from maps of their parameters.
 *
 * Given:    alpha                    finite, of the detector's size; copied in its type
 *           alpha_prime, alpha_plus  the same; NULL: 0 everywhere
 *           options                  KERNEL_NEGATIVE
 * Returned: out                      the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_SIZE (maps of different sizes), ERROR_NOT_FINITE, ERROR_KERNEL (a tap
 *           of a pixel outside [0, 1]), ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_create_maps(const wfpsf_image *alpha,
                                                        const wfpsf_image *alpha_prime,
                                                        const wfpsf_image *alpha_plus,
                                                        const wfpsf_options *options,
                                                        wfpsf_varying_ipc **out);

/**
 * The same from polynomials in X = (2x + 1 - nx) / nx and Y = (2y + 1 - ny) / ny, which run from -1
 * to 1 between the outer borders of the outermost pixels.
 *
 * Given:    nx, ny                   of the detector, >= 0
 *           degree                   0..20
 *           alpha                    (degree + 1) (degree + 2) / 2 coefficients of X^i Y^j by
 *                                    growing i + j, then by growing j: 1, X, Y, X^2, XY, Y^2, ...
 *           alpha_prime, alpha_plus  the same; NULL: 0 everywhere
 *           options                  KERNEL_NEGATIVE
 * Returned: out                      the handle; NULL on failure
 * Status:   as for wfpsf_varying_ipc_create_maps(); ERROR_RANGE
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_create_polynomials(
    int64_t nx, int64_t ny, int64_t degree, const double *alpha, const double *alpha_prime,
    const double *alpha_plus, const wfpsf_options *options, wfpsf_varying_ipc **out);

/**
 * One kernel per region, of any sizes.
 *
 * Given:    regions  of the detector's size: pixel (x, y) has kernels[regions(x, y)]
 *           count    of kernels, >= 0
 *           kernels  copied
 * Returned: out      the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_SIZE, ERROR_RANGE (a pixel that is not a whole number of
 *           0..count-1), ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_create_regions(const wfpsf_image *regions,
                                                           int64_t count,
                                                           const wfpsf_ipc_kernel *const *kernels,
                                                           wfpsf_varying_ipc **out);

/** Frees varying IPC; NULL is allowed. */
WFPSF_EXPORT void wfpsf_varying_ipc_destroy(wfpsf_varying_ipc *varying);

/**
 * The kernel of one pixel.
 *
 * Given:    x, y    within the detector
 * Returned: out     the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_kernel(const wfpsf_varying_ipc *varying, int64_t x,
                                                   int64_t y, wfpsf_ipc_kernel **out);

/**
 * The least stability margin, min |K^|, of any pixel's kernel, and the first pixel that has it.
 *
 * Returned: margin  dimensionless; 0 if a transform has a zero
 *           x, y    may be NULL
 * Status:   ERROR_NULL
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_margin(const wfpsf_varying_ipc *varying, double *margin,
                                                   int64_t *x, int64_t *y);

/**
 * Applies varying IPC. Sums are double. NaN and infinities spread to the pixels within reach of the
 * kernels and no further. WFPSF_EDGE_REPLICATE continues the kernels as it does pixels.
 *
 * Given:    in       native pixels, oversampling 1, of the detector's size
 *           edge     WFPSF_EDGE_*
 *           options  IPC_FORM, IPC_FILL, FORCE, THREADS (the bits are the same for any number)
 * Returned: out, not_finite  as for wfpsf_ipc_apply(); out may be `in` itself, which costs a copy
 * Status:   as for wfpsf_ipc_apply()
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_apply(const wfpsf_varying_ipc *varying,
                                                  const wfpsf_image *in, int32_t edge,
                                                  const wfpsf_options *options, wfpsf_image *out,
                                                  int64_t *not_finite);

/**
 * Undoes varying IPC: out is the image that wfpsf_varying_ipc_apply() turns into `in`, with the
 * same edge, by Chebyshev's iteration. Arguments as of wfpsf_ipc_correct(), but for
 *
 * Returned: noise_amplification  measured on random numbers, over 65536 pixels or the image if it
 *                                is larger (of small images 64 times their pixels): it scatters by
 *                                less than its value over the square root of their number. It costs
 *                                about a third of the correction; NULL spares that.
 * Status:   as for wfpsf_ipc_correct(); ERROR_KERNEL_SINGULAR if wfpsf_varying_ipc_margin() is
 *           below IPC_LEAST_MARGIN, or if a transform is not positive
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_correct(const wfpsf_varying_ipc *varying,
                                                    const wfpsf_image *in, int32_t edge,
                                                    const wfpsf_options *options, wfpsf_image *out,
                                                    double *residual, double *noise_amplification,
                                                    int64_t *passes, int64_t *not_finite);

/**
 * Covariance of two pixels after varying IPC, for noise that is independent from pixel to pixel
 * before it. Scattered, cov(p, p + lag) = sum over d of K_q(d) K_q(d + lag) variance(q), q = p - d;
 * gathered, sum over d of K_p(d) K_(p+lag)(d - lag) variance(p + d). Arguments, output and status
 * as of wfpsf_ipc_covariance().
 *
 * Given:    variance  of the detector's size, oversampling 1
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_covariance(const wfpsf_varying_ipc *varying,
                                                       const wfpsf_image *variance, int64_t lag_x,
                                                       int64_t lag_y, int32_t edge,
                                                       const wfpsf_options *options,
                                                       wfpsf_image *out);

/**
 * The autocorrelation of noise about one pixel: its covariance, after varying IPC, with each pixel
 * that it may covary with, and with itself.
 *
 * Given:    variance     as for wfpsf_varying_ipc_covariance(); NULL: 1 everywhere
 *           x, y         within the detector
 *           edge         WFPSF_EDGE_ZERO or _WRAP
 *           options      IPC_FORM
 *           capacity     numbers that covariances has room for; 0 to ask for the size alone
 * Returned: covariances  cov(p, p + d) at [(dy + ny/2) * nx + dx + nx/2]; 0 where p + d is not a
 *                        pixel; untouched if capacity is 0
 *           nx, ny       one less than twice the size of the largest kernel; may be NULL
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_RANGE, ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_autocorrelation(const wfpsf_varying_ipc *varying,
                                                            const wfpsf_image *variance, int64_t x,
                                                            int64_t y, int32_t edge,
                                                            const wfpsf_options *options,
                                                            int64_t capacity, double *covariances,
                                                            int64_t *nx, int64_t *ny);

#ifdef __cplusplus
}
#endif

#endif
