! SPDX-License-Identifier: GPL-3.0-or-later
! A star of Roman, before and after interpixel capacitance: its size, its shape and their errors.
! A call that fails ends the program; with stat= and errmsg= it would tell and go on.
program start
    use, intrinsic :: iso_fortran_env, only: real64
    use wfpsf
    implicit none

    integer, parameter :: side = 128, samples = 4 ! 32 x 32 native pixels, 4 x 4 samples in each
    real(real64), parameter :: middle = (side + 1) / 2.0_real64
    real(real64), target :: pixels(side, side)
    real(real64) :: psf_error, model_error, pixel_arcsec
    type(wfpsf_instrument) :: roman
    type(wfpsf_psf) :: psf
    type(wfpsf_image) :: star
    type(wfpsf_ipc_kernel) :: kernel

    call wfpsf_check_version()
    call roman%create("roman-c9")
    call roman%constant("pixel_scale", pixel_arcsec)

    ! The PSF in the middle of detector 7, at the band's effective wavelength.
    call psf%create_in_band(roman, "H158", 7, 2044.5_real64, 2044.5_real64, 0.0_real64)
    call psf%get(wfpsf_psf_error_estimate, psf_error)
    call psf%get(wfpsf_psf_model_error, model_error)

    ! A star in the middle of an image on our own memory, the first pixel's centre at (1, 1).
    call star%wrap(pixels, samples)
    call psf%draw(middle, middle, 1.0_real64, star)
    call measure("optics  ")

    ! alpha = 0.02, alpha' = 0.002, alpha+ = 0, in place.
    call kernel%create(0.02_real64, 0.002_real64, 0.0_real64)
    call kernel%apply(star, wfpsf_edge_zero, star)
    call measure("with IPC")

    print "(a, f8.6, a, f8.6, a)", "any pixel of the PSF: within ", 100 * psf_error, &
        " % of the peak; its pupil's outline: ", 100 * model_error, " %"

contains

    subroutine measure(what)
        character(len=*), intent(in) :: what
        type(wfpsf_moments) :: moments
        real(real64) :: sigma, e1, e2, error

        call moments%measure(star)
        call moments%get(wfpsf_moments_sigma, sigma)
        call moments%get(wfpsf_moments_e1, e1)
        call moments%get(wfpsf_moments_e2, e2)
        call moments%get(wfpsf_moments_error_estimate, error)
        sigma = sigma * 1000 * pixel_arcsec / samples
        error = error / 2 + 2 * psf_error ! of the measurement and of the PSF, relative
        print "(a, ' sigma ', f10.6, ' mas, e1 ', f9.6, ', e2 ', f9.6, ', error of sigma ', " // &
            "f8.6, ' mas')", what, sigma, e1, e2, sigma * error
    end subroutine measure

end program start
