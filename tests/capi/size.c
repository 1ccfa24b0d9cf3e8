/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Encircled energy, EE50 and FWHM of a Gaussian, and what is refused. */
#include "pixels.h"

enum { nx = 81, ny = 79 };
static const double star_x = 40.3, star_y = 38.6, sigma = 5, pi = 3.14159265358979323846;

static wfpsf_options *options;

static void test_gaussian(const wfpsf_image *image) {
    double value = 0, error = 1;
    const double half = sigma * sqrt(2 * log(2));
    for (int i = 0; i < 4; ++i) {
        const double r = 7.5 * i;
        CHECK_OK(wfpsf_size_encircled_energy(image, star_x, star_y, r, options, &value, &error));
        CHECK_NEAR(value, 1 - exp(-r * r / (2 * sigma * sigma)), 1e-10);
        CHECK(error >= 0 && error < 1e-9);
    }
    CHECK_OK(wfpsf_size_ee_radius(image, star_x, star_y, 0.5, WFPSF_SIZE_BANDLIMITED, options,
                                  &value, &error));
    CHECK_NEAR(value, half, 1e-9);
    CHECK(error >= 0 && error < 1e-8);
    CHECK_OK(wfpsf_size_ee_radius(image, star_x, star_y, 0.5, WFPSF_SIZE_PIXEL_SUM, options, &value,
                                  &error));
    CHECK_NEAR(value, half, 0.3);
    CHECK(isnan(error));
    CHECK_OK(wfpsf_size_ee_radius(image, star_x, star_y, 0.5, WFPSF_SIZE_PIXEL_INTERPOLATED,
                                  options, &value, &error));
    CHECK_NEAR(value, half, 0.3);
    CHECK(isnan(error));
    CHECK_OK(
        wfpsf_size_ee_radius(image, star_x, star_y, 0.5, WFPSF_SIZE_PIXEL_SUM, NULL, &value, NULL));
    CHECK_OK(wfpsf_size_fwhm(image, star_x, star_y, &value));
    CHECK_NEAR(value, 2 * half, 0.5);
}

/* A stated total scales the fraction; without it the sum of the pixels counts. */
static void test_total(const wfpsf_image *image) {
    double value = 0;
    CHECK_OK(wfpsf_size_encircled_energy(image, star_x, star_y, 10, NULL, &value, NULL));
    CHECK_NEAR(value, 1 - exp(-2), 1e-10);
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_SIZE_TOTAL_FLUX, 4 * pi * sigma * sigma));
    CHECK_OK(wfpsf_size_encircled_energy(image, star_x, star_y, 10, options, &value, NULL));
    CHECK_NEAR(value, (1 - exp(-2)) / 2, 1e-10);
    CHECK_FAILS(WFPSF_ERROR_SIZE_NOT_REACHED, "0.6",
                wfpsf_size_ee_radius(image, star_x, star_y, 0.6, WFPSF_SIZE_BANDLIMITED, options,
                                     &value, NULL));
    CHECK_STATUS(WFPSF_ERROR_SIZE_NOT_REACHED,
                 wfpsf_size_ee_radius(image, star_x, star_y, 0.6, WFPSF_SIZE_PIXEL_SUM, options,
                                      &value, NULL));
    CHECK_STATUS(WFPSF_ERROR_SIZE_NOT_REACHED,
                 wfpsf_size_ee_radius(image, star_x, star_y, 0.6, WFPSF_SIZE_PIXEL_INTERPOLATED,
                                      options, &value, NULL));
    CHECK_OK(wfpsf_options_reset(options, WFPSF_OPTION_SIZE_TOTAL_FLUX));
}

static void check_energy_refused(wfpsf_status status, const char *culprit, const wfpsf_image *image,
                                 double x, double y, double radius) {
    double value = 7, error = 7;
    CHECK_FAILS(status, culprit,
                wfpsf_size_encircled_energy(image, x, y, radius, NULL, &value, &error));
    CHECK(value == 7 && error == 7);
}

static void check_radius_refused(wfpsf_status status, const char *culprit, const wfpsf_image *image,
                                 double x, double y, double fraction, int32_t method) {
    double value = 7, error = 7;
    CHECK_FAILS(status, culprit,
                wfpsf_size_ee_radius(image, x, y, fraction, method, NULL, &value, &error));
    CHECK(value == 7 && error == 7);
}

