/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file psf.h
 * Effective PSFs: the diffraction image of a star, averaged over the native pixel.
 *
 * Amplitude at angle theta: integral over the lit pupil of exp(2 pi i W(u)) exp(2 pi i
 * u.theta/lambda) d2u, W in waves from Noll's Zernike polynomials; x and y of the image along x and
 * y of the pupil. Piston, tip and tilt of the instrument are dropped unless asked for, so (x, y) of
 * a star is where the optical axis falls, not the centroid.
 *
 * Thread-safety: a PSF is immutable; many threads may draw from one, each into its own image.
 */
#ifndef WFPSF_PSF_H
#define WFPSF_PSF_H

#include <wfpsf/image.h>
#include <wfpsf/instrument.h>
#include <wfpsf/sed.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_psf wfpsf_psf;

/** X(NAME, key, text): what can be asked of a PSF. */
#define WFPSF_PSF_PROPERTY_LIST(X)                                                                 \
    X(WAVELENGTH_NM, 10, "wavelength, nm; of many, the mean by photons detected")                  \
    X(PIXEL_SCALE_ARCSEC, 20, "native pixel, arcsec")                                              \
    X(ERROR_ESTIMATE, 30, "numerical error of any pixel, in units of the peak pixel")              \
    X(MODEL_ERROR, 40, "error of the pupil's geometry against the published mask, same units")     \
    X(PEAK, 50, "largest fraction of the light that one native pixel receives")                    \
    X(NODES, 60, "quadrature nodes, or pixels of the mask")                                        \
    X(GRID_SIZE, 70, "side of the focal grid")                                                     \
    X(GRID_STEP_ARCSEC, 80, "step of the focal grid, arcsec")                                      \
    X(RADIUS, 90, "half size of the field made in advance, native pixels")                         \
    X(LIT_AREA_M2, 100, "lit area of the pupil, m^2")                                              \
    X(WAVELENGTHS, 110, "wavelengths that the PSF is a sum over")

#define WFPSF_PSF_PROPERTY_ENUM(name, key, text) WFPSF_PSF_##name = (key),
enum { WFPSF_PSF_PROPERTY_LIST(WFPSF_PSF_PROPERTY_ENUM) };
#undef WFPSF_PSF_PROPERTY_ENUM

/**
 * An optical path difference (OPD) map, added to the wavefront of every PSF made with the options:
 * W in waves is the sum of Zernike terms plus OPD / wavelength, so that a map of
 * coefficient * reference wavelength * Z_j adds what the coefficient does. Between the samples
 * stands the bicubic spline that meets them all, with an error that falls as the fourth power of
 * their distance; beyond the outermost samples' centres, the value at the nearest point of the
 * border. Nothing of the map is dropped, its tilt included. Let it go on smoothly beyond the
 * pupil's edge: a jump there rings through several samples. A pupil mask sampled like the map meets
 * its samples.
 *
 * A map that is too rough for the number of nodes that a PSF takes at most, about a million, gives
 * WARNING_NOT_CERTIFIED, with an error estimate that holds.
 *
 * Given:    map             metres, -0.001..0.001, at least 4 x 4 samples, at most 8192 x 8192, of
 *                           either pixel type; copied. Its record of effects does not matter. NULL
 *                           takes the present map away
 *           scale_m         distance of the samples in the pupil, above 0, up to 1
 *           axis_x, axis_y  the sample at which the optical axis passes, the first one's centre at
 *                           (0, 0); -1e6..1e6
 * Status:   ERROR_NULL, ERROR_SIZE, ERROR_RANGE, ERROR_NOT_FINITE, ERROR_NO_MEMORY; the options
 *           then keep their map
 */
WFPSF_EXPORT wfpsf_status wfpsf_options_set_opd(wfpsf_options *options, const wfpsf_image *map,
                                                double scale_m, double axis_x, double axis_y);

/**
 * The monochromatic effective PSF at the centre of a detector, for an instrument with one pupil
 * ("wfirst-afta-c5", and all made from a design).
 *
 * Given:    instrument     may be freed afterwards
 *           sca            1..n_sca
 *           wavelength_nm  100..100000
 *           options        EPS, STRUTS, PSF_RADIUS, PISTON_TILT, JITTER_*, CHARGE_DIFFUSION,
 *                          PIXEL_RESPONSE, extra Zernikes, an OPD map, MEMORY_LIMIT and the progress
 *                          function
 * Returned: out            the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_NOT_FINITE, ERROR_NO_MEMORY;
 *           ERROR_ARGUMENT if the pupil depends on the band (wfpsf_psf_create_in_band());
 *           ERROR_CANCELLED, ERROR_MEMORY_LIMIT; WARNING_NOT_CERTIFIED if the error estimate stays
 *           above EPS
 */
