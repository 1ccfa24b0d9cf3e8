/* SPDX-License-Identifier: GPL-3.0-or-later */
/* IPC that varies over a detector: made of maps, polynomials and regions, applied, undone. */
#include "pixels.h"

#include <stdlib.h>

enum { NX = 13, NY = 9, N = NX * NY };

static double ramp[N], primes[N], labels[N];

static wfpsf_image *map_of(double *data) {
    return wrap(data, NX, NY);
}

static wfpsf_varying_ipc *from_maps(void) {
    wfpsf_varying_ipc *varying = NULL;
    wfpsf_image *alpha = map_of(ramp), *prime = map_of(primes);
    CHECK_OK(wfpsf_varying_ipc_create_maps(alpha, prime, NULL, NULL, &varying));
    wfpsf_image_destroy(alpha);
    wfpsf_image_destroy(prime);
    return varying;
}

/* By the definition, no charge outside. */
static double scattered(const double *in, int x, int y) {
    double sum = 0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const int i = x - dx, j = y - dy, q = j * NX + i;
            if (i < 0 || i >= NX || j < 0 || j >= NY)
                continue;
            sum += in[q] * (dx && dy   ? primes[q]
                            : dx || dy ? ramp[q]
                                       : 1 - 4 * (ramp[q] + primes[q]));
        }
    return sum;
}

static void test_maps(void) {
    double in[N], out[N], back[N], margin = 0, residual = 1, noise = 0, taps[9];
    int64_t x = -1, y = -1, passes = 0, not_finite = -1;
    fill_noise(in, N);
    wfpsf_varying_ipc *varying = from_maps();
    wfpsf_image *from = wrap(in, NX, NY), *to = wrap(out, NX, NY), *again = wrap(back, NX, NY);
    CHECK_OK(wfpsf_varying_ipc_apply(varying, from, WFPSF_EDGE_ZERO, NULL, to, &not_finite));
    CHECK(not_finite == 0);
    check_record(to, 1, 0, WFPSF_EFFECT_IPC);
    for (int p = 0; p < N; ++p)
        CHECK_NEAR(out[p], scattered(in, p % NX, p / NX), 65535 * 1e-15);
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "interpixel",
                wfpsf_varying_ipc_apply(varying, to, WFPSF_EDGE_ZERO, NULL, again, NULL));
    CHECK_OK(wfpsf_varying_ipc_correct(varying, to, WFPSF_EDGE_ZERO, NULL, again, &residual, &noise,
                                       &passes, &not_finite));
    check_record(again, 1, 0, WFPSF_EFFECT_IPC | WFPSF_EFFECT_IPC_CORRECTION);
    for (int p = 0; p < N; ++p)
        CHECK_NEAR(back[p], in[p], 65535 * 1e-14);
    CHECK(residual < 1e-14 && noise > 1 && noise < 1.3 && passes > 0 && not_finite == 0);
    CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "correction",
                wfpsf_varying_ipc_correct(varying, again, WFPSF_EDGE_ZERO, NULL, to, NULL, NULL,
                                          NULL, NULL));

    CHECK_OK(wfpsf_varying_ipc_margin(varying, &margin, &x, &y));
    CHECK(x == NX - 1 && y == NY - 1);
    CHECK_NEAR(margin, 1 - 8 * ramp[N - 1], 1e-15);
    wfpsf_ipc_kernel *kernel = NULL;
    CHECK_OK(wfpsf_varying_ipc_kernel(varying, 3, 2, &kernel));
    CHECK_OK(wfpsf_ipc_kernel_taps(kernel, 9, taps, NULL, NULL));
    CHECK(taps[1] == ramp[2 * NX + 3] && taps[0] == primes[2 * NX + 3]);
    wfpsf_ipc_kernel_destroy(kernel);
    wfpsf_image_destroy(from);
    wfpsf_image_destroy(to);
    wfpsf_image_destroy(again);
    wfpsf_varying_ipc_destroy(varying);
    wfpsf_varying_ipc_destroy(NULL);
}

