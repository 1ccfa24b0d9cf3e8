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

static const int32_t derived[] = {
    WFPSF_MOMENTS_CENTROID_X,  WFPSF_MOMENTS_CENTROID_Y, WFPSF_MOMENTS_MXX,
    WFPSF_MOMENTS_MXY,         WFPSF_MOMENTS_MYY,        WFPSF_MOMENTS_SIGMA,
    WFPSF_MOMENTS_SIGMA_TRACE, WFPSF_MOMENTS_E1,         WFPSF_MOMENTS_E2,
    WFPSF_MOMENTS_E,           WFPSF_MOMENTS_BETA,       WFPSF_MOMENTS_FLUX};
enum { derived_count = sizeof derived / sizeof derived[0], side = 41 };

/* One of the measurements, of the image plus t times the change. */
typedef wfpsf_moments *measurement(const wfpsf_image *image);

static wfpsf_moments *adaptive(const wfpsf_image *image) {
    wfpsf_options *options = NULL;
    wfpsf_moments *m = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_MOMENTS_TOLERANCE, 1e-12));
    CHECK_OK(wfpsf_moments_measure(image, options, &m));
    wfpsf_options_destroy(options);
    return m;
}

static wfpsf_moments *unweighted(const wfpsf_image *image) {
    wfpsf_moments *m = NULL;
    CHECK_OK(wfpsf_moments_measure_unweighted(image, NAN, NAN, &m));
    return m;
}

static wfpsf_moments *about_a_point(const wfpsf_image *image) {
    wfpsf_moments *m = NULL;
    CHECK_OK(wfpsf_moments_measure_unweighted(image, 19, 20, &m));
    return m;
}

static wfpsf_moments *weighted(const wfpsf_image *image) {
    wfpsf_moments *m = NULL;
    CHECK_OK(wfpsf_moments_measure_weighted(image, 19.5, 20.3, 7, 1, 6, &m));
    return m;
}

static double value_along(measurement *measured, double t, double u, int32_t key) {
    double data[side * side], a[side * side], b[side * side];
    fill_gaussian(data, side, side, 20.3, 18.9, 7, 1, 2.5);
    fill_gaussian(a, side, side, 22, 20, 6, -1, 5);
    fill_gaussian(b, side, side, 18, 18, 3, 0, 9);
    for (int i = 0; i < side * side; ++i)
        data[i] += t * a[i] + u * b[i];
    wfpsf_image *image = wrap(data, side, side);
    wfpsf_moments *m = measured(image);
    const double value = number(m, key);
    wfpsf_moments_destroy(m);
    wfpsf_image_destroy(image);
    return value;
}

static double slope(measurement *measured, double h, int32_t key) {
    return (value_along(measured, h, 0, key) - value_along(measured, -h, 0, key)) / (2 * h);
}

static double cross(measurement *measured, double h, int32_t key) {
    return (value_along(measured, h, h, key) - value_along(measured, h, -h, key) -
            value_along(measured, -h, h, key) + value_along(measured, -h, -h, key)) /
           (4 * h * h);
}

/* Two steps of Richardson's extrapolation. */
static double extrapolated(double (*f)(measurement *, double, int32_t), measurement *measured,
                           double h, int32_t key) {
    const double f1 = f(measured, h, key), f2 = f(measured, 2 * h, key),
                 f4 = f(measured, 4 * h, key);
    return (16 * (4 * f1 - f2) / 3 - (4 * f2 - f4) / 3) / 15;
}

