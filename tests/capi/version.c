/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program, its headers and the loaded library fit together. */
#include "check.h"

int main(void) {
    char text[64];
    snprintf(text, sizeof text, "%d.%d.%d", WFPSF_VERSION_MAJOR, WFPSF_VERSION_MINOR,
             WFPSF_VERSION_PATCH);
    CHECK(strcmp(wfpsf_version(), text) == 0);
    CHECK(wfpsf_abi_number() == WFPSF_ABI_NUMBER);
    CHECK_OK(wfpsf_check_version());
    CHECK_OK(wfpsf_abi_check(WFPSF_ABI_NUMBER));
    CHECK_FAILS(WFPSF_ERROR_ABI, "expected = 1000", wfpsf_abi_check(1000));
    CHECK_FAILS(WFPSF_ERROR_ABI, "expected = -1", wfpsf_abi_check(-1));
    return checked();
}