/* Polynomials and regions of one kernel are that kernel, in both forms and in a chain. */
static void test_one_kernel(void) {
    const double alpha[3] = {0.02, 0, 0}, prime[3] = {0.002, 0, 0}, plus[3] = {0.001, 0, 0};
    double in[N], out[N], wanted[N];
    wfpsf_varying_ipc *varying[2] = {NULL, NULL};
    wfpsf_ipc_kernel *kernel = NULL;
    wfpsf_options *options = NULL;
    wfpsf_image *regions = map_of(labels), *from = wrap(in, NX, NY);
    fill_noise(in, N);
    fill(labels, N, 0);
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_THREADS, 3));
    CHECK_OK(wfpsf_ipc_kernel_create(0.02, 0.002, 0.001, NULL, &kernel));
    const wfpsf_ipc_kernel *const kernels[1] = {kernel};
    CHECK_OK(
        wfpsf_varying_ipc_create_polynomials(NX, NY, 1, alpha, prime, plus, NULL, &varying[0]));
    CHECK_OK(wfpsf_varying_ipc_create_regions(regions, 1, kernels, &varying[1]));
    for (int kind = 0; kind < 2; ++kind)
        for (int form = WFPSF_IPC_SCATTER; form <= WFPSF_IPC_GATHER; ++form) {
            wfpsf_image *to = wrap(out, NX, NY), *right = wrap(wanted, NX, NY);
            CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_IPC_FORM, form));
            CHECK_OK(wfpsf_ipc_apply(kernel, from, WFPSF_EDGE_REPLICATE, options, right, NULL));
            CHECK_OK(wfpsf_varying_ipc_apply(varying[kind], from, WFPSF_EDGE_REPLICATE, options, to,
                                             NULL));
            for (int p = 0; p < N; ++p)
                CHECK_NEAR(out[p], wanted[p], 65535 * 4e-16);
            wfpsf_chain *chain = NULL;
            CHECK_OK(wfpsf_chain_create(&chain));
            CHECK_OK(wfpsf_chain_add_varying_ipc(chain, varying[kind], form, WFPSF_EDGE_REPLICATE));
            CHECK_FAILS(WFPSF_ERROR_ALREADY_APPLIED, "ipc",
                        wfpsf_chain_add_ipc(chain, kernel, WFPSF_EDGE_ZERO));
            CHECK_OK(wfpsf_image_copy(from, right));
            CHECK_OK(wfpsf_image_set_record(right, 1, 0, 0));
            CHECK_OK(wfpsf_chain_apply(chain, right, 0, NULL, options, NULL, NULL));
            CHECK(are_equal(wanted, out, N));
            check_record(right, 1, 0, WFPSF_EFFECT_IPC);
            wfpsf_image *small = wrap(in, NX, NY - 1);
            CHECK_FAILS(WFPSF_ERROR_SIZE, "13 x 9",
                        wfpsf_chain_apply(chain, small, 0, NULL, NULL, NULL, NULL));
            wfpsf_image_destroy(small);
            CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "form = 2",
                        wfpsf_chain_add_varying_ipc(chain, varying[kind], 2, WFPSF_EDGE_ZERO));
            CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "edge = 5",
                        wfpsf_chain_add_varying_ipc(chain, varying[kind], 0, WFPSF_EDGE_VALID));
            CHECK_FAILS(WFPSF_ERROR_NULL, "varying",
                        wfpsf_chain_add_varying_ipc(chain, NULL, 0, WFPSF_EDGE_ZERO));
            CHECK_FAILS(WFPSF_ERROR_NULL, "chain",
                        wfpsf_chain_add_varying_ipc(NULL, varying[kind], 0, WFPSF_EDGE_ZERO));
            wfpsf_chain_destroy(chain);
            wfpsf_image_destroy(to);
            wfpsf_image_destroy(right);
        }
    wfpsf_varying_ipc_destroy(varying[0]);
    wfpsf_varying_ipc_destroy(varying[1]);
    wfpsf_ipc_kernel_destroy(kernel);
    wfpsf_options_destroy(options);
    wfpsf_image_destroy(regions);
    wfpsf_image_destroy(from);
}

/* The share of pixel q's charge that pixel p reads, no charge outside. */
static double share(int p, int q) {
    const int dx = abs(p % NX - q % NX), dy = abs(p / NX - q / NX);
    if (dx > 1 || dy > 1)
        return 0;
    return dx && dy ? primes[q] : dx || dy ? ramp[q] : 1 - 4 * (ramp[q] + primes[q]);
}

