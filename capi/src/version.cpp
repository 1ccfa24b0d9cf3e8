// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"

#include <wfpsf/version.h>

#define WFPSF_TEXT(number) #number
#define WFPSF_VERSION_TEXT(major, minor, patch)                                                    \
    WFPSF_TEXT(major) "." WFPSF_TEXT(minor) "." WFPSF_TEXT(patch)

const char *wfpsf_version(void) {
    return WFPSF_VERSION_TEXT(WFPSF_VERSION_MAJOR, WFPSF_VERSION_MINOR, WFPSF_VERSION_PATCH);
}

int32_t wfpsf_abi_number(void) {
    return WFPSF_ABI_NUMBER;
}

wfpsf_status wfpsf_abi_check(int32_t expected) {
    return wfpsf::guarded([&] {
        if (expected != WFPSF_ABI_NUMBER)
            wfpsf::fail(WFPSF_ERROR_ABI,
                        "expected = %d: the loaded library (version %s) has ABI number %d",
                        expected, wfpsf_version(), WFPSF_ABI_NUMBER);
    });
}
