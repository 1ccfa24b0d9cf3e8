/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PSFs from the instrument's pupil: what is drawn, and what is refused. */
#include "aberrations.h"
#include "pixels.h"

#include <stdlib.h>

static const double wavelength_nm = 1292.11;

static wfpsf_psf *make_psf(const wfpsf_instrument *c5, double eps, double radius) {
    wfpsf_psf *psf = NULL;
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, eps));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, radius));
    CHECK_OK(wfpsf_psf_create(c5, 7, wavelength_nm, options, &psf));
    wfpsf_options_destroy(options);
    return psf;
}

static double number(const wfpsf_psf *psf, int32_t key) {
    double value = NAN;
    CHECK_OK(wfpsf_psf_get(psf, key, &value));
    return value;
}

static void draw(const wfpsf_psf *psf, int64_t nx, int64_t ny, int64_t oversampling, double x,
                 double y, double *data) {
    wfpsf_image *image = wrap_strided(data, nx, ny, 1, nx, oversampling);
    CHECK_OK(wfpsf_psf_draw(psf, x, y, 1, NULL, image));
    check_record(image, oversampling, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE);
    wfpsf_image_destroy(image);
}

static void test_properties(const wfpsf_instrument *c5) {
    wfpsf_psf *psf = make_psf(c5, 1e-6, 8);
    double value = 7;
#define CHECK_PROPERTY(name, key, text) CHECK(isfinite(number(psf, WFPSF_PSF_##name)));
    WFPSF_PSF_PROPERTY_LIST(CHECK_PROPERTY)
#undef CHECK_PROPERTY
    CHECK_NEAR(number(psf, WFPSF_PSF_WAVELENGTH_NM), wavelength_nm, 1e-9);
    CHECK_NEAR(number(psf, WFPSF_PSF_PIXEL_SCALE_ARCSEC), 0.11, 1e-15);
    CHECK(number(psf, WFPSF_PSF_ERROR_ESTIMATE) <= 1e-6);
    CHECK(number(psf, WFPSF_PSF_RADIUS) == 8);
    CHECK(number(psf, WFPSF_PSF_NODES) > 100 && number(psf, WFPSF_PSF_GRID_SIZE) > 16);

    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = 11", wfpsf_psf_get(psf, 11, &value));
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = -10", wfpsf_psf_get(psf, -10, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "psf", wfpsf_psf_get(NULL, WFPSF_PSF_PEAK, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "value", wfpsf_psf_get(psf, WFPSF_PSF_PEAK, NULL));
    CHECK(value == 7);
    wfpsf_psf_destroy(psf);
    wfpsf_psf_destroy(NULL);
}

static void check_refused(wfpsf_status status, const char *culprit, const wfpsf_instrument *c5,
                          int32_t sca, double wavelength) {
    wfpsf_psf *psf = STALE(wfpsf_psf);
    CHECK_FAILS(status, culprit, wfpsf_psf_create(c5, sca, wavelength, NULL, &psf));
    CHECK(psf == NULL);
}

static void test_create_refuses(const wfpsf_instrument *c5) {
    check_refused(WFPSF_ERROR_NULL, "instrument", NULL, 7, 1300);
    check_refused(WFPSF_ERROR_RANGE, "sca = 0", c5, 0, 1300);
    check_refused(WFPSF_ERROR_RANGE, "sca = 19", c5, 19, 1300);
    check_refused(WFPSF_ERROR_RANGE, "sca = -2147483648", c5, INT32_MIN, 1300);
    check_refused(WFPSF_ERROR_RANGE, "wavelength_nm = 0", c5, 7, 0);
    check_refused(WFPSF_ERROR_RANGE, "wavelength_nm = -1300", c5, 7, -1300);
    check_refused(WFPSF_ERROR_RANGE, "wavelength_nm = 99", c5, 7, 99);
    check_refused(WFPSF_ERROR_RANGE, "wavelength_nm = 100001", c5, 7, 100001);
    check_refused(WFPSF_ERROR_NOT_FINITE, "wavelength_nm = nan", c5, 7, NAN);
    check_refused(WFPSF_ERROR_NOT_FINITE, "wavelength_nm = inf", c5, 7, HUGE_VAL);
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_psf_create(c5, 7, 1300, NULL, NULL));
}

