! SPDX-License-Identifier: GPL-3.0-or-later
! SEDs, PSFs of many colours, blur, and long work that tells how far it is.
module countdowns
    use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int32_t, c_ptr
    use expectations, only: expect
    implicit none
    private
    public :: count_down

contains

    ! Stops when the number that user points to is down to 0.
    function count_down(part, user) bind(c) result(outcome)
        real(c_double), value :: part
        type(c_ptr), value :: user
        integer(c_int32_t) :: outcome
        integer, pointer :: left

        call expect(part >= 0 .and. part <= 1, "a part of the work")
        call c_f_pointer(user, left)
        left = left - 1
        outcome = merge(1, 0, left == 0)
    end function count_down

end module countdowns

program test_colours
    use, intrinsic :: iso_c_binding, only: c_loc
    use, intrinsic :: iso_fortran_env, only: real64
    use countdowns, only: count_down
    use expectations, only: expect
    use wfpsf
    implicit none
    real(real64), parameter :: eps = 1e-5_real64
    type(wfpsf_instrument) :: roman
    type(wfpsf_options) :: options

    call roman%create("roman-c9")
    call options%create()
    call options%set(wfpsf_option_eps, eps)
    call options%set(wfpsf_option_psf_radius, 6.0_real64)
    call makes_seds()
    call makes_one_psf()
    call makes_a_varying_psf()
    call makes_several_psfs()
    call blurs()
    call shows_progress()

