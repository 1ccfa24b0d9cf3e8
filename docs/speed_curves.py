# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of time against error, for docs/speed.py."""
import re

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

DETECTOR, PART = 4088**2, 512**2  # pixels of the images that IPC is taken out of

# Panels: title, axis of errors, axis of times and its unit in s, and curves: a label and what their
# cases' names hold.
PANELS = [
    ("Light of one colour", "largest error of any pixel / peak pixel", "ms", 1e-3, [
        ("PSF model, ±16 native pixels, J129", r"^PSF model, J129"),
        ("star stamp 32², model built", r"^star stamp"),
        ("PSF all over a detector, J129", r"^PSF all over"),
    ]),
    ("Light of many colours", "largest error of any pixel / peak pixel", "ms", 1e-3, [
        ("J129, one spectrum", r"^chromatic PSF, Roman J129.* 1 SED"),
        ("W146, one spectrum", r"^chromatic PSF, Roman W146.* 1 SED"),
    ]),
    ("IPC taken out", "largest error of any pixel / largest pixel", "ns a pixel", 1e-9, [
        *((f"orders 1 to 8, α = {alpha}", rf"^IPC correction.*alpha = {alpha},")
          for alpha in ("0.01", "0.02", "0.05")),
        ("exact, α = 0.02 to 0.1248", r"^exact IPC inverse[^,]*, alpha = [\d.]+$"),
    ]),
    ("Adaptive moments", "relative error of sigma", "µs", 1e-6, [
        *((f"{n}², N = {N}", rf"^adaptive moments {n}\^2 \(N = {N}\), tolerance")
          for n, N in ((32, 4), (128, 4), (512, 16), (1024, 32))),
    ]),
    ("Sizes, 512²", "relative error", "µs", 1e-6, [
        ("EE50, bandwidth 0.05", r"^EE50.*bandwidth 0.05"),
        ("EE50, bandwidth 0.25", r"^EE50.*bandwidth 0.25"),
        ("FWHM", r"^FWHM"),
    ]),
    ("Scenes on 4088²", "error asked for, of a pixel's noise", "s", 1, [
        ("10⁵ stars, AB 20 to 28", r"^1e\+05 stars AB 20\.\.28"),
        ("10⁵ stars, AB 24 to 28", r"^1e\+05 stars AB 24\.\.28"),
        ("10⁷ stars, AB 26 to 28", r"^1e\+07 stars AB 26\.\.28"),
    ]),
]


def error(case):
    budget = re.search(r"([\d.]+) of the noise$", case["case"])
    return float(budget[1]) if budget else case["error"]


def pixels(case):
    if "IPC correction" in case["case"]:
        return PART
    return DETECTOR if "IPC inverse" in case["case"] else 1


def peer_points(cases):
    """HSM's core at its own error; bench names its times as measured elsewhere."""
    return [(3e-8, case["baseline"]["time_s"]) for case in cases
            if case["baseline"] and "HSM" in case["baseline"]["name"] and "cold" not in case["case"]]


def draw(cases, path):
    plt.rcParams.update({"svg.hashsalt": "wfpsf", "font.size": 9})
    figure, panels = plt.subplots(3, 2, figsize=(9, 10.5), layout="constrained")
    for axes, (title, of_error, unit, scale, curves) in zip(panels.flat, PANELS):
        for (label, pattern), marker in zip(curves, "os^Dv"):
            curve = sorted((error(case), case["time_s"] / pixels(case) / scale) for case in cases
                           if re.search(pattern, case["case"]) and error(case))
            if curve:
                axes.loglog(*zip(*curve), marker=marker, markersize=4, label=label)
        if title == "Adaptive moments":
            points = peer_points(cases)
            if points:
                axes.loglog(*zip(*((x, y / scale) for x, y in points)), "kx",
                            label="HSM's core, the same sizes")
        axes.set(title=title, xlabel=of_error, ylabel=f"time ({unit})")
        axes.grid(which="major", alpha=0.4)
        if axes.lines:
            axes.legend(fontsize=8)
        else:
            axes.set_visible(False)
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