static void test_derivatives(measurement *measured) {
    double data[side * side], a[side * side], b[side * side], influence[side * side];
    fill_gaussian(data, side, side, 20.3, 18.9, 7, 1, 2.5);
    fill_gaussian(a, side, side, 22, 20, 6, -1, 5);
    fill_gaussian(b, side, side, 18, 18, 3, 0, 9);
    wfpsf_image *image = wrap(data, side, side), *change = wrap(a, side, side),
                *other = wrap(b, side, side), *out = wrap(influence, side, side);
    wfpsf_moments *m = measured(image), *first = NULL, *second = NULL;
    CHECK_OK(wfpsf_moments_differentiate(m, image, change, NULL, &first));
    CHECK_OK(wfpsf_moments_differentiate(m, image, change, other, &second));
    for (int i = 0; i < derived_count; ++i) {
        const int32_t key = derived[i];
        const double scale = 1 + fabs(number(m, key));
        CHECK_NEAR(number(first, key), extrapolated(slope, measured, 1e-3, key), 1e-8 * scale);
        CHECK_NEAR(number(second, key), extrapolated(cross, measured, 2e-3, key), 1e-6 * scale);
        CHECK_OK(wfpsf_moments_influence(m, image, key, out));
        double sum = 0;
        for (int k = 0; k < side * side; ++k)
            sum += influence[k] * a[k];
        CHECK_NEAR(number(first, key), sum, 1e-10 * scale);
    }
    CHECK(isnan(number(first, WFPSF_MOMENTS_PASSES)));
    wfpsf_moments *again = STALE(wfpsf_moments);
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "derivatives",
                wfpsf_moments_differentiate(first, image, change, NULL, &again));
    CHECK(again == NULL);
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = 140",
                wfpsf_moments_influence(m, image, WFPSF_MOMENTS_PASSES, out));
    wfpsf_moments_destroy(m);
    wfpsf_moments_destroy(first);
    wfpsf_moments_destroy(second);
    wfpsf_image *const all[] = {image, change, other, out};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
        wfpsf_image_destroy(all[i]);
}

static void test_derivatives_refused(void) {
    double data[side * side], small[9] = {0};
    float single[side * side];
    fill_gaussian(data, side, side, 20, 20, 4, 1, 3);
    wfpsf_image *image = wrap(data, side, side), *other = wrap(small, 3, 3),
                *wrong = wrap_float(single, side, side);
    wfpsf_moments *m = adaptive(image), *out = STALE(wfpsf_moments);
    CHECK_FAILS(WFPSF_ERROR_NULL, "moments",
                wfpsf_moments_differentiate(NULL, image, image, NULL, &out));
    CHECK(out == NULL);
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_moments_differentiate(m, NULL, image, NULL, &out));
    CHECK_FAILS(WFPSF_ERROR_NULL, "change",
                wfpsf_moments_differentiate(m, image, NULL, NULL, &out));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_moments_differentiate(m, image, image, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "image: has 3 x 3",
                wfpsf_moments_differentiate(m, other, image, NULL, &out));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "change: has 3 x 3",
                wfpsf_moments_differentiate(m, image, other, NULL, &out));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "second: has 3 x 3",
                wfpsf_moments_differentiate(m, image, image, other, &out));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "influence: has 3 x 3",
                wfpsf_moments_influence(m, image, WFPSF_MOMENTS_E1, other));
    CHECK_FAILS(WFPSF_ERROR_TYPE, "float64",
                wfpsf_moments_influence(m, image, WFPSF_MOMENTS_E1, wrong));
    CHECK_FAILS(WFPSF_ERROR_NULL, "influence",
                wfpsf_moments_influence(m, image, WFPSF_MOMENTS_E1, NULL));
    double bad[side * side];
    fill(bad, side * side, NAN);
    wfpsf_image *nans = wrap(bad, side, side);
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "change",
                wfpsf_moments_differentiate(m, image, nans, NULL, &out));
    CHECK(out == NULL);
    wfpsf_moments_destroy(m);
    /* nothing to differentiate where there is no solution */
    fill(data, side * side, 0);
    CHECK_STATUS(WFPSF_ERROR_MOMENTS_FLUX, wfpsf_moments_measure(image, NULL, &m));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "-310",
                wfpsf_moments_differentiate(m, image, image, NULL, &out));
    wfpsf_moments_destroy(m);
    wfpsf_image *const all[] = {image, other, wrong, nans};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
        wfpsf_image_destroy(all[i]);
}

