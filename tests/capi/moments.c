/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moments: Gaussians give back what they were made of; everything else a status that says why. */
#include "pixels.h"

static double number(const wfpsf_moments *moments, int32_t key) {
    double value = 7;
    CHECK_OK(wfpsf_moments_get(moments, key, &value));
    return value;
}

static void check_gaussian(const wfpsf_image *image, double x0, double y0, double Mxx, double Mxy,
                           double Myy) {
    wfpsf_moments *m = NULL;
    const double det = Mxx * Myy - Mxy * Mxy, trace = Mxx + Myy;
    CHECK_OK(wfpsf_moments_measure(image, NULL, &m));
    CHECK(wfpsf_moments_status(m) == WFPSF_OK);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_CENTROID_X), x0, 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_CENTROID_Y), y0, 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MXX), Mxx, 1e-7 * trace);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MXY), Mxy, 1e-7 * trace);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MYY), Myy, 1e-7 * trace);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_SIGMA), pow(det, 0.25), 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_SIGMA_TRACE), sqrt(trace), 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_E1), (Mxx - Myy) / trace, 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_E2), 2 * Mxy / trace, 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_E), hypot(Mxx - Myy, 2 * Mxy) / trace, 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_BETA), atan2(2 * Mxy, Mxx - Myy) / 2, 1e-6);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_FLUX), 2 * 3.14159265358979323846 * sqrt(det), 1e-6 * det);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_RHO4), 2, 1e-6);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_CURVATURE), 0.125, 1e-4);
    CHECK(number(m, WFPSF_MOMENTS_PASSES) >= 1);
    CHECK(number(m, WFPSF_MOMENTS_ERROR_ESTIMATE) <= 1e-8);
    CHECK(number(m, WFPSF_MOMENTS_EDGE_FRACTION) < 1e-6);
    wfpsf_moments_destroy(m);
}

static void test_gaussians(void) {
    double data[51 * 46], flipped[51 * 46];
    float single[51 * 46];
    fill_gaussian(data, 51, 46, 24.3, 23.8, 9, 2, 5);
    for (int i = 0; i < 51 * 46; ++i)
        flipped[51 * 46 - 1 - i] = data[i];
    wfpsf_image *image = wrap(data, 51, 46), *backward = wrap_flipped(flipped, 51, 46),
                *narrow = wrap_float(single, 51, 46);
    CHECK_OK(wfpsf_image_copy(image, narrow));
    check_gaussian(image, 24.3, 23.8, 9, 2, 5);
    check_gaussian(backward, 24.3, 23.8, 9, 2, 5);
    check_gaussian(narrow, 24.3, 23.8, 9, 2, 5);
    fill_gaussian(data, 51, 46, 24.3, 23.8, 3, -1, 6);
    check_gaussian(image, 24.3, 23.8, 3, -1, 6);

    /* the same solution from the caller's guess, and a warning when passes run out */
    wfpsf_options *options = NULL;
    wfpsf_moments *m = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_MOMENTS_GUESS_X, 23));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_MOMENTS_GUESS_SIGMA, 3));
    CHECK_OK(wfpsf_moments_measure(image, options, &m));
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MXX), 3, 1e-6);
    wfpsf_moments_destroy(m);
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_MOMENTS_MAX_PASSES, 1));
    CHECK_STATUS(WFPSF_WARNING_NOT_CONVERGED, wfpsf_moments_measure(image, options, &m));
    CHECK(wfpsf_moments_status(m) == WFPSF_WARNING_NOT_CONVERGED);
    wfpsf_moments_destroy(m);

    /* every tolerance that the option allows can be asked for */
    double tolerances[] = {0, 1e-11, 1e-5, 0};
    CHECK_OK(wfpsf_option_describe(WFPSF_OPTION_MOMENTS_TOLERANCE, NULL, NULL, NULL, NULL,
                                   &tolerances[0], &tolerances[3]));
    CHECK_OK(wfpsf_options_reset(options, WFPSF_OPTION_MOMENTS_MAX_PASSES));
    for (size_t i = 0; i < sizeof tolerances / sizeof tolerances[0]; ++i) {
        CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_MOMENTS_TOLERANCE, tolerances[i]));
        CHECK(wfpsf_moments_measure(image, options, &m) >= 0);
        CHECK_NEAR(number(m, WFPSF_MOMENTS_MXX), 3, 10 * tolerances[i] + 1e-9);
        wfpsf_moments_destroy(m);
    }
    wfpsf_options_destroy(options);
    wfpsf_image_destroy(image);
    wfpsf_image_destroy(backward);
    wfpsf_image_destroy(narrow);
}

static void test_unweighted(void) {
    double data[41 * 40];
    wfpsf_image *image = wrap(data, 41, 40);
    wfpsf_moments *m = NULL;
    fill_gaussian(data, 41, 40, 20.3, 18.9, 4, 1, 3);
    CHECK_OK(wfpsf_moments_measure_unweighted(image, NAN, NAN, &m));
    CHECK_NEAR(number(m, WFPSF_MOMENTS_CENTROID_X), 20.3, 1e-10);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_CENTROID_Y), 18.9, 1e-10);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MXX), 4, 1e-9);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MXY), 1, 1e-9);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MYY), 3, 1e-9);
    CHECK(isnan(number(m, WFPSF_MOMENTS_RHO4)) && isnan(number(m, WFPSF_MOMENTS_PASSES)));
    wfpsf_moments_destroy(m);
    CHECK_OK(wfpsf_moments_measure_unweighted(image, 19.3, 18.9, &m));
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MXX), 5, 1e-9); /* parallel axes */
    wfpsf_moments_destroy(m);

    m = STALE(wfpsf_moments);
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "nan", wfpsf_moments_measure_unweighted(image, NAN, 3, &m));
    CHECK(m == NULL);
    m = STALE(wfpsf_moments);
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "inf",
                wfpsf_moments_measure_unweighted(image, 3, HUGE_VAL, &m));
    CHECK(m == NULL);
    wfpsf_image_destroy(image);
}

