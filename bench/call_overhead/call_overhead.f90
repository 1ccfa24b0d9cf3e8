! SPDX-License-Identifier: GPL-3.0-or-later
! What a call costs in Fortran: see call_overhead.c.
program call_overhead
    use, intrinsic :: iso_fortran_env, only: int64, real64
    use wfpsf
    implicit none

    integer, parameter :: rounds = 20, side = 24
    integer, parameter :: keys(22) = [wfpsf_moments_centroid_x, wfpsf_moments_centroid_y, &
        wfpsf_moments_mxx, wfpsf_moments_mxy, wfpsf_moments_myy, wfpsf_moments_sigma, &
        wfpsf_moments_sigma_trace, wfpsf_moments_e1, wfpsf_moments_e2, wfpsf_moments_e, &
        wfpsf_moments_beta, wfpsf_moments_flux, wfpsf_moments_rho4, wfpsf_moments_passes, &
        wfpsf_moments_error_estimate, wfpsf_moments_residual, wfpsf_moments_curvature, &
        wfpsf_moments_edge_fraction, wfpsf_moments_missing_fraction, wfpsf_moments_amplitude, &
        wfpsf_moments_last_step, wfpsf_moments_pixels]

    type(wfpsf_instrument) :: instrument
    type(wfpsf_psf) :: psf
    type(wfpsf_image) :: image, star

    call instrument%create("wfirst-afta-c5")
    call psf%create(instrument, 7, 1292.0_real64)
    call image%create(wfpsf_float64, side, side, 1)
    call star%create(wfpsf_float64, side, side, 4)
    call psf%draw(12.25_real64, 13.5_real64, 1.0_real64, star)
    call measure("property", property, 100000)
    call measure("add_star", add_star, 2000)
    call measure("draw", draw, 2000)
    call measure("moments", moments, 2000)

contains

    subroutine property()
        real(real64) :: value

        call psf%get(wfpsf_psf_peak, value)
    end subroutine property

    subroutine add_star()
        call psf%add_stars([12.25_real64], [13.5_real64], [1.0_real64], image)
    end subroutine add_star

    subroutine draw()
        call psf%draw(12.25_real64, 13.5_real64, 1.0_real64, image)
    end subroutine draw

    subroutine moments()
        type(wfpsf_moments) :: found
        real(real64) :: value
        integer :: i

        call found%measure(star)
        do i = 1, size(keys)
            call found%get(keys(i), value)
        end do
    end subroutine moments

    subroutine measure(name, action, calls)
        character(len=*), intent(in) :: name
        interface
            subroutine action()
            end subroutine action
        end interface
        integer, intent(in) :: calls
        real(real64) :: least
        integer(int64) :: start, end, per_second
        integer :: round, i

        least = huge(least)
        do round = 1, rounds
            call system_clock(start, per_second)
            do i = 1, calls
                call action()
            end do
            call system_clock(end)
            least = min(least, real(end - start, real64) / per_second / calls * 1e9_real64)
        end do
        print "(a, a10, f11.0, a)", "Fortran  ", name // repeat(" ", 10 - len(name)), least, " ns"
    end subroutine measure
end program call_overhead
