/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Status codes are pinned and named; the last-error line is cut to fit, and each thread's own. */
#include "check.h"

#include <pthread.h>

struct pinned {
    const char *name;
    wfpsf_status value;
};

static const struct pinned pinned[] = {
    {"WFPSF_OK", 0},
    {"WFPSF_WARNING_NOT_CONVERGED", 100},
    {"WFPSF_WARNING_NOT_CERTIFIED", 110},
    {"WFPSF_WARNING_RESTARTED", 120},
    {"WFPSF_WARNING_NEAR_DEGENERATE", 130},
    {"WFPSF_WARNING_UNDERSAMPLED", 140},
    {"WFPSF_ERROR_NULL", -10},
    {"WFPSF_ERROR_ARGUMENT", -20},
    {"WFPSF_ERROR_RANGE", -30},
    {"WFPSF_ERROR_SIZE", -40},
    {"WFPSF_ERROR_TYPE", -50},
    {"WFPSF_ERROR_NOT_FINITE", -60},
    {"WFPSF_ERROR_UNKNOWN_NAME", -70},
    {"WFPSF_ERROR_OVERLAP", -80},
    {"WFPSF_ERROR_ALREADY_APPLIED", -90},
    {"WFPSF_ERROR_KERNEL", -100},
    {"WFPSF_ERROR_KERNEL_SINGULAR", -110},
    {"WFPSF_ERROR_SKY_SUN", -120},
    {"WFPSF_ERROR_SUN_ANGLE", -130},
    {"WFPSF_ERROR_NO_WCS", -140},
    {"WFPSF_ERROR_FILE_OPEN", -200},
    {"WFPSF_ERROR_FILE_FORMAT", -210},
    {"WFPSF_ERROR_FILE_WRITE", -220},
    {"WFPSF_ERROR_MOMENTS_NO_PIXELS", -300},
    {"WFPSF_ERROR_MOMENTS_FLUX", -310},
    {"WFPSF_ERROR_MOMENTS_UNRESOLVED", -320},
    {"WFPSF_ERROR_MOMENTS_FILLS_IMAGE", -330},
    {"WFPSF_ERROR_MOMENTS_OUTSIDE", -340},
    {"WFPSF_ERROR_MOMENTS_STALLED", -350},
    {"WFPSF_ERROR_SIZE_NOT_REACHED", -400},
    {"WFPSF_ERROR_CANCELLED", -500},
    {"WFPSF_ERROR_MEMORY_LIMIT", -510},
    {"WFPSF_ERROR_NO_MEMORY", -900},
    {"WFPSF_ERROR_INTERNAL", -910},
    {"WFPSF_ERROR_ABI", -920},
};

static void test_list(void) {
    const size_t count = sizeof pinned / sizeof pinned[0];
    size_t listed = 0;
#define CHECK_CODE(name, value, text)                                                              \
    CHECK(strcmp(wfpsf_status_name(WFPSF_##name), "WFPSF_" #name) == 0);                           \
    CHECK(strcmp(wfpsf_status_string(WFPSF_##name), text) == 0);                                   \
    ++listed;
    WFPSF_STATUS_LIST(CHECK_CODE)
#undef CHECK_CODE
    CHECK(listed == count);
    for (size_t i = 0; i < count; ++i)
        CHECK(strcmp(wfpsf_status_name(pinned[i].value), pinned[i].name) == 0);
}

static void test_unknown_codes(void) {
    const wfpsf_status unknown[] = {1, -1, -11, 101, -1000, INT32_MAX, INT32_MIN};
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; ++i) {
        CHECK(strcmp(wfpsf_status_name(unknown[i]), "unknown status") == 0);
        CHECK(strcmp(wfpsf_status_string(unknown[i]), "unknown status") == 0);
    }
}

static void test_last_error_is_cut_to_fit(void) {
    char whole[1024], part[16];
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "key = 7",
                wfpsf_option_describe(7, NULL, NULL, NULL, NULL, NULL, NULL));
    const int64_t length = wfpsf_last_error(whole, sizeof whole);
    CHECK(length == (int64_t)strlen(whole) && length > 10);
    CHECK(wfpsf_last_error(NULL, 0) == length);
    CHECK(wfpsf_last_error(NULL, 10) == length);

    memset(part, '#', sizeof part);
    CHECK(wfpsf_last_error(part, 8) == length);
    CHECK(strlen(part) == 7 && memcmp(part, whole, 7) == 0 && part[8] == '#');
    CHECK(wfpsf_last_error(part, 1) == length);
    CHECK(part[0] == '\0' && part[1] == whole[1]);
    memset(part, '#', sizeof part);
    CHECK(wfpsf_last_error(part, 0) == length);
    CHECK(wfpsf_last_error(part, -5) == length);
    CHECK(part[0] == '#');

    CHECK_OK(wfpsf_check_version());
    CHECK(wfpsf_last_error(part, sizeof part) == length);
}

/* A culprit too long for the line leaves a line that is whole and closed all the same. */
static void test_long_culprit(void) {
    char name[5000], line[5000];
    wfpsf_instrument *out = NULL;
    memset(name, 'x', sizeof name);
    name[sizeof name - 1] = '\0';
    CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, "xxxx", wfpsf_instrument_create(name, &out));
    CHECK(wfpsf_last_error(line, sizeof line) == (int64_t)strlen(line));
}

static void *fail_in_a_thread(void *unused) {
    (void)unused;
    CHECK(wfpsf_last_error(NULL, 0) == 0);
    CHECK_FAILS(WFPSF_ERROR_ABI, "expected = 77", wfpsf_abi_check(77));
    return NULL;
}

static void test_each_thread_has_its_line(void) {
    pthread_t thread;
    CHECK_STATUS(WFPSF_ERROR_ABI, wfpsf_abi_check(55));
    CHECK(pthread_create(&thread, NULL, fail_in_a_thread, NULL) == 0);
    CHECK(pthread_join(thread, NULL) == 0);
    check_culprit("expected = 55", "after another thread failed", __FILE__, __LINE__);
}

int main(void) {
    CHECK(wfpsf_last_error(NULL, 0) == 0);
    test_list();
    test_unknown_codes();
    test_last_error_is_cut_to_fit();
    test_long_culprit();
    test_each_thread_has_its_line();
    return checked();
}
