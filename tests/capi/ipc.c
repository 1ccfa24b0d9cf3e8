/* SPDX-License-Identifier: GPL-3.0-or-later */
/* IPC kernels and their application. */
#include "pixels.h"

#include <float.h>
#include <stdlib.h>

static wfpsf_options *with(int32_t key) {
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_integer(options, key, 1));
    return options;
}

static wfpsf_ipc_kernel *paper_kernel(double alpha, double alpha_prime, double alpha_plus) {
    wfpsf_ipc_kernel *kernel = NULL;
    CHECK_OK(wfpsf_ipc_kernel_create(alpha, alpha_prime, alpha_plus, NULL, &kernel));
    return kernel;
}

static wfpsf_ipc_kernel *table(int64_t nx, int64_t ny, const double *taps) {
    wfpsf_ipc_kernel *kernel = NULL;
    CHECK_OK(wfpsf_ipc_kernel_create_taps(nx, ny, taps, NULL, &kernel));
    return kernel;
}

static const double asymmetric[15] = {0.01, 0.02, 0.00, 0.03, 0.01,  0.02, 0.05, 0.70,
                                      0.04, 0.01, 0.00, 0.03, 0.025, 0.04, 0.015};

static void test_paper_kernel(void) {
    double taps[9];
    int64_t nx = 0, ny = 0;
    wfpsf_ipc_kernel *kernel = paper_kernel(0.02, 0.002, 0.003);
    CHECK_OK(wfpsf_ipc_kernel_taps(kernel, 9, taps, &nx, &ny));
    CHECK(nx == 3 && ny == 3);
    for (int i = 0; i < 9; ++i) {
        const int dx = i % 3 - 1, dy = i / 3 - 1;
        const double wanted = dx && dy ? 0.002 : dx ? 0.023 : dy ? 0.017 : 1 - 4 * 0.022;
        CHECK_NEAR(taps[i], wanted, 1e-16);
    }
    wfpsf_ipc_kernel *correction = NULL;
    CHECK_OK(wfpsf_ipc_kernel_create_correction(kernel, &correction));
    CHECK_OK(wfpsf_ipc_kernel_taps(correction, 9, taps, NULL, NULL));
    CHECK_NEAR(taps[4], 1 + 4 * 0.022, 1e-15);
    CHECK_NEAR(taps[3], -0.023, 1e-16);
    wfpsf_ipc_kernel_destroy(correction);
    wfpsf_ipc_kernel_destroy(kernel);
}

static void test_taps(void) {
    double taps[15], sum = 0;
    wfpsf_ipc_kernel *kernel = table(5, 3, asymmetric), *flipped = NULL, *other = NULL;
    int64_t nx = 0, ny = 0;
    CHECK_OK(wfpsf_ipc_kernel_taps(kernel, 15, taps, &nx, &ny));
    CHECK(nx == 5 && ny == 3 && are_equal(taps, asymmetric, 15));
    CHECK_OK(wfpsf_ipc_kernel_create_flipped(kernel, &flipped));
    CHECK_OK(wfpsf_ipc_kernel_taps(flipped, 20, taps, NULL, NULL));
    for (int i = 0; i < 15; ++i)
        CHECK(taps[i] == asymmetric[14 - i]);

    fill(taps, 15, 7), nx = ny = 7;
    CHECK_FAILS(WFPSF_ERROR_SIZE, "capacity = 14",
                wfpsf_ipc_kernel_taps(kernel, 14, taps, &nx, &ny));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "capacity = -1",
                wfpsf_ipc_kernel_taps(kernel, -1, taps, &nx, &ny));
    CHECK_FAILS(WFPSF_ERROR_NULL, "taps", wfpsf_ipc_kernel_taps(kernel, 15, NULL, &nx, &ny));
    CHECK_FAILS(WFPSF_ERROR_NULL, "kernel", wfpsf_ipc_kernel_taps(NULL, 15, taps, &nx, &ny));
    CHECK(all_are(taps, 15, 7) && nx == 7 && ny == 7);
    CHECK_OK(wfpsf_ipc_kernel_taps(kernel, 0, taps, &nx, &ny));
    CHECK(all_are(taps, 15, 7) && nx == 5 && ny == 3);
    CHECK_OK(wfpsf_ipc_kernel_taps(kernel, 0, NULL, NULL, NULL));

    wfpsf_instrument *c5 = NULL;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    CHECK_OK(wfpsf_ipc_kernel_create_default(c5, &other));
    wfpsf_instrument_destroy(c5);
    CHECK_OK(wfpsf_ipc_kernel_taps(other, 9, taps, NULL, NULL));
    for (int i = 0; i < 9; ++i)
        sum += taps[i];
    CHECK_NEAR(sum, 1, 1e-15);
    wfpsf_ipc_kernel_destroy(other);
    CHECK_OK(wfpsf_ipc_kernel_create_wfc3(&other));
    CHECK_OK(wfpsf_ipc_kernel_taps(other, 9, taps, NULL, NULL));
    CHECK_NEAR(fabs(taps[3] - taps[5]), 0.0001 / 0.9985, 1e-15);
    wfpsf_ipc_kernel_destroy(other);
    wfpsf_ipc_kernel_destroy(flipped);
    wfpsf_ipc_kernel_destroy(kernel);
    wfpsf_ipc_kernel_destroy(NULL);
}

