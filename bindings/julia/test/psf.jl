# SPDX-License-Identifier: GPL-3.0-or-later

instrument = Instrument()
psf = PSF(instrument, 7, 1292; eps = 1e-5, psf_radius = 8)

@test psf.wavelength_nm == 1292
@test 0 < psf.error_estimate <= 1e-5
@test issetequal(propertynames(psf), keys(Wfpsf.PSF_PROPERTIES))
@test_throws ArgumentError psf.colour

# A PSF outlives its instrument.
close(instrument)
star = draw(psf, 15, 17; oversampling = 3, flux = 2)
@test record(star) == (oversampling = 3, pixel_scale_arcsec = psf.pixel_scale_arcsec,
                       applied = [:pixel_response])
@test star.pixels == draw!(Image(Float64, 15, 17; oversampling = 3), psf, 8, 9; flux = 2).pixels
@test draw(psf, 15, 17; oversampling = 3).pixels ≈ star.pixels / 2

# Without aberrations a star at the image's centre looks the same from the other side.
perfect = PSF(Instrument(), 7, 1292; zernikes = -zernikes(Instrument(), 7), piston_tilt = true,
              eps = 1e-5)
pixels = draw(perfect, 15, 18; oversampling = 3).pixels
@test maximum(abs, pixels - pixels[end:-1:1, end:-1:1]) < 1e-5 * maximum(pixels)

# A star moved by whole pixels is the same star.
moved = draw(psf, 19, 20; x = 8 + 4, y = 9 + 2, oversampling = 3, flux = 2)
@test maximum(abs, moved.pixels[5:19, 3:19] - star.pixels) < 3e-5 * maximum(star.pixels)

# Roman's PSFs depend on band and place; the two frames differ by a flip of y.
roman = Instrument("roman-c9")
science, pupil = (PSF(roman, "H158", 3, 12.5, 4000; frame = frame, eps = 1e-5) for frame in 0:1)
@test draw(science, 21, 21).pixels ≈ reverse(draw(pupil, 21, 21).pixels, dims = 2)
@test science.wavelength_nm ≈ band(roman, "H158"; rule = :tabulated).effective_nm
@test status_of(() -> PSF(roman, 3, 1500)) == LibWfpsf.WFPSF_ERROR_ARGUMENT
@test status_of(() -> PSF(roman, "H158", 3, 1, 9999)) == LibWfpsf.WFPSF_ERROR_RANGE

# Stars are added to what is there, wherever they lie.
field = Image(Float64, 41, 37)
add_stars!(field, psf, [12.3, 12.3, -500], 1:3:7, [3, 1, 1e9]; threads = 2)
add_stars!(field, psf, [12.3, 30], [1, 36], Float32[-3, 0])
# Beyond the radius, in little memory.
let small = PSF(Instrument(), 7, 1292; psf_radius = 3), image = Image(Float64, 33, 31)
    memory = draw_memory(small, image, 17, 16)
    @test 0 < memory.least < memory.most
    draw!(image, small, 17, 16; memory_limit = memory.least)
    @test image.pixels ≈ draw(psf, 33, 31).pixels rtol = 1e-4
    before = copy(image.pixels)
    add_bright_star!(image, small, 17, 16; flux = 2, memory_limit = memory.most)
    @test image.pixels ≈ 3 * before
    @test status_of(() -> draw!(image, small, 17, 16; memory_limit = 1e4)) ==
        LibWfpsf.WFPSF_ERROR_MEMORY_LIMIT
end

alone = draw!(Image(Float64, 41, 37), psf, 12.3, 4)
near = [abs(x - 12.3) <= psf.radius && abs(y - 4) <= psf.radius for x = 1:41, y = 1:37]
@test maximum(abs, field.pixels - near .* alone.pixels) < 1e-8
@test_throws DimensionMismatch add_stars!(field, psf, [1, 2], [1, 2], [1])
@test status_of(() -> add_stars!(field, psf, [1], [NaN], [1])) == LibWfpsf.WFPSF_ERROR_NOT_FINITE

@test status_of(() -> draw!(star, psf, 8, 9; flux = NaN)) == LibWfpsf.WFPSF_ERROR_NOT_FINITE
@test status_of(() -> PSF(Instrument(), 0, 1292)) == LibWfpsf.WFPSF_ERROR_RANGE

@testset "threads" begin
    stamps = Vector{Matrix{Float64}}(undef, 16)
    Threads.@threads for k = 1:16
        stamps[k] = draw(psf, 15, 17; oversampling = 3, flux = 2).pixels
    end
    @test all(stamp == star.pixels for stamp in stamps)
end

@testset "galaxy" begin
    # One sample is a star; a star's image holds the pixel response already.
    galaxy = Image(Float64, 5, 5; oversampling = 4)
    galaxy.pixels[3, 3] = 2
    image = convolve!(Image(Float64, 15, 17), psf, galaxy, 7.3, 9.1; flux = 3)
    @test image.pixels ≈ draw(psf, 15, 17; x = 7.3, y = 9.1, flux = 6).pixels
    @test record(image).applied == [:pixel_response]
    @test status_of(() -> convolve!(image, psf, draw(psf, 5, 5), 7, 9)) ==
          LibWfpsf.WFPSF_ERROR_ALREADY_APPLIED
    other = Image(Float64, 15, 17; oversampling = 3)
    @test status_of(() -> convolve!(other, psf, galaxy, 7, 9)) == LibWfpsf.WFPSF_ERROR_ARGUMENT
end

@testset "pupil" begin
    # The pupil as a mask gives the PSF by other means.
    instrument = Instrument()
    drawn = Wfpsf.pupil(instrument, "J129", 7, 300, 256)
    @test all(0 .<= drawn.mask.pixels .<= 1)
    @test sum(drawn.mask.pixels) * drawn.scale_m^2 ≈ psf.lit_area_m2
    by_mask = PSF(instrument, 7, 1292, drawn.mask; mask_scale_m = drawn.scale_m,
                  axis_x = drawn.axis_x, axis_y = drawn.axis_y, eps = 1e-6)
    by_geometry = PSF(instrument, 7, 1292; eps = 1e-6)
    @test draw(by_mask, 9, 9).pixels ≈ draw(by_geometry, 9, 9).pixels rtol = 1e-3
    @test status_of(() -> Wfpsf.pupil(instrument, "J129", 0, 9, 9)) == LibWfpsf.WFPSF_ERROR_RANGE
end

@testset "mask" begin
    # The bare annulus as squares. Under a strong defocus, an axis that is a pixel off shifts the
    # PSF.
    instrument = Instrument()
    diameter = constant(instrument, "diameter").value
    obscuration = constant(instrument, "obscuration").value
    n, scale = 301, diameter / 280
    lit(x, y) = obscuration <= hypot(x - 151, y - 151) * scale / (diameter / 2) <= 1
    mask = Image(Float64[lit(x, y) for x = 1:n, y = 1:n])
    defocus = (zernikes = [0, 0, 0, 1], psf_radius = 8, eps = 1e-4)
    expected = draw(PSF(instrument, 7, 1292; struts = false, defocus...), 32, 32; oversampling = 4)
    difference(axis_x) = maximum(abs, expected.pixels - draw(
        PSF(instrument, 7, 1292, mask; mask_scale_m = scale, axis_x = axis_x, axis_y = 151,
            defocus...), 32, 32; oversampling = 4).pixels) / maximum(expected.pixels)
    @test difference(151) < 0.01
    @test difference(152) > 0.03
end
