#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# docs.sh: makes the documentation site in build/docs/html. Warnings are errors, and so are links
# that lead nowhere in the site; no network is needed but for packages that are missing.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh --docs
out=$PWD/build/docs
rm -rf "$out"
mkdir -p "$out/tree/docs"

# The pages as they stand, beside pages made from the headers and the examples that they show.
cp -r docs/. "$out/tree/docs"
ln -s "$PWD/examples" "$out/tree/examples"
/usr/bin/python3 docs/site/reference.py "$out"

{
    cat docs/site/Doxyfile
    printf 'INPUT = %s\nSTRIP_FROM_PATH = %s\nOUTPUT_DIRECTORY = %s\n' \
        "$out/headers" "$out/headers" "$out"
} | doxygen -

sphinx() {
    sphinx-build -b "$1" -W --keep-going -n -q -c docs/site -d "$out/doctrees" \
        -D "breathe_projects.wfpsf=$out/xml" "$out/tree/docs" "$out/$2"
}
sphinx html html
docs/site/check_links.py "$out/html"
printf 'build/docs/html/index.html\n'
