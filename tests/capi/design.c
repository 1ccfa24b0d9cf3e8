/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Instruments of one's own, and every wrong figure. */
#include "pixels.h"

static wfpsf_design *sound_design(void) {
    wfpsf_design *design = NULL;
    CHECK_OK(wfpsf_design_create(&design));
    CHECK_OK(wfpsf_design_set_telescope(design, 2.36, 0.3, 1293));
    CHECK_OK(wfpsf_design_set_detector(design, 2, 0.11, 4088, 2044));
    return design;
}

static wfpsf_instrument *instrument_of(const wfpsf_design *design) {
    wfpsf_instrument *instrument = NULL;
    CHECK_OK(wfpsf_instrument_create_from_design(design, &instrument));
    return instrument;
}

static wfpsf_options *fast_options(int struts) {
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-9));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 8));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_STRUTS, struts));
    return options;
}

enum { size = 15 };

static void draw(wfpsf_psf *psf, double *data) {
    wfpsf_image *image = wrap(data, size, size);
    CHECK_OK(wfpsf_psf_draw(psf, 7.2, 6.9, 1, NULL, image));
    wfpsf_image_destroy(image);
    wfpsf_psf_destroy(psf);
}

static void check_alike(const double *a, const double *b, double tolerance) {
    double worst = 0, peak = 0;
    for (int i = 0; i < size * size; ++i) {
        worst = fmax(worst, fabs(a[i] - b[i]));
        peak = fmax(peak, b[i]);
    }
    CHECK_NEAR(worst / peak, 0, tolerance);
}

/* The figures of Cycle 5 make its annulus, band for band and detector for detector. */
static void test_like_a_built_in(void) {
    static const double throughput[] = {0, 0.5, 0.7, 0.6, 0};
    wfpsf_instrument *c5 = NULL;
    wfpsf_psf *psf = NULL;
    wfpsf_design *design = sound_design();
    double zernikes[11], ours[size * size], theirs[size * size], value = 0;
    double blue = 0, red = 0, effective = 0;
    const char *unit = NULL;
    int64_t count = 0;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    CHECK_OK(wfpsf_instrument_zernikes(c5, 7, 11, zernikes, NULL));
    CHECK_OK(wfpsf_design_set_zernikes(design, 2, 11, zernikes));
    CHECK_OK(wfpsf_design_add_band(design, "mine", 1200, 50, 5, throughput));
    wfpsf_instrument *mine = instrument_of(design);
    wfpsf_design_destroy(design);
    zernikes[3] = 7; /* copied */

    CHECK_OK(wfpsf_instrument_constant(mine, "diameter", &value, &unit));
    CHECK(value == 2.36 && strcmp(unit, "m") == 0);
    CHECK_OK(wfpsf_instrument_constant(mine, "n_pix", &value, NULL));
    CHECK(value == 4088);
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "gain",
                wfpsf_instrument_constant(mine, "gain", &value, NULL));
    while (wfpsf_instrument_constant_name(mine, count))
        ++count;
    CHECK(count == 9);
    CHECK(strcmp(wfpsf_instrument_band_name(mine, 0), "mine") == 0);
    CHECK(wfpsf_instrument_band_name(mine, 1) == NULL);
    CHECK_OK(wfpsf_instrument_band(mine, "mine", WFPSF_BAND_TABULATED, &blue, &red, &effective));
    CHECK(blue == 1200 && red == 1400 && effective > 1290 && effective < 1310);
    CHECK_OK(wfpsf_instrument_throughput(mine, "mine", 1, &effective, &value));
    CHECK(value > 0.69 && value <= 0.7);
    CHECK_OK(wfpsf_instrument_zernikes(mine, 2, 11, zernikes, &count));
    CHECK(count == 11 && zernikes[3] == -0.032239);
    CHECK_OK(wfpsf_instrument_zernikes(mine, 1, 11, zernikes, &count));
    CHECK(count == 0);

    for (int struts = 0; struts < 2; ++struts) {
        wfpsf_options *options = fast_options(struts), *bare = fast_options(0);
        CHECK_OK(wfpsf_psf_create(c5, 7, 1292.11, bare, &psf));
        draw(psf, theirs);
        CHECK_OK(wfpsf_psf_create(mine, 2, 1292.11, options, &psf));
        draw(psf, ours);
        check_alike(ours, theirs, 2e-9);
        CHECK_OK(wfpsf_psf_create_in_band(mine, "mine", 2, 0, 2043, 1292.11, options, &psf));
        draw(psf, ours);
        check_alike(ours, theirs, 2e-9);
        wfpsf_options_destroy(options);
        wfpsf_options_destroy(bare);
    }
    wfpsf_ipc_kernel *kernel = STALE(wfpsf_ipc_kernel);
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "instrument", wfpsf_ipc_kernel_create_default(mine, &kernel));
    CHECK(kernel == NULL);
    wfpsf_instrument_destroy(mine);
    wfpsf_instrument_destroy(c5);
}

