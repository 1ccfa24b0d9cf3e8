/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * compare EXPECTED FOUND RELATIVE ABSOLUTE
 *
 * Two files of golden results must have the same cases and quantities in the same order, and values
 * that are equal bit for bit or within RELATIVE of the larger one plus ABSOLUTE. Exit code 0 if
 * they do, 1 if not, 2 if a file cannot be read.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    char name[64], quantity[64], value[64];
} row;

static int next(FILE *file, row *r) {
    return fscanf(file, "%63s %63s %63s", r->name, r->quantity, r->value) == 3;
}

int main(int argc, char **argv) {
    FILE *expected = argc == 5 ? fopen(argv[1], "r") : NULL;
    FILE *found = argc == 5 ? fopen(argv[2], "r") : NULL;
    if (!expected || !found) {
        fprintf(stderr, "usage: %s EXPECTED FOUND RELATIVE ABSOLUTE\n", argv[0]);
        return 2;
    }
    const double relative = atof(argv[3]), absolute = atof(argv[4]);
    row a, b;
    int rows = 0, differing = 0, more_a, more_b;
    for (;;) {
        more_a = next(expected, &a);
        more_b = next(found, &b);
        if (!more_a || !more_b)
            break;
        const double x = atof(a.value), y = atof(b.value);
        const int same = memcmp(&x, &y, sizeof x) == 0 ||
                         fabs(x - y) <= relative * fmax(fabs(x), fabs(y)) + absolute;
        if (strcmp(a.name, b.name) != 0 || strcmp(a.quantity, b.quantity) != 0 || !same) {
            printf("%s %s %s, not %s %s %s\n", b.name, b.quantity, b.value, a.name, a.quantity,
                   a.value);
            ++differing;
        }
        ++rows;
    }
    fclose(expected);
    fclose(found);
    if (more_a != more_b || rows < 2) {
        printf("the number of rows differs after %d\n", rows);
        return 1;
    }
    return differing == 0 ? 0 : 1;
}
