#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws docs/pictures/architecture.svg from the #include lines of the sources (Graphviz's dot).

usage: docs/architecture.py [--check]

--check draws nothing: it fails unless arrows run one way, as cpp/CMakeLists.txt says, and the
picture shows the arrows that there are.
"""
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs/pictures/architecture.svg"
HOLDS = {
    "bindings": "Fortran, Julia, Python", "capi": "the C interface",
    "study": "the paper in one call", "scene": "whole fields of sources",
    "optics": "pupil to pixels", "detector": "IPC, noise, the chain",
    "moments": "sizes and shapes", "observation": "where it is on the sky",
    "instrument": "figures of telescopes", "image": "pixels, FITS",
    "numerics": "FFTs, quadrature, filters", "error": "one exception"}


def core():
    return sorted(path.name for path in (ROOT / "cpp").iterdir() if path.is_dir())


def arrows():
    """{(from, to): how many lines include it}; bindings stand on the C headers alone."""
    found = Counter({("bindings", "capi"): 0})
    places = {folder: ROOT / "cpp" / folder for folder in core()} | {"capi": ROOT / "capi/src"}
    for folder, place in places.items():
        for path in [*place.rglob("*.hpp"), *place.rglob("*.cpp")]:
            for other in re.findall(r'^#include "(\w+)/', path.read_text(), re.MULTILINE):
                if other in places and other != folder:
                    found[folder, other] += 1
    return found


def layers():
    """The folders from top to bottom, as cpp/CMakeLists.txt has them."""
    text = " ".join(line.lstrip("# ") for line in
                    (ROOT / "cpp/CMakeLists.txt").read_text().splitlines() if line.startswith("#"))
    line = re.search(r"Arrows run one way: ([^.]*)\.", text).group(1)
    return [re.findall(r"\w+", part) for part in line.split("->")]


def wrong(found):
    order = [["bindings"], ["capi"], *layers()]
    layer = {folder: i for i, folders in enumerate(order) for folder in folders}
    if sorted(layer) != sorted([*core(), "bindings", "capi"]):
        yield f"cpp/CMakeLists.txt speaks of {sorted(layer)}"
        return
    base = order[-2]  # the only layer whose folders may know each other
    for (a, b) in found:
        if layer[a] > layer[b] or (layer[a] == layer[b] and a not in base):
            yield f"{a} includes {b}"
        if (b, a) in found and a < b:
            yield f"{a} and {b} include each other"


def drawing(found):
    lines = ["digraph wfpsf {", "rankdir=TB; nodesep=0.35; ranksep=0.55;",
             'node [shape=box, style="rounded,filled", fillcolor="#eef3fa", fontname="sans-serif", '
             'fontsize=11]; edge [fontname="sans-serif", fontsize=8, color="#555555"];']
    for folders in [["bindings"], ["capi"], *layers()]:
        same = "; ".join(f'{folder} [label="{folder}\\n{HOLDS[folder]}"]' for folder in folders)
        # Folders of one layer that know each other cannot stand side by side.
        inside = any(a in folders and b in folders for a, b in found)
        lines.append(f"{same};" if inside else f"{{rank=same; {same}}}")
    lines += [f'{a} -> {b} [label="{count or ""}"];' for (a, b), count in sorted(found.items())]
    return "\n".join([*lines, "}"])


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    found = arrows()
    faults = list(wrong(found))
    if not sys.argv[1:]:
        svg = subprocess.run(["dot", "-Tsvg"], input=drawing(found), text=True, check=True,
                             capture_output=True).stdout
        PICTURE.write_text(re.sub(r"<!-- Generated.*?-->\s*", "", svg, flags=re.DOTALL))
    shown = {tuple(pair) for pair in re.findall(r"<title>(\w+)&#45;&gt;(\w+)</title>",
                                                PICTURE.read_text())}
    if shown != set(found):
        faults.append(f"{PICTURE.name} is out of date (docs/architecture.py draws it): "
                      f"{sorted(shown ^ set(found))}")
    print("\n".join(faults) or f"{len(found)} arrows run one way")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
