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
