/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file instrument.h
 * Instruments: the figures of a telescope and its detectors. The published ones are compiled in;
 * design.h makes others from figures of your own.
 *
 * Known: "wfirst-afta-c5", the paper's (WFIRST-AFTA Cycle 5, July 2015), and "roman-c9" (Roman
 * Wide Field Instrument, Cycle 9).
 * Thread-safety: an instrument is immutable; every function here is thread-safe.
 */
#ifndef WFPSF_INSTRUMENT_H
#define WFPSF_INSTRUMENT_H

#include <wfpsf/image.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_instrument wfpsf_instrument;

/** Which curve the limits and effective wavelength of a band are taken from. */
enum {
    /** The tabulated throughput: first and last zero; mean of the piecewise linear curve. */
    WFPSF_BAND_TABULATED = 1,
    /** The same table thinned as GalSim 1.3.0 does: for C5, the figures of the paper's Table 1. */
    WFPSF_BAND_PAPER = 2
};

/**
 * An instrument by name.
 *
 * Given:    name  "wfirst-afta-c5" or "roman-c9"
 * Returned: out   the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_instrument_create(const char *name, wfpsf_instrument **out);

/** Frees an instrument; NULL is allowed. */
WFPSF_EXPORT void wfpsf_instrument_destroy(wfpsf_instrument *instrument);

/**
 * A constant by name, such as "diameter" (m) or "pixel_scale" (arcsec). An instrument made from a
 * design has "diameter", "obscuration", "pixel_scale", "n_sca", "n_pix" (the longer side),
 * "n_pix_x", "n_pix_y", "zemax_wavelength" (the reference wavelength, nm) and "zernike_jmax".
 *
 * Returned: value, unit  unit is a static string, may be asked for with NULL
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_instrument_constant(const wfpsf_instrument *instrument,
                                                    const char *name, double *value,
                                                    const char **unit);

/**
 * The name of the index-th constant, or of the index-th band, in order of wavelength or as a design
 * lists them; a string that lives as long as the instrument, NULL when the index is past the last
 * one or the handle is NULL.
 */
WFPSF_EXPORT const char *wfpsf_instrument_constant_name(const wfpsf_instrument *instrument,
                                                        int64_t index);
WFPSF_EXPORT const char *wfpsf_instrument_band_name(const wfpsf_instrument *instrument,
                                                    int64_t index);

/**
 * Limits and effective (throughput-weighted mean) wavelength of a band (paper, Table 1).
 *
 * Given:    band  such as "J129"
 *           rule  WFPSF_BAND_*
 * Returned: blue_nm, red_nm, effective_nm  any may be NULL
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME, ERROR_ARGUMENT
 */
WFPSF_EXPORT wfpsf_status wfpsf_instrument_band(const wfpsf_instrument *instrument,
                                                const char *band, int32_t rule, double *blue_nm,
                                                double *red_nm, double *effective_nm);

/**
 * Throughput of a band, linear between tabulated points, zero outside.
 *
 * Given:    count          of wavelengths, >= 0
 *           wavelength_nm  finite
 * Returned: throughput     dimensionless, count numbers
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME, ERROR_SIZE, ERROR_NOT_FINITE
 */
WFPSF_EXPORT wfpsf_status wfpsf_instrument_throughput(const wfpsf_instrument *instrument,
                                                      const char *band, int64_t count,
                                                      const double *wavelength_nm,
                                                      double *throughput);

/**
 * Aberrations at the centre of a detector.
 *
 * Given:    sca           1..n_sca
 *           capacity      numbers that `coefficients` has room for, >= 0
 * Returned: coefficients  Noll order from j = 1, waves rms over the full circle at the constant
 *                         "zemax_wavelength"; the first min(capacity, count)
 *           count         how many there are; may be NULL
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_SIZE
 */
WFPSF_EXPORT wfpsf_status wfpsf_instrument_zernikes(const wfpsf_instrument *instrument, int32_t sca,
                                                    int64_t capacity, double *coefficients,
                                                    int64_t *count);

/**
 * A pupil as an image: every pixel the lit fraction of its area, to 1e-8. The pupil stands in the
 * middle of the image and fills its shorter side. Handed to wfpsf_psf_create_from_mask(), it gives
 * the PSF by other means than the pupil's geometry does, with an error that falls as the square of
 * the pixel.
 *
 * Roman's pupils are those of the exit pupil, y up, as published; C5's as its mask is.
 *
 * Given:    band            such as "J129"
 *           sca             1..n_sca
 *           options         STRUTS
 * Returned: out             transmissions 0..1, overwritten; the record is left alone
 *           scale_m         side of a pixel, metres
 *           axis_x, axis_y  where the optical axis is, pixels, the first one's centre at (0, 0)
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME, ERROR_RANGE, ERROR_SIZE (an empty image),
 *           ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_instrument_pupil(const wfpsf_instrument *instrument,
                                                 const char *band, int32_t sca,
                                                 const wfpsf_options *options, wfpsf_image *out,
                                                 double *scale_m, double *axis_x, double *axis_y);

#ifdef __cplusplus
}
#endif

#endif
