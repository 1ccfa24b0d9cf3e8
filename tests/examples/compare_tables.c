/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * compare_tables EXPECTED FOUND
 *
 * Two table_sizes.csv of the main job must have the same rows in the same order: equal texts, the
 * paper's figures equal as numbers, values within 1e-12 relative + 1e-13, error estimates within a
 * factor of 2. Exit code 0 if they do, 1 if not, 2 if a file cannot be read.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXTS = 5, PAPER = TEXTS, VALUE, ERROR_ESTIMATE, FIELDS, LINE = 1024 };

/* The next line without its end, cut to LINE - 1 characters; NULL where the file ends. */
static char *next_line(FILE *file, char *line) {
    if (!fgets(line, LINE, file))
        return NULL;
    line[strcspn(line, "\r\n")] = '\0';
    return line;
}

/* Cuts a line at its commas; whether there are as many fields as a row has. */
static int split(char *line, char *fields[FIELDS]) {
    for (int i = 0; i < FIELDS; ++i) {
        fields[i] = line;
        line += strcspn(line, ",");
        if ((*line == ',') != (i + 1 < FIELDS))
            return 0;
        *line++ = '\0';
    }
    return 1;
}

/* NaN unless the whole field is a number. */
static double number(const char *field) {
    char *end;
    const double value = strtod(field, &end);
    return end != field && *end == '\0' ? value : NAN;
}

static int close_enough(double a, double b) {
    return fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b)) + 1e-13;
}

static int within_factor_2(double a, double b) {
    return a >= 0 && a <= 2 * b && b <= 2 * a;
}

/* What differs between two rows; NULL if nothing does. */
static const char *difference(const char *row_a, const char *row_b) {
    static const char *const names[FIELDS] = {"band", "struts", "ipc",   "quantity",
                                              "unit", "paper",  "value", "error_estimate"};
    char copy_a[LINE], copy_b[LINE], *a[FIELDS], *b[FIELDS];
    if (!split(strcpy(copy_a, row_a), a) || !split(strcpy(copy_b, row_b), b))
        return "number of fields";
    for (int i = 0; i < TEXTS; ++i)
        if (strcmp(a[i], b[i]) != 0)
            return names[i];
    if ((*a[PAPER] || *b[PAPER]) && !close_enough(number(a[PAPER]), number(b[PAPER])))
        return names[PAPER];
    if (!close_enough(number(a[VALUE]), number(b[VALUE])))
        return names[VALUE];
    if (!within_factor_2(number(a[ERROR_ESTIMATE]), number(b[ERROR_ESTIMATE])))
        return names[ERROR_ESTIMATE];
    return NULL;
}

static FILE *open_table(const char *path) {
    FILE *file = fopen(path, "r");
    if (!file) {
        perror(path);
        exit(2);
    }
    return file;
}

int main(int argc, char **argv) {
    if (argc != 3) {
        fprintf(stderr, "usage: %s EXPECTED FOUND\n", argv[0]);
        return 2;
    }
    FILE *expected = open_table(argv[1]), *found = open_table(argv[2]);
    char line_a[LINE], line_b[LINE];
    int lines = 0, differing = 0;
    for (;;) {
        const char *a = next_line(expected, line_a), *b = next_line(found, line_b);
        if (!a && !b)
            break;
        ++lines;
        const char *what = NULL;
        if (!a || !b)
            what = "number of rows";
        else if (lines == 1)
            what = strcmp(a, b) == 0 ? NULL : "header";
        else
            what = difference(a, b);
        if (what) {
            ++differing;
            printf("line %d: %s differs\n  %s\n  %s\n", lines, what, a ? a : "(none)",
                   b ? b : "(none)");
        }
        if (!a || !b)
            break;
    }
    if (ferror(expected) || ferror(found)) {
        fprintf(stderr, "a table cannot be read to its end\n");
        return 2;
    }
    fclose(expected);
    fclose(found);
    if (lines < 2) {
        printf("the tables have no rows\n");
        return 1;
    }
    return differing == 0 ? 0 : 1;
}