WFPSF_EXPORT wfpsf_status wfpsf_psf_create(const wfpsf_instrument *instrument, int32_t sca,
                                           double wavelength_nm, const wfpsf_options *options,
                                           wfpsf_psf **out);

/**
 * The same anywhere on a detector, through the pupil that a band is used with. Needed for
 * "roman-c9", whose pupils and aberrations depend on both; "wfirst-afta-c5" has one pupil and one
 * set of aberrations a detector.
 *
 * Roman's published pupils and aberrations are those of the exit pupil. By default its images are
 * in science coordinates, which differ by a flip of y (and what comes out of GalSim up to 2.8.4 is
 * in the exit pupil's: FRAME 1). C5 images are in the orientation of its mask, as in the paper, in
 * both.
 *
 * Given:    band           such as "J129"
 *           x, y           position on the detector, pixels, the first one's centre at (0, 0);
 *                          up to 512 pixels beyond the detector's edge
 *           wavelength_nm  100..100000; 0: the band's effective wavelength, tabulated
 *           others         as for wfpsf_psf_create(), and FRAME, FIELD_RULE
 * Returned: out            the handle; NULL on failure
 * Status:   as for wfpsf_psf_create(); ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_psf_create_in_band(const wfpsf_instrument *instrument,
                                                   const char *band, int32_t sca, double x,
                                                   double y, double wavelength_nm,
                                                   const wfpsf_options *options, wfpsf_psf **out);

/**
 * PSFs of sources of many colours, seen through a band: the sum of monochromatic PSFs over the
 * photons detected, which are the SED's times the band's throughput. Aberrations are a length, so
 * their waves go as 1 / wavelength. The library chooses as many wavelengths as EPS needs (Gauss
 * nodes for the photons detected); several SEDs share their monochromatic images, so that many cost
 * little more than one.
 *
 * Given:    count    of SEDs, 1..1000
 *           seds     count handles, which may be freed afterwards
 *           others   as for wfpsf_psf_create_in_band()
 * Returned: out      count handles; NULL all of them on failure
 * Status:   as for wfpsf_psf_create_in_band(); ERROR_SIZE; ERROR_RANGE if a table does not cover
 *           the band; ERROR_ARGUMENT if no light of an SED is detected; ERROR_CANCELLED
 */
WFPSF_EXPORT wfpsf_status wfpsf_psf_create_chromatic(const wfpsf_instrument *instrument,
                                                     const char *band, int32_t sca, double x,
                                                     double y, int64_t count,
                                                     const wfpsf_sed *const *seds,
                                                     const wfpsf_options *options, wfpsf_psf **out);

/**
 * The PSF at the centre of a detector with the pupil given as a mask: every pixel a square of that
 * transmission, with the phase of its centre. MASK_POINTS 1 makes them points of as much light,
 * which is what plain sums over masks are; such a PSF has no OTF (ERROR_ARGUMENT).
 *
 * Given:    mask            transmissions in [0, 1]; copied
 *           mask_scale_m    side of a mask pixel, metres, > 0
 *           axis_x, axis_y  position of the optical axis in the mask, first pixel at (0, 0)
 *           others          as for wfpsf_psf_create(), and MASK_POINTS; STRUTS does not matter
 * Returned: out             the handle; NULL on failure
 * Status:   as for wfpsf_psf_create(), ERROR_ARGUMENT if nothing is lit
 */
WFPSF_EXPORT wfpsf_status wfpsf_psf_create_from_mask(const wfpsf_instrument *instrument,
                                                     const wfpsf_image *mask, double mask_scale_m,
                                                     double axis_x, double axis_y, int32_t sca,
                                                     double wavelength_nm,
                                                     const wfpsf_options *options, wfpsf_psf **out);

/** Frees a PSF; NULL is allowed. */
WFPSF_EXPORT void wfpsf_psf_destroy(wfpsf_psf *psf);

/**
 * Draws one star, overwriting the image.
 *
 * Each pixel gets flux / N^2 times the fraction of the light that a native pixel centred there
 * receives, N the image's oversampling: the sum over an infinite image is the flux at any N. The
 * image's record becomes: the PSF's pixel scale, pixel response applied. Any size, odd or even.
 * With PIXEL_RESPONSE 0 it is the light's density at the sample's centre times a native pixel's
 * area, not averaged: for hosts that average over pixels themselves; the record says so.
 *
 * A stamp that reaches beyond the radius made in advance is drawn from its diffraction image anew:
 * nothing is folded back at any distance, the time goes with the area, and the image is made in
 * strips so that the memory stays within MEMORY_LIMIT (wfpsf_psf_draw_memory()).
 *
 * Given:    x, y     position of the star, pixels of the image, the first pixel's centre at (0, 0)
 *           flux     finite
 *           options  MEMORY_LIMIT and the progress function, for stamps beyond the radius
 * Returned: image    pixels and record
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_RANGE (star more than 4096 native pixels away),
 *           ERROR_MEMORY_LIMIT (the image is then all zero); ERROR_CANCELLED and ERROR_NO_MEMORY
 *           leave a part of the light in the image; WARNING_NOT_CERTIFIED
 */
