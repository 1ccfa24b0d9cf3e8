#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds and installs the library and runs every test. Arguments go to ctest. The conformance tests
# are among them where the reference data stand beside the project.
set -euo pipefail
cd "$(dirname "$0")/.."

reference=../shared/reference
options=()
if [ -d "$reference" ]; then options+=(-DWFPSF_REFERENCE_DIR="$(realpath "$reference")"); fi
scripts/build.sh -DWFPSF_BUILD_TESTS=ON -DWFPSF_BUILD_BENCH=ON -DWFPSF_BUILD_FORTRAN=ON \
    "${options[@]}"
ctest --preset release -j "$(nproc)" "$@"
