! SPDX-License-Identifier: GPL-3.0-or-later
! The first pixel is (1, 1) wherever a position goes in or comes out.
program test_positions
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use, intrinsic :: iso_fortran_env, only: int64, real64
    use expectations, only: expect
    use wfpsf
    implicit none
    real(real64), parameter :: eps = 1e-6_real64

    call of_a_gaussian()
    call of_a_masked_gaussian()
    call of_options()
    call of_a_star()
    call of_a_mask()
    call of_a_galaxy()
    call of_an_otf()
    call of_a_pupil()

contains

    ! Flux 1 at (x0, y0), counted from (1, 1); sigma = 4 leaves no trace of the sampling.
    subroutine gaussian(x0, y0, array)
        real(real64), intent(in) :: x0, y0
        real(real64), intent(out) :: array(:, :)
        real(real64), parameter :: sigma = 4
        integer :: x, y

        do y = 1, size(array, 2)
            do x = 1, size(array, 1)
                array(x, y) = exp(-((x - x0)**2 + (y - y0)**2) / (2 * sigma**2)) &
                    / (2 * acos(-1.0_real64) * sigma**2)
            end do
        end do
    end subroutine gaussian

    ! A star with a row that is missing, its noise, and how it answers to more light on one side.
    subroutine of_a_masked_gaussian()
        real(real64), parameter :: x0 = 40.25_real64, y0 = 33.5_real64
        real(real64), target :: array(80, 70), mask(80, 70), change_array(80, 70), slopes(80, 70)
        type(wfpsf_image) :: image, missing, change, influence
        type(wfpsf_moments) :: moments, derivatives
        type(wfpsf_options) :: options
        real(real64) :: x, y, slope, curvature, variance, sums(6), profile(2), errors(2), width
        integer :: i, stat

        call gaussian(x0, y0, array)
        do i = 1, 80
            change_array(i, :) = array(i, :) * (i - x0)
        end do
        mask = 0
        mask(:, 34) = 1
        array(:, 34) = 1e30_real64
        call image%wrap(array, 1)
        call missing%wrap(mask, 1)
        call change%wrap(change_array, 1)
        call influence%wrap(slopes, 1)
        call options%create()
        call options%set(wfpsf_option_moments_variance, 1e-8_real64)
        call moments%measure_masked(image, missing, options=options)
        call moments%get(wfpsf_moments_centroid_x, x)
        call moments%get(wfpsf_moments_centroid_y, y)
        call expect(abs(x - x0) < 1e-7_real64 .and. abs(y - y0) < 1e-7_real64, "masked centroid")
        call moments%covariance(wfpsf_moments_centroid_x, wfpsf_moments_centroid_x, variance)
        call expect(variance > 0, "variance of the centroid")
        ! I (1 + t (x - x0)) is to first order in t the Gaussian moved by sigma^2 t.
        call derivatives%differentiate(moments, image, change)
        call derivatives%get(wfpsf_moments_centroid_x, slope)
        call expect(abs(slope - 16) < 1e-6_real64, "derivative of the centroid")
        call derivatives%differentiate(moments, image, change, change)
        call derivatives%get(wfpsf_moments_centroid_x, curvature)
        call expect(abs(curvature) < 1e-5_real64, "second derivative of the centroid")
        call moments%influence(image, wfpsf_moments_centroid_x, influence)
        call expect(abs(sum(slopes * change_array) - 16) < 1e-6_real64, "influence function")
        call derivatives%differentiate(derivatives, image, change, stat=stat)
        call expect(stat == wfpsf_error_argument, "derivative of a derivative")

        call gaussian(x0, y0, array)
        call image%moment_sums(x0, y0, sums)
        call expect(abs(sums(4) - 16) < 1e-6_real64, "second moment")
        call image%moment_sums(x0, y0, sums, weight=[16.0_real64, 0.0_real64, 16.0_real64])
        call expect(abs(sums(1) - 0.5_real64) < 1e-9_real64, "weighted flux")
        call image%radial_profile(x0, y0, [0.0_real64, 4.0_real64], profile, errors)
        call expect(all(errors >= 0 .and. errors < 1e-9_real64 * profile(1)), "its errors")
        call expect(abs(profile(2) / profile(1) - exp(-0.5_real64)) < 1e-9_real64, "profile")
        call image%profile_fwhm(x0, y0, width)
        call expect(abs(width - 8 * sqrt(2 * log(2.0_real64))) < 1e-8_real64, "its FWHM")
        call image%ee_radius_derivative(image, x0, y0, 0.5_real64, slope)
        call expect(abs(slope) < 1e-9_real64, "more of the same light moves no radius")
        call image%ee_radius_derivative(image, x0, y0, 0.5_real64, curvature, second=image)
        call expect(abs(curvature) < 1e-8_real64, "nor the second time")
    end subroutine of_a_masked_gaussian

    subroutine of_a_gaussian()
        real(real64), parameter :: x0 = 40.25_real64, y0 = 33.5_real64
        real(real64), target :: array(80, 70)
        type(wfpsf_image) :: image
        type(wfpsf_moments) :: moments
        type(wfpsf_options) :: options
        real(real64) :: x, y, sigma, radius, error, fraction, fwhm

        call gaussian(x0, y0, array)
        call image%wrap(array, 1)
        call options%create()
        call options%set(wfpsf_option_moments_tolerance, 1e-11_real64)
        call moments%measure(image, options)
        call moments%get(wfpsf_moments_centroid_x, x)
        call moments%get(wfpsf_moments_centroid_y, y)
        call moments%get(wfpsf_moments_sigma, sigma)
        call expect(abs(x - x0) < 1e-9_real64 .and. abs(y - y0) < 1e-9_real64, "adaptive centroid")
        call expect(abs(sigma - 4) < 1e-9_real64, "sigma")
        call expect(moments%status() == wfpsf_ok, "status of moments")

        call moments%measure_unweighted(image)
        call moments%get(wfpsf_moments_centroid_x, x)
        call expect(abs(x - x0) < 1e-9_real64, "unweighted centroid")
        call moments%measure_unweighted(image, x0 + 1, y0)
        call moments%get(wfpsf_moments_mxx, sigma)
        call expect(abs(sigma - 17) < 1e-6_real64, "unweighted moments about a point")

        call moments%measure_weighted(image, x0, y0, 16.0_real64, 0.0_real64, 16.0_real64)
        call moments%get(wfpsf_moments_centroid_x, x)
        call moments%get(wfpsf_moments_mxx, sigma)
        call expect(abs(x - x0) < 1e-9_real64, "weighted centroid")
        call expect(abs(sigma - 8) < 1e-9_real64, "moment under a fixed weight")

        ! 1 - exp(-r^2 / (2 sigma^2)) = 1/2
        call image%ee_radius(x0, y0, 0.5_real64, wfpsf_size_bandlimited, radius, error)
        call expect(abs(radius - 4 * sqrt(2 * log(2.0_real64))) < 1e-8_real64, "radius")
        call image%encircled_energy(x0, y0, radius, fraction)
        call expect(abs(fraction - 0.5_real64) < 1e-8_real64, "encircled energy")
        call image%fwhm(x0, y0, fwhm)
        call expect(abs(fwhm - 8 * sqrt(2 * log(2.0_real64))) < 0.5_real64, "FWHM")
    end subroutine of_a_gaussian

    subroutine of_options()
        real(real64), target :: array(100, 40)
        real(real64) :: value, second(100, 40)
        type(wfpsf_image) :: image
        type(wfpsf_moments) :: moments
        type(wfpsf_options) :: options

        call options%create()
        call options%get(wfpsf_option_moments_guess_x, value)
        call expect(ieee_is_nan(value), "a guess left to the library")
        call options%set(wfpsf_option_moments_guess_x, 75.0_real64)
        call options%set(wfpsf_option_moments_guess_y, 20.0_real64)
        call options%get(wfpsf_option_moments_guess_x, value)
        call expect(abs(value - 75) < 1e-12_real64, "a guess that was set")
        call options%set(wfpsf_option_eps, 1e-5_real64)
        call options%get(wfpsf_option_eps, value)
        call expect(abs(value - 1e-5_real64) < 1e-20_real64, "an option that is no position")
        call options%reset(wfpsf_option_eps)
        call options%get(wfpsf_option_eps, value)
        call expect(abs(value - 1e-6_real64) < 1e-20_real64, "an option that was reset")

        ! Of two equal objects the guess takes the second.
        call gaussian(25.0_real64, 20.0_real64, array)
        call gaussian(75.0_real64, 20.0_real64, second)
        array = array + second
        call image%wrap(array, 1)
        call options%set(wfpsf_option_moments_guess_sigma, 4.0_real64)
        call moments%measure(image, options)
        call moments%get(wfpsf_moments_centroid_x, value)
        call expect(abs(value - 75) < 1e-6_real64, "the guess finds its object")
    end subroutine of_options

    ! Two odd stamps, the star in the middle of each and a pixel off: the same pixels, moved.
    subroutine of_a_star()
        real(real64), target :: middle(33, 33), moved(33, 33), bright(33, 33)
        type(wfpsf_instrument) :: instrument
        type(wfpsf_psf) :: psf, small
        type(wfpsf_image) :: image
        type(wfpsf_options) :: options
        real(real64) :: peak
        integer(int64) :: least, most
        integer :: status

        call instrument%create("wfirst-afta-c5")
        call options%create()
        call options%set(wfpsf_option_eps, eps)
        call psf%create(instrument, 7, 1292.0_real64, options)
        call image%wrap(middle, 1)
        call psf%draw(17.0_real64, 17.0_real64, 1.0_real64, image)
        call psf%get(wfpsf_psf_peak, peak)
        call expect(all(maxloc(middle) == 17), "brightest pixel")
        call expect(abs(middle(17, 17) - peak) < 0.01_real64 * peak, "its value")
        call psf%create_in_band(instrument, "J129", 7, 2000.0_real64, 1.0_real64, 1292.0_real64, &
            options)
        call image%wrap(moved, 1)
        call psf%draw(17.0_real64, 17.0_real64, 1.0_real64, image)
        call expect(maxval(abs(moved - middle)) < 1e-14_real64, "one set of aberrations a detector")
        call psf%draw(16.0_real64, 19.0_real64, 1.0_real64, image)
        call expect(maxval(abs(moved(:32, 3:) - middle(2:, :31))) < 2 * eps * peak, "a star moved")

        ! From a small field in the least memory, and taken away again.
        call options%set(wfpsf_option_psf_radius, 4.0_real64)
        call small%create(instrument, 7, 1292.0_real64, options)
        call small%draw_memory(17.0_real64, 17.0_real64, image, least, most)
        call expect(0 < least .and. least < most, "memory of a bright star")
        call options%set(wfpsf_option_memory_limit, real(least, real64))
        call image%wrap(bright, 1)
        call small%draw(17.0_real64, 17.0_real64, 1.0_real64, image, options)
        call expect(maxval(abs(bright - middle)) < 2 * eps * peak, "a bright star")
        call small%add_bright_star(17.0_real64, 17.0_real64, -1.0_real64, image, options)
        call expect(maxval(abs(bright)) < 1e-15_real64, "its light taken away")
        call image%wrap(moved, 1)

        ! Taken away where it was drawn, as far as the PSF's radius of 16 pixels goes.
        call psf%add_stars([16.0_real64, 900.0_real64], [19.0_real64, 1.0_real64], &
            [-1.0_real64, 1.0_real64], image)
        call expect(maxval(abs(moved(:32, 3:))) < 2 * eps * peak, "a star taken away")
        call psf%add_stars([1.0_real64], [1.0_real64], [1.0_real64, 2.0_real64], image, stat=status)
        call expect(status == wfpsf_error_size, "arrays of two sizes")
    end subroutine of_a_star

    ! A disc about the axis is even: its PSF has its centroid where the star is put.
    subroutine of_a_mask()
        integer, parameter :: n = 65
        real(real64), parameter :: axis = (n + 1) / 2.0_real64
        real(real64), target :: mask(n, n), stamp(24, 21)
        real(real64), allocatable :: coefficients(:)
        type(wfpsf_instrument) :: instrument
        type(wfpsf_image) :: mask_image, image
        type(wfpsf_options) :: options
        type(wfpsf_psf) :: psf
        integer :: x, y, stat
        character(len=200) :: line

        do y = 1, n
            do x = 1, n
                mask(x, y) = merge(1, 0, (x - axis)**2 + (y - axis)**2 <= 30.0_real64**2)
            end do
        end do
        call mask_image%wrap(mask, 1)
        call instrument%create("wfirst-afta-c5")
        call instrument%zernikes(7, coefficients)
        coefficients(:3) = 0 ! the instrument's piston and tilt are left out by default
        call options%create()
        call options%set_zernikes(-coefficients)
        call options%set(wfpsf_option_eps, eps)
        call psf%create_from_mask(instrument, mask_image, 2.36_real64 / 61, axis, axis, 7, &
            1292.0_real64, options, stat, line)
        if (stat < 0) error stop line
        call image%wrap(stamp, 1)
        call psf%draw(12.5_real64, 11.0_real64, 1.0_real64, image)
        ! Even about the star: the stamp equals itself turned by 180 degrees.
        call expect(maxval(abs(stamp - stamp(24:1:-1, 21:1:-1))) < 2 * eps * maxval(stamp), &
            "even PSF")
    end subroutine of_a_mask

    ! One sample in the middle is a star.
    subroutine of_a_galaxy()
        real(real64), target :: samples(5, 7), image_pixels(15, 17), star_pixels(15, 17)
        type(wfpsf_instrument) :: instrument
        type(wfpsf_psf) :: psf
        type(wfpsf_image) :: galaxy, image, star
        integer :: status

        samples = 0
        samples(3, 4) = 2
        call galaxy%wrap(samples, 4)
        call image%wrap(image_pixels, 1)
        call star%wrap(star_pixels, 1)
        call instrument%create("wfirst-afta-c5")
        call psf%create(instrument, 7, 1292.0_real64)
        call psf%convolve(galaxy, 7.3_real64, 9.1_real64, 3.0_real64, image)
        call psf%draw(7.3_real64, 9.1_real64, 6.0_real64, star)
        call expect(maxval(abs(image_pixels - star_pixels)) < 2 * eps * maxval(star_pixels), &
            "a galaxy of one sample")
        call psf%convolve(star, 7.3_real64, 9.1_real64, 3.0_real64, image, stat=status)
        call expect(status == wfpsf_error_already_applied, "pixel response twice")
    end subroutine of_a_galaxy

    subroutine of_an_otf()
        real(real64), target :: re_pixels(5, 4), im_pixels(5, 4)
        real(real64) :: re(2), im(2), cutoff, step
        type(wfpsf_instrument) :: instrument
        type(wfpsf_options) :: options
        type(wfpsf_psf) :: psf
        type(wfpsf_otf) :: otf
        type(wfpsf_image) :: re_image, im_image
        integer :: status

        call instrument%create("wfirst-afta-c5")
        call options%create()
        call options%set(wfpsf_option_eps, 1e-3_real64)
        call psf%create(instrument, 7, 1292.0_real64, options)
        call otf%create(psf, options)
        call psf%destroy()
        call otf%get(wfpsf_otf_cutoff, cutoff)
        step = cutoff / 7
        call otf%values(wfpsf_response_effective, [0.0_real64, 2 * step], [0.0_real64, -step], re, &
            im)
        call expect(abs(re(1) - 1) < 1e-15_real64 .and. abs(im(1)) < 1e-15_real64, "OTF at zero")
        call re_image%wrap(re_pixels, 1)
        call im_image%wrap(im_pixels, 1)
        call otf%grid(wfpsf_response_effective, wfpsf_order_wrapped, step, re_image, im_image)
        call expect(abs(re_pixels(3, 4) - re(2)) < 1e-15_real64 .and. &
            abs(im_pixels(3, 4) - im(2)) < 1e-15_real64, "grid of an OTF")
        call otf%values(wfpsf_response_effective, [step], [step, step], re, im, stat=status)
        call expect(status == wfpsf_error_size, "frequencies of two sizes")
    end subroutine of_an_otf

    ! The optical axis comes back counted from 1.
    subroutine of_a_pupil()
        real(real64), target :: pixels(60, 51)
        type(wfpsf_instrument) :: instrument
        type(wfpsf_options) :: options
        type(wfpsf_image) :: image
        real(real64) :: scale_m, axis_x, axis_y
        integer :: status

        call instrument%create("wfirst-afta-c5")
        call options%create()
        call options%set(wfpsf_option_struts, 0)
        call image%wrap(pixels, 1)
        call instrument%pupil("J129", 7, image, scale_m, axis_x, axis_y, options)
        call expect(abs(axis_x - 30.5_real64) < 1e-9_real64 .and. &
            abs(axis_y - 26) < 1e-9_real64, "axis of an annulus")
        call expect(abs(scale_m - 2.36_real64 / 51) < 1e-12_real64, "its scale")
        call instrument%pupil("J129", 19, image, scale_m, axis_x, axis_y, stat=status)
        call expect(status == wfpsf_error_range, "no such detector")
    end subroutine of_a_pupil

end program test_positions