static void test_refuses(const wfpsf_image *image) {
    const int32_t exact = WFPSF_SIZE_BANDLIMITED;
    double value = 7, error = 7;
    check_energy_refused(WFPSF_ERROR_NULL, "image", NULL, star_x, star_y, 5);
    check_energy_refused(WFPSF_ERROR_NOT_FINITE, "x = nan", image, NAN, star_y, 5);
    check_energy_refused(WFPSF_ERROR_NOT_FINITE, "y = inf", image, star_x, HUGE_VAL, 5);
    check_energy_refused(WFPSF_ERROR_NOT_FINITE, "radius = nan", image, star_x, star_y, NAN);
    check_energy_refused(WFPSF_ERROR_RANGE, "radius = -1", image, star_x, star_y, -1);
    check_energy_refused(WFPSF_ERROR_SIZE_NOT_REACHED, "radius = 39.5", image, star_x, star_y,
                         39.5);
    check_energy_refused(WFPSF_ERROR_SIZE_NOT_REACHED, "radius = 1", image, -5, star_y, 1);
    CHECK_FAILS(WFPSF_ERROR_NULL, "fraction",
                wfpsf_size_encircled_energy(image, star_x, star_y, 5, NULL, NULL, &error));

    check_radius_refused(WFPSF_ERROR_NULL, "image", NULL, star_x, star_y, 0.5, exact);
    check_radius_refused(WFPSF_ERROR_NOT_FINITE, "x = inf", image, HUGE_VAL, star_y, 0.5, exact);
    check_radius_refused(WFPSF_ERROR_NOT_FINITE, "y = nan", image, star_x, NAN, 0.5, exact);
    check_radius_refused(WFPSF_ERROR_NOT_FINITE, "fraction = nan", image, star_x, star_y, NAN,
                         exact);
    check_radius_refused(WFPSF_ERROR_RANGE, "fraction = 0", image, star_x, star_y, 0, exact);
    check_radius_refused(WFPSF_ERROR_RANGE, "fraction = 1", image, star_x, star_y, 1, exact);
    check_radius_refused(WFPSF_ERROR_RANGE, "fraction = -0.5", image, star_x, star_y, -0.5, exact);
    check_radius_refused(WFPSF_ERROR_ARGUMENT, "method = 0", image, star_x, star_y, 0.5, 0);
    check_radius_refused(WFPSF_ERROR_ARGUMENT, "method = 4", image, star_x, star_y, 0.5, 4);
    check_radius_refused(WFPSF_ERROR_SIZE_NOT_REACHED, "-9", image, -9, star_y, 0.5, exact);
    CHECK_FAILS(WFPSF_ERROR_NULL, "radius",
                wfpsf_size_ee_radius(image, star_x, star_y, 0.5, exact, NULL, NULL, &error));

    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_size_fwhm(NULL, star_x, star_y, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "fwhm", wfpsf_size_fwhm(image, star_x, star_y, NULL));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "x = nan", wfpsf_size_fwhm(image, NAN, star_y, &value));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "y = -inf",
                wfpsf_size_fwhm(image, star_x, -HUGE_VAL, &value));
    CHECK(value == 7 && error == 7);
}

/* Images without light, with a NaN, or without pixels. */
static void test_bad_pixels(void) {
    double data[25], value = 7;
    wfpsf_image *image = wrap(data, 5, 5), *none = wrap(NULL, 0, 0);
    fill(data, 25, 0);
    for (int round = 0; round < 2; ++round) {
        check_energy_refused(WFPSF_ERROR_MOMENTS_FLUX, "= ", image, 2, 2, 1);
        for (int32_t method = 1; method <= 3; ++method)
            check_radius_refused(WFPSF_ERROR_MOMENTS_FLUX, "= ", image, 2, 2, 0.5, method);
        CHECK_STATUS(WFPSF_ERROR_MOMENTS_FLUX, wfpsf_size_fwhm(image, 2, 2, &value));
        fill(data, 25, -1);
    }
    fill(data, 25, 1);
    CHECK_STATUS(WFPSF_ERROR_SIZE_NOT_REACHED, wfpsf_size_fwhm(image, 2, 2, &value));
    data[7] = NAN;
    check_energy_refused(WFPSF_ERROR_NOT_FINITE, "nan", image, 2, 2, 1);
    for (int32_t method = 1; method <= 3; ++method)
        check_radius_refused(WFPSF_ERROR_NOT_FINITE, "nan", image, 2, 2, 0.5, method);
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "(2, 1) = nan", wfpsf_size_fwhm(image, 2, 2, &value));

    check_energy_refused(WFPSF_ERROR_MOMENTS_FLUX, "", none, 0, 0, 0);
    for (int32_t method = 1; method <= 3; ++method)
        check_radius_refused(WFPSF_ERROR_MOMENTS_FLUX, "", none, 0, 0, 0.5, method);
    CHECK_STATUS(WFPSF_ERROR_MOMENTS_FLUX, wfpsf_size_fwhm(none, 0, 0, &value));
    CHECK(value == 7);
    wfpsf_image_destroy(image);
    wfpsf_image_destroy(none);
}

