#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes docs/psf_speed.md and docs/psf_speed.svg from what bench wrote.

usage: docs/speed.py BENCH.json    (needs Matplotlib: Debian's python3-matplotlib)
"""
import json
import pathlib
import re
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

FOLDER = pathlib.Path(__file__).parent
PSF = re.compile(r"PSF|stamp|stars|nonuniform|chirp")
CURVES = [
    ("PSF model, J129", "PSF model, ±16 native pixels, J129", "o"),
    ("star stamp 32^2", "star stamp 32², model built", "s"),
    ("chromatic PSF, Roman J129, +-16 native pixels, 1 SED", "chromatic PSF, Roman J129", "^"),
]


def duration(seconds):
    for unit, name in ((1, "s"), (1e-3, "ms")):
        if seconds >= unit:
            return f"{seconds / unit:.3g} {name}"
    return f"{seconds / 1e-6:.3g} µs"


def target(case):
    return duration(case["target_time_s"]) if case["target_time_s"] else ""


def table(cases):
    yield "| Case | Time | Target | Error | Asked for | Peak memory | Against |"
    yield "|---|---|---|---|---|---|---|"
    for case in cases:
        asked = f"{case['target_error']:.0e}" if case["target_error"] else ""
        against = f"{case['ratio']:.2g} × {case['baseline']['name']}" if case["baseline"] else ""
        yield (
            f"| {case['case']} | {duration(case['time_s'])} | {target(case)} "
            f"| {case['error']:.1e} | {asked} | {case['memory_bytes'] / 2**20:.0f} MiB | {against} |"
        )


def picture(cases):
    plt.rcParams["svg.hashsalt"] = "wfpsf"
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    for part, label, marker in CURVES:
        curve = sorted(
            (case["error"], 1e3 * case["time_s"]) for case in cases if part in case["case"]
        )
        axes.loglog(*zip(*curve), marker=marker, label=label)
    axes.set_xlabel("largest error of any pixel probed, of the peak pixel")
    axes.set_ylabel("time, one thread (ms)")
    axes.grid(which="major", alpha=0.4)
    axes.legend()
    figure.savefig(FOLDER / "psf_speed.svg", metadata={"Date": None})


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    bench = json.loads(pathlib.Path(sys.argv[1]).read_text())
    cases = [case for case in bench["cases"] if PSF.search(case["case"])]
    lines = [
        "# PSFs: speed against error",
        "",
        f"By `build/release/bench/bench`, wfpsf {bench['version']}, on {bench['machine']}, one thread",
        "unless a row says otherwise; medians. This page and its picture are made by `docs/speed.py`",
        "from the JSON that `bench` writes.",
        "",
        "![time against error](psf_speed.svg)",
        "",
        *table(cases),
    ]
    (FOLDER / "psf_speed.md").write_text("\n".join(lines) + "\n")
    picture(cases)


if __name__ == "__main__":
    main()
