/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Size, shape and half-light radius of the WFIRST-AFTA C5 PSF before and after interpixel
 * capacitance, beside Table 2 of Kannawadi et al. 2016, and the six PSFs of its Figure 2.
 *
 * usage: main_job [output folder]
 *
 * Writes table_sizes.csv, psf_<BAND>.fits and, where libgd was there at build time, gallery.png.
 */
#define _POSIX_C_SOURCE 200809L /* mkdir, isatty, clock_gettime */

#ifdef MAIN_JOB_WITH_GALLERY
#include "gallery.h"
#endif

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <wfpsf/wfpsf.h>

/* The paper's stamp: 16 x 16 native pixels in steps of 1/32 pixel, the star at the centre. */
enum { SCA = 7, NATIVE_SIDE = 16, OVERSAMPLING = 32, SIDE = NATIVE_SIDE * OVERSAMPLING };
static const double centre = (SIDE - 1) / 2.0;

/* The field whose light counts as all of it for EE50, as in the paper: 32 x 32 native pixels. */
enum { FIELD_SIDE = 32, FIELD_SAMPLING = 4, FIELD = FIELD_SIDE * FIELD_SAMPLING };

enum quantity { SIGMA, E1, E2, E, EE50_CENTROID, EE50_AXIS, QUANTITIES };
static const struct {
    const char *in_csv, *in_table, *unit;
} quantities[QUANTITIES] = {{"sigma", "sigma", "mas"},
                            {"e1", "e1", "1"},
                            {"e2", "e2", "1"},
                            {"e", "|e|", "1"},
                            {"ee50_centroid", "EE50 about centroid", "mas"},
                            {"ee50_axis", "EE50 about axis", "mas"}};

/* Table 2 of the paper, [struts]; it gives no more digits than these. */
static const struct {
    const char *band, *sigma[2], *hlr[2], *e[2];
} paper_table[] = {{"J129", {"60.480", "61.50"}, {"95.06", "114.85"}, {"0.0652", "0.0646"}},
                   {"H158", {"65.884", "66.16"}, {"103.85", "123.72"}, {"0.0417", "0.0379"}},
                   {"F184", {"72.452", "72.39"}, {"113.21", "132.37"}, {"0.0292", "0.0246"}}};
enum { TABLE_BANDS = sizeof paper_table / sizeof paper_table[0] };

struct measurement {
    double value[QUANTITIES], error[QUANTITIES], moments_ms, ee50_ms;
};

struct table_row {
    const char *band, *paper[QUANTITIES]; /* paper: NULL where it prints nothing */
    int struts;
    double nodes, grid, error, model_error, psf_ms, draw_ms, ipc_ms;
    struct measurement optics, with_ipc;
};

/* One line on a terminal, overwritten by the next; empty texts wipe it. */
static void progress(const char *band, const char *step) {
    if (isatty(STDERR_FILENO))
        fprintf(stderr, "\r\033[K%s%s", band, step);
}

static void fail_with_file(const char *path) {
    fprintf(stderr, "main_job: %s: %s\n", path, strerror(errno));
    exit(1);
}

/* Ends the program on an error; a warning comes with a valid result, so it is only told. */
static void check(wfpsf_status status) {
    char line[1024];
    if (status == WFPSF_OK)
        return;
    progress("", "");
    wfpsf_last_error(line, sizeof line);
    if (status > 0) {
        printf("%s: %s\n", wfpsf_status_name(status), line);
        return;
    }
    fprintf(stderr, "main_job: %s: %s\n", wfpsf_status_name(status), line);
    exit(1);
}

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static double psf_property(const wfpsf_psf *psf, int32_t key) {
    double value;
    check(wfpsf_psf_get(psf, key, &value));
    return value;
}

static double moment(const wfpsf_moments *moments, int32_t key) {
    double value;
    check(wfpsf_moments_get(moments, key, &value));
    return value;
}

static double effective_wavelength_nm(const wfpsf_instrument *instrument, const char *band) {
    double nm;
    check(wfpsf_instrument_band(instrument, band, WFPSF_BAND_PAPER, NULL, NULL, &nm));
    return nm;
}

/* The light of a star of unit flux that falls on the field around it. */
static double field_flux(const wfpsf_psf *psf) {
    static double pixels[FIELD * FIELD];
    wfpsf_image *field;
    check(wfpsf_image_wrap(WFPSF_FLOAT64, pixels, FIELD, FIELD, 1, FIELD, FIELD_SAMPLING, &field));
    check(wfpsf_psf_draw(psf, (FIELD - 1) / 2.0, (FIELD - 1) / 2.0, 1, NULL, field));
    wfpsf_image_destroy(field);
    double sum = 0;
    for (int i = 0; i < FIELD * FIELD; ++i)
        sum += pixels[i];
    return sum;
}

