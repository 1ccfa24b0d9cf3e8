/* SPDX-License-Identifier: GPL-3.0-or-later */
/* FITS images: round trips, bad files, and nothing left half-written. */
#include "pixels.h"

#include <dirent.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "capi_fits_XXXXXX";

static const char *path_of(const char *name) {
    static char path[4][512];
    static int next = 0;
    char *p = path[next++ % 4];
    snprintf(p, sizeof path[0], "%s/%s", folder, name);
    return p;
}

static int files_in(const char *place) {
    int count = 0;
    DIR *entries = opendir(place);
    for (struct dirent *e; entries && (e = readdir(entries)) != NULL;)
        count += e->d_name[0] != '.' || strlen(e->d_name) > 2;
    if (entries)
        closedir(entries);
    return count;
}

static void write_bytes(const char *path, const char *bytes, size_t count) {
    FILE *file = fopen(path, "wb");
    CHECK(file && fwrite(bytes, 1, count, file) == count);
    CHECK(file && fclose(file) == 0);
}

static void remove_all(void) {
    static const char *const names[] = {"plain.fits",     "packed.fits.gz", "single.fits",
                                        "truncated.fits", "text.fits",      "empty.fits",
                                        "a[1].fits",      "flipped.fits"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
        unlink(path_of(names[i]));
    CHECK(rmdir(folder) == 0);
}

static void test_round_trip(const char *name) {
    double data[35], back[35];
    fill_noise(data, 35);
    data[3] = NAN, data[4] = -HUGE_VAL, data[5] = 1e-310, data[6] = -0.1;
    wfpsf_image *image = wrap(data, 7, 5), *to = wrap(back, 7, 5), *read = NULL;
    CHECK_OK(
        wfpsf_image_set_record(image, 32, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE | WFPSF_EFFECT_IPC));
    CHECK_OK(wfpsf_image_write_fits(image, path_of(name), NULL));
    CHECK_OK(wfpsf_image_read_fits(path_of(name), NULL, 0, &read));
    int32_t type = 0;
    int64_t nx = 0, ny = 0;
    CHECK_OK(wfpsf_image_shape(read, &type, &nx, &ny));
    CHECK(type == WFPSF_FLOAT64 && nx == 7 && ny == 5);
    check_record(read, 32, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE | WFPSF_EFFECT_IPC);
    CHECK_OK(wfpsf_image_copy(read, to));
    for (int i = 0; i < 35; ++i)
        CHECK(back[i] == data[i] || (isnan(back[i]) && isnan(data[i])));
    wfpsf_image_destroy(read);

    /* the first HDU by number, as float32 */
    CHECK_OK(wfpsf_image_read_fits(path_of(name), "0", WFPSF_FLOAT32, &read));
    CHECK_OK(wfpsf_image_shape(read, &type, NULL, NULL));
    CHECK(type == WFPSF_FLOAT32);
    check_record(read, 32, 0.11, WFPSF_EFFECT_PIXEL_RESPONSE | WFPSF_EFFECT_IPC);
    wfpsf_image_destroy(read);
    wfpsf_image_destroy(image);
    wfpsf_image_destroy(to);
}

static void test_float_and_flipped(void) {
    float single[6] = {1, 2, 3, 4, 5, 6.5f};
    double data[6] = {1, 2, 3, 4, 5, 6.5}, back[6];
    int32_t type = 0;
    wfpsf_image *image = wrap_float(single, 3, 2), *read = NULL, *to = wrap(back, 3, 2);
    CHECK_OK(wfpsf_image_write_fits(image, path_of("single.fits"), NULL));
    CHECK_OK(wfpsf_image_read_fits(path_of("single.fits"), NULL, 0, &read));
    CHECK_OK(wfpsf_image_shape(read, &type, NULL, NULL));
    CHECK(type == WFPSF_FLOAT32);
    CHECK_OK(wfpsf_image_copy(read, to));
    CHECK(are_equal(back, data, 6));
    wfpsf_image_destroy(read);
    wfpsf_image_destroy(image);

    image = wrap_flipped(data, 3, 2);
    CHECK_OK(wfpsf_image_write_fits(image, path_of("flipped.fits"), NULL));
    CHECK_OK(wfpsf_image_read_fits(path_of("flipped.fits"), NULL, 0, &read));
    CHECK_OK(wfpsf_image_copy(read, to));
    for (int i = 0; i < 6; ++i)
        CHECK(back[i] == data[5 - i]);
    wfpsf_image_destroy(read);
    wfpsf_image_destroy(image);
    wfpsf_image_destroy(to);
}

static void check_unreadable(wfpsf_status status, const char *culprit, const char *path,
                             const char *hdu) {
    wfpsf_image *image = STALE(wfpsf_image);
    CHECK_FAILS(status, culprit, wfpsf_image_read_fits(path, hdu, 0, &image));
    CHECK(image == NULL);
}

static void test_bad_files(void) {
    static const char text[] = "This is no FITS file, however long it may go on.\n";
    char block[5760];
    check_unreadable(WFPSF_ERROR_FILE_OPEN, "absent.fits", path_of("absent.fits"), NULL);
    check_unreadable(WFPSF_ERROR_FILE_OPEN, "plain.fits[0]", path_of("plain.fits[0]"), NULL);
    check_unreadable(WFPSF_ERROR_FILE_OPEN, folder, folder, NULL);
    check_unreadable(WFPSF_ERROR_FILE_OPEN, "", "", NULL);
    write_bytes(path_of("text.fits"), text, sizeof text - 1);
    check_unreadable(WFPSF_ERROR_FILE_FORMAT, "text.fits", path_of("text.fits"), NULL);
    write_bytes(path_of("empty.fits"), "", 0);
    check_unreadable(WFPSF_ERROR_FILE_FORMAT, "empty.fits", path_of("empty.fits"), NULL);
    if (geteuid() != 0) {
        CHECK(chmod(path_of("text.fits"), 0) == 0);
        check_unreadable(WFPSF_ERROR_FILE_OPEN, "text.fits", path_of("text.fits"), NULL);
    }

    FILE *file = fopen(path_of("plain.fits"), "rb");
    CHECK(file && fread(block, 1, sizeof block, file) == sizeof block);
    CHECK(file && fclose(file) == 0);
    static const size_t lengths[] = {1, 79, 2000, 2880, 2881, 3100};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; ++i) {
        write_bytes(path_of("truncated.fits"), block, lengths[i]);
        check_unreadable(WFPSF_ERROR_FILE_FORMAT, "truncated.fits", path_of("truncated.fits"),
                         NULL);
    }

    check_unreadable(WFPSF_ERROR_FILE_FORMAT, "PSF", path_of("plain.fits"), "PSF");
    check_unreadable(WFPSF_ERROR_FILE_FORMAT, "HDU 3", path_of("plain.fits"), "3");
    check_unreadable(WFPSF_ERROR_FILE_FORMAT, "-1", path_of("plain.fits"), "-1");
    check_unreadable(WFPSF_ERROR_NULL, "path", NULL, NULL);
    CHECK_FAILS(WFPSF_ERROR_NULL, "out",
                wfpsf_image_read_fits(path_of("plain.fits"), NULL, 0, NULL));
    wfpsf_image *image = STALE(wfpsf_image);
    CHECK_FAILS(WFPSF_ERROR_ARGUMENT, "pixel_type = 16",
                wfpsf_image_read_fits(path_of("plain.fits"), NULL, 16, &image));
    CHECK(image == NULL);
}

