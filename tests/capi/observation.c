/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Observations: positions both ways, detectors, headers, the Sun; and what they refuse. */
#include "check.h"

#define N 3

static wfpsf_instrument *instrument(const char *name) {
    wfpsf_instrument *made = NULL;
    CHECK_OK(wfpsf_instrument_create(name, &made));
    return made;
}

static wfpsf_observation *observe(const char *name) {
    wfpsf_instrument *of = instrument(name);
    wfpsf_observation *made = NULL;
    CHECK_OK(wfpsf_observation_create(of, 60, -30, 30, NULL, &made));
    wfpsf_instrument_destroy(of);
    return made;
}

static void test_positions(void) {
    wfpsf_observation *o = observe("roman-c9");
    const double x[N] = {0, 2043, NAN}, y[N] = {4087, 2043, 0};
    double ra[N], dec[N], back_x[N], back_y[N], jacobian[4 * N], area[N], angle[N];
    int32_t sca[N];
    int64_t undefined = -1, found = -1, first_x, last_x, first_y, last_y;
    CHECK_OK(wfpsf_observation_pixel_to_sky(o, 7, N, x, y, ra, dec, &undefined));
    CHECK(undefined == 1 && isnan(ra[2]) && isnan(dec[2]));
    CHECK_OK(wfpsf_observation_sky_to_pixel(o, 7, N, ra, dec, back_x, back_y, &undefined));
    CHECK(undefined == 1);
    CHECK_NEAR(back_x[0], 0, 1e-8);
    CHECK_NEAR(back_y[0], 4087, 1e-8);
    CHECK_OK(wfpsf_observation_find_sca(o, 0, N, ra, dec, sca, back_x, back_y, &found));
    CHECK(found == 2 && sca[0] == 7 && sca[1] == 7 && sca[2] == 0);
    CHECK_OK(wfpsf_observation_find_sca(o, 1, N, ra, dec, sca, NULL, NULL, NULL));
    CHECK_OK(wfpsf_observation_jacobian(o, 7, N, x, y, jacobian, area, angle, &undefined));
    CHECK(undefined == 1 && isnan(area[2]) && isnan(jacobian[8]));
    CHECK_NEAR(fabs(jacobian[4] * jacobian[7] - jacobian[5] * jacobian[6]), area[1], 1e-15);
    CHECK_NEAR(area[1], 0.01177, 1e-4);
    CHECK_OK(wfpsf_observation_jacobian(o, 7, N, x, y, NULL, NULL, NULL, NULL));
    CHECK_OK(wfpsf_observation_bounds(o, 7, 1, &first_x, &last_x, &first_y, &last_y));
    CHECK(first_x == -169 && last_x == 4087 && first_y == -414 && last_y == 4501);
    CHECK_OK(wfpsf_observation_pixel_to_sky(o, 7, 0, NULL, NULL, NULL, NULL, NULL));

    CHECK_FAILS(WFPSF_ERROR_NULL, "observation = NULL",
                wfpsf_observation_pixel_to_sky(NULL, 7, N, x, y, ra, dec, NULL));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 19: must be 1..18",
                wfpsf_observation_pixel_to_sky(o, 19, N, x, y, ra, dec, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = -1",
                wfpsf_observation_sky_to_pixel(o, 7, -1, ra, dec, back_x, back_y, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "dec_deg = NULL",
                wfpsf_observation_sky_to_pixel(o, 7, N, ra, NULL, back_x, back_y, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "with_gaps = 2",
                wfpsf_observation_find_sca(o, 2, N, ra, dec, sca, NULL, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "sca = NULL",
                wfpsf_observation_find_sca(o, 0, N, ra, dec, NULL, NULL, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "x_last = NULL",
                wfpsf_observation_bounds(o, 7, 1, &first_x, NULL, &first_y, &last_y));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 0",
                wfpsf_observation_jacobian(o, 0, N, x, y, NULL, area, NULL, NULL));
    wfpsf_observation_destroy(o);
}

static void test_header(void) {
    wfpsf_observation *o = observe("wfirst-afta-c5");
    char text[8000], few[9];
    double value = 0;
    int64_t length = 0;
    CHECK_OK(wfpsf_observation_fits_header(o, 3, sizeof text, text, &length));
    CHECK(length > 0 && length % 80 == 0 && (int64_t)strlen(text) == length);
    CHECK(strstr(text, "CTYPE1  = 'RA---TAN-SIP'") != NULL);
    CHECK(strstr(text, "SCA_NUM =                    3") != NULL);
    CHECK_OK(wfpsf_observation_fits_header(o, 3, 0, NULL, &length));
    CHECK_OK(wfpsf_observation_fits_header(o, 3, sizeof few, few, NULL));
    CHECK(strcmp(few, "WCSAXES ") == 0);
    CHECK_OK(wfpsf_observation_get(o, 3, WFPSF_OBSERVATION_PA_FPA, &value));
    CHECK_NEAR(value, 152.5, 1e-12);
    CHECK_OK(wfpsf_observation_get(o, 3, WFPSF_OBSERVATION_CRPIX2, &value));
    CHECK(value == 2044);
    CHECK_FAILS(WFPSF_ERROR_SIZE, "capacity = -1",
                wfpsf_observation_fits_header(o, 3, -1, text, &length));
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = 11", wfpsf_observation_get(o, 3, 11, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "value = NULL",
                wfpsf_observation_get(o, 3, WFPSF_OBSERVATION_RA, NULL));
    wfpsf_observation_destroy(o);
    wfpsf_observation_destroy(NULL);
}

static void test_refusals(void) {
    wfpsf_instrument *roman = instrument("roman-c9"), *own = NULL;
    wfpsf_design *design = NULL;
    wfpsf_observation *o = (wfpsf_observation *)roman; /* something that must be overwritten */
    CHECK_FAILS(WFPSF_ERROR_RANGE, "dec_deg = 91",
                wfpsf_observation_create(roman, 0, 91, 0, NULL, &o));
    CHECK(o == NULL);
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "pa_deg = nan",
                wfpsf_observation_create(roman, 0, 0, NAN, NULL, &o));
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument = NULL",
                wfpsf_observation_create(NULL, 0, 0, 0, NULL, &o));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out = NULL",
                wfpsf_observation_create(roman, 0, 0, 0, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 19",
                wfpsf_observation_create_aimed(roman, 19, 0, 0, 0, 0, 0, NULL, &o));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "x = inf",
                wfpsf_observation_create_aimed(roman, 1, INFINITY, 0, 0, 0, 0, NULL, &o));

    CHECK_OK(wfpsf_design_create(&design));
    CHECK_OK(wfpsf_design_set_telescope(design, 1, 0, 1000));
    CHECK_OK(wfpsf_design_set_detector(design, 1, 0.1, 100, 100));
    CHECK_OK(wfpsf_instrument_create_from_design(design, &own));
    CHECK_FAILS(WFPSF_ERROR_NO_WCS, "instrument = design",
                wfpsf_observation_create(own, 0, 0, 0, NULL, &o));
    CHECK_FAILS(WFPSF_ERROR_NO_WCS, "instrument = design",
                wfpsf_observation_create_on_date(own, 0, 0, 2461000, NULL, &o));
    wfpsf_instrument_destroy(own);
    wfpsf_design_destroy(design);
    wfpsf_instrument_destroy(roman);
}

