# SPDX-License-Identifier: GPL-3.0-or-later
"""golden.py CASES RESULTS: the golden cases in Python; golden.c says what they are."""
import sys

import wfpsf

INTEGERS = {"sca", "struts", "nx", "ny", "oversampling"}
WORDS = {"name", "instrument", "band"}


def cases(path):
    with open(path, encoding="ascii") as file:
        names = file.readline().split()
        for line in file:
            yield {name: word if name in WORDS else (int if name in INTEGERS else float)(word)
                   for name, word in zip(names, line.split())}


def results(c):
    places = ((0, 0), (c["ny"] // 2, c["nx"] // 2), (-1, -2))
    with wfpsf.Instrument(c["instrument"]) as instrument:
        psf = wfpsf.PSF.in_band(instrument, c["band"], c["sca"], c["x"], c["y"], c["wavelength_nm"],
                                struts=c["struts"])
    yield "wavelength_nm", psf.wavelength_nm
    yield "peak", psf.peak

    star = psf.draw(c["nx"], c["ny"], c["star_x"], c["star_y"], c["flux"], c["oversampling"])
    for i, place in enumerate(places):
        yield "drawn_%d" % i, star.pixels[place]

    blurred = wfpsf.IPCKernel(c["alpha"], c["alpha_prime"], c["alpha_plus"]).apply(star)
    for i, place in enumerate(places):
        yield "blurred_%d" % i, blurred.pixels[place]

    yield "ee25", wfpsf.ee_radius(blurred, c["star_x"], c["star_y"], 0.25,
                                  method="pixel_interpolated").radius
    yield "unweighted_mxx", wfpsf.unweighted_moments(blurred, c["star_x"], c["star_y"]).mxx
    moments = wfpsf.adaptive_moments(blurred)
    for name in ("sigma", "e1", "e2", "flux", "rho4"):
        yield name, getattr(moments, name)

    wfpsf.add_noise(blurred, c["noise"], seed=20150901)
    for i, place in enumerate(places):
        yield "noisy_%d" % i, blurred.pixels[place]


with open(sys.argv[2], "w", encoding="ascii") as out:
    print("case quantity value", file=out)
    for case in cases(sys.argv[1]):
        for quantity, value in results(case):
            print("%s %s %.17g" % (case["name"], quantity, value), file=out)
