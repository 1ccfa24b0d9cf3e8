/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Kannawadi et al. 2016 in one call: prints its tables beside these values and what errors of the
 * IPC the mission can bear, and writes all tables and the grids of its figures as CSV. Where libgd
 * was there at build time, figure_NN.png are the figures' contours.
 *
 * usage: study [output folder [SCA]]
 */
#define _POSIX_C_SOURCE 200809L /* mkdir, clock_gettime */

#ifdef STUDY_WITH_CONTOURS
#include "contours.h"
#endif

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include <wfpsf/wfpsf.h>

static void check(wfpsf_status status) {
    char line[1024];
    if (status >= WFPSF_OK)
        return;
    wfpsf_last_error(line, sizeof line);
    fprintf(stderr, "study: %s: %s\n", wfpsf_status_name(status), line);
    exit(1);
}

static double now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double number(const wfpsf_study *study, int32_t table, int64_t row, int64_t column) {
    double value;
    check(wfpsf_study_value(study, table, row, column, &value));
    return value;
}

/* A whole table: words as they are, numbers to six digits, nothing where nothing is known. */
static void print_table(const wfpsf_study *study, int32_t table, const char *title) {
    int64_t rows, columns;
    check(wfpsf_study_size(study, table, &rows, &columns));
    printf("%s\n", title);
    for (int64_t row = -1; row < rows; ++row) {
        for (int64_t c = 0; c < columns; ++c) {
            const char *name = wfpsf_study_column(study, table, c);
            const char *words = row < 0 ? name : wfpsf_study_text(study, table, row, c);
            const int width = (int)strlen(name) > 13 ? (int)strlen(name) : 13;
            const char *between = c == 0 ? "" : "  ";
            if (words)
                printf("%s%-*s", between, width, words);
            else if (isnan(number(study, table, row, c)))
                printf("%s%*s", between, width, "");
            else
                printf("%s%*.6g", between, width, number(study, table, row, c));
        }
        printf("\n");
    }
    printf("\n");
}

#ifdef STUDY_WITH_CONTOURS
/* A figure as the study holds it: columns x and y and one for each of three bands. */
static void draw_figure(const wfpsf_study *study, const char *folder, int32_t table,
                        const char *file, const char *title) {
    enum { SIDE = 11, POINTS = SIDE * SIDE };
    static double columns[2 + CONTOURS_PANELS][POINTS];
    int64_t rows, count;
    check(wfpsf_study_size(study, table, &rows, &count));
    if (rows != POINTS || count != 2 + CONTOURS_PANELS)
        return;
    for (int c = 0; c < 2 + CONTOURS_PANELS; ++c)
        for (int row = 0; row < POINTS; ++row)
            columns[c][row] = number(study, table, row, c);
    const char *names[CONTOURS_PANELS];
    const double *values[CONTOURS_PANELS];
    double y[SIDE];
    for (int j = 0; j < SIDE; ++j)
        y[j] = columns[1][j * SIDE];
    for (int panel = 0; panel < CONTOURS_PANELS; ++panel) {
        names[panel] = wfpsf_study_column(study, table, 2 + panel);
        values[panel] = columns[2 + panel];
    }
    /* The nominal IPC stands in the middle of every figure. */
    const struct contour_figure figure = {title,
                                          wfpsf_study_column(study, table, 0),
                                          wfpsf_study_column(study, table, 1),
                                          SIDE,
                                          columns[0],
                                          y,
                                          columns[0][SIDE / 2],
                                          y[SIDE / 2]};
    char path[4096];
    if (snprintf(path, sizeof path, "%s/%s.png", folder, file) >= (int)sizeof path ||
        contours_write(path, &figure, names, values) != 0) {
        fprintf(stderr, "study: %s.png: %s\n", file, strerror(errno));
        exit(1);
    }
}

static void draw_figures(const wfpsf_study *study, const char *folder) {
#define DRAW(name, key, file, text)                                                                \
    if (strncmp(file, "figure", 6) == 0)                                                           \
        draw_figure(study, folder, key, file, text);
    WFPSF_STUDY_TABLE_LIST(DRAW)
#undef DRAW
}
#endif

int main(int argc, char **argv) {
    const char *folder = argc > 1 ? argv[1] : "out";
    const int sca = argc > 2 ? atoi(argv[2]) : 7;
    if (argc > 3) {
        fprintf(stderr, "usage: %s [output folder [SCA]]\n", argv[0]);
        return 1;
    }
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "study: %s: %s\n", folder, strerror(errno));
        return 1;
    }
    wfpsf_instrument *instrument;
    wfpsf_study *study;
    check(wfpsf_check_version());
    check(wfpsf_instrument_create("wfirst-afta-c5", &instrument));
    const double start = now_s();
    check(wfpsf_study_create(instrument, sca, NULL, &study));
    const double taken = now_s() - start;

    print_table(study, WFPSF_STUDY_BANDS, "Bands (Table 1)");
    print_table(study, WFPSF_STUDY_SIZES, "Sizes and ellipticities (Table 2)");
    print_table(study, WFPSF_STUDY_SENSITIVITIES, "Sensitivities (Tables 3 and 4)");
    print_table(study, WFPSF_STUDY_LINEAR_LAW, "Largest errors of the linear laws");
    print_table(study, WFPSF_STUDY_REQUIREMENTS, "Requirements (section 6)");
    print_table(study, WFPSF_STUDY_CONVERGENCE, "Errors against the oversampling");
    print_table(study, WFPSF_STUDY_COMPARISON, "The paper, the peer and this work");
    check(wfpsf_study_write_csv(study, folder));
#ifdef STUDY_WITH_CONTOURS
    draw_figures(study, folder);
#else
    printf("figure_NN.png left out: this program was built without libgd\n");
#endif
    printf("The study took %.2f s.\n", taken);

    wfpsf_study_destroy(study);
    wfpsf_instrument_destroy(instrument);
    return fclose(stdout) == 0 ? 0 : 1;
}
