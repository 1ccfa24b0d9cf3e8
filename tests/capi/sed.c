/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sources of many colours: SEDs, the PSFs made of them, and long work that is told to stop. */
#include "pixels.h"

static wfpsf_sed *power_law(int32_t unit, double exponent) {
    wfpsf_sed *sed = NULL;
    CHECK_OK(wfpsf_sed_create_power_law(unit, exponent, &sed));
    return sed;
}

static double ratio(const wfpsf_sed *sed, double numerator_nm, double denominator_nm) {
    const double nm[2] = {numerator_nm, denominator_nm};
    double photons[2] = {NAN, NAN};
    CHECK_OK(wfpsf_sed_photon_density(sed, 2, nm, photons));
    return photons[0] / photons[1];
}

static void test_seds(void) {
    const double nm[3] = {500, 1000, 2000}, density[3] = {1, 3, 1};
    const double falling[2] = {1000, 500}, negative[2] = {1, -1}, infinite[1] = {INFINITY};
    const double zero[1] = {0};
    double photons[1] = {7};
    wfpsf_sed *table = NULL, *red = NULL, *sed = STALE(wfpsf_sed);
    wfpsf_sed *ab = power_law(WFPSF_SED_ENERGY, -2), *sun = NULL;
    CHECK_NEAR(ratio(ab, 1000, 2000), 2, 1e-14);
    CHECK_OK(wfpsf_sed_create_black_body(5772, &sun));
    CHECK(ratio(sun, 650, 630) < 1 && ratio(sun, 634, 600) > 1);
    CHECK_OK(wfpsf_sed_create_table(WFPSF_SED_PHOTONS, 3, nm, density, &table));
    CHECK_NEAR(ratio(table, 750, 500), 2, 1e-14);
    CHECK_OK(wfpsf_sed_create_redshifted(table, 1, &red));
    wfpsf_sed_destroy(table);
    CHECK_NEAR(ratio(red, 1500, 1000), 2, 1e-14);
    CHECK_OK(wfpsf_sed_photon_density(red, 0, NULL, NULL));

    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "unit = 3", wfpsf_sed_create_power_law(3, 0, &sed));
    CHECK(sed == NULL);
    CHECK_FAILS(WFPSF_ERROR_RANGE, "exponent = 1e+06",
                wfpsf_sed_create_power_law(WFPSF_SED_ENERGY, 1e6, &sed));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "temperature_k = nan", wfpsf_sed_create_black_body(NAN, &sed));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "wavelength_nm[1] = 500",
                wfpsf_sed_create_table(WFPSF_SED_ENERGY, 2, falling, density, &sed));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sed = -1",
                wfpsf_sed_create_table(WFPSF_SED_ENERGY, 2, nm, negative, &sed));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = 1",
                wfpsf_sed_create_table(WFPSF_SED_ENERGY, 1, nm, density, &sed));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = -1",
                wfpsf_sed_create_table(WFPSF_SED_ENERGY, -1, nm, density, &sed));
    CHECK_FAILS(WFPSF_ERROR_NULL, "density",
                wfpsf_sed_create_table(WFPSF_SED_ENERGY, 2, nm, NULL, &sed));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "redshift = -1", wfpsf_sed_create_redshifted(red, -1, &sed));
    CHECK_FAILS(WFPSF_ERROR_NULL, "sed", wfpsf_sed_create_redshifted(NULL, 1, &sed));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_sed_create_black_body(5000, NULL));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "wavelength_nm[0] = inf",
                wfpsf_sed_photon_density(red, 1, infinite, photons));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "wavelength_nm[0] = 0",
                wfpsf_sed_photon_density(red, 1, zero, photons));
    CHECK(photons[0] == 7);
    wfpsf_sed_destroy(red);
    wfpsf_sed_destroy(ab);
    wfpsf_sed_destroy(sun);
    wfpsf_sed_destroy(NULL);
}

static wfpsf_options *make_options(double eps) {
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, eps));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 6));
    return options;
}

enum { side = 11 };

static void draw(const wfpsf_psf *psf, double *pixels) {
    wfpsf_image *image = wrap(pixels, side, side);
    CHECK_OK(wfpsf_psf_draw(psf, 5.1, 4.8, 1, NULL, image));
    wfpsf_image_destroy(image);
}

static double get(const wfpsf_psf *psf, int32_t key) {
    double value = NAN;
    CHECK_OK(wfpsf_psf_get(psf, key, &value));
    return value;
}

