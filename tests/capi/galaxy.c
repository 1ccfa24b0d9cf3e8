/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Extended sources, and every wrong way to ask for them. */
#include "pixels.h"

enum { nx = 12, ny = 9, side = 7, samples = 4 };

/* What stars at every sample add up to. */
static void check_sum_of_stars(const wfpsf_psf *psf, const double *galaxy, double x, double y,
                               double flux, const double *got, double tolerance) {
    double sum[nx * ny] = {0}, star[nx * ny];
    wfpsf_image *image = wrap(star, nx, ny);
    for (int b = 0; b < side; ++b)
        for (int a = 0; a < side; ++a) {
            CHECK_OK(wfpsf_psf_draw(psf, x + (a - (side - 1) / 2.0) / samples,
                                    y + (b - (side - 1) / 2.0) / samples,
                                    flux * galaxy[b * side + a], NULL, image));
            for (int i = 0; i < nx * ny; ++i)
                sum[i] += star[i];
        }
    for (int i = 0; i < nx * ny; ++i)
        CHECK_NEAR(got[i], sum[i], tolerance);
    wfpsf_image_destroy(image);
}

static void test_values(const wfpsf_psf *psf) {
    double source[side * side], out[nx * ny];
    float single[nx * ny];
    fill_noise(source, side * side);
    double total = 0;
    for (int i = 0; i < side * side; ++i)
        total += source[i];
    wfpsf_image *galaxy = wrap_strided(source, side, side, 1, side, samples);
    wfpsf_image *image = wrap(out, nx, ny), *image_single = wrap_float(single, nx, ny);
    fill(out, nx * ny, NAN);
    CHECK_OK(wfpsf_psf_convolve(psf, galaxy, 5.3, 4.9, -0.5, NULL, image));
    check_sum_of_stars(psf, source, 5.3, 4.9, -0.5, out, 1e-5 * total);
    check_record(image, 1, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE);
    CHECK_OK(wfpsf_psf_convolve(psf, galaxy, 5.3, 4.9, -0.5, NULL, image_single));
    for (int i = 0; i < nx * ny; ++i)
        CHECK_NEAR(single[i], out[i], 1e-7 * total);

    wfpsf_image *backwards = wrap_flipped(out, nx, ny);
    CHECK_OK(wfpsf_psf_convolve(psf, galaxy, 5.3, 4.9, -0.5, NULL, backwards));
    for (int i = 0; i < nx * ny; ++i)
        CHECK_NEAR(single[i], out[nx * ny - 1 - i], 1e-7 * total);

    wfpsf_image *none = wrap(NULL, 0, 0);
    CHECK_OK(wfpsf_psf_convolve(psf, galaxy, 0, 0, 1, NULL, none));
    CHECK_OK(wfpsf_image_set_record(none, 1, 0, 0));
    CHECK_OK(wfpsf_psf_convolve(psf, none, 0, 0, 1, NULL, image));
    CHECK(all_are(out, nx * ny, 0));
    wfpsf_image_destroy(none);
    wfpsf_image_destroy(backwards);
    wfpsf_image_destroy(image_single);
    wfpsf_image_destroy(image);
    wfpsf_image_destroy(galaxy);
}

static void test_refuses(const wfpsf_psf *psf) {
    double source[side * side], out[nx * ny];
    fill(source, side * side, 1);
    fill(out, nx * ny, 7);
    wfpsf_image *g = wrap_strided(source, side, side, 1, side, samples), *image = wrap(out, nx, ny);
    CHECK_FAILS(WFPSF_ERROR_NULL, "psf", wfpsf_psf_convolve(NULL, g, 1, 1, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NULL, "galaxy", wfpsf_psf_convolve(psf, NULL, 1, 1, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_psf_convolve(psf, g, 1, 1, 1, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "x = nan",
                wfpsf_psf_convolve(psf, g, NAN, 1, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "y = inf",
                wfpsf_psf_convolve(psf, g, 1, HUGE_VAL, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "flux = nan",
                wfpsf_psf_convolve(psf, g, 1, 1, NAN, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "4096", wfpsf_psf_convolve(psf, g, 1e5, 1, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "4096", wfpsf_psf_convolve(psf, g, 1, -1e300, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_OVERLAP, "shares", wfpsf_psf_convolve(psf, g, 1, 1, 1, NULL, g));

    CHECK_OK(wfpsf_image_set_record(image, 3, 0, 0));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "galaxy: has 4",
                wfpsf_psf_convolve(psf, g, 1, 1, 1, NULL, image));
    CHECK_OK(wfpsf_image_set_record(image, 1, 0, 0));
    CHECK_OK(wfpsf_image_set_record(g, samples, 0.2, 0));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "galaxy: has pixels of 0.2",
                wfpsf_psf_convolve(psf, g, 1, 1, 1, NULL, image));
    CHECK_OK(wfpsf_image_set_record(g, INT32_MAX, 0, 0));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "8192", wfpsf_psf_convolve(psf, g, 1, 1, 1, NULL, image));
    source[9] = NAN;
    CHECK_OK(wfpsf_image_set_record(g, samples, 0, 0));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "(2, 1) = nan",
                wfpsf_psf_convolve(psf, g, 1, 1, 1, NULL, image));
    source[9] = 1;
    CHECK_OK(wfpsf_image_set_record(g, samples, 0, WFPSF_EFFECT_PIXEL_RESPONSE));
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "pixel response",
                wfpsf_psf_convolve(psf, g, 1, 1, 1, NULL, image));
    CHECK(all_are(out, nx * ny, 7));
    wfpsf_options *force = NULL;
    CHECK_OK(wfpsf_options_create(&force));
    CHECK_OK(wfpsf_options_set_integer(force, WFPSF_OPTION_FORCE, 1));
    CHECK_OK(wfpsf_psf_convolve(psf, g, 1, 1, 1, force, image));
    wfpsf_options_destroy(force);
    wfpsf_image_destroy(g);
    wfpsf_image_destroy(image);
}

int main(void) {
    wfpsf_instrument *c5 = NULL;
    wfpsf_psf *psf = NULL;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    CHECK_OK(wfpsf_psf_create(c5, 7, 1292, NULL, &psf));
    test_values(psf);
    test_refuses(psf);
    wfpsf_psf_destroy(psf);
    wfpsf_instrument_destroy(c5);
    return checked();
}
