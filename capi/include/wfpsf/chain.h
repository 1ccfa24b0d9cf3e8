/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file chain.h
 * Detector chains: effects applied to an image in a stated order, each once; and correlated noise.
 *
 * Randomness: what a pixel draws depends on SEED, STREAM, the step's place in the chain and the
 * pixel's place on the detector, (x + ORIGIN_X, y + ORIGIN_Y), alone: not on threads, and not on
 * the tile of the detector that an image is. The generator is Random123's Philox4x32-10.
 *
 * Electrons unless stated. NaN and infinities stay where they are but for IPC, charge diffusion and
 * clipping (-infinity becomes 0).
 *
 * Thread-safety: a chain may be shared once nothing is added to it any more.
 */
#ifndef WFPSF_CHAIN_H
#define WFPSF_CHAIN_H

#include <wfpsf/image.h>
#include <wfpsf/instrument.h>
#include <wfpsf/varying_ipc.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_chain wfpsf_chain;

/** Steps, with their parameters in brackets. */
enum {
    WFPSF_STEP_CLIP_NEGATIVE = 10,    /**< negative pixels become 0 */
    WFPSF_STEP_CHARGE_DIFFUSION = 20, /**< [sigma, pixels] the discrete Gaussian of that variance */
    WFPSF_STEP_BACKGROUND = 30,       /**< [electrons] adds a mean */
    WFPSF_STEP_POISSON_NOISE = 40,    /**< each pixel is a mean; those <= 0 stay */
    WFPSF_STEP_QUANTISATION = 50,     /**< [unit] to the nearest multiple, halves to the even one */
    /** [alpha per decade, exposure time s, base flux e-/s] in (in / (flux time))^(alpha / ln 10);
        0 stays 0, negative pixels become NaN */
    WFPSF_STEP_RECIPROCITY_FAILURE = 60,
    WFPSF_STEP_DARK_CURRENT = 70,     /**< [e-/s, exposure time s] adds a Poisson number */
    WFPSF_STEP_DARK_CURRENT_MAP = 71, /**< [exposure time s] and a map in e-/s */
    /** [share of the latest exposure, of the one before, ...] */
    WFPSF_STEP_PERSISTENCE_LINEAR = 80,
    /** [A e-/s, x0, dx, a, r, half well, exposure time s]: exposure k = 1, 2, ... leaves its
       current at (k - 1/2) exposure times, for one exposure time: A (x/x0)^a (t/1000 s)^-r / (1 +
       exp(-(x-x0)/dx)) from the half well up, linear in x below */
    WFPSF_STEP_PERSISTENCE_FERMI = 81,
    WFPSF_STEP_NONLINEARITY = 90, /**< [c2, c3, ...] in + c2 in^2 + c3 in^3 + ... */
    /** [c2, c3, ...] its inverse on the branch through 0; NaN where there is none */
    WFPSF_STEP_NONLINEARITY_INVERSE = 100,
    WFPSF_STEP_CAPACITANCE_MAP = 110, /**< a map that divides: V = Q / C, the paper's Eq. 1 */
    WFPSF_STEP_IPC = 120,             /**< a kernel */
    WFPSF_STEP_READ_NOISE = 130,      /**< [rms] adds a normal number */
    WFPSF_STEP_SATURATION = 140, /**< [level] pixels at or above it are set to it and counted */
    WFPSF_STEP_GAIN = 150,       /**< [e-/ADU] divides */
    WFPSF_STEP_PIXEL_MASK =
        160 /**< [dead, hot] and a map: 1 is set to dead, 2 to hot, others stay */
};

/**
 * An empty chain.
 *
 * Returned: out     the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_chain_create(wfpsf_chain **out);

/**
 * The chain of an instrument, with its constants. wfirst-afta-c5: Poisson noise, reciprocity
 * failure, rounding, dark current, nonlinearity, IPC, read noise, gain, rounding. roman-c9:
 * clipping of negative pixels, Poisson noise, rounding, reciprocity failure, dark current,
 * persistence (Fermi), nonlinearity, IPC, read noise, gain, rounding.
 *
 * Given:    exposure_time  s, > 0; NaN for the instrument's own
 * Returned: out            the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_chain_create_default(const wfpsf_instrument *instrument,
                                                     double exposure_time, wfpsf_chain **out);

/** Frees a chain; NULL is allowed. */
WFPSF_EXPORT void wfpsf_chain_destroy(wfpsf_chain *chain);

