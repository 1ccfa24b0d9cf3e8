/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Path difference maps among the options: what they do to a PSF, and every wrong one. */
#include "pixels.h"

#include <stdio.h>
#include <unistd.h>

enum { side = 96, size = 15 };
static const double scale = 0.03, axis = (side - 1) / 2.0, wavelength_nm = 1500,
                    reference_nm = 1293;
static double samples[side * side];

/* a metres of defocus (Noll's Z_4). */
static void fill_defocus(double a) {
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double u = (x - axis) * scale / 1.18, v = (y - axis) * scale / 1.18;
            samples[y * side + x] = a * sqrt(3) * (2 * (u * u + v * v) - 1);
        }
}

static void draw(const wfpsf_instrument *c5, const wfpsf_options *options, double *data) {
    wfpsf_psf *psf = NULL;
    wfpsf_image *image = wrap(data, size, size);
    CHECK_OK(wfpsf_psf_create(c5, 7, wavelength_nm, options, &psf));
    CHECK_OK(wfpsf_psf_draw(psf, 7.2, 6.9, 1, NULL, image));
    wfpsf_image_destroy(image);
    wfpsf_psf_destroy(psf);
}

static double difference(const double *a, const double *b) {
    double worst = 0, peak = 0;
    for (int i = 0; i < size * size; ++i) {
        worst = fmax(worst, fabs(a[i] - b[i]));
        peak = fmax(peak, b[i]);
    }
    return worst / peak;
}

static wfpsf_options *new_options(void) {
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-9));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 8));
    return options;
}

/* 0.2 waves of defocus, as a coefficient and as a map from an array, from the array backwards, in
   single precision and from a file. */
static void test_defocus(const wfpsf_instrument *c5) {
    static float narrow[side * side];
    const double zernikes[4] = {0, 0, 0, 0.2};
    double truth[size * size], plain[size * size], data[size * size];
    char path[64];
    wfpsf_options *by_coefficient = new_options(), *by_map = new_options();
    wfpsf_image *map = NULL;
    CHECK_OK(wfpsf_options_set_zernikes(by_coefficient, 4, zernikes));
    draw(c5, by_map, plain);
    draw(c5, by_coefficient, truth);
    CHECK(difference(plain, truth) > 0.1);

    fill_defocus(0.2 * reference_nm * 1e-9);
    for (int i = 0; i < side * side; ++i)
        narrow[i] = (float)samples[i];
    map = wrap(samples, side, side);
    snprintf(path, sizeof path, "opd_test_%ld.fits", (long)getpid());
    CHECK_OK(wfpsf_image_write_fits(map, path, NULL));
    CHECK_OK(wfpsf_options_set_opd(by_map, map, scale, axis, axis));
    wfpsf_image_destroy(map);
    map = wrap_flipped(samples, side, side);
    draw(c5, by_map, data);
    CHECK_NEAR(difference(data, truth), 0, 2e-9);
    CHECK_OK(wfpsf_options_set_opd(by_map, map, scale, axis, axis));
    wfpsf_image_destroy(map);
    draw(c5, by_map, data);
    CHECK_NEAR(difference(data, truth), 0, 2e-9);

    CHECK_OK(wfpsf_image_read_fits(path, NULL, WFPSF_FLOAT64, &map));
    remove(path);
    CHECK_OK(wfpsf_options_set_opd(by_map, map, scale, axis, axis));
    wfpsf_image_destroy(map);
    draw(c5, by_map, data);
    CHECK_NEAR(difference(data, truth), 0, 2e-9);

    map = wrap_float(narrow, side, side);
    CHECK_OK(wfpsf_options_set_opd(by_map, map, scale, axis, axis));
    wfpsf_image_destroy(map);
    draw(c5, by_map, data);
    CHECK_NEAR(difference(data, truth), 0, 1e-6);

    CHECK_OK(wfpsf_options_set_opd(by_map, NULL, 0, 0, 0));
    draw(c5, by_map, data);
    CHECK(are_equal(data, plain, size * size));
    wfpsf_options_destroy(by_map);
    wfpsf_options_destroy(by_coefficient);
}

/* White noise beyond what the nodes can follow: a warning, and an estimate above EPS. */
static void test_rough_map(const wfpsf_instrument *c5) {
    double estimate = 0;
    wfpsf_options *options = new_options();
    wfpsf_psf *psf = NULL;
    wfpsf_image *map = wrap(samples, side, side);
    fill_noise(samples, side * side);
    for (int i = 0; i < side * side; ++i)
        samples[i] *= 1e-11;
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 3));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-12));
    CHECK_OK(wfpsf_options_set_opd(options, map, scale, axis, axis));
    CHECK_FAILS(WFPSF_WARNING_NOT_CERTIFIED, "EPS",
                wfpsf_psf_create(c5, 7, wavelength_nm, options, &psf));
    CHECK_OK(wfpsf_psf_get(psf, WFPSF_PSF_ERROR_ESTIMATE, &estimate));
    CHECK(estimate > 1e-12);
    wfpsf_psf_destroy(psf);
    wfpsf_image_destroy(map);
    wfpsf_options_destroy(options);
}

static void test_wrong_maps(const wfpsf_instrument *c5) {
    double before[size * size], after[size * size];
    wfpsf_options *options = new_options();
    wfpsf_image *map = wrap(samples, side, side), *small = wrap(samples, 3, 5), *empty = NULL;
    CHECK_OK(wfpsf_image_create(WFPSF_FLOAT64, 0, 7, 1, &empty));
    fill_defocus(1e-7);
    CHECK_OK(wfpsf_options_set_opd(options, map, scale, axis, axis));
    draw(c5, options, before);

    CHECK_FAILS(WFPSF_ERROR_NULL, "options", wfpsf_options_set_opd(NULL, map, scale, axis, axis));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "scale_m = 0", wfpsf_options_set_opd(options, map, 0, 0, 0));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "scale_m = 1.5", wfpsf_options_set_opd(options, map, 1.5, 0, 0));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "scale_m = nan",
                wfpsf_options_set_opd(options, map, NAN, 0, 0));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "axis_x = inf",
                wfpsf_options_set_opd(options, map, scale, HUGE_VAL, 0));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "axis_y = 2e+06",
                wfpsf_options_set_opd(options, map, scale, 0, 2e6));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "map", wfpsf_options_set_opd(options, small, scale, 0, 0));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "map", wfpsf_options_set_opd(options, empty, scale, 0, 0));
    samples[2 * side + 5] = NAN;
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "map sample (5, 2) = nan",
                wfpsf_options_set_opd(options, map, scale, axis, axis));
    samples[2 * side + 5] = 35;
    CHECK_FAILS(WFPSF_ERROR_RANGE, "map sample (5, 2) = 35",
                wfpsf_options_set_opd(options, map, scale, axis, axis));
    draw(c5, options, after);
    CHECK(are_equal(before, after, size * size));
    wfpsf_image_destroy(empty);
    wfpsf_image_destroy(small);
    wfpsf_image_destroy(map);
    wfpsf_options_destroy(options);
}

int main(void) {
    wfpsf_instrument *c5 = NULL;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    test_defocus(c5);
    test_rough_map(c5);
    test_wrong_maps(c5);
    wfpsf_instrument_destroy(c5);
    return checked();
}
