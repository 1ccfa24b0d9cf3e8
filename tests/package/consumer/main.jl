# SPDX-License-Identifier: GPL-3.0-or-later
# The program of main.c in Julia: positions count from 1, errors are exceptions.
using Wfpsf

ARGS == [string(Wfpsf.version())] || error("another version")
roman = Instrument("roman-c9")
psf = PSF(roman, "H158", 4, 1001, 2001)
star = draw(psf, 64, 64; x = 32.2, y = 33.1, flux = 1000, oversampling = 4)
blurred = apply_ipc(IPCKernel(roman), star)
println("sigma = ", round(adaptive_moments(blurred).sigma; digits = 9))
