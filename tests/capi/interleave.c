/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interleaving and its inverse, under both ways to count the offsets. */
#include "pixels.h"

enum { nx = 4, ny = 3, n_x = 3, n_y = 2, phases = n_x * n_y };

struct dithers {
    double data[phases][nx * ny], fine_data[phases * nx * ny], dx[phases], dy[phases];
    wfpsf_image *coarse[phases], *fine;
};

/* Image k = j n_x + i has the samples (i, j). */
static void make(struct dithers *d, int32_t convention) {
    for (int k = 0; k < phases; ++k) {
        const int i = k % n_x, j = k / n_x;
        for (int p = 0; p < nx * ny; ++p)
            d->data[k][p] = 100 * k + p;
        d->coarse[k] = wrap(d->data[k], nx, ny);
        d->dx[k] = (double)i / n_x;
        d->dy[k] = (double)j / n_y;
        if (convention == WFPSF_DITHER_OBJECT) {
            d->dx[k] = ((n_x - 1) / 2.0 - i) / n_x;
            d->dy[k] = ((n_y - 1) / 2.0 - j) / n_y;
        }
    }
    fill(d->fine_data, phases * nx * ny, 7);
    d->fine = wrap(d->fine_data, n_x * nx, n_y * ny);
}

static void destroy(struct dithers *d) {
    for (int k = 0; k < phases; ++k)
        wfpsf_image_destroy(d->coarse[k]);
    wfpsf_image_destroy(d->fine);
}

static wfpsf_status interleave(const struct dithers *d, int32_t convention) {
    return wfpsf_image_interleave(n_x, n_y, (const wfpsf_image *const *)d->coarse, d->dx, d->dy,
                                  convention, d->fine);
}

static wfpsf_status deinterleave(const struct dithers *d, int32_t convention) {
    return wfpsf_image_deinterleave(d->fine, n_x, n_y, d->dx, d->dy, convention, d->coarse);
}

static void test_there_and_back(int32_t convention) {
    struct dithers d;
    make(&d, convention);
    CHECK_OK(interleave(&d, convention));
    for (int y = 0; y < n_y * ny; ++y)
        for (int x = 0; x < n_x * nx; ++x) {
            const int k = (y % n_y) * n_x + x % n_x, p = (y / n_y) * nx + x / n_x;
            CHECK(d.fine_data[y * n_x * nx + x] == 100 * k + p);
        }
    for (int k = 0; k < phases; ++k)
        fill(d.data[k], nx * ny, 7);
    CHECK_OK(deinterleave(&d, convention));
    for (int k = 0; k < phases; ++k)
        for (int p = 0; p < nx * ny; ++p)
            CHECK(d.data[k][p] == 100 * k + p);
    destroy(&d);
}

/* With as many dithers along x as along y the oversampling grows and shrinks by that many. */
static void test_record(void) {
    double data[4][1] = {{1}, {2}, {3}, {4}}, fine_data[4];
    const double dx[4] = {0, 0.5, 0, 0.5}, dy[4] = {0, 0, 0.5, 0.5};
    wfpsf_image *coarse[4], *fine = wrap_strided(fine_data + 3, 2, 2, -1, -2, 1);
    for (int k = 0; k < 4; ++k) {
        coarse[k] = wrap_strided(data[k], 1, 1, 1, 1, 3);
        CHECK_OK(wfpsf_image_set_record(coarse[k], 3, 0.11, WFPSF_EFFECT_IPC));
    }
    CHECK_OK(wfpsf_image_interleave(2, 2, (const wfpsf_image *const *)coarse, dx, dy,
                                    WFPSF_DITHER_DETECTOR, fine));
    check_record(fine, 6, 0.11, WFPSF_EFFECT_IPC);
    for (int k = 0; k < 4; ++k)
        CHECK(fine_data[3 - k] == data[k][0]);
    CHECK_OK(wfpsf_image_deinterleave(fine, 2, 2, dx, dy, WFPSF_DITHER_DETECTOR, coarse));
    for (int k = 0; k < 4; ++k)
        check_record(coarse[k], 3, 0.11, WFPSF_EFFECT_IPC);
    CHECK_OK(wfpsf_image_set_record(fine, 3, 0.11, 0));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "n_x = 2",
                wfpsf_image_deinterleave(fine, 2, 2, dx, dy, WFPSF_DITHER_DETECTOR, coarse));
    for (int k = 0; k < 4; ++k)
        wfpsf_image_destroy(coarse[k]);
    wfpsf_image_destroy(fine);
}

