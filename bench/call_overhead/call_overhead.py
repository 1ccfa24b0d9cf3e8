# SPDX-License-Identifier: GPL-3.0-or-later
"""What a call costs in Python: see call_overhead.c.

usage: WFPSF_LIBRARY=... PYTHONPATH=bindings/python python3 bench/call_overhead/call_overhead.py
"""
import time

import numpy as np
import wfpsf

ROUNDS, SIDE = 20, 24

psf = wfpsf.PSF(wfpsf.Instrument("wfirst-afta-c5"), 7, 1292)
image = wfpsf.zeros((SIDE, SIDE))
star = psf.draw(SIDE, SIDE, 11.25, 12.5, oversampling=4)
x, y, flux = np.array([11.25]), np.array([12.5]), np.array([1.0])


def measure(name, call, calls):
    least = float("inf")
    for _ in range(ROUNDS):
        start = time.perf_counter()
        for _ in range(calls):
            call()
        least = min(least, time.perf_counter() - start)
    print("Python   %-10s %10.0f ns" % (name, 1e9 * least / calls))


measure("property", lambda: psf.peak, 10000)
measure("add_star", lambda: psf.add_stars(image, x, y, flux), 1000)
measure("draw", lambda: psf.draw_into(image, 11.25, 12.5), 1000)
measure("moments", lambda: wfpsf.adaptive_moments(star), 1000)
