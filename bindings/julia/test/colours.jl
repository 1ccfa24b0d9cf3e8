# SPDX-License-Identifier: GPL-3.0-or-later
# PSFs of sources of many colours, blur, and long work that tells how far it is.

roman = Instrument("roman-c9")
place = (roman, "J129", 3, 100, 4000)
few = (eps = 1e-5, psf_radius = 6)
pixels_of(psf) = draw(psf, 11, 11).pixels
same(a, b) = maximum(abs, a - b) < 2e-5 * maximum(a)

# Each source by itself and both together; a narrow line is as good as one wavelength.
seds = [power_law(0), black_body(3500)]
together = psfs(place..., seds; few...)
@test together isa Vector{PSF}
for (shared, sed) in zip(together, seds)
    alone = PSF(place..., sed; few...)
    @test same(pixels_of(alone), pixels_of(shared))
    @test alone.error_estimate <= 1e-5
    @test alone.wavelengths > 2
end
@test together[2].wavelength_nm < together[1].wavelength_nm
line = SED([500, 1299.999, 1300, 1300.001, 2500], [0, 0, 1, 0, 0])
@test same(pixels_of(PSF(place..., line; few...)),
           pixels_of(PSF(place...; wavelength_nm = 1300, few...)))
@test PSF(psf -> psf.wavelengths, place..., line; few...) >= 1

narrow = SED([1200, 1300], [1, 1])
@test status_of(() -> PSF(place..., narrow)) == LibWfpsf.WFPSF_ERROR_RANGE
@test status_of(() -> psfs(place..., [seds[1], narrow])) == LibWfpsf.WFPSF_ERROR_RANGE
@test status_of(() -> psfs(place..., SED[])) == LibWfpsf.WFPSF_ERROR_SIZE
failure = try
    PSF(roman, "J129", 3, -700, 1, seds[1])
catch e
    e
end
@test occursin("x = -701", failure.message)
closed = power_law(0)
close(closed)
@test_throws ArgumentError psfs(place..., [closed])

@testset "blur" begin
    # 0.3 pixels of 0.11 arcsec are as good as jitter.
    sharp, diffused = (pixels_of(PSF(place...; charge_diffusion = s, few...)) for s in (0, 0.3))
    @test maximum(diffused) < 0.95 * maximum(sharp)
    variance = 0.033^2
    @test pixels_of(PSF(place...; jitter_xx = variance, jitter_yy = variance, few...)) ≈ diffused
    @test status_of(() -> PSF(place...; jitter_xx = variance, jitter_xy = -0.0011,
                              jitter_yy = variance)) == LibWfpsf.WFPSF_ERROR_RANGE
end

@testset "progress" begin
    quick = (eps = 1e-3, psf_radius = 6)
    parts = Float64[]
    expected = pixels_of(PSF(place..., seds[1]; quick...))
    @test pixels_of(PSF(place..., seds[1]; progress = part -> push!(parts, part), quick...)) ==
          expected
    @test length(parts) > 2 && issorted(parts) && all(0 .<= parts .<= 1)

    # Told to stop, and by exceptions: none passes through the library, all come out.
    calls = 0
    @test status_of(() -> psfs(place..., seds; progress = part -> (calls += 1) < 2, quick...)) ==
          LibWfpsf.WFPSF_ERROR_CANCELLED
    @test calls == 2
    for _ = 1:100
        @test_throws KeyError(1) PSF(place..., seds[1]; progress = _ -> throw(KeyError(1)))
    end
    @test_throws MethodError PSF(place...; progress = 3, quick...)

    # Such a function may collect garbage, switch tasks and make PSFs itself.
    collecting = PSF(place..., seds[1]; quick..., progress = function (part)
        GC.gc(false)
        yield()
        PSF(inner -> inner.peak, place...; progress = _ -> nothing, quick...)
    end)
    @test pixels_of(collecting) == expected
    @test pixels_of(PSF(place..., seds[1]; progress = nothing, quick...)) == expected

    # Each call has its own.
    counts = zeros(Int, 8)
    Threads.@threads for k = 1:8
        PSF(place..., seds[1]; progress = _ -> (counts[k] += 1), quick...)
    end
    @test all(counts .== length(parts))
end
