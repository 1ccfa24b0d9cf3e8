/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Images: making, wrapping, their record, copying. */
#include "pixels.h"

static void check_shape(const wfpsf_image *image, int32_t pixel_type, int64_t nx, int64_t ny) {
    int32_t got_type = 0;
    int64_t got_nx = -1, got_ny = -1;
    CHECK_OK(wfpsf_image_shape(image, &got_type, &got_nx, &got_ny));
    CHECK(got_type == pixel_type && got_nx == nx && got_ny == ny);
}

static void test_create(void) {
    static const int64_t sizes[][2] = {{0, 0}, {0, 5}, {5, 0}, {1, 1}, {1, 7}, {7, 1}, {32, 33}};
    static const int32_t types[] = {WFPSF_FLOAT32, WFPSF_FLOAT64};
    wfpsf_image *image = NULL;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i)
        for (size_t t = 0; t < 2; ++t) {
            CHECK_OK(wfpsf_image_create(types[t], sizes[i][0], sizes[i][1], 3, &image));
            check_shape(image, types[t], sizes[i][0], sizes[i][1]);
            check_record(image, 3, 0, 0);
            CHECK_OK(wfpsf_image_shape(image, NULL, NULL, NULL));
            wfpsf_image_destroy(image);
        }
    wfpsf_image_destroy(NULL);
}

static void check_refused(wfpsf_status status, const char *culprit, int32_t pixel_type, int64_t nx,
                          int64_t ny, int64_t oversampling) {
    wfpsf_image *image = STALE(wfpsf_image);
    CHECK_FAILS(status, culprit, wfpsf_image_create(pixel_type, nx, ny, oversampling, &image));
    CHECK(image == NULL);
    double pixel = 0;
    image = STALE(wfpsf_image);
    CHECK_FAILS(status, culprit,
                wfpsf_image_wrap(pixel_type, &pixel, nx, ny, 1, 1, oversampling, &image));
    CHECK(image == NULL);
}

static void test_create_refuses(void) {
    check_refused(WFPSF_ERROR_ARGUMENT, "pixel_type = 33", 33, 1, 1, 1);
    check_refused(WFPSF_ERROR_ARGUMENT, "pixel_type = 0", 0, 1, 1, 1);
    check_refused(WFPSF_ERROR_SIZE, "nx = -1", WFPSF_FLOAT64, -1, 1, 1);
    check_refused(WFPSF_ERROR_SIZE, "ny = -1", WFPSF_FLOAT64, 1, -1, 1);
    check_refused(WFPSF_ERROR_SIZE, "nx", WFPSF_FLOAT64, INT64_MIN, 1, 1);
    check_refused(WFPSF_ERROR_SIZE, "9223372036854775807", WFPSF_FLOAT64, INT64_MAX, INT64_MAX, 1);
    check_refused(WFPSF_ERROR_SIZE, "4611686018427387904", WFPSF_FLOAT32, INT64_C(1) << 62, 4, 1);
    check_refused(WFPSF_ERROR_RANGE, "oversampling = 0", WFPSF_FLOAT64, 1, 1, 0);
    check_refused(WFPSF_ERROR_RANGE, "oversampling = -3", WFPSF_FLOAT64, 1, 1, -3);
    check_refused(WFPSF_ERROR_RANGE, "oversampling = 4294967297", WFPSF_FLOAT64, 1, 1,
                  INT64_C(4294967297));
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_image_create(WFPSF_FLOAT64, 1, 1, 1, NULL));
    double pixel = 0;
    CHECK_FAILS(WFPSF_ERROR_NULL, "out",
                wfpsf_image_wrap(WFPSF_FLOAT64, &pixel, 1, 1, 1, 1, 1, NULL));
}

static void check_strides_refused(wfpsf_status status, const char *culprit, void *data, int64_t nx,
                                  int64_t ny, int64_t stride_x, int64_t stride_y) {
    wfpsf_image *image = STALE(wfpsf_image);
    CHECK_FAILS(status, culprit,
                wfpsf_image_wrap(WFPSF_FLOAT64, data, nx, ny, stride_x, stride_y, 1, &image));
    CHECK(image == NULL);
}

static void test_wrap_refuses(void) {
    double data[64] = {0};
    check_strides_refused(WFPSF_ERROR_NULL, "data", NULL, 3, 3, 1, 3);
    check_strides_refused(WFPSF_ERROR_SIZE, "stride_x = 0", data, 3, 3, 0, 3);
    check_strides_refused(WFPSF_ERROR_SIZE, "stride_y = 0", data, 3, 3, 1, 0);
    check_strides_refused(WFPSF_ERROR_SIZE, "stride_y = 2", data, 3, 3, 1, 2);
    check_strides_refused(WFPSF_ERROR_SIZE, "stride_y = -1", data, 3, 3, 1, -1);
    check_strides_refused(WFPSF_ERROR_SIZE, "stride_x = 9223372036854775807", data, 3, 3, INT64_MAX,
                          1);
    check_strides_refused(WFPSF_ERROR_SIZE, "stride_y = -9223372036854775808", data, 3, 3, 1,
                          INT64_MIN);
    check_strides_refused(WFPSF_ERROR_ARGUMENT, "data", (char *)data + 1, 3, 3, 1, 3);
}

