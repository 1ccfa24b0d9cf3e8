/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file design.h
 * Instruments from figures of your own: fill a design, then make an instrument of it, which serves
 * wherever a built-in one does.
 *
 *     wfpsf_design_create(&design);
 *     wfpsf_design_set_telescope(design, 2.4, 0.33, 633);
 *     for (int i = 0; i < 4; ++i)
 *         wfpsf_design_add_strut(design, 45 + 90 * i, 0.03, 0);
 *     wfpsf_design_set_detector(design, 1, 0.04, 4096, 2048);
 *     wfpsf_instrument_create_from_design(design, &instrument);
 *
 * The pupil is a circular primary about the optical axis, less a circular obscuration about it,
 * less the struts. Pupil coordinates are metres from the axis, x to the right, y up; they are also
 * the axes of the images, so that WFPSF_OPTION_FRAME changes nothing. Wavelengths are 100..100000
 * nm. A call that fails leaves the design as it was. Thread-safety: a design is mutable; callers
 * that share one lock it themselves. Instruments made from it are immutable and hold copies.
 */
#ifndef WFPSF_DESIGN_H
#define WFPSF_DESIGN_H

#include <wfpsf/instrument.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_design wfpsf_design;

/**
 * An empty design. Telescope and detector must be set; struts, aberrations and bands need not be.
 *
 * Returned: out     the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_design_create(wfpsf_design **out);

/** Frees a design; NULL is allowed. */
WFPSF_EXPORT void wfpsf_design_destroy(wfpsf_design *design);

/**
 * The mirrors.
 *
 * Given:    diameter_m              of the primary, 0.01..100
 *           obscuration             0..0.99, linear: its diameter over the primary's
 *           reference_wavelength_nm at which Zernike coefficients are given, those of the design
 *                                   and those of wfpsf_options_set_zernikes() alike
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE
 */
WFPSF_EXPORT wfpsf_status wfpsf_design_set_telescope(wfpsf_design *design, double diameter_m,
                                                     double obscuration,
                                                     double reference_wavelength_nm);

/**
 * One more strut: a dark bar with parallel sides that begins at the optical axis, square, and runs
 * outwards beyond the primary's edge. Bars may overlap.
 *
 * Given:    azimuth_deg   direction it runs in, from the x axis towards the y axis, -360..360
 *           width_m       0..100; nothing is added for 0
 *           offset_m      of its middle line from the axis, towards azimuth_deg + 90, -100..100
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE, ERROR_SIZE (there are 64)
 */
WFPSF_EXPORT wfpsf_status wfpsf_design_add_strut(wfpsf_design *design, double azimuth_deg,
                                                 double width_m, double offset_m);

/**
 * The detectors, all of one kind.
 *
 * Given:    sca_count           1..1000; SCAs are numbered from 1
 *           pixel_scale_arcsec  side of a square pixel, 1e-4..10
 *           n_pix_x, n_pix_y    active pixels along each axis, 1..100000
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE
 */
WFPSF_EXPORT wfpsf_status wfpsf_design_set_detector(wfpsf_design *design, int32_t sca_count,
                                                    double pixel_scale_arcsec, int64_t n_pix_x,
                                                    int64_t n_pix_y);

/**
 * Aberrations of a detector, the same all over it; without them it has none. They replace what was
 * set for the detector before.
 *
 * Given:    sca           1..1000
 *           count         0..231
 *           coefficients  Noll order from j = 1, waves rms over the full circle of the primary's
 *                         diameter, at the reference wavelength, -1e6..1e6. PSFs leave out the
 *                         first three unless WFPSF_OPTION_PISTON_TILT is set
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE
 */
WFPSF_EXPORT wfpsf_status wfpsf_design_set_zernikes(wfpsf_design *design, int32_t sca,
                                                    int64_t count, const double *coefficients);

/**
 * Aberrations of a detector at five field points, between which WFPSF_OPTION_FIELD_RULE
 * interpolates. Either all detectors that have aberrations have them at five points, or none has.
 *
 * Given:    sca           1..1000
 *           x, y          five each, pixels of the detector, the first one's centre at (0, 0):
 *                         first a point near the centre, then one towards each corner, in any order
 *           count         of coefficients at each point, 0..231
 *           coefficients  5 count numbers, point by point, each as in wfpsf_design_set_zernikes()
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE, ERROR_ARGUMENT (points not so placed)
 */
WFPSF_EXPORT wfpsf_status wfpsf_design_set_field(wfpsf_design *design, int32_t sca, const double *x,
                                                 const double *y, int64_t count,
                                                 const double *coefficients);

/**
 * One more filter band: its throughput at equal steps of wavelength, linear in between and zero
 * outside. The ends may be zero or not.
 *
 * Given:    name                1..63 bytes, copied; unlike those of other bands
 *           first_nm, step_nm   wavelength of the first sample and the step
 *           count               of samples, 2..1000000
 *           throughput          dimensionless, 0..1, not all zero; copied
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE, ERROR_SIZE, ERROR_ARGUMENT (the name is
 *           taken, empty or too long; all zero)
 */
WFPSF_EXPORT wfpsf_status wfpsf_design_add_band(wfpsf_design *design, const char *name,
                                                double first_nm, double step_nm, int64_t count,
                                                const double *throughput);

/**
 * The instrument that a design describes; the design may be changed or freed afterwards. It has no
 * IPC kernel of its own: make one by its taps.
 *
 * Returned: out     the handle, to be freed with wfpsf_instrument_destroy(); NULL on failure
 * Status:   ERROR_NULL, ERROR_NO_MEMORY, ERROR_ARGUMENT (telescope or detector not set, field
 *           points on some detectors only, struts that leave no light), ERROR_RANGE (aberrations of
 *           an SCA that there is not)
 */
WFPSF_EXPORT wfpsf_status wfpsf_instrument_create_from_design(const wfpsf_design *design,
                                                              wfpsf_instrument **out);

#ifdef __cplusplus
}
#endif

#endif
