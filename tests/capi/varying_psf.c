/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The PSF all over a detector: at a place, for stars, and what is refused. */
#include "pixels.h"

enum { side = 15 };

static double get(const wfpsf_varying_psf *varying, int32_t key) {
    double value = NAN;
    CHECK_OK(wfpsf_varying_psf_get(varying, key, &value));
    return value;
}

static void draw(const wfpsf_psf *psf, double *pixels) {
    wfpsf_image *image = wrap(pixels, side, side);
    CHECK_OK(wfpsf_psf_draw(psf, 7.2, 6.9, 1, NULL, image));
    wfpsf_image_destroy(image);
}

/* As good as the PSF made for the place; nothing it was made from is needed any more. */
static void test_places(void) {
    const double eps = 1e-5;
    double exact[side * side], model[side * side], peak = 0;
    wfpsf_instrument *roman = NULL;
    wfpsf_options *options = NULL;
    wfpsf_varying_psf *varying = NULL;
    wfpsf_psf *psf = NULL, *there = NULL;
    CHECK_OK(wfpsf_instrument_create("roman-c9", &roman));
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, eps));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 8));
    CHECK_OK(wfpsf_options_set_zernikes(options, 5, (const double[]){0, 0, 0, 0.01, 0.02}));
    CHECK_OK(wfpsf_psf_create_in_band(roman, "J129", 6, 4321, -77, 1300, options, &psf));
    CHECK_OK(wfpsf_varying_psf_create(roman, "J129", 6, 1300, NULL, options, &varying));
    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(roman);
    CHECK_OK(wfpsf_varying_psf_at(varying, 4321, -77, &there));
    draw(psf, exact);
    draw(there, model);
    for (int p = 0; p < side * side; ++p)
        peak = fmax(peak, exact[p]);
    for (int p = 0; p < side * side; ++p)
        CHECK_NEAR(model[p], exact[p], 2 * eps * peak);
    CHECK(get(varying, WFPSF_VARYING_PSF_ERROR_ESTIMATE) <= eps);
    CHECK(get(varying, WFPSF_VARYING_PSF_INTERPOLATION_ERROR) > 0);
    CHECK(get(varying, WFPSF_VARYING_PSF_DEGREE) >= 2);
    CHECK(get(varying, WFPSF_VARYING_PSF_RANK) > 1);
    CHECK(get(varying, WFPSF_VARYING_PSF_EXACT_PSFS) > 9);
    CHECK(get(varying, WFPSF_VARYING_PSF_MEMORY_BYTES) > 1e5);
    CHECK(get(varying, WFPSF_VARYING_PSF_MARGIN) == 512);

    /* A star in an image that begins at (4314, -84): the same light to a tenth of eps, on threads
       too. */
    {
        const double x = 7.2, y = 6.9, flux = 1;
        double pixels[side * side], threaded[side * side];
        wfpsf_options *two = NULL;
        wfpsf_image *image = wrap(pixels, side, side), *other = wrap(threaded, side, side);
        fill(pixels, side * side, 0);
        fill(threaded, side * side, 0);
        CHECK_OK(wfpsf_options_create(&two));
        CHECK_OK(wfpsf_options_set_integer(two, WFPSF_OPTION_THREADS, 2));
        CHECK_OK(
            wfpsf_varying_psf_add_stars(varying, 4313.8, -83.9, 1, &x, &y, &flux, NULL, image));
        CHECK_OK(wfpsf_varying_psf_add_stars(varying, 4313.8, -83.9, 1, &x, &y, &flux, two, other));
        CHECK(are_equal(pixels, threaded, side * side));
        for (int p = 0; p < side * side; ++p)
            CHECK_NEAR(pixels[p], model[p], 0.1 * eps * peak);
        check_record(image, 1, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE);
        CHECK_FAILS(WFPSF_ERROR_RANGE, "star 0",
                    wfpsf_varying_psf_add_stars(varying, 4600, 0, 1, &x, &y, &flux, NULL, image));
        CHECK_FAILS(WFPSF_ERROR_SIZE, "count = -1",
                    wfpsf_varying_psf_add_stars(varying, 0, 0, -1, &x, &y, &flux, NULL, image));
        CHECK_FAILS(WFPSF_ERROR_NULL, "flux",
                    wfpsf_varying_psf_add_stars(varying, 0, 0, 1, &x, &y, NULL, NULL, image));
        CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "x0",
                    wfpsf_varying_psf_add_stars(varying, NAN, 0, 1, &x, &y, &flux, NULL, image));
        CHECK(are_equal(pixels, threaded, side * side));
        CHECK_OK(wfpsf_image_set_record(image, 1, 0.11, WFPSF_EFFECT_IPC));
        CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "interpixel",
                    wfpsf_varying_psf_add_stars(varying, 0, 0, 1, &x, &y, &flux, NULL, image));
        wfpsf_options_destroy(two);
        wfpsf_image_destroy(image);
        wfpsf_image_destroy(other);
    }

    wfpsf_psf_destroy(psf);
    psf = STALE(wfpsf_psf);
    CHECK_FAILS(WFPSF_ERROR_RANGE, "5000", wfpsf_varying_psf_at(varying, 5000, 0, &psf));
    CHECK(psf == NULL);
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "y", wfpsf_varying_psf_at(varying, 0, INFINITY, &psf));
    CHECK_FAILS(WFPSF_ERROR_NULL, "varying", wfpsf_varying_psf_at(NULL, 0, 0, &psf));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_varying_psf_at(varying, 0, 0, NULL));
    {
        double value = 7;
        CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = 11",
                    wfpsf_varying_psf_get(varying, 11, &value));
        CHECK_FAILS(WFPSF_ERROR_NULL, "value",
                    wfpsf_varying_psf_get(varying, WFPSF_VARYING_PSF_RANK, NULL));
        CHECK(value == 7);
    }
    wfpsf_varying_psf_destroy(varying);
    wfpsf_varying_psf_destroy(NULL);

    /* A PSF taken from a model outlives it, even for a stamp beyond its radius. */
    {
        double far[41 * 41];
        wfpsf_image *image = wrap(far, 41, 41);
        CHECK_OK(wfpsf_psf_draw(there, 20, 20, 1, NULL, image));
        CHECK(far[20 * 41 + 20] > 0.1);
        wfpsf_image_destroy(image);
        wfpsf_psf_destroy(there);
    }
}

