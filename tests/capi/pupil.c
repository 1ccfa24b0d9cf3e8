/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pupils as images, the PSFs that these give, and every wrong way to ask for them. */
#include "pixels.h"

enum { stamp = 11 };
static double mask_values[300 * 256];

/* Largest difference, in units of the peak, between the PSF of the pupil's image and that of its
   geometry, at the place of SCA 1 that Roman's aberrations are given for. */
static double difference(const wfpsf_instrument *instrument, const char *band, int struts,
                         int64_t nx, int64_t ny) {
    double by_mask[stamp * stamp], by_geometry[stamp * stamp], scale, x, y, area, peak;
    wfpsf_options *options = NULL;
    wfpsf_psf *psf = NULL, *other = NULL;
    wfpsf_image *mask = wrap(mask_values, nx, ny), *image = wrap(by_geometry, stamp, stamp);
    wfpsf_image *other_image = wrap(by_mask, stamp, stamp);
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_STRUTS, struts));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_FRAME, 1));
    CHECK_OK(wfpsf_instrument_pupil(instrument, band, 1, options, mask, &scale, &x, &y));
    CHECK_OK(wfpsf_psf_create_in_band(instrument, band, 1, 2037, 2012, 1500, options, &psf));
    CHECK_OK(wfpsf_psf_create_from_mask(instrument, mask, scale, x, y, 1, 1500, options, &other));

    double sum = 0, worst = 0;
    for (int64_t i = 0; i < nx * ny; ++i) {
        CHECK(mask_values[i] >= 0 && mask_values[i] <= 1);
        sum += mask_values[i];
    }
    CHECK_OK(wfpsf_psf_get(psf, WFPSF_PSF_LIT_AREA_M2, &area));
    CHECK_NEAR(sum * scale * scale, area, 1e-8);
    CHECK_OK(wfpsf_psf_get(psf, WFPSF_PSF_PEAK, &peak));
    CHECK_OK(wfpsf_psf_draw(psf, 5.2, 4.9, 1, NULL, image));
    CHECK_OK(wfpsf_psf_draw(other, 5.2, 4.9, 1, NULL, other_image));
    for (int i = 0; i < stamp * stamp; ++i)
        worst = fmax(worst, fabs(by_mask[i] - by_geometry[i]) / peak);

    wfpsf_image_destroy(mask);
    wfpsf_image_destroy(image);
    wfpsf_image_destroy(other_image);
    wfpsf_psf_destroy(psf);
    wfpsf_psf_destroy(other);
    wfpsf_options_destroy(options);
    return worst;
}

/* By other means comes the same PSF, but for an error that falls as the square of the pixel. */
static void check_psf(const char *name, const char *band, int struts) {
    wfpsf_instrument *instrument = NULL;
    CHECK_OK(wfpsf_instrument_create(name, &instrument));
    const double coarse = difference(instrument, band, struts, 150, 128);
    const double fine = difference(instrument, band, struts, 300, 256);
    CHECK(fine < 3e-4);
    CHECK_NEAR(coarse / fine, 4, 0.5);
    wfpsf_instrument_destroy(instrument);
}

/* Any strides and types, down to one pixel. */
static void test_layouts(const wfpsf_instrument *c5) {
    double plain[30], flipped[30], scale, x, y, one;
    float single[30];
    wfpsf_image *a = wrap(plain, 6, 5), *b = wrap_flipped(flipped, 6, 5);
    wfpsf_image *c = wrap_float(single, 6, 5), *d = wrap(&one, 1, 1);
    CHECK_OK(wfpsf_image_set_record(a, 3, 0.5, WFPSF_EFFECT_IPC));
    CHECK_OK(wfpsf_instrument_pupil(c5, "J129", 7, NULL, a, &scale, &x, &y));
    check_record(a, 3, 0.5, WFPSF_EFFECT_IPC);
    CHECK_NEAR(x, 2.5, 0.1);
    CHECK_NEAR(y, 2, 0.1);
    CHECK_OK(wfpsf_instrument_pupil(c5, "J129", 7, NULL, b, &scale, &x, &y));
    CHECK_OK(wfpsf_instrument_pupil(c5, "J129", 7, NULL, c, &scale, &x, &y));
    for (int i = 0; i < 30; ++i) {
        CHECK(plain[i] == flipped[29 - i]);
        CHECK_NEAR(single[i], plain[i], 1e-7);
    }
    CHECK_OK(wfpsf_instrument_pupil(c5, "J129", 7, NULL, d, &scale, &x, &y));
    CHECK(one > 0.5 && one < 0.8);
    wfpsf_image_destroy(a);
    wfpsf_image_destroy(b);
    wfpsf_image_destroy(c);
    wfpsf_image_destroy(d);
}

static void test_refuses(const wfpsf_instrument *c5) {
    double data[4] = {7, 7, 7, 7}, s = 7, x = 7, y = 7;
    wfpsf_image *out = wrap(data, 2, 2), *none = wrap(NULL, 0, 5);
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument",
                wfpsf_instrument_pupil(NULL, "J129", 7, NULL, out, &s, &x, &y));
    CHECK_FAILS(WFPSF_ERROR_NULL, "band",
                wfpsf_instrument_pupil(c5, NULL, 7, NULL, out, &s, &x, &y));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out",
                wfpsf_instrument_pupil(c5, "J129", 7, NULL, NULL, &s, &x, &y));
    CHECK_FAILS(WFPSF_ERROR_NULL, "scale_m",
                wfpsf_instrument_pupil(c5, "J129", 7, NULL, out, NULL, &x, &y));
    CHECK_FAILS(WFPSF_ERROR_NULL, "axis_x",
                wfpsf_instrument_pupil(c5, "J129", 7, NULL, out, &s, NULL, &y));
    CHECK_FAILS(WFPSF_ERROR_NULL, "axis_y",
                wfpsf_instrument_pupil(c5, "J129", 7, NULL, out, &s, &x, NULL));
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "K999",
                wfpsf_instrument_pupil(c5, "K999", 7, NULL, out, &s, &x, &y));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 19",
                wfpsf_instrument_pupil(c5, "J129", 19, NULL, out, &s, &x, &y));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "0 x 5",
                wfpsf_instrument_pupil(c5, "J129", 7, NULL, none, &s, &x, &y));
    CHECK(all_are(data, 4, 7) && s == 7 && x == 7 && y == 7);
    wfpsf_image_destroy(out);
    wfpsf_image_destroy(none);
}

int main(void) {
    wfpsf_instrument *c5 = NULL;
    check_psf("wfirst-afta-c5", "J129", 1);
    check_psf("wfirst-afta-c5", "J129", 0);
    check_psf("roman-c9", "H158", 1);
    check_psf("roman-c9", "F184", 1);
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    test_layouts(c5);
    test_refuses(c5);
    wfpsf_instrument_destroy(c5);
    return checked();
}
