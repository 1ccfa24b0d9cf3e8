# SPDX-License-Identifier: GPL-3.0-or-later

function figures!(design)
    set_telescope!(design, diameter_m = 2.4, obscuration = 0.3, reference_wavelength_nm = 1000)
    set_detector!(design, sca_count = 2, pixel_scale_arcsec = 0.1, n_pix_x = 100, n_pix_y = 100)
end

design = Design()
@test status_of(() -> Instrument(design)) == LibWfpsf.WFPSF_ERROR_ARGUMENT
figures!(design)
foreach(azimuth -> add_strut!(design, azimuth, 0.05; offset_m = 0.1), (30, 150, 270))
x, y = [50, 1, 100, 1, 100], [50, 1, 1, 100, 100]
coefficients = [j == 4 ? i / 10 : 0 for j = 1:4, i = 1:5]
set_zernikes!(design, 2, x, y, coefficients)
@test_throws DimensionMismatch set_zernikes!(design, 2, x, y[1:4], coefficients)
add_band!(design, "mine", 900, 100, [0.5, 1, 0])
@test status_of(() -> add_band!(design, "mine", 900, 100, [1, 1])) == LibWfpsf.WFPSF_ERROR_ARGUMENT
@test status_of(() -> add_strut!(design, 400, 0.1)) == LibWfpsf.WFPSF_ERROR_RANGE
instrument = Instrument(design)
close(design)
@test constant(instrument, "diameter").value == 2.4
@test bands(instrument) == ["mine"]
@test throughput(instrument, "mine", 950) ≈ 0.75
@test zernikes(instrument, 1) == []
@test zernikes(instrument, 2) ≈ coefficients[:, 1]

# The aberrations of the first corner, at that corner and as an option.
few = (eps = 1e-7, psf_radius = 8)
there = draw(PSF(instrument, "mine", 2, 1, 1; few...), 15, 15).pixels
extra = draw(PSF(instrument, "mine", 1, 1, 1; zernikes = coefficients[:, 2], few...), 15, 15).pixels
@test maximum(abs, there - extra) < 2e-7 * maximum(extra)

@testset "path difference map" begin
    # Z_4 over the circle of 1.2 m, once as a coefficient and once as a map.
    defocus(u, v) = sqrt(3) * (2 * (u^2 + v^2) / 1.2^2 - 1) * 0.2 * 1000e-9
    map = Image([defocus((i - 31) * 0.04, (j - 32) * 0.04) for i = 1:64, j = 1:65])
    opd = (map = map, scale_m = 0.04, axis_x = 31, axis_y = 32)
    through = draw(PSF(instrument, "mine", 1, 1, 1; opd = opd, few...), 15, 15).pixels
    @test maximum(abs, through - extra) < 2e-7 * maximum(extra)
    @test status_of(() -> PSF(instrument, 1, 1000; opd = merge(opd, (scale_m = 0,)))) ==
          LibWfpsf.WFPSF_ERROR_RANGE
end
