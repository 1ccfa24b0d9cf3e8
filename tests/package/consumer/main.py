# SPDX-License-Identifier: GPL-3.0-or-later
"""The program of main.c in Python: objects free themselves, errors are exceptions."""
import sys

import wfpsf

if len(sys.argv) != 2 or sys.argv[1] != wfpsf.__version__:
    sys.exit("another version")
roman = wfpsf.Instrument("roman-c9")
psf = wfpsf.PSF.in_band(roman, "H158", sca=4, x=1000, y=2000)
star = psf.draw(64, 64, x=31.2, y=32.1, flux=1000, oversampling=4)
wfpsf.IPCKernel.default(roman).apply(star, out=star)
print(f"sigma = {wfpsf.adaptive_moments(star).sigma:.9f}")