/* Each source by itself, all of them together, and the sum over wavelengths that they mean. */
static void test_chromatic(void) {
    const double eps = 1e-5;
    double one[side * side], shared[side * side], peak = 0;
    wfpsf_instrument *roman = NULL;
    wfpsf_options *options = make_options(eps);
    wfpsf_sed *seds[2] = {power_law(WFPSF_SED_PHOTONS, 0), NULL};
    wfpsf_psf *all[2] = {NULL, NULL};
    CHECK_OK(wfpsf_instrument_create("roman-c9", &roman));
    CHECK_OK(wfpsf_sed_create_black_body(3500, &seds[1]));
    CHECK_OK(wfpsf_psf_create_chromatic(roman, "J129", 3, 100, 4000, 2,
                                        (const wfpsf_sed *const *)seds, options, all));
    CHECK(get(all[1], WFPSF_PSF_WAVELENGTH_NM) < get(all[0], WFPSF_PSF_WAVELENGTH_NM));
    for (int i = 0; i < 2; ++i) {
        const wfpsf_sed *alone = seds[i];
        wfpsf_psf *psf = NULL;
        CHECK_OK(wfpsf_psf_create_chromatic(roman, "J129", 3, 100, 4000, 1, &alone, options, &psf));
        CHECK(get(psf, WFPSF_PSF_ERROR_ESTIMATE) <= eps);
        CHECK(get(psf, WFPSF_PSF_WAVELENGTHS) > 2);
        draw(psf, one);
        draw(all[i], shared);
        for (int p = 0; p < side * side; ++p)
            peak = fmax(peak, one[p]);
        for (int p = 0; p < side * side; ++p)
            CHECK_NEAR(shared[p], one[p], 2 * eps * peak);
        wfpsf_psf_destroy(psf);
    }

    /* A narrow line is as good as one wavelength. */
    {
        const double nm[5] = {500, 1299.999, 1300, 1300.001, 2500}, density[5] = {0, 0, 1, 0, 0};
        wfpsf_sed *line = NULL;
        wfpsf_psf *psf = NULL, *single = NULL;
        CHECK_OK(wfpsf_sed_create_table(WFPSF_SED_ENERGY, 5, nm, density, &line));
        CHECK_OK(wfpsf_psf_create_chromatic(roman, "J129", 3, 100, 4000, 1,
                                            (const wfpsf_sed *const *)&line, options, &psf));
        CHECK_OK(wfpsf_psf_create_in_band(roman, "J129", 3, 100, 4000, 1300, options, &single));
        draw(psf, one);
        draw(single, shared);
        for (int p = 0; p < side * side; ++p)
            CHECK_NEAR(shared[p], one[p], 2 * eps * peak);
        CHECK_NEAR(get(psf, WFPSF_PSF_WAVELENGTH_NM), 1300, 1e-3);
        wfpsf_psf_destroy(psf);
        wfpsf_psf_destroy(single);
        wfpsf_sed_destroy(line);
    }
    for (int i = 0; i < 2; ++i) {
        wfpsf_psf_destroy(all[i]);
        wfpsf_sed_destroy(seds[i]);
    }
    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(roman);
}

static void test_refusals(void) {
    const double nm[2] = {1200, 1300}, density[2] = {1, 1};
    const double wide[4] = {100, 200, 300, 9000}, blue[4] = {1, 0, 0, 0};
    wfpsf_instrument *c5 = NULL;
    wfpsf_sed *narrow = NULL, *dark = NULL, *flat = power_law(WFPSF_SED_PHOTONS, 0);
    const wfpsf_sed *two[2];
    wfpsf_psf *out[2] = {STALE(wfpsf_psf), STALE(wfpsf_psf)};
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    CHECK_OK(wfpsf_sed_create_table(WFPSF_SED_PHOTONS, 2, nm, density, &narrow));
    CHECK_OK(wfpsf_sed_create_table(WFPSF_SED_PHOTONS, 4, wide, blue, &dark));
    two[0] = flat;
    two[1] = narrow;
    CHECK_FAILS(WFPSF_ERROR_RANGE, "covers 1200..1300 nm",
                wfpsf_psf_create_chromatic(c5, "J129", 1, 0, 0, 2, two, NULL, out));
    CHECK(out[0] == NULL && out[1] == NULL);
    two[1] = dark;
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "detects 0",
                wfpsf_psf_create_chromatic(c5, "J129", 1, 0, 0, 2, two, NULL, out));
    two[1] = NULL;
    CHECK_FAILS(WFPSF_ERROR_NULL, "seds",
                wfpsf_psf_create_chromatic(c5, "J129", 1, 0, 0, 2, two, NULL, out));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = 0",
                wfpsf_psf_create_chromatic(c5, "J129", 1, 0, 0, 0, two, NULL, out));
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "K999",
                wfpsf_psf_create_chromatic(c5, "K999", 1, 0, 0, 1, two, NULL, out));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "x = -600",
                wfpsf_psf_create_chromatic(c5, "J129", 1, -600, 0, 1, two, NULL, out));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out",
                wfpsf_psf_create_chromatic(c5, "J129", 1, 0, 0, 1, two, NULL, NULL));
    wfpsf_sed_destroy(flat);
    wfpsf_sed_destroy(narrow);
    wfpsf_sed_destroy(dark);
    wfpsf_instrument_destroy(c5);
}

