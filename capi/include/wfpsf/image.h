/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file image.h
 * Images: strided pixels with a record of what has been done to them.
 *
 * Pixels: x runs along the fast axis, y upwards; the centre of the first pixel is (0, 0) and the
 * centre of the image is ((nx-1)/2, (ny-1)/2). Pixel (x, y) stands at
 * data[y * stride_y + x * stride_x]; strides count elements and may be negative. In FITS, NAXIS1 =
 * nx.
 *
 * An image may be oversampled: `oversampling` = N samples per native detector pixel along each
 * axis. "Pixels of the image" are its samples. Its record says which effects it has been through,
 * so that none is applied twice.
 *
 * Thread-safety: an image is mutable; callers that share one lock it themselves.
 */
#ifndef WFPSF_IMAGE_H
#define WFPSF_IMAGE_H

#include <wfpsf/options.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wfpsf_image wfpsf_image;

/** Pixel types. */
enum { WFPSF_FLOAT32 = 32, WFPSF_FLOAT64 = 64 };

/** Effects that an image can record as applied; the record is their sum. */
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

/** How the offsets of a dither are counted (wfpsf_image_interleave). */
enum {
    /** The detector moved by (dx, dy) pixels, 0 <= dx < 1: the paper's Eqs. 26-29. */
    WFPSF_DITHER_DETECTOR = 1,
    /** The object moved by (dx, dy) pixels, -1/2 < dx < 1/2: GalSim's interleaveImages. */
    WFPSF_DITHER_OBJECT = 2
};

/**
 * A new image of zeros that owns its pixels.
 *
 * Given:    pixel_type    WFPSF_FLOAT32 or WFPSF_FLOAT64
 *           nx, ny        >= 0
 *           oversampling  samples per native pixel, >= 1
 * Returned: out           the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_SIZE, ERROR_RANGE, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_image_create(int32_t pixel_type, int64_t nx, int64_t ny,
                                             int64_t oversampling, wfpsf_image **out);

/**
 * An image on the caller's own memory, which is neither copied nor freed and must outlive the
 * handle.
 *
 * Given:    pixel_type          type of the elements of data
 *           data                pixel (0, 0); may be NULL if the image is empty
 *           nx, ny              >= 0
 *           stride_x, stride_y  elements from a pixel to its neighbour; no two pixels may coincide
 *           oversampling        samples per native pixel, >= 1
 * Returned: out                 the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_SIZE, ERROR_RANGE, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_image_wrap(int32_t pixel_type, void *data, int64_t nx, int64_t ny,
                                           int64_t stride_x, int64_t stride_y, int64_t oversampling,
                                           wfpsf_image **out);

/** Frees an image; NULL is allowed. Wrapped memory stays. */
WFPSF_EXPORT void wfpsf_image_destroy(wfpsf_image *image);

/**
 * Type and size of an image. Any output may be NULL.
 *
 * Returned: pixel_type  WFPSF_FLOAT32 or WFPSF_FLOAT64
 *           nx, ny      pixels of the image, samples if it is oversampled
 * Status:   ERROR_NULL
 */
WFPSF_EXPORT wfpsf_status wfpsf_image_shape(const wfpsf_image *image, int32_t *pixel_type,
                                            int64_t *nx, int64_t *ny);

/**
 * The record of an image. Any output may be NULL.
 *
 * Returned: oversampling        samples per native pixel along each axis
 *           pixel_scale_arcsec  of a native pixel; 0: not stated
 *           applied             sum of WFPSF_EFFECT_*
 * Status:   ERROR_NULL
 */
WFPSF_EXPORT wfpsf_status wfpsf_image_record(const wfpsf_image *image, int64_t *oversampling,
                                             double *pixel_scale_arcsec, int32_t *applied);

/**
 * States the record of an image whose pixels come from elsewhere.
 *
 * Given:    oversampling        >= 1
 *           pixel_scale_arcsec  >= 0, finite
 *           applied             sum of WFPSF_EFFECT_*
 * Status:   ERROR_NULL, ERROR_RANGE, ERROR_ARGUMENT, ERROR_NOT_FINITE; the record is then unchanged
 */
