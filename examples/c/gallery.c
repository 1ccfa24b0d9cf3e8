/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "gallery.h"

#include <errno.h>
#include <gd.h>
#include <gdfontg.h>
#include <gdfonts.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    PANEL = 352,
    GAP_X = 24,
    GAP_Y = 64,
    LEFT = 84,
    RIGHT = 130,
    TOP = 48,
    BOTTOM = 70,
    BAR_WIDTH = 22,
    TICK = 7,
    DECADES = 5,
    WIDTH = LEFT + GALLERY_COLUMNS * PANEL + (GALLERY_COLUMNS - 1) * GAP_X + RIGHT,
    HEIGHT = TOP + GALLERY_ROWS * PANEL + (GALLERY_ROWS - 1) * GAP_Y + BOTTOM
};

static const int black = gdTrueColor(0, 0, 0), white = gdTrueColor(255, 255, 255);

/* Inferno: perceptually uniform, and its brightness alone tells the value. t in [0, 1]. */
static int colour(double t) {
    static const int stops[][3] = {{0, 0, 4},      {31, 12, 72},   {85, 15, 109},
                                   {136, 34, 106}, {186, 54, 85},  {227, 89, 51},
                                   {249, 140, 10}, {249, 201, 50}, {252, 255, 164}};
    const int last = (int)(sizeof stops / sizeof stops[0]) - 1;
    const int i = t < 1 ? (int)(t * last) : last - 1;
    const double f = t * last - i;
    int rgb[3];
    for (int c = 0; c < 3; ++c)
        rgb[c] = (int)lround(stops[i][c] + f * (stops[i + 1][c] - stops[i][c]));
    return gdTrueColor(rgb[0], rgb[1], rgb[2]);
}

/* Place of a value between 10^-DECADES and 1 on the logarithmic scale, in [0, 1]. */
static double on_scale(double value) {
    return fmin(1, fmax(0, 1 + log10(fmax(value, 1e-300)) / DECADES));
}

static void text(gdImagePtr image, gdFontPtr font, int x, int y, const char *line, int ink) {
    gdImageString(image, font, x, y, (unsigned char *)line, ink);
}

static void text_centred(gdImagePtr image, gdFontPtr font, int x, int y, const char *line,
                         int ink) {
    text(image, font, x - (int)strlen(line) * font->w / 2, y, line, ink);
}

static void text_upwards(gdImagePtr image, gdFontPtr font, int x, int y, const char *line,
                         int ink) {
    gdImageStringUp(image, font, x, y + (int)strlen(line) * font->w / 2, (unsigned char *)line,
                    ink);
}

/* 0 or -1: the picture has no room in memory. */
static int draw_pixels(gdImagePtr image, int left, int top, const double *pixels, int side) {
    double brightest = 0;
    for (int i = 0; i < side * side; ++i)
        brightest = fmax(brightest, pixels[i]);
    gdImagePtr whole = gdImageCreateTrueColor(side, side);
    if (!whole)
        return -1;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            gdImageSetPixel(whole, x, side - 1 - y,
                            colour(on_scale(pixels[y * side + x] / brightest)));
    gdImageCopyResampled(image, whole, left, top, 0, 0, PANEL, PANEL, side, side);
    gdImageDestroy(whole);
    return 0;
}

/* Ticks every 0.1 arcsec from the optical axis, longer and with numbers every 0.5. */
static void draw_axes(gdImagePtr image, int left, int top, double side_arcsec, int numbers_x,
                      int numbers_y) {
    const int bottom = top + PANEL;
    const int most = (int)floor(side_arcsec / 2 / 0.1);
    gdImageRectangle(image, left - 1, top - 1, left + PANEL, bottom, black);
    for (int i = -most; i <= most; ++i) {
        const int offset = (int)lround(PANEL * (0.5 + 0.1 * i / side_arcsec));
        const int length = i % 5 == 0 ? TICK : TICK / 2;
        gdImageLine(image, left + offset, bottom, left + offset, bottom + length, black);
        gdImageLine(image, left - 1, bottom - offset, left - 1 - length, bottom - offset, black);
        if (i % 5 != 0)
            continue;
        char number[16];
        snprintf(number, sizeof number, "%.1f", 0.1 * i);
        if (numbers_x)
            text_centred(image, gdFontGetGiant(), left + offset, bottom + TICK + 3, number, black);
        if (numbers_y)
            text(image, gdFontGetGiant(), left - TICK - 5 - 9 * (int)strlen(number),
                 bottom - offset - 8, number, black);
    }
}

