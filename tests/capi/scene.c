/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Catalogues and scenes, in C99: what is drawn is what stars drawn one by one are, hard scenes are
   defined, and bad arguments are refused. */
#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <wfpsf/wfpsf.h>

enum { N = 64 };

static wfpsf_instrument *roman;

static wfpsf_image *image_of(double *pixels) {
    wfpsf_image *image = NULL;
    memset(pixels, 0, N * N * sizeof *pixels);
    CHECK_OK(wfpsf_image_wrap(WFPSF_FLOAT64, pixels, N, N, 1, N, 1, &image));
    return image;
}

static wfpsf_catalogue *catalogue_of(int64_t count, const double *x, const double *y,
                                     const double *flux) {
    wfpsf_catalogue *catalogue = NULL;
    CHECK_OK(
        wfpsf_catalogue_create(WFPSF_POSITIONS_DETECTOR, WFPSF_BRIGHTNESS_ELECTRONS, &catalogue));
    CHECK_OK(wfpsf_catalogue_add_stars(catalogue, count, x, y, flux, NULL));
    return catalogue;
}

/* Renders stars at (1000, 1000) of the detector; returns the time. */
static void render(const wfpsf_catalogue *catalogue, const wfpsf_options *options, double *pixels) {
    wfpsf_image *image = image_of(pixels);
    wfpsf_scene *scene = NULL;
    wfpsf_rendering *rendering = NULL;
    double allowed = 0, estimate = 0;
    CHECK_OK(
        wfpsf_scene_create(roman, NULL, "J129", 7, catalogue, image, 1000, 1000, options, &scene));
    CHECK_OK(wfpsf_scene_render(scene, options, image, &rendering));
    CHECK_OK(wfpsf_scene_get(scene, WFPSF_SCENE_ERROR_ALLOWED, &allowed));
    CHECK_OK(wfpsf_rendering_get(rendering, WFPSF_RENDERING_ERROR_ESTIMATE, &estimate));
    CHECK(estimate <= allowed);
    wfpsf_rendering_destroy(rendering);
    wfpsf_scene_destroy(scene);
    wfpsf_image_destroy(image);
}

static wfpsf_options *options_of(double noise, double variance) {
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_SCENE_NOISE, noise));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_SCENE_VARIANCE, variance));
    return options;
}

