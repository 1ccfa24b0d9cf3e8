/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file status.h
 * Status codes and the text of the last error.
 *
 * Every fallible function of wfpsf returns a wfpsf_status:
 *   0          the call did what it says;
 *   negative   error: outputs are untouched, or as the function documents;
 *   positive   warning: the output is valid, but read the text.
 * Values are pinned for ever, gapped, and never reused.
 *
 * Thread-safety: the last-error text belongs to the calling thread.
 */
#ifndef WFPSF_STATUS_H
#define WFPSF_STATUS_H

#include <wfpsf/export.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What became of a call: 0, negative or positive, as said above. */
typedef int32_t wfpsf_status;

/** X(NAME, value, text): the one list that the enum, the texts and every binding are made from. */
#define WFPSF_STATUS_LIST(X)                                                                       \
    X(OK, 0, "success")                                                                            \
    X(WARNING_NOT_CONVERGED, 100, "iteration stopped at its limit before the tolerance was met")   \
    X(WARNING_NOT_CERTIFIED, 110, "the error estimate exceeds the tolerance that was asked for")   \
    X(WARNING_RESTARTED, 120, "solved, but from another start than the one given")                 \
    X(WARNING_NEAR_DEGENERATE, 130, "solved, but the solution is poorly determined")               \
    X(WARNING_UNDERSAMPLED, 140,                                                                   \
      "solved, but the object is so small that its pixels' places count")                          \
    X(ERROR_NULL, -10, "a required pointer is NULL")                                               \
    X(ERROR_ARGUMENT, -20, "an argument has a value that is not one of those allowed")             \
    X(ERROR_RANGE, -30, "an argument lies outside its allowed range")                              \
    X(ERROR_SIZE, -40, "the sizes or strides of an array do not fit")                              \
    X(ERROR_TYPE, -50, "the pixel types of two images differ")                                     \
    X(ERROR_NOT_FINITE, -60, "a number that must be finite is NaN or infinite")                    \
    X(ERROR_UNKNOWN_NAME, -70, "no instrument, band, constant, option or property of that name")   \
    X(ERROR_OVERLAP, -80, "input and output share memory")                                         \
    X(ERROR_ALREADY_APPLIED, -90, "the image records that this effect was applied before")         \
    X(ERROR_KERNEL, -100, "the taps do not make an IPC kernel")                                    \
    X(ERROR_KERNEL_SINGULAR, -110, "the IPC kernel comes too close to zero to be undone")          \
    X(ERROR_SKY_SUN, -120, "the Sun is too close for a sky level")                                 \
    X(ERROR_SUN_ANGLE, -130, "the angle between the Sun and the line of sight is not allowed")     \
    X(ERROR_NO_WCS, -140, "the instrument's detectors have no places on the sky")                  \
    X(ERROR_FILE_OPEN, -200, "a file cannot be opened")                                            \
    X(ERROR_FILE_FORMAT, -210, "a file does not hold what it should")                              \
    X(ERROR_FILE_WRITE, -220, "a file cannot be written")                                          \
    X(ERROR_MOMENTS_NO_PIXELS, -300, "no pixel lies within reach of the weight function")          \
    X(ERROR_MOMENTS_FLUX, -310, "the weighted flux is not positive")                               \
    X(ERROR_MOMENTS_UNRESOLVED, -320, "the object is too small for its pixels: no solution")       \
    X(ERROR_MOMENTS_FILLS_IMAGE, -330, "the weight outgrew the image: no object of finite size")   \
    X(ERROR_MOMENTS_OUTSIDE, -340, "the centroid left the image")                                  \
    X(ERROR_MOMENTS_STALLED, -350, "the iteration stands at a point that is not a maximum")        \
    X(ERROR_SIZE_NOT_REACHED, -400, "the image does not hold the fraction of light asked for")     \
    X(ERROR_CANCELLED, -500, "the caller's progress function asked to stop")                       \
    X(ERROR_MEMORY_LIMIT, -510, "the work needs more memory than the option MEMORY_LIMIT allows")  \
    X(ERROR_NO_MEMORY, -900, "memory ran out")                                                     \
    X(ERROR_INTERNAL, -910, "an unexpected failure inside the library: please report it")          \
    X(ERROR_ABI, -920, "the program was compiled for another ABI than the loaded library's")

#define WFPSF_STATUS_ENUM(name, value, text) WFPSF_##name = (value),
enum { WFPSF_STATUS_LIST(WFPSF_STATUS_ENUM) };
#undef WFPSF_STATUS_ENUM

/**
 * Name of a status code, such as "WFPSF_ERROR_RANGE".
 *
 * Given:    status  any number
 * Returned: a static string; "unknown status" if there is no such code
 * Thread-safe.
 */
WFPSF_EXPORT const char *wfpsf_status_name(wfpsf_status status);

/**
 * One line of English on a status code. Arguments and result as in wfpsf_status_name().
 * Thread-safe.
 */
WFPSF_EXPORT const char *wfpsf_status_string(wfpsf_status status);

/**
 * The line that the last failing or warning call of this thread left: it names the argument, its
 * value and the allowed range. A call that succeeds leaves it as it is.
 *
 * Given:    length  size of buffer in bytes, >= 0
 * Returned: buffer  the line, cut to length - 1 bytes and closed by NUL; may be NULL if length is 0
 *           the length of the whole line in bytes, without the NUL
 * Thread-safe: each thread has its own line.
 */
WFPSF_EXPORT int64_t wfpsf_last_error(char *buffer, int64_t length);

#ifdef __cplusplus
}
#endif

#endif
