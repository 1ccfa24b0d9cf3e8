/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Images on the program's own arrays. */
#ifndef WFPSF_TESTS_PIXELS_H
#define WFPSF_TESTS_PIXELS_H

#include "check.h"

/* Stands for a handle that was there before the call. */
#define STALE(type) ((type *)(uintptr_t)0x10)

static inline wfpsf_image *wrap_strided(double *data, int64_t nx, int64_t ny, int64_t stride_x,
                                        int64_t stride_y, int64_t oversampling) {
    wfpsf_image *image = NULL;
    CHECK_OK(
        wfpsf_image_wrap(WFPSF_FLOAT64, data, nx, ny, stride_x, stride_y, oversampling, &image));
    return image;
}

static inline wfpsf_image *wrap(double *data, int64_t nx, int64_t ny) {
    return wrap_strided(data, nx, ny, 1, nx, 1);
}

static inline wfpsf_image *wrap_float(float *data, int64_t nx, int64_t ny) {
    wfpsf_image *image = NULL;
    CHECK_OK(wfpsf_image_wrap(WFPSF_FLOAT32, data, nx, ny, 1, nx, 1, &image));
    return image;
}

/* The same array seen from its last pixel: both axes run backwards. */
static inline wfpsf_image *wrap_flipped(double *data, int64_t nx, int64_t ny) {
    return wrap_strided(data + nx * ny - 1, nx, ny, -1, -nx, 1);
}

static inline void fill(double *data, int64_t count, double value) {
    for (int64_t i = 0; i < count; ++i)
        data[i] = value;
}

static inline int all_are(const double *data, int64_t count, double value) {
    for (int64_t i = 0; i < count; ++i)
        if (data[i] != value)
            return 0;
    return 1;
}

static inline int are_equal(const double *a, const double *b, int64_t count) {
    for (int64_t i = 0; i < count; ++i)
        if (a[i] != b[i])
            return 0;
    return 1;
}

/* A Gaussian of peak 1, sampled at the pixel centres. */
static inline void fill_gaussian(double *data, int64_t nx, int64_t ny, double x0, double y0,
                                 double Mxx, double Mxy, double Myy) {
    const double det = Mxx * Myy - Mxy * Mxy;
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x) {
            const double dx = (double)x - x0, dy = (double)y - y0;
            data[y * nx + x] =
                exp(-(Myy * dx * dx - 2 * Mxy * dx * dy + Mxx * dy * dy) / (2 * det));
        }
}

/* Whole numbers without a pattern. */
static inline void fill_noise(double *data, int64_t count) {
    uint32_t state = 12345;
    for (int64_t i = 0; i < count; ++i) {
        state = state * 1664525u + 1013904223u;
        data[i] = (double)(state >> 16);
    }
}

static inline void check_record(const wfpsf_image *image, int64_t oversampling, double scale,
                                int32_t applied) {
    int64_t got_oversampling = 0;
    double got_scale = -1;
    int32_t got_applied = -1;
    CHECK_OK(wfpsf_image_record(image, &got_oversampling, &got_scale, &got_applied));
    CHECK(got_oversampling == oversampling);
    CHECK_NEAR(got_scale, scale, 1e-15 * scale);
    CHECK(got_applied == applied);
}

#endif