/* A measurement that fails still leaves a result, which carries the status. */
static void check_failure(wfpsf_status status, const wfpsf_image *image) {
    wfpsf_moments *m = NULL;
    spoil_last_error();
    CHECK_STATUS(status, wfpsf_moments_measure(image, NULL, &m));
    char line[1024];
    wfpsf_last_error(line, sizeof line);
    CHECK(strlen(line) > 20 && strstr(line, "-12345") == NULL && !strchr(line, '\n'));
    CHECK(m != NULL && wfpsf_moments_status(m) == status);
    wfpsf_moments_destroy(m);
}

static void check_unweighted_failure(wfpsf_status status, const wfpsf_image *image) {
    wfpsf_moments *m = STALE(wfpsf_moments);
    CHECK_STATUS(status, wfpsf_moments_measure_unweighted(image, NAN, NAN, &m));
    CHECK(m == NULL);
}

static void test_failures(void) {
    double data[25 * 25];
    wfpsf_image *image = wrap(data, 25, 25), *none = wrap(NULL, 0, 0), *one = wrap(data, 1, 1),
                *row = wrap(data, 25, 1), *column = wrap(data, 1, 25), *frame = wrap(data, 9, 9);
    check_failure(WFPSF_ERROR_MOMENTS_NO_PIXELS, none);
    check_unweighted_failure(WFPSF_ERROR_MOMENTS_NO_PIXELS, none);

    fill(data, 25 * 25, 0);
    check_failure(WFPSF_ERROR_MOMENTS_FLUX, image);
    check_unweighted_failure(WFPSF_ERROR_MOMENTS_FLUX, image);
    fill(data, 25 * 25, -1);
    check_failure(WFPSF_ERROR_MOMENTS_FLUX, image);
    for (int i = 0; i < 81; ++i) /* light at the border alone */
        data[i] = i % 9 == 0 || i % 9 == 8 || i / 9 == 0 || i / 9 == 8;
    check_failure(WFPSF_ERROR_MOMENTS_FILLS_IMAGE, frame);
    fill_gaussian(data, 25, 25, 12, 12, 0.09, 0, 0.09);
    check_failure(WFPSF_ERROR_MOMENTS_UNRESOLVED, image);
    fill_gaussian(data, 25, 25, 12, 12, 9, 0, 9);
    data[12 * 25 + 11] = NAN;
    check_failure(WFPSF_ERROR_NOT_FINITE, image);
    check_unweighted_failure(WFPSF_ERROR_NOT_FINITE, image);
    data[12 * 25 + 11] = HUGE_VAL;
    check_failure(WFPSF_ERROR_NOT_FINITE, image);

    /* one pixel, one row or one column hold no matrix */
    fill(data, 25, 1);
    data[12] = 5;
    wfpsf_image *const thin[] = {one, row, column};
    for (int i = 0; i < 3; ++i) {
        wfpsf_moments *m = NULL;
        CHECK(wfpsf_moments_measure(thin[i], NULL, &m) < 0);
        CHECK(m != NULL && wfpsf_moments_status(m) < 0);
        wfpsf_moments_destroy(m);
    }
    wfpsf_image *const all[] = {image, none, one, row, column, frame};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
        wfpsf_image_destroy(all[i]);
}

static void test_null_and_unknown(void) {
    double data[21 * 21], value = 7;
    wfpsf_image *image = wrap(data, 21, 21);
    wfpsf_moments *m = STALE(wfpsf_moments);
    fill_gaussian(data, 21, 21, 10, 10, 4, 0, 4);
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_moments_measure(NULL, NULL, &m));
    CHECK(m == NULL);
    m = STALE(wfpsf_moments);
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_moments_measure_unweighted(NULL, 0, 0, &m));
    CHECK(m == NULL);
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_moments_measure(image, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_moments_measure_unweighted(image, 0, 0, NULL));
    CHECK(wfpsf_moments_status(NULL) == WFPSF_ERROR_NULL);
    wfpsf_moments_destroy(NULL);

    CHECK_OK(wfpsf_moments_measure(image, NULL, &m));
#define CHECK_PROPERTY(name, key, text) CHECK(isfinite(number(m, WFPSF_MOMENTS_##name)));
    WFPSF_MOMENTS_PROPERTY_LIST(CHECK_PROPERTY)
#undef CHECK_PROPERTY
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = 11", wfpsf_moments_get(m, 11, &value));
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = 0", wfpsf_moments_get(m, 0, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "moments", wfpsf_moments_get(NULL, WFPSF_MOMENTS_SIGMA, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "value", wfpsf_moments_get(m, WFPSF_MOMENTS_SIGMA, NULL));
    CHECK(value == 7);
    wfpsf_moments_destroy(m);
    wfpsf_image_destroy(image);
}

int main(void) {
    test_gaussians();
    test_unweighted();
    test_failures();
    test_null_and_unknown();
    return checked();
}
