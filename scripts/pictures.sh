#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# pictures.sh [BUILD]: draws the documentation's pictures anew into docs/pictures, by the Python
# package of this tree and the library of a build (build/release).
set -euo pipefail
build=$(realpath "${1:-build/release}")
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh --docs
export WFPSF_LIBRARY=$build/capi/libwfpsf.so PYTHONPATH=$PWD/bindings/python
export PYTHONDONTWRITEBYTECODE=1
mkdir -p docs/pictures
for program in conventions gallery architecture; do
    /usr/bin/python3 docs/$program.py
done
