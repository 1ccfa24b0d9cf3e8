# SPDX-License-Identifier: GPL-3.0-or-later

@test issetequal(fieldnames(Moments), (:status, keys(Wfpsf.MOMENTS_PROPERTIES)...))

shape = (x = 31.3, y = 27.6, mxx = 20.0, mxy = 3.0, myy = 16.0)
image = Image(gaussian(Float64, 60, 64; shape...))

@testset "a Gaussian" for m in (adaptive_moments(image; moments_tolerance = 1e-11),
                                unweighted_moments(image))
    @test m.status == 0
    @test [m.centroid_x, m.centroid_y] ≈ [31.3, 27.6] atol = 1e-8
    @test [m.mxx, m.mxy, m.myy] ≈ [20, 3, 16] atol = 1e-6
    @test m.sigma ≈ (20 * 16 - 3^2)^0.25
    @test m.sigma_trace ≈ 6
    @test [m.e1, m.e2, m.e] ≈ [4, 6, hypot(4, 6)] / 36 atol = 1e-7
    @test m.beta ≈ atan(6, 4) / 2 atol = 1e-6
    @test m.flux ≈ 1
end

single = adaptive_moments(Image(Float32.(image.pixels)))
@test single.centroid_x ≈ 31.3 atol = 1e-5
@test single.rho4 ≈ 2 atol = 1e-5
@test single.curvature ≈ 1 / 8 atol = 1e-5

about_point = unweighted_moments(image, 30.3, 29.6)
@test [about_point.mxx, about_point.mxy, about_point.myy] ≈ [21, 1, 20] atol = 1e-6

@testset "first guess" begin
    two = image.pixels + gaussian(Float64, 60, 64; x = 50, y = 52, mxx = 4, mxy = 0, myy = 4)
    near(x, y) = adaptive_moments(Image(two); moments_guess_x = x, moments_guess_y = y,
                                  moments_guess_sigma = 2)
    @test near(50, 52).centroid_x ≈ 50 atol = 0.05
    @test near(50, 52).centroid_y ≈ 52 atol = 0.05
end

@testset "failures and warnings" begin
    dark = Image(-ones(20, 20))
    @test status_of(() -> adaptive_moments(dark)) < 0
    @test adaptive_moments(dark; strict = false).status < 0
    once = (moments_tolerance = 1e-12, moments_max_passes = 1)
    @test_logs (:warn, r"WFPSF_WARNING_NOT_CONVERGED") adaptive_moments(image; once...)
    @test adaptive_moments(image; strict = false, once...).status ==
          LibWfpsf.WFPSF_WARNING_NOT_CONVERGED
end

@testset "missing pixels, noise and derivatives" begin
    star = gaussian(Float64, 60, 64; shape...)
    holes, spoiled = zeros(60, 64), copy(star)
    holes[30:32, 27] .= 1
    spoiled[30:32, 27] .= NaN
    options = (missing = Image(holes), moments_tolerance = 1e-11)
    m = adaptive_moments(Image(spoiled); options...)
    @test [m.centroid_x, m.mxx, m.flux] ≈ [31.3, 20, 1] atol = 1e-6
    @test m.missing_fraction > 0

    # I (1 + t (x - x0)) is to first order in t the Gaussian moved by mxx t, mxy t.
    tilt = star .* ((1:60) .- 31.3)
    slopes = moments_derivative(Image(spoiled), Image(tilt); options...)
    @test [slopes.centroid_x, slopes.centroid_y, slopes.sigma] ≈ [20, 3, 0] atol = 1e-6
    @test isnan(slopes.passes)
    second = moments_derivative(Image(spoiled), Image(tilt), Image(tilt); options...)
    @test second.centroid_x ≈ 0 atol = 1e-4
    influence = moments_influence(Image(spoiled), :centroid_x; options...)
    @test sum(influence .* tilt) ≈ 20 atol = 1e-6

    flat = moments_covariance(image, (:centroid_x, :e1); moments_variance = 1e-8)
    mapped = moments_covariance(image, (:centroid_x, :e1);
                                variance = Image(fill(1e-8, 60, 64)))
    @test flat ≈ mapped
    @test flat[1, 2] ≈ flat[2, 1] atol = 1e-15
    @test status_of(() -> moments_covariance(image, (:e1,))) == LibWfpsf.WFPSF_ERROR_ARGUMENT
end

@testset "fixed weights" begin
    m = weighted_moments(image, 31.3, 27.6, 20, 3, 16)
    @test [m.mxx, m.mxy, m.myy] ≈ [10, 1.5, 8] atol = 1e-6
    @test moment_sums(image, 31.3, 27.6)[4] ≈ 20 atol = 1e-5
    @test moment_sums(image, 31.3, 27.6; weight = (20, 3, 16))[1] ≈ 1 / 2 atol = 1e-8
end
