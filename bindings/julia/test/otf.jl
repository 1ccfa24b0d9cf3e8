# SPDX-License-Identifier: GPL-3.0-or-later

psf = PSF(Instrument(), 7, 1292; eps = 1e-4)
otf = OTF(psf; eps = 1e-3)
@test 0 < otf.error_estimate <= 1e-3
@test issetequal(propertynames(otf), keys(Wfpsf.OTF_PROPERTIES))
@test_throws ArgumentError otf.colour
close(psf)

# One at zero, Hermitian, with the pixel's sinc, zero beyond the cut-off.
kx, ky = 0.2 * otf.cutoff, -0.3 * otf.cutoff
@test otf(0, 0) == 1
@test otf(-kx, -ky) == conj(otf(kx, ky))
@test otf(kx, ky) ≈ otf(kx, ky; response = :diffraction) * sinc(0.11kx) * sinc(0.11ky)
@test otf(otf.cutoff, 0) == 0
@test otf([0 kx; -kx 0], [0 ky; -ky 0]) == [1 otf(kx, ky); conj(otf(kx, ky)) 1]

# The three orders of a grid.
step = otf.cutoff / 7
wrapped = otf_grid(otf, 6, 5, step)
@test wrapped[2, 3] == otf(step, 2step)
@test wrapped[5, 5] == otf(-2step, -step)
@test circshift(wrapped, (3, 2)) == otf_grid(otf, 6, 5, step; order = :centred)
@test otf_grid(otf, 4, 5, step; order = :half)[1:3, :] == wrapped[1:3, :]

@test_throws DimensionMismatch otf([1, 2], [1])
@test_throws ArgumentError otf(1, 2; response = :none)
@test status_of(() -> otf(NaN, 0)) == LibWfpsf.WFPSF_ERROR_NOT_FINITE
@test status_of(() -> otf_grid(otf, 4, 4, 0)) == LibWfpsf.WFPSF_ERROR_RANGE