static void test_draw_refuses(const wfpsf_psf *psf) {
    double data[30];
    fill(data, 30, 7);
    wfpsf_image *image = wrap(data, 6, 5);
    CHECK_OK(wfpsf_image_set_record(image, 2, 0.5, WFPSF_EFFECT_IPC));
    CHECK_FAILS(WFPSF_ERROR_NULL, "psf", wfpsf_psf_draw(NULL, 2, 2, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_psf_draw(psf, 2, 2, 1, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "x = nan", wfpsf_psf_draw(psf, NAN, 2, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "y = inf",
                wfpsf_psf_draw(psf, 2, HUGE_VAL, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "flux = -inf",
                wfpsf_psf_draw(psf, 2, 2, -HUGE_VAL, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "flux = nan", wfpsf_psf_draw(psf, 2, 2, NAN, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "8200", wfpsf_psf_draw(psf, 8200, 2, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "-8193", wfpsf_psf_draw(psf, 2, -8193, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "1e+300", wfpsf_psf_draw(psf, 1e300, 2, 1, NULL, image));
    CHECK(all_are(data, 30, 7));
    check_record(image, 2, 0.5, WFPSF_EFFECT_IPC);
    wfpsf_image_destroy(image);
}

static void test_small_images(const wfpsf_psf *psf) {
    double whole[49], part[7];
    draw(psf, 0, 0, 1, 0, 0, NULL);
    draw(psf, 0, 9, 1, 3, 3, NULL);
    draw(psf, 7, 7, 3, 3.2, 2.9, whole);
    draw(psf, 1, 1, 3, 0.2, -0.1, part);
    CHECK_NEAR(part[0], whole[3 * 7 + 3], 1e-15);
    draw(psf, 7, 1, 3, 3.2, 2.9, part);
    for (int x = 0; x < 7; ++x)
        CHECK_NEAR(part[x], whole[x], 1e-15);
    draw(psf, 1, 7, 3, 3.2, 2.9, part);
    for (int y = 0; y < 7; ++y)
        CHECK_NEAR(part[y], whole[y * 7], 1e-15);
}

/* float32, backward axes and flux change the storage and the scale, not the values. */
static void test_storage(const wfpsf_psf *psf) {
    double data[99], flipped[99], bright[99];
    float single[99];
    draw(psf, 11, 9, 2, 5.3, 4.1, data);
    wfpsf_image *backward = wrap_flipped(flipped, 11, 9), *narrow = wrap_float(single, 11, 9),
                *scaled = wrap(bright, 11, 9);
    CHECK_OK(wfpsf_image_set_record(backward, 2, 0, 0));
    CHECK_OK(wfpsf_image_set_record(narrow, 2, 0, 0));
    CHECK_OK(wfpsf_image_set_record(scaled, 2, 0, 0));
    CHECK_OK(wfpsf_psf_draw(psf, 5.3, 4.1, 1, NULL, backward));
    CHECK_OK(wfpsf_psf_draw(psf, 5.3, 4.1, 1, NULL, narrow));
    CHECK_OK(wfpsf_psf_draw(psf, 5.3, 4.1, -2e6, NULL, scaled));
    for (int i = 0; i < 99; ++i) {
        CHECK(flipped[98 - i] == data[i]);
        CHECK_NEAR((double)single[i], data[i], 6e-8 * data[i] + 1e-12);
        CHECK_NEAR(bright[i], -2e6 * data[i], 2e6 * 1e-16);
    }
    wfpsf_image_destroy(backward);
    wfpsf_image_destroy(narrow);
    wfpsf_image_destroy(scaled);
}

/* A sample of a /N image is 1/N^2 of the native pixel centred there; a shift by whole samples
   shifts the image. */
static void test_native_and_oversampled(const wfpsf_psf *psf) {
    double native[81], fine[625], shifted[625];
    draw(psf, 9, 9, 1, 4.37, 3.85, native);
    for (int n = 2; n <= 3; ++n) {
        const int side = 8 * n + 1;
        draw(psf, side, side, n, 4.37 * n, 3.85 * n, fine);
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 9; ++x)
                CHECK_NEAR(n * n * fine[y * n * side + x * n], native[y * 9 + x], 2e-14);
        draw(psf, side, side, n, 4.37 * n + 1, 3.85 * n - 2, shifted);
        for (int y = 0; y < side - 2; ++y)
            for (int x = 1; x < side; ++x)
                CHECK_NEAR(shifted[y * side + x], fine[(y + 2) * side + x - 1], 2e-14);
    }
}

/* Beyond the radius made in advance a larger field is made: the same figures. */
static void test_beyond_radius(const wfpsf_instrument *c5) {
    enum { side = 41 };
    static double near_data[side * side], far_data[side * side];
    const double eps = 1e-8;
    wfpsf_psf *small = make_psf(c5, eps, 2), *large = make_psf(c5, eps, 24);
    draw(small, side, side, 1, 20.2, 19.7, near_data);
    draw(large, side, side, 1, 20.2, 19.7, far_data);
    const double peak = number(large, WFPSF_PSF_PEAK);
    for (int i = 0; i < side * side; ++i)
        CHECK_NEAR(near_data[i], far_data[i], 2 * eps * peak);
    draw(small, 1, 1, 1, -20.2, 5, near_data);
    draw(large, 1, 1, 1, -20.2, 5, far_data);
    CHECK_NEAR(near_data[0], far_data[0], 2 * eps * peak);
    wfpsf_psf_destroy(small);
    wfpsf_psf_destroy(large);
}

/* The centroid of a symmetric PSF is where the star was put, whatever the sizes and offsets. */
static void check_centroid(const wfpsf_psf *psf, int64_t nx, int64_t ny, int64_t oversampling,
                           double shift_x, double shift_y) {
    double *data = malloc(sizeof(double) * (size_t)(nx * ny)), x = NAN, y = NAN;
    wfpsf_image *image = wrap_strided(data, nx, ny, 1, nx, oversampling);
    wfpsf_moments *moments = NULL;
    const double star_x = (double)(nx - 1) / 2 + shift_x, star_y = (double)(ny - 1) / 2 + shift_y;
    CHECK_OK(wfpsf_psf_draw(psf, star_x, star_y, 1, NULL, image));
    if (oversampling > 2) {
        CHECK_OK(wfpsf_moments_measure(image, NULL, &moments));
    } else {
        /* too coarse for adaptive moments */
        CHECK_OK(wfpsf_moments_measure_unweighted(image, NAN, NAN, &moments));
    }
    CHECK_OK(wfpsf_moments_get(moments, WFPSF_MOMENTS_CENTROID_X, &x));
    CHECK_OK(wfpsf_moments_get(moments, WFPSF_MOMENTS_CENTROID_Y, &y));
    CHECK_NEAR(x, star_x, 1e-9 * (double)oversampling);
    CHECK_NEAR(y, star_y, 1e-9 * (double)oversampling);
    wfpsf_moments_destroy(moments);
    wfpsf_image_destroy(image);
    free(data);
}

static void test_symmetric(const wfpsf_instrument *c5) {
    wfpsf_options *options = perfect_annulus(c5, 12, 1e-10, 12);
    wfpsf_psf *psf = NULL;
    CHECK_OK(wfpsf_psf_create(c5, 12, wavelength_nm, options, &psf));
    wfpsf_options_destroy(options);
    for (int64_t n = 1; n <= 6; ++n)
        for (int64_t odd_x = 0; odd_x < 2; ++odd_x)
            for (int64_t odd_y = 0; odd_y < 2; ++odd_y)
                check_centroid(psf, 14 * n + (14 * n % 2 != odd_x), 12 * n + (12 * n % 2 != odd_y),
                               n, 0, 0);
    check_centroid(psf, 96, 95, 5, 0.5, -0.5); /* exactly half a sample */
    check_centroid(psf, 95, 96, 5, -2.5, 2.5); /* exactly half a pixel */

    /* stars half a pixel to either side are mirror images */
    double left[13 * 11], right[13 * 11];
    draw(psf, 13, 11, 1, 5.5, 5.5, left);
    draw(psf, 13, 11, 1, 6.5, 4.5, right);
    for (int i = 0; i < 13 * 11; ++i)
        CHECK_NEAR(left[i], right[13 * 11 - 1 - i], 1e-14);
    wfpsf_psf_destroy(psf);
}

/* The smallest eps is honoured, or the caller is warned that it is not. */
static void test_smallest_eps(const wfpsf_instrument *c5) {
    wfpsf_options *options = NULL;
    wfpsf_psf *psf = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-12));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 4));
    const wfpsf_status status = wfpsf_psf_create(c5, 1, 900, options, &psf);
    CHECK(psf != NULL);
    CHECK(status == (number(psf, WFPSF_PSF_ERROR_ESTIMATE) <= 1e-12 ? WFPSF_OK
                                                                    : WFPSF_WARNING_NOT_CERTIFIED));
    wfpsf_psf_destroy(psf);
    wfpsf_options_destroy(options);
}

/* Piston does nothing, tilt moves the star: one wave rms of Noll's Z2 = 2 rho cos(theta) is four
   waves across the diameter, and x grows where the phase falls. */
static void test_tilt(const wfpsf_instrument *c5) {
    const double tilt[3] = {0.3, 0.05, 0};
    double straight[17 * 17], tilted[17 * 17];
    wfpsf_options *options = NULL;
    wfpsf_psf *psf = make_psf(c5, 1e-9, 12), *other = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-9));
    CHECK_OK(wfpsf_options_set_zernikes(options, 3, tilt));
    CHECK_OK(wfpsf_psf_create(c5, 7, wavelength_nm, options, &other));
    const double shift = 4 * tilt[1] * 1293e-9 / 2.36 * 206264.80624709636 / 0.11;
    draw(psf, 17, 17, 1, 8 - shift, 8, straight);
    draw(other, 17, 17, 1, 8, 8, tilted);
    for (int i = 0; i < 17 * 17; ++i)
        CHECK_NEAR(tilted[i], straight[i], 1e-9);
    wfpsf_psf_destroy(psf);
    wfpsf_psf_destroy(other);
    wfpsf_options_destroy(options);
}

/* Stars in the image, on its border and far off, with one thread and several. */
static void test_add_stars(const wfpsf_psf *psf) {
    const double x[4] = {10.3, -0.5, 39, 1e300}, y[4] = {12.9, 20, -5.6, 0};
    const double flux[4] = {100, 70, 30, 1}, bad[4] = {1, 2, NAN, 3};
    double one[41 * 37] = {0}, many[41 * 37] = {0}, expected[41 * 37] = {0}, stamp[41 * 37];
    wfpsf_image *image = wrap(one, 41, 37), *shared = wrap(many, 41, 37);
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_psf_add_stars(psf, 4, x, y, flux, NULL, image));
    check_record(image, 1, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE);
    for (int k = 0; k < 3; ++k) {
        draw(psf, 41, 37, 1, x[k], y[k], stamp);
        for (int i = 0; i < 41 * 37; ++i)
            if (fabs(i % 41 - x[k]) <= 12 && fabs(i / 41 - y[k]) <= 12)
                expected[i] += flux[k] * stamp[i];
    }
    for (int i = 0; i < 41 * 37; ++i)
        CHECK_NEAR(one[i], expected[i], 1e-5);
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_THREADS, 5));
    CHECK_OK(wfpsf_psf_add_stars(psf, 4, x, y, flux, options, shared));
    CHECK(memcmp(one, many, sizeof one) == 0);

    CHECK_FAILS(WFPSF_ERROR_NULL, "psf", wfpsf_psf_add_stars(NULL, 4, x, y, flux, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NULL, "x", wfpsf_psf_add_stars(psf, 4, NULL, y, flux, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NULL, "y", wfpsf_psf_add_stars(psf, 4, x, NULL, flux, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NULL, "flux", wfpsf_psf_add_stars(psf, 4, x, y, NULL, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_psf_add_stars(psf, 4, x, y, flux, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = -1",
                wfpsf_psf_add_stars(psf, -1, x, y, flux, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "y[2] = nan",
                wfpsf_psf_add_stars(psf, 4, x, bad, flux, NULL, image));
    CHECK_OK(wfpsf_image_set_record(image, 1, 0.2, 0));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "0.2", wfpsf_psf_add_stars(psf, 4, x, y, flux, NULL, image));
    CHECK_OK(wfpsf_image_set_record(image, 1, 0, WFPSF_EFFECT_IPC));
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "interpixel",
                wfpsf_psf_add_stars(psf, 4, x, y, flux, NULL, image));
    CHECK(memcmp(one, many, sizeof one) == 0);
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_FORCE, 1));
    CHECK_OK(wfpsf_psf_add_stars(psf, 4, x, y, flux, options, image));
    CHECK_OK(wfpsf_psf_add_stars(psf, 0, NULL, NULL, NULL, NULL, shared));
    wfpsf_options_destroy(options);
    wfpsf_image_destroy(image);
    wfpsf_image_destroy(shared);
}

/* Without the pixel's response, which the record then does not claim. */
static void test_pixel_response(const wfpsf_instrument *instrument) {
    double sharp[9 * 9], fine[45 * 45], averaged[9 * 9];
    double x = 4, y = 4, flux = 1, mean = 0;
    wfpsf_options *options = NULL;
    wfpsf_psf *psf = NULL, *plain = NULL;
    wfpsf_image *image = wrap(sharp, 9, 9), *samples = wrap_strided(fine, 45, 45, 1, 45, 5);
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_PIXEL_RESPONSE, 0));
    CHECK_OK(wfpsf_psf_create(instrument, 7, 1292.11, options, &psf));
    CHECK_OK(wfpsf_psf_draw(psf, 4, 4, 1, NULL, image));
    check_record(image, 1, 0.11, 0);
    CHECK_OK(wfpsf_psf_add_stars(psf, 1, &x, &y, &flux, NULL, image));
    check_record(image, 1, 0.11, 0);
    CHECK_OK(wfpsf_image_set_record(image, 1, 0, WFPSF_EFFECT_PIXEL_RESPONSE));
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "pixel response",
                wfpsf_psf_add_stars(psf, 1, &x, &y, &flux, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "pixel response",
                wfpsf_psf_add_bright_star(psf, 4, 4, 1, NULL, image));

    /* Averaging over 5 x 5 samples is nearly the pixel's response; none is far from it. */
    CHECK_OK(wfpsf_psf_create(instrument, 7, 1292.11, NULL, &plain));
    CHECK_OK(wfpsf_psf_draw(psf, 22, 22, 1, NULL, samples));
    CHECK_OK(wfpsf_image_set_record(image, 1, 0, 0));
    CHECK_OK(wfpsf_psf_draw(plain, 4, 4, 1, NULL, image));
    memcpy(averaged, sharp, sizeof averaged);
    for (int j = 20; j < 25; ++j)
        for (int i = 20; i < 25; ++i)
            mean += fine[45 * j + i];
    CHECK_NEAR(mean, averaged[40], 0.02 * averaged[40]);
    CHECK(25 * fine[45 * 22 + 22] > 1.1 * averaged[40]);
    wfpsf_options_destroy(options);
    wfpsf_psf_destroy(psf);
    wfpsf_psf_destroy(plain);
    wfpsf_image_destroy(image);
    wfpsf_image_destroy(samples);
}

