#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# main_job.sh [FOLDER]: builds and installs the library, compiles the C example against the
# installed tree alone, and runs it. Its files go to FOLDER (out).
set -euo pipefail
out=$(realpath -m "${1:-out}")
cd "$(dirname "$0")/.."

scripts/build.sh -DWFPSF_BUILD_TESTS=OFF -DWFPSF_BUILD_BENCH=OFF -DWFPSF_BUILD_FORTRAN=OFF
cmake -S examples/c -B build/example -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_PREFIX_PATH="$PWD/build/install"
cmake --build build/example
build/example/main_job "$out"
