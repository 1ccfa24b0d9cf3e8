/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exposures in C99: a detector's file is made once, whole or not at all, with the same bits however
   the work is shared out. */
#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static wfpsf_instrument *roman;
static wfpsf_observation *observation;

/* Stars on detectors 7 and 8, and a galaxy. */
static wfpsf_catalogue *sky_catalogue(void) {
    wfpsf_catalogue *catalogue = NULL;
    CHECK_OK(
        wfpsf_catalogue_create(WFPSF_POSITIONS_SKY, WFPSF_BRIGHTNESS_AB_MAGNITUDE, &catalogue));
    for (int sca = 7; sca <= 8; ++sca) {
        const double x[] = {100.25, 2000, 4087.5}, y[] = {90, 2100.5, 4087.5};
        const double magnitude[] = {19, 22, 20};
        double ra[3], dec[3];
        CHECK_OK(wfpsf_observation_pixel_to_sky(observation, sca, 3, x, y, ra, dec, NULL));
        CHECK_OK(wfpsf_catalogue_add_stars(catalogue, 3, ra, dec, magnitude, NULL));
        const double index = 1, radius = 0.4;
        CHECK_OK(wfpsf_catalogue_add_galaxies(catalogue, 1, ra + 1, dec + 1, magnitude, NULL,
                                              &index, &radius, NULL, NULL));
    }
    return catalogue;
}

static int exists(const char *path) {
    struct stat status;
    return stat(path, &status) == 0;
}

/* All pixels of a file, which the caller frees. */
static float *pixels_of(const char *path) {
    wfpsf_image *image = NULL;
    float *copy = malloc(sizeof(float) * 4088 * 4088);
    wfpsf_image *into = NULL;
    CHECK(copy != NULL);
    CHECK_OK(wfpsf_image_read_fits(path, NULL, WFPSF_FLOAT32, &image));
    CHECK_OK(wfpsf_image_wrap(WFPSF_FLOAT32, copy, 4088, 4088, 1, 4088, 1, &into));
    CHECK_OK(wfpsf_image_copy(image, into));
    wfpsf_image_destroy(into);
    wfpsf_image_destroy(image);
    return copy;
}

static int32_t stop(double part, void *user) {
    (void)user;
    return part > 0.3;
}

static wfpsf_exposure *exposure_of(const wfpsf_catalogue *catalogue, const wfpsf_chain *chain,
                                   int64_t seed) {
    wfpsf_options *options = NULL;
    wfpsf_exposure *exposure = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_SCENE_NOISE, 0.1));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_SCENE_BACKGROUND, 50));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_SEED, seed));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_STREAM, 12));
    CHECK_OK(
        wfpsf_exposure_create(roman, observation, "H158", catalogue, chain, options, &exposure));
    wfpsf_options_destroy(options);
    return exposure;
}

/* IPC of 0.01 but for one pixel, whose alpha is another. */
static wfpsf_chain *varying_chain(float alpha) {
    float *map = malloc(sizeof(float) * 4088 * 4088);
    wfpsf_image *image = NULL;
    wfpsf_varying_ipc *ipc = NULL;
    wfpsf_chain *chain = NULL;
    CHECK(map != NULL);
    for (int64_t i = 0; i < 4088 * 4088; ++i)
        map[i] = 0.01f;
    map[2000 * 4088 + 3000] = alpha;
    CHECK_OK(wfpsf_image_wrap(WFPSF_FLOAT32, map, 4088, 4088, 1, 4088, 1, &image));
    CHECK_OK(wfpsf_varying_ipc_create_maps(image, NULL, NULL, NULL, &ipc));
    CHECK_OK(wfpsf_chain_create(&chain));
    CHECK_OK(wfpsf_chain_add_varying_ipc(chain, ipc, WFPSF_IPC_SCATTER, WFPSF_EDGE_ZERO));
    wfpsf_varying_ipc_destroy(ipc);
    wfpsf_image_destroy(image);
    free(map);
    return chain;
}

