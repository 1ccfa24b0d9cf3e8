/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The instrument's figures, and every wrong way to ask for them. */
#include "pixels.h"

static void test_create(void) {
    wfpsf_instrument *out = STALE(wfpsf_instrument);
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "hubble", wfpsf_instrument_create("hubble", &out));
    CHECK(out == NULL);
    out = STALE(wfpsf_instrument);
    CHECK_STATUS(WFPSF_ERROR_UNKNOWN_NAME, wfpsf_instrument_create("", &out));
    CHECK(out == NULL);
    out = STALE(wfpsf_instrument);
    CHECK_FAILS(WFPSF_ERROR_NULL, "name", wfpsf_instrument_create(NULL, &out));
    CHECK(out == NULL);
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_instrument_create("wfirst-afta-c5", NULL));
    wfpsf_instrument_destroy(NULL);
}

static void test_constants(const wfpsf_instrument *c5) {
    double value = 7;
    const char *unit = "before";
    CHECK_OK(wfpsf_instrument_constant(c5, "diameter", &value, &unit));
    CHECK(value == 2.36 && strcmp(unit, "m") == 0);
    CHECK_OK(wfpsf_instrument_constant(c5, "obscuration", &value, NULL));
    CHECK(value == 0.3);
    CHECK_OK(wfpsf_instrument_constant(c5, "n_sca", &value, &unit));
    CHECK(value == 18);

    value = 7, unit = "before";
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "colour",
                wfpsf_instrument_constant(c5, "colour", &value, &unit));
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument",
                wfpsf_instrument_constant(NULL, "diameter", &value, &unit));
    CHECK_FAILS(WFPSF_ERROR_NULL, "name", wfpsf_instrument_constant(c5, NULL, &value, &unit));
    CHECK(value == 7 && strcmp(unit, "before") == 0);
    CHECK_FAILS(WFPSF_ERROR_NULL, "value", wfpsf_instrument_constant(c5, "diameter", NULL, &unit));
    CHECK(strcmp(unit, "before") == 0);

    int64_t count = 0;
    for (; wfpsf_instrument_constant_name(c5, count); ++count)
        CHECK_OK(wfpsf_instrument_constant(c5, wfpsf_instrument_constant_name(c5, count), &value,
                                           &unit));
    CHECK(count > 10);
    CHECK(wfpsf_instrument_constant_name(c5, -1) == NULL);
    CHECK(wfpsf_instrument_constant_name(c5, INT64_MAX) == NULL);
    CHECK(wfpsf_instrument_constant_name(NULL, 0) == NULL);
}

static void test_bands(const wfpsf_instrument *c5) {
    static const char *const names[] = {"Z087", "Y106", "J129", "W149", "H158", "F184"};
    double blue = 7, red = 7, effective = 7;
    for (int64_t i = 0; i < 6; ++i) {
        CHECK(strcmp(wfpsf_instrument_band_name(c5, i), names[i]) == 0);
        CHECK_OK(wfpsf_instrument_band(c5, names[i], WFPSF_BAND_PAPER, &blue, &red, &effective));
        CHECK(blue < effective && effective < red);
        CHECK_OK(wfpsf_instrument_band(c5, names[i], WFPSF_BAND_TABULATED, NULL, NULL, NULL));
    }
    CHECK(wfpsf_instrument_band_name(c5, 6) == NULL);
    CHECK(wfpsf_instrument_band_name(c5, -1) == NULL);
    CHECK(wfpsf_instrument_band_name(NULL, 0) == NULL);

    blue = red = effective = 7;
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "K213",
                wfpsf_instrument_band(c5, "K213", WFPSF_BAND_PAPER, &blue, &red, &effective));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "rule = 0",
                wfpsf_instrument_band(c5, "J129", 0, &blue, &red, &effective));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "rule = 3",
                wfpsf_instrument_band(c5, "J129", 3, &blue, &red, &effective));
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument",
                wfpsf_instrument_band(NULL, "J129", WFPSF_BAND_PAPER, &blue, &red, &effective));
    CHECK_FAILS(WFPSF_ERROR_NULL, "band",
                wfpsf_instrument_band(c5, NULL, WFPSF_BAND_PAPER, &blue, &red, &effective));
    CHECK(blue == 7 && red == 7 && effective == 7);
}

