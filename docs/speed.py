#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what bench measured into the pages, between their marks, and draws the report's curves.

usage: docs/speed.py BENCH.json [PART.json ...]    (needs Matplotlib: Debian's python3-matplotlib)

A case of a later file takes the place of the same one in an earlier file: a part may be run again.
"""
import datetime
import json
import pathlib
import re
import sys

import speed_curves

FOLDER = pathlib.Path(__file__).parent
MARKED = re.compile(r"(<!-- ([^>]+): by docs/speed.py -->\n).*?(<!-- end -->)", re.DOTALL)

# Each case belongs to the first area whose pattern is in its name.
AREAS = [
    ("PSFs", r"^PSF model|^effective PSF"),
    ("Stars on a detector", r"^star stamp|^1e4 stars|^Star of"),
    ("Many colours", r"^chromatic"),
    ("Bright stars and far light", r"^stamp |^far light"),
    ("Over a detector", r"^PSF all over|^PSF at a place"),
    ("Transforms", r"^nonuniform|^chirp"),
    ("Correcting IPC", r"inverse of|IPC inverse|^IPC correction"),
    ("IPC", r"IPC (3x3|on)"),
    ("Noise and the detector's chain", r"noise, |^variance|chain"),
    ("Moments", r"moments|^least squares"),
    ("Sizes", r"^EE50|^FWHM"),
    ("Galaxies", r"^galaxy"),
    ("Scenes", r"stars AB"),
    ("World coordinates", r"^WCS"),
    ("The study", r"^the whole study"),
    ("Peaks of the machine", r"^peak:"),
    ("Others", ""),
]

# What a path takes at least: its case, pixels (or samples), bytes of memory for each, and operations,
# of which two of float32 count as one. The page tells how they are counted.
PATHS = [
    ("IPC 3x3, float32", "IPC 3x3 on 4088^2, float32", "4088^2", 8, 9),
    ("IPC 3x3, float64", "IPC 3x3 on 4088^2, float64", "4088^2", 16, 18),
    ("star stamp, 16 taps", "star stamp 32^2, model built, eps 1e-05", "32^2", 0, 172),
    ("PSF model, 7759 nodes", "PSF model, J129, +-16 native pixels, eps 1e-06", "175^2", 0, 630),
    ("adaptive moments, 512^2", "adaptive moments 512^2 (N = 16), tolerance 1e-08", "12578", 0, 13),
    ("adaptive moments, 32^2", "adaptive moments 32^2 (N = 4), tolerance 1e-08", "2211", 0, 13),
    ("far light", "far light, 4088^2, roman-c9 J129, 1e8 e, floor 0.01 e", "4088^2", 8, None),
]

# Measured before this project started: work, peer, its time (s; the shorter where there is a range)
# in words too, its error, and our case.
PEERS = [
    ("Roman PSF at a new place, 32^2 native pixels", "GalSim, defaults", 0.13, "0.13 s",
     "1.2e-2 of the peak; sigma +1.5 % (J129)", "PSF model, Roman J129, the same, eps 1e-06"),
    ("the same, all pixels of the published pupil", "GalSim, masks as they are", 4.7, "4.7 s",
     "1.2e-2 of the peak", "PSF model, Roman J129, the same, eps 1e-06"),
    ("one more star of it, elsewhere in a pixel", "GalSim", 4e-3, "4 to 7 ms", "as above",
     "star stamp 32^2, model built, eps 1e-05"),
    ("the paper's image, 512^2 at pixel / 32", "GalSim, Cycle 5 mask", 5, "5 to 17 s, 2 to 3 GB",
     "sigma +0.63, +0.88, +0.98 % (J129, H158, F184)",
     "effective PSF 512^2 at pixel/32 with its model, eps 1e-6"),
    ("a star of many colours, J129, exact", "GalSim", 56, "56 s", "",
     "chromatic PSF, Roman J129, +-16 native pixels, 1 SED, eps 1e-05"),
    ("the same in W146", "GalSim", 110, "110 s", "",
     "chromatic PSF, Roman W146, +-16 native pixels, 1 SED, eps 1e-05"),
    ("the same in J129, 10 wavelengths interpolated", "GalSim", 4.2, "4.2 s", "not reported",
     "chromatic PSF, Roman J129, +-16 native pixels, 1 SED, eps 1e-03"),
    ("a PSF on 128^2 from a pupil of 512^2", "POPPY", 0.07, "0.07 s", "pupil edges in pixels",
     "PSF model, mask of 512^2, the same, eps 1e-06"),
    ("the same from 1024^2", "POPPY", 0.27, "0.27 s", "pupil edges in pixels",
     "PSF model, mask of 1024^2, the same, eps 1e-06"),
    ("adaptive moments, 128^2", "GalSim's HSM, a call", 277e-6, "277 µs", "3e-8",
     "adaptive moments 128^2 (N = 4), tolerance 1e-08"),
    ("adaptive moments, 512^2", "GalSim's HSM, a call", 4065e-6, "4.1 ms", "3e-8",
     "adaptive moments 512^2 (N = 16), tolerance 1e-08"),
    ("adaptive moments, 512^2", "HSM's core in C++", 960e-6, "0.96 ms", "3e-8",
     "adaptive moments 512^2 (N = 16), tolerance 1e-08"),
    ("IPC on 4088^2", "GalSim's `applyIPC`", 0.57, "0.57 s, 36 copies", "rounding",
     "IPC 3x3 on 4088^2, float64"),
]


# What costs much: our case, and what is said of it.
LOSSES = [
    ("stamp 4096^2 of a bright star, J129, eps 1e-08",
     "An exact stamp as large as a detector takes {time} and {memory}: every sample is diffracted."),
    ("chromatic field, Roman J129, +-256 native pixels, eps 1e-06",
     "A field of many colours with a radius of 256 native pixels takes {time}, bound by memory."),
    ("far light of a star made, wfirst-afta-c5 F184",
     "Far light, the short form of spikes, is made in {time} for each colour and is off by {error} "
     "of a spike."),
    ("PSF model, mask of 4096^2, the same, eps 1e-06",
     "A mask in place of a pupil's geometry is a sum over its pixels: {time} and {memory} of 4096^2, "
     "and its pixels err by {error} where geometry is exact."),
    ("galaxy, the first one behind a PSF",
     "The first galaxy behind a PSF waits {peer} for a transfer function."),
    ("star stamp 32^2, model built, eps 1e-05",
     "A star's stamp costs {time} at eps 1e-5 and cannot cost much less at 1e-3: an interpolant of "
     "an image, wrong by some per cent of the peak, is cheaper (rows *PSF at a place*)."),
    ("exact IPC inverse on 4088^2, alpha = 0.02",
     "The exact inverse of IPC takes {time}, some 25 times the IPC itself; the first-order "
     "correction is one more IPC."),
    ("varying IPC on 4088^2, float64, scatter",
     "IPC that varies over the detector takes {time}, {ratio} copies."),
    ("Roman's detector chain on 4088^2, float32",
     "A whole detector's chain takes {time}, {ratio} copies: it is bound by its random numbers."),
    ("covariance of all moments 32^2 (N = 4), second order",
     "The covariance of moments to second order takes {time}, some hundred measurements."),
]


def merged(paths):
    """The head of the first file, and the cases of all, in the order of their first appearance."""
    benches = [json.loads(pathlib.Path(path).read_text()) for path in paths]
    cases = {}
    for bench in benches:
        for case in bench["cases"]:
            against = case["baseline"]["name"] if case["baseline"] else ""
            cases[case["case"], case["error_kind"], against] = case
    head = {key: value for key, value in benches[0].items() if key != "cases"}
    head.setdefault("date", str(datetime.date.fromtimestamp(pathlib.Path(paths[0]).stat().st_mtime)))
    return head, list(cases.values())


def named(cases, name):
    return next((case for case in cases if case["case"] == name), None)


def duration(seconds):
    if not seconds:
        return ""
    for unit, name in ((1, "s"), (1e-3, "ms")):
        if seconds >= unit:
            return f"{seconds / unit:.3g} {name}"
    return f"{seconds / 1e-6:.3g} µs"


def number(value):
    if value is None:
        return ""
    if value == 0 or 0.01 <= value < 1000:
        return f"{value:.2g}"
    digits, _, exponent = f"{value:.1e}".partition("e")
    return f"{digits.removesuffix('.0')}e{int(exponent)}"


def two_digits(value):
    return f"{float(f'{value:.2g}'):g}"


def about(case):
    text = number(case["error"])
    return f"{duration(case['time_s'])}; {text}" if text else duration(case["time_s"])


def area_of(case):
    return next(title for title, pattern in AREAS if re.search(pattern, case["case"]))


def row(cells):
    return f"| {' | '.join(cells)} |"


def cells(case, with_kind):
    peer = case["baseline"]
    return {
        "Case": case["case"],
        "Time": duration(case["time_s"]),
        "Target": duration(case["target_time_s"] or 0),
        "Error": number(case["error"]),
        "Asked": number(case["target_error"]),
        "Error of what": case["error_kind"] if with_kind and number(case["error"]) else "",
        "Peak memory": f"{case['memory_bytes'] / 2**20:.0f} MiB",
        "Against": f"{two_digits(case['ratio'])} × {peer['name']}" if peer else ""}


def table(cases):
    kinds = {case["error_kind"] for case in cases if case["error"] is not None}
    if len(kinds) == 1:
        yield from (f"Errors: {kinds.pop()}.", "")
    rows = [cells(case, bool(kinds)) for case in cases]
    columns = [title for title in cells(cases[0], True) if any(own[title] for own in rows)]
    yield row(columns)
    yield row("---" for _ in columns)
    yield from (row(own[title] for title in columns) for own in rows)


def all_tables(areas):
    for title, cases in areas.items():
        if cases:
            yield from ("", f"### {title}", "", *table(cases))


def run(head):
    yield (f"The run: wfpsf {head['version']} on {head['machine']}, {head['date']}, by "
           "`build/release/bench/bench bench.json`.")


def losses(cases):
    for name, text in LOSSES:
        case = named(cases, name)
        if case:
            peer = duration(case["baseline"]["time_s"]) if case["baseline"] else ""
            yield "- " + text.format(
                time=duration(case["time_s"]), error=number(case["error"]), peer=peer,
                memory=f"{case['memory_bytes'] / 2**30:.1f} GiB",
                ratio=f"{case['ratio'] or 0:.3g}") + f" (*{name}*)"


def missed(cases):
    late = [case for case in cases
            if case["target_time_s"] and case["time_s"] > case["target_time_s"]]
    for case in late:
        yield (f"- *{case['case']}* takes {duration(case['time_s'])}, the target is "
               f"{duration(case['target_time_s'])}.")
    if not late:
        yield "- Of this run's targets none is missed."


def rooflines(cases):
    memory = next((case for case in cases if case["case"].startswith("peak:")
                   and "bytes" in case["case"]), None)
    arithmetic = {int(re.search(r"of (\d+) doubles", case["case"])[1]): case for case in cases
                  if re.match(r"peak: \d+ operations", case["case"])}
    if not memory or 4 not in arithmetic:
        yield "This run has no cases *peak*."
        return

    def rate(case):
        return int(re.search(r"\d+", case["case"])[0]) / case["time_s"]

    peaks = " and ".join(f"{rate(case) / 1e9:.0f} on vectors of {lanes}"
                         for lanes, case in sorted(arithmetic.items()))
    yield (f"One core moves {rate(memory) / 1e9:.0f} GB/s through memory, read and written, and does "
           f"{peaks} doubles, in 10^9 operations a second (rows *peak*).")
    yield ""
    yield "| Path | Pixels | Bytes a pixel | Operations a pixel | Bound | Measured | Reached |"
    yield "|---|---|---|---|---|---|---|"
    for path, name, pixels, size, operations in PATHS:
        case = named(cases, name)
        if not case:
            continue
        side, _, power = pixels.partition("^")
        count = int(side) ** int(power or 1)
        bounds = {"memory": count * size / rate(memory),
                  "arithmetic": count * (operations or 0) / rate(arithmetic[4])}
        what = max(bounds, key=bounds.get)
        yield row([path, pixels, f"{size or 'in cache'}", f"{operations or ''}",
                   f"{duration(bounds[what])}, {what}", duration(case["time_s"]),
                   f"{100 * bounds[what] / case['time_s']:.0f} %"])


def peers(cases):
    yield "| Work | Peer | Its time | Its error | Our case | Ours: time; error | Time over ours |"
    yield "|---|---|---|---|---|---|---|"
    for work, peer, seconds, words, error, name in PEERS:
        case = named(cases, name)
        if case:
            yield row([work, peer, words, error, f"*{name}*", about(case),
                       two_digits(seconds / case["time_s"])])


def filled(page, blocks):
    """The page with what stands between its marks made anew."""
    def made_anew(marks):
        if marks[2] not in blocks:
            sys.exit(f"{page}: no such mark: {marks[2]}")
        body = "\n".join(blocks[marks[2]]).strip("\n")
        return f"{marks[1]}\n{body}\n\n{marks[3]}"

    return MARKED.sub(made_anew, page.read_text())


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    head, cases = merged(sys.argv[1:])
    for name in [*(path[1] for path in PATHS), *(peer[-1] for peer in PEERS), *dict(LOSSES)]:
        if not named(cases, name):
            print(f"no such case, its rows are left out: {name}", file=sys.stderr)
    areas = {title: [case for case in cases if area_of(case) == title] for title, _ in AREAS}
    blocks = {"run": run(head), "losses": losses(cases), "missed": missed(cases),
              "rooflines": rooflines(cases), "peers": peers(cases), "tables": all_tables(areas)}
    # The table of an area may stand on other pages too.
    blocks |= {title: table(own) if own else [] for title, own in areas.items()}
    blocks = {name: list(lines) for name, lines in blocks.items()}
    for page in FOLDER.glob("*.md"):
        page.write_text(filled(page, blocks))
    speed_curves.draw(cases, FOLDER / "pictures/speed.svg")


if __name__ == "__main__":
    main()