/* Both directions fail alike, and nothing is written. */
static void check_both_refused(wfpsf_status status, const char *culprit, const struct dithers *d,
                               int32_t convention) {
    CHECK_FAILS(status, culprit, interleave(d, convention));
    CHECK(all_are(d->fine_data, phases * nx * ny, 7));
    CHECK_FAILS(status, culprit, deinterleave(d, convention));
    for (int k = 0; k < phases; ++k)
        CHECK(d->data[k][1] == 100 * k + 1);
}

static void test_bad_offsets(void) {
    struct dithers d;
    make(&d, WFPSF_DITHER_DETECTOR);
    check_both_refused(WFPSF_ERROR_ARGUMENT, "convention = 0", &d, 0);
    check_both_refused(WFPSF_ERROR_ARGUMENT, "convention = 3", &d, 3);
    d.dx[4] = 0.4;
    check_both_refused(WFPSF_ERROR_RANGE, "dx = 0.4", &d, WFPSF_DITHER_DETECTOR);
    d.dx[4] = 1;
    check_both_refused(WFPSF_ERROR_RANGE, "dx = 1", &d, WFPSF_DITHER_DETECTOR);
    d.dx[4] = -1.0 / 3;
    check_both_refused(WFPSF_ERROR_RANGE, "dx = -0.333", &d, WFPSF_DITHER_DETECTOR);
    d.dx[4] = NAN;
    check_both_refused(WFPSF_ERROR_NOT_FINITE, "dx = nan", &d, WFPSF_DITHER_DETECTOR);
    d.dx[4] = 1.0 / 3;
    d.dy[4] = HUGE_VAL;
    check_both_refused(WFPSF_ERROR_NOT_FINITE, "dy = inf", &d, WFPSF_DITHER_DETECTOR);
    d.dy[4] = 0; /* that of image 1 */
    check_both_refused(WFPSF_ERROR_ARGUMENT, "images 1 and 4", &d, WFPSF_DITHER_DETECTOR);
    destroy(&d);
}

static void test_bad_images(void) {
    const int32_t by = WFPSF_DITHER_DETECTOR;
    struct dithers d;
    make(&d, by);
    double other[64];
    float single[64];
    wfpsf_image *const fine = d.fine, *const first = d.coarse[0], *const last = d.coarse[5];
    wfpsf_image *larger = wrap(other, nx + 1, ny), *floats = wrap_float(single, nx, ny),
                *inside = wrap_strided(d.fine_data, nx, ny, 1, nx, 1);

    d.coarse[5] = larger;
    CHECK_FAILS(WFPSF_ERROR_SIZE, "5 x 3", interleave(&d, by));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "5 x 3", deinterleave(&d, by));
    d.coarse[5] = floats;
    CHECK_FAILS(WFPSF_ERROR_TYPE, "images[5]", interleave(&d, by));
    CHECK_FAILS(WFPSF_ERROR_TYPE, "[5]", deinterleave(&d, by));
    d.coarse[5] = inside;
    CHECK_FAILS(WFPSF_ERROR_OVERLAP, "image 5", interleave(&d, by));
    CHECK_FAILS(WFPSF_ERROR_OVERLAP, "image 5", deinterleave(&d, by));
    d.coarse[5] = NULL;
    CHECK_FAILS(WFPSF_ERROR_NULL, "images[5]", interleave(&d, by));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out[5]", deinterleave(&d, by));
    d.coarse[5] = last;

    d.fine = first;
    CHECK_FAILS(WFPSF_ERROR_SIZE, "4 x 3", interleave(&d, by));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "4 x 3", deinterleave(&d, by));
    d.fine = NULL;
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", interleave(&d, by));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", deinterleave(&d, by));
    d.fine = fine;

    CHECK(all_are(d.fine_data, phases * nx * ny, 7));
    wfpsf_image_destroy(larger);
    wfpsf_image_destroy(floats);
    wfpsf_image_destroy(inside);
    destroy(&d);
}