static void check_parameters_refused(wfpsf_status status, const char *culprit, double alpha,
                                     double alpha_prime, double alpha_plus) {
    wfpsf_ipc_kernel *out = STALE(wfpsf_ipc_kernel);
    CHECK_FAILS(status, culprit,
                wfpsf_ipc_kernel_create(alpha, alpha_prime, alpha_plus, NULL, &out));
    CHECK(out == NULL);
}

static void test_bad_parameters(void) {
    check_parameters_refused(WFPSF_ERROR_NOT_FINITE, "alpha = nan", NAN, 0, 0);
    check_parameters_refused(WFPSF_ERROR_NOT_FINITE, "alpha_prime = inf", 0, HUGE_VAL, 0);
    check_parameters_refused(WFPSF_ERROR_NOT_FINITE, "alpha_plus = -inf", 0, 0, -HUGE_VAL);
    check_parameters_refused(WFPSF_ERROR_KERNEL, "-0.02", -0.02, 0, 0);
    check_parameters_refused(WFPSF_ERROR_KERNEL, "-0.002", 0.02, -0.002, 0);
    check_parameters_refused(WFPSF_ERROR_KERNEL, "-0.25", 0.25, 0, 0.5);
    check_parameters_refused(WFPSF_ERROR_KERNEL, "-1", 0.5, 0, 0);
    check_parameters_refused(WFPSF_ERROR_KERNEL, "e+300", 1e300, 1e300, 0);

    wfpsf_ipc_kernel *kernel = NULL;
    wfpsf_options *negative = with(WFPSF_OPTION_KERNEL_NEGATIVE);
    CHECK_OK(wfpsf_ipc_kernel_create(-0.02, -0.002, -0.001, negative, &kernel));
    wfpsf_ipc_kernel_destroy(kernel);
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "alpha = nan",
                wfpsf_ipc_kernel_create(NAN, 0, 0, negative, &kernel));
    wfpsf_options_destroy(negative);
}

static void check_taps_refused(wfpsf_status status, const char *culprit, int64_t nx, int64_t ny,
                               const double *taps, const wfpsf_options *options) {
    wfpsf_ipc_kernel *out = STALE(wfpsf_ipc_kernel);
    CHECK_FAILS(status, culprit, wfpsf_ipc_kernel_create_taps(nx, ny, taps, options, &out));
    CHECK(out == NULL);
}