/**
 * Adds a step at the end.
 *
 * Given:    step        WFPSF_STEP_* that takes numbers alone
 *           count       of parameters
 *           parameters  in the units that WFPSF_STEP_* states, finite; may be NULL if count is 0
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_SIZE, ERROR_RANGE, ERROR_NOT_FINITE,
 *           ERROR_ALREADY_APPLIED (the chain has that effect already: all but clipping, rounding,
 *           saturation and masks come once); the chain is then unchanged
 */
WFPSF_EXPORT wfpsf_status wfpsf_chain_add(wfpsf_chain *chain, int32_t step, int64_t count,
                                          const double *parameters);

/**
 * Adds WFPSF_STEP_IPC at the end.
 *
 * Given:    kernel  copied
 *           edge    WFPSF_EDGE_ZERO, _REPLICATE, _WRAP or _CROP
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_ALREADY_APPLIED
 */
WFPSF_EXPORT wfpsf_status wfpsf_chain_add_ipc(wfpsf_chain *chain, const wfpsf_ipc_kernel *kernel,
                                              int32_t edge);

/**
 * Adds WFPSF_STEP_IPC at the end, with kernels that vary over the detector.
 *
 * Given:    varying  may be freed afterwards; of the size of the images to come
 *           form     WFPSF_IPC_SCATTER or _GATHER
 *           edge     as for wfpsf_chain_add_ipc()
 * Status:   as for wfpsf_chain_add_ipc()
 */
WFPSF_EXPORT wfpsf_status wfpsf_chain_add_varying_ipc(wfpsf_chain *chain,
                                                      const wfpsf_varying_ipc *varying,
                                                      int32_t form, int32_t edge);

/**
 * Adds a step with a map at the end: DARK_CURRENT_MAP, CAPACITANCE_MAP or PIXEL_MASK.
 *
 * Given:    count, parameters  as for wfpsf_chain_add()
 *           map                of the size of the images to come; copied as float32
 * Status:   as for wfpsf_chain_add()
 */
WFPSF_EXPORT wfpsf_status wfpsf_chain_add_map(wfpsf_chain *chain, int32_t step, int64_t count,
                                              const double *parameters, const wfpsf_image *map);

/**
 * The steps of a chain, in their order.
 *
 * Given:    index       from 0
 *           capacity    numbers that parameters has room for, >= 0
 * Returned: parameters  the first min(capacity, count) of them, as for wfpsf_chain_add()
 *           count       how many there are; may be NULL
 *           step        WFPSF_STEP_*; 0 past the last step
 * Status:   ERROR_NULL, ERROR_RANGE (index < 0), ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_chain_step(const wfpsf_chain *chain, int64_t index,
                                           int64_t capacity, double *parameters, int64_t *count,
                                           int32_t *step);

/** Name of a step, such as "dark_current"; NULL if there is no such step. Thread-safe. */
WFPSF_EXPORT const char *wfpsf_step_name(int32_t step);

/**
 * Applies a chain to an image, in place. Refused as a whole if the image records one of the effects
 * as applied; those of the chain are added to its record.
 *
 * Given:    chain
 *           image             native pixels: oversampling 1
 *           previous_count    exposures before this one, >= 0
 *           previous          their images of charge, the latest first, of the image's size,
 *                             sharing no memory with it; may be NULL if there are none
 *           options           SEED, STREAM, ORIGIN_X, ORIGIN_Y, NOISE, FORCE, THREADS (the bits are
 *                             the same for any number)
 * Returned: image             its pixels and record
 *           not_finite        pixels that are NaN or infinite at the end; may be NULL
 *           saturated         pixels that saturated; may be NULL
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_SIZE, ERROR_RANGE, ERROR_OVERLAP,
 *           ERROR_ALREADY_APPLIED; the image is then unchanged
 */
WFPSF_EXPORT wfpsf_status wfpsf_chain_apply(const wfpsf_chain *chain, wfpsf_image *image,
                                            int64_t previous_count,
                                            const wfpsf_image *const *previous,
                                            const wfpsf_options *options, int64_t *not_finite,
                                            int64_t *saturated);

/**
 * Adds a realisation of noise to an image: white normal noise through a kernel. The noise goes on
 * beyond the border, so tiles of a detector fit together. Its covariance is rms^2 times the
 * kernel's autocorrelation.
 *
 * Given:    image
 *           rms      of the white noise, in the unit of the pixels, >= 0
 *           kernel   NULL: white noise
 *           options  SEED, STREAM, ORIGIN_X, ORIGIN_Y, THREADS
 * Returned: image    its record is unchanged
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE
 */
WFPSF_EXPORT wfpsf_status wfpsf_noise_add(wfpsf_image *image, double rms,
                                          const wfpsf_ipc_kernel *kernel,
                                          const wfpsf_options *options);

#ifdef __cplusplus
}
#endif

#endif
