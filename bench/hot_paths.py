#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""hot_paths.py NAME: goes one of the library's hot paths for three seconds, for a profiler.

    export PYTHONPATH=bindings/python WFPSF_LIBRARY=build/release/capi/libwfpsf.so
    perf record -e cpu-clock -o perf.data python3 bench/hot_paths.py NAME
    perf report -i perf.data --no-children
"""
import sys
import time

import numpy as np
import wfpsf

C5 = wfpsf.Instrument("wfirst-afta-c5")
J129_NM = 1292.11


def detector():
    return np.random.default_rng(1).uniform(0, 1e5, (4088, 4088)).astype(np.float32)


def ipc():
    image, kernel = detector(), wfpsf.IPCKernel(0.02, 0.002)
    out = np.empty_like(image)
    return lambda: kernel.apply(image, out)


def stamps():
    psf = wfpsf.PSF(C5, 7, J129_NM, eps=1e-5, psf_radius=16.5)
    image = np.zeros((64, 64))
    x, y = np.random.default_rng(1).uniform(28, 36, (2, 10000))
    return lambda: psf.add_stars(image, x, y, np.ones(10000))


def model():
    return lambda: wfpsf.PSF(C5, 7, J129_NM, eps=1e-6, psf_radius=16.5)


def chromatic():
    roman, sed = wfpsf.Instrument("roman-c9"), wfpsf.SED.black_body(5000)
    return lambda: wfpsf.PSF.in_band(roman, "J129", 7, 2043.5, 2043.5, sed=sed, eps=1e-5,
                                     psf_radius=16.5)


def moments():
    star = wfpsf.PSF(C5, 7, J129_NM, eps=1e-10).draw(512, 512, oversampling=16)
    return lambda: wfpsf.adaptive_moments(star, moments_guess_x=255.5, moments_guess_y=255.5,
                                          moments_guess_sigma=9.6)


PATHS = {path.__name__: path for path in (ipc, stamps, model, chromatic, moments)}


def main():
    if len(sys.argv) != 2 or sys.argv[1] not in PATHS:
        sys.exit(f"{__doc__}\nNAME: {' '.join(PATHS)}")
    call = PATHS[sys.argv[1]]()
    start = time.monotonic()
    while time.monotonic() < start + 3:
        call()


if __name__ == "__main__":
    main()
