/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every option: its description, its bounds, its default, and back to it. */
#include "check.h"

#include <float.h>

struct listed {
    const char *name, *text;
    int32_t key, kind;
    double standard, smallest, largest;
};

static const struct listed list[] = {
#define LISTED(name, key, kind, standard, smallest, largest, text)                                 \
    {#name, text, key, WFPSF_OPTION_##kind, standard, smallest, largest},
    WFPSF_OPTION_LIST(LISTED)
#undef LISTED
};
static const size_t count = sizeof list / sizeof list[0];

static const int32_t unknown_keys[] = {0, 1, 99, 101, -100, INT32_MAX, INT32_MIN};

/* Equal, or both left to the library. */
static int same(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}

static double value_of(const wfpsf_options *options, int32_t key) {
    double value = -1;
    CHECK_OK(wfpsf_options_get(options, key, &value));
    return value;
}

static wfpsf_status set(wfpsf_options *options, const struct listed *o, double value) {
    return o->kind == WFPSF_OPTION_REAL
               ? wfpsf_options_set_real(options, o->key, value)
               : wfpsf_options_set_integer(options, o->key, (int64_t)value);
}

static void test_descriptions(void) {
    for (size_t i = 0; i < count; ++i) {
        const struct listed *o = &list[i];
        const char *name = NULL, *text = NULL;
        int32_t kind = 0;
        double standard = -1, smallest = -1, largest = -1;
        CHECK_OK(
            wfpsf_option_describe(o->key, &name, &text, &kind, &standard, &smallest, &largest));
        CHECK(strcmp(name, o->name) == 0 && strcmp(text, o->text) == 0);
        CHECK(kind == o->kind && same(standard, o->standard));
        CHECK(smallest == o->smallest && largest == o->largest && smallest <= largest);
        CHECK(isnan(standard) || (smallest <= standard && standard <= largest));
        CHECK_OK(wfpsf_option_describe(o->key, NULL, NULL, NULL, NULL, NULL, NULL));
        for (size_t j = 0; j < i; ++j)
            CHECK(list[j].key != o->key);
    }
    for (size_t i = 0; i < sizeof unknown_keys / sizeof unknown_keys[0]; ++i) {
        const char *name = "before", *text = "before";
        int32_t kind = 7;
        double standard = 7, smallest = 7, largest = 7;
        char culprit[32];
        snprintf(culprit, sizeof culprit, "key = %d", unknown_keys[i]);
        CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, culprit,
                    wfpsf_option_describe(unknown_keys[i], &name, &text, &kind, &standard,
                                          &smallest, &largest));
        CHECK(strcmp(name, "before") == 0 && strcmp(text, "before") == 0);
        CHECK(kind == 7 && standard == 7 && smallest == 7 && largest == 7);
    }
}

static void test_bounds_and_reset(wfpsf_options *options) {
    for (size_t i = 0; i < count; ++i) {
        const struct listed *o = &list[i];
        CHECK(same(value_of(options, o->key), o->standard));
        CHECK_OK(set(options, o, o->largest));
        CHECK(value_of(options, o->key) == o->largest);
        CHECK_OK(set(options, o, o->smallest));
        CHECK(value_of(options, o->key) == o->smallest);

        const int is_real = o->kind == WFPSF_OPTION_REAL;
        if (o->smallest > -DBL_MAX)
            CHECK_FAILS(
                WFPSF_ERROR_RANGE, o->name,
                set(options, o, is_real ? nextafter(o->smallest, -HUGE_VAL) : o->smallest - 1));
        if (o->largest < DBL_MAX)
            CHECK_FAILS(
                WFPSF_ERROR_RANGE, o->name,
                set(options, o, is_real ? nextafter(o->largest, HUGE_VAL) : o->largest + 1));
        if (is_real) {
            CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, o->name,
                        wfpsf_options_set_real(options, o->key, NAN));
            CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, o->name,
                        wfpsf_options_set_real(options, o->key, HUGE_VAL));
            CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, o->name,
                        wfpsf_options_set_real(options, o->key, -HUGE_VAL));
            CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, o->name,
                        wfpsf_options_set_integer(options, o->key, 1));
        } else {
            CHECK_FAILS(WFPSF_ERROR_RANGE, o->name,
                        wfpsf_options_set_integer(options, o->key, INT64_MIN));
            CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, o->name,
                        wfpsf_options_set_real(options, o->key, o->largest));
        }
        CHECK(value_of(options, o->key) == o->smallest);
        CHECK_OK(wfpsf_options_reset(options, o->key));
        CHECK(same(value_of(options, o->key), o->standard));
    }
}

