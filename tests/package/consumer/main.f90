! SPDX-License-Identifier: GPL-3.0-or-later
! The program of main.c in Fortran: positions count from 1, errors end the program.
program main
    use, intrinsic :: iso_fortran_env, only: real64
    use wfpsf
    implicit none

    real(real64), target :: pixels(64, 64)
    real(real64) :: sigma
    character(len=32) :: expected
    type(wfpsf_instrument) :: roman
    type(wfpsf_psf) :: psf
    type(wfpsf_image) :: image
    type(wfpsf_ipc_kernel) :: kernel
    type(wfpsf_moments) :: moments

    call get_command_argument(1, expected)
    if (wfpsf_library_version() /= trim(expected)) error stop "another version"
    call wfpsf_check_version()
    call roman%create("roman-c9")
    call psf%create_in_band(roman, "H158", 4, 1001.0_real64, 2001.0_real64, 0.0_real64)
    call image%wrap(pixels, 4)
    call psf%draw(32.2_real64, 33.1_real64, 1000.0_real64, image)
    call kernel%create_default(roman)
    call kernel%apply(image, wfpsf_edge_zero, image)
    call moments%measure(image)
    call moments%get(wfpsf_moments_sigma, sigma)
    print "(a, f0.9)", "sigma = ", sigma
end program main
