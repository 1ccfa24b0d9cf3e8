# SPDX-License-Identifier: GPL-3.0-or-later

roman = Instrument("roman-c9")
observation = Observation(roman, 60, -30, 30)
keywords = properties(observation, 7)
sky = pixel_to_sky(observation, 7, 2044, 2044)
@test sky.ra_deg ≈ keywords.crval1 rtol = 1e-14
@test keywords.pa_fpa ≈ 150
x, y = sky_to_pixel(observation, 7, [sky.ra_deg, NaN], [sky.dec_deg, 0])
@test x[1] ≈ 2044 && y[1] ≈ 2044 && isnan(x[2])
found = find_sca(observation, [sky.ra_deg, 0], [sky.dec_deg, 0]; with_gaps = true)
@test found.sca == [7, 0] && found.y[1] ≈ 2044 && isnan(found.x[2])
@test sca_bounds(observation, 7) == (x = 1:4088, y = 1:4088)
@test sca_bounds(observation, 7; with_gaps = true) == (x = -168:4088, y = -413:4502)
local_frame = pixel_jacobian(observation, 7, 2044, 2044)
j = local_frame.jacobian
@test local_frame.area ≈ abs(j[1, 1] * j[2, 2] - j[1, 2] * j[2, 1])
@test local_frame.y_angle_deg ≈ atand(j[1, 2], j[2, 2])
@test all(card -> length(card) == 80, fits_header(observation, 7))
@test fits_header(observation, 7)[2][12:23] == "RA---TAN-SIP"
peer = Observation(roman, 60, -30, 30; wcs_rule = 1)
corner = sky_to_pixel(peer, 7, pixel_to_sky(observation, 7, 1, 1)...)
@test 5 < hypot(corner.x - 1, corner.y - 1) < 30
to = aimed(roman, 3, 1, 1, 10, 5, 0)
@test collect(pixel_to_sky(to, 3, 1, 1)) ≈ [10, 5]

date = julian_date(2026, 3, 20, 14, 46)
sun = sun_position(date)
@test pointing_allowed(roman, sun.ra_deg + 90, 0, date).allowed
@test best_pa(roman, sun.ra_deg + 90, 0, date) ≈ sun.dec_deg
@test properties(on_date(roman, sun.ra_deg + 90, 0, date), 1).pa ≈ sun.dec_deg
@test status_of(() -> best_pa(roman, sun..., date)) == LibWfpsf.WFPSF_ERROR_SUN_ANGLE
@test status_of(() -> Observation(roman, 0, 91, 0)) == LibWfpsf.WFPSF_ERROR_RANGE
@test_throws DimensionMismatch sky_to_pixel(observation, 1, [1, 2], [1])
