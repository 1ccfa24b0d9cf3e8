/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The public headers of ABI 1 as they were when it was frozen: never edited. */
/* clang-format off */
#ifndef WFPSF_EXPORT_H
#define WFPSF_EXPORT_H 
#include <stddef.h>
#include <stdint.h>
#if defined(__GNUC__) || defined(__clang__)
#define WFPSF_EXPORT __attribute__((visibility("default")))
#else
#define WFPSF_EXPORT 
#endif
#endif
#ifndef WFPSF_STATUS_H
#define WFPSF_STATUS_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef int32_t wfpsf_status;
#define WFPSF_STATUS_LIST(X) \
    X(OK, 0, "success") \
    X(WARNING_NOT_CONVERGED, 100, "iteration stopped at its limit before the tolerance was met") \
    X(WARNING_NOT_CERTIFIED, 110, "the error estimate exceeds the tolerance that was asked for") \
    X(WARNING_RESTARTED, 120, "solved, but from another start than the one given") \
    X(WARNING_NEAR_DEGENERATE, 130, "solved, but the solution is poorly determined") \
    X(WARNING_UNDERSAMPLED, 140, \
      "solved, but the object is so small that its pixels' places count") \
    X(ERROR_NULL, -10, "a required pointer is NULL") \
    X(ERROR_ARGUMENT, -20, "an argument has a value that is not one of those allowed") \
    X(ERROR_RANGE, -30, "an argument lies outside its allowed range") \
    X(ERROR_SIZE, -40, "the sizes or strides of an array do not fit") \
    X(ERROR_TYPE, -50, "the pixel types of two images differ") \
    X(ERROR_NOT_FINITE, -60, "a number that must be finite is NaN or infinite") \
    X(ERROR_UNKNOWN_NAME, -70, "no instrument, band, constant, option or property of that name") \
    X(ERROR_OVERLAP, -80, "input and output share memory") \
    X(ERROR_ALREADY_APPLIED, -90, "the image records that this effect was applied before") \
    X(ERROR_KERNEL, -100, "the taps do not make an IPC kernel") \
    X(ERROR_KERNEL_SINGULAR, -110, "the IPC kernel comes too close to zero to be undone") \
    X(ERROR_SKY_SUN, -120, "the Sun is too close for a sky level") \
    X(ERROR_SUN_ANGLE, -130, "the angle between the Sun and the line of sight is not allowed") \
    X(ERROR_NO_WCS, -140, "the instrument's detectors have no places on the sky") \
    X(ERROR_FILE_OPEN, -200, "a file cannot be opened") \
    X(ERROR_FILE_FORMAT, -210, "a file does not hold what it should") \
    X(ERROR_FILE_WRITE, -220, "a file cannot be written") \
    X(ERROR_MOMENTS_NO_PIXELS, -300, "no pixel lies within reach of the weight function") \
    X(ERROR_MOMENTS_FLUX, -310, "the weighted flux is not positive") \
    X(ERROR_MOMENTS_UNRESOLVED, -320, "the object is too small for its pixels: no solution") \
    X(ERROR_MOMENTS_FILLS_IMAGE, -330, "the weight outgrew the image: no object of finite size") \
    X(ERROR_MOMENTS_OUTSIDE, -340, "the centroid left the image") \
    X(ERROR_MOMENTS_STALLED, -350, "the iteration stands at a point that is not a maximum") \
    X(ERROR_SIZE_NOT_REACHED, -400, "the image does not hold the fraction of light asked for") \
    X(ERROR_CANCELLED, -500, "the caller's progress function asked to stop") \
    X(ERROR_MEMORY_LIMIT, -510, "the work needs more memory than the option MEMORY_LIMIT allows") \
    X(ERROR_NO_MEMORY, -900, "memory ran out") \
    X(ERROR_INTERNAL, -910, "an unexpected failure inside the library: please report it") \
    X(ERROR_ABI, -920, "the program was compiled for another ABI than the loaded library's")