WFPSF_EXPORT wfpsf_status wfpsf_image_set_record(wfpsf_image *image, int64_t oversampling,
                                                 double pixel_scale_arcsec, int32_t applied);

/**
 * Copies pixels, converting their type, and the record.
 *
 * Given:    from  the source
 * Returned: to    an image of the same size, sharing no memory with the source
 * Status:   ERROR_NULL, ERROR_SIZE, ERROR_OVERLAP
 */
WFPSF_EXPORT wfpsf_status wfpsf_image_copy(const wfpsf_image *from, wfpsf_image *to);

/**
 * Reads a two-dimensional FITS image of any BITPIX, plain or gzipped. The path is taken literally.
 * The record is read where this library wrote it; otherwise oversampling is 1 and nothing is
 * applied.
 *
 * Given:    path        of the file
 *           hdu         name of the extension, or its number counted from 0 as text; NULL: the
 *                       first image found
 *           pixel_type  type to convert to; 0: float32 for BITPIX -32, 8, 16, else float64
 * Returned: out         the handle; NULL on failure
 * Status:   ERROR_NULL, ERROR_ARGUMENT, ERROR_FILE_OPEN, ERROR_FILE_FORMAT, ERROR_NO_MEMORY
 */
WFPSF_EXPORT wfpsf_status wfpsf_image_read_fits(const char *path, const char *hdu,
                                                int32_t pixel_type, wfpsf_image **out);

/**
 * Writes an image and its record as the primary HDU of a FITS file; gzipped if the path ends in
 * ".gz". The file appears whole or not at all.
 *
 * Given:    path     of the file
 *           options  WFPSF_OPTION_FITS_OVERWRITE
 * Status:   ERROR_NULL, ERROR_SIZE (an empty image), ERROR_FILE_WRITE (also when the file exists
 *           and may not be overwritten)
 */
WFPSF_EXPORT wfpsf_status wfpsf_image_write_fits(const wfpsf_image *image, const char *path,
                                                 const wfpsf_options *options);

/**
 * Interleaves n_x * n_y dithered images into one that is sampled n_x, n_y times finer, with the
 * same pixel response (paper, Eqs. 26-29). Values are kept, so the flux grows n_x n_y times.
 *
 * Given:    n_x, n_y    dithers along x and y, >= 1
 *           images      n_x * n_y images of one size and type
 *           dx, dy      offset of each, native pixels, n_x * n_y numbers
 *           convention  WFPSF_DITHER_*
 * Returned: out         pixels of an image of size (n_x nx, n_y ny); its oversampling becomes n_x
 *                       times the inputs' if n_x = n_y, else is left alone
 * Status:   ERROR_NULL, ERROR_RANGE (n_x or n_y outside 1..4096, an offset that is none of the n_x
 *           or n_y equal steps within 1e-8), ERROR_NOT_FINITE, ERROR_ARGUMENT (a convention that is
 *           none, two images of one offset), ERROR_SIZE, ERROR_TYPE, ERROR_OVERLAP
 */
WFPSF_EXPORT wfpsf_status wfpsf_image_interleave(int64_t n_x, int64_t n_y,
                                                 const wfpsf_image *const *images, const double *dx,
                                                 const double *dy, int32_t convention,
                                                 wfpsf_image *out);

/**
 * The inverse of wfpsf_image_interleave().
 *
 * Given:    image       the fine image, of size (n_x nx, n_y ny)
 *           n_x, n_y, dx, dy, convention  as for interleave
 * Returned: out         n_x * n_y images of size (nx, ny), sharing no memory with each other
 * Status:   as for interleave; ERROR_ARGUMENT also if n_x = n_y does not divide the oversampling
 */
WFPSF_EXPORT wfpsf_status wfpsf_image_deinterleave(const wfpsf_image *image, int64_t n_x,
                                                   int64_t n_y, const double *dx, const double *dy,
                                                   int32_t convention, wfpsf_image *const *out);

#ifdef __cplusplus
}
#endif

#endif