static void test_other_kinds(void) {
    wfpsf_instrument *c5 = NULL;
    wfpsf_options *options = NULL;
    wfpsf_sed *flat = NULL;
    wfpsf_varying_psf *varying = STALE(wfpsf_varying_psf);
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-3));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 4));
    CHECK_OK(wfpsf_sed_create_power_law(WFPSF_SED_PHOTONS, 0, &flat));
    CHECK_OK(wfpsf_varying_psf_create(c5, "H158", 2, 0, flat, options, &varying));
    CHECK(get(varying, WFPSF_VARYING_PSF_EXACT_PSFS) == 1);
    CHECK(get(varying, WFPSF_VARYING_PSF_RANK) == 1);
    wfpsf_varying_psf_destroy(varying);
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "wavelength_nm = 1500",
                wfpsf_varying_psf_create(c5, "H158", 2, 1500, flat, options, &varying));
    CHECK(varying == NULL);
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 19",
                wfpsf_varying_psf_create(c5, "H158", 19, 0, NULL, options, &varying));
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "X1",
                wfpsf_varying_psf_create(c5, "X1", 2, 0, NULL, options, &varying));
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument",
                wfpsf_varying_psf_create(NULL, "H158", 2, 0, NULL, options, &varying));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out",
                wfpsf_varying_psf_create(c5, "H158", 2, 0, NULL, options, NULL));
    wfpsf_sed_destroy(flat);
    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(c5);
}

int main(void) {
    test_places();
    test_other_kinds();
    return checked();
}