static double worst(const double *a, const double *b) {
    double most = 0;
    for (int i = 0; i < N * N; ++i)
        most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

static void check_store(void) {
    const double x[] = {1010.3, 1040.7, 1063.5}, y[] = {1020.1, 1050, 1000};
    const double flux[] = {5000, 300, 2000};
    static double first[N * N], again[N * N], second[N * N];
    int64_t empty = -1, held = -1, from_file = -1;
    wfpsf_scene_store *store = NULL;
    wfpsf_options *options = options_of(0.1, 100);
    wfpsf_catalogue *catalogue = catalogue_of(3, x, y, flux);
    CHECK_OK(wfpsf_scene_store_create(&store));
    CHECK_OK(wfpsf_scene_store_memory(store, &empty));
    CHECK(empty == 0);
    CHECK_OK(wfpsf_options_set_scene_store(options, store));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_SCENE_EXPOSURES, 50));
    render(catalogue, options, first);
    CHECK_OK(wfpsf_scene_store_memory(store, &held));
    CHECK(held > 0);
    CHECK_OK(wfpsf_scene_store_write(store, "capi_scene.store"));
    wfpsf_scene_store_destroy(store); /* options share it */
    render(catalogue, options, again);
    CHECK(worst(first, again) <= 2 * 0.1 * sqrt(100));
    CHECK_OK(wfpsf_options_set_scene_store(options, NULL));
    render(catalogue, options, second);
    CHECK(worst(first, second) <= 2 * 0.1 * sqrt(100));

    /* A store from a file gives the same bits. */
    CHECK_OK(wfpsf_scene_store_create(&store));
    CHECK_OK(wfpsf_scene_store_read(store, "capi_scene.store"));
    CHECK_OK(wfpsf_scene_store_memory(store, &from_file));
    CHECK(from_file == held);
    CHECK_OK(wfpsf_options_set_scene_store(options, store));
    render(catalogue, options, second);
    CHECK(worst(again, second) == 0);
    CHECK_STATUS(WFPSF_ERROR_FILE_OPEN, wfpsf_scene_store_read(store, "no such file"));
    CHECK_STATUS(WFPSF_ERROR_FILE_WRITE, wfpsf_scene_store_write(store, "no such folder/file"));
    CHECK_STATUS(WFPSF_ERROR_NULL, wfpsf_scene_store_read(NULL, "capi_scene.store"));
    CHECK_STATUS(WFPSF_ERROR_NULL, wfpsf_scene_store_read(store, NULL));
    CHECK_STATUS(WFPSF_ERROR_NULL, wfpsf_scene_store_write(NULL, "capi_scene.store"));
    CHECK_STATUS(WFPSF_ERROR_NULL, wfpsf_scene_store_write(store, NULL));
    wfpsf_scene_store_destroy(store);
    remove("capi_scene.store");
    CHECK_STATUS(WFPSF_ERROR_NULL, wfpsf_scene_store_create(NULL));
    CHECK_STATUS(WFPSF_ERROR_NULL, wfpsf_scene_store_memory(NULL, &held));
    CHECK_STATUS(WFPSF_ERROR_NULL, wfpsf_options_set_scene_store(NULL, NULL));
    wfpsf_scene_store_destroy(NULL);
    wfpsf_catalogue_destroy(catalogue);
    wfpsf_options_destroy(options);
}

static void check_stars(void) {
    const double x[] = {1010.3, 1040.7, 1063.5, 990, 1030}, y[] = {1020.1, 1050, 1000, 1031, 1300};
    const double flux[] = {5000, 300, 2000, 8000, 4000};
    static double drawn[N * N], truth[N * N];
    wfpsf_options *options = options_of(0.01, 100);
    wfpsf_catalogue *catalogue = catalogue_of(5, x, y, flux);
    render(catalogue, options, drawn);
    wfpsf_image *image = image_of(truth);
    wfpsf_options *exact = NULL;
    CHECK_OK(wfpsf_options_create(&exact));
    CHECK_OK(wfpsf_options_set_real(exact, WFPSF_OPTION_EPS, 1e-8));
    for (int i = 0; i < 5; ++i) {
        wfpsf_psf *psf = NULL;
        CHECK_OK(wfpsf_psf_create_in_band(roman, "J129", 7, x[i], y[i], 0, exact, &psf));
        CHECK_OK(wfpsf_psf_add_bright_star(psf, x[i] - 1000, y[i] - 1000, flux[i], exact, image));
        wfpsf_psf_destroy(psf);
    }
    CHECK(worst(drawn, truth) <= 0.1);
    CHECK(worst(drawn, truth) > 0);

    /* The same bits with threads. */
    static double again[N * N];
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_THREADS, 3));
    render(catalogue, options, again);
    CHECK(memcmp(drawn, again, sizeof drawn) == 0);

    wfpsf_image_destroy(image);
    wfpsf_options_destroy(exact);
    wfpsf_options_destroy(options);
    wfpsf_catalogue_destroy(catalogue);
}