/* Jitter and diffusion widen a PSF and keep its light; what is no covariance is refused. */
static void test_blur(void) {
    double sharp[side * side], round[side * side], diffused[side * side];
    wfpsf_instrument *c5 = NULL;
    wfpsf_options *options = make_options(1e-8);
    wfpsf_psf *psf = NULL;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    CHECK_OK(wfpsf_psf_create(c5, 7, 1300, options, &psf));
    draw(psf, sharp);
    wfpsf_psf_destroy(psf);
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_CHARGE_DIFFUSION, 0.3));
    CHECK_OK(wfpsf_psf_create(c5, 7, 1300, options, &psf));
    draw(psf, diffused);
    wfpsf_psf_destroy(psf);
    CHECK(diffused[5 * side + 5] < 0.95 * sharp[5 * side + 5]);
    /* 0.3 pixels of 0.11 arcsec are as good as jitter. */
    CHECK_OK(wfpsf_options_reset(options, WFPSF_OPTION_CHARGE_DIFFUSION));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_JITTER_XX, 0.033 * 0.033));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_JITTER_YY, 0.033 * 0.033));
    CHECK_OK(wfpsf_psf_create(c5, 7, 1300, options, &psf));
    draw(psf, round);
    wfpsf_psf_destroy(psf);
    for (int p = 0; p < side * side; ++p)
        CHECK_NEAR(round[p], diffused[p], 1e-13);

    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_JITTER_XY, -0.0011));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "JITTER_XY = -0.0011",
                wfpsf_psf_create(c5, 7, 1300, options, &psf));
    CHECK(psf == NULL);
    CHECK_OK(wfpsf_options_reset(options, WFPSF_OPTION_JITTER_XY));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_JITTER_XX, 100));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "native pixels", wfpsf_psf_create(c5, 7, 1300, options, &psf));
    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(c5);
}

static int32_t count_down(double part, void *user) {
    int *left = user;
    CHECK(part >= 0 && part <= 1);
    return --*left == 0;
}

static void test_progress(void) {
    int left = 1000;
    wfpsf_instrument *c5 = NULL;
    wfpsf_options *options = make_options(1e-3);
    wfpsf_sed *flat = power_law(WFPSF_SED_PHOTONS, 0);
    wfpsf_psf *psf = STALE(wfpsf_psf);
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    CHECK_OK(wfpsf_options_set_progress(options, count_down, &left));
    CHECK_OK(wfpsf_psf_create_chromatic(c5, "J129", 1, 0, 0, 1, (const wfpsf_sed *const *)&flat,
                                        options, &psf));
    CHECK(left < 1000);
    wfpsf_psf_destroy(psf);
    left = 2;
    CHECK_FAILS(WFPSF_ERROR_CANCELLED, "stop",
                wfpsf_psf_create_chromatic(c5, "J129", 1, 0, 0, 1, (const wfpsf_sed *const *)&flat,
                                           options, &psf));
    CHECK(psf == NULL && left == 0);
    CHECK_OK(wfpsf_options_set_progress(options, NULL, NULL));
    CHECK_OK(wfpsf_psf_create_chromatic(c5, "J129", 1, 0, 0, 1, (const wfpsf_sed *const *)&flat,
                                        options, &psf));
    CHECK_FAILS(WFPSF_ERROR_NULL, "options", wfpsf_options_set_progress(NULL, count_down, NULL));
    wfpsf_psf_destroy(psf);
    wfpsf_sed_destroy(flat);
    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(c5);
}

int main(void) {
    test_seds();
    test_chromatic();
    test_refusals();
    test_blur();
    test_progress();
    return checked();
}
