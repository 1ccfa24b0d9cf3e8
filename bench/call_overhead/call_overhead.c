/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a call costs, in nanoseconds: the least mean of 20 rounds. Its twins in Fortran, Julia and
 * Python make the same calls by their comfortable layers; the differences are what those add.
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <wfpsf/wfpsf.h>

enum { ROUNDS = 20, SIDE = 24 };

static wfpsf_psf *psf;
static wfpsf_image *image, *star;
static const int32_t keys[] = {
#define KEY(name, key, text) WFPSF_MOMENTS_##name,
    WFPSF_MOMENTS_PROPERTY_LIST(KEY)
#undef KEY
};

static void check(wfpsf_status status) {
    if (status < 0)
        abort();
}

static void property(void) {
    double value;
    check(wfpsf_psf_get(psf, WFPSF_PSF_PEAK, &value));
}

static void add_star(void) {
    const double x = 11.25, y = 12.5, flux = 1;
    check(wfpsf_psf_add_stars(psf, 1, &x, &y, &flux, NULL, image));
}

static void draw(void) {
    check(wfpsf_psf_draw(psf, 11.25, 12.5, 1, NULL, image));
}

static void moments(void) {
    wfpsf_moments *found;
    double value;
    check(wfpsf_moments_measure(star, NULL, &found));
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; ++i)
        check(wfpsf_moments_get(found, keys[i], &value));
    wfpsf_moments_destroy(found);
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static void measure(const char *name, void (*call)(void), int calls) {
    double least = 1e300;
    for (int round = 0; round < ROUNDS; ++round) {
        const double start = now();
        for (int i = 0; i < calls; ++i)
            call();
        const double mean = (now() - start) / calls;
        least = mean < least ? mean : least;
    }
    printf("C        %-10s %10.0f ns\n", name, least);
}

int main(void) {
    wfpsf_instrument *instrument;
    check(wfpsf_instrument_create("wfirst-afta-c5", &instrument));
    check(wfpsf_psf_create(instrument, 7, 1292, NULL, &psf));
    check(wfpsf_image_create(WFPSF_FLOAT64, SIDE, SIDE, 1, &image));
    check(wfpsf_image_create(WFPSF_FLOAT64, SIDE, SIDE, 4, &star));
    check(wfpsf_psf_draw(psf, 11.25, 12.5, 1, NULL, star));
    measure("property", property, 100000);
    measure("add_star", add_star, 2000);
    measure("draw", draw, 2000);
    measure("moments", moments, 2000);
    wfpsf_image_destroy(star);
    wfpsf_image_destroy(image);
    wfpsf_psf_destroy(psf);
    wfpsf_instrument_destroy(instrument);
    return 0;
}