static void test_masked(void) {
    double data[side * side], mask[side * side], variance[side * side], value = 7;
    fill_gaussian(data, side, side, 20.3, 18.9, 4, 1, 3);
    fill(mask, side * side, 0);
    fill(variance, side * side, 1e-6);
    for (int i = 0; i < side; ++i) {
        data[19 * side + i] = i % 2 ? NAN : 1e30;
        mask[19 * side + i] = i % 2 ? NAN : 2;
    }
    wfpsf_image *image = wrap(data, side, side), *missing = wrap(mask, side, side),
                *noise = wrap(variance, side, side), *small = wrap(data, 3, 3);
    wfpsf_options *options = NULL;
    wfpsf_moments *m = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    double errors[3];
    for (int method = 0; method < 2; ++method) {
        CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_MOMENTS_METHOD, method));
        CHECK_OK(wfpsf_moments_measure_masked(image, missing, noise, options, &m));
        CHECK_NEAR(number(m, WFPSF_MOMENTS_CENTROID_X), 20.3, 1e-8);
        CHECK_NEAR(number(m, WFPSF_MOMENTS_MXX), 4, 1e-7);
        CHECK_NEAR(number(m, WFPSF_MOMENTS_AMPLITUDE), 1, 1e-7);
        CHECK(number(m, WFPSF_MOMENTS_MISSING_FRACTION) > 0.1);
        CHECK(number(m, WFPSF_MOMENTS_MISSING_FRACTION) < 0.5);
        CHECK_OK(
            wfpsf_moments_covariance(m, WFPSF_MOMENTS_SIGMA, WFPSF_MOMENTS_SIGMA, &errors[method]));
        wfpsf_moments_destroy(m);
    }
    CHECK_OK(wfpsf_options_reset(options, WFPSF_OPTION_MOMENTS_METHOD));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_MOMENTS_VARIANCE, 1e-6));
    CHECK_OK(wfpsf_moments_measure_masked(image, missing, NULL, options, &m));
    CHECK_OK(wfpsf_moments_covariance(m, WFPSF_MOMENTS_SIGMA, WFPSF_MOMENTS_SIGMA, &errors[2]));
    CHECK_NEAR(errors[1] / errors[0], 1, 1e-6);
    CHECK_NEAR(errors[2] / errors[0], 1, 1e-9);
    double xy, yx;
    CHECK_OK(wfpsf_moments_covariance(m, WFPSF_MOMENTS_E1, WFPSF_MOMENTS_FLUX, &xy));
    CHECK_OK(wfpsf_moments_covariance(m, WFPSF_MOMENTS_FLUX, WFPSF_MOMENTS_E1, &yx));
    CHECK_NEAR(xy / yx, 1, 1e-12);
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = 140",
                wfpsf_moments_covariance(m, WFPSF_MOMENTS_E1, WFPSF_MOMENTS_PASSES, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "value",
                wfpsf_moments_covariance(m, WFPSF_MOMENTS_E1, WFPSF_MOMENTS_E1, NULL));
    wfpsf_moments_destroy(m);
    CHECK_OK(wfpsf_moments_measure_masked(image, missing, NULL, NULL, &m));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "variance",
                wfpsf_moments_covariance(m, WFPSF_MOMENTS_E1, WFPSF_MOMENTS_E1, &value));
    wfpsf_moments_destroy(m);

    /* refused: sizes, impossible variances (with a result), nothing seen */
    m = STALE(wfpsf_moments);
    CHECK_FAILS(WFPSF_ERROR_SIZE, "missing: has 3 x 3",
                wfpsf_moments_measure_masked(image, small, NULL, NULL, &m));
    CHECK(m == NULL);
    CHECK_FAILS(WFPSF_ERROR_SIZE, "variance: has 3 x 3",
                wfpsf_moments_measure_masked(image, NULL, small, NULL, &m));
    variance[5] = -1;
    CHECK_FAILS(WFPSF_ERROR_RANGE, "(5, 0) = -1",
                wfpsf_moments_measure_masked(image, missing, noise, NULL, &m));
    CHECK(m != NULL && wfpsf_moments_status(m) == WFPSF_OK);
    wfpsf_moments_destroy(m);
    variance[5] = HUGE_VAL;
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "(5, 0) = inf",
                wfpsf_moments_measure_masked(image, missing, noise, NULL, &m));
    wfpsf_moments_destroy(m);
    fill(mask, side * side, 1);
    CHECK_FAILS(WFPSF_ERROR_MOMENTS_NO_PIXELS, "missing",
                wfpsf_moments_measure_masked(image, missing, NULL, NULL, &m));
    CHECK(m != NULL);
    wfpsf_moments_destroy(m);
    CHECK_FAILS(WFPSF_ERROR_NULL, "image",
                wfpsf_moments_measure_masked(NULL, NULL, NULL, NULL, &m));
    CHECK(m == NULL && value == 7);
    wfpsf_options_destroy(options);
    wfpsf_image *const all[] = {image, missing, noise, small};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
        wfpsf_image_destroy(all[i]);
}