static void test_throughput(const wfpsf_instrument *c5) {
    double wavelength[3] = {1290, 100, 1292.5}, throughput[3] = {7, 7, 7};
    CHECK_OK(wfpsf_instrument_throughput(c5, "J129", 3, wavelength, throughput));
    CHECK(throughput[0] > 0.5 && throughput[1] == 0 && throughput[2] > 0.5);
    CHECK_OK(wfpsf_instrument_throughput(c5, "J129", 0, NULL, NULL));

    fill(throughput, 3, 7);
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = -1",
                wfpsf_instrument_throughput(c5, "J129", -1, wavelength, throughput));
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "j129",
                wfpsf_instrument_throughput(c5, "j129", 3, wavelength, throughput));
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument",
                wfpsf_instrument_throughput(NULL, "J129", 3, wavelength, throughput));
    CHECK_FAILS(WFPSF_ERROR_NULL, "band",
                wfpsf_instrument_throughput(c5, NULL, 3, wavelength, throughput));
    CHECK_FAILS(WFPSF_ERROR_NULL, "wavelength_nm",
                wfpsf_instrument_throughput(c5, "J129", 3, NULL, throughput));
    CHECK_FAILS(WFPSF_ERROR_NULL, "throughput",
                wfpsf_instrument_throughput(c5, "J129", 3, wavelength, NULL));
    wavelength[2] = NAN;
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "wavelength_nm[2] = nan",
                wfpsf_instrument_throughput(c5, "J129", 3, wavelength, throughput));
    wavelength[1] = HUGE_VAL;
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "wavelength_nm[1] = inf",
                wfpsf_instrument_throughput(c5, "J129", 3, wavelength, throughput));
    CHECK(all_are(throughput, 3, 7));
}

static void test_zernikes(const wfpsf_instrument *c5) {
    double coefficients[12];
    int64_t count = 7;
    for (int32_t sca = 1; sca <= 18; ++sca) {
        fill(coefficients, 12, 7);
        CHECK_OK(wfpsf_instrument_zernikes(c5, sca, 12, coefficients, &count));
        CHECK(count == 11 && coefficients[11] == 7 && fabs(coefficients[10]) < 1);
    }
    fill(coefficients, 12, 7);
    CHECK_OK(wfpsf_instrument_zernikes(c5, 7, 4, coefficients, NULL));
    CHECK(coefficients[3] != 7 && coefficients[4] == 7);
    count = 7;
    CHECK_OK(wfpsf_instrument_zernikes(c5, 7, 0, NULL, &count));
    CHECK(count == 11);

    fill(coefficients, 12, 7), count = 7;
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 0",
                wfpsf_instrument_zernikes(c5, 0, 12, coefficients, &count));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 19",
                wfpsf_instrument_zernikes(c5, 19, 12, coefficients, &count));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = -2147483648",
                wfpsf_instrument_zernikes(c5, INT32_MIN, 12, coefficients, &count));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "capacity = -1",
                wfpsf_instrument_zernikes(c5, 7, -1, coefficients, &count));
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument",
                wfpsf_instrument_zernikes(NULL, 7, 12, coefficients, &count));
    CHECK_FAILS(WFPSF_ERROR_NULL, "coefficients",
                wfpsf_instrument_zernikes(c5, 7, 12, NULL, &count));
    CHECK(all_are(coefficients, 12, 7) && count == 7);
}

int main(void) {
    wfpsf_instrument *c5 = NULL;
    test_create();
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    test_constants(c5);
    test_bands(c5);
    test_throughput(c5);
    test_zernikes(c5);
    wfpsf_instrument_destroy(c5);
    return checked();
}