static void test_bad_taps(void) {
    double taps[9] = {0, 0.01, 0, 0.01, 0.97, 0.01, 0, 0.01, 0};
    wfpsf_options *normalise = with(WFPSF_OPTION_KERNEL_NORMALISE);
    wfpsf_options *negative = with(WFPSF_OPTION_KERNEL_NEGATIVE);
    wfpsf_ipc_kernel *kernel = NULL;

    check_taps_refused(WFPSF_ERROR_KERNEL, "1.01", 3, 3, taps, NULL);
    check_taps_refused(WFPSF_ERROR_KERNEL, "1.01", 3, 3, taps, negative);
    CHECK_OK(wfpsf_ipc_kernel_create_taps(3, 3, taps, normalise, &kernel));
    CHECK_OK(wfpsf_ipc_kernel_taps(kernel, 9, taps, NULL, NULL));
    CHECK_NEAR(taps[4], 0.97 / 1.01, 1e-16);
    wfpsf_ipc_kernel_destroy(kernel);

    double outside[3] = {-0.25, 1.5, -0.25};
    check_taps_refused(WFPSF_ERROR_KERNEL, "-0.25", 3, 1, outside, NULL);
    check_taps_refused(WFPSF_ERROR_KERNEL, "-0.25", 3, 1, outside, normalise);
    CHECK_OK(wfpsf_ipc_kernel_create_taps(3, 1, outside, negative, &kernel));
    wfpsf_ipc_kernel_destroy(kernel);
    double null_sum[3] = {-1, 2, -1};
    check_taps_refused(WFPSF_ERROR_KERNEL, "sum", 3, 1, null_sum, normalise);
    check_taps_refused(WFPSF_ERROR_KERNEL, "sum", 3, 1, null_sum, negative);
    double close[3] = {0, 1 + 2e-9, 0};
    check_taps_refused(WFPSF_ERROR_KERNEL, "1.00000000", 3, 1, close, NULL);

    double odd[3] = {0, 1, 0};
    check_taps_refused(WFPSF_ERROR_SIZE, "2 x 1", 2, 1, odd, NULL);
    check_taps_refused(WFPSF_ERROR_SIZE, "1 x 2", 1, 2, odd, NULL);
    check_taps_refused(WFPSF_ERROR_SIZE, "0 x 3", 0, 3, odd, NULL);
    check_taps_refused(WFPSF_ERROR_SIZE, "-3 x 1", -3, 1, odd, NULL);
    check_taps_refused(WFPSF_ERROR_SIZE, "9223372036854775807", INT64_MAX, INT64_MAX, odd, NULL);
    check_taps_refused(WFPSF_ERROR_NULL, "taps", 3, 1, NULL, NULL);
    odd[0] = NAN;
    check_taps_refused(WFPSF_ERROR_NOT_FINITE, "nan", 3, 1, odd, NULL);
    check_taps_refused(WFPSF_ERROR_NOT_FINITE, "nan", 3, 1, odd, normalise);
    odd[0] = HUGE_VAL;
    check_taps_refused(WFPSF_ERROR_NOT_FINITE, "inf", 3, 1, odd, negative);

    wfpsf_options_destroy(normalise);
    wfpsf_options_destroy(negative);
}

static void test_null(void) {
    wfpsf_ipc_kernel *kernel = paper_kernel(0.02, 0, 0), *out = STALE(wfpsf_ipc_kernel);
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_ipc_kernel_create(0.02, 0, 0, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out",
                wfpsf_ipc_kernel_create_taps(5, 3, asymmetric, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_ipc_kernel_create_wfc3(NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument", wfpsf_ipc_kernel_create_default(NULL, &out));
    CHECK(out == NULL);
    wfpsf_instrument *c5 = NULL;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &c5));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_ipc_kernel_create_default(c5, NULL));
    wfpsf_instrument_destroy(c5);
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_ipc_kernel_create_correction(kernel, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_ipc_kernel_create_flipped(kernel, NULL));
    out = STALE(wfpsf_ipc_kernel);
    CHECK_FAILS(WFPSF_ERROR_NULL, "kernel", wfpsf_ipc_kernel_create_correction(NULL, &out));
    CHECK(out == NULL);
    out = STALE(wfpsf_ipc_kernel);
    CHECK_FAILS(WFPSF_ERROR_NULL, "kernel", wfpsf_ipc_kernel_create_flipped(NULL, &out));
    CHECK(out == NULL);
    wfpsf_ipc_kernel_destroy(kernel);
}