int main(void) {
    char folder[] = "/tmp/wfpsf_exposure_XXXXXX";
    CHECK(mkdtemp(folder) != NULL);
    CHECK_OK(wfpsf_instrument_create("roman-c9", &roman));
    CHECK_OK(wfpsf_observation_create(roman, 53.1, -27.8, 30, NULL, &observation));
    wfpsf_catalogue *catalogue = sky_catalogue();
    wfpsf_chain *chain = NULL;
    CHECK_OK(wfpsf_chain_create_default(roman, 139.8, &chain));
    wfpsf_exposure *exposure = exposure_of(catalogue, chain, 5);
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));

    char path[256];
    int64_t length = 0;
    CHECK_OK(wfpsf_exposure_path(exposure, folder, 7, sizeof path, path, &length));
    CHECK(strstr(path, "/exposure_00012_sca07.fits") != NULL && (int64_t)strlen(path) == length);

    /* A caller that stops leaves nothing behind. */
    int32_t made = -1;
    CHECK_OK(wfpsf_options_set_progress(options, stop, NULL));
    CHECK_STATUS(WFPSF_ERROR_CANCELLED, wfpsf_exposure_make(exposure, 7, folder, options, &made));
    CHECK(!exists(path) && made == 0);
    CHECK_OK(wfpsf_options_set_progress(options, NULL, NULL));

    /* Made once, whatever the number of threads of those who come later. */
    CHECK_OK(wfpsf_exposure_make(exposure, 7, folder, options, &made));
    CHECK(made == 1 && exists(path));
    float *first = pixels_of(path);
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_THREADS, 2));
    CHECK_OK(wfpsf_exposure_make(exposure, 7, folder, options, &made));
    CHECK(made == 0);

    /* Another exposure of the same name is not taken for it. */
    wfpsf_exposure *other = exposure_of(catalogue, chain, 6);
    CHECK_FAILS(WFPSF_ERROR_FILE_WRITE, "exposure_00012_sca07.fits",
                wfpsf_exposure_make(other, 7, folder, options, &made));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_FITS_OVERWRITE, 1));
    CHECK_OK(wfpsf_exposure_make(other, 7, folder, options, &made));
    float *second = pixels_of(path);
    CHECK(made == 1 && memcmp(first, second, sizeof(float) * 4088 * 4088) != 0);

    /* The first one again, by two threads: the same bits. */
    CHECK_OK(wfpsf_exposure_make(exposure, 7, folder, options, &made));
    free(second);
    second = pixels_of(path);
    CHECK(made == 1 && memcmp(first, second, sizeof(float) * 4088 * 4088) == 0);
    free(second);

    /* The galaxy and the star at (2000, 2100.5) shine above the background, and the corner's star
       is cut by the border. */
    CHECK(first[2100 * 4088 + 2000] > 1000);
    CHECK(first[4087 * 4088 + 4087] > 1000);
    CHECK(first[1000 * 4088 + 1000] < 200);

    /* Without a chain: means; the noise of the chain has gone. */
    wfpsf_exposure *means = exposure_of(catalogue, NULL, 5);
    CHECK_OK(wfpsf_exposure_make(means, 8, folder, options, &made));
    CHECK_OK(wfpsf_exposure_path(means, folder, 8, sizeof path, path, NULL));
    second = pixels_of(path);
    CHECK(made == 1);
    CHECK_NEAR((double)second[1000 * 4088 + 1000], 50, 0.1);
    free(second);
    CHECK(remove(path) == 0);

    /* Another varying IPC is another exposure, wherever on the detector it differs. */
    for (int k = 0; k < 2; ++k) {
        wfpsf_chain *varying = varying_chain(k == 0 ? 0.01f : 0.0101f);
        wfpsf_exposure *with_ipc = exposure_of(catalogue, varying, 5);
        if (k == 0) {
            CHECK_OK(wfpsf_exposure_make(with_ipc, 8, folder, options, &made));
            CHECK_OK(wfpsf_exposure_make(with_ipc, 8, folder, options, &made));
            CHECK(made == 0);
            CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_FITS_OVERWRITE, 0));
        } else {
            CHECK_FAILS(WFPSF_ERROR_FILE_WRITE, "exposure_00012_sca08.fits",
                        wfpsf_exposure_make(with_ipc, 8, folder, options, &made));
        }
        wfpsf_exposure_destroy(with_ipc);
        wfpsf_chain_destroy(varying);
    }
    CHECK(remove(path) == 0);

    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 19", wfpsf_exposure_make(means, 19, folder, NULL, NULL));
    CHECK_STATUS(WFPSF_ERROR_FILE_WRITE,
                 wfpsf_exposure_make(means, 8, "/nowhere/at/all", NULL, NULL));
    CHECK_STATUS(WFPSF_ERROR_NULL, wfpsf_exposure_make(means, 8, NULL, NULL, NULL));

    CHECK_OK(wfpsf_exposure_path(exposure, folder, 7, sizeof path, path, NULL));
    CHECK(remove(path) == 0 && rmdir(folder) == 0);
    free(first);
    wfpsf_exposure_destroy(means);
    wfpsf_exposure_destroy(other);
    wfpsf_exposure_destroy(exposure);
    wfpsf_options_destroy(options);
    wfpsf_chain_destroy(chain);
    wfpsf_catalogue_destroy(catalogue);
    wfpsf_observation_destroy(observation);
    wfpsf_instrument_destroy(roman);
    return checked();
}