static void test_covariance(void) {
    double given[N], out[N], table[25], white[25];
    int64_t nx = 0, ny = 0;
    fill_noise(given, N);
    wfpsf_varying_ipc *varying = from_maps();
    wfpsf_image *variance = wrap(given, NX, NY), *to = wrap(out, NX, NY);
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    for (int form = WFPSF_IPC_SCATTER; form <= WFPSF_IPC_GATHER; ++form) {
        CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_IPC_FORM, form));
        CHECK_OK(
            wfpsf_varying_ipc_covariance(varying, variance, 1, 0, WFPSF_EDGE_ZERO, options, to));
        check_record(to, 1, 0, 0);
        for (int p = 0; p < N; ++p) {
            double sum = 0;
            for (int q = 0; q < N && p % NX < NX - 1; ++q)
                sum += given[q] *
                       (form ? share(q, p) * share(q, p + 1) : share(p, q) * share(p + 1, q));
            CHECK_NEAR(out[p], sum, 65535 * 1e-15);
        }
        CHECK_OK(wfpsf_varying_ipc_autocorrelation(varying, variance, 3, 2, WFPSF_EDGE_ZERO,
                                                   options, 25, table, &nx, &ny));
        CHECK(nx == 5 && ny == 5);
        CHECK_NEAR(table[2 * 5 + 3], out[2 * NX + 3], 65535 * 1e-15);
        CHECK_NEAR(table[2 * 5 + 1], out[2 * NX + 2], 65535 * 1e-15);
    }
    CHECK_OK(wfpsf_varying_ipc_autocorrelation(varying, NULL, 0, 0, WFPSF_EDGE_ZERO, NULL, 25,
                                               white, NULL, NULL));
    CHECK(white[0] == 0 && white[12] > 0.8 && white[12] < 1);
    nx = 0;
    CHECK_OK(wfpsf_varying_ipc_autocorrelation(varying, NULL, 0, 0, WFPSF_EDGE_ZERO, NULL, 0, NULL,
                                               &nx, NULL));
    CHECK(nx == 5);

    CHECK_FAILS(WFPSF_ERROR_NULL, "varying",
                wfpsf_varying_ipc_covariance(NULL, variance, 0, 0, 0, NULL, to));
    CHECK_FAILS(WFPSF_ERROR_NULL, "variance",
                wfpsf_varying_ipc_covariance(varying, NULL, 0, 0, 0, NULL, to));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out",
                wfpsf_varying_ipc_covariance(varying, variance, 0, 0, 0, NULL, NULL));
    CHECK_FAILS(
        WFPSF_ERROR_ARGUMENT, "edge = 1",
        wfpsf_varying_ipc_covariance(varying, variance, 0, 0, WFPSF_EDGE_REPLICATE, NULL, to));
    CHECK_FAILS(
        WFPSF_ERROR_NULL, "varying",
        wfpsf_varying_ipc_autocorrelation(NULL, NULL, 0, 0, 0, NULL, 25, table, NULL, NULL));
    CHECK_FAILS(
        WFPSF_ERROR_NULL, "covariances",
        wfpsf_varying_ipc_autocorrelation(varying, NULL, 0, 0, 0, NULL, 25, NULL, NULL, NULL));
    CHECK_FAILS(
        WFPSF_ERROR_SIZE, "capacity = 24",
        wfpsf_varying_ipc_autocorrelation(varying, NULL, 0, 0, 0, NULL, 24, table, NULL, NULL));
    CHECK_FAILS(
        WFPSF_ERROR_RANGE, "(13, 0)",
        wfpsf_varying_ipc_autocorrelation(varying, NULL, NX, 0, 0, NULL, 25, table, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "edge = 4",
                wfpsf_varying_ipc_autocorrelation(varying, NULL, 0, 0, WFPSF_EDGE_FILL, NULL, 25,
                                                  table, NULL, NULL));
    wfpsf_image *small = wrap(given, NX, 3);
    CHECK_FAILS(
        WFPSF_ERROR_SIZE, "13 x 3",
        wfpsf_varying_ipc_autocorrelation(varying, small, 0, 0, 0, NULL, 25, table, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "13 x 3",
                wfpsf_varying_ipc_covariance(varying, small, 0, 0, 0, NULL, small));
    CHECK_OK(wfpsf_image_set_record(variance, 2, 0, 0));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "variance: oversampling = 2",
                wfpsf_varying_ipc_covariance(varying, variance, 0, 0, 0, NULL, to));
    wfpsf_options_destroy(options);
    wfpsf_image_destroy(small);
    wfpsf_image_destroy(variance);
    wfpsf_image_destroy(to);
    wfpsf_varying_ipc_destroy(varying);
}

static void test_not_finite(void) {
    double in[N], out[N];
    int64_t not_finite = -1;
    fill(in, N, 1);
    in[4 * NX + 4] = NAN;
    wfpsf_varying_ipc *varying = from_maps();
    wfpsf_image *from = wrap(in, NX, NY), *to = wrap_flipped(out, NX, NY);
    CHECK_OK(wfpsf_varying_ipc_apply(varying, from, WFPSF_EDGE_WRAP, NULL, to, &not_finite));
    CHECK(not_finite == 9);
    CHECK_OK(wfpsf_image_set_record(from, 1, 0, 0));
    CHECK_OK(wfpsf_varying_ipc_correct(varying, from, WFPSF_EDGE_WRAP, NULL, to, NULL, NULL, NULL,
                                       &not_finite));
    CHECK(not_finite == 1);
    wfpsf_image_destroy(from);
    wfpsf_image_destroy(to);
    wfpsf_varying_ipc_destroy(varying);
}