static void test_write_refuses(void) {
    double data[4] = {1, 2, 3, 4}, back[35];
    wfpsf_image *image = wrap(data, 2, 2), *read = NULL, *to = wrap(back, 7, 5);
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    const int before = files_in(folder);
    CHECK_FAILS(WFPSF_ERROR_FILE_WRITE, "no/such/place.fits",
                wfpsf_image_write_fits(image, path_of("no/such/place.fits"), NULL));
    CHECK_FAILS(WFPSF_ERROR_FILE_WRITE, "plain.fits/inside.fits",
                wfpsf_image_write_fits(image, path_of("plain.fits/inside.fits"), NULL));
    CHECK_FAILS(WFPSF_ERROR_FILE_WRITE, folder, wfpsf_image_write_fits(image, folder, NULL));
    CHECK_STATUS(WFPSF_ERROR_FILE_WRITE, wfpsf_image_write_fits(image, "", NULL));
    CHECK_FAILS(WFPSF_ERROR_FILE_WRITE, "plain.fits",
                wfpsf_image_write_fits(image, path_of("plain.fits"), NULL));
    CHECK_FAILS(WFPSF_ERROR_FILE_WRITE, "plain.fits",
                wfpsf_image_write_fits(image, path_of("plain.fits"), options));
    CHECK_FAILS(WFPSF_ERROR_NULL, "image",
                wfpsf_image_write_fits(NULL, path_of("plain.fits"), NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "path", wfpsf_image_write_fits(image, NULL, NULL));
    if (geteuid() != 0) {
        CHECK(chmod(folder, 0555) == 0);
        CHECK_FAILS(WFPSF_ERROR_FILE_WRITE, "new.fits",
                    wfpsf_image_write_fits(image, path_of("new.fits"), NULL));
        CHECK(chmod(folder, 0755) == 0);
    }
    CHECK(files_in(folder) == before);

    /* the file that was there is as it was, until overwriting is allowed */
    CHECK_OK(wfpsf_image_read_fits(path_of("plain.fits"), NULL, 0, &read));
    CHECK_OK(wfpsf_image_copy(read, to));
    wfpsf_image_destroy(read);
    CHECK_OK(wfpsf_options_set_integer(options, WFPSF_OPTION_FITS_OVERWRITE, 1));
    CHECK_OK(wfpsf_image_write_fits(image, path_of("plain.fits"), options));
    CHECK(files_in(folder) == before);
    int64_t nx = 0;
    CHECK_OK(wfpsf_image_read_fits(path_of("plain.fits"), NULL, 0, &read));
    CHECK_OK(wfpsf_image_shape(read, NULL, &nx, NULL));
    CHECK(nx == 2);
    wfpsf_image_destroy(read);

    /* brackets and the like mean nothing */
    CHECK_OK(wfpsf_image_write_fits(image, path_of("a[1].fits"), NULL));
    CHECK_OK(wfpsf_image_read_fits(path_of("a[1].fits"), NULL, 0, &read));
    wfpsf_image_destroy(read);

    wfpsf_image_destroy(image);
    wfpsf_image_destroy(to);
    wfpsf_options_destroy(options);
}

int main(void) {
    CHECK(mkdtemp(folder) != NULL);
    test_round_trip("plain.fits");
    test_round_trip("packed.fits.gz");
    test_float_and_flipped();
    test_bad_files();
    test_write_refuses();
    remove_all();
    return checked();
}