/* A turn of the struts by 90 degrees turns the image. WFPSF_OPTION_STRUTS takes them away, also
   before an unobscured primary. */
static void test_struts(void) {
    double first[size * size], second[size * size], turned[size * size], area[2], bare_area = 0;
    wfpsf_options *with = fast_options(1), *without = fast_options(0);
    wfpsf_psf *psf = NULL;
    for (int turn = 0; turn < 2; ++turn) {
        wfpsf_design *design = sound_design();
        CHECK_OK(wfpsf_design_set_telescope(design, 2.36, 0, 1293));
        for (int i = 0; i < 3; ++i)
            CHECK_OK(wfpsf_design_add_strut(design, 20 + 100 * i + 90 * turn, 0.1, 0.2 * i));
        wfpsf_instrument *mine = instrument_of(design);
        wfpsf_design_destroy(design);
        CHECK_OK(wfpsf_psf_create(mine, 1, 1500, with, &psf));
        CHECK_OK(wfpsf_psf_get(psf, WFPSF_PSF_LIT_AREA_M2, &area[turn]));
        wfpsf_image *image = wrap(turn ? second : first, size, size);
        CHECK_OK(wfpsf_psf_draw(psf, 7, 7, 1, NULL, image));
        wfpsf_image_destroy(image);
        wfpsf_psf_destroy(psf);
        CHECK_OK(wfpsf_psf_create(mine, 1, 1500, without, &psf));
        CHECK_OK(wfpsf_psf_get(psf, WFPSF_PSF_LIT_AREA_M2, &bare_area));
        CHECK_NEAR(bare_area, 3.14159265358979323846 * 1.18 * 1.18, 1e-12);
        wfpsf_psf_destroy(psf);
        wfpsf_instrument_destroy(mine);
    }
    CHECK_NEAR(area[1], area[0], 1e-12);
    CHECK(area[0] < bare_area - 0.3);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            turned[x * size + (size - 1 - y)] = first[y * size + x]; /* (x, y) to (-y, x) */
    check_alike(second, turned, 2e-9);
    wfpsf_options_destroy(with);
    wfpsf_options_destroy(without);
}

