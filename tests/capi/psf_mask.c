/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PSFs from a mask of the caller's. */
#include "pixels.h"

#include <stdlib.h>

static const double pi = 3.14159265358979323846, wavelength_nm = 1500;

static wfpsf_options *flat_wavefront(const wfpsf_instrument *c5) {
    double coefficients[11];
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_instrument_zernikes(c5, 7, 11, coefficients, NULL));
    for (int i = 0; i < 11; ++i)
        coefficients[i] = i < 3 ? 0 : -coefficients[i];
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_zernikes(options, 11, coefficients));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-9));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 8));
    return options;
}

/* Integral of sinc^2 over a native pixel centred at x pixels, in fractions of the light: what a
   square pupil of that side sends there. */
static double square_pupil_pixel(double x, double side) {
    const double pixels = side * 0.11 * pi / 180 / 3600 / (wavelength_nm * 1e-9);
    const int panels = 400;
    double sum = 0; /* Simpson's rule */
    for (int i = 0; i <= panels; ++i) {
        const double u = pi * pixels * (x - 0.5 + (double)i / panels);
        const double s = fabs(u) < 1e-8 ? 1 : sin(u) / u;
        sum += (i == 0 || i == panels ? 1 : i % 2 ? 4 : 2) * s * s;
    }
    return sum * pixels / (3 * panels);
}

/* A square of lit pixels gives a product of two sinc^2, whatever the strides of the mask. */
static void test_square_pupil(const wfpsf_instrument *c5) {
    enum { side = 12, lit = 8, stamp = 9 };
    double mask[side * side] = {0}, data[stamp * stamp], area = 0;
    for (int y = 2; y < 2 + lit; ++y)
        for (int x = 3; x < 3 + lit; ++x)
            mask[y * side + x] = 1;
    const double scale = 0.2, axis_x = 3 + (lit - 1) / 2.0, axis_y = 2 + (lit - 1) / 2.0;
    wfpsf_options *options = flat_wavefront(c5);
    for (int flipped = 0; flipped < 2; ++flipped) {
        wfpsf_image *image = flipped ? wrap_flipped(mask, side, side) : wrap(mask, side, side);
        wfpsf_image *out = wrap(data, stamp, stamp);
        wfpsf_psf *psf = NULL;
        CHECK_OK(wfpsf_psf_create_from_mask(c5, image, scale, flipped ? side - 1 - axis_x : axis_x,
                                            flipped ? side - 1 - axis_y : axis_y, 7, wavelength_nm,
                                            options, &psf));
        wfpsf_image_destroy(image); /* copied */
        CHECK_OK(wfpsf_psf_get(psf, WFPSF_PSF_LIT_AREA_M2, &area));
        CHECK_NEAR(area, lit * lit * scale * scale, 1e-12);
        CHECK_OK(wfpsf_psf_draw(psf, 4.3, 3.9, 1, NULL, out));
        const double peak = data[4 * stamp + 4];
        for (int y = 0; y < stamp; ++y)
            for (int x = 0; x < stamp; ++x)
                CHECK_NEAR(data[y * stamp + x],
                           square_pupil_pixel(x - 4.3, lit * scale) *
                               square_pupil_pixel(y - 3.9, lit * scale),
                           2e-9 * peak);
        wfpsf_psf_destroy(psf);
        wfpsf_image_destroy(out);
    }
    wfpsf_options_destroy(options);
}

static const wfpsf_instrument *instrument;
static const wfpsf_image *good_mask;

static void check_refused(wfpsf_status status, const char *culprit, const wfpsf_image *mask,
                          double scale, double axis_x, double axis_y, int32_t sca,
                          double wavelength) {
    wfpsf_psf *psf = STALE(wfpsf_psf);
    CHECK_FAILS(status, culprit,
                wfpsf_psf_create_from_mask(instrument, mask, scale, axis_x, axis_y, sca, wavelength,
                                           NULL, &psf));
    CHECK(psf == NULL);
}

static void check_mask_refused(wfpsf_status status, const char *culprit, double transmission) {
    double data[16];
    fill(data, 16, 1);
    data[6] = transmission;
    wfpsf_image *mask = wrap(data, 4, 4);
    check_refused(status, culprit, mask, 0.5, 1.5, 1.5, 7, 1300);
    wfpsf_image_destroy(mask);
}