/* A background that is fitted, its covariance, and what the second order adds to it. */
static void test_fitted_background(void) {
    double data[side * side];
    fill_gaussian(data, side, side, 20.3, 18.9, 4, 1, 3);
    for (int i = 0; i < side * side; ++i)
        data[i] += 7;
    wfpsf_image *image = wrap(data, side, side);
    wfpsf_options *options = NULL;
    wfpsf_moments *m = NULL, *by = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_MOMENTS_METHOD, 3));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_MOMENTS_VARIANCE, 1e-3));
    double first = 0, second = 0, background = 0;
    CHECK_OK(wfpsf_moments_measure(image, options, &m));
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MXX), 4, 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_BACKGROUND), 7, 1e-8);
    CHECK_OK(wfpsf_moments_covariance(m, WFPSF_MOMENTS_MXX, WFPSF_MOMENTS_MXX, &first));
    CHECK_OK(
        wfpsf_moments_covariance(m, WFPSF_MOMENTS_BACKGROUND, WFPSF_MOMENTS_FLUX, &background));
    CHECK(background < 0);
    /* along the image itself everything that scales does */
    CHECK_OK(wfpsf_moments_differentiate(m, image, image, NULL, &by));
    CHECK_NEAR(number(by, WFPSF_MOMENTS_BACKGROUND), 7, 1e-7);
    CHECK_NEAR(number(by, WFPSF_MOMENTS_MXX), 0, 1e-7);
    wfpsf_moments_destroy(by);
    wfpsf_moments_destroy(m);
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_MOMENTS_COVARIANCE_ORDER, 2));
    CHECK_OK(wfpsf_moments_measure(image, options, &m));
    CHECK_OK(wfpsf_moments_covariance(m, WFPSF_MOMENTS_MXX, WFPSF_MOMENTS_MXX, &second));
    CHECK(second > first && second < 1.02 * first);
    wfpsf_moments_destroy(m);
    CHECK_STATUS(WFPSF_ERROR_RANGE,
                 wfpsf_options_set_integer(options, WFPSF_OPTION_MOMENTS_COVARIANCE_ORDER, 3));
    data[3] = NAN; /* far beyond the weight */
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "(3, 0)", wfpsf_moments_measure(image, options, &m));
    wfpsf_moments_destroy(m);
    wfpsf_options_destroy(options);
    wfpsf_image_destroy(image);
}