/* Clusters, a star too bright, none at all, far ones. */
static void check_hard_scenes(void) {
    enum { many = 10000 };
    static double x[many], y[many], flux[many], drawn[N * N], truth[N * N];
    for (int i = 0; i < many; ++i) {
        x[i] = 1031.6 + 0.8 * i / many;
        y[i] = 1032.3 - 0.6 * i / many;
        flux[i] = 10;
    }
    wfpsf_options *options = options_of(0.1, 100);
    wfpsf_catalogue *cluster = catalogue_of(many, x, y, flux);
    render(cluster, options, drawn);
    wfpsf_psf *psf = NULL;
    wfpsf_options *exact = NULL;
    CHECK_OK(wfpsf_options_create(&exact));
    CHECK_OK(wfpsf_options_set_real(exact, WFPSF_OPTION_PSF_RADIUS, 64));
    CHECK_OK(wfpsf_psf_create_in_band(roman, "J129", 7, 1032, 1032, 0, exact, &psf));
    wfpsf_image *image = image_of(truth);
    for (int i = 0; i < many; ++i) {
        x[i] -= 1000;
        y[i] -= 1000;
    }
    CHECK_OK(wfpsf_psf_add_stars(psf, many, x, y, flux, exact, image));
    /* 1e5 e- in all, whose PSF is that of their middle to 1e-5. */
    CHECK(worst(drawn, truth) <= 2);
    wfpsf_image_destroy(image);
    wfpsf_psf_destroy(psf);
    wfpsf_options_destroy(exact);
    wfpsf_catalogue_destroy(cluster);

    const double middle = 1031.5, brilliant = 1e12;
    wfpsf_catalogue *bright = catalogue_of(1, &middle, &middle, &brilliant);
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_SCENE_NOISE, 1e3));
    render(bright, options, drawn);
    double sum = 0;
    for (int i = 0; i < N * N; ++i)
        sum += drawn[i];
    CHECK(sum > 0.97e12 && sum < 1e12);
    wfpsf_catalogue_destroy(bright);

    wfpsf_catalogue *none = catalogue_of(0, NULL, NULL, NULL);
    render(none, options, drawn);
    for (int i = 0; i < N * N; ++i)
        CHECK(drawn[i] == 0);
    wfpsf_catalogue_destroy(none);

    const double far[] = {1e9, -1e9}, zero[] = {0, 0}, some[] = {1e4, 1e4};
    wfpsf_catalogue *away = catalogue_of(2, far, zero, some);
    render(away, options, drawn);
    for (int i = 0; i < N * N; ++i)
        CHECK(fabs(drawn[i]) < 1e-6);
    wfpsf_catalogue_destroy(away);
    wfpsf_options_destroy(options);
}

static void check_galaxies(void) {
    /* From a thousandth of a pixel to a thousand pixels. */
    const double x[] = {1032, 1032, 1032, 1032}, flux[] = {1000, 1000, 1000, 1e6};
    const double index[] = {1, 0.5, 4, 1}, radius[] = {1.1e-4, 0.3, 0.5, 110};
    const double e1[] = {0, 0.3, 0, 0.1}, e2[] = {0, 0, -0.2, 0};
    static double drawn[N * N];
    wfpsf_options *options = options_of(0.02, 100);
    for (int i = 0; i < 4; ++i) {
        wfpsf_catalogue *catalogue = NULL;
        CHECK_OK(wfpsf_catalogue_create(WFPSF_POSITIONS_DETECTOR, WFPSF_BRIGHTNESS_ELECTRONS,
                                        &catalogue));
        CHECK_OK(wfpsf_catalogue_add_galaxies(catalogue, 1, x + i, x + i, flux + i, NULL, index + i,
                                              radius + i, e1 + i, e2 + i));
        render(catalogue, options, drawn);
        double sum = 0;
        for (int k = 0; k < N * N; ++k)
            sum += drawn[k];
        if (i < 2)
            CHECK(sum > 0.95 * flux[i] && sum < 1.01 * flux[i]);
        if (i == 2)
            CHECK(sum > 0.85 * flux[i] && sum < flux[i]);
        if (i == 3) { /* exponential: its central surface brightness, 1.678^2 / (2 pi r_e^2) */
            const double centre = flux[i] * 1.678347 * 1.678347 / (2 * 3.14159265 * 1e6);
            CHECK(fabs(drawn[32 * N + 32] - centre) < 0.02 * centre + 0.1);
        }
        wfpsf_catalogue_destroy(catalogue);
    }
    wfpsf_options_destroy(options);
}