/* out(p) = sum over d of K(d) in(p - d), with the edge's charge beyond the border. */
static double convolved(const double *in, int nx, int ny, int step, int edge, int x, int y) {
    double sum = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
            int i = x - step * dx, j = y - step * dy;
            if (edge == WFPSF_EDGE_WRAP) {
                i = (i % nx + nx) % nx;
                j = (j % ny + ny) % ny;
            }
            /* the nearest native pixel: on an oversampled image, a sample of the same dither */
            while (edge == WFPSF_EDGE_REPLICATE && i < 0)
                i += step;
            while (edge == WFPSF_EDGE_REPLICATE && i >= nx)
                i -= step;
            while (edge == WFPSF_EDGE_REPLICATE && j < 0)
                j += step;
            while (edge == WFPSF_EDGE_REPLICATE && j >= ny)
                j -= step;
            if (i >= 0 && i < nx && j >= 0 && j < ny)
                sum += asymmetric[(dy + 1) * 5 + dx + 2] * in[j * nx + i];
        }
    return sum;
}

static void test_convolution(int nx, int ny, int step) {
    double *in = malloc(sizeof(double) * (size_t)(nx * ny));
    double *out = malloc(sizeof(double) * (size_t)(nx * ny));
    wfpsf_ipc_kernel *kernel = table(5, 3, asymmetric);
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_IPC_FILL, -4));
    fill_noise(in, nx * ny);
    for (int flipped = 0; flipped < 2; ++flipped)
        for (int edge = WFPSF_EDGE_ZERO; edge <= WFPSF_EDGE_FILL; ++edge) {
            wfpsf_image *from = wrap(in, nx, ny);
            wfpsf_image *to = flipped ? wrap_flipped(out, nx, ny) : wrap(out, nx, ny);
            fill(out, nx * ny, NAN);
            CHECK_OK(wfpsf_image_set_record(from, step, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE));
            CHECK_OK(wfpsf_ipc_apply(kernel, from, edge, options, to, NULL));
            check_record(to, step, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE | WFPSF_EFFECT_IPC);
            for (int y = 0; y < ny; ++y)
                for (int x = 0; x < nx; ++x) {
                    const int near =
                        x < 2 * step || x >= nx - 2 * step || y < step || y >= ny - step;
                    double wanted = convolved(in, nx, ny, step, edge, x, y);
                    if (near && edge == WFPSF_EDGE_CROP)
                        wanted = in[y * nx + x];
                    if (near && edge == WFPSF_EDGE_FILL)
                        wanted = -4;
                    const int p = y * nx + x;
                    CHECK_NEAR(out[flipped ? nx * ny - 1 - p : p], wanted, 65535 * 1e-15);
                }
            wfpsf_image_destroy(from);
            wfpsf_image_destroy(to);
        }
    if (nx > 4 * step && ny > 2 * step) {
        const int inner_nx = nx - 4 * step, inner_ny = ny - 2 * step;
        wfpsf_image *from = wrap_strided(in, nx, ny, 1, nx, step),
                    *to = wrap(out, inner_nx, inner_ny);
        CHECK_OK(wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_VALID, NULL, to, NULL));
        for (int y = 0; y < inner_ny; ++y)
            for (int x = 0; x < inner_nx; ++x)
                CHECK_NEAR(out[y * inner_nx + x],
                           convolved(in, nx, ny, step, WFPSF_EDGE_VALID, x + 2 * step, y + step),
                           65535 * 1e-15);
        wfpsf_image_destroy(from);
        wfpsf_image_destroy(to);
    }
    wfpsf_options_destroy(options);
    wfpsf_ipc_kernel_destroy(kernel);
    free(in);
    free(out);
}

static void test_float(void) {
    double in[63], out[63];
    float single_in[63], single_out[63];
    fill_noise(in, 63);
    for (int i = 0; i < 63; ++i)
        single_in[i] = (float)in[i];
    wfpsf_ipc_kernel *kernel = table(5, 3, asymmetric);
    wfpsf_image *from = wrap(in, 9, 7), *to = wrap(out, 9, 7);
    wfpsf_image *single_from = wrap_float(single_in, 9, 7),
                *single_to = wrap_float(single_out, 9, 7);
    CHECK_OK(wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_ZERO, NULL, to, NULL));
    CHECK_OK(wfpsf_ipc_apply(kernel, single_from, WFPSF_EDGE_ZERO, NULL, single_to, NULL));
    for (int i = 0; i < 63; ++i) /* summed in double, rounded once */
        CHECK_NEAR((double)single_out[i], out[i], out[i] * (FLT_EPSILON / 2 + 1e-9));
    wfpsf_image_destroy(single_from);
    wfpsf_image_destroy(single_to);
    wfpsf_image_destroy(from);
    wfpsf_image_destroy(to);
    wfpsf_ipc_kernel_destroy(kernel);
}

