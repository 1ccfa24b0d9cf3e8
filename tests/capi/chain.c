/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Detector chains, noise and the sky. */
#include "pixels.h"

static wfpsf_chain *default_chain(const char *name) {
    wfpsf_instrument *instrument = NULL;
    wfpsf_chain *chain = NULL;
    CHECK_OK(wfpsf_instrument_create(name, &instrument));
    CHECK_OK(wfpsf_chain_create_default(instrument, NAN, &chain));
    wfpsf_instrument_destroy(instrument);
    return chain;
}

static void test_steps(void) {
    static const int32_t wanted[] = {WFPSF_STEP_CLIP_NEGATIVE, WFPSF_STEP_POISSON_NOISE,
                                     WFPSF_STEP_QUANTISATION,  WFPSF_STEP_RECIPROCITY_FAILURE,
                                     WFPSF_STEP_DARK_CURRENT,  WFPSF_STEP_PERSISTENCE_FERMI,
                                     WFPSF_STEP_NONLINEARITY,  WFPSF_STEP_IPC,
                                     WFPSF_STEP_READ_NOISE,    WFPSF_STEP_GAIN,
                                     WFPSF_STEP_QUANTISATION,  0};
    wfpsf_chain *chain = default_chain("roman-c9");
    double parameters[3] = {0};
    int64_t count = -1;
    int32_t step = -1;
    for (int i = 0; i < 12; ++i) {
        CHECK_OK(wfpsf_chain_step(chain, i, 0, NULL, NULL, &step));
        CHECK(step == wanted[i]);
    }
    CHECK_OK(wfpsf_chain_step(chain, 3, 2, parameters, &count, &step));
    CHECK(count == 3 && parameters[0] == 0.0065 && parameters[1] == 139.8 && parameters[2] == 0);
    CHECK(strcmp(wfpsf_step_name(WFPSF_STEP_DARK_CURRENT), "dark_current") == 0);
    CHECK(wfpsf_step_name(11) == NULL);
    CHECK_FAILS(WFPSF_ERROR_RANGE, "index = -1", wfpsf_chain_step(chain, -1, 0, NULL, NULL, &step));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "capacity = -1",
                wfpsf_chain_step(chain, 0, -1, parameters, NULL, &step));
    CHECK_FAILS(WFPSF_ERROR_NULL, "parameters", wfpsf_chain_step(chain, 0, 1, NULL, NULL, &step));
    CHECK_FAILS(WFPSF_ERROR_NULL, "step", wfpsf_chain_step(chain, 0, 0, NULL, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "chain", wfpsf_chain_step(NULL, 0, 0, NULL, NULL, &step));
    wfpsf_chain_destroy(chain);
    wfpsf_chain_destroy(NULL);
}

static void test_bad_steps(void) {
    const double one = 1, nothing = 0, none = NAN;
    wfpsf_chain *chain = NULL, *stale = STALE(wfpsf_chain);
    wfpsf_ipc_kernel *kernel = NULL;
    double pixel = 1;
    wfpsf_image *image = wrap(&pixel, 1, 1);
    CHECK_OK(wfpsf_chain_create(&chain));
    CHECK_OK(wfpsf_ipc_kernel_create(0.02, 0, 0, NULL, &kernel));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "step = 11", wfpsf_chain_add(chain, 11, 0, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "ipc", wfpsf_chain_add(chain, WFPSF_STEP_IPC, 0, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = -1", wfpsf_chain_add(chain, WFPSF_STEP_GAIN, -1, &one));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = 0", wfpsf_chain_add(chain, WFPSF_STEP_GAIN, 0, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "parameters", wfpsf_chain_add(chain, WFPSF_STEP_GAIN, 1, NULL));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "parameters[0] = 0",
                wfpsf_chain_add(chain, WFPSF_STEP_GAIN, 1, &nothing));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "parameters[0] = nan",
                wfpsf_chain_add(chain, WFPSF_STEP_BACKGROUND, 1, &none));
    CHECK_FAILS(WFPSF_ERROR_NULL, "chain", wfpsf_chain_add(NULL, WFPSF_STEP_GAIN, 1, &one));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "edge = 4", wfpsf_chain_add_ipc(chain, kernel, 4));
    CHECK_FAILS(WFPSF_ERROR_NULL, "kernel", wfpsf_chain_add_ipc(chain, NULL, 0));
    CHECK_FAILS(WFPSF_ERROR_NULL, "map",
                wfpsf_chain_add_map(chain, WFPSF_STEP_CAPACITANCE_MAP, 0, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "gain",
                wfpsf_chain_add_map(chain, WFPSF_STEP_GAIN, 1, &one, image));
    CHECK_OK(wfpsf_chain_add(chain, WFPSF_STEP_GAIN, 1, &one));
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "gain",
                wfpsf_chain_add(chain, WFPSF_STEP_GAIN, 1, &one));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image",
                wfpsf_chain_apply(chain, NULL, 0, NULL, NULL, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "previous",
                wfpsf_chain_apply(chain, image, 1, NULL, NULL, NULL, NULL));
    const wfpsf_image *itself = image;
    CHECK_FAILS(WFPSF_ERROR_OVERLAP, "previous[0]",
                wfpsf_chain_apply(chain, image, 1, &itself, NULL, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument", wfpsf_chain_create_default(NULL, 1, &stale));
    CHECK(stale == NULL && pixel == 1);
    check_record(image, 1, 0, 0);
    wfpsf_image_destroy(image);
    wfpsf_ipc_kernel_destroy(kernel);
    wfpsf_chain_destroy(chain);
}

static wfpsf_options *seeded(int64_t seed, int64_t threads) {
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_SEED, seed));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_THREADS, threads));
    return options;
}