static void measure_ee50(const wfpsf_image *image, double x, double y, const wfpsf_options *options,
                         double mas_per_sample, double psf_error, double *value, double *error) {
    double radius, radius_error;
    check(wfpsf_size_ee_radius(image, x, y, 0.5, WFPSF_SIZE_BANDLIMITED, options, &radius,
                               &radius_error));
    *value = radius * mas_per_sample;
    *error = radius_error * mas_per_sample + *value * 2 * psf_error;
}

/*
 * The errors are numerical ones: that of the measurement and that of the PSF's pixels. How well
 * the pupil's geometry fits the published mask is another matter: WFPSF_PSF_MODEL_ERROR.
 */
static struct measurement measure(const wfpsf_image *image, const wfpsf_options *options,
                                  double mas_per_sample, double psf_error) {
    struct measurement m;
    wfpsf_moments *moments;

    double start = now_ms();
    check(wfpsf_moments_measure(image, options, &moments));
    m.moments_ms = now_ms() - start;

    const double error = moment(moments, WFPSF_MOMENTS_ERROR_ESTIMATE) / 2 + 2 * psf_error;
    m.value[SIGMA] = moment(moments, WFPSF_MOMENTS_SIGMA) * mas_per_sample;
    m.value[E1] = moment(moments, WFPSF_MOMENTS_E1);
    m.value[E2] = moment(moments, WFPSF_MOMENTS_E2);
    m.value[E] = moment(moments, WFPSF_MOMENTS_E);
    m.error[SIGMA] = m.value[SIGMA] * error;
    m.error[E1] = m.error[E2] = m.error[E] = 2 * error;

    start = now_ms();
    measure_ee50(image, moment(moments, WFPSF_MOMENTS_CENTROID_X),
                 moment(moments, WFPSF_MOMENTS_CENTROID_Y), options, mas_per_sample, psf_error,
                 &m.value[EE50_CENTROID], &m.error[EE50_CENTROID]);
    measure_ee50(image, centre, centre, options, mas_per_sample, psf_error, &m.value[EE50_AXIS],
                 &m.error[EE50_AXIS]);
    m.ee50_ms = now_ms() - start;

    wfpsf_moments_destroy(moments);
    return m;
}

static struct table_row make_row(const wfpsf_instrument *instrument, int band, int struts,
                                 wfpsf_options *options) {
    struct table_row row = {.band = paper_table[band].band, .struts = struts};
    row.paper[SIGMA] = paper_table[band].sigma[struts];
    row.paper[E] = paper_table[band].e[struts];
    row.paper[EE50_CENTROID] = paper_table[band].hlr[struts];

    const double wavelength_nm = effective_wavelength_nm(instrument, row.band);
    double pixel_arcsec;
    check(wfpsf_instrument_constant(instrument, "pixel_scale", &pixel_arcsec, NULL));
    const double mas_per_sample = 1000 * pixel_arcsec / OVERSAMPLING;
    check(wfpsf_options_set_integer(options, WFPSF_OPTION_STRUTS, struts));
    check(wfpsf_options_set_real(options, WFPSF_OPTION_MOMENTS_GUESS_SIGMA,
                                 0.55 * OVERSAMPLING * wavelength_nm / 1292));

    wfpsf_psf *psf;
    progress(row.band, ": PSF");
    double start = now_ms();
    check(wfpsf_psf_create(instrument, SCA, wavelength_nm, options, &psf));
    row.psf_ms = now_ms() - start;
    row.nodes = psf_property(psf, WFPSF_PSF_NODES);
    row.grid = psf_property(psf, WFPSF_PSF_GRID_SIZE);
    row.error = psf_property(psf, WFPSF_PSF_ERROR_ESTIMATE);
    row.model_error = psf_property(psf, WFPSF_PSF_MODEL_ERROR);

    check(wfpsf_options_set_real(options, WFPSF_OPTION_SIZE_TOTAL_FLUX, field_flux(psf)));

    wfpsf_image *optics, *with_ipc;
    check(wfpsf_image_create(WFPSF_FLOAT64, SIDE, SIDE, OVERSAMPLING, &optics));
    check(wfpsf_image_create(WFPSF_FLOAT64, SIDE, SIDE, OVERSAMPLING, &with_ipc));
    start = now_ms();
    check(wfpsf_psf_draw(psf, centre, centre, 1, NULL, optics));
    row.draw_ms = now_ms() - start;

    progress(row.band, ": moments and EE50");
    row.optics = measure(optics, options, mas_per_sample, row.error);

    progress(row.band, ": IPC");
    wfpsf_ipc_kernel *kernel;
    check(wfpsf_ipc_kernel_create(0.02, 0.002, 0, options, &kernel));
    start = now_ms();
    check(wfpsf_ipc_apply(kernel, optics, WFPSF_EDGE_ZERO, options, with_ipc, NULL));
    row.ipc_ms = now_ms() - start;
    row.with_ipc = measure(with_ipc, options, mas_per_sample, row.error);
    progress("", "");

    wfpsf_ipc_kernel_destroy(kernel);
    wfpsf_image_destroy(with_ipc);
    wfpsf_image_destroy(optics);
    wfpsf_psf_destroy(psf);
    return row;
}

