/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A star of Roman, before and after interpixel capacitance: its size, its shape and their errors. */
#include <stdio.h>
#include <stdlib.h>

#include <wfpsf/wfpsf.h>

enum { SIDE = 128, SAMPLES = 4 }; /* 32 x 32 native pixels, 4 x 4 samples in each */

static void check(wfpsf_status status) {
    char line[256];
    if (status == WFPSF_OK)
        return;
    wfpsf_last_error(line, sizeof line);
    fprintf(stderr, "%s: %s\n", wfpsf_status_name(status), line);
    if (status < 0) /* a positive status is a warning: the result is valid */
        exit(1);
}

static void measure(const char *what, const wfpsf_image *image, double mas, double psf_error) {
    wfpsf_moments *moments;
    double sigma, e1, e2, error;
    check(wfpsf_moments_measure(image, NULL, &moments));
    check(wfpsf_moments_get(moments, WFPSF_MOMENTS_SIGMA, &sigma));
    check(wfpsf_moments_get(moments, WFPSF_MOMENTS_E1, &e1));
    check(wfpsf_moments_get(moments, WFPSF_MOMENTS_E2, &e2));
    check(wfpsf_moments_get(moments, WFPSF_MOMENTS_ERROR_ESTIMATE, &error));
    wfpsf_moments_destroy(moments);
    error = error / 2 + 2 * psf_error; /* of the measurement and of the PSF, relative */
    printf("%-8s sigma %10.6f mas, e1 %9.6f, e2 %9.6f, error of sigma %8.6f mas\n", what,
           sigma * mas, e1, e2, sigma * mas * error);
}

int main(void) {
    static double pixels[SIDE * SIDE];
    wfpsf_instrument *roman;
    wfpsf_psf *psf;
    wfpsf_image *star;
    wfpsf_ipc_kernel *kernel;
    double psf_error, model_error, pixel_arcsec;

    check(wfpsf_check_version());
    check(wfpsf_instrument_create("roman-c9", &roman));
    check(wfpsf_instrument_constant(roman, "pixel_scale", &pixel_arcsec, NULL));

    /* The PSF in the middle of detector 7, at the band's effective wavelength. */
    check(wfpsf_psf_create_in_band(roman, "H158", 7, 2043.5, 2043.5, 0, NULL, &psf));
    check(wfpsf_psf_get(psf, WFPSF_PSF_ERROR_ESTIMATE, &psf_error));
    check(wfpsf_psf_get(psf, WFPSF_PSF_MODEL_ERROR, &model_error));

    /* A star in the middle of an image on our own memory, the first pixel's centre at (0, 0). */
    check(wfpsf_image_wrap(WFPSF_FLOAT64, pixels, SIDE, SIDE, 1, SIDE, SAMPLES, &star));
    check(wfpsf_psf_draw(psf, (SIDE - 1) / 2.0, (SIDE - 1) / 2.0, 1, NULL, star));
    measure("optics", star, 1000 * pixel_arcsec / SAMPLES, psf_error);

    /* alpha = 0.02, alpha' = 0.002, alpha+ = 0, in place. */
    check(wfpsf_ipc_kernel_create(0.02, 0.002, 0, NULL, &kernel));
    check(wfpsf_ipc_apply(kernel, star, WFPSF_EDGE_ZERO, NULL, star, NULL));
    measure("with IPC", star, 1000 * pixel_arcsec / SAMPLES, psf_error);

    printf("any pixel of the PSF: within %8.6f %% of the peak; its pupil's outline: %8.6f %%\n",
           100 * psf_error, 100 * model_error);

    wfpsf_ipc_kernel_destroy(kernel);
    wfpsf_image_destroy(star);
    wfpsf_psf_destroy(psf);
    wfpsf_instrument_destroy(roman);
    return 0;
}