#define WFPSF_STATUS_ENUM(name,value,text) WFPSF_ ##name = (value),
enum { WFPSF_STATUS_LIST(WFPSF_STATUS_ENUM) };
#undef WFPSF_STATUS_ENUM
WFPSF_EXPORT const char *wfpsf_status_name(wfpsf_status status);
WFPSF_EXPORT const char *wfpsf_status_string(wfpsf_status status);
WFPSF_EXPORT int64_t wfpsf_last_error(char *buffer, int64_t length);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_VERSION_H
#define WFPSF_VERSION_H 
#define WFPSF_VERSION_MAJOR 1
#define WFPSF_VERSION_MINOR 0
#define WFPSF_VERSION_PATCH 0
#define WFPSF_ABI_NUMBER 1
#ifdef __cplusplus
extern "C" {
#endif
WFPSF_EXPORT const char *wfpsf_version(void);
WFPSF_EXPORT int32_t wfpsf_abi_number(void);
WFPSF_EXPORT wfpsf_status wfpsf_abi_check(int32_t expected);
static inline wfpsf_status wfpsf_check_version(void) {
    return wfpsf_abi_check(WFPSF_ABI_NUMBER);
}
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_OPTIONS_H
#define WFPSF_OPTIONS_H 
#include <math.h>
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_options wfpsf_options;
#define WFPSF_AUTOMATIC NAN
enum { WFPSF_OPTION_REAL = 1, WFPSF_OPTION_INTEGER = 2 };
#define WFPSF_OPTION_LIST(X) \
    X(EPS, 100, REAL, 1e-6, 1e-12, 0.1, \
      "largest error of any PSF pixel, in units of the stamp's peak pixel") \
    X(STRUTS, 110, INTEGER, 1, 0, 1, \
      "1: the pupil with its struts; 0: the bare annulus of diameter and obscuration") \
    X(PSF_RADIUS, 120, REAL, 16, 1, 512, \
      "half size of the field that a PSF makes in advance, native pixels") \
    X(PISTON_TILT, 130, INTEGER, 0, 0, 1, \
      "1: keep the instrument's Zernike terms 1 to 3, which are dropped otherwise") \
    X(FRAME, 140, INTEGER, 0, 0, 1, \
      "axes of a PSF's image: 0, the detector's science coordinates; 1, those of the exit pupil") \
    X(FIELD_RULE, 150, INTEGER, 0, 0, 1, \
      "aberrations between field points: 0, all points are met; 1, bilinear between the corners") \
    X(JITTER_XX, 160, REAL, 0, 0, 1e4, "variance of the telescope's jitter along x, arcsec^2") \
    X(JITTER_XY, 161, REAL, 0, -1e4, 1e4, "covariance of the jitter along x and y, arcsec^2") \
    X(JITTER_YY, 162, REAL, 0, 0, 1e4, "variance of the jitter along y, arcsec^2") \
    X(CHARGE_DIFFUSION, 170, REAL, 0, 0, 16, \
      "standard deviation of the Gaussian that charge diffuses over, native pixels") \
    X(MASK_POINTS, 180, INTEGER, 0, 0, 1, \
      "1: a mask's pixels are points at their centres, not squares") \
    X(PIXEL_RESPONSE, 190, INTEGER, 1, 0, 1, \
      "1: PSFs are averaged over the native pixel; 0: they are the light at the samples' centres") \
    X(FORCE, 200, INTEGER, 0, 0, 1, \
      "1: apply an effect even to an image that records it as applied") \
    X(IPC_FILL, 210, REAL, 0, -1.7976931348623157e308, 1.7976931348623157e308, \
      "value of the border pixels under WFPSF_EDGE_FILL") \
    X(KERNEL_NEGATIVE, 220, INTEGER, 0, 0, 1, \
      "1: taps outside [0, 1] are allowed, as correction kernels need") \
    X(KERNEL_NORMALISE, 230, INTEGER, 0, 0, 1, "1: taps are divided by their sum") \
    X(IPC_FORM, 240, INTEGER, 0, 0, 1, \
      "0: scatter, a convolution with the kernel; 1: gather, a correlation") \
    X(IPC_LEAST_MARGIN, 250, REAL, 1e-3, 0, 1, \
      "min |K^| below which an exact correction is refused") \
    X(IPC_TOLERANCE, 260, REAL, 1e-15, 1e-16, 0.1, \
      "residual of an exact correction to stop at, over the largest pixel") \
    X(IPC_MAX_PASSES, 270, INTEGER, 1000, 1, 1000000, "most passes of an exact correction") \
    X(MOMENTS_TOLERANCE, 300, REAL, 1e-8, 1e-12, 1e-2, \
      "largest whitened error of centroid and moments") \
    X(MOMENTS_MAX_PASSES, 310, INTEGER, 200, 1, 100000, "most passes over the image") \
    X(MOMENTS_GUESS_X, 320, REAL, WFPSF_AUTOMATIC, -1e15, 1e15, \
      "first guess of the centroid, pixels of the image, first pixel at 0") \
    X(MOMENTS_GUESS_Y, 330, REAL, WFPSF_AUTOMATIC, -1e15, 1e15, "first guess of the centroid") \
    X(MOMENTS_GUESS_SIGMA, 340, REAL, WFPSF_AUTOMATIC, 1e-3, 1e9, \
      "first guess of the size sigma, pixels of the image") \
    X(MOMENTS_METHOD, 350, INTEGER, 0, 0, 3, \
      "0: the adaptive weight; 1: least squares at pixel centres, for small stars; 2: a round " \
      "weight; 3: as 1, with a constant background that is fitted") \
    X(MOMENTS_BACKGROUND, 360, REAL, 0, -1.7976931348623157e308, 1.7976931348623157e308, \
      "constant that is taken off every pixel before adaptive moments") \
    X(MOMENTS_VARIANCE, 370, REAL, WFPSF_AUTOMATIC, 0, 1.7976931348623157e308, \
      "variance of every pixel's noise, for covariances; automatic: not known") \
    X(MOMENTS_RESTART, 380, INTEGER, 1, 0, 1, \
      "0: fail, rather than start elsewhere, if the first guess leads to no solution") \
    X(MOMENTS_COVARIANCE_ORDER, 390, INTEGER, 1, 1, 2, \
      "1: covariances to first order in the noise; 2: with the next terms, for S/N 10 to 50") \
    X(SIZE_TOTAL_FLUX, 400, REAL, WFPSF_AUTOMATIC, 2.2250738585072014e-308, \
      1.7976931348623157e308, "flux that counts as 100%; automatic: the sum of all pixels") \
    X(SIZE_BANDWIDTH, 410, REAL, 0.25, 1e-3, 0.45, \
      "highest frequency in the image, cycles per pixel of the image") \
    X(SIZE_EPS, 420, REAL, 1e-12, 1e-14, 0.1, \
      "error of a band-limited image's integral, per pixel, in units of the largest pixel") \
    X(FITS_OVERWRITE, 500, INTEGER, 0, 0, 1, "1: replace an existing file") \
    X(THREADS, 600, INTEGER, 1, 1, 1024, "threads that a call may use, the caller's among them") \
    X(MEMORY_LIMIT, 610, REAL, 4294967296.0, 1e3, 1e15, \
      "bytes that a call may take, about, beside the caller's own images") \
    X(SEED, 700, INTEGER, 0, 0, 9007199254740991, "seed of the random numbers") \
    X(STREAM, 710, INTEGER, 0, 0, 4294967295, "stream of the seed, such as an exposure's number") \
    X(ORIGIN_X, 720, INTEGER, 0, -2147483648, 2147483647, \
      "column of the detector that an image's first pixel is in") \
    X(ORIGIN_Y, 730, INTEGER, 0, -2147483648, 2147483647, \
      "row of the detector that an image's first pixel is in") \
    X(NOISE, 740, INTEGER, 1, 0, 1, "0: a chain adds means alone, no Poisson and read noise") \
    X(WCS_RULE, 800, INTEGER, 0, 0, 1, \
      "0: the field's distortion inside each detector, the Sun of the ICRS; 1: as GalSim has " \
      "them") \
    X(PA_OF_FPA, 810, INTEGER, 0, 0, 1, \
      "1: position angles that are given are the focal plane's, not the observatory's")
#define WFPSF_OPTION_ENUM(name,key,kind,standard,smallest,largest,text) \
    WFPSF_OPTION_##name = (key),
enum { WFPSF_OPTION_LIST(WFPSF_OPTION_ENUM) };
#undef WFPSF_OPTION_ENUM
WFPSF_EXPORT wfpsf_status wfpsf_options_create(wfpsf_options **out);
WFPSF_EXPORT void wfpsf_options_destroy(wfpsf_options *options);
WFPSF_EXPORT wfpsf_status wfpsf_options_set_real(wfpsf_options *options, int32_t key, double value);
WFPSF_EXPORT wfpsf_status wfpsf_options_set_integer(wfpsf_options *options, int32_t key,
                                                    int64_t value);
WFPSF_EXPORT wfpsf_status wfpsf_options_get(const wfpsf_options *options, int32_t key,
                                            double *value);
WFPSF_EXPORT wfpsf_status wfpsf_options_reset(wfpsf_options *options, int32_t key);
WFPSF_EXPORT wfpsf_status wfpsf_options_set_zernikes(wfpsf_options *options, int64_t count,
                                                     const double *coefficients);
typedef int32_t (*wfpsf_progress)(double part, void *user);
WFPSF_EXPORT wfpsf_status wfpsf_options_set_progress(wfpsf_options *options,
                                                     wfpsf_progress progress, void *user);
WFPSF_EXPORT wfpsf_status wfpsf_option_describe(int32_t key, const char **name, const char **text,
                                                int32_t *kind, double *standard, double *smallest,
                                                double *largest);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_IMAGE_H
#define WFPSF_IMAGE_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_image wfpsf_image;
enum { WFPSF_FLOAT32 = 32, WFPSF_FLOAT64 = 64 };
enum {
    WFPSF_EFFECT_PIXEL_RESPONSE = 1,
    WFPSF_EFFECT_IPC = 2,
    WFPSF_EFFECT_IPC_CORRECTION = 4,
    WFPSF_EFFECT_CHARGE_DIFFUSION = 8,
    WFPSF_EFFECT_BACKGROUND = 16,
    WFPSF_EFFECT_POISSON_NOISE = 32,
    WFPSF_EFFECT_RECIPROCITY_FAILURE = 64,
    WFPSF_EFFECT_DARK_CURRENT = 128,
    WFPSF_EFFECT_PERSISTENCE = 256,
    WFPSF_EFFECT_NONLINEARITY = 512,
    WFPSF_EFFECT_NONLINEARITY_CORRECTION = 1024,
    WFPSF_EFFECT_CAPACITANCE = 2048,
    WFPSF_EFFECT_READ_NOISE = 4096,
    WFPSF_EFFECT_GAIN = 8192
};
enum {
    WFPSF_DITHER_DETECTOR = 1,
    WFPSF_DITHER_OBJECT = 2
};
WFPSF_EXPORT wfpsf_status wfpsf_image_create(int32_t pixel_type, int64_t nx, int64_t ny,
                                             int64_t oversampling, wfpsf_image **out);
WFPSF_EXPORT wfpsf_status wfpsf_image_wrap(int32_t pixel_type, void *data, int64_t nx, int64_t ny,
                                           int64_t stride_x, int64_t stride_y, int64_t oversampling,
                                           wfpsf_image **out);
WFPSF_EXPORT void wfpsf_image_destroy(wfpsf_image *image);
WFPSF_EXPORT wfpsf_status wfpsf_image_shape(const wfpsf_image *image, int32_t *pixel_type,
                                            int64_t *nx, int64_t *ny);
WFPSF_EXPORT wfpsf_status wfpsf_image_record(const wfpsf_image *image, int64_t *oversampling,
                                             double *pixel_scale_arcsec, int32_t *applied);
WFPSF_EXPORT wfpsf_status wfpsf_image_set_record(wfpsf_image *image, int64_t oversampling,
                                                 double pixel_scale_arcsec, int32_t applied);
WFPSF_EXPORT wfpsf_status wfpsf_image_copy(const wfpsf_image *from, wfpsf_image *to);
WFPSF_EXPORT wfpsf_status wfpsf_image_read_fits(const char *path, const char *hdu,
                                                int32_t pixel_type, wfpsf_image **out);
WFPSF_EXPORT wfpsf_status wfpsf_image_write_fits(const wfpsf_image *image, const char *path,
                                                 const wfpsf_options *options);
WFPSF_EXPORT wfpsf_status wfpsf_image_interleave(int64_t n_x, int64_t n_y,
                                                 const wfpsf_image *const *images, const double *dx,
                                                 const double *dy, int32_t convention,
                                                 wfpsf_image *out);
WFPSF_EXPORT wfpsf_status wfpsf_image_deinterleave(const wfpsf_image *image, int64_t n_x,
                                                   int64_t n_y, const double *dx, const double *dy,
                                                   int32_t convention, wfpsf_image *const *out);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_INSTRUMENT_H
#define WFPSF_INSTRUMENT_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_instrument wfpsf_instrument;
enum {
    WFPSF_BAND_TABULATED = 1,
    WFPSF_BAND_PAPER = 2
};
WFPSF_EXPORT wfpsf_status wfpsf_instrument_create(const char *name, wfpsf_instrument **out);
WFPSF_EXPORT void wfpsf_instrument_destroy(wfpsf_instrument *instrument);
WFPSF_EXPORT wfpsf_status wfpsf_instrument_constant(const wfpsf_instrument *instrument,
                                                    const char *name, double *value,
                                                    const char **unit);
WFPSF_EXPORT const char *wfpsf_instrument_constant_name(const wfpsf_instrument *instrument,
                                                        int64_t index);
WFPSF_EXPORT const char *wfpsf_instrument_band_name(const wfpsf_instrument *instrument,
                                                    int64_t index);
WFPSF_EXPORT wfpsf_status wfpsf_instrument_band(const wfpsf_instrument *instrument,
                                                const char *band, int32_t rule, double *blue_nm,
                                                double *red_nm, double *effective_nm);
WFPSF_EXPORT wfpsf_status wfpsf_instrument_throughput(const wfpsf_instrument *instrument,
                                                      const char *band, int64_t count,
                                                      const double *wavelength_nm,
                                                      double *throughput);
WFPSF_EXPORT wfpsf_status wfpsf_instrument_zernikes(const wfpsf_instrument *instrument, int32_t sca,
                                                    int64_t capacity, double *coefficients,
                                                    int64_t *count);
WFPSF_EXPORT wfpsf_status wfpsf_instrument_pupil(const wfpsf_instrument *instrument,
                                                 const char *band, int32_t sca,
                                                 const wfpsf_options *options, wfpsf_image *out,
                                                 double *scale_m, double *axis_x, double *axis_y);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_DESIGN_H
#define WFPSF_DESIGN_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_design wfpsf_design;
WFPSF_EXPORT wfpsf_status wfpsf_design_create(wfpsf_design **out);
WFPSF_EXPORT void wfpsf_design_destroy(wfpsf_design *design);
WFPSF_EXPORT wfpsf_status wfpsf_design_set_telescope(wfpsf_design *design, double diameter_m,
                                                     double obscuration,
                                                     double reference_wavelength_nm);
WFPSF_EXPORT wfpsf_status wfpsf_design_add_strut(wfpsf_design *design, double azimuth_deg,
                                                 double width_m, double offset_m);
WFPSF_EXPORT wfpsf_status wfpsf_design_set_detector(wfpsf_design *design, int32_t sca_count,
                                                    double pixel_scale_arcsec, int64_t n_pix_x,
                                                    int64_t n_pix_y);
WFPSF_EXPORT wfpsf_status wfpsf_design_set_zernikes(wfpsf_design *design, int32_t sca,
                                                    int64_t count, const double *coefficients);
WFPSF_EXPORT wfpsf_status wfpsf_design_set_field(wfpsf_design *design, int32_t sca, const double *x,
                                                 const double *y, int64_t count,
                                                 const double *coefficients);
WFPSF_EXPORT wfpsf_status wfpsf_design_add_band(wfpsf_design *design, const char *name,
                                                double first_nm, double step_nm, int64_t count,
                                                const double *throughput);
WFPSF_EXPORT wfpsf_status wfpsf_instrument_create_from_design(const wfpsf_design *design,
                                                              wfpsf_instrument **out);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_OBSERVATION_H
#define WFPSF_OBSERVATION_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_observation wfpsf_observation;
enum {
    WFPSF_OBSERVATION_RA = 10,
    WFPSF_OBSERVATION_DEC = 20,
    WFPSF_OBSERVATION_PA = 30,
    WFPSF_OBSERVATION_PA_FPA = 40,
    WFPSF_OBSERVATION_CRPIX1 = 100,
    WFPSF_OBSERVATION_CRPIX2 = 110,
    WFPSF_OBSERVATION_CRVAL1 = 120,
    WFPSF_OBSERVATION_CRVAL2 = 130,
    WFPSF_OBSERVATION_CD1_1 = 140,
    WFPSF_OBSERVATION_CD1_2 = 150,
    WFPSF_OBSERVATION_CD2_1 = 160,
    WFPSF_OBSERVATION_CD2_2 = 170,
    WFPSF_OBSERVATION_ORIENTAT = 180
};
WFPSF_EXPORT wfpsf_status wfpsf_observation_create(const wfpsf_instrument *instrument,
                                                   double ra_deg, double dec_deg, double pa_deg,
                                                   const wfpsf_options *options,
                                                   wfpsf_observation **out);
WFPSF_EXPORT wfpsf_status wfpsf_observation_create_on_date(const wfpsf_instrument *instrument,
                                                           double ra_deg, double dec_deg,
                                                           double julian_date,
                                                           const wfpsf_options *options,
                                                           wfpsf_observation **out);
WFPSF_EXPORT wfpsf_status wfpsf_observation_create_aimed(
    const wfpsf_instrument *instrument, int32_t sca, double x, double y, double ra_deg,
    double dec_deg, double pa_deg, const wfpsf_options *options, wfpsf_observation **out);
WFPSF_EXPORT void wfpsf_observation_destroy(wfpsf_observation *observation);
WFPSF_EXPORT wfpsf_status wfpsf_observation_get(const wfpsf_observation *observation, int32_t sca,
                                                int32_t key, double *value);
WFPSF_EXPORT wfpsf_status wfpsf_observation_sky_to_pixel(const wfpsf_observation *observation,
                                                         int32_t sca, int64_t count,
                                                         const double *ra_deg,
                                                         const double *dec_deg, double *x,
                                                         double *y, int64_t *undefined);
WFPSF_EXPORT wfpsf_status wfpsf_observation_pixel_to_sky(const wfpsf_observation *observation,
                                                         int32_t sca, int64_t count,
                                                         const double *x, const double *y,
                                                         double *ra_deg, double *dec_deg,
                                                         int64_t *undefined);
WFPSF_EXPORT wfpsf_status wfpsf_observation_find_sca(const wfpsf_observation *observation,
                                                     int32_t with_gaps, int64_t count,
                                                     const double *ra_deg, const double *dec_deg,
                                                     int32_t *sca, double *x, double *y,
                                                     int64_t *found);
WFPSF_EXPORT wfpsf_status wfpsf_observation_bounds(const wfpsf_observation *observation,
                                                   int32_t sca, int32_t with_gaps, int64_t *x_first,
                                                   int64_t *x_last, int64_t *y_first,
                                                   int64_t *y_last);
WFPSF_EXPORT wfpsf_status wfpsf_observation_jacobian(const wfpsf_observation *observation,
                                                     int32_t sca, int64_t count, const double *x,
                                                     const double *y, double *jacobian,
                                                     double *pixel_area, double *y_angle_deg,
                                                     int64_t *undefined);
WFPSF_EXPORT wfpsf_status wfpsf_observation_fits_header(const wfpsf_observation *observation,
                                                        int32_t sca, int64_t capacity, char *text,
                                                        int64_t *length);
WFPSF_EXPORT wfpsf_status wfpsf_julian_date(int32_t year, int32_t month, int32_t day, int32_t hour,
                                            int32_t minute, double second, double *julian_date);
WFPSF_EXPORT wfpsf_status wfpsf_sun_position(double julian_date, const wfpsf_options *options,
                                             double *ra_deg, double *dec_deg);
WFPSF_EXPORT wfpsf_status wfpsf_pointing_allowed(const wfpsf_instrument *instrument, double ra_deg,
                                                 double dec_deg, double julian_date,
                                                 const wfpsf_options *options,
                                                 double *sun_angle_deg, int32_t *allowed);
WFPSF_EXPORT wfpsf_status wfpsf_pointing_best_pa(const wfpsf_instrument *instrument, double ra_deg,
                                                 double dec_deg, double julian_date,
                                                 const wfpsf_options *options, double *pa_deg);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_SED_H
#define WFPSF_SED_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_sed wfpsf_sed;
enum {
    WFPSF_SED_PHOTONS = 1,
    WFPSF_SED_ENERGY = 2
};
WFPSF_EXPORT wfpsf_status wfpsf_sed_create_table(int32_t unit, int64_t count,
                                                 const double *wavelength_nm, const double *density,
                                                 wfpsf_sed **out);
WFPSF_EXPORT wfpsf_status wfpsf_sed_create_power_law(int32_t unit, double exponent,
                                                     wfpsf_sed **out);
WFPSF_EXPORT wfpsf_status wfpsf_sed_create_black_body(double temperature_k, wfpsf_sed **out);
WFPSF_EXPORT wfpsf_status wfpsf_sed_create_redshifted(const wfpsf_sed *sed, double redshift,
                                                      wfpsf_sed **out);
WFPSF_EXPORT void wfpsf_sed_destroy(wfpsf_sed *sed);
WFPSF_EXPORT wfpsf_status wfpsf_sed_photon_density(const wfpsf_sed *sed, int64_t count,
                                                   const double *wavelength_nm, double *photons);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_PSF_H
#define WFPSF_PSF_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_psf wfpsf_psf;
#define WFPSF_PSF_PROPERTY_LIST(X) \
    X(WAVELENGTH_NM, 10, "wavelength, nm; of many, the mean by photons detected") \
    X(PIXEL_SCALE_ARCSEC, 20, "native pixel, arcsec") \
    X(ERROR_ESTIMATE, 30, "numerical error of any pixel, in units of the peak pixel") \
    X(MODEL_ERROR, 40, "error of the pupil's geometry against the published mask, same units") \
    X(PEAK, 50, "largest fraction of the light that one native pixel receives") \
    X(NODES, 60, "quadrature nodes, or pixels of the mask") \
    X(GRID_SIZE, 70, "side of the focal grid") \
    X(GRID_STEP_ARCSEC, 80, "step of the focal grid, arcsec") \
    X(RADIUS, 90, "half size of the field made in advance, native pixels") \
    X(LIT_AREA_M2, 100, "lit area of the pupil, m^2") \
    X(WAVELENGTHS, 110, "wavelengths that the PSF is a sum over")
#define WFPSF_PSF_PROPERTY_ENUM(name,key,text) WFPSF_PSF_ ##name = (key),
enum { WFPSF_PSF_PROPERTY_LIST(WFPSF_PSF_PROPERTY_ENUM) };
#undef WFPSF_PSF_PROPERTY_ENUM
WFPSF_EXPORT wfpsf_status wfpsf_options_set_opd(wfpsf_options *options, const wfpsf_image *map,
                                                double scale_m, double axis_x, double axis_y);
WFPSF_EXPORT wfpsf_status wfpsf_psf_create(const wfpsf_instrument *instrument, int32_t sca,
                                           double wavelength_nm, const wfpsf_options *options,
                                           wfpsf_psf **out);
WFPSF_EXPORT wfpsf_status wfpsf_psf_create_in_band(const wfpsf_instrument *instrument,
                                                   const char *band, int32_t sca, double x,
                                                   double y, double wavelength_nm,
                                                   const wfpsf_options *options, wfpsf_psf **out);
WFPSF_EXPORT wfpsf_status wfpsf_psf_create_chromatic(const wfpsf_instrument *instrument,
                                                     const char *band, int32_t sca, double x,
                                                     double y, int64_t count,
                                                     const wfpsf_sed *const *seds,
                                                     const wfpsf_options *options, wfpsf_psf **out);
WFPSF_EXPORT wfpsf_status wfpsf_psf_create_from_mask(const wfpsf_instrument *instrument,
                                                     const wfpsf_image *mask, double mask_scale_m,
                                                     double axis_x, double axis_y, int32_t sca,
                                                     double wavelength_nm,
                                                     const wfpsf_options *options, wfpsf_psf **out);
WFPSF_EXPORT void wfpsf_psf_destroy(wfpsf_psf *psf);
WFPSF_EXPORT wfpsf_status wfpsf_psf_draw(const wfpsf_psf *psf, double x, double y, double flux,
                                         const wfpsf_options *options, wfpsf_image *image);
WFPSF_EXPORT wfpsf_status wfpsf_psf_add_bright_star(const wfpsf_psf *psf, double x, double y,
                                                    double flux, const wfpsf_options *options,
                                                    wfpsf_image *image);
WFPSF_EXPORT wfpsf_status wfpsf_psf_draw_memory(const wfpsf_psf *psf, double x, double y,
                                                const wfpsf_image *image, int64_t *least,
                                                int64_t *most);
WFPSF_EXPORT wfpsf_status wfpsf_psf_add_stars(const wfpsf_psf *psf, int64_t count, const double *x,
                                              const double *y, const double *flux,
                                              const wfpsf_options *options, wfpsf_image *image);
WFPSF_EXPORT wfpsf_status wfpsf_psf_convolve(const wfpsf_psf *psf, const wfpsf_image *galaxy,
                                             double x, double y, double flux,
                                             const wfpsf_options *options, wfpsf_image *image);
WFPSF_EXPORT wfpsf_status wfpsf_psf_get(const wfpsf_psf *psf, int32_t key, double *value);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_VARYING_PSF_H
#define WFPSF_VARYING_PSF_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_varying_psf wfpsf_varying_psf;
#define WFPSF_VARYING_PSF_PROPERTY_LIST(X) \
    X(ERROR_ESTIMATE, 10, "numerical error of any pixel at any place, in units of the peak pixel") \
    X(INTERPOLATION_ERROR, 20, "the part of it that comes from the interpolation") \
    X(DEGREE, 30, "degree of the polynomials in each coordinate") \
    X(RANK, 40, "images that the PSFs of all places are sums of") \
    X(EXACT_PSFS, 50, "PSFs that were made to make and to check it") \
    X(MEMORY_BYTES, 60, "memory that it holds, bytes") \
    X(MARGIN, 70, "how far beyond the centres of the outermost pixels it reaches, pixels")
#define WFPSF_VARYING_PSF_PROPERTY_ENUM(name,key,text) WFPSF_VARYING_PSF_ ##name = (key),
enum { WFPSF_VARYING_PSF_PROPERTY_LIST(WFPSF_VARYING_PSF_PROPERTY_ENUM) };
#undef WFPSF_VARYING_PSF_PROPERTY_ENUM
WFPSF_EXPORT wfpsf_status wfpsf_varying_psf_create(const wfpsf_instrument *instrument,
                                                   const char *band, int32_t sca,
                                                   double wavelength_nm, const wfpsf_sed *sed,
                                                   const wfpsf_options *options,
                                                   wfpsf_varying_psf **out);
WFPSF_EXPORT void wfpsf_varying_psf_destroy(wfpsf_varying_psf *varying);
WFPSF_EXPORT wfpsf_status wfpsf_varying_psf_at(const wfpsf_varying_psf *varying, double x, double y,
                                               wfpsf_psf **out);
WFPSF_EXPORT wfpsf_status wfpsf_varying_psf_add_stars(const wfpsf_varying_psf *varying, double x0,
                                                      double y0, int64_t count, const double *x,
                                                      const double *y, const double *flux,
                                                      const wfpsf_options *options,
                                                      wfpsf_image *image);
WFPSF_EXPORT wfpsf_status wfpsf_varying_psf_get(const wfpsf_varying_psf *varying, int32_t key,
                                                double *value);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_OTF_H
#define WFPSF_OTF_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_otf wfpsf_otf;
#define WFPSF_OTF_PROPERTY_LIST(X) \
    X(ERROR_ESTIMATE, 10, "error of a PSF made of it, in units of the PSF's peak") \
    X(VALUE_ERROR, 20, "largest error of any value") \
    X(CUTOFF, 30, "frequency above which nothing passes along x or y, cycles per arcsec") \
    X(PIXELS, 40, "pixels across the pupil")
#define WFPSF_OTF_PROPERTY_ENUM(name,key,text) WFPSF_OTF_ ##name = (key),
enum { WFPSF_OTF_PROPERTY_LIST(WFPSF_OTF_PROPERTY_ENUM) };
#undef WFPSF_OTF_PROPERTY_ENUM
enum {
    WFPSF_RESPONSE_DIFFRACTION = 1,
    WFPSF_RESPONSE_EFFECTIVE = 2
};
enum {
    WFPSF_ORDER_CENTRED = 1,
    WFPSF_ORDER_WRAPPED = 2,
    WFPSF_ORDER_HALF = 3
};
WFPSF_EXPORT wfpsf_status wfpsf_otf_create(const wfpsf_psf *psf, const wfpsf_options *options,
                                           wfpsf_otf **out);
WFPSF_EXPORT void wfpsf_otf_destroy(wfpsf_otf *otf);
WFPSF_EXPORT wfpsf_status wfpsf_otf_values(const wfpsf_otf *otf, int32_t response, int64_t count,
                                           const double *kx, const double *ky, double *re,
                                           double *im);
WFPSF_EXPORT wfpsf_status wfpsf_otf_grid(const wfpsf_otf *otf, int32_t response, int32_t order,
                                         double step, wfpsf_image *re, wfpsf_image *im);
WFPSF_EXPORT wfpsf_status wfpsf_otf_get(const wfpsf_otf *otf, int32_t key, double *value);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_IPC_H
#define WFPSF_IPC_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_ipc_kernel wfpsf_ipc_kernel;
enum { WFPSF_IPC_SCATTER = 0, WFPSF_IPC_GATHER = 1 };
enum {
    WFPSF_EDGE_ZERO = 0,
    WFPSF_EDGE_REPLICATE = 1,
    WFPSF_EDGE_WRAP = 2,
    WFPSF_EDGE_CROP = 3,
    WFPSF_EDGE_FILL = 4,
    WFPSF_EDGE_VALID = 5
};
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create(double alpha, double alpha_prime,
                                                  double alpha_plus, const wfpsf_options *options,
                                                  wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_taps(int64_t nx, int64_t ny, const double *taps,
                                                       const wfpsf_options *options,
                                                       wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_wfc3(wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_default(const wfpsf_instrument *instrument,
                                                          wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_correction(const wfpsf_ipc_kernel *kernel,
                                                             wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_flipped(const wfpsf_ipc_kernel *kernel,
                                                          wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_read_fits(const char *path, const char *hdu,
                                                     const wfpsf_options *options,
                                                     wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_composed(const wfpsf_ipc_kernel *first,
                                                           const wfpsf_ipc_kernel *second,
                                                           wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_neumann(const wfpsf_ipc_kernel *kernel,
                                                          int64_t order, wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_create_autocorrelation(const wfpsf_ipc_kernel *kernel,
                                                                  wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_wfc3_deviations(int64_t capacity, double *deviations);
WFPSF_EXPORT void wfpsf_ipc_kernel_destroy(wfpsf_ipc_kernel *kernel);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_taps(const wfpsf_ipc_kernel *kernel, int64_t capacity,
                                                double *taps, int64_t *nx, int64_t *ny);
#define WFPSF_KERNEL_PROPERTY_LIST(X) \
    X(SUM, 10, "sum of the taps") \
    X(CENTROID_X, 20, "centroid along x, pixels; it moves every image by as much") \
    X(CENTROID_Y, 30, "centroid along y, pixels") \
    X(MXX, 40, "second moment about the centroid, pixels^2; it adds to every image's") \
    X(MXY, 50, "second moment about the centroid, pixels^2") \
    X(MYY, 60, "second moment about the centroid, pixels^2") \
    X(LEFT_RIGHT, 100, "largest difference between K(dx, dy) and K(-dx, dy)") \
    X(UP_DOWN, 110, "largest difference between K(dx, dy) and K(dx, -dy)") \
    X(HALF_TURN, 120, "largest difference between K(d) and K(-d): 0 if scatter is gather") \
    X(TRANSPOSED, 130, \
      "largest difference between K(dx, dy) and K(dy, dx); infinite unless square") \
    X(MARGIN, 200, "min |K^| over all frequencies") \
    X(MARGIN_FREQUENCY_X, 210, "where it is met, cycles per pixel") \
    X(MARGIN_FREQUENCY_Y, 220, "where it is met, cycles per pixel") \
    X(VARIANCE_RATIO, 300, "variance of white noise after the kernel over that before") \
    X(CONVERSION_GAIN_BIAS, 310, \
      "relative error of the conversion gain (signal per electron) from " \
      "mean and variance if the kernel is ignored") \
    X(QUANTUM_EFFICIENCY_BIAS, 320, "relative error of the quantum efficiency that follows") \
    X(INVERSE_NOISE, 330, "rms of white noise after the exact inverse over that before")
#define WFPSF_KERNEL_PROPERTY_ENUM(name,key,text) WFPSF_KERNEL_ ##name = (key),
enum { WFPSF_KERNEL_PROPERTY_LIST(WFPSF_KERNEL_PROPERTY_ENUM) };
#undef WFPSF_KERNEL_PROPERTY_ENUM
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_get(const wfpsf_ipc_kernel *kernel, int32_t key,
                                               double *value);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_transform(const wfpsf_ipc_kernel *kernel,
                                                     double frequency_x, double frequency_y,
                                                     double *real_part, double *imaginary_part);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_apply(const wfpsf_ipc_kernel *kernel, const wfpsf_image *in,
                                          int32_t edge, const wfpsf_options *options,
                                          wfpsf_image *out, int64_t *not_finite);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_kernel_self_test(const wfpsf_ipc_kernel *kernel,
                                                     const wfpsf_options *options, int64_t capacity,
                                                     double *response);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_correct(const wfpsf_ipc_kernel *kernel, const wfpsf_image *in,
                                            int32_t edge, const wfpsf_options *options,
                                            wfpsf_image *out, double *residual,
                                            double *noise_amplification, int64_t *passes,
                                            int64_t *not_finite);
WFPSF_EXPORT wfpsf_status wfpsf_ipc_covariance(const wfpsf_ipc_kernel *kernel,
                                               const wfpsf_image *variance, int64_t lag_x,
                                               int64_t lag_y, int32_t edge,
                                               const wfpsf_options *options, wfpsf_image *out);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_VARYING_IPC_H
#define WFPSF_VARYING_IPC_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_varying_ipc wfpsf_varying_ipc;
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_create_maps(const wfpsf_image *alpha,
                                                        const wfpsf_image *alpha_prime,
                                                        const wfpsf_image *alpha_plus,
                                                        const wfpsf_options *options,
                                                        wfpsf_varying_ipc **out);
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_create_polynomials(
    int64_t nx, int64_t ny, int64_t degree, const double *alpha, const double *alpha_prime,
    const double *alpha_plus, const wfpsf_options *options, wfpsf_varying_ipc **out);
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_create_regions(const wfpsf_image *regions,
                                                           int64_t count,
                                                           const wfpsf_ipc_kernel *const *kernels,
                                                           wfpsf_varying_ipc **out);
WFPSF_EXPORT void wfpsf_varying_ipc_destroy(wfpsf_varying_ipc *varying);
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_kernel(const wfpsf_varying_ipc *varying, int64_t x,
                                                   int64_t y, wfpsf_ipc_kernel **out);
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_margin(const wfpsf_varying_ipc *varying, double *margin,
                                                   int64_t *x, int64_t *y);
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_apply(const wfpsf_varying_ipc *varying,
                                                  const wfpsf_image *in, int32_t edge,
                                                  const wfpsf_options *options, wfpsf_image *out,
                                                  int64_t *not_finite);
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_correct(const wfpsf_varying_ipc *varying,
                                                    const wfpsf_image *in, int32_t edge,
                                                    const wfpsf_options *options, wfpsf_image *out,
                                                    double *residual, double *noise_amplification,
                                                    int64_t *passes, int64_t *not_finite);
WFPSF_EXPORT wfpsf_status wfpsf_varying_ipc_covariance(const wfpsf_varying_ipc *varying,
                                                       const wfpsf_image *variance, int64_t lag_x,
                                                       int64_t lag_y, int32_t edge,
                                                       const wfpsf_options *options,
                                                       wfpsf_image *out);
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
#ifndef WFPSF_CHAIN_H
#define WFPSF_CHAIN_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_chain wfpsf_chain;
enum {
    WFPSF_STEP_CLIP_NEGATIVE = 10,
    WFPSF_STEP_CHARGE_DIFFUSION = 20,
    WFPSF_STEP_BACKGROUND = 30,
    WFPSF_STEP_POISSON_NOISE = 40,
    WFPSF_STEP_QUANTISATION = 50,
    WFPSF_STEP_RECIPROCITY_FAILURE = 60,
    WFPSF_STEP_DARK_CURRENT = 70,
    WFPSF_STEP_DARK_CURRENT_MAP = 71,
    WFPSF_STEP_PERSISTENCE_LINEAR = 80,
    WFPSF_STEP_PERSISTENCE_FERMI = 81,
    WFPSF_STEP_NONLINEARITY = 90,
    WFPSF_STEP_NONLINEARITY_INVERSE = 100,
    WFPSF_STEP_CAPACITANCE_MAP = 110,
    WFPSF_STEP_IPC = 120,
    WFPSF_STEP_READ_NOISE = 130,
    WFPSF_STEP_SATURATION = 140,
    WFPSF_STEP_GAIN = 150,
    WFPSF_STEP_PIXEL_MASK =
        160
};
WFPSF_EXPORT wfpsf_status wfpsf_chain_create(wfpsf_chain **out);
WFPSF_EXPORT wfpsf_status wfpsf_chain_create_default(const wfpsf_instrument *instrument,
                                                     double exposure_time, wfpsf_chain **out);
WFPSF_EXPORT void wfpsf_chain_destroy(wfpsf_chain *chain);
WFPSF_EXPORT wfpsf_status wfpsf_chain_add(wfpsf_chain *chain, int32_t step, int64_t count,
                                          const double *parameters);
WFPSF_EXPORT wfpsf_status wfpsf_chain_add_ipc(wfpsf_chain *chain, const wfpsf_ipc_kernel *kernel,
                                              int32_t edge);
WFPSF_EXPORT wfpsf_status wfpsf_chain_add_varying_ipc(wfpsf_chain *chain,
                                                      const wfpsf_varying_ipc *varying,
                                                      int32_t form, int32_t edge);
WFPSF_EXPORT wfpsf_status wfpsf_chain_add_map(wfpsf_chain *chain, int32_t step, int64_t count,
                                              const double *parameters, const wfpsf_image *map);
WFPSF_EXPORT wfpsf_status wfpsf_chain_step(const wfpsf_chain *chain, int64_t index,
                                           int64_t capacity, double *parameters, int64_t *count,
                                           int32_t *step);
WFPSF_EXPORT const char *wfpsf_step_name(int32_t step);
WFPSF_EXPORT wfpsf_status wfpsf_chain_apply(const wfpsf_chain *chain, wfpsf_image *image,
                                            int64_t previous_count,
                                            const wfpsf_image *const *previous,
                                            const wfpsf_options *options, int64_t *not_finite,
                                            int64_t *saturated);
WFPSF_EXPORT wfpsf_status wfpsf_noise_add(wfpsf_image *image, double rms,
                                          const wfpsf_ipc_kernel *kernel,
                                          const wfpsf_options *options);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_SKY_H
#define WFPSF_SKY_H 
#ifdef __cplusplus
extern "C" {
#endif
WFPSF_EXPORT wfpsf_status wfpsf_sky_level(const wfpsf_instrument *instrument, const char *band,
                                          double longitude, double latitude, double *level);
WFPSF_EXPORT wfpsf_status wfpsf_sky_background(const wfpsf_instrument *instrument, const char *band,
                                               double longitude, double latitude,
                                               double exposure_time, double pixel_area,
                                               double *electrons);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_MOMENTS_H
#define WFPSF_MOMENTS_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_moments wfpsf_moments;
#define WFPSF_MOMENTS_PROPERTY_LIST(X) \
    X(CENTROID_X, 10, "centroid") \
    X(CENTROID_Y, 20, "centroid") \
    X(MXX, 30, "second moment") \
    X(MXY, 40, "second moment") \
    X(MYY, 50, "second moment") \
    X(SIGMA, 60, "size from the determinant, det(M)^(1/4)") \
    X(SIGMA_TRACE, 70, "size from the trace, sqrt(Mxx + Myy)") \
    X(E1, 80, "ellipticity along the axes") \
    X(E2, 90, "ellipticity along the diagonals") \
    X(E, 100, "|e|") \
    X(BETA, 110, "position angle of the major axis from x towards y, radians") \
    X(FLUX, 120, "flux of the best-fit Gaussian; of the pixels for unweighted moments") \
    X(RHO4, 130, "weighted fourth moment, 2 for a Gaussian") \
    X(PASSES, 140, "passes over the image") \
    X(ERROR_ESTIMATE, 150, "whitened error of centroid and moments") \
    X(RESIDUAL, 160, "norm of the gradient at the end, whitened") \
    X(CURVATURE, 170, "smallest eigenvalue of minus the Hessian, whitened; 1/8 for a Gaussian") \
    X(EDGE_FRACTION, 180, "fraction of the weight that falls outside the image") \
    X(MISSING_FRACTION, 190, "fraction of the squared weight that falls on missing pixels") \
    X(AMPLITUDE, 200, "central value of the best-fit Gaussian") \
    X(LAST_STEP, 210, "length of the last step, whitened") \
    X(PIXELS, 220, "pixels visited, all passes together") \
    X(BACKGROUND, 230, "background: fitted, or as it was given")
#define WFPSF_MOMENTS_PROPERTY_ENUM(name,key,text) WFPSF_MOMENTS_ ##name = (key),
enum { WFPSF_MOMENTS_PROPERTY_LIST(WFPSF_MOMENTS_PROPERTY_ENUM) };
#undef WFPSF_MOMENTS_PROPERTY_ENUM
WFPSF_EXPORT wfpsf_status wfpsf_moments_measure(const wfpsf_image *image,
                                                const wfpsf_options *options, wfpsf_moments **out);
WFPSF_EXPORT wfpsf_status wfpsf_moments_measure_masked(const wfpsf_image *image,
                                                       const wfpsf_image *missing,
                                                       const wfpsf_image *variance,
                                                       const wfpsf_options *options,
                                                       wfpsf_moments **out);
WFPSF_EXPORT wfpsf_status wfpsf_moments_measure_weighted(const wfpsf_image *image, double x,
                                                         double y, double Mxx, double Mxy,
                                                         double Myy, wfpsf_moments **out);
WFPSF_EXPORT wfpsf_status wfpsf_moments_sums(const wfpsf_image *image, double x, double y,
                                             const double *weight, int64_t count, double *sums);
WFPSF_EXPORT wfpsf_status wfpsf_moments_measure_unweighted(const wfpsf_image *image, double x,
                                                           double y, wfpsf_moments **out);
WFPSF_EXPORT void wfpsf_moments_destroy(wfpsf_moments *moments);
WFPSF_EXPORT wfpsf_status wfpsf_moments_status(const wfpsf_moments *moments);
WFPSF_EXPORT wfpsf_status wfpsf_moments_get(const wfpsf_moments *moments, int32_t key,
                                            double *value);
WFPSF_EXPORT wfpsf_status wfpsf_moments_covariance(const wfpsf_moments *moments, int32_t key_a,
                                                   int32_t key_b, double *value);
WFPSF_EXPORT wfpsf_status wfpsf_moments_differentiate(const wfpsf_moments *moments,
                                                      const wfpsf_image *image,
                                                      const wfpsf_image *change,
                                                      const wfpsf_image *second,
                                                      wfpsf_moments **out);
WFPSF_EXPORT wfpsf_status wfpsf_moments_influence(const wfpsf_moments *moments,
                                                  const wfpsf_image *image, int32_t key,
                                                  wfpsf_image *influence);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_SIZE_H
#define WFPSF_SIZE_H 
#ifdef __cplusplus
extern "C" {
#endif
enum {
    WFPSF_SIZE_BANDLIMITED = 1,
    WFPSF_SIZE_PIXEL_SUM = 2,
    WFPSF_SIZE_PIXEL_INTERPOLATED = 3
};
WFPSF_EXPORT wfpsf_status wfpsf_size_encircled_energy(const wfpsf_image *image, double x, double y,
                                                      double radius, const wfpsf_options *options,
                                                      double *fraction, double *error);
WFPSF_EXPORT wfpsf_status wfpsf_size_ee_radius(const wfpsf_image *image, double x, double y,
                                               double fraction, int32_t method,
                                               const wfpsf_options *options, double *radius,
                                               double *error);
WFPSF_EXPORT wfpsf_status wfpsf_size_fwhm(const wfpsf_image *image, double x, double y,
                                          double *fwhm);
WFPSF_EXPORT wfpsf_status wfpsf_size_ee_radius_derivative(
    const wfpsf_image *image, const wfpsf_image *change, const wfpsf_image *second, double x,
    double y, double fraction, const wfpsf_options *options, double *derivative, double *error);
WFPSF_EXPORT wfpsf_status wfpsf_size_profile(const wfpsf_image *image, double x, double y,
                                             int64_t count, const double *radii,
                                             const wfpsf_options *options, double *profile,
                                             double *errors);
WFPSF_EXPORT wfpsf_status wfpsf_size_profile_fwhm(const wfpsf_image *image, double x, double y,
                                                  const wfpsf_options *options, double *fwhm,
                                                  double *error);
#ifdef __cplusplus
}
#endif
#endif
#ifndef WFPSF_STUDY_H
#define WFPSF_STUDY_H 
#ifdef __cplusplus
extern "C" {
#endif
typedef struct wfpsf_study wfpsf_study;
#define WFPSF_STUDY_TABLE_LIST(X) \
    X(BANDS, 10, "table_bands", "wavelengths of the bands (Table 1), nm") \
    X(SIZES, 20, "table_sizes", "sizes and ellipticities, with and without IPC (Table 2)") \
    X(SENSITIVITIES, 30, "table_sensitivities", \
      "derivatives: exact ones, and those fitted on the paper's grids (Tables 3 and 4)") \
    X(LINEAR_LAW, 40, "table_linear_law", \
      "largest error of the linear laws on those grids, over the largest change there") \
    X(FIGURE_3, 103, "figure_03", "relative increase of sigma, percent, by alpha and alpha'") \
    X(FIGURE_4, 104, "figure_04", "relative increase of EE50 about the centroid, percent") \
    X(FIGURE_5, 105, "figure_05", "change of e1 by alpha and alpha'") \
    X(FIGURE_6, 106, "figure_06", "change of e2 by alpha and alpha'") \
    X(FIGURE_7, 107, "figure_07", "change of e1 by alpha and alpha+, alpha' = 0.002") \
    X(FIGURE_8, 108, "figure_08", "change of e2 by alpha and alpha+, alpha' = 0.002") \
    X(FIGURE_9, 109, "figure_09", "relative change of sigma, percent, about the nominal IPC") \
    X(FIGURE_10, 110, "figure_10", "1000 times the change of e1 about the nominal IPC") \
    X(FIGURE_11, 111, "figure_11", "1000 times the change of e2 about the nominal IPC") \
    X(REQUIREMENTS, 200, "table_requirements", \
      "section 6, all detectors: what errors of 1e-4 do, and the largest ones allowed") \
    X(COMPARISON, 210, "table_comparison", \
      "the paper's values, the peer's and these, with the reason for each difference above 1%") \
    X(CONVERGENCE, 220, "table_convergence", "errors against the oversampling N")
#define WFPSF_STUDY_ENUM(name,key,file,text) WFPSF_STUDY_ ##name = (key),
enum { WFPSF_STUDY_TABLE_LIST(WFPSF_STUDY_ENUM) };
#undef WFPSF_STUDY_ENUM
WFPSF_EXPORT wfpsf_status wfpsf_study_create(const wfpsf_instrument *instrument, int32_t sca,
                                             const wfpsf_options *options, wfpsf_study **out);
WFPSF_EXPORT void wfpsf_study_destroy(wfpsf_study *study);
WFPSF_EXPORT wfpsf_status wfpsf_study_size(const wfpsf_study *study, int32_t table, int64_t *rows,
                                           int64_t *columns);
WFPSF_EXPORT const char *wfpsf_study_column(const wfpsf_study *study, int32_t table,
                                            int64_t column);
WFPSF_EXPORT wfpsf_status wfpsf_study_value(const wfpsf_study *study, int32_t table, int64_t row,
                                            int64_t column, double *value);
WFPSF_EXPORT const char *wfpsf_study_text(const wfpsf_study *study, int32_t table, int64_t row,
                                          int64_t column);
WFPSF_EXPORT wfpsf_status wfpsf_study_write_csv(const wfpsf_study *study, const char *folder);
#ifdef __cplusplus
}
#endif
#endif