static void test_not_finite(void) {
    double in[63], out[63];
    float single_in[63], single_out[63];
    int64_t not_finite = -1;
    fill(in, 63, -1);
    in[20] = NAN, in[0] = HUGE_VAL;
    for (int i = 0; i < 63; ++i)
        single_in[i] = (float)in[i];
    wfpsf_ipc_kernel *kernel = paper_kernel(0.02, 0, 0);
    wfpsf_image *from = wrap_flipped(in, 9, 7), *to = wrap(out, 9, 7);
    wfpsf_image *single_from = wrap_float(single_in, 9, 7),
                *single_to = wrap_float(single_out, 9, 7);
    CHECK_OK(wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_ZERO, NULL, to, &not_finite));
    CHECK(not_finite == 5 + 3);
    CHECK_OK(wfpsf_ipc_apply(kernel, single_from, WFPSF_EDGE_ZERO, NULL, single_to, &not_finite));
    CHECK(not_finite == 5 + 3);
    CHECK_OK(wfpsf_image_set_record(from, 1, 0, 0));
    CHECK_OK(wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_ZERO, NULL, from, NULL));
    fill(in, 63, 1);
    CHECK_OK(wfpsf_image_set_record(from, 1, 0, 0));
    CHECK_OK(wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_ZERO, NULL, from, &not_finite));
    CHECK(not_finite == 0);
    wfpsf_image_destroy(from);
    wfpsf_image_destroy(to);
    wfpsf_image_destroy(single_from);
    wfpsf_image_destroy(single_to);
    wfpsf_ipc_kernel_destroy(kernel);
}

/* IPC twice is refused unless forced; its correction is another effect, and once again only. */
static void test_twice(void) {
    double data[4][25];
    wfpsf_image *image[4];
    for (int i = 0; i < 4; ++i) {
        fill(data[i], 25, 7);
        image[i] = wrap(data[i], 5, 5);
    }
    wfpsf_options *force = with(WFPSF_OPTION_FORCE);
    wfpsf_ipc_kernel *kernel = paper_kernel(0.02, 0.002, 0), *correction = NULL;
    CHECK_OK(wfpsf_ipc_kernel_create_correction(kernel, &correction));
    CHECK_OK(wfpsf_ipc_apply(kernel, image[0], WFPSF_EDGE_ZERO, NULL, image[1], NULL));
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "interpixel capacitance",
                wfpsf_ipc_apply(kernel, image[1], WFPSF_EDGE_ZERO, NULL, image[2], NULL));
    CHECK(all_are(data[2], 25, 7));
    check_record(image[2], 1, 0, 0);
    CHECK_OK(wfpsf_ipc_apply(kernel, image[1], WFPSF_EDGE_ZERO, force, image[2], NULL));
    check_record(image[2], 1, 0, WFPSF_EFFECT_IPC);
    CHECK_OK(wfpsf_ipc_apply(correction, image[1], WFPSF_EDGE_ZERO, NULL, image[3], NULL));
    check_record(image[3], 1, 0, WFPSF_EFFECT_IPC | WFPSF_EFFECT_IPC_CORRECTION);
    CHECK_NEAR(data[3][12], 7, 1e-14);
    fill(data[2], 25, 7);
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "correction",
                wfpsf_ipc_apply(correction, image[3], WFPSF_EDGE_ZERO, NULL, image[2], NULL));
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "interpixel capacitance",
                wfpsf_ipc_apply(kernel, image[3], WFPSF_EDGE_ZERO, NULL, image[2], NULL));
    CHECK(all_are(data[2], 25, 7));
    for (int i = 0; i < 4; ++i)
        wfpsf_image_destroy(image[i]);
    wfpsf_ipc_kernel_destroy(correction);
    wfpsf_ipc_kernel_destroy(kernel);
    wfpsf_options_destroy(force);
}

