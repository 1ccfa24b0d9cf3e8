/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CONTOURS_H
#define CONTOURS_H

/* Functions on one square grid, x fastest. */
struct contour_figure {
    const char *title, *x_name, *y_name;
    int side;              /* points along each axis, two or more */
    const double *x, *y;   /* side numbers each, in equal steps upwards */
    double mark_x, mark_y; /* where a cross stands */
};

enum { CONTOURS_PANELS = 3 };

/*
 * Draws three functions side by side as a PNG, each with about ten contours at round levels.
 *
 * Given:    names   of the panels
 *           values  side * side numbers each
 * Returned: 0, or -1 with errno set if the file cannot be written
 */
int contours_write(const char *path, const struct contour_figure *figure,
                   const char *const names[CONTOURS_PANELS],
                   const double *const values[CONTOURS_PANELS]);

#endif
