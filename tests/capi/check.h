/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks: one that fails is told and counted, and the program goes on; main returns the count. */
#ifndef WFPSF_TESTS_CHECK_H
#define WFPSF_TESTS_CHECK_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <wfpsf/wfpsf.h>

static int failed_checks = 0;

static inline int checked(void) {
    return failed_checks == 0 ? 0 : 1;
}

static inline void check(int holds, const char *what, const char *file, int line) {
    if (holds)
        return;
    ++failed_checks;
    fprintf(stderr, "%s:%d: %s\n", file, line, what);
}

static inline void check_near(double got, double wanted, double tolerance, const char *what,
                              const char *file, int line) {
    if (fabs(got - wanted) <= tolerance)
        return;
    ++failed_checks;
    fprintf(stderr, "%s:%d: %s = %.17g, not %.17g: off by %.3g, more than %.3g\n", file, line, what,
            got, wanted, got - wanted, tolerance);
}

static inline void check_status(wfpsf_status got, wfpsf_status wanted, const char *what,
                                const char *file, int line) {
    char text[1024];
    if (got == wanted)
        return;
    ++failed_checks;
    wfpsf_last_error(text, sizeof text);
    fprintf(stderr, "%s:%d: %s is %s (%s), not %s\n", file, line, what, wfpsf_status_name(got),
            text, wfpsf_status_name(wanted));
}

/* Leaves a last-error line that no other call would. */
static inline void spoil_last_error(void) {
    (void)wfpsf_abi_check(-12345);
}

/* The last-error line is one line and holds the culprit, such as "sca = 19". */
static inline void check_culprit(const char *culprit, const char *what, const char *file,
                                 int line) {
    char text[1024];
    wfpsf_last_error(text, sizeof text);
    if (strstr(text, culprit) && !strchr(text, '\n'))
        return;
    ++failed_checks;
    fprintf(stderr, "%s:%d: %s: the last error is \"%s\" and does not say \"%s\"\n", file, line,
            what, text, culprit);
}

#define CHECK(condition) check((condition) != 0, #condition, __FILE__, __LINE__)
#define CHECK_NEAR(got, wanted, tolerance)                                                         \
    check_near((got), (wanted), (tolerance), #got, __FILE__, __LINE__)
#define CHECK_STATUS(wanted, call) check_status((call), (wanted), #call, __FILE__, __LINE__)
#define CHECK_OK(call) CHECK_STATUS(WFPSF_OK, call)
#define CHECK_FAILS(wanted, culprit, call)                                                         \
    do {                                                                                           \
        spoil_last_error();                                                                        \
        check_status((call), (wanted), #call, __FILE__, __LINE__);                                 \
        check_culprit((culprit), #call, __FILE__, __LINE__);                                       \
    } while (0)

#endif
