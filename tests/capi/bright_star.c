/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stars whose light is drawn beyond the radius made in advance, within a limit of memory. */
#include "pixels.h"

#include <stdlib.h>

enum { side = 81 };

static int32_t stop(double part, void *user) {
    (void)user;
    return part > 0.4;
}

int main(void) {
    static double wide[side * side], narrow[side * side], added[side * side];
    const double star_x = 40.3, star_y = 39.8;
    int64_t least = -1, most = -1;
    wfpsf_instrument *c5 = NULL;
    wfpsf_options *options = NULL;
    wfpsf_psf *small = NULL, *large = NULL;
    wfpsf_image *image = wrap(narrow, side, side);
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-8));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 4));
    CHECK_OK(wfpsf_psf_create(c5, 7, 1292.11, options, &small));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 42));
    CHECK_OK(wfpsf_psf_create(c5, 7, 1292.11, options, &large));

    /* The same light, from a field that holds it and from strips in the least memory. */
    {
        wfpsf_image *whole = wrap(wide, side, side);
        CHECK_OK(wfpsf_psf_draw(large, star_x, star_y, 1, NULL, whole));
        CHECK_OK(wfpsf_psf_draw_memory(large, star_x, star_y, whole, &least, &most));
        CHECK(least == 0 && most == 0);
        wfpsf_image_destroy(whole);
    }
    CHECK_OK(wfpsf_psf_draw_memory(small, star_x, star_y, image, &least, &most));
    CHECK(least > 1000000 && most > least);
    CHECK_OK(wfpsf_psf_draw_memory(small, star_x, star_y, image, NULL, NULL));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_MEMORY_LIMIT, (double)least));
    CHECK_OK(wfpsf_psf_draw(small, star_x, star_y, 1, options, image));
    for (int p = 0; p < side * side; ++p)
        CHECK_NEAR(narrow[p], wide[p], 2e-8);
    check_record(image, 1, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE);

    /* Added to what is there; and refused when it needs too much, with nothing done. */
    fill(added, side * side, 7);
    {
        wfpsf_image *target = wrap(added, side, side);
        CHECK_OK(wfpsf_psf_add_bright_star(small, star_x, star_y, 3, options, target));
        for (int p = 0; p < side * side; ++p)
            CHECK_NEAR(added[p], 7 + 3 * narrow[p], 1e-13);
        check_record(target, 1, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE);
        memcpy(wide, added, sizeof wide);
        CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_MEMORY_LIMIT, 1e6));
        CHECK_FAILS(WFPSF_ERROR_MEMORY_LIMIT, "MEMORY_LIMIT = 1000000",
                    wfpsf_psf_add_bright_star(small, star_x, star_y, 3, options, target));
        CHECK(are_equal(added, wide, side * side));
        CHECK_OK(wfpsf_image_set_record(target, 1, 0.11, WFPSF_EFFECT_IPC));
        CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "interpixel",
                    wfpsf_psf_add_bright_star(small, 0, 0, 1, NULL, target));
        CHECK_OK(wfpsf_image_set_record(target, 1, 0.2, 0));
        CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "0.2",
                    wfpsf_psf_add_bright_star(small, 0, 0, 1, NULL, target));
        CHECK(are_equal(added, wide, side * side));
        wfpsf_image_destroy(target);
    }

    /* A field too large for the limit is not begun either. */
    {
        wfpsf_psf *psf = STALE(wfpsf_psf);
        CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, 512));
        CHECK_FAILS(WFPSF_ERROR_MEMORY_LIMIT, "field",
                    wfpsf_psf_create(c5, 7, 1292.11, options, &psf));
        CHECK(psf == NULL);
    }

    /* Told to stop on the way. */
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_MEMORY_LIMIT, (double)least));
    CHECK_OK(wfpsf_options_set_progress(options, stop, NULL));
    CHECK_FAILS(WFPSF_ERROR_CANCELLED, "stop",
                wfpsf_psf_draw(small, star_x, star_y, 1, options, image));

    CHECK_FAILS(WFPSF_ERROR_NULL, "psf", wfpsf_psf_add_bright_star(NULL, 0, 0, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_psf_add_bright_star(small, 0, 0, 1, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "flux",
                wfpsf_psf_add_bright_star(small, 0, 0, NAN, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "1e+06",
                wfpsf_psf_add_bright_star(small, 1e6, 0, 1, NULL, image));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "1e+06",
                wfpsf_psf_draw_memory(small, 1e6, 0, image, &least, &most));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_psf_draw_memory(small, 0, 0, NULL, NULL, NULL));
    wfpsf_image_destroy(image);
    wfpsf_psf_destroy(small);
    wfpsf_psf_destroy(large);
    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(c5);
    return checked();
}