/* Lengths differ by per cent, ellipticities by absolute numbers. */
static void print_change(enum quantity q, double from, double to) {
    if (strcmp(quantities[q].unit, "mas") == 0)
        printf("  %+8.3f %%", 100 * (to / from - 1));
    else
        printf("  %+10.6f", to - from);
}

static void print_table(const struct table_row *rows) {
    printf("WFIRST-AFTA C5, SCA %d, %s struts; IPC: alpha 0.02, alpha' 0.002\n\n", SCA,
           rows[0].struts ? "with" : "without");
    printf("band  quantity             unit   this work  error est.   paper  difference"
           "    with IPC  error est.      change\n");
    for (int band = 0; band < TABLE_BANDS; ++band) {
        const struct table_row *row = &rows[band];
        for (enum quantity q = 0; q < QUANTITIES; ++q) {
            const int digits = strcmp(quantities[q].unit, "mas") == 0 ? 5 : 8;
            printf("%-4s  %-19s  %-4s  %10.*f  %10.1e", row->band, quantities[q].in_table,
                   quantities[q].unit, digits, row->optics.value[q], row->optics.error[q]);
            if (row->paper[q]) {
                printf("  %6s", row->paper[q]);
                print_change(q, strtod(row->paper[q], NULL), row->optics.value[q]);
            } else {
                printf("  %6s  %10s", "", "");
            }
            printf("  %10.*f  %10.1e", digits, row->with_ipc.value[q], row->with_ipc.error[q]);
            print_change(q, row->optics.value[q], row->with_ipc.value[q]);
            printf("\n");
        }
    }
    printf("\nPSF   nodes   grid  error est.  pupil model error"
           "      ms: PSF   draw  moments   EE50    IPC  moments   EE50\n");
    for (int band = 0; band < TABLE_BANDS; ++band) {
        const struct table_row *row = &rows[band];
        printf("%-4s  %5.0f  %5.0f  %10.1e  %17.1e  %11.2f  %5.2f  %7.2f  %5.2f  %5.2f  %7.2f"
               "  %5.2f\n",
               row->band, row->nodes, row->grid, row->error, row->model_error, row->psf_ms,
               row->draw_ms, row->optics.moments_ms, row->optics.ee50_ms, row->ipc_ms,
               row->with_ipc.moments_ms, row->with_ipc.ee50_ms);
    }
    printf("\n");
}

static void path_in(const char *folder, const char *name, const char *ending, char path[4096]) {
    if (snprintf(path, 4096, "%s/%s%s", folder, name, ending) >= 4096) {
        errno = ENAMETOOLONG;
        fail_with_file(folder);
    }
}

static void write_csv(const char *folder, const struct table_row *rows, int count) {
    char path[4096];
    path_in(folder, "table_sizes", ".csv", path);
    FILE *file = fopen(path, "w");
    if (!file)
        fail_with_file(path);
    fprintf(file, "band,struts,ipc,quantity,unit,paper,value,error_estimate\n");
    for (const struct table_row *row = rows; row < rows + count; ++row)
        for (int ipc = 0; ipc <= 1; ++ipc) {
            const struct measurement *m = ipc ? &row->with_ipc : &row->optics;
            for (enum quantity q = 0; q < QUANTITIES; ++q)
                fprintf(file, "%s,%d,%d,%s,%s,%s,%.17g,%.17g\n", row->band, row->struts, ipc,
                        quantities[q].in_csv, quantities[q].unit,
                        !ipc && row->paper[q] ? row->paper[q] : "", m->value[q], m->error[q]);
        }
    const int bad = ferror(file);
    if (fclose(file) != 0 || bad)
        fail_with_file(path);
}

