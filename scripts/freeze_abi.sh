#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# freeze_abi.sh LIBRARY: writes what tests/package holds the binary interface to, from the headers and
# from a shared library built of them with debugging information. Run once for each ABI number.
set -euo pipefail
library=$(realpath "$1")
cd "$(dirname "$0")/.."

number=$(sed -n 's/^set(WFPSF_ABI_NUMBER \([0-9]*\)).*/\1/p' CMakeLists.txt)
out=tests/package/abi
mkdir -p "$out"
abidw --no-corpus-path --no-comp-dir-path --no-show-locs --no-elf-needed \
    --exported-interfaces-only --drop-private-types \
    --headers-dir capi/include/wfpsf "$library" |
    sed "s| path='[^']*/| path='|; s|filepath='[^']*/|filepath='|" > "$out/wfpsf-$number.abi"

# The headers one after the other, as each needs the ones before it, without comments.
headers="export status version options image instrument design observation sed psf varying_psf otf ipc
    varying_ipc chain sky moments size study"
{
    printf '/* SPDX-License-Identifier: GPL-3.0-or-later */\n'
    printf '/* The public headers of ABI %s as they were when it was frozen: never edited. */\n' "$number"
    printf '/* clang-format off */\n'
    for header in $headers; do
        file=capi/include/wfpsf/$header.h
        [ -e "$file" ] || file=build/release/capi/include/wfpsf/$header.h
        grep -v '^#include <wfpsf/' "$file" | gcc -w -fpreprocessed -dD -E -P -x c -
    done
} > "$out/wfpsf_$number.h"
