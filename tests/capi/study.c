/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The study of the paper: its tables by key, the paper's figures in them, and what is refused. */
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static double number(const wfpsf_study *study, int32_t table, int64_t row, const char *column) {
    double value = -1;
    int64_t columns = 0;
    CHECK_OK(wfpsf_study_size(study, table, NULL, &columns));
    for (int64_t c = 0; c < columns; ++c)
        if (strcmp(wfpsf_study_column(study, table, c), column) == 0)
            CHECK_OK(wfpsf_study_value(study, table, row, c, &value));
    return value;
}

static void test_tables(const wfpsf_study *study) {
    static const struct {
        int32_t key;
        const char *file;
    } tables[] = {
#define TABLE(name, key, file, text) {key, file},
        WFPSF_STUDY_TABLE_LIST(TABLE)
#undef TABLE
    };
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; ++i) {
        int64_t rows = 0, columns = 0;
        CHECK_OK(wfpsf_study_size(study, tables[i].key, &rows, &columns));
        CHECK(rows > 0 && columns > 1);
        CHECK(wfpsf_study_column(study, tables[i].key, columns - 1) != NULL);
        CHECK(wfpsf_study_column(study, tables[i].key, columns) == NULL);
    }
    CHECK(strcmp(wfpsf_study_text(study, WFPSF_STUDY_BANDS, 2, 0), "J129") == 0);
    CHECK_NEAR(number(study, WFPSF_STUDY_BANDS, 2, "effective_nm"), 1292.11, 5e-3);
    CHECK(wfpsf_study_text(study, WFPSF_STUDY_BANDS, 2, 1) == NULL);
    double value = 0;
    CHECK_OK(wfpsf_study_value(study, WFPSF_STUDY_BANDS, 2, 0, &value));
    CHECK(isnan(value));

    int64_t rows = 0;
    CHECK_OK(wfpsf_study_size(study, WFPSF_STUDY_COMPARISON, &rows, NULL));
    for (int64_t row = 0; row < rows; ++row) {
        const double off = number(study, WFPSF_STUDY_COMPARISON, row, "paper_off_percent");
        const char *reason = wfpsf_study_text(study, WFPSF_STUDY_COMPARISON, row, 9);
        CHECK((strlen(reason) > 0) == (fabs(off) > 1));
    }
}

static void test_csv(const wfpsf_study *study) {
    char folder[] = "/tmp/wfpsf_study_XXXXXX", path[64];
    CHECK(mkdtemp(folder) != NULL);
    CHECK_OK(wfpsf_study_write_csv(study, folder));
    CHECK_OK(wfpsf_study_write_csv(study, folder));
#define REMOVE(name, key, file, text)                                                              \
    snprintf(path, sizeof path, "%s/%s.csv", folder, file);                                        \
    CHECK(unlink(path) == 0);
    WFPSF_STUDY_TABLE_LIST(REMOVE)
#undef REMOVE
    CHECK(rmdir(folder) == 0);
    CHECK_FAILS(WFPSF_ERROR_FILE_WRITE, folder, wfpsf_study_write_csv(study, folder));
    CHECK_FAILS(WFPSF_ERROR_NULL, "folder", wfpsf_study_write_csv(study, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "study", wfpsf_study_write_csv(NULL, "."));
}

static void test_refused(const wfpsf_study *study, const wfpsf_instrument *instrument) {
    double value = 7;
    int64_t rows = 7;
    CHECK_FAILS(WFPSF_ERROR_NULL, "study", wfpsf_study_size(NULL, WFPSF_STUDY_BANDS, &rows, NULL));
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "99", wfpsf_study_size(study, 99, &rows, NULL));
    CHECK(rows == 7);
    CHECK_STATUS(WFPSF_ERROR_NULL, wfpsf_study_value(NULL, WFPSF_STUDY_BANDS, 0, 0, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "value", wfpsf_study_value(study, WFPSF_STUDY_BANDS, 0, 0, NULL));
    CHECK_STATUS(WFPSF_ERROR_UNKNOWN_NAME, wfpsf_study_value(study, -1, 0, 0, &value));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "row = 6",
                wfpsf_study_value(study, WFPSF_STUDY_BANDS, 6, 0, &value));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "column = -1",
                wfpsf_study_value(study, WFPSF_STUDY_BANDS, 0, -1, &value));
    CHECK(value == 7);
    CHECK(wfpsf_study_column(NULL, WFPSF_STUDY_BANDS, 0) == NULL);
    CHECK(wfpsf_study_column(study, 99, 0) == NULL);
    CHECK(wfpsf_study_column(study, WFPSF_STUDY_BANDS, -1) == NULL);
    CHECK(wfpsf_study_text(NULL, WFPSF_STUDY_BANDS, 0, 0) == NULL);
    CHECK(wfpsf_study_text(study, WFPSF_STUDY_BANDS, 6, 0) == NULL);
    CHECK(wfpsf_study_text(study, WFPSF_STUDY_BANDS, 0, 99) == NULL);

    wfpsf_study *out = (wfpsf_study *)1;
    CHECK_FAILS(WFPSF_ERROR_NULL, "instrument", wfpsf_study_create(NULL, 7, NULL, &out));
    CHECK(out == NULL);
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_study_create(instrument, 7, NULL, NULL));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 0", wfpsf_study_create(instrument, 0, NULL, &out));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "sca = 19", wfpsf_study_create(instrument, 19, NULL, &out));
    CHECK(out == NULL);
    wfpsf_study_destroy(NULL);
}

static int32_t stop_late(double part, void *user) {
    *(double *)user = part;
    return part > 0.75;
}

static void test_cancelled(const wfpsf_instrument *instrument, wfpsf_options *options) {
    wfpsf_study *out = (wfpsf_study *)1;
    double part = 0;
    CHECK_OK(wfpsf_options_set_progress(options, stop_late, &part));
    CHECK_STATUS(WFPSF_ERROR_CANCELLED, wfpsf_study_create(instrument, 7, options, &out));
    CHECK(out == NULL && part > 0.75 && part < 1);
}

/* EPS 1e-12 is beyond what figures are sure of: the study comes with a warning, and whole. */
static void test_not_certified(const wfpsf_instrument *instrument, wfpsf_options *options) {
    wfpsf_study *study = NULL;
    CHECK_OK(wfpsf_options_set_progress(options, NULL, NULL));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-12));
    CHECK_FAILS(WFPSF_WARNING_NOT_CERTIFIED, "EPS = 1e-12",
                wfpsf_study_create(instrument, 7, options, &study));
    CHECK(number(study, WFPSF_STUDY_SIZES, 0, "error_estimate") > 0);
    wfpsf_study_destroy(study);
}

int main(void) {
    wfpsf_instrument *instrument = NULL;
    wfpsf_options *options = NULL;
    wfpsf_study *study = NULL;
    CHECK_OK(wfpsf_instrument_create("wfirst-afta-c5", &instrument));
    CHECK_OK(wfpsf_options_create(&options));
    CHECK_OK(wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-5));
    CHECK_OK(wfpsf_study_create(instrument, 7, options, &study));
    test_tables(study);
    test_csv(study);
    test_refused(study, instrument);
    test_cancelled(instrument, options);
    test_not_certified(instrument, options);
    wfpsf_study_destroy(study);
    wfpsf_options_destroy(options);
    wfpsf_instrument_destroy(instrument);
    return checked();
}