static void test_sun(void) {
    wfpsf_instrument *roman = instrument("roman-c9");
    wfpsf_observation *o = NULL;
    double date = 0, ra = 0, dec = 0, angle = 0, pa = 0, kept = 0;
    int32_t allowed = -1;
    CHECK_OK(wfpsf_julian_date(2026, 3, 20, 14, 46, 0, &date));
    CHECK_OK(wfpsf_sun_position(date, NULL, &ra, &dec));
    CHECK_NEAR(dec, 0, 0.2);
    CHECK_OK(wfpsf_pointing_allowed(roman, ra + 90, 0, date, NULL, &angle, &allowed));
    CHECK(allowed == 1);
    CHECK_NEAR(angle, 90, 1e-6);
    CHECK_OK(wfpsf_pointing_best_pa(roman, ra + 90, 0, date, NULL, &pa));
    CHECK_NEAR(pa, dec, 1e-6); /* the Sun is to the west, Y a quarter turn past it */
    CHECK_OK(wfpsf_observation_create_on_date(roman, ra + 90, 0, date, NULL, &o));
    CHECK_OK(wfpsf_observation_get(o, 1, WFPSF_OBSERVATION_PA, &kept));
    CHECK_NEAR(kept, pa, 1e-12);
    wfpsf_observation_destroy(o);

    CHECK_OK(wfpsf_pointing_allowed(roman, ra, dec, date, NULL, &angle, &allowed));
    CHECK(allowed == 0 && angle < 1e-6);
    CHECK_FAILS(WFPSF_ERROR_SUN_ANGLE, "must be 54..126",
                wfpsf_pointing_best_pa(roman, ra, dec, date, NULL, &pa));
    CHECK_FAILS(WFPSF_ERROR_SUN_ANGLE, "must be 54..126",
                wfpsf_observation_create_on_date(roman, ra, dec, date, NULL, &o));
    CHECK(o == NULL);
    CHECK_FAILS(WFPSF_ERROR_RANGE, "julian_date = 5",
                wfpsf_pointing_allowed(roman, 0, 0, 5, NULL, &angle, &allowed));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "julian_date = nan",
                wfpsf_sun_position(NAN, NULL, &ra, &dec));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "2026-13-1", wfpsf_julian_date(2026, 13, 1, 0, 0, 0, &date));
    CHECK_FAILS(WFPSF_ERROR_NULL, "julian_date = NULL",
                wfpsf_julian_date(2026, 1, 1, 0, 0, 0, NULL));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "dec_deg = -91",
                wfpsf_pointing_best_pa(roman, 0, -91, date, NULL, &pa));
    wfpsf_instrument_destroy(roman);
}

int main(void) {
    test_positions();
    test_header();
    test_refusals();
    test_sun();
    return checked();
}