/* Images to take apart into may not share memory with each other either. */
static void test_outputs_apart(void) {
    const double dx[2] = {0, 0.5}, dy[2] = {0, 0};
    double fine_data[2] = {1, 2}, data[1] = {7};
    wfpsf_image *fine = wrap(fine_data, 2, 1), *one = wrap(data, 1, 1), *other = wrap(data, 1, 1);
    wfpsf_image *const out[2] = {one, other};
    CHECK_STATUS(WFPSF_ERROR_OVERLAP,
                 wfpsf_image_deinterleave(fine, 2, 1, dx, dy, WFPSF_DITHER_DETECTOR, out));
    CHECK(data[0] == 7);
    wfpsf_image_destroy(fine);
    wfpsf_image_destroy(one);
    wfpsf_image_destroy(other);
}

static void test_bad_counts_and_null(void) {
    const int32_t by = WFPSF_DITHER_DETECTOR;
    struct dithers d;
    make(&d, by);
    const wfpsf_image *const *in = (const wfpsf_image *const *)d.coarse;
    const int64_t bad[][2] = {{0, 2}, {-1, 2}, {3, 0}, {3, INT64_MIN}, {INT64_MAX, INT64_MAX}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        const int64_t n = bad[i][0], m = bad[i][1];
        char culprit[64];
        snprintf(culprit, sizeof culprit, "(%lld, %lld)", (long long)n, (long long)m);
        CHECK_FAILS(WFPSF_ERROR_RANGE, culprit,
                    wfpsf_image_interleave(n, m, in, d.dx, d.dy, by, d.fine));
        CHECK_FAILS(WFPSF_ERROR_RANGE, culprit,
                    wfpsf_image_deinterleave(d.fine, n, m, d.dx, d.dy, by, d.coarse));
    }
    CHECK_FAILS(WFPSF_ERROR_NULL, "images",
                wfpsf_image_interleave(n_x, n_y, NULL, d.dx, d.dy, by, d.fine));
    CHECK_FAILS(WFPSF_ERROR_NULL, "dx",
                wfpsf_image_interleave(n_x, n_y, in, NULL, d.dy, by, d.fine));
    CHECK_FAILS(WFPSF_ERROR_NULL, "dy",
                wfpsf_image_interleave(n_x, n_y, in, d.dx, NULL, by, d.fine));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out = NULL",
                wfpsf_image_deinterleave(d.fine, n_x, n_y, d.dx, d.dy, by, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "dx",
                wfpsf_image_deinterleave(d.fine, n_x, n_y, NULL, d.dy, by, d.coarse));
    CHECK_FAILS(WFPSF_ERROR_NULL, "dy",
                wfpsf_image_deinterleave(d.fine, n_x, n_y, d.dx, NULL, by, d.coarse));
    CHECK(all_are(d.fine_data, phases * nx * ny, 7));
    destroy(&d);
}

int main(void) {
    test_there_and_back(WFPSF_DITHER_DETECTOR);
    test_there_and_back(WFPSF_DITHER_OBJECT);
    test_record();
    test_bad_offsets();
    test_bad_images();
    test_outputs_apart();
    test_bad_counts_and_null();
    return checked();
}