/* Figure 2 of the paper: the monochromatic PSFs of six bands, as FITS files and as a picture. */
static void draw_figure(const char *folder, const wfpsf_instrument *instrument,
                        wfpsf_options *options) {
    static const char *const bands[] = {"Z087", "Y106", "J129", "W149", "H158", "F184"};
    enum { BANDS = sizeof bands / sizeof bands[0] };
    char path[4096];
    double *pixels = malloc((size_t)BANDS * SIDE * SIDE * sizeof *pixels);
    if (!pixels)
        fail_with_file("the six stamps");
    check(wfpsf_options_set_integer(options, WFPSF_OPTION_STRUTS, 1));

    double wavelength_nm[BANDS];
    for (int i = 0; i < BANDS; ++i) {
        wfpsf_psf *psf;
        wfpsf_image *image;
        char name[16];
        progress(bands[i], ": PSF");
        wavelength_nm[i] = effective_wavelength_nm(instrument, bands[i]);
        check(wfpsf_psf_create(instrument, SCA, wavelength_nm[i], options, &psf));
        check(wfpsf_image_wrap(WFPSF_FLOAT64, pixels + (size_t)i * SIDE * SIDE, SIDE, SIDE, 1, SIDE,
                               OVERSAMPLING, &image));
        check(wfpsf_psf_draw(psf, centre, centre, 1, NULL, image));
        snprintf(name, sizeof name, "psf_%s", bands[i]);
        path_in(folder, name, ".fits", path);
        check(wfpsf_image_write_fits(image, path, options));
        wfpsf_image_destroy(image);
        wfpsf_psf_destroy(psf);
    }
    progress("", "");

#ifdef MAIN_JOB_WITH_GALLERY
    double pixel_arcsec;
    check(wfpsf_instrument_constant(instrument, "pixel_scale", &pixel_arcsec, NULL));
    struct gallery_panel panels[BANDS];
    for (int i = 0; i < BANDS; ++i)
        panels[i] =
            (struct gallery_panel){bands[i], wavelength_nm[i], pixels + (size_t)i * SIDE * SIDE};
    path_in(folder, "gallery", ".png", path);
    if (gallery_write(path, panels, SIDE, NATIVE_SIDE * pixel_arcsec) != 0)
        fail_with_file(path);
#else
    printf("gallery.png left out: this program was built without libgd\n");
#endif
    free(pixels);
}

int main(int argc, char **argv) {
    if (argc > 2) {
        fprintf(stderr, "usage: %s [output folder]\n", argv[0]);
        return 1;
    }
    const char *folder = argc == 2 ? argv[1] : "out";
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        fail_with_file(folder);

    wfpsf_instrument *instrument;
    wfpsf_options *options;
    check(wfpsf_check_version());
    check(wfpsf_instrument_create("wfirst-afta-c5", &instrument));
    check(wfpsf_options_create(&options));
    check(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-7));
    check(wfpsf_options_set_real(options, WFPSF_OPTION_PSF_RADIUS, FIELD_SIDE / 2));
    check(wfpsf_options_set_real(options, WFPSF_OPTION_MOMENTS_TOLERANCE, 1e-10));
    check(wfpsf_options_set_real(options, WFPSF_OPTION_MOMENTS_GUESS_X, centre));
    check(wfpsf_options_set_real(options, WFPSF_OPTION_MOMENTS_GUESS_Y, centre));
    check(wfpsf_options_set_integer(options, WFPSF_OPTION_FITS_OVERWRITE, 1));

    struct table_row rows[2 * TABLE_BANDS];
    int count = 0;
    for (int struts = 1; struts >= 0; --struts) {
        for (int band = 0; band < TABLE_BANDS; ++band)
            rows[count++] = make_row(instrument, band, struts, options);
        print_table(rows + count - TABLE_BANDS);
    }
    printf(
        "Differences and changes: per cent of the paper's figure, or of the one without IPC;\n"
        "absolute for ellipticities. EE50: half of the star's light on 32 x 32 native pixels.\n"
        "Errors are numerical, for a PSF in units of its peak; the pupil model's error is apart\n"
        "from them.\n");
    write_csv(folder, rows, count);
    draw_figure(folder, instrument, options);

    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(instrument);
    if (fclose(stdout) != 0)
        fail_with_file("standard output");
    return 0;
}