static void test_wrap(void) {
    double data[12], copy[12];
    for (int i = 0; i < 12; ++i)
        data[i] = i;
    /* 4 x 3 pixels: as they lie, transposed, and from the other corner */
    wfpsf_image *plain = wrap(data, 4, 3), *to = wrap(copy, 4, 3);
    CHECK_OK(wfpsf_image_copy(plain, to));
    CHECK(are_equal(copy, data, 12));
    wfpsf_image_destroy(plain);
    plain = wrap_flipped(data, 4, 3);
    CHECK_OK(wfpsf_image_copy(plain, to));
    for (int i = 0; i < 12; ++i)
        CHECK(copy[i] == 11 - i);
    wfpsf_image_destroy(plain);
    wfpsf_image_destroy(to);
    plain = wrap_strided(data, 3, 4, 4, 1, 1);
    to = wrap(copy, 3, 4);
    CHECK_OK(wfpsf_image_copy(plain, to));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 3; ++x)
            CHECK(copy[y * 3 + x] == data[x * 4 + y]);
    wfpsf_image_destroy(plain);
    wfpsf_image_destroy(to);

    /* one pixel needs no strides, an empty image no memory */
    wfpsf_image_destroy(wrap_strided(data, 1, 1, 0, 0, 1));
    wfpsf_image_destroy(wrap_strided(NULL, 0, 4, 1, 1, 1));
    wfpsf_image_destroy(wrap_strided(NULL, 0, 0, 0, 0, 1));
}

static void test_record(void) {
    const int32_t all =
        WFPSF_EFFECT_PIXEL_RESPONSE | WFPSF_EFFECT_IPC | WFPSF_EFFECT_IPC_CORRECTION;
    double data[4] = {0};
    wfpsf_image *image = wrap(data, 2, 2);
    check_record(image, 1, 0, 0);
    CHECK_OK(wfpsf_image_set_record(image, 32, 0.11, all));
    check_record(image, 32, 0.11, all);

    CHECK_FAILS(WFPSF_ERROR_RANGE, "oversampling = 0", wfpsf_image_set_record(image, 0, 1, 0));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "pixel_scale_arcsec = -1",
                wfpsf_image_set_record(image, 1, -1, 0));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "pixel_scale_arcsec = nan",
                wfpsf_image_set_record(image, 1, NAN, 0));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "pixel_scale_arcsec = inf",
                wfpsf_image_set_record(image, 1, HUGE_VAL, 0));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "applied = 16384",
                wfpsf_image_set_record(image, 1, 1, 16384));
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "applied = -1", wfpsf_image_set_record(image, 1, 1, -1));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_image_set_record(NULL, 1, 1, 0));
    check_record(image, 32, 0.11, all);
    CHECK_OK(wfpsf_image_record(image, NULL, NULL, NULL));
    wfpsf_image_destroy(image);

    int32_t type = 7, applied = 7;
    int64_t nx = 7, ny = 7, oversampling = 7;
    double scale = 7;
    CHECK_FAILS(WFPSF_ERROR_NULL, "image", wfpsf_image_shape(NULL, &type, &nx, &ny));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image",
                wfpsf_image_record(NULL, &oversampling, &scale, &applied));
    CHECK(type == 7 && nx == 7 && ny == 7 && oversampling == 7 && scale == 7 && applied == 7);
}

static void test_copy(void) {
    double data[6] = {0.1, 2, -3, NAN, HUGE_VAL, 1e-300}, back[6], other[8];
    float narrow[6];
    wfpsf_image *from = wrap(data, 3, 2), *single = wrap_float(narrow, 3, 2),
                *to = wrap(back, 3, 2);
    CHECK_OK(wfpsf_image_set_record(from, 4, 0.5, WFPSF_EFFECT_IPC));
    CHECK_OK(wfpsf_image_copy(from, single));
    CHECK_OK(wfpsf_image_copy(single, to));
    check_record(single, 4, 0.5, WFPSF_EFFECT_IPC);
    check_record(to, 4, 0.5, WFPSF_EFFECT_IPC);
    CHECK(back[0] == (double)0.1f && back[1] == 2 && back[2] == -3 && isnan(back[3]) &&
          back[4] == HUGE_VAL && back[5] == 0);

    fill(other, 8, 7);
    wfpsf_image *larger = wrap(other, 4, 2), *shifted = wrap(data + 1, 2, 2),
                *square = wrap(data, 2, 2), *transposed = wrap(other, 2, 3);
    CHECK_FAILS(WFPSF_ERROR_SIZE, "4 x 2", wfpsf_image_copy(from, larger));
    CHECK_FAILS(WFPSF_ERROR_SIZE, "2 x 3", wfpsf_image_copy(from, transposed));
    CHECK_FAILS(WFPSF_ERROR_OVERLAP, "from", wfpsf_image_copy(from, from));
    CHECK_FAILS(WFPSF_ERROR_OVERLAP, "from", wfpsf_image_copy(square, shifted));
    CHECK_FAILS(WFPSF_ERROR_NULL, "from", wfpsf_image_copy(NULL, larger));
    CHECK_FAILS(WFPSF_ERROR_NULL, "to", wfpsf_image_copy(from, NULL));
    CHECK(all_are(other, 8, 7) && data[1] == 2);
    check_record(larger, 1, 0, 0);

    wfpsf_image *none = wrap(NULL, 0, 3), *nothing = wrap(NULL, 0, 3);
    CHECK_OK(wfpsf_image_copy(none, nothing));
    wfpsf_image *const all[] = {from,   single,     to,   larger, shifted,
                                square, transposed, none, nothing};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i)
        wfpsf_image_destroy(all[i]);
}

int main(void) {
    test_create();
    test_create_refuses();
    test_wrap_refuses();
    test_wrap();
    test_record();
    test_copy();
    return checked();
}