static void test_apply(void) {
    double first[600], second[600], third[600];
    fill(first, 600, 1000), fill(second, 600, 1000), fill(third, 600, 1000);
    wfpsf_image *one = wrap(first, 30, 20), *two = wrap(second, 30, 20),
                *three = wrap(third, 30, 20);
    wfpsf_options *serial = seeded(5, 1), *threaded = seeded(5, 3), *other = seeded(6, 1);
    wfpsf_chain *chain = default_chain("wfirst-afta-c5");
    int64_t not_finite = -1, saturated = -1;
    CHECK_OK(wfpsf_chain_apply(chain, one, 0, NULL, serial, &not_finite, &saturated));
    CHECK_OK(wfpsf_chain_apply(chain, two, 0, NULL, threaded, NULL, NULL));
    CHECK_OK(wfpsf_chain_apply(chain, three, 0, NULL, other, NULL, NULL));
    CHECK(are_equal(first, second, 600) && !are_equal(first, third, 600));
    CHECK(not_finite == 0 && saturated == 0);
    check_record(one, 1, 0,
                 WFPSF_EFFECT_POISSON_NOISE + WFPSF_EFFECT_RECIPROCITY_FAILURE +
                     WFPSF_EFFECT_DARK_CURRENT + WFPSF_EFFECT_NONLINEARITY + WFPSF_EFFECT_IPC +
                     WFPSF_EFFECT_READ_NOISE + WFPSF_EFFECT_GAIN);
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "Poisson noise",
                wfpsf_chain_apply(chain, one, 0, NULL, serial, NULL, NULL));
    CHECK(are_equal(first, second, 600));
    wfpsf_options_destroy(serial);
    wfpsf_options_destroy(threaded);
    wfpsf_options_destroy(other);
    wfpsf_chain_destroy(chain);
    wfpsf_image_destroy(one);
    wfpsf_image_destroy(two);
    wfpsf_image_destroy(three);
}

static void test_noise(void) {
    double white[400] = {0}, again[400] = {0};
    wfpsf_image *one = wrap(white, 20, 20), *two = wrap(again, 20, 20);
    wfpsf_ipc_kernel *kernel = NULL;
    CHECK_OK(wfpsf_ipc_kernel_create(0.02, 0, 0, NULL, &kernel));
    CHECK_OK(wfpsf_noise_add(one, 2, NULL, NULL));
    CHECK_OK(wfpsf_noise_add(two, 2, kernel, NULL));
    /* away from the border the correlated noise is the white noise through the kernel */
    CHECK_NEAR(again[210],
               0.92 * white[210] + 0.02 * (white[209] + white[211] + white[190] + white[230]),
               1e-14);
    CHECK_FAILS(WFPSF_ERROR_RANGE, "rms = -1", wfpsf_noise_add(one, -1, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "rms = nan", wfpsf_noise_add(one, NAN, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_noise_add(NULL, 1, NULL, NULL));
    wfpsf_ipc_kernel_destroy(kernel);
    wfpsf_image_destroy(one);
    wfpsf_image_destroy(two);
}

static void test_sky(void) {
    wfpsf_instrument *roman = NULL;
    double level = 7, electrons = 7;
    CHECK_OK(wfpsf_instrument_create("roman-c9", &roman));
    CHECK_OK(wfpsf_sky_level(roman, "F184", 90, 30, &level));
    CHECK_OK(wfpsf_sky_background(roman, "F184", -90, -30, 100, 0.01, &electrons));
    CHECK_NEAR(electrons, 100 * (1.1 * 0.01 * level + 0.17), 1e-12 * electrons);
    CHECK_OK(wfpsf_sky_level(roman, "F184", 180, 90, &level));
    CHECK_NEAR(level, 16.0572, 1e-12);
    CHECK_FAILS(WFPSF_ERROR_SKY_SUN, "longitude = 3", wfpsf_sky_level(roman, "F184", 3, 0, &level));
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "X184", wfpsf_sky_level(roman, "X184", 90, 0, &level));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "latitude = 91", wfpsf_sky_level(roman, "F184", 90, 91, &level));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "longitude = nan",
                wfpsf_sky_level(roman, "F184", NAN, 0, &level));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "exposure_time = -1",
                wfpsf_sky_background(roman, "F184", 90, 0, -1, 1, &electrons));
    CHECK_FAILS(WFPSF_ERROR_NULL, "electrons",
                wfpsf_sky_background(roman, "F184", 90, 0, 1, 1, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument", wfpsf_sky_level(NULL, "F184", 90, 0, &level));
    CHECK_NEAR(level, 16.0572, 1e-12);
    wfpsf_instrument_destroy(roman);
}

int main(void) {
    test_steps();
    test_bad_steps();
    test_apply();
    test_noise();
    test_sky();
    return checked();
}