static void test_apply_refuses(void) {
    double in[35] = {0}, out[63];
    float single[35];
    fill(out, 63, 7);
    wfpsf_ipc_kernel *kernel = table(5, 3, asymmetric);
    wfpsf_image *from = wrap(in, 7, 5), *to = wrap(out, 7, 5), *larger = wrap(out, 8, 5),
                *floats = wrap_float(single, 7, 5), *shifted = wrap(in + 7, 7, 4),
                *upper = wrap(in, 7, 4);

    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "edge = 6", wfpsf_ipc_apply(kernel, from, 6, NULL, to, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "edge = -1",
                wfpsf_ipc_apply(kernel, from, -1, NULL, to, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "8 x 5",
                wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_ZERO, NULL, larger, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "3 x 3",
                wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_VALID, NULL, to, NULL));
    CHECK_FAILS(WFPSF_ERROR_TYPE, "out",
                wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_ZERO, NULL, floats, NULL));
    CHECK_FAILS(WFPSF_ERROR_TYPE, "out",
                wfpsf_ipc_apply(kernel, floats, WFPSF_EDGE_ZERO, NULL, to, NULL));
    CHECK_FAILS(WFPSF_ERROR_OVERLAP, "out",
                wfpsf_ipc_apply(kernel, upper, WFPSF_EDGE_ZERO, NULL, shifted, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "kernel",
                wfpsf_ipc_apply(NULL, from, WFPSF_EDGE_ZERO, NULL, to, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "in",
                wfpsf_ipc_apply(kernel, NULL, WFPSF_EDGE_ZERO, NULL, to, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out",
                wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_ZERO, NULL, NULL, NULL));
    CHECK(all_are(out, 63, 7) && all_are(in, 35, 0));
    check_record(to, 1, 0, 0);

    /* an empty image stays empty */
    wfpsf_image *none = wrap(NULL, 0, 0), *nothing = wrap(NULL, 0, 0);
    for (int edge = WFPSF_EDGE_ZERO; edge <= WFPSF_EDGE_VALID; ++edge)
        CHECK_OK(wfpsf_ipc_apply(kernel, none, edge, NULL, nothing, NULL));

    wfpsf_image *const all[] = {from, to, larger, floats, shifted, upper, none, nothing};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
        wfpsf_image_destroy(all[i]);
    wfpsf_ipc_kernel_destroy(kernel);
}

/* A NaN spreads as far as the kernel reaches. */
static void test_nan(void) {
    double in[25] = {0}, out[25];
    in[12] = NAN;
    wfpsf_ipc_kernel *kernel = paper_kernel(0.02, 0.002, 0);
    wfpsf_image *from = wrap(in, 5, 5), *to = wrap(out, 5, 5);
    CHECK_OK(wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_ZERO, NULL, to, NULL));
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 5; ++x)
            CHECK((isnan(out[y * 5 + x]) != 0) == (abs(x - 2) <= 1 && abs(y - 2) <= 1));
    wfpsf_image_destroy(from);
    wfpsf_image_destroy(to);
    wfpsf_ipc_kernel_destroy(kernel);
}

