/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file sed.h
 * Spectral energy distributions: how a source's light is spread over wavelength, up to a factor.
 *
 * Thread-safety: an SED is immutable; every function here is thread-safe.
 */
#ifndef WFPSF_SED_H
#define WFPSF_SED_H

#include <wfpsf/status.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_sed wfpsf_sed;

/** What a density counts, per unit of wavelength. */
enum {
    /** Photons: f_photon, photons/s/m^2/nm or any multiple of it. */
    WFPSF_SED_PHOTONS = 1,
    /** Energy: f_lambda, W/m^2/nm or any multiple of it. */
    WFPSF_SED_ENERGY = 2
};

/**
 * A tabulated SED, linear between its samples. A PSF can be made of it in bands that the table
 * covers.
 *
 * Given:    unit           WFPSF_SED_*
 *           count          of samples, >= 2
 *           wavelength_nm  rising, > 0
 *           density        >= 0, in any unit
 * Returned: out            the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_SIZE, ERROR_RANGE, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_sed_create_table(int32_t unit, int64_t count,
                                                 const double *wavelength_nm, const double *density,
                                                 wfpsf_sed **out);

/**
 * A density proportional to wavelength^exponent. Flat in photons: PHOTONS, 0; flat in f_lambda:
 * ENERGY, 0; flat in f_nu, an AB source: ENERGY, -2.
 *
 * Given:    unit      WFPSF_SED_*
 *           exponent  dimensionless, -100..100
 * Returned: out       the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_RANGE, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_sed_create_power_law(int32_t unit, double exponent,
                                                     wfpsf_sed **out);

/**
 * A black body: Planck's law.
 *
 * Given:    temperature_k  kelvin, 50..1e9
 * Returned: out            the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_sed_create_black_body(double temperature_k, wfpsf_sed **out);

/**
 * Another SED at a redshift: its wavelengths 1 + z times as long.
 *
 * Given:    sed       may be freed afterwards
 *           redshift  dimensionless, above -1, up to 1000
 * Returned: out       the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_sed_create_redshifted(const wfpsf_sed *sed, double redshift,
                                                      wfpsf_sed **out);

/** Frees an SED; NULL is allowed. */
WFPSF_EXPORT void wfpsf_sed_destroy(wfpsf_sed *sed);

/**
 * Photons per unit of wavelength, up to a factor that is the same for all wavelengths. A table goes
 * on beyond its ends in straight lines; PSFs never ask there.
 *
 * Given:    count          of wavelengths, >= 0
 *           wavelength_nm  finite, > 0
 * Returned: photons        count numbers, in a unit that does not matter
 * Status:   ERROR_NULL, ERROR_SIZE, ERROR_RANGE, ERROR_NOT_FINITE
 */
WFPSF_EXPORT wfpsf_status wfpsf_sed_photon_density(const wfpsf_sed *sed, int64_t count,
                                                   const double *wavelength_nm, double *photons);

#ifdef __cplusplus
}
#endif

#endif