static void test_refuses(void) {
    wfpsf_psf *psf = STALE(wfpsf_psf);
    check_refused(WFPSF_ERROR_NULL, "mask", NULL, 0.5, 1.5, 1.5, 7, 1300);
    check_refused(WFPSF_ERROR_RANGE, "sca = 0", good_mask, 0.5, 1.5, 1.5, 0, 1300);
    check_refused(WFPSF_ERROR_RANGE, "sca = 19", good_mask, 0.5, 1.5, 1.5, 19, 1300);
    check_refused(WFPSF_ERROR_RANGE, "wavelength_nm = 99", good_mask, 0.5, 1.5, 1.5, 7, 99);
    check_refused(WFPSF_ERROR_NOT_FINITE, "wavelength_nm = nan", good_mask, 0.5, 1.5, 1.5, 7, NAN);
    check_refused(WFPSF_ERROR_RANGE, "mask_scale_m = 0", good_mask, 0, 1.5, 1.5, 7, 1300);
    check_refused(WFPSF_ERROR_RANGE, "mask_scale_m = -0.5", good_mask, -0.5, 1.5, 1.5, 7, 1300);
    check_refused(WFPSF_ERROR_NOT_FINITE, "mask_scale_m = nan", good_mask, NAN, 1.5, 1.5, 7, 1300);
    check_refused(WFPSF_ERROR_NOT_FINITE, "mask_scale_m = inf", good_mask, HUGE_VAL, 1.5, 1.5, 7,
                  1300);
    check_refused(WFPSF_ERROR_NOT_FINITE, "axis_x = nan", good_mask, 0.5, NAN, 1.5, 7, 1300);
    check_refused(WFPSF_ERROR_NOT_FINITE, "axis_y = -inf", good_mask, 0.5, 1.5, -HUGE_VAL, 7, 1300);
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument",
                wfpsf_psf_create_from_mask(NULL, good_mask, 0.5, 1.5, 1.5, 7, 1300, NULL, &psf));
    CHECK(psf == NULL);
    CHECK_FAILS(
        WFPSF_ERROR_NULL, "out",
        wfpsf_psf_create_from_mask(instrument, good_mask, 0.5, 1.5, 1.5, 7, 1300, NULL, NULL));

    check_mask_refused(WFPSF_ERROR_RANGE, "(2, 1) = 1.5", 1.5);
    check_mask_refused(WFPSF_ERROR_RANGE, "(2, 1) = -0.1", -0.1);
    check_mask_refused(WFPSF_ERROR_NOT_FINITE, "(2, 1) = nan", NAN);
    check_mask_refused(WFPSF_ERROR_NOT_FINITE, "(2, 1) = inf", HUGE_VAL);

    double dark[16] = {0};
    wfpsf_image *mask = wrap(dark, 4, 4), *none = wrap(NULL, 0, 0);
    check_refused(WFPSF_ERROR_ARGUMENT, "mask", mask, 0.5, 1.5, 1.5, 7, 1300);
    check_refused(WFPSF_ERROR_ARGUMENT, "mask", none, 0.5, 1.5, 1.5, 7, 1300);
    wfpsf_image_destroy(mask);
    wfpsf_image_destroy(none);
}

/* Two points a metre apart: fringes of a cosine squared, without a square's fall. */
static void test_points(const wfpsf_instrument *c5) {
    double mask[11] = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, far, near;
    wfpsf_options *options = flat_wavefront(c5);
    wfpsf_image *image = wrap(mask, 11, 1), *out = wrap(&near, 1, 1);
    wfpsf_psf *psf = NULL;
    CHECK_FAILS(WFPSF_ERROR_RANGE, "MASK_POINTS = 2",
                wfpsf_options_set_integer(options, WFPSF_OPTION_MASK_POINTS, 2));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_MASK_POINTS, 1));
    CHECK_OK(wfpsf_psf_create_from_mask(c5, image, 0.1, 5, 0, 7, wavelength_nm, options, &psf));
    CHECK_OK(wfpsf_psf_draw(psf, 0, 0, 1, NULL, out));
    far = near;
    /* Along y the light is the same everywhere. */
    CHECK_OK(wfpsf_psf_draw(psf, 0, 6.3, 1, NULL, out));
    CHECK_NEAR(far, near, 1e-9 * near);
    /* Points cover no area, whose autocorrelation an OTF is. */
    wfpsf_otf *otf = NULL;
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "points", wfpsf_otf_create(psf, NULL, &otf));
    CHECK(otf == NULL);
    wfpsf_psf_destroy(psf);
    wfpsf_image_destroy(out);
    wfpsf_image_destroy(image);
    wfpsf_options_destroy(options);
}

int main(void) {
    double lit[16];
    wfpsf_instrument *c5 = NULL;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    fill(lit, 16, 1);
    wfpsf_image *mask = wrap(lit, 4, 4);
    instrument = c5;
    good_mask = mask;
    test_square_pupil(c5);
    test_points(c5);
    test_refuses();
    wfpsf_image_destroy(mask);
    wfpsf_instrument_destroy(c5);
    return checked();
}
