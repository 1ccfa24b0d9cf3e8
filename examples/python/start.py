#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A star of Roman, before and after interpixel capacitance: its size, its shape and their errors."""
import wfpsf

SIDE, SAMPLES = 128, 4  # 32 x 32 native pixels, 4 x 4 samples in each


def measure(what, image, mas, psf_error):
    m = wfpsf.adaptive_moments(image)
    error = m.error_estimate / 2 + 2 * psf_error  # of the measurement and of the PSF, relative
    print("%-8s sigma %10.6f mas, e1 %9.6f, e2 %9.6f, error of sigma %8.6f mas"
          % (what, m.sigma * mas, m.e1, m.e2, m.sigma * mas * error))


roman = wfpsf.Instrument("roman-c9")
mas = 1000 * roman.constant("pixel_scale").value / SAMPLES

# The PSF in the middle of detector 7, at the band's effective wavelength; pixels count from 0.
psf = wfpsf.PSF.in_band(roman, "H158", sca=7, x=2043.5, y=2043.5)
star = psf.draw(SIDE, SIDE, oversampling=SAMPLES)  # in the image's middle
measure("optics", star, mas, psf.error_estimate)

# alpha = 0.02, alpha' = 0.002, alpha+ = 0
blurred = wfpsf.IPCKernel(0.02, 0.002).apply(star)
measure("with IPC", blurred, mas, psf.error_estimate)

print("any pixel of the PSF: within %8.6f %% of the peak; its pupil's outline: %8.6f %%"
      % (100 * psf.error_estimate, 100 * psf.model_error))
