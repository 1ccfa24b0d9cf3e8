/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef GALLERY_H
#define GALLERY_H

/* One square PSF, x fastest and y upwards. */
struct gallery_panel {
    const char *band;
    double wavelength_nm;
    const double *pixels;
};

enum { GALLERY_ROWS = 2, GALLERY_COLUMNS = 3 };

/*
 * Draws 2 x 3 PSFs as a PNG, each on a logarithmic scale relative to its brightest pixel.
 *
 * Given:    panels       row by row
 *           side         pixels along a side of each
 *           side_arcsec  the same in arcsec, outer edge to outer edge
 * Returned: 0, or -1 with errno set if the file cannot be written
 */
int gallery_write(const char *path, const struct gallery_panel *panels, int side,
                  double side_arcsec);

#endif
