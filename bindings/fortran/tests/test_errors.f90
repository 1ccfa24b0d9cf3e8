! SPDX-License-Identifier: GPL-3.0-or-later
! stat and errmsg, objects used too early or twice, objects that go out of scope.
program test_errors
    use, intrinsic :: iso_fortran_env, only: real64
    use expectations, only: expect
    use wfpsf
    implicit none
    type :: holder
        type(wfpsf_options) :: options
    end type holder

    call takes_stat_and_errmsg()
    call passes_warnings()
    call refuses_empty_objects()
    call starts_anew()
    call frees_what_leaves_scope()
    call wfpsf_check_version()
    call expect(index(wfpsf_library_version(), ".") > 0, "version")

contains

    subroutine takes_stat_and_errmsg()
        type(wfpsf_instrument) :: instrument
        type(wfpsf_psf) :: psf
        integer :: stat
        character(len=100) :: line
        character(len=5) :: short

        line = "as it was"
        call instrument%create("wfirst-afta-c5", stat, line)
        call expect(stat == wfpsf_ok .and. line == "as it was", "success leaves errmsg alone")
        call psf%create(instrument, 19, 1000.0_real64, stat=stat, errmsg=line)
        call expect(stat == wfpsf_error_range, "stat of an error")
        call expect(line(:8) == "sca = 19", "errmsg of an error")
        call psf%create(instrument, 19, 1000.0_real64, stat=stat, errmsg=short)
        call expect(short == "sca =", "errmsg is cut")
        call psf%create(instrument, 0, 1000.0_real64, stat=stat)
        call expect(stat == wfpsf_error_range .and. psf%is_empty(), "stat alone")
    end subroutine takes_stat_and_errmsg

    subroutine passes_warnings()
        real(real64), target :: array(64, 64)
        type(wfpsf_image) :: image
        type(wfpsf_options) :: options
        type(wfpsf_moments) :: moments
        real(real64) :: sigma
        integer :: x, y, stat
        character(len=200) :: line

        do y = 1, 64
            do x = 1, 64
                array(x, y) = 1 / (1 + (x - 30)**2 + 2 * (y - 33)**2)**2.0_real64
            end do
        end do
        call image%wrap(array, 1)
        call options%create()
        call options%set(wfpsf_option_moments_max_passes, 1)
        line = ""
        call moments%measure(image, options, stat, line)
        call expect(stat == wfpsf_warning_not_converged .and. line /= "", "a warning")
        call moments%measure(image, options)
        call moments%get(wfpsf_moments_sigma, sigma)
        call expect(sigma > 0, "the result of a warning without stat")

        ! A measurement that fails holds its last iterate.
        array = -1
        call moments%measure(image, stat=stat)
        call expect(stat < 0 .and. .not. moments%is_empty(), "a failed measurement")
        call expect(moments%status() == stat, "its status")
    end subroutine passes_warnings

    subroutine refuses_empty_objects()
        type(wfpsf_instrument) :: instrument
        type(wfpsf_psf) :: psf
        type(wfpsf_options) :: options
        type(wfpsf_image) :: image
        type(wfpsf_moments) :: moments
        real(real64), allocatable :: pixels(:, :)
        integer :: stat

        call expect(instrument%is_empty(), "an object before create")
        call psf%create(instrument, 7, 1000.0_real64, stat=stat)
        call expect(stat == wfpsf_error_null, "an empty instrument")
        call options%set(wfpsf_option_eps, 1e-3_real64, stat)
        call expect(stat == wfpsf_error_null, "empty options")
        call image%get_pixels(pixels, stat)
        call expect(stat == wfpsf_error_null .and. size(pixels) == 0, "an empty image")
        call moments%measure(image, stat=stat)
        call expect(stat == wfpsf_error_null .and. moments%is_empty(), "moments of nothing")
    end subroutine refuses_empty_objects

    subroutine starts_anew()
        type(wfpsf_options) :: options
        real(real64) :: value

        call options%create()
        call options%set(wfpsf_option_struts, 0)
        call options%create()
        call options%get(wfpsf_option_struts, value)
        call expect(nint(value) == 1, "created again")
        call options%destroy()
        call options%destroy()
        call expect(options%is_empty(), "destroyed twice")
    end subroutine starts_anew

    ! The sanitizers and valgrind see what is not freed: 32 MB a turn here.
    subroutine frees_what_leaves_scope()
        integer :: i

        do i = 1, 100
            call leave_objects()
        end do
    end subroutine frees_what_leaves_scope

    subroutine leave_objects()
        type(wfpsf_image) :: image, several(3)
        type(wfpsf_image), allocatable :: made
        type(holder) :: outer

        call image%create(wfpsf_float64, 1000, 1000, 1)
        call several(1)%create(wfpsf_float64, 1000, 1000, 1)
        call several(3)%create(wfpsf_float64, 1000, 1000, 1)
        allocate (made)
        call made%create(wfpsf_float64, 1000, 1000, 1)
        call outer%options%create()
    end subroutine leave_objects

end program test_errors