WFPSF_EXPORT wfpsf_status wfpsf_psf_draw(const wfpsf_psf *psf, double x, double y, double flux,
                                         const wfpsf_options *options, wfpsf_image *image);

/**
 * The same, added to what the image holds, on all of its pixels: for stars whose spikes are seen
 * far from them. (wfpsf_psf_add_stars() is for the many, and ends at RADIUS.) The image's record is
 * treated as there.
 *
 * Status:   as for wfpsf_psf_draw() and wfpsf_psf_add_stars(); after ERROR_MEMORY_LIMIT the image
 *           is as it was
 */
WFPSF_EXPORT wfpsf_status wfpsf_psf_add_bright_star(const wfpsf_psf *psf, double x, double y,
                                                    double flux, const wfpsf_options *options,
                                                    wfpsf_image *image);

/**
 * The memory that drawing a star into an image would take, before it is taken.
 *
 * Given:    x, y, image  as for wfpsf_psf_draw(); the image is not touched
 * Returned: least        bytes without which it cannot be done
 *           most         bytes with which it is done in one go; either may be NULL
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_RANGE
 */
WFPSF_EXPORT wfpsf_status wfpsf_psf_draw_memory(const wfpsf_psf *psf, double x, double y,
                                                const wfpsf_image *image, int64_t *least,
                                                int64_t *most);

/**
 * Adds stars to an image, each with the light that falls within the PSF's RADIUS of it along both
 * axes, clipped at the image's borders. Values and positions are those of wfpsf_psf_draw(). Stars
 * out of reach of the image add nothing. The image's record must hold no effect beyond the pixel
 * response (light does not come after IPC), and a pixel scale, if it states one, that is the PSF's;
 * afterwards it states both.
 *
 * Given:    count       of stars, >= 0
 *           x, y, flux  count numbers each, all finite; pixels of the image, and any unit of light
 *           options     THREADS, which changes the time and no bit of the result; FORCE
 * Returned: image       pixels and record; untouched on failure, unless memory runs out on the way
 * Status:   ERROR_NULL, ERROR_SIZE, ERROR_NOT_FINITE, ERROR_ALREADY_APPLIED, ERROR_ARGUMENT
 *           (another pixel scale), ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_psf_add_stars(const wfpsf_psf *psf, int64_t count, const double *x,
                                              const double *y, const double *flux,
                                              const wfpsf_options *options, wfpsf_image *image);

/**
 * Draws an extended source, overwriting the image: the source's own image convolved with the
 * effective PSF,
 *
 *     image(p) = flux * sum over the samples q of galaxy(q) PSF(p - q),
 *
 * which is what wfpsf_psf_draw() would give for a star of flux * galaxy(q) at every sample, added
 * up. Nothing wraps around: light that leaves the image is lost. The numerical error is the PSF's;
 * how well N samples a native pixel describe the source is the caller's choice. The PSF is needed
 * from every sample to every pixel; where that is farther than its RADIUS, each call makes a new
 * field, which takes most of the time.
 *
 * Given:    galaxy   flux of each sample, all finite; its oversampling N is a multiple of the
 *                    image's. Its record may hold no effect (the pixel response comes with the
 *                    PSF), and a pixel scale, if it states one, that is the PSF's
 *           x, y     where the centre of `galaxy`, ((nx-1)/2, (ny-1)/2) of it, falls: pixels of the
 *                    image, the first pixel's centre at (0, 0)
 *           flux     multiplies the samples; finite
 *           options  FORCE
 * Returned: image    pixels and record, as by wfpsf_psf_draw(); shares no memory with galaxy
 * Status:   ERROR_NULL, ERROR_NOT_FINITE, ERROR_ARGUMENT (N is no multiple, another pixel scale),
 *           ERROR_ALREADY_APPLIED, ERROR_OVERLAP, ERROR_RANGE (more than 4096 native pixels apart),
 *           ERROR_SIZE (galaxy and image together have more than 8192 samples a side),
 *           ERROR_NO_MEMORY; the image is then as it was
 */
WFPSF_EXPORT wfpsf_status wfpsf_psf_convolve(const wfpsf_psf *psf, const wfpsf_image *galaxy,
                                             double x, double y, double flux,
                                             const wfpsf_options *options, wfpsf_image *image);

/**
 * One property of a PSF.
 *
 * Given:    key    WFPSF_PSF_*
 * Returned: value  in the unit that the list states
 * Status:   ERROR_NULL, ERROR_UNKNOWN_NAME
 */
WFPSF_EXPORT wfpsf_status wfpsf_psf_get(const wfpsf_psf *psf, int32_t key, double *value);

#ifdef __cplusplus
}
#endif

#endif
