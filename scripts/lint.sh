#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Format and static analysis of the C and C++ sources; the release must have been configured.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh --lint
find capi cpp tests examples bench \( -name '*.[ch]' -o -name '*.[ch]pp' \) -print0 |
    xargs -0 clang-format --dry-run -Werror
find cpp capi/src -name '*.cpp' -print0 |
    xargs -0 -n 1 -P "$(nproc)" clang-tidy -quiet -p build/release --warnings-as-errors='*'
