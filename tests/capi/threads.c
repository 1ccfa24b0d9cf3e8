/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Threads share one PSF and one kernel, draw, measure, and fail on purpose: every figure is that of
   one thread alone, bit for bit, and every error line is the thread's own. */
#include "pixels.h"

#include <pthread.h>

enum { threads = 4, stars = 6, side = 48 };

static const wfpsf_instrument *c5;
static const wfpsf_psf *psf;
static const wfpsf_ipc_kernel *kernel;

struct star {
    double drawn[side * side], blurred[side * side], sigma, e1, ee50;
};

static struct star alone[stars], together[threads][stars];

static void work(int star, struct star *result) {
    const double x = side / 2.0 + 0.37 * star, y = side / 2.0 - 0.21 * star;
    wfpsf_image *drawn = wrap_strided(result->drawn, side, side, 1, side, 4);
    wfpsf_image *blurred = wrap_strided(result->blurred, side, side, 1, side, 4);
    wfpsf_moments *moments = NULL;
    CHECK_OK(wfpsf_psf_draw(psf, x, y, 1000, NULL, drawn));
    CHECK_OK(wfpsf_ipc_apply(kernel, drawn, WFPSF_EDGE_ZERO, NULL, blurred, NULL));
    CHECK(wfpsf_moments_measure(blurred, NULL, &moments) >= 0);
    CHECK_OK(wfpsf_moments_get(moments, WFPSF_MOMENTS_SIGMA, &result->sigma));
    CHECK_OK(wfpsf_moments_get(moments, WFPSF_MOMENTS_E1, &result->e1));
    CHECK_OK(wfpsf_size_ee_radius(blurred, x, y, 0.5, WFPSF_SIZE_BANDLIMITED, NULL, &result->ee50,
                                  NULL));
    wfpsf_moments_destroy(moments);
    wfpsf_image_destroy(drawn);
    wfpsf_image_destroy(blurred);
}

/* Checks count failures without a lock: a count that is off is still not zero. */
static void *run(void *argument) {
    const int thread = *(const int *)argument;
    char culprit[32];
    double coefficient = 0;
    snprintf(culprit, sizeof culprit, "sca = %d", 100 + thread);
    for (int star = 0; star < stars; ++star) {
        CHECK_STATUS(WFPSF_ERROR_RANGE,
                     wfpsf_instrument_zernikes(c5, 100 + thread, 1, &coefficient, NULL));
        work(star, &together[thread][star]);
        check_culprit(culprit, "after a thread's own failure", __FILE__, __LINE__);
    }

    /* PSFs of a thread's own, made while others are */
    wfpsf_psf *own = NULL;
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 8));
    CHECK_OK(wfpsf_psf_create(c5, 1 + thread, 1300, options, &own));
    wfpsf_psf_destroy(own);
    wfpsf_options_destroy(options);
    return NULL;
}

static void check_same(const struct star *a, const struct star *b) {
    CHECK(are_equal(a->drawn, b->drawn, side * side));
    CHECK(are_equal(a->blurred, b->blurred, side * side));
    CHECK(a->sigma == b->sigma && a->e1 == b->e1 && a->ee50 == b->ee50);
}

/* A scene whose plan, PSFs and far light so many threads make. */
static void render_by(int number, double *pixels) {
    enum { faint = 60 };
    double x[faint + 1], y[faint + 1], flux[faint + 1];
    wfpsf_instrument *roman = NULL;
    wfpsf_sed *sed = NULL;
    wfpsf_catalogue *catalogue = NULL;
    wfpsf_options *options = NULL;
    wfpsf_scene *scene = NULL;
    wfpsf_image *image = wrap_strided(pixels, side, side, 1, side, 1);
    for (int i = 0; i <= faint; ++i) {
        x[i] = 1000 + (17 * i) % side + 0.01 * i;
        y[i] = 1000 + (29 * i) % side - 0.01 * i;
        flux[i] = i == 0 ? 1e6 : 200 + i;
    }
    CHECK_OK(wfpsf_instrument_create("roman-c9", &roman));
    CHECK_OK(wfpsf_sed_create_black_body(5000, &sed));
    CHECK_OK(
        wfpsf_catalogue_create(WFPSF_POSITIONS_DETECTOR, WFPSF_BRIGHTNESS_ELECTRONS, &catalogue));
    CHECK_OK(wfpsf_catalogue_add_colour(catalogue, 0, sed, NULL));
    CHECK_OK(wfpsf_catalogue_add_stars(catalogue, faint + 1, x, y, flux, NULL));
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_SCENE_NOISE, 0.3));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_SCENE_VARIANCE, 100));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_THREADS, number));
    CHECK_OK(
        wfpsf_scene_create(roman, NULL, "J129", 7, catalogue, image, 1000, 1000, options, &scene));
    CHECK_OK(wfpsf_scene_render(scene, options, image, NULL));
    wfpsf_scene_destroy(scene);
    wfpsf_options_destroy(options);
    wfpsf_catalogue_destroy(catalogue);
    wfpsf_sed_destroy(sed);
    wfpsf_image_destroy(image);
    wfpsf_instrument_destroy(roman);
}

static void check_scenes(void) {
    static double by_one[side * side], by_three[side * side];
    render_by(1, by_one);
    render_by(3, by_three);
    CHECK(are_equal(by_one, by_three, side * side));
    CHECK(by_one[0] > 1e4);
}

int main(void) {
    pthread_t started[threads];
    int numbers[threads];
    wfpsf_instrument *instrument = NULL;
    wfpsf_psf *shared_psf = NULL;
    wfpsf_ipc_kernel *shared_kernel = NULL;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &instrument));
    CHECK_OK(wfpsf_psf_create(instrument, 7, 1292.11, NULL, &shared_psf));
    CHECK_OK(wfpsf_ipc_kernel_create(0.02, 0.002, 0, NULL, &shared_kernel));
    c5 = instrument, psf = shared_psf, kernel = shared_kernel;

    for (int i = 0; i < threads; ++i) {
        numbers[i] = i;
        CHECK(pthread_create(&started[i], NULL, run, &numbers[i]) == 0);
    }
    for (int i = 0; i < threads; ++i)
        CHECK(pthread_join(started[i], NULL) == 0);
    for (int star = 0; star < stars; ++star)
        work(star, &alone[star]);
    for (int i = 0; i < threads; ++i)
        for (int star = 0; star < stars; ++star)
            check_same(&together[i][star], &alone[star]);

    check_scenes();
    wfpsf_ipc_kernel_destroy(shared_kernel);
    wfpsf_psf_destroy(shared_psf);
    wfpsf_instrument_destroy(instrument);
    return checked();
}
