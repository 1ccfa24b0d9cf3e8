/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "contours.h"

#include <errno.h>
#include <gd.h>
#include <gdfontg.h>
#include <gdfonts.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    PANEL = 352,
    GAP = 40,
    LEFT = 110,
    RIGHT = 30,
    TOP = 70,
    BOTTOM = 70,
    TICKS = 5, /* along an axis */
    WIDTH = LEFT + CONTOURS_PANELS * PANEL + (CONTOURS_PANELS - 1) * GAP + RIGHT,
    HEIGHT = TOP + PANEL + BOTTOM
};

static const int black = gdTrueColor(0, 0, 0), white = gdTrueColor(255, 255, 255),
                 blue = gdTrueColor(20, 60, 160), red = gdTrueColor(200, 30, 30);

struct place {
    double x, y; /* of the picture */
};

static void text_centred(gdImagePtr image, gdFontPtr font, int x, int y, const char *line,
                         int ink) {
    gdImageString(image, font, x - (int)strlen(line) * font->w / 2, y, (unsigned char *)line, ink);
}

/* 1, 2 or 5 times a power of ten, so that about ten steps span the range. */
static double round_step(double range) {
    const double power = pow(10, floor(log10(range / 10)));
    const double mantissa = range / 10 / power;
    return power * (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10);
}

/* Where the level is met between two points; 0: nowhere. */
static int crossing(double level, struct place a, double at_a, struct place b, double at_b,
                    struct place *out) {
    if ((at_a < level) == (at_b < level))
        return 0;
    const double t = (level - at_a) / (at_b - at_a);
    *out = (struct place){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    return 1;
}

/* A level's line through a triangle, on which the function is taken as linear. */
static void draw_triangle(gdImagePtr image, double level, const struct place corner[3],
                          const double at[3]) {
    struct place ends[3];
    int count = 0;
    for (int i = 0; i < 3; ++i)
        count +=
            crossing(level, corner[i], at[i], corner[(i + 1) % 3], at[(i + 1) % 3], &ends[count]);
    if (count == 2)
        gdImageLine(image, (int)lround(ends[0].x), (int)lround(ends[0].y), (int)lround(ends[1].x),
                    (int)lround(ends[1].y), blue);
}

static struct place grid_place(int left, int side, int i, int j) {
    const double step = (double)PANEL / (side - 1);
    return (struct place){left + i * step, TOP + PANEL - j * step};
}

static void draw_level(gdImagePtr image, int left, int side, const double *values, double level) {
    for (int j = 0; j + 1 < side; ++j)
        for (int i = 0; i + 1 < side; ++i)
            for (int half = 0; half < 2; ++half) {
                /* The cell's lower right and upper left triangle. */
                const int corners[3][2] = {{i, j}, {i + 1 - half, j + half}, {i + 1, j + 1}};
                struct place corner[3];
                double at[3];
                for (int c = 0; c < 3; ++c) {
                    corner[c] = grid_place(left, side, corners[c][0], corners[c][1]);
                    at[c] = values[corners[c][1] * side + corners[c][0]];
                }
                draw_triangle(image, level, corner, at);
            }
    /* Its number, where it meets the middle column, or else the middle row. */
    const int middle = side / 2;
    char number[32];
    snprintf(number, sizeof number, "%.4g", level);
    for (int across = 0; across < 2; ++across)
        for (int k = 0; k + 1 < side; ++k) {
            const int i = across ? k : middle, j = across ? middle : k;
            const int i1 = across ? k + 1 : middle, j1 = across ? middle : k + 1;
            struct place at;
            if (!crossing(level, grid_place(left, side, i, j), values[j * side + i],
                          grid_place(left, side, i1, j1), values[j1 * side + i1], &at))
                continue;
            text_centred(image, gdFontGetSmall(), (int)at.x, (int)at.y - 12, number, black);
            return;
        }
}

static void draw_panel(gdImagePtr image, const struct contour_figure *figure, int panel,
                       const char *name, const double *values) {
    const int left = LEFT + panel * (PANEL + GAP), side = figure->side;
    const double *x = figure->x, *y = figure->y;
    double least = values[0], most = values[0];
    for (int i = 0; i < side * side; ++i) {
        least = fmin(least, values[i]);
        most = fmax(most, values[i]);
    }
    if (most > least) {
        const double step = round_step(most - least);
        for (double n = ceil(least / step); n * step <= most; ++n)
            draw_level(image, left, side, values, n == 0 ? 0 : n * step);
    }
    gdImageRectangle(image, left, TOP, left + PANEL, TOP + PANEL, black);
    text_centred(image, gdFontGetGiant(), left + PANEL / 2, TOP - 24, name, black);
    text_centred(image, gdFontGetGiant(), left + PANEL / 2, TOP + PANEL + 36, figure->x_name,
                 black);
    for (int t = 0; t <= TICKS; ++t) {
        char number[32];
        const int offset = PANEL * t / TICKS;
        snprintf(number, sizeof number, "%.3g", x[0] + (x[side - 1] - x[0]) * t / TICKS);
        gdImageLine(image, left + offset, TOP + PANEL, left + offset, TOP + PANEL + 6, black);
        text_centred(image, gdFontGetSmall(), left + offset, TOP + PANEL + 10, number, black);
        gdImageLine(image, left - 6, TOP + PANEL - offset, left, TOP + PANEL - offset, black);
        if (panel > 0)
            continue;
        snprintf(number, sizeof number, "%.3g", y[0] + (y[side - 1] - y[0]) * t / TICKS);
        gdImageString(image, gdFontGetSmall(), left - 12 - 6 * (int)strlen(number),
                      TOP + PANEL - offset - 7, (unsigned char *)number, black);
    }
    const int cross_x = left + (int)lround(PANEL * (figure->mark_x - x[0]) / (x[side - 1] - x[0]));
    const int cross_y =
        TOP + PANEL - (int)lround(PANEL * (figure->mark_y - y[0]) / (y[side - 1] - y[0]));
    gdImageLine(image, cross_x - 6, cross_y - 6, cross_x + 6, cross_y + 6, red);
    gdImageLine(image, cross_x - 6, cross_y + 6, cross_x + 6, cross_y - 6, red);
}

int contours_write(const char *path, const struct contour_figure *figure,
                   const char *const names[CONTOURS_PANELS],
                   const double *const values[CONTOURS_PANELS]) {
    gdImagePtr image = gdImageCreateTrueColor(WIDTH, HEIGHT);
    if (!image) {
        errno = ENOMEM;
        return -1;
    }
    gdImageFilledRectangle(image, 0, 0, WIDTH - 1, HEIGHT - 1, white);
    for (int panel = 0; panel < CONTOURS_PANELS; ++panel)
        draw_panel(image, figure, panel, names[panel], values[panel]);
    text_centred(image, gdFontGetGiant(), WIDTH / 2, 14, figure->title, black);
    gdImageStringUp(image, gdFontGetGiant(), 18,
                    TOP + PANEL / 2 + (int)strlen(figure->y_name) * gdFontGetGiant()->w / 2,
                    (unsigned char *)figure->y_name, black);
    FILE *file = fopen(path, "wb");
    int status = -1;
    if (file) {
        gdImagePng(image, file);
        const int bad = ferror(file);
        status = fclose(file) != 0 || bad ? -1 : 0;
    }
    gdImageDestroy(image);
    return status;
}