static void test_wrong_figures(void) {
    wfpsf_design *d = STALE(wfpsf_design);
    wfpsf_instrument *out = STALE(wfpsf_instrument);
    const double good[5] = {0, 1, 1, 1, 0}, dark[3] = {0, 0, 0};
    const double x[5] = {50, 0, 100, 0, 100}, y[5] = {50, 0, 0, 100, 100};
    double bad[5] = {0, 1, NAN, 1, 0};

    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_design_create(NULL));
    wfpsf_design_destroy(NULL);
    CHECK_OK(wfpsf_design_create(&d));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "telescope", wfpsf_instrument_create_from_design(d, &out));
    CHECK(out == NULL);
    wfpsf_design_destroy(d);
    d = sound_design();
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_instrument_create_from_design(d, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "design", wfpsf_instrument_create_from_design(NULL, &out));

    CHECK_FAILS(WFPSF_ERROR_NULL, "design", wfpsf_design_set_telescope(NULL, 1, 0, 500));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "diameter_m = 0", wfpsf_design_set_telescope(d, 0, 0, 500));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "diameter_m = inf",
                wfpsf_design_set_telescope(d, HUGE_VAL, 0, 500));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "obscuration = 1", wfpsf_design_set_telescope(d, 1, 1, 500));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "obscuration = -0.1",
                wfpsf_design_set_telescope(d, 1, -0.1, 500));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "obscuration = nan",
                wfpsf_design_set_telescope(d, 1, NAN, 500));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "reference_wavelength_nm = 99",
                wfpsf_design_set_telescope(d, 1, 0, 99));

    CHECK_FAILS(WFPSF_ERROR_NULL, "design", wfpsf_design_add_strut(NULL, 0, 0.1, 0));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "azimuth_deg = 361", wfpsf_design_add_strut(d, 361, 0.1, 0));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "width_m = -0.1", wfpsf_design_add_strut(d, 0, -0.1, 0));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "offset_m = nan", wfpsf_design_add_strut(d, 0, 0.1, NAN));

    CHECK_FAILS(WFPSF_ERROR_NULL, "design", wfpsf_design_set_detector(NULL, 1, 0.1, 10, 10));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca_count = 0", wfpsf_design_set_detector(d, 0, 0.1, 10, 10));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "pixel_scale_arcsec = 0",
                wfpsf_design_set_detector(d, 1, 0, 10, 10));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "n_pix_x = 0", wfpsf_design_set_detector(d, 1, 0.1, 0, 10));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "n_pix_y = 9",
                wfpsf_design_set_detector(d, 1, 0.1, 1, INT64_MAX));

    CHECK_FAILS(WFPSF_ERROR_NULL, "design", wfpsf_design_set_zernikes(NULL, 1, 5, good));
    CHECK_FAILS(WFPSF_ERROR_NULL, "coefficients", wfpsf_design_set_zernikes(d, 1, 5, NULL));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 0", wfpsf_design_set_zernikes(d, 0, 5, good));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "count = 232", wfpsf_design_set_zernikes(d, 1, 232, good));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "count = -1", wfpsf_design_set_zernikes(d, 1, -1, good));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "coefficients[2] = nan",
                wfpsf_design_set_zernikes(d, 1, 5, bad));

    CHECK_FAILS(WFPSF_ERROR_NULL, "design", wfpsf_design_set_field(NULL, 1, x, y, 1, good));
    CHECK_FAILS(WFPSF_ERROR_NULL, "x", wfpsf_design_set_field(d, 1, NULL, y, 1, good));
    CHECK_FAILS(WFPSF_ERROR_NULL, "y", wfpsf_design_set_field(d, 1, x, NULL, 1, good));
    CHECK_FAILS(WFPSF_ERROR_NULL, "coefficients", wfpsf_design_set_field(d, 1, x, y, 1, NULL));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "x_pix[2] = nan",
                wfpsf_design_set_field(d, 1, bad, y, 1, good));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "coefficients[2] = nan",
                wfpsf_design_set_field(d, 1, x, y, 1, bad));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "field points", wfpsf_design_set_field(d, 1, x, x, 1, good));

    CHECK_FAILS(WFPSF_ERROR_NULL, "design", wfpsf_design_add_band(NULL, "V", 500, 10, 5, good));
    CHECK_FAILS(WFPSF_ERROR_NULL, "name", wfpsf_design_add_band(d, NULL, 500, 10, 5, good));
    CHECK_FAILS(WFPSF_ERROR_NULL, "throughput", wfpsf_design_add_band(d, "V", 500, 10, 5, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "name", wfpsf_design_add_band(d, "", 500, 10, 5, good));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "first_nm = 5", wfpsf_design_add_band(d, "V", 5, 10, 5, good));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "step_nm = 0", wfpsf_design_add_band(d, "V", 500, 0, 5, good));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "step_nm = 25000",
                wfpsf_design_add_band(d, "V", 500, 25000, 5, good));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = -1", wfpsf_design_add_band(d, "V", 500, 10, -1, good));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = 1", wfpsf_design_add_band(d, "V", 500, 10, 1, good));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "throughput[2] = nan",
                wfpsf_design_add_band(d, "V", 500, 10, 5, bad));
    bad[2] = 1.5;
    CHECK_FAILS(WFPSF_ERROR_RANGE, "throughput[2] = 1.5",
                wfpsf_design_add_band(d, "V", 500, 10, 5, bad));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "throughput",
                wfpsf_design_add_band(d, "V", 500, 10, 3, dark));
    CHECK_OK(wfpsf_design_add_band(d, "V", 500, 10, 5, good));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "name = \"V\"",
                wfpsf_design_add_band(d, "V", 500, 10, 5, good));

    /* None of that has changed anything. */
    wfpsf_instrument *mine = instrument_of(d);
    CHECK(strcmp(wfpsf_instrument_band_name(mine, 0), "V") == 0);
    CHECK(wfpsf_instrument_band_name(mine, 1) == NULL);
    wfpsf_instrument_destroy(mine);

    CHECK_OK(wfpsf_design_set_zernikes(d, 3, 0, NULL));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 3", wfpsf_instrument_create_from_design(d, &out));
    CHECK_OK(wfpsf_design_set_detector(d, 3, 0.11, 10, 10));
    for (int i = 0; i < 64; ++i)
        CHECK_OK(wfpsf_design_add_strut(d, i, 5, 0));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "struts", wfpsf_design_add_strut(d, 0, 5, 0));
    wfpsf_design_destroy(d);

    d = sound_design();
    CHECK_OK(wfpsf_design_add_strut(d, 0, 5, 0));
    CHECK_OK(wfpsf_design_add_strut(d, 180, 5, 0));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "struts", wfpsf_instrument_create_from_design(d, &out));
    wfpsf_design_destroy(d);
}

int main(void) {
    test_like_a_built_in();
    test_struts();
    test_wrong_figures();
    return checked();
}
