#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds the release and installs it into build/install. Arguments go to
# CMake's configure step.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh
cmake --preset release -DCMAKE_INSTALL_PREFIX="$PWD/build/install" "$@"
cmake --build --preset release
cmake --install build/release
