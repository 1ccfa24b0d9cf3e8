/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file exposure.h
 * Exposures: the scenes of all detectors of a focal plane, with background and detector effects,
 * each in a FITS file of its own.
 *
 *     wfpsf_exposure_create(roman, observation, "J129", catalogue, NULL, options, &exposure);
 *     for (sca = 1; sca <= 18; ++sca)
 *         wfpsf_exposure_make(exposure, sca, folder, options, NULL);
 *
 * A file appears whole or not at all, and carries a fingerprint of all that it was made of. So a
 * program that was broken off is run again: what is there is kept, what is not is made, and nothing
 * is made twice. Detectors may be shared out among programs and machines in any way; the files are
 * the same. The header holds the WCS, the record of effects, and what the scene's budget came to.
 *
 * Thread-safety: an exposure is immutable; many threads may make detectors of one.
 */
#ifndef WFPSF_EXPOSURE_H
#define WFPSF_EXPOSURE_H

#include <wfpsf/chain.h>
#include <wfpsf/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_exposure wfpsf_exposure;

/**
 * An exposure.
 *
 * Given:    instrument   one with places on the sky; this and all others may be freed afterwards
 *           observation  of the instrument
 *           band         such as "J129"
 *           catalogue    copied
 *           chain        what the detectors do, after SCENE_BACKGROUND is added; NULL: nothing,
 *                        files hold the mean electrons of sources and background
 *           options      those of wfpsf_scene_create(); SEED; STREAM: the exposure's number, 0 to
 *                        67108862, which goes into file names and noise; NOISE
 * Returned: out          the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME, ERROR_RANGE, ERROR_ARGUMENT, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_exposure_create(const wfpsf_instrument *instrument,
                                                const wfpsf_observation *observation,
                                                const char *band, const wfpsf_catalogue *catalogue,
                                                const wfpsf_chain *chain,
                                                const wfpsf_options *options, wfpsf_exposure **out);

/** Frees an exposure; NULL is allowed. */
WFPSF_EXPORT void wfpsf_exposure_destroy(wfpsf_exposure *exposure);

/**
 * The path of a detector's file, such as "folder/exposure_00001_sca07.fits".
 *
 * Given:    folder    its path
 *           sca       1..n_sca
 *           capacity  bytes that `text` has room for, >= 0
 * Returned: text      the first capacity - 1 characters, closed by NUL; may be NULL if capacity is 0
 *           length    of the whole text, without the NUL; may be NULL
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_exposure_path(const wfpsf_exposure *exposure, const char *folder,
                                              int32_t sca, int64_t capacity, char *text,
                                              int64_t *length);

/**
 * Makes a detector's file, if it is not there.
 *
 * Given:    sca      1..n_sca
 *           folder   one that exists
 *           options  FITS_OVERWRITE, THREADS (no bit of the file depends on it), MEMORY_LIMIT and
 *                    the progress function
 * Returned: made     1; 0: the file was there, made of the same. May be NULL
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_CANCELLED, ERROR_MEMORY_LIMIT, ERROR_NO_MEMORY,
 *           ERROR_FILE_WRITE (also if a file is there that was made of other things, unless
 *           FITS_OVERWRITE is 1), those of wfpsf_scene_create() and wfpsf_chain_apply(). There is
 *           then no new file
 */
WFPSF_EXPORT wfpsf_status wfpsf_exposure_make(const wfpsf_exposure *exposure, int32_t sca,
                                              const char *folder, const wfpsf_options *options,
                                              int32_t *made);

#ifdef __cplusplus
}
#endif

#endif
