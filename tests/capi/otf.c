/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PSFs in k space, and every wrong way to ask for them. */
#include "pixels.h"

static const double pi = 3.14159265358979323846;

static wfpsf_options *with_eps(double eps) {
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, eps));
    return options;
}

static double property(const wfpsf_otf *otf, int32_t key) {
    double value = NAN;
    CHECK_OK(wfpsf_otf_get(otf, key, &value));
    return value;
}

static double sinc(double x) {
    return x == 0 ? 1 : sin(pi * x) / (pi * x);
}

static void test_values(const wfpsf_otf *otf) {
    const double cutoff = property(otf, WFPSF_OTF_CUTOFF);
    CHECK(property(otf, WFPSF_OTF_ERROR_ESTIMATE) <= 1e-3);
    CHECK(property(otf, WFPSF_OTF_VALUE_ERROR) > 0);
    CHECK(property(otf, WFPSF_OTF_PIXELS) >= 64);
    /* 2.36 m at 1292 nm */
    CHECK_NEAR(cutoff, 2.36 / 1292e-9 * pi / 180 / 3600, 0.01 * cutoff);

    const double kx[] = {0, 0.2 * cutoff, -0.2 * cutoff, 1.01 * cutoff, 1e300};
    const double ky[] = {0, -0.3 * cutoff, 0.3 * cutoff, 0, -1e300};
    double re[5], im[5], pixel_re[5], pixel_im[5];
    CHECK_OK(wfpsf_otf_values(otf, WFPSF_RESPONSE_DIFFRACTION, 5, kx, ky, re, im));
    CHECK_OK(wfpsf_otf_values(otf, WFPSF_RESPONSE_EFFECTIVE, 5, kx, ky, pixel_re, pixel_im));
    CHECK(re[0] == 1 && im[0] == 0);
    CHECK(re[1] == re[2] && im[1] == -im[2] && re[1] != 0);
    CHECK(re[3] == 0 && im[3] == 0 && re[4] == 0 && im[4] == 0);
    for (int i = 0; i < 4; ++i) {
        const double response = sinc(0.11 * kx[i]) * sinc(0.11 * ky[i]);
        CHECK_NEAR(pixel_re[i], response * re[i], 1e-15);
        CHECK_NEAR(pixel_im[i], response * im[i], 1e-15);
    }
    CHECK_OK(wfpsf_otf_values(otf, WFPSF_RESPONSE_DIFFRACTION, 0, NULL, NULL, NULL, NULL));
}

static int64_t frequency(int64_t pixel, int64_t size) {
    return pixel < (size + 1) / 2 ? pixel : pixel - size;
}

/* Each order, odd and even, in an array of complex numbers and in float32. */
static void test_grid(const wfpsf_otf *otf) {
    enum { nx = 6, ny = 5 };
    const double step = property(otf, WFPSF_OTF_CUTOFF) / 7;
    double values[2 * nx * ny];
    float im_values[nx * ny];
    for (int32_t order = WFPSF_ORDER_CENTRED; order <= WFPSF_ORDER_HALF; ++order) {
        wfpsf_image *re = wrap_strided(values, nx, ny, 2, 2 * nx, 1);
        wfpsf_image *im = wrap_strided(values + 1, nx, ny, 2, 2 * nx, 1);
        wfpsf_image *im_single = wrap_float(im_values, nx, ny);
        CHECK_OK(wfpsf_otf_grid(otf, WFPSF_RESPONSE_EFFECTIVE, order, step, re, im_single));
        CHECK_OK(wfpsf_otf_grid(otf, WFPSF_RESPONSE_EFFECTIVE, order, step, re, im));
        for (int64_t y = 0; y < ny; ++y)
            for (int64_t x = 0; x < nx; ++x) {
                const int centred = order == WFPSF_ORDER_CENTRED;
                const double kx = step * (double)(centred                     ? x - 3
                                                  : order == WFPSF_ORDER_HALF ? x
                                                                              : frequency(x, nx));
                const double ky = step * (double)(centred ? y - 2 : frequency(y, ny));
                double wanted_re, wanted_im;
                CHECK_OK(wfpsf_otf_values(otf, WFPSF_RESPONSE_EFFECTIVE, 1, &kx, &ky, &wanted_re,
                                          &wanted_im));
                CHECK_NEAR(values[2 * (y * nx + x)], wanted_re, 0);
                CHECK_NEAR(values[2 * (y * nx + x) + 1], wanted_im, 0);
                CHECK_NEAR(im_values[y * nx + x], wanted_im, 1e-7);
            }
        wfpsf_image_destroy(re);
        wfpsf_image_destroy(im);
        wfpsf_image_destroy(im_single);
    }
}

/* The inverse transform of the grid is the star that the PSF draws. */
static void test_draws_the_psf(const wfpsf_psf *psf, const wfpsf_otf *otf) {
    enum { n = 256, stamp = 5 };
    static double re_values[n * n], im_values[n * n];
    double star[stamp * stamp], peak;
    /* Periodic over 128 native pixels, sampled twice a native pixel: no frequency is left out. */
    const double step = 1 / (n / 2 * 0.11);
    wfpsf_image *re = wrap(re_values, n, n), *im = wrap(im_values, n, n);
    wfpsf_image *drawn = wrap(star, stamp, stamp);
    CHECK_OK(wfpsf_otf_grid(otf, WFPSF_RESPONSE_EFFECTIVE, WFPSF_ORDER_CENTRED, step, re, im));
    CHECK_OK(wfpsf_psf_draw(psf, 2, 2, 1, NULL, drawn));
    CHECK_OK(wfpsf_psf_get(psf, WFPSF_PSF_PEAK, &peak));
    for (int y = 0; y < stamp; ++y)
        for (int x = 0; x < stamp; ++x) {
            double sum = 0;
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    const double phase =
                        2 * pi * step * 0.11 * ((i - n / 2) * (x - 2) + (j - n / 2) * (y - 2));
                    sum += re_values[j * n + i] * cos(phase) - im_values[j * n + i] * sin(phase);
                }
            /* What lies 128 pixels off comes in by the period. */
            CHECK_NEAR(sum * step * step * 0.11 * 0.11, star[y * stamp + x], 2e-3 * peak);
        }
    wfpsf_image_destroy(re);
    wfpsf_image_destroy(im);
    wfpsf_image_destroy(drawn);
}