static void draw_scale_bar(gdImagePtr image, int left, int top, double side_arcsec) {
    const int length = (int)lround(PANEL * 0.5 / side_arcsec);
    const int x = left + 16, y = top + PANEL - 18;
    gdImageFilledRectangle(image, x, y, x + length - 1, y + 2, white);
    text_centred(image, gdFontGetGiant(), x + length / 2, y - 19, "0.5 arcsec", white);
}

static void draw_colour_bar(gdImagePtr image, int left, int top, int bottom) {
    for (int y = top; y <= bottom; ++y)
        gdImageLine(image, left, y, left + BAR_WIDTH, y,
                    colour((double)(bottom - y) / (bottom - top)));
    gdImageRectangle(image, left - 1, top - 1, left + BAR_WIDTH + 1, bottom + 1, black);
    const int right = left + BAR_WIDTH + 1;
    for (int decade = 0; decade <= DECADES; ++decade) {
        const int y = top + (int)lround((double)(bottom - top) * decade / DECADES);
        char exponent[8];
        gdImageLine(image, right, y, right + TICK, y, black);
        snprintf(exponent, sizeof exponent, "%d", -decade);
        text(image, gdFontGetGiant(), right + TICK + 4, y - 8, "10", black);
        text(image, gdFontGetSmall(), right + TICK + 24, y - 14, exponent, black);
    }
    text_upwards(image, gdFontGetGiant(), right + TICK + 42, (top + bottom) / 2,
                 "PSF / its brightest pixel", black);
}

static int write_png(gdImagePtr image, const char *path) {
    FILE *file = fopen(path, "wb");
    if (!file)
        return -1;
    gdImagePng(image, file);
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}

int gallery_write(const char *path, const struct gallery_panel *panels, int side,
                  double side_arcsec) {
    gdImagePtr image = gdImageCreateTrueColor(WIDTH, HEIGHT);
    if (!image) {
        errno = ENOMEM;
        return -1;
    }
    gdImageFilledRectangle(image, 0, 0, WIDTH - 1, HEIGHT - 1, white);
    int status = 0;
    for (int i = 0; i < GALLERY_ROWS * GALLERY_COLUMNS; ++i) {
        const int row = i / GALLERY_COLUMNS, column = i % GALLERY_COLUMNS;
        const int left = LEFT + column * (PANEL + GAP_X), top = TOP + row * (PANEL + GAP_Y);
        char title[64];
        snprintf(title, sizeof title, "%s   %.2f nm", panels[i].band, panels[i].wavelength_nm);
        text_centred(image, gdFontGetGiant(), left + PANEL / 2, top - 24, title, black);
        status |= draw_pixels(image, left, top, panels[i].pixels, side);
        draw_axes(image, left, top, side_arcsec, 1, column == 0);
        draw_scale_bar(image, left, top, side_arcsec);
        if (row == GALLERY_ROWS - 1)
            text_centred(image, gdFontGetGiant(), left + PANEL / 2, top + PANEL + 36, "x [arcsec]",
                         black);
        if (column == 0)
            text_upwards(image, gdFontGetGiant(), left - 68, top + PANEL / 2, "y [arcsec]", black);
    }
    draw_colour_bar(image, WIDTH - RIGHT + GAP_X, TOP, HEIGHT - BOTTOM - 1);
    if (status == 0)
        status = write_png(image, path);
    else
        errno = ENOMEM;
    gdImageDestroy(image);
    return status;
}
