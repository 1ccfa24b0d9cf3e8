/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A user's program: a Roman star through IPC, its size; in C, C++ and Fortran with the same output.
   Fails unless the library that is loaded has the version given as the argument. */
#include <stdio.h>
#include <string.h>

#include <wfpsf/wfpsf.h>

static void check(wfpsf_status status) {
    char line[256];
    if (status == WFPSF_OK)
        return;
    wfpsf_last_error(line, sizeof line);
    fprintf(stderr, "%s\n", line);
}

int main(int argc, char **argv) {
    static double pixels[64 * 64];
    double sigma = 0;
    wfpsf_instrument *roman;
    wfpsf_psf *psf;
    wfpsf_ipc_kernel *kernel;
    wfpsf_image *image;
    wfpsf_moments *moments;
    if (argc != 2 || strcmp(argv[1], wfpsf_version()) != 0 || wfpsf_check_version() != WFPSF_OK)
        return 1;
    check(wfpsf_instrument_create("roman-c9", &roman));
    check(wfpsf_psf_create_in_band(roman, "H158", 4, 1000, 2000, 0, NULL, &psf));
    check(wfpsf_image_wrap(WFPSF_FLOAT64, pixels, 64, 64, 1, 64, 4, &image));
    check(wfpsf_psf_draw(psf, 31.2, 32.1, 1000, NULL, image));
    check(wfpsf_ipc_kernel_create_default(roman, &kernel));
    check(wfpsf_ipc_apply(kernel, image, WFPSF_EDGE_ZERO, NULL, image, NULL));
    check(wfpsf_moments_measure(image, NULL, &moments));
    check(wfpsf_moments_get(moments, WFPSF_MOMENTS_SIGMA, &sigma));
    printf("sigma = %.9f\n", sigma);
    wfpsf_moments_destroy(moments);
    wfpsf_ipc_kernel_destroy(kernel);
    wfpsf_image_destroy(image);
    wfpsf_psf_destroy(psf);
    wfpsf_instrument_destroy(roman);
    return 0;
}