static void check_plan(void) {
    const double x[] = {1010, 1020, 1e9}, y[] = {1010, 1030, 0}, flux[] = {1e4, 10, 5};
    static double pixels[N * N];
    wfpsf_catalogue *catalogue = catalogue_of(3, x, y, flux);
    wfpsf_image *image = image_of(pixels);
    wfpsf_options *options = options_of(0.05, 100);
    wfpsf_scene *scene = NULL;
    CHECK_OK(
        wfpsf_scene_create(roman, NULL, "J129", 7, catalogue, image, 1000, 1000, options, &scene));
    double groups = 0, value = 0;
    CHECK_OK(wfpsf_scene_get(scene, WFPSF_SCENE_GROUPS, &groups));
    CHECK(groups == 3);
    int32_t group[3];
    CHECK_OK(wfpsf_scene_groups_of(scene, 3, group));
    double bright = 0, faint = 0;
    CHECK_OK(wfpsf_scene_get_group(scene, group[0], WFPSF_SCENE_GROUP_RADIUS, &bright));
    CHECK_OK(wfpsf_scene_get_group(scene, group[1], WFPSF_SCENE_GROUP_RADIUS, &faint));
    CHECK(bright > faint);
    CHECK_OK(wfpsf_scene_get_group(scene, group[0], WFPSF_SCENE_GROUP_FLUX_FROM, &value));
    CHECK(value == 8192);
    char text[2000];
    int64_t length = 0;
    CHECK_OK(wfpsf_scene_text(scene, sizeof text, text, &length));
    CHECK((int64_t)strlen(text) == length && strstr(text, "3 sources"));

    double truth[3 * WFPSF_TRUTH_COLUMNS];
    wfpsf_ipc_kernel *kernel = NULL;
    CHECK_OK(wfpsf_ipc_kernel_create(0.02, 0.002, 0, NULL, &kernel));
    CHECK_OK(wfpsf_scene_truth(scene, 2, NULL, kernel, NULL, truth));
    for (int i = 0; i < 2; ++i) {
        const double *row = truth + i * WFPSF_TRUTH_COLUMNS;
        CHECK(row[WFPSF_TRUTH_POSITION_X] == x[i]);
        CHECK(row[WFPSF_TRUTH_STATUS] == WFPSF_OK);
        CHECK(fabs(row[WFPSF_TRUTH_CENTROID_X] - x[i]) < 0.3);
        /* the paper's 6 % for J129 */
        CHECK(fabs(row[WFPSF_TRUTH_IPC_SIGMA] / row[WFPSF_TRUTH_SIGMA] - 1.06) < 0.01);
    }
    wfpsf_ipc_kernel_destroy(kernel);

    CHECK_STATUS(WFPSF_ERROR_UNKNOWN_NAME, wfpsf_scene_get(scene, 12345, &value));
    CHECK_STATUS(WFPSF_ERROR_RANGE,
                 wfpsf_scene_get_group(scene, 3, WFPSF_SCENE_GROUP_RADIUS, &value));
    CHECK_STATUS(WFPSF_ERROR_SIZE, wfpsf_scene_groups_of(scene, 2, group));
    const int64_t beyond = 3;
    CHECK_STATUS(WFPSF_ERROR_RANGE, wfpsf_scene_truth(scene, 1, &beyond, NULL, NULL, truth));
    wfpsf_image *small = NULL;
    CHECK_OK(wfpsf_image_create(WFPSF_FLOAT64, 32, 32, 1, &small));
    CHECK_STATUS(WFPSF_ERROR_SIZE, wfpsf_scene_render(scene, NULL, small, NULL));
    wfpsf_image_destroy(small);
    wfpsf_scene_destroy(scene);
    wfpsf_options_destroy(options);
    wfpsf_image_destroy(image);
    wfpsf_catalogue_destroy(catalogue);
}