contains

    function ratio(sed, numerator_nm, denominator_nm)
        type(wfpsf_sed), intent(in) :: sed
        real(real64), intent(in) :: numerator_nm, denominator_nm
        real(real64) :: ratio, photons(2)

        call sed%photon_density([numerator_nm, denominator_nm], photons)
        ratio = photons(1) / photons(2)
    end function ratio

    subroutine draw(psf, pixels)
        type(wfpsf_psf), intent(in) :: psf
        real(real64), target, intent(out) :: pixels(:, :)
        type(wfpsf_image) :: image

        call image%wrap(pixels, 1)
        call psf%draw(6.1_real64, 5.8_real64, 1.0_real64, image)
    end subroutine draw

    subroutine makes_seds()
        real(real64), parameter :: nm(3) = [500, 1000, 2000], density(3) = [1, 3, 1]
        type(wfpsf_sed) :: table, red, ab, sun
        real(real64) :: photons(2)
        integer :: stat

        call ab%create_power_law(wfpsf_sed_energy, -2.0_real64)
        call expect(abs(ratio(ab, 1000.0_real64, 2000.0_real64) - 2) < 1e-14_real64, "an AB source")
        call sun%create_black_body(5772.0_real64)
        call expect(ratio(sun, 650.0_real64, 630.0_real64) < 1, "a black body, red of its peak")
        call expect(ratio(sun, 634.0_real64, 600.0_real64) > 1, "and blue of it")
        call table%create_table(wfpsf_sed_photons, nm, density)
        call expect(abs(ratio(table, 750.0_real64, 500.0_real64) - 2) < 1e-14_real64, "a table")
        call red%create_redshifted(table, 1.0_real64)
        call table%destroy()
        call expect(table%is_empty(), "an SED that was destroyed")
        call expect(abs(ratio(red, 1500.0_real64, 1000.0_real64) - 2) < 1e-14_real64, "a redshift")

        call table%create_table(wfpsf_sed_photons, nm, density(:2), stat)
        call expect(stat == wfpsf_error_size .and. table%is_empty(), "a table of two sizes")
        call table%create_table(3, nm, density, stat)
        call expect(stat == wfpsf_error_argument, "no such unit")
        call red%photon_density(nm, photons, stat)
        call expect(stat == wfpsf_error_size, "densities of two sizes")
        call table%photon_density(nm(:2), photons, stat)
        call expect(stat == wfpsf_error_null, "an empty SED")
        call red%create_redshifted(table, 1.0_real64, stat)
        call expect(stat == wfpsf_error_null .and. red%is_empty(), "a redshift of nothing")
        call sun%create_black_body(-1.0_real64, stat)
        call expect(stat == wfpsf_error_range .and. sun%is_empty(), "a cold black body")
    end subroutine makes_seds

    ! A narrow line is as good as one wavelength.
    subroutine makes_one_psf()
        real(real64), parameter :: nm(5) = [500.0_real64, 1299.999_real64, 1300.0_real64, &
            1300.001_real64, 2500.0_real64]
        real(real64) :: through_line(11, 11), at_wavelength(11, 11), wavelength
        type(wfpsf_sed) :: line, none
        type(wfpsf_psf) :: psf, single
        integer :: stat
        character(len=100) :: text

        call line%create_table(wfpsf_sed_energy, nm, [real(real64) :: 0, 0, 1, 0, 0])
        call psf%create_chromatic(roman, "J129", 3, 100.0_real64, 4000.0_real64, line, options)
        call psf%get(wfpsf_psf_wavelength_nm, wavelength)
        call expect(abs(wavelength - 1300) < 1e-3_real64, "mean wavelength")
        call single%create_in_band(roman, "J129", 3, 100.0_real64, 4000.0_real64, 1300.0_real64, &
            options)
        call draw(psf, through_line)
        call draw(single, at_wavelength)
        call expect(maxval(abs(through_line - at_wavelength)) < 2 * eps * maxval(at_wavelength), &
            "a narrow line")

        call psf%create_chromatic(roman, "J129", 3, -700.0_real64, 1.0_real64, line, stat=stat, &
            errmsg=text)
        call expect(stat == wfpsf_error_range .and. psf%is_empty(), "beside the detector")
        call expect(index(text, "x = -701") > 0, "a position that counts from 1")
        call psf%create_chromatic(roman, "J129", 3, 1.0_real64, 1.0_real64, none, stat=stat)
        call expect(stat == wfpsf_error_null, "no SED")
    end subroutine makes_one_psf

    ! All over a detector: the PSF at a place, and a star that has it.
    subroutine makes_a_varying_psf()
        real(real64), target :: exact(11, 11), model(11, 11), star(11, 11)
        type(wfpsf_varying_psf) :: varying
        type(wfpsf_sed) :: flat
        type(wfpsf_image) :: image
        type(wfpsf_psf) :: psf
        real(real64) :: value
        integer :: stat

        call psf%create_in_band(roman, "J129", 3, 100.0_real64, 4000.0_real64, 1300.0_real64, &
            options)
        call draw(psf, exact)
        call varying%create(roman, "J129", 3, wavelength_nm=1300.0_real64, options=options)
        call varying%at(100.0_real64, 4000.0_real64, psf)
        call draw(psf, model)
        call expect(maxval(abs(model - exact)) < 2 * eps * maxval(exact), "at a place")
        call varying%get(wfpsf_varying_psf_rank, value)
        call expect(value > 1, "its rank")
        star = 0
        call image%wrap(star, 1)
        call varying%add_stars(94.9_real64, 3995.2_real64, [6.1_real64], [5.8_real64], &
            [1.0_real64], image)
        call expect(maxval(abs(star - model)) < 0.1_real64 * eps * maxval(model), &
            "a star of its own place")
        call varying%at(9000.0_real64, 1.0_real64, psf, stat)
        call expect(stat == wfpsf_error_range .and. psf%is_empty(), "beside the detector")
        call flat%create_power_law(wfpsf_sed_photons, 0.0_real64)
        call varying%create(roman, "J129", 3, 1300.0_real64, flat, options, stat)
        call expect(stat == wfpsf_error_argument .and. varying%is_empty(), "two colours at once")
    end subroutine makes_a_varying_psf

    subroutine makes_several_psfs()
        type(wfpsf_sed) :: seds(2)
        type(wfpsf_psf) :: alone, psfs(2)
        real(real64) :: one(11, 11), shared(11, 11), wavelength(2), wavelengths
        integer :: i, stat

        call seds(1)%create_power_law(wfpsf_sed_photons, 0.0_real64)
        call seds(2)%create_black_body(3500.0_real64)
        call wfpsf_psf_create_chromatic_each(roman, "J129", 3, 100.0_real64, 4000.0_real64, seds, &
            psfs, options)
        do i = 1, 2
            call alone%create_chromatic(roman, "J129", 3, 100.0_real64, 4000.0_real64, seds(i), &
                options)
            call draw(alone, one)
            call draw(psfs(i), shared)
            call expect(maxval(abs(one - shared)) < 2 * eps * maxval(one), "shared images")
            call psfs(i)%get(wfpsf_psf_wavelength_nm, wavelength(i))
            call psfs(i)%get(wfpsf_psf_wavelengths, wavelengths)
            call expect(wavelengths > 2, "many wavelengths")
        end do
        call expect(wavelength(2) < wavelength(1), "a star that is bluer than flat")

        call wfpsf_psf_create_chromatic_each(roman, "J129", 3, 1.0_real64, 1.0_real64, seds(:1), &
            psfs, options, stat)
        call expect(stat == wfpsf_error_size .and. all([(psfs(i)%is_empty(), i = 1, 2)]), &
            "SEDs and PSFs of two sizes")
        call psfs(1)%create_chromatic(roman, "J129", 3, 1.0_real64, 1.0_real64, seds(1), options)
        call seds(2)%destroy()
        call wfpsf_psf_create_chromatic_each(roman, "J129", 3, 1.0_real64, 1.0_real64, seds, psfs, &
            options, stat)
        call expect(stat == wfpsf_error_null .and. psfs(1)%is_empty(), "one SED is empty")
        call wfpsf_psf_create_chromatic_each(roman, "J129", 3, 1.0_real64, 1.0_real64, seds(:0), &
            psfs(:0), options, stat)
        call expect(stat == wfpsf_error_size, "no SEDs")
    end subroutine makes_several_psfs

    ! 0.3 pixels of 0.11 arcsec are as good as jitter.
    subroutine blurs()
        type(wfpsf_options) :: blur
        type(wfpsf_psf) :: psf
        real(real64) :: sharp(11, 11), diffused(11, 11), jittered(11, 11)
        integer :: stat

        call blur%create()
        call blur%set(wfpsf_option_psf_radius, 6.0_real64)
        call psf%create_in_band(roman, "J129", 3, 1.0_real64, 1.0_real64, 0.0_real64, blur)
        call draw(psf, sharp)
        call blur%set(wfpsf_option_charge_diffusion, 0.3_real64)
        call psf%create_in_band(roman, "J129", 3, 1.0_real64, 1.0_real64, 0.0_real64, blur)
        call draw(psf, diffused)
        call expect(maxval(diffused) < 0.95_real64 * maxval(sharp), "charge diffusion")
        call blur%reset(wfpsf_option_charge_diffusion)
        call blur%set(wfpsf_option_jitter_xx, 0.033_real64**2)
        call blur%set(wfpsf_option_jitter_yy, 0.033_real64**2)
        call psf%create_in_band(roman, "J129", 3, 1.0_real64, 1.0_real64, 0.0_real64, blur)
        call draw(psf, jittered)
        call expect(maxval(abs(jittered - diffused)) < 1e-12_real64, "jitter")
        call blur%set(wfpsf_option_jitter_xy, -0.0011_real64)
        call psf%create_in_band(roman, "J129", 3, 1.0_real64, 1.0_real64, 0.0_real64, blur, stat)
        call expect(stat == wfpsf_error_range, "no covariance")
    end subroutine blurs

    subroutine shows_progress()
        type(wfpsf_options) :: watched
        type(wfpsf_sed) :: flat
        type(wfpsf_psf) :: psf
        integer, target :: left
        integer :: stat

        call flat%create_power_law(wfpsf_sed_photons, 0.0_real64)
        call watched%set_progress(count_down, c_loc(left), stat)
        call expect(stat == wfpsf_error_null, "progress of empty options")
        call watched%create()
        call watched%set(wfpsf_option_eps, 1e-3_real64)
        call watched%set_progress(count_down, c_loc(left))
        left = 1000
        call psf%create_chromatic(roman, "J129", 3, 1.0_real64, 1.0_real64, flat, watched)
        call expect(left < 1000, "progress was told")
        left = 2
        call psf%create_chromatic(roman, "J129", 3, 1.0_real64, 1.0_real64, flat, watched, stat)
        call expect(stat == wfpsf_error_cancelled .and. left == 0 .and. psf%is_empty(), "stopped")
        call watched%set_progress()
        call psf%create_chromatic(roman, "J129", 3, 1.0_real64, 1.0_real64, flat, watched)
        call expect(left == 0, "progress was taken away")
    end subroutine shows_progress

end program test_colours