/* exp(-r^2/(2 sigma^2)) on circles, its FWHM, and the radius' derivative as the star grows. */
static void test_profile(const wfpsf_image *image) {
    const double radii[3] = {0, 4, 11};
    double profile[3] = {0}, errors[3] = {0}, value = 0, error = 0;
    CHECK_OK(wfpsf_size_profile(image, star_x, star_y, 3, radii, NULL, profile, errors));
    for (int i = 0; i < 3; ++i) {
        const double truth = exp(-radii[i] * radii[i] / (2 * sigma * sigma));
        CHECK_NEAR(profile[i], truth, 1e-11);
        CHECK(fabs(profile[i] - truth) <= errors[i] && errors[i] < 1e-10);
    }
    CHECK_OK(wfpsf_size_profile(image, star_x, star_y, 0, NULL, NULL, NULL, NULL));
    CHECK_OK(wfpsf_size_profile_fwhm(image, star_x, star_y, NULL, &value, &error));
    CHECK_NEAR(value, 2 * sigma * sqrt(2 * log(2)), 1e-9);
    CHECK(fabs(value - 2 * sigma * sqrt(2 * log(2))) <= error && error < 1e-8);

    const double bad[1] = {-1}, far[1] = {60}, nan_radius[1] = {NAN};
    CHECK_FAILS(WFPSF_ERROR_RANGE, "radius = -1",
                wfpsf_size_profile(image, star_x, star_y, 1, bad, NULL, profile, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE_NOT_REACHED, "radius = 60",
                wfpsf_size_profile(image, star_x, star_y, 1, far, NULL, profile, NULL));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "radius = nan",
                wfpsf_size_profile(image, star_x, star_y, 1, nan_radius, NULL, profile, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = -1",
                wfpsf_size_profile(image, star_x, star_y, -1, radii, NULL, profile, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image",
                wfpsf_size_profile(NULL, star_x, star_y, 1, radii, NULL, profile, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "radii",
                wfpsf_size_profile(image, star_x, star_y, 1, NULL, NULL, profile, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "profile",
                wfpsf_size_profile(image, star_x, star_y, 1, radii, NULL, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "fwhm",
                wfpsf_size_profile_fwhm(image, star_x, star_y, NULL, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image",
                wfpsf_size_profile_fwhm(NULL, star_x, star_y, NULL, &value, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE_NOT_REACHED, "-9",
                wfpsf_size_profile_fwhm(image, -9, star_y, NULL, &value, NULL));
    double flat[121];
    fill(flat, 121, 1);
    wfpsf_image *even = wrap(flat, 11, 11);
    CHECK_STATUS(WFPSF_ERROR_SIZE_NOT_REACHED,
                 wfpsf_size_profile_fwhm(even, 5, 5, NULL, &value, NULL));
    fill(flat, 121, -1);
    CHECK_STATUS(WFPSF_ERROR_MOMENTS_FLUX, wfpsf_size_profile_fwhm(even, 5, 5, NULL, &value, NULL));
    fill(flat, 121, NAN);
    CHECK_STATUS(WFPSF_ERROR_NOT_FINITE, wfpsf_size_profile_fwhm(even, 5, 5, NULL, &value, NULL));
    wfpsf_image_destroy(even);
}

static void test_derivative(const wfpsf_image *image) {
    static double change_data[nx * ny];
    double value = 7, error = 7;
    /* d/dsigma of a Gaussian of constant flux 2 pi 25: (r^2/sigma^3 - 2/sigma) I */
    fill_gaussian(change_data, nx, ny, star_x, star_y, sigma * sigma, 0, sigma * sigma);
    for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x) {
            const double r2 = (x - star_x) * (x - star_x) + (y - star_y) * (y - star_y);
            change_data[y * nx + x] *= r2 / (sigma * sigma * sigma) - 2 / sigma;
        }
    wfpsf_image *change = wrap(change_data, nx, ny), *small = wrap(change_data, 3, 3);
    CHECK_OK(wfpsf_size_ee_radius_derivative(image, change, NULL, star_x, star_y, 0.5, NULL, &value,
                                             &error));
    CHECK_NEAR(value, sqrt(2 * log(2)), 1e-9);
    CHECK(fabs(value - sqrt(2 * log(2))) <= error && error < 1e-8);
    /* more of the same light changes nothing, unless the total is said to stay */
    CHECK_OK(wfpsf_size_ee_radius_derivative(image, image, NULL, star_x, star_y, 0.5, NULL, &value,
                                             NULL));
    CHECK_NEAR(value, 0, 1e-10);
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_SIZE_TOTAL_FLUX, 2 * pi * sigma * sigma));
    CHECK_OK(wfpsf_size_ee_radius_derivative(image, image, NULL, star_x, star_y, 0.5, options,
                                             &value, NULL));
    CHECK_NEAR(value, -sigma / sqrt(2 * log(2)), 1e-9);
    /* (1 + s) (1 - exp(-R^2/(2 sigma^2))) = 1/2 by s, twice */
    const double half = sqrt(2 * log(2));
    CHECK_OK(wfpsf_size_ee_radius_derivative(image, image, image, star_x, star_y, 0.5, options,
                                             &value, &error));
    CHECK_NEAR(value, sigma * (3 / half - 1 / (half * half * half)), 1e-8);
    CHECK(error > 0 && error < 1e-7);
    CHECK_OK(wfpsf_options_reset(options, WFPSF_OPTION_SIZE_TOTAL_FLUX));

    value = 7;
    CHECK_FAILS(WFPSF_ERROR_SIZE, "change: has 3 x 3",
                wfpsf_size_ee_radius_derivative(image, small, NULL, star_x, star_y, 0.5, NULL,
                                                &value, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "second: has 3 x 3",
                wfpsf_size_ee_radius_derivative(image, change, small, star_x, star_y, 0.5, NULL,
                                                &value, NULL));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "fraction = 2",
                wfpsf_size_ee_radius_derivative(image, change, NULL, star_x, star_y, 2, NULL,
                                                &value, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image",
                wfpsf_size_ee_radius_derivative(NULL, change, NULL, star_x, star_y, 0.5, NULL,
                                                &value, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "change",
                wfpsf_size_ee_radius_derivative(image, NULL, NULL, star_x, star_y, 0.5, NULL,
                                                &value, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "derivative",
                wfpsf_size_ee_radius_derivative(image, change, NULL, star_x, star_y, 0.5, NULL,
                                                NULL, NULL));
    change_data[38 * nx + 40] = NAN;
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "nan",
                wfpsf_size_ee_radius_derivative(image, change, NULL, star_x, star_y, 0.5, NULL,
                                                &value, NULL));
    CHECK(value == 7);
    wfpsf_image_destroy(change);
    wfpsf_image_destroy(small);
}

/* The error that is asked for is met, and its estimate holds. */
static void test_eps(const wfpsf_image *image) {
    const double half = sigma * sqrt(2 * log(2));
    double value = 0, error = 0;
    for (double eps = 1e-2; eps > 1e-13; eps /= 10) {
        CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_SIZE_EPS, eps));
        CHECK_OK(wfpsf_size_ee_radius(image, star_x, star_y, 0.5, WFPSF_SIZE_BANDLIMITED, options,
                                      &value, &error));
        CHECK_NEAR(value, half, 10 * eps + 1e-9);
        CHECK(fabs(value - half) <= error + 1e-9);
    }
    CHECK_OK(wfpsf_options_reset(options, WFPSF_OPTION_SIZE_EPS));
}

int main(void) {
    static double data[nx * ny], flipped[nx * ny];
    fill_gaussian(data, nx, ny, star_x, star_y, sigma * sigma, 0, sigma * sigma);
    for (int i = 0; i < nx * ny; ++i)
        flipped[nx * ny - 1 - i] = data[i];
    CHECK_OK(wfpsf_options_create(&options));
    wfpsf_image *image = wrap(data, nx, ny), *backward = wrap_flipped(flipped, nx, ny);
    test_gaussian(image);
    test_gaussian(backward);
    test_total(image);
    test_refuses(image);
    test_bad_pixels();
    test_profile(image);
    test_profile(backward);
    test_derivative(image);
    test_eps(image);
    wfpsf_image_destroy(image);
    wfpsf_image_destroy(backward);
    wfpsf_options_destroy(options);
    return checked();
}