static void test_refuses(const wfpsf_psf *psf, const wfpsf_otf *otf) {
    wfpsf_otf *out = STALE(wfpsf_otf);
    CHECK_FAILS(WFPSF_ERROR_NULL, "psf", wfpsf_otf_create(NULL, NULL, &out));
    CHECK(out == NULL);
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_otf_create(psf, NULL, NULL));
    wfpsf_otf_destroy(NULL);

    double k[2] = {1, 1}, re[2] = {7, 7}, im[2] = {7, 7};
    const int32_t effective = WFPSF_RESPONSE_EFFECTIVE;
    CHECK_FAILS(WFPSF_ERROR_NULL, "otf", wfpsf_otf_values(NULL, effective, 2, k, k, re, im));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "response = 3", wfpsf_otf_values(otf, 3, 2, k, k, re, im));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = -1", wfpsf_otf_values(otf, effective, -1, k, k, re, im));
    CHECK_FAILS(WFPSF_ERROR_NULL, "kx", wfpsf_otf_values(otf, effective, 2, NULL, k, re, im));
    CHECK_FAILS(WFPSF_ERROR_NULL, "ky", wfpsf_otf_values(otf, effective, 2, k, NULL, re, im));
    CHECK_FAILS(WFPSF_ERROR_NULL, "re", wfpsf_otf_values(otf, effective, 2, k, k, NULL, im));
    CHECK_FAILS(WFPSF_ERROR_NULL, "im", wfpsf_otf_values(otf, effective, 2, k, k, re, NULL));
    const double bad[2] = {1, NAN};
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "kx[1] = nan",
                wfpsf_otf_values(otf, effective, 2, bad, k, re, im));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "ky[1] = nan",
                wfpsf_otf_values(otf, effective, 2, k, bad, re, im));

    wfpsf_image *a = wrap(re, 2, 1), *b = wrap(im, 2, 1), *c = wrap(im, 1, 1);
    const int32_t order = WFPSF_ORDER_CENTRED;
    CHECK_FAILS(WFPSF_ERROR_NULL, "otf", wfpsf_otf_grid(NULL, effective, order, 1, a, b));
    CHECK_FAILS(WFPSF_ERROR_NULL, "re", wfpsf_otf_grid(otf, effective, order, 1, NULL, b));
    CHECK_FAILS(WFPSF_ERROR_NULL, "im", wfpsf_otf_grid(otf, effective, order, 1, a, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "response = 0", wfpsf_otf_grid(otf, 0, order, 1, a, b));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "order = 4", wfpsf_otf_grid(otf, effective, 4, 1, a, b));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "step = inf",
                wfpsf_otf_grid(otf, effective, order, HUGE_VAL, a, b));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "step = 0", wfpsf_otf_grid(otf, effective, order, 0, a, b));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "re and im", wfpsf_otf_grid(otf, effective, order, 1, a, a));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "im", wfpsf_otf_grid(otf, effective, order, 1, a, c));
    CHECK(all_are(re, 2, 7) && all_are(im, 2, 7));
    wfpsf_image_destroy(a);
    wfpsf_image_destroy(b);
    wfpsf_image_destroy(c);

    double value = 7;
    CHECK_FAILS(WFPSF_ERROR_NULL, "otf", wfpsf_otf_get(NULL, WFPSF_OTF_CUTOFF, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "value", wfpsf_otf_get(otf, WFPSF_OTF_CUTOFF, NULL));
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = 15", wfpsf_otf_get(otf, 15, &value));
    CHECK(value == 7);
}

/* More than memory allows is told, and what comes out is good. */
static void test_says_what_it_cannot(const wfpsf_psf *psf) {
    wfpsf_options *options = with_eps(1e-12);
    wfpsf_otf *otf = NULL;
    CHECK_FAILS(WFPSF_WARNING_NOT_CERTIFIED, "EPS = 1e-12", wfpsf_otf_create(psf, options, &otf));
    CHECK(property(otf, WFPSF_OTF_PIXELS) == 2048);
    CHECK(property(otf, WFPSF_OTF_ERROR_ESTIMATE) < 1e-5);
    wfpsf_otf_destroy(otf);
    wfpsf_options_destroy(options);
}

int main(void) {
    wfpsf_instrument *c5 = NULL;
    wfpsf_psf *psf = NULL;
    wfpsf_otf *otf = NULL;
    wfpsf_options *options = with_eps(1e-3);
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    CHECK_OK(wfpsf_psf_create(c5, 7, 1292, options, &psf));
    CHECK_OK(wfpsf_otf_create(psf, options, &otf));
    test_values(otf);
    test_grid(otf);
    test_draws_the_psf(psf, otf);
    test_refuses(psf, otf);
    test_says_what_it_cannot(psf);
    wfpsf_psf_destroy(psf);
    test_values(otf); /* outlives its PSF */
    wfpsf_otf_destroy(otf);
    wfpsf_instrument_destroy(c5);
    wfpsf_options_destroy(options);
    return checked();
}
