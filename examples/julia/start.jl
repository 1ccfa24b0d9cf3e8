# SPDX-License-Identifier: GPL-3.0-or-later
# A star of Roman, before and after interpixel capacitance: its size, its shape and their errors.
using Printf
using Wfpsf

const SIDE, SAMPLES = 128, 4    # 32 x 32 native pixels, 4 x 4 samples in each

function measure(what, image, mas, psf_error)
    m = adaptive_moments(image)
    error = m.error_estimate / 2 + 2 * psf_error    # of the measurement and of the PSF, relative
    @printf("%-8s sigma %10.6f mas, e1 %9.6f, e2 %9.6f, error of sigma %8.6f mas\n", what,
            m.sigma * mas, m.e1, m.e2, m.sigma * mas * error)
end

roman = Instrument("roman-c9")
mas = 1000 * constant(roman, "pixel_scale").value / SAMPLES

# The PSF in the middle of detector 7, at the band's effective wavelength; pixels count from 1.
psf = PSF(roman, "H158", 7, 2044.5, 2044.5)
star = draw(psf, SIDE, SIDE; oversampling = SAMPLES)    # in the image's middle
measure("optics", star, mas, psf.error_estimate)

# alpha = 0.02, alpha' = 0.002, alpha+ = 0
blurred = apply_ipc(IPCKernel(0.02, 0.002), star)
measure("with IPC", blurred, mas, psf.error_estimate)

@printf("any pixel of the PSF: within %8.6f %% of the peak; its pupil's outline: %8.6f %%\n",
        100 * psf.error_estimate, 100 * psf.model_error)
