! SPDX-License-Identifier: GPL-3.0-or-later
! Observations: positions both ways, the first pixel being (1, 1); headers, the Sun, refusals.
program test_observation
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use, intrinsic :: iso_fortran_env, only: int32, int64, real64
    use expectations, only: expect
    use wfpsf
    implicit none
    type(wfpsf_instrument) :: roman
    type(wfpsf_observation) :: observation
    real(real64) :: ra(2), dec(2), x(2), y(2), found_x(2), found_y(2), jacobian(2, 2, 2), area(2), &
        angle(2), date, sun_angle, pa, value
    integer(int32) :: sca(2)
    integer(int64) :: undefined, x_first, x_last, y_first, y_last
    integer :: stat
    logical :: allowed
    character(len=:), allocatable :: text
    character(len=200) :: line

    call roman%create("roman-c9")
    call observation%create(roman, 60.0_real64, -30.0_real64, 30.0_real64)
    ! The reference pixel of FITS is (2044, 2044) here too.
    call observation%get(7, wfpsf_observation_crval1, value)
    x = [2044, -99999]
    y = [2044, 1]
    call observation%pixel_to_sky(7, x, y, ra, dec, undefined)
    call expect(undefined == 1_int64 .and. ieee_is_nan(ra(2)), "undefined")
    call expect(abs(ra(1) - value) < 1e-12_real64, "crval1")
    call observation%sky_to_pixel(7, ra, dec, found_x, found_y)
    call expect(abs(found_x(1) - 2044) < 1e-7_real64, "sky_to_pixel")
    call observation%find_sca(.true., ra, dec, sca, found_x, found_y)
    call expect(sca(1) == 7 .and. sca(2) == 0, "find_sca")
    call expect(abs(found_y(1) - 2044) < 1e-7_real64 .and. ieee_is_nan(found_y(2)), "find_sca y")
    call observation%get_bounds(7, .true., x_first, x_last, y_first, y_last)
    call expect(x_first == -168 .and. x_last == 4088 .and. y_first == -413, "bounds")
    call observation%jacobian(7, x, y, jacobian, area, angle)
    call expect(abs(area(1) - abs(jacobian(1, 1, 1) * jacobian(2, 2, 1) &
        - jacobian(2, 1, 1) * jacobian(1, 2, 1))) < 1e-15_real64, "area")
    call observation%fits_header(7, text)
    call expect(mod(len(text), 80) == 0 .and. index(text, "RA---TAN-SIP") > 0, "header")
    call observation%create_aimed(roman, 3, 1.0_real64, 1.0_real64, 10.0_real64, 5.0_real64, 0.0_real64)
    x = 1
    y = 1
    call observation%pixel_to_sky(3, x, y, ra, dec)
    call expect(abs(ra(1) - 10) < 1e-10_real64 .and. abs(dec(1) - 5) < 1e-10_real64, "aimed")

    call wfpsf_get_julian_date(2026, 3, 20, 14, 46, 0.0_real64, date)
    call wfpsf_get_sun_position(date, ra(1), dec(1))
    call wfpsf_check_pointing(roman, ra(1) + 90, 0.0_real64, date, sun_angle, allowed)
    call expect(allowed .and. abs(sun_angle - 90) < 1e-6_real64, "allowed")
    call wfpsf_get_best_pa(roman, ra(1) + 90, 0.0_real64, date, pa)
    call expect(abs(pa - dec(1)) < 1e-6_real64, "best_pa")
    call observation%create_on_date(roman, ra(1), dec(1), date, stat=stat, errmsg=line)
    call expect(stat == wfpsf_error_sun_angle .and. observation%is_empty(), "Sun")
    call observation%create(roman, 0.0_real64, 91.0_real64, 0.0_real64, stat=stat, errmsg=line)
    call expect(stat == wfpsf_error_range .and. index(line, "dec_deg = 91") == 1, "dec")
    call observation%create(roman, 0.0_real64, 1.0_real64, 0.0_real64)
    call observation%sky_to_pixel(7, ra, dec(:1), found_x, found_y, stat=stat)
    call expect(stat == wfpsf_error_size, "sizes")
end program test_observation