/* By band and place: Roman's pupils and aberrations depend on both, C5's on neither. */
static void test_in_band(const wfpsf_instrument *c5) {
    double one[17 * 17], other[17 * 17];
    wfpsf_instrument *roman = NULL;
    wfpsf_options *options = NULL;
    wfpsf_psf *science = NULL, *pupil = NULL, *psf = NULL;
    CHECK_OK(wfpsf_instrument_create("roman-c9", &roman));
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_psf_create_in_band(roman, "J129", 18, 10, 4000, 0, options, &science));
    CHECK_NEAR(number(science, WFPSF_PSF_WAVELENGTH_NM), 1293.6037310202814, 1e-6);
    CHECK(number(science, WFPSF_PSF_ERROR_ESTIMATE) <= 1e-6);
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_FRAME, 1));
    CHECK_OK(wfpsf_psf_create_in_band(roman, "J129", 18, 10, 4000, 0, options, &pupil));
    draw(science, 17, 17, 1, 8.3, 7.9, one);
    draw(pupil, 17, 17, 1, 8.3, 16 - 7.9, other);
    double change = 0;
    for (int y = 0; y < 17; ++y)
        for (int x = 0; x < 17; ++x) {
            CHECK_NEAR(one[y * 17 + x], other[(16 - y) * 17 + x], 1e-14);
            change = fmax(change, fabs(one[y * 17 + x] - one[(16 - y) * 17 + x]));
        }
    CHECK(change > 1e-3); /* the flip is seen */
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_FIELD_RULE, 1));
    CHECK_OK(wfpsf_psf_create_in_band(roman, "J129", 18, 1000, 4000, 0, options, &psf));
    wfpsf_psf_destroy(psf);

    CHECK_OK(wfpsf_psf_create_in_band(c5, "J129", 7, 3, 4000, wavelength_nm, NULL, &psf));
    draw(psf, 17, 17, 1, 8.3, 7.9, one);
    wfpsf_psf_destroy(psf);
    CHECK_OK(wfpsf_psf_create(c5, 7, wavelength_nm, NULL, &psf));
    draw(psf, 17, 17, 1, 8.3, 7.9, other);
    CHECK(memcmp(one, other, sizeof one) == 0);
    wfpsf_psf_destroy(psf);

    const struct {
        const char *band;
        int32_t sca;
        double x, y, wavelength;
        wfpsf_status status;
        const char *culprit;
    } bad[] = {{"J130", 1, 0, 0, 0, WFPSF_ERROR_UNKNOWN_NAME, "J130"},
               {"J129", 0, 0, 0, 0, WFPSF_ERROR_RANGE, "sca = 0"},
               {"J129", 19, 0, 0, 0, WFPSF_ERROR_RANGE, "sca = 19"},
               {"J129", 1, NAN, 0, 0, WFPSF_ERROR_NOT_FINITE, "x = nan"},
               {"J129", 1, 0, HUGE_VAL, 0, WFPSF_ERROR_NOT_FINITE, "y = inf"},
               {"J129", 1, 0, 1e4, 0, WFPSF_ERROR_RANGE, "10000"},
               {"J129", 1, -1e4, 0, 0, WFPSF_ERROR_RANGE, "-10000"},
               {"J129", 1, 0, 0, -3, WFPSF_ERROR_RANGE, "wavelength_nm = -3"}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        psf = STALE(wfpsf_psf);
        CHECK_FAILS(bad[i].status, bad[i].culprit,
                    wfpsf_psf_create_in_band(roman, bad[i].band, bad[i].sca, bad[i].x, bad[i].y,
                                             bad[i].wavelength, NULL, &psf));
        CHECK(psf == NULL);
    }
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument",
                wfpsf_psf_create_in_band(NULL, "J129", 1, 0, 0, 0, NULL, &psf));
    CHECK_FAILS(WFPSF_ERROR_NULL, "band",
                wfpsf_psf_create_in_band(roman, NULL, 1, 0, 0, 0, NULL, &psf));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out",
                wfpsf_psf_create_in_band(roman, "J129", 1, 0, 0, 0, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "roman-c9", wfpsf_psf_create(roman, 1, 1300, NULL, &psf));
    wfpsf_psf_destroy(science);
    wfpsf_psf_destroy(pupil);
    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(roman);
}

int main(void) {
    wfpsf_instrument *c5 = NULL;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    test_properties(c5);
    test_create_refuses(c5);
    test_beyond_radius(c5);
    test_symmetric(c5);
    test_smallest_eps(c5);
    test_tilt(c5);
    test_in_band(c5);
    test_pixel_response(c5);
    wfpsf_psf *psf = make_psf(c5, 1e-7, 12);
    wfpsf_instrument_destroy(c5); /* the PSF stands on its own */
    test_draw_refuses(psf);
    test_small_images(psf);
    test_storage(psf);
    test_native_and_oversampled(psf);
    test_add_stars(psf);
    wfpsf_psf_destroy(psf);
    return checked();
}