static void test_algebra(void) {
    wfpsf_ipc_kernel *kernel = table(5, 3, asymmetric), *third = NULL, *whole = NULL, *noise = NULL;
    wfpsf_options *gather = with(WFPSF_OPTION_IPC_FORM);
    double response[15], value = 0, real_part = 0, imaginary_part = 0, sum = 0;

    CHECK_OK(wfpsf_ipc_kernel_self_test(kernel, NULL, 15, response));
    CHECK(are_equal(response, asymmetric, 15));
    CHECK_OK(wfpsf_ipc_kernel_self_test(kernel, gather, 15, response));
    for (int i = 0; i < 15; ++i)
        CHECK(response[i] == asymmetric[14 - i]);
    CHECK_FAILS(WFPSF_ERROR_SIZE, "capacity = 14",
                wfpsf_ipc_kernel_self_test(kernel, NULL, 14, response));
    CHECK_FAILS(WFPSF_ERROR_NULL, "response", wfpsf_ipc_kernel_self_test(kernel, NULL, 15, NULL));

    CHECK_OK(wfpsf_ipc_kernel_create_neumann(kernel, 3, &third));
    CHECK_OK(wfpsf_ipc_kernel_create_composed(kernel, third, &whole));
    CHECK_OK(wfpsf_ipc_kernel_create_autocorrelation(kernel, &noise));
    CHECK_OK(wfpsf_ipc_kernel_transform(kernel, 0.2, -0.3, &real_part, &imaginary_part));
    const double off_x = 1 - real_part, off_y = -imaginary_part;
    const double size = off_x * off_x + off_y * off_y;
    CHECK_OK(wfpsf_ipc_kernel_transform(whole, 0.2, -0.3, &real_part, &imaginary_part));
    CHECK_NEAR(hypot(1 - real_part, imaginary_part), size * size, 1e-14);
    for (int i = 0; i < 15; ++i)
        sum += asymmetric[i] * asymmetric[i];
    CHECK_OK(wfpsf_ipc_kernel_get(kernel, WFPSF_KERNEL_VARIANCE_RATIO, &value));
    CHECK_NEAR(value, sum, 1e-15);
    CHECK_OK(wfpsf_ipc_kernel_get(kernel, WFPSF_KERNEL_CONVERSION_GAIN_BIAS, &value));
    CHECK_NEAR(value, sum - 1, 1e-15);
    CHECK_OK(wfpsf_ipc_kernel_get(kernel, WFPSF_KERNEL_QUANTUM_EFFICIENCY_BIAS, &value));
    CHECK_NEAR(value, 1 / sum - 1, 1e-15);
    double taps[45];
    CHECK_OK(wfpsf_ipc_kernel_taps(noise, 45, taps, NULL, NULL));
    CHECK_NEAR(taps[22], sum, 1e-15);
    CHECK_NEAR(taps[23], taps[21], 1e-16);

    static const int32_t keys[] = {
#define KEY(name, key, text) WFPSF_KERNEL_##name,
        WFPSF_KERNEL_PROPERTY_LIST(KEY)
#undef KEY
    };
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; ++i) {
        value = NAN;
        CHECK_OK(wfpsf_ipc_kernel_get(kernel, keys[i], &value));
        CHECK(!isnan(value));
    }
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = 11", wfpsf_ipc_kernel_get(kernel, 11, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "kernel", wfpsf_ipc_kernel_get(NULL, 10, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "value", wfpsf_ipc_kernel_get(kernel, 10, NULL));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "frequency_y = nan",
                wfpsf_ipc_kernel_transform(kernel, 0, NAN, &real_part, &imaginary_part));

    wfpsf_ipc_kernel *none = STALE(wfpsf_ipc_kernel);
    CHECK_FAILS(WFPSF_ERROR_RANGE, "order = -1",
                wfpsf_ipc_kernel_create_neumann(kernel, -1, &none));
    CHECK(none == NULL);
    CHECK_FAILS(WFPSF_ERROR_SIZE, "1023", wfpsf_ipc_kernel_create_neumann(kernel, 300, &none));
    CHECK_FAILS(WFPSF_ERROR_NULL, "second", wfpsf_ipc_kernel_create_composed(kernel, NULL, &none));
    CHECK_FAILS(WFPSF_ERROR_FILE_OPEN, "no such",
                wfpsf_ipc_kernel_read_fits("no such.fits", NULL, NULL, &none));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "capacity = 8", wfpsf_ipc_wfc3_deviations(8, taps));
    CHECK_OK(wfpsf_ipc_wfc3_deviations(9, taps));
    CHECK_NEAR(taps[4], 0.0045 / 0.9985, 1e-17);

    wfpsf_options_destroy(gather);
    wfpsf_ipc_kernel_destroy(noise);
    wfpsf_ipc_kernel_destroy(whole);
    wfpsf_ipc_kernel_destroy(third);
    wfpsf_ipc_kernel_destroy(kernel);
}