static void check_bad_arguments(void) {
    wfpsf_catalogue *catalogue = NULL;
    CHECK_STATUS(WFPSF_ERROR_ARGUMENT, wfpsf_catalogue_create(3, 1, &catalogue));
    CHECK_STATUS(WFPSF_ERROR_ARGUMENT, wfpsf_catalogue_create(1, 0, &catalogue));
    CHECK_STATUS(WFPSF_ERROR_NULL, wfpsf_catalogue_create(1, 1, NULL));
    CHECK_OK(
        wfpsf_catalogue_create(WFPSF_POSITIONS_SKY, WFPSF_BRIGHTNESS_AB_MAGNITUDE, &catalogue));
    const double good = 1, nan_value = NAN, pole = 91, wide = 0.99;
    const int32_t colour = 1;
    CHECK_STATUS(WFPSF_ERROR_NOT_FINITE,
                 wfpsf_catalogue_add_stars(catalogue, 1, &nan_value, &good, &good, NULL));
    CHECK_STATUS(WFPSF_ERROR_RANGE,
                 wfpsf_catalogue_add_stars(catalogue, 1, &good, &pole, &good, NULL));
    CHECK_STATUS(WFPSF_ERROR_RANGE,
                 wfpsf_catalogue_add_stars(catalogue, 1, &good, &good, &good, &colour));
    CHECK_STATUS(WFPSF_ERROR_SIZE,
                 wfpsf_catalogue_add_stars(catalogue, -1, &good, &good, &good, NULL));
    CHECK_STATUS(WFPSF_ERROR_NULL,
                 wfpsf_catalogue_add_stars(catalogue, 1, NULL, &good, &good, NULL));
    CHECK_STATUS(WFPSF_ERROR_RANGE, wfpsf_catalogue_add_galaxies(catalogue, 1, &good, &good, &good,
                                                                 NULL, &good, &good, &wide, NULL));
    int64_t count = -1;
    CHECK_OK(wfpsf_catalogue_size(catalogue, &count));
    CHECK(count == 0);
    CHECK_STATUS(WFPSF_ERROR_RANGE, wfpsf_catalogue_add_colour(catalogue, 10, NULL, NULL));

    static double pixels[N * N];
    wfpsf_image *image = image_of(pixels);
    wfpsf_scene *scene = NULL;
    CHECK_OK(wfpsf_catalogue_add_stars(catalogue, 1, &good, &good, &good, NULL));
    CHECK_STATUS(WFPSF_ERROR_ARGUMENT,
                 wfpsf_scene_create(roman, NULL, "J129", 7, catalogue, image, 0, 0, NULL,
                                    &scene)); /* sky positions, no observation */
    CHECK_STATUS(WFPSF_ERROR_UNKNOWN_NAME,
                 wfpsf_scene_create(roman, NULL, "X1", 7, catalogue, image, 0, 0, NULL, &scene));
    CHECK_STATUS(WFPSF_ERROR_RANGE,
                 wfpsf_scene_create(roman, NULL, "J129", 19, catalogue, image, 0, 0, NULL, &scene));
    CHECK_STATUS(WFPSF_ERROR_NOT_FINITE, wfpsf_scene_create(roman, NULL, "J129", 7, catalogue,
                                                            image, NAN, 0, NULL, &scene));
    CHECK(scene == NULL);
    wfpsf_image_destroy(image);
    wfpsf_catalogue_destroy(catalogue);

    double rate = 0;
    CHECK_OK(wfpsf_instrument_ab_zero_rate(roman, "J129", &rate));
    CHECK(fabs(2.5 * log10(rate) - 26.4) < 0.2); /* the band's zero point */
    CHECK_STATUS(WFPSF_ERROR_UNKNOWN_NAME, wfpsf_instrument_ab_zero_rate(roman, "X1", &rate));
}

int main(void) {
    CHECK_OK(wfpsf_instrument_create("roman-c9", &roman));
    check_stars();
    check_hard_scenes();
    check_galaxies();
    check_plan();
    check_store();
    check_bad_arguments();
    wfpsf_instrument_destroy(roman);
    return checked();
}
