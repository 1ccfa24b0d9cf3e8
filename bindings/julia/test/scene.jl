# SPDX-License-Identifier: GPL-3.0-or-later

roman = Instrument("roman-c9")
budget = (scene_noise = 0.01, scene_variance = 100)
x, y, flux = [1011.3, 1041.7, 1e9], [1021.1, 1051.0, 1.0], [5000, 300, 8]
catalogue = Catalogue(:detector, :electrons)
add_stars!(catalogue, x, y, flux)
@test length(catalogue) == 3
planned = Scene(roman, "J129", 7, catalogue, (64, 64), 1001, 1001; budget...)

@testset "rendering" begin
    # The same stars one by one.
    one_by_one = Image(Float64, 64, 64)
    for k = 1:2
        psf = PSF(roman, "J129", 7, x[k], y[k]; eps = 1e-8)
        add_bright_star!(one_by_one, psf, x[k] - 1000, y[k] - 1000; flux = flux[k])
    end
    image = Image(Float64, 64, 64)
    rendering = render!(image, planned; threads = 2)
    @test planned.error_allowed ≈ 0.1
    @test rendering.error_estimate < planned.error_allowed
    @test rendering.drawn == 2
    @test 0 < maximum(abs, image.pixels - one_by_one.pixels) <= planned.error_allowed
    @test status_of(() -> render!(image, planned; progress = part -> false)) ==
          LibWfpsf.WFPSF_ERROR_CANCELLED
    @test status_of(() -> render!(Image(Float64, 32, 64), planned)) == LibWfpsf.WFPSF_ERROR_SIZE
end

@testset "plan" begin
    @test (planned.sources, planned.groups) == (3, 3)
    @test issetequal(propertynames(planned), keys(Wfpsf.SCENE_PROPERTIES))
    @test_throws ArgumentError planned.colour
    bright, faint = scene_groups(planned)[groups_of_sources(planned)[1:2]]
    @test (bright.kind, bright.sources, bright.colour) == (:star, 1, 1)
    @test bright.drawing in (:shared, :own)
    @test (bright.flux_from, faint.flux_from) == (4096, 256)
    @test bright.radius > faint.radius
    @test occursin("3 sources", string(planned))
end

@testset "store" begin
    store = SceneStore()
    @test store.memory == 0
    @test propertynames(store) == (:memory,)
    @test_throws ArgumentError store.size
    made(; options...) = render!(Image(Float64, 64, 64),
                                 Scene(roman, "J129", 7, catalogue, (64, 64), 1001, 1001;
                                       scene_noise = 0.1, scene_variance = 100,
                                       options...)).exact_psfs
    @test made(scene_store = store, scene_exposures = 50) > 0
    held = store.memory
    @test held > 0
    @test made(scene_store = store, scene_exposures = 50) == 0
    @test store.memory == held
    mktempdir() do folder
        path = joinpath(folder, "roman.store")
        write_scene_store(path, store)
        again = read_scene_store!(SceneStore(), path)
        @test again.memory == held
        @test made(scene_store = again, scene_exposures = 50) == 0
        @test_throws WfpsfError read_scene_store!(again, joinpath(folder, "none"))
    end
    @test made() > 0
end

@testset "truth" begin
    table = scene_truth(planned, [2, 1]; kernel = IPCKernel(0.02, 0.002))
    @test table.position_x == x[[2, 1]] && table.position_y == y[[2, 1]]
    @test table.flux == flux[[2, 1]]
    @test table.group == groups_of_sources(planned)[[2, 1]]
    # The star's moments by other means.
    star = draw(PSF(roman, "J129", 7, x[1], y[1]; eps = 1e-8), 256, 256; oversampling = 4)
    m = adaptive_moments(star)
    @test table.sigma[2] ≈ m.sigma / 4 atol = 1e-4
    @test table.e2[2] ≈ m.e2 atol = 1e-4
    @test table.centroid_x[2] - x[1] ≈ (m.centroid_x - 128.5) / 4 atol = 1e-4
    @test table.ipc_sigma[2] / table.sigma[2] ≈ 1.06 atol = 0.01 # the paper's
    @test isequal(scene_truth(planned).sigma[1:2], table.sigma[[2, 1]])
    @test all(isnan, scene_truth(planned).ipc_sigma)
    @test status_of(() -> scene_truth(planned, [4])) == LibWfpsf.WFPSF_ERROR_RANGE
end

@testset "galaxies" begin
    other = Catalogue(:detector, :electrons)
    @test add_colour!(other; wavelength_nm = 1250) == 1
    @test add_colour!(other, black_body(5000)) == 2
    add_galaxies!(other, [1032], [1032], [300]; sersic_index = [0.5],
                  half_light_radius_arcsec = [0.3], e1 = [0.3], colour = 1)
    drawn = Scene(roman, "J129", 7, other, (64, 64), 1001, 1001; budget...)
    galaxy = only(scene_groups(drawn))
    @test (galaxy.kind, galaxy.drawing, galaxy.colour) == (:galaxy, :fourier, 1)
    image = Image(Float64, 64, 64)
    @test render!(image, drawn).time_galaxies > 0
    @test adaptive_moments(image).e1 > 0.2
    @test adaptive_moments(image).centroid_x ≈ 32 atol = 0.1
    @test_throws DimensionMismatch add_stars!(other, [1, 2], [1, 2], [1])
    @test_throws DimensionMismatch add_stars!(other, [1], [1], [1]; colour = [1, 1])
    @test status_of(() -> add_stars!(other, [1], [1], [1]; colour = 3)) ==
          LibWfpsf.WFPSF_ERROR_RANGE
end

@testset "sky" begin
    observation = Observation(roman, 60, -30, 30)
    sky = pixel_to_sky(observation, 7, [1020, 1031], [1010, 1040])
    seen = Catalogue(:sky, :ab_magnitude)
    add_stars!(seen, sky.ra_deg, sky.dec_deg, [20, 22.5])
    on_sky = Scene(roman, "J129", 7, seen, (64, 64), 1001, 1001; observation = observation,
                   exposure_time = 100, budget...)
    table = scene_truth(on_sky)
    @test table.position_x ≈ [1020, 1031] atol = 1e-7
    @test table.flux ≈ 100 * ab_zero_rate(roman, "J129") * exp10.(-0.4 * [20, 22.5])
    @test status_of(() -> Scene(roman, "J129", 7, seen, (64, 64))) == LibWfpsf.WFPSF_ERROR_ARGUMENT
    @test_throws ArgumentError Catalogue(:pixels, :electrons)

    chain = add!(Chain(), :gain, 2)
    exposure = Exposure(roman, observation, "J129", seen; chain = chain, stream = 12,
                        exposure_time = 100, scene_background = 50)
    mktempdir() do folder
        path = exposure_path(exposure, folder, 7)
        @test path == joinpath(folder, "exposure_00012_sca07.fits")
        @test make_exposure(exposure, 7, folder; threads = 2)
        @test !make_exposure(exposure, 7, folder)
        pixels = read_fits(path).pixels
        @test Tuple(argmax(pixels)) == (1020, 1010)
        @test pixels[50, 3000] ≈ 25 atol = 1e-3
        @test status_of(() -> make_exposure(exposure, 7, joinpath(folder, "none"))) ==
              LibWfpsf.WFPSF_ERROR_FILE_WRITE
    end
end
