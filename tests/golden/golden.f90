! SPDX-License-Identifier: GPL-3.0-or-later
!
! golden CASES RESULTS: the golden cases in Fortran; golden.c says what they are. Positions count
! from 1 here; those of the cases are such that adding 1 rounds nothing.
program golden
    use, intrinsic :: iso_fortran_env, only: real64
    use wfpsf
    implicit none

    character(len=1000) :: path
    character(len=32) :: name, instrument_name, band
    integer :: cases, results, stat, sca, struts, nx, ny, oversampling
    real(real64) :: x, y, wavelength_nm, star_x, star_y, flux, alpha, alpha_prime, alpha_plus, noise

    call get_command_argument(1, path)
    open (newunit=cases, file=trim(path), status="old", action="read")
    call get_command_argument(2, path)
    open (newunit=results, file=trim(path), status="replace", action="write")
    write (results, "(a)") "case quantity value"
    read (cases, *) ! the header
    do
        read (cases, *, iostat=stat) name, instrument_name, band, sca, x, y, wavelength_nm, struts, &
            nx, ny, oversampling, star_x, star_y, flux, alpha, alpha_prime, alpha_plus, noise
        if (stat /= 0) exit
        call run()
    end do

contains

    subroutine run()
        type(wfpsf_instrument) :: instrument
        type(wfpsf_options) :: options
        type(wfpsf_psf) :: psf
        type(wfpsf_image) :: star, blurred
        type(wfpsf_ipc_kernel) :: kernel
        type(wfpsf_moments) :: moments
        real(real64), allocatable, target :: drawn(:, :), after(:, :)
        real(real64) :: value

        allocate (drawn(nx, ny), after(nx, ny))
        call instrument%create(trim(instrument_name))
        call options%create()
        call options%set(wfpsf_option_struts, struts)
        call options%set(wfpsf_option_seed, 20150901)
        call psf%create_in_band(instrument, trim(band), sca, x + 1, y + 1, wavelength_nm, options)
        call psf%get(wfpsf_psf_wavelength_nm, value)
        call tell("wavelength_nm", value)
        call psf%get(wfpsf_psf_peak, value)
        call tell("peak", value)

        call star%wrap(drawn, oversampling)
        call psf%draw(star_x + 1, star_y + 1, flux, star)
        call tell_pixels("drawn", drawn)

        call blurred%wrap(after, oversampling)
        call kernel%create(alpha, alpha_prime, alpha_plus)
        call kernel%apply(star, wfpsf_edge_zero, blurred)
        call tell_pixels("blurred", after)

        call blurred%ee_radius(star_x + 1, star_y + 1, 0.25_real64, &
            wfpsf_size_pixel_interpolated, value)
        call tell("ee25", value)
        call moments%measure_unweighted(blurred, star_x + 1, star_y + 1)
        call tell_moment(moments, "unweighted_mxx", wfpsf_moments_mxx)
        call moments%measure(blurred)
        call tell_moment(moments, "sigma", wfpsf_moments_sigma)
        call tell_moment(moments, "e1", wfpsf_moments_e1)
        call tell_moment(moments, "e2", wfpsf_moments_e2)
        call tell_moment(moments, "flux", wfpsf_moments_flux)
        call tell_moment(moments, "rho4", wfpsf_moments_rho4)

        call wfpsf_add_noise(blurred, noise, options=options)
        call tell_pixels("noisy", after)
    end subroutine run

    subroutine tell_moment(moments, quantity, key)
        type(wfpsf_moments), intent(in) :: moments
        character(len=*), intent(in) :: quantity
        integer, intent(in) :: key
        real(real64) :: value

        call moments%get(key, value)
        call tell(quantity, value)
    end subroutine tell_moment

    subroutine tell(quantity, value)
        character(len=*), intent(in) :: quantity
        real(real64), intent(in) :: value

        write (results, "(a, 1x, a, 1x, es24.16e3)") trim(name), quantity, value
    end subroutine tell

    subroutine tell_pixels(quantity, pixels)
        character(len=*), intent(in) :: quantity
        real(real64), intent(in) :: pixels(:, :)

        call tell(quantity // "_0", pixels(1, 1))
        call tell(quantity // "_1", pixels(nx / 2 + 1, ny / 2 + 1))
        call tell(quantity // "_2", pixels(nx - 1, ny))
    end subroutine tell_pixels
end program golden
