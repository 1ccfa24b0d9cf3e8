# SPDX-License-Identifier: GPL-3.0-or-later

few = (eps = 1e-4, psf_radius = 6)
roman = Instrument("roman-c9")
varying = VaryingPSF(roman, "J129", 4; few...)
@test varying.error_estimate <= 1e-4
@test varying.rank > 1
@test_throws ArgumentError varying.colour

# At a place: the PSF that is made for it.
pixels_there = draw(PSF(varying, 300, 4000), 11, 11).pixels
@test pixels_there ≈ draw(PSF(roman, "J129", 4, 300, 4000; few...), 11, 11).pixels rtol = 1e-3
@test status_of(() -> PSF(varying, 6000, 1)) == LibWfpsf.WFPSF_ERROR_RANGE

# A star in an image that begins at (295, 3995) of the detector.
image = add_stars!(Image(Float64, 11, 11), varying, 295, 3995, [6], [6], [2]; threads = 2)
@test maximum(abs.(image.pixels - 2 * pixels_there)) < 0.1 * few.eps * 2 * maximum(pixels_there)
@test_throws DimensionMismatch add_stars!(image, varying, 1, 1, [1, 2], [1], [1])

# A source of many colours, through the other constructor, where nothing varies.
VaryingPSF(Instrument(), "H158", 2, black_body(4000); few...) do c5
    @test c5.exact_psfs == 1
end