/* A Gaussian of matrix 4, 1, 3 under a weight W has the moments (M^-1 + W^-1)^-1. */
static void test_fixed_weight(void) {
    double data[side * side], sums[15], weight[3] = {4, 1, 3};
    fill_gaussian(data, side, side, 20, 19, 4, 1, 3);
    wfpsf_image *image = wrap(data, side, side), *none = wrap(NULL, 0, 0);
    wfpsf_moments *m = NULL;
    const double pi = 3.14159265358979323846, flux = pi * sqrt(11);
    CHECK_OK(wfpsf_moments_measure_weighted(image, 20, 19, 4, 1, 3, &m));
    CHECK_NEAR(number(m, WFPSF_MOMENTS_CENTROID_X), 20, 1e-12);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MXX), 2, 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MXY), 0.5, 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_MYY), 1.5, 1e-7);
    CHECK_NEAR(number(m, WFPSF_MOMENTS_FLUX), flux, 1e-6);
    wfpsf_moments_destroy(m);
    /* fourth moments of a normal distribution; (j, k) = (4,0), (3,1), (2,2) are sums 10 to 12 */
    CHECK_OK(wfpsf_moments_sums(image, 20, 19, weight, 15, sums));
    CHECK_NEAR(sums[0], flux, 1e-6);
    CHECK_NEAR(sums[6] / flux, 0, 1e-12);
    CHECK_NEAR(sums[10] / flux, 3 * 2 * 2, 1e-5);
    CHECK_NEAR(sums[11] / flux, 3 * 2 * 0.5, 1e-5);
    CHECK_NEAR(sums[12] / flux, 2 * 1.5 + 2 * 0.25, 1e-5);
    CHECK_OK(wfpsf_moments_sums(image, 20, 19, NULL, 15, sums));
    CHECK_NEAR(sums[0], 2 * flux, 1e-6);
    CHECK_NEAR(sums[10] / sums[0], 3 * 4 * 4, 1e-5);
    CHECK_NEAR(sums[14] / sums[0], 3 * 3 * 3, 1e-5);
    CHECK_OK(wfpsf_moments_sums(none, 20, 19, NULL, 15, sums));
    CHECK(sums[0] == 0);

    sums[0] = 7;
    weight[1] = 9;
    CHECK_FAILS(WFPSF_ERROR_RANGE, "(4, 9, 3)",
                wfpsf_moments_sums(image, 20, 19, weight, 15, sums));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "x = nan",
                wfpsf_moments_sums(image, NAN, 19, NULL, 15, sums));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_moments_sums(NULL, 20, 19, NULL, 15, sums));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "count = 16", wfpsf_moments_sums(image, 20, 19, NULL, 16, sums));
    CHECK_OK(wfpsf_moments_sums(image, 20, 19, NULL, 0, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "sums", wfpsf_moments_sums(image, 20, 19, NULL, 15, NULL));
    m = STALE(wfpsf_moments);
    CHECK_FAILS(WFPSF_ERROR_MOMENTS_NO_PIXELS, "empty",
                wfpsf_moments_measure_weighted(none, 20, 19, 4, 1, 3, &m));
    CHECK(m == NULL);
    CHECK_FAILS(WFPSF_ERROR_RANGE, "(0, 0, 3)",
                wfpsf_moments_measure_weighted(image, 20, 19, 0, 0, 3, &m));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "inf",
                wfpsf_moments_measure_weighted(image, HUGE_VAL, 19, 4, 1, 3, &m));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image",
                wfpsf_moments_measure_weighted(NULL, 20, 19, 4, 1, 3, &m));
    CHECK_FAILS(WFPSF_ERROR_MOMENTS_FLUX, "= 0",
                wfpsf_moments_measure_weighted(image, 2000, 19, 4, 1, 3, &m));
    data[20 * side + 20] = NAN;
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "nan",
                wfpsf_moments_measure_weighted(image, 20, 19, 4, 1, 3, &m));
    weight[1] = 1;
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "nan", wfpsf_moments_sums(image, 20, 19, weight, 15, sums));
    CHECK(sums[0] == 7);
    wfpsf_image_destroy(image);
    wfpsf_image_destroy(none);
}

int main(void) {
    test_derivatives(adaptive);
    test_derivatives(unweighted);
    test_derivatives(about_a_point);
    test_derivatives(weighted);
    test_derivatives_refused();
    test_masked();
    test_fitted_background();
    test_fixed_weight();
    test_gaussians();
    test_unweighted();
    test_failures();
    test_null_and_unknown();
    return checked();
}
