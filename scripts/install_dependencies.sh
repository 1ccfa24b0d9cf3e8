#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Debian packages that building and testing need; nothing if all are there.
# With --lint, also what the lint step needs; with --docs, what the documentation and its pictures
# need.
set -euo pipefail

packages=(
    cmake ninja-build gcc g++ gfortran pkg-config binutils python3 python3-numpy
    libeigen3-dev libfftw3-dev libcfitsio-dev liberfa-dev wcslib-dev zlib1g-dev librandom123-dev libgd-dev libgtest-dev
    libopenmpi-dev openmpi-bin
    dpkg-dev file
)
case "${1:-}" in
    --lint) packages+=(clang-format clang-tidy abigail-tools lintian) ;;
    --docs)
        packages=(
            doxygen graphviz python3 python3-numpy python3-matplotlib
            python3-sphinx python3-breathe python3-myst-parser furo
        )
        ;;
    "") ;;
    *) printf 'usage: %s [--lint | --docs]\n' "$0" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
    state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)
    [ "$state" = installed ] || missing+=("$package")
done
[ "${#missing[@]}" -gt 0 ] || exit 0

printf 'installing: %s\n' "${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "${missing[@]}"