static void test_the_value_is_named(wfpsf_options *options) {
    CHECK_FAILS(WFPSF_ERROR_RANGE, "EPS = 0", wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 0));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "EPS = 1",
                wfpsf_options_set_real(options, WFPSF_OPTION_EPS, 1e-30));
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "EPS = nan",
                wfpsf_options_set_real(options, WFPSF_OPTION_EPS, NAN));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "STRUTS = 2",
                wfpsf_options_set_integer(options, WFPSF_OPTION_STRUTS, 2));
    CHECK(value_of(options, WFPSF_OPTION_EPS) == 1e-6);
    CHECK(value_of(options, WFPSF_OPTION_STRUTS) == 1);
}

static void test_unknown_keys(wfpsf_options *options) {
    for (size_t i = 0; i < sizeof unknown_keys / sizeof unknown_keys[0]; ++i) {
        const int32_t key = unknown_keys[i];
        double value = 7;
        char culprit[32];
        snprintf(culprit, sizeof culprit, "key = %d", key);
        CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, culprit, wfpsf_options_set_real(options, key, 1));
        CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, culprit, wfpsf_options_set_integer(options, key, 1));
        CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, culprit, wfpsf_options_get(options, key, &value));
        CHECK_FAILS(WFPSF_ERROR_UNKNOWN_NAME, culprit, wfpsf_options_reset(options, key));
        CHECK(value == 7);
    }
}

static void test_null(wfpsf_options *options) {
    double value = 7;
    CHECK_FAILS(WFPSF_ERROR_NULL, "out", wfpsf_options_create(NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "options", wfpsf_options_set_real(NULL, WFPSF_OPTION_EPS, 1e-3));
    CHECK_FAILS(WFPSF_ERROR_NULL, "options",
                wfpsf_options_set_integer(NULL, WFPSF_OPTION_FORCE, 1));
    CHECK_FAILS(WFPSF_ERROR_NULL, "options", wfpsf_options_get(NULL, WFPSF_OPTION_EPS, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "value", wfpsf_options_get(options, WFPSF_OPTION_EPS, NULL));
    CHECK_FAILS(WFPSF_ERROR_NULL, "options", wfpsf_options_reset(NULL, WFPSF_OPTION_EPS));
    CHECK_FAILS(WFPSF_ERROR_NULL, "options", wfpsf_options_set_zernikes(NULL, 1, &value));
    CHECK_FAILS(WFPSF_ERROR_NULL, "coefficients", wfpsf_options_set_zernikes(options, 1, NULL));
    CHECK(value == 7);
    wfpsf_options_destroy(NULL);
}

static void test_zernikes(wfpsf_options *options) {
    double coefficients[232] = {0};
    CHECK_OK(wfpsf_options_set_zernikes(options, 231, coefficients));
    CHECK_OK(wfpsf_options_set_zernikes(options, 0, NULL));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "count = 232",
                wfpsf_options_set_zernikes(options, 232, coefficients));
    CHECK_FAILS(WFPSF_ERROR_RANGE, "count = -1",
                wfpsf_options_set_zernikes(options, -1, coefficients));
    coefficients[3] = NAN;
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "coefficients[3] = nan",
                wfpsf_options_set_zernikes(options, 5, coefficients));
    coefficients[3] = -HUGE_VAL;
    CHECK_FAILS(WFPSF_ERROR_NOT_FINITE, "coefficients[3] = -inf",
                wfpsf_options_set_zernikes(options, 5, coefficients));
    CHECK_OK(wfpsf_options_set_zernikes(options, 3, coefficients));
}

int main(void) {
    wfpsf_options *options = NULL;
    CHECK_OK(wfpsf_options_create(&options));
    test_descriptions();
    test_bounds_and_reset(options);
    test_the_value_is_named(options);
    test_unknown_keys(options);
    test_null(options);
    test_zernikes(options);
    wfpsf_options_destroy(options);
    return checked();
}
