/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * golden CASES RESULTS
 *
 * Reads cases.txt, a header and a case a line, and writes a header and "case quantity value" lines:
 * a PSF, a star drawn from it, the star after IPC and noise, and what is measured on it. Its twins
 * in Fortran, Julia and Python do the same: tests compare the results bit for bit.
 */
#include <stdio.h>
#include <stdlib.h>

#include <wfpsf/wfpsf.h>

static void check(wfpsf_status status) {
    char line[1000];
    if (status == WFPSF_OK)
        return;
    wfpsf_last_error(line, sizeof line);
    fprintf(stderr, "%s\n", line);
    exit(1);
}

static FILE *open_file(const char *path, const char *mode) {
    FILE *file = fopen(path, mode);
    if (!file) {
        perror(path);
        exit(1);
    }
    return file;
}

typedef struct {
    char name[32], instrument[32], band[8];
    int sca, struts, nx, ny, oversampling;
    double x, y, wavelength_nm, star_x, star_y, flux, alpha, alpha_prime, alpha_plus, noise;
} golden_case;

static int read_case(FILE *file, golden_case *c) {
    return fscanf(file, "%31s %31s %7s %d %lf %lf %lf %d %d %d %d %lf %lf %lf %lf %lf %lf %lf",
                  c->name, c->instrument, c->band, &c->sca, &c->x, &c->y, &c->wavelength_nm,
                  &c->struts, &c->nx, &c->ny, &c->oversampling, &c->star_x, &c->star_y, &c->flux,
                  &c->alpha, &c->alpha_prime, &c->alpha_plus, &c->noise) == 18;
}

static void run(const golden_case *c, FILE *out) {
    wfpsf_instrument *instrument;
    wfpsf_options *options;
    wfpsf_psf *psf;
    wfpsf_image *star, *blurred;
    wfpsf_ipc_kernel *kernel;
    wfpsf_moments *moments;
    static const struct {
        const char *name;
        int32_t key;
    } measured[] = {{"sigma", WFPSF_MOMENTS_SIGMA},
                    {"e1", WFPSF_MOMENTS_E1},
                    {"e2", WFPSF_MOMENTS_E2},
                    {"flux", WFPSF_MOMENTS_FLUX},
                    {"rho4", WFPSF_MOMENTS_RHO4}};
    double value;
    double *pixels = calloc((size_t)(2 * c->nx * c->ny), sizeof *pixels);
    double *blurred_pixels = pixels + c->nx * c->ny;
    const int places[3] = {0, c->nx / 2 + c->ny / 2 * c->nx, c->nx * c->ny - 2};
    if (!pixels)
        exit(1);

    check(wfpsf_instrument_create(c->instrument, &instrument));
    check(wfpsf_options_create(&options));
    check(wfpsf_options_set_integer(options, WFPSF_OPTION_STRUTS, c->struts));
    check(wfpsf_options_set_integer(options, WFPSF_OPTION_SEED, 20150901));
    check(wfpsf_psf_create_in_band(instrument, c->band, c->sca, c->x, c->y, c->wavelength_nm,
                                   options, &psf));
    check(wfpsf_image_wrap(WFPSF_FLOAT64, pixels, c->nx, c->ny, 1, c->nx, c->oversampling, &star));
    check(wfpsf_image_wrap(WFPSF_FLOAT64, blurred_pixels, c->nx, c->ny, 1, c->nx, c->oversampling,
                           &blurred));
    check(wfpsf_ipc_kernel_create(c->alpha, c->alpha_prime, c->alpha_plus, options, &kernel));

    check(wfpsf_psf_get(psf, WFPSF_PSF_WAVELENGTH_NM, &value));
    fprintf(out, "%s wavelength_nm %.17g\n", c->name, value);
    check(wfpsf_psf_get(psf, WFPSF_PSF_PEAK, &value));
    fprintf(out, "%s peak %.17g\n", c->name, value);

    check(wfpsf_psf_draw(psf, c->star_x, c->star_y, c->flux, NULL, star));
    for (int i = 0; i < 3; ++i)
        fprintf(out, "%s drawn_%d %.17g\n", c->name, i, pixels[places[i]]);

    check(wfpsf_ipc_apply(kernel, star, WFPSF_EDGE_ZERO, NULL, blurred, NULL));
    for (int i = 0; i < 3; ++i)
        fprintf(out, "%s blurred_%d %.17g\n", c->name, i, blurred_pixels[places[i]]);

    check(wfpsf_size_ee_radius(blurred, c->star_x, c->star_y, 0.25, WFPSF_SIZE_PIXEL_INTERPOLATED,
                               NULL, &value, NULL));
    fprintf(out, "%s ee25 %.17g\n", c->name, value);
    check(wfpsf_moments_measure_unweighted(blurred, c->star_x, c->star_y, &moments));
    check(wfpsf_moments_get(moments, WFPSF_MOMENTS_MXX, &value));
    fprintf(out, "%s unweighted_mxx %.17g\n", c->name, value);
    wfpsf_moments_destroy(moments);

    check(wfpsf_moments_measure(blurred, NULL, &moments));
    for (size_t i = 0; i < sizeof measured / sizeof measured[0]; ++i) {
        check(wfpsf_moments_get(moments, measured[i].key, &value));
        fprintf(out, "%s %s %.17g\n", c->name, measured[i].name, value);
    }
    wfpsf_moments_destroy(moments);

    check(wfpsf_noise_add(blurred, c->noise, NULL, options));
    for (int i = 0; i < 3; ++i)
        fprintf(out, "%s noisy_%d %.17g\n", c->name, i, blurred_pixels[places[i]]);

    wfpsf_ipc_kernel_destroy(kernel);
    wfpsf_image_destroy(blurred);
    wfpsf_image_destroy(star);
    wfpsf_psf_destroy(psf);
    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(instrument);
    free(pixels);
}

int main(int argc, char **argv) {
    if (argc != 3) {
        fprintf(stderr, "usage: %s CASES RESULTS\n", argv[0]);
        return 1;
    }
    FILE *cases = open_file(argv[1], "r"), *out = open_file(argv[2], "w");
    golden_case c;
    fprintf(out, "case quantity value\n");
    if (fscanf(cases, "%*[^\n]") != 0) /* the header */
        return 1;
    while (read_case(cases, &c))
        run(&c, out);
    fclose(cases);
    return fclose(out) == 0 ? 0 : 1;
}