static void test_correct(void) {
    double charge[99], seen[99], found[99], residual = -1, noise = -1;
    int64_t passes = -1, not_finite = -1;
    fill_noise(charge, 99);
    wfpsf_ipc_kernel *kernel = paper_kernel(0.02, 0.002, 0.001), *singular = NULL;
    wfpsf_image *from = wrap(charge, 11, 9), *to = wrap(seen, 11, 9), *back = wrap(found, 11, 9);
    for (int edge = WFPSF_EDGE_ZERO; edge <= WFPSF_EDGE_WRAP; ++edge) {
        CHECK_OK(wfpsf_image_set_record(to, 1, 0, 0));
        CHECK_OK(wfpsf_ipc_apply(kernel, from, edge, NULL, to, NULL));
        CHECK_OK(wfpsf_ipc_correct(kernel, to, edge, NULL, back, &residual, &noise, &passes,
                                   &not_finite));
        for (int i = 0; i < 99; ++i)
            CHECK_NEAR(found[i], charge[i], 65536 * 1e-15);
        CHECK(residual >= 0 && residual < 1e-15 && passes > 0 && not_finite == 0);
        CHECK(noise > 1.09 && noise < 1.12);
        check_record(back, 1, 0, WFPSF_EFFECT_IPC + WFPSF_EFFECT_IPC_CORRECTION);
        CHECK_OK(wfpsf_ipc_correct(kernel, to, edge, NULL, to, NULL, NULL, NULL, NULL));
        CHECK(are_equal(seen, found, 99));
    }
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "correction",
                wfpsf_ipc_correct(kernel, to, 0, NULL, back, NULL, NULL, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "edge = 3",
                wfpsf_ipc_correct(kernel, from, 3, NULL, back, NULL, NULL, NULL, NULL));
    CHECK_OK(wfpsf_ipc_kernel_create(0.12499, 0, 0, NULL, &singular));
    CHECK_FAILS(WFPSF_ERROR_KERNEL_SINGULAR, "8e-05",
                wfpsf_ipc_correct(singular, from, 0, NULL, back, NULL, NULL, NULL, NULL));
    wfpsf_options *bold = NULL;
    CHECK_OK(wfpsf_options_create(&bold));
    CHECK_OK(wfpsf_options_set_real(bold, WFPSF_OPTION_IPC_LEAST_MARGIN, 1e-6));
    CHECK_OK(wfpsf_ipc_correct(singular, from, 0, bold, back, &residual, &noise, NULL, NULL));
    CHECK(residual < 1e-12 && noise > 50);
    wfpsf_options_destroy(bold);

    /* the variance of white noise after the kernel, away from the border */
    double ones[99], variance[99], value = 0;
    fill(ones, 99, 1);
    wfpsf_image *white = wrap(ones, 11, 9), *map = wrap(variance, 11, 9);
    CHECK_OK(wfpsf_ipc_covariance(kernel, white, 0, 0, WFPSF_EDGE_ZERO, NULL, map));
    CHECK_OK(wfpsf_ipc_kernel_get(kernel, WFPSF_KERNEL_VARIANCE_RATIO, &value));
    CHECK_NEAR(variance[4 * 11 + 5], value, 1e-15);
    check_record(map, 1, 0, 0);
    CHECK_OK(wfpsf_ipc_covariance(kernel, white, 2, 1, WFPSF_EDGE_WRAP, NULL, map));
    CHECK_NEAR(variance[0], 2 * 0.002 * 0.021, 1e-16);
    CHECK_OK(wfpsf_ipc_covariance(kernel, white, INT64_MAX, INT64_MIN, WFPSF_EDGE_WRAP, NULL, map));
    CHECK(all_are(variance, 99, 0));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "edge = 1",
                wfpsf_ipc_covariance(kernel, white, 0, 0, WFPSF_EDGE_REPLICATE, NULL, map));
    CHECK_FAILS(WFPSF_ERROR_NULL, "variance",
                wfpsf_ipc_covariance(kernel, NULL, 0, 0, 0, NULL, map));

    wfpsf_image *const all[] = {from, to, back, white, map};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
        wfpsf_image_destroy(all[i]);
    wfpsf_ipc_kernel_destroy(singular);
    wfpsf_ipc_kernel_destroy(kernel);
}

int main(void) {
    test_algebra();
    test_correct();
    test_paper_kernel();
    test_taps();
    test_bad_parameters();
    test_bad_taps();
    test_null();
    test_convolution(11, 9, 1);
    test_convolution(17, 13, 3);
    test_convolution(1, 1, 1);
    test_convolution(1, 6, 2);
    test_convolution(6, 1, 1);
    test_float();
    test_not_finite();
    test_twice();
    test_apply_refuses();
    test_nan();
    return checked();
}