static void test_bad_arguments(void) {
    double data[N];
    const double zero[1] = {0};
    wfpsf_varying_ipc *out = STALE(wfpsf_varying_ipc);
    wfpsf_image *alpha = map_of(ramp), *small = wrap(data, 3, 3), *fine = NULL;
    wfpsf_ipc_kernel *kernel = STALE(wfpsf_ipc_kernel);
    const wfpsf_ipc_kernel *const none[1] = {NULL};
    double margin = 7;
    fill(data, N, 0);
    CHECK_FAILS(WFPSF_ERROR_NULL, "alpha",
                wfpsf_varying_ipc_create_maps(NULL, NULL, NULL, NULL, &out));
    CHECK(out == NULL);
    CHECK_FAILS(WFPSF_ERROR_NULL, "out",
                wfpsf_varying_ipc_create_maps(alpha, NULL, NULL, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "3 x 3",
                wfpsf_varying_ipc_create_maps(alpha, small, NULL, NULL, &out));
    data[4] = NAN;
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "alpha(1, 1)",
                wfpsf_varying_ipc_create_maps(small, NULL, NULL, NULL, &out));
    data[4] = 0.3;
    CHECK_FAILS(WFPSF_ERROR_KERNEL, "pixel (1, 1)",
                wfpsf_varying_ipc_create_maps(small, NULL, NULL, NULL, &out));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "degree = -1",
                wfpsf_varying_ipc_create_polynomials(3, 3, -1, zero, NULL, NULL, NULL, &out));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "-3 x 3",
                wfpsf_varying_ipc_create_polynomials(-3, 3, 0, zero, NULL, NULL, NULL, &out));
    CHECK_FAILS(WFPSF_ERROR_NULL, "alpha",
                wfpsf_varying_ipc_create_polynomials(3, 3, 0, NULL, NULL, NULL, NULL, &out));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "count = -1",
                wfpsf_varying_ipc_create_regions(alpha, -1, none, &out));
    CHECK_FAILS(WFPSF_ERROR_NULL, "kernels",
                wfpsf_varying_ipc_create_regions(alpha, 1, none, &out));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "regions(0, 0)",
                wfpsf_varying_ipc_create_regions(alpha, 0, NULL, &out));
    CHECK(out == NULL);

    wfpsf_varying_ipc *varying = from_maps();
    CHECK_FAILS(WFPSF_ERROR_RANGE, "(13, 0)", wfpsf_varying_ipc_kernel(varying, NX, 0, &kernel));
    CHECK(kernel == NULL);
    CHECK_FAILS(WFPSF_ERROR_NULL, "varying", wfpsf_varying_ipc_margin(NULL, &margin, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "margin", wfpsf_varying_ipc_margin(varying, NULL, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "3 x 3",
                wfpsf_varying_ipc_apply(varying, small, WFPSF_EDGE_ZERO, NULL, small, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "edge = 6",
                wfpsf_varying_ipc_apply(varying, alpha, 6, NULL, alpha, NULL));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "edge = 3",
                wfpsf_varying_ipc_correct(varying, alpha, WFPSF_EDGE_CROP, NULL, alpha, NULL, NULL,
                                          NULL, NULL));
    fine = wrap_strided(data, NX, NY, 1, NX, 2);
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "oversampling = 2",
                wfpsf_varying_ipc_apply(varying, fine, WFPSF_EDGE_ZERO, NULL, fine, NULL));
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_IPC_LEAST_MARGIN, 0.9));
    CHECK_FAILS(WFPSF_ERROR_KERNEL_SINGULAR, "pixel (12, 8)",
                wfpsf_varying_ipc_correct(varying, alpha, WFPSF_EDGE_ZERO, options, alpha, NULL,
                                          NULL, NULL, NULL));
    wfpsf_options_destroy(options);
    wfpsf_varying_ipc_destroy(varying);
    wfpsf_image_destroy(alpha);
    wfpsf_image_destroy(small);
    wfpsf_image_destroy(fine);
}

int main(void) {
    for (int p = 0; p < N; ++p) {
        ramp[p] = 0.01 + 0.0001 * p;
        primes[p] = 0.001 + 0.00001 * (p % 7);
    }
    test_maps();
    test_one_kernel();
    test_covariance();
    test_not_finite();
    test_bad_arguments();
    return checked();
}
