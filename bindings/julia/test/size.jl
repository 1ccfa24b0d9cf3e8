# SPDX-License-Identifier: GPL-3.0-or-later

# A round Gaussian: the fraction of light within r is 1 - exp(-r^2 / (2 sigma^2)).
sigma = 4.0
image = Image(gaussian(Float64, 71, 73; x = 35.4, y = 37.2, mxx = sigma^2, mxy = 0, myy = sigma^2))

inside = encircled_energy(image, 35.4, 37.2, 5; size_total_flux = 1)
@test inside.fraction ≈ 1 - exp(-25 / (2 * sigma^2)) atol = 1e-6
@test 0 <= inside.error < 1e-3

half = ee_radius(image, 35.4, 37.2; size_total_flux = 1)
@test half.radius ≈ sigma * sqrt(2log(2)) atol = 1e-5
@test ee_radius(image, 35.4, 37.2, 0.8).radius ≈ sigma * sqrt(2log(5)) atol = 1e-4

for method in (:pixel_sum, :pixel_interpolated)
    rough = ee_radius(image, 35.4, 37.2; method = method)
    @test rough.radius ≈ half.radius atol = 0.3
    @test isnan(rough.error)
end
@test_throws ArgumentError ee_radius(image, 35.4, 37.2; method = :guess)
@test status_of(() -> ee_radius(image, 35.4, 37.2, 1.5)) < 0

@test fwhm(image, 35.4, 37.2) ≈ sigma * sqrt(8log(2)) atol = 0.3

@test profile_fwhm(image, 35.4, 37.2).fwhm ≈ sigma * sqrt(8log(2)) atol = 1e-6
profile, errors = radial_profile(image, 35.4, 37.2, [0, 5])
@test profile[2] / profile[1] ≈ exp(-25 / (2 * sigma^2)) atol = 1e-8
@test all(0 .<= errors .< 1e-10 * profile[1])
@test ee_radius_derivative(image, image, 35.4, 37.2; size_eps = 1e-9).derivative ≈ 0 atol = 1e-8
@test ee_radius_derivative(image, image, 35.4, 37.2; second = image).derivative ≈ 0 atol = 1e-8
