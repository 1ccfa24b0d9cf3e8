/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Without struts and aberrations the PSF is the obscured Airy pattern averaged over the pixel,
   here by brute-force quadrature of the closed form. */
#include "aberrations.h"
#include "pixels.h"

enum { sca = 3, size = 13 };
static const double pi = 3.14159265358979323846, wavelength = 1292.11e-9;

/* Gauss-Legendre nodes and weights on [-1/2, 1/2]. */
enum { nodes = 24 };
static double node[nodes], weight[nodes];

static void make_rule(void) {
    for (int i = 0; i < nodes; ++i) {
        double x = cos(pi * (i + 0.75) / (nodes + 0.5)), slope = 1;
        for (int step = 0; step < 100; ++step) {
            double p = x, before = 1;
            for (int n = 2; n <= nodes; ++n) {
                const double next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
                before = p;
                p = next;
            }
            slope = nodes * (before - x * p) / (1 - x * x);
            x -= p / slope;
        }
        node[i] = x / 2;
        weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
}

/* 2 J1(x) / x */
static double jinc(double x) {
    return x < 1e-8 ? 1 : 2 * j1(x) / x;
}

/* Fraction of the light per native pixel area at a distance of r native pixels. */
static double airy(double r, double diameter, double obscuration, double pixel) {
    const double x = pi * diameter * pixel * r / wavelength, e2 = obscuration * obscuration;
    const double amplitude = jinc(x) - e2 * jinc(obscuration * x);
    const double pixels = diameter * pixel / wavelength;
    return pi / 4 * pixels * pixels * amplitude * amplitude / (1 - e2);
}

static double pixel_average(double x, double y, double diameter, double obscuration, double pixel) {
    double sum = 0;
    for (int i = 0; i < nodes; ++i)
        for (int j = 0; j < nodes; ++j)
            sum += weight[i] * weight[j] *
                   airy(hypot(x + node[i], y + node[j]), diameter, obscuration, pixel);
    return sum;
}

static void check_stamp(const wfpsf_psf *psf, const wfpsf_instrument *c5, int64_t oversampling,
                        double x, double y, double tolerance) {
    double data[size * size], diameter = 0, obscuration = 0, scale = 0, peak = 0;
    CHECK_OK(wfpsf_instrument_constant(c5, "diameter", &diameter, NULL));
    CHECK_OK(wfpsf_instrument_constant(c5, "obscuration", &obscuration, NULL));
    CHECK_OK(wfpsf_instrument_constant(c5, "pixel_scale", &scale, NULL));
    const double pixel = scale * pi / 180 / 3600, n = (double)oversampling;
    wfpsf_image *image = wrap_strided(data, size, size, 1, size, oversampling);
    CHECK_OK(wfpsf_psf_draw(psf, x, y, 1, NULL, image));
    for (int i = 0; i < size * size; ++i)
        peak = fmax(peak, data[i]);
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i)
            CHECK_NEAR(data[j * size + i],
                       pixel_average((i - x) / n, (j - y) / n, diameter, obscuration, pixel) /
                           (n * n),
                       tolerance * peak);
    wfpsf_image_destroy(image);
}

/* Draws at one eps and holds it against the closed form. */
static void test_at(const wfpsf_instrument *c5, double eps, double tolerance) {
    wfpsf_options *options = perfect_annulus(c5, sca, eps, 8);
    wfpsf_psf *psf = NULL;
    double estimate = 1, peak = 0, area = 0;
    CHECK_OK(wfpsf_psf_create(c5, sca, wavelength * 1e9, options, &psf));
    CHECK_OK(wfpsf_psf_get(psf, WFPSF_PSF_ERROR_ESTIMATE, &estimate));
    CHECK(estimate <= eps);
    CHECK_OK(wfpsf_psf_get(psf, WFPSF_PSF_LIT_AREA_M2, &area));
    CHECK_NEAR(area, pi / 4 * 2.36 * 2.36 * (1 - 0.09), 1e-12);
    CHECK_OK(wfpsf_psf_get(psf, WFPSF_PSF_PEAK, &peak));
    CHECK_NEAR(peak, pixel_average(0, 0, 2.36, 0.3, 0.11 * pi / 180 / 3600), tolerance);
    check_stamp(psf, c5, 1, 6, 6, tolerance);
    check_stamp(psf, c5, 1, 6.3, 5.55, tolerance);
    check_stamp(psf, c5, 4, 6, 6.5, tolerance);
    check_stamp(psf, c5, 7, -1.25, 9, tolerance);
    wfpsf_psf_destroy(psf);
    wfpsf_options_destroy(options);
}

int main(void) {
    wfpsf_instrument *c5 = NULL;
    make_rule();
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    test_at(c5, 1e-11, 1e-10);
    test_at(c5, 1e-9, 1e-9);
    test_at(c5, 1e-6, 1e-6);
    test_at(c5, 1e-3, 1e-3);
    wfpsf_instrument_destroy(c5);
    return checked();
}
