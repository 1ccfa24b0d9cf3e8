/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fails unless the library that is loaded has the version given as the argument. */
#include <stdio.h>
#include <string.h>

#include <wfpsf/wfpsf.h>

int main(int argc, char **argv) {
    if (argc != 2 || strcmp(argv[1], wfpsf_version()) != 0 || wfpsf_check_version() != WFPSF_OK)
        return 1;
    printf("wfpsf %s\n", wfpsf_version());
    return 0;
}
