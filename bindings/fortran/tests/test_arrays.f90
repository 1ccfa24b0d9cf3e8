! SPDX-License-Identifier: GPL-3.0-or-later
! Images on Fortran arrays: both types, any strides, no copy; pixels out of images; files; the other
! arrays that cross the border.
program test_arrays
    use, intrinsic :: iso_fortran_env, only: int64, real32, real64
    use expectations, only: expect
    use wfpsf
    implicit none
    type :: cell
        real(real64) :: weight, flux
    end type cell
    type :: odd_cell
        sequence
        real(real32) :: weight(2)
        integer :: flag
    end type odd_cell

    call wraps_float64()
    call wraps_sections()
    call wraps_float32()
    call wraps_nothing()
    call reads_and_writes()
    call interleaves()
    call passes_taps()
    call corrects_ipc()
    call varies_ipc()
    call runs_a_chain()
    call passes_instrument_arrays()
    call designs()

contains

    ! Distinct numbers: 100 x + y at pixel (x, y), which float32 holds exactly.
    function numbered(nx, ny) result(array)
        integer, intent(in) :: nx, ny
        real(real64) :: array(nx, ny)
        integer :: x, y

        array = reshape([((100.0_real64 * x + y, x = 1, nx), y = 1, ny)], [nx, ny])
    end function numbered

    ! Convolution with a kernel that moves everything by one pixel in x shows what is where.
    subroutine shift_in_x(from, to)
        type(wfpsf_image), intent(in) :: from
        type(wfpsf_image), intent(inout) :: to
        type(wfpsf_ipc_kernel) :: kernel
        real(real64) :: taps(3, 1)

        taps(:, 1) = [0.0_real64, 0.0_real64, 1.0_real64]
        call kernel%create_taps(taps)
        call kernel%apply(from, wfpsf_edge_zero, to)
    end subroutine shift_in_x

    subroutine wraps_float64()
        type(wfpsf_image) :: from, to
        real(real64), target :: a(5, 3), b(5, 3)
        integer :: pixel_type, nx, ny

        a = numbered(5, 3)
        b = -1
        call from%wrap(a, 1)
        call to%wrap(b, 1)
        call from%get_shape(pixel_type, nx, ny)
        call expect(all([pixel_type, nx, ny] == [64, 5, 3]), "shape")
        call shift_in_x(from, to)
        call expect(all(b(2:, :) == a(:4, :)) .and. all(b(1, :) == 0), "float64: (nx, ny)")
    end subroutine wraps_float64

    subroutine wraps_sections()
        type(wfpsf_image) :: from, to
        real(real64), target :: a(12, 9), b(7, 6)
        real(real64) :: expected(5, 3)
        real(real64), allocatable :: seen(:, :)
        type(cell), target :: cells(4, 3)
        type(odd_cell), target :: odd_cells(4, 3)
        real(real64), pointer :: flux(:, :)
        real(real32), pointer :: weight(:, :)
        integer :: stat

        a = numbered(12, 9)
        expected = a(11:2:-2, 8:1:-3)
        call from%wrap(a(11:2:-2, 8:1:-3), 1)
        call from%get_pixels(seen)
        call expect(all(shape(seen) == shape(expected)), "shape of a section")
        call expect(all(seen == expected), "a section backwards")

        b = -1
        call to%wrap(b(7:3:-1, 1:6:2), 1)
        call to%copy_from(from)
        call expect(all(b(7:3:-1, 1:6:2) == expected), "written through a section")
        call expect(all(b(:2, :) == -1) .and. all(b(:, 2:6:2) == -1), "and nowhere else")

        call from%wrap(a(:, 4:4), 1)
        call from%get_pixels(seen)
        call expect(all(seen == a(:, 4:4)), "one row")
        call from%wrap(a(3:3, ::2), 1)
        call from%get_pixels(seen)
        call expect(all(seen == a(3:3, ::2)), "one column")

        cells%weight = 0
        cells%flux = numbered(4, 3)
        flux => cells%flux
        call from%wrap(flux, 1)
        call from%get_pixels(seen)
        call expect(all(seen == numbered(4, 3)), "a component of a derived type")

        odd_cells%weight(1) = 0
        odd_cells%weight(2) = real(numbered(4, 3), real32)
        odd_cells%flag = 0
        weight => odd_cells%weight(2)
        call from%wrap(weight, 1, stat)
        call expect(stat == wfpsf_ok, "a component of a type of three words")
        call from%get_pixels(seen)
        call expect(all(seen == numbered(4, 3)), "its pixels")
    end subroutine wraps_sections

    subroutine wraps_float32()
        type(wfpsf_image) :: from, to
        real(real32), target :: a(4, 6), b(4, 6)
        real(real64), allocatable :: wide(:, :)
        real(real32), allocatable :: narrow(:, :)
        integer :: pixel_type

        a = real(numbered(4, 6), real32)
        b = -1
        call from%wrap(a, 1)
        call to%wrap(b, 1)
        call from%get_shape(pixel_type)
        call expect(pixel_type == wfpsf_float32, "pixel type")
        call shift_in_x(from, to)
        call expect(all(b(2:, :) == a(:3, :)), "float32")
        call from%get_pixels(wide)
        call from%get_pixels(narrow)
        call expect(all(wide == numbered(4, 6)) .and. all(narrow == a), "pixels of either type")
    end subroutine wraps_float32

    subroutine wraps_nothing()
        type(wfpsf_image) :: image
        real(real64), target :: a(0, 3), b(3, 0)
        real(real64), allocatable :: seen(:, :)
        integer :: nx, ny

        call image%wrap(a, 1)
        call image%get_shape(nx=nx, ny=ny)
        call expect(nx == 0 .and. ny == 3, "an empty image")
        call image%wrap(b, 1)
        call image%get_pixels(seen)
        call expect(all(shape(seen) == [3, 0]), "its pixels")
    end subroutine wraps_nothing

    subroutine reads_and_writes()
        character(len=*), parameter :: path = "test_arrays.fits   "
        type(wfpsf_image) :: image, again
        type(wfpsf_options) :: options
        real(real64), target :: a(7, 4)
        real(real64), allocatable :: seen(:, :)
        real(real64) :: scale
        integer :: oversampling, applied

        a = numbered(7, 4)
        call image%wrap(a, 3)
        call image%set_record(3, 0.11_real64, wfpsf_effect_ipc)
        call options%create()
        call options%set(wfpsf_option_fits_overwrite, 1)
        call image%write_fits(path, options)
        call again%read_fits(path)
        call again%get_record(oversampling, scale, applied)
        call expect(oversampling == 3 .and. applied == wfpsf_effect_ipc, "record of a file")
        call expect(abs(scale - 0.11_real64) < 1e-15_real64, "scale of a file")
        call again%get_pixels(seen)
        call expect(all(seen == a), "pixels of a file")
        call again%read_fits(path, hdu="0", pixel_type=wfpsf_float32)
        call again%get_pixels(seen)
        call expect(all(seen == a), "hdu 0 as float32")
    end subroutine reads_and_writes

    subroutine interleaves()
        type(wfpsf_image) :: dithers(2), fine, back(2)
        real(real64), target :: a(3, 2, 2), b(6, 2), c(3, 2, 2)
        real(real64) :: dx(2), dy(2)
        integer :: i, stat

        a(:, :, 1) = numbered(3, 2)
        a(:, :, 2) = numbered(3, 2) + 0.5_real64
        do i = 1, 2
            call dithers(i)%wrap(a(:, :, i), 1)
            call back(i)%wrap(c(:, :, i), 1)
        end do
        call fine%wrap(b, 1)
        dx = [0.0_real64, 0.5_real64]
        dy = 0
        call fine%interleave(dithers, 2, 1, dx, dy, wfpsf_dither_detector)
        call expect(all(b(1::2, :) == a(:, :, 1)) .and. all(b(2::2, :) == a(:, :, 2)), "interleave")
        call fine%deinterleave(back, 2, 1, dx, dy, wfpsf_dither_detector)
        call expect(all(c == a), "deinterleave")
        call fine%interleave(dithers(:1), 2, 1, dx, dy, wfpsf_dither_detector, stat)
        call expect(stat == wfpsf_error_size, "too few images")
    end subroutine interleaves

    subroutine passes_taps()
        type(wfpsf_ipc_kernel) :: kernel, flipped
        real(real64) :: taps(3, 3)
        real(real64), allocatable :: seen(:, :)

        taps = reshape([0.01, 0.02, 0.03, 0.04, 0.7, 0.05, 0.06, 0.07, 0.02], [3, 3])
        taps = taps / sum(taps)
        call kernel%create_taps(taps)
        call kernel%get_taps(seen)
        call expect(maxval(abs(seen - taps)) < 1e-15_real64, "taps")
        call flipped%create_flipped(kernel)
        call flipped%get_taps(seen)
        call expect(maxval(abs(seen - taps(3:1:-1, 3:1:-1))) < 1e-15_real64, "flipped")
        call kernel%create(0.02_real64, 0.002_real64, 0.001_real64)
        call kernel%get_taps(seen)
        call expect(abs(seen(1, 2) - 0.021_real64) < 1e-15_real64 &
            .and. abs(seen(2, 1) - 0.019_real64) < 1e-15_real64, "alpha_plus is more along x")
    end subroutine passes_taps

    subroutine corrects_ipc()
        type(wfpsf_ipc_kernel) :: kernel, rest, noise
        type(wfpsf_image) :: image, map
        real(real64), target :: a(9, 7), variance(9, 7)
        real(real64), allocatable :: response(:, :), taps(:, :)
        real(real64) :: margin, residual
        complex(real64) :: value
        integer(int64) :: passes

        a = numbered(9, 7)
        variance = 1
        call image%wrap(a, 1)
        call map%wrap(variance, 1)
        call kernel%create(0.02_real64, 0.002_real64, 0.001_real64)
        call kernel%get(wfpsf_kernel_margin, margin)
        call kernel%transform(0.5_real64, 0.5_real64, value)
        call expect(abs(margin - 0.84_real64) + abs(value - margin) < 1e-14_real64, "margin")
        call kernel%self_test(response)
        call kernel%get_taps(taps)
        call expect(maxval(abs(response - taps)) < 1e-15_real64, "self-test")
        call kernel%apply(image, wfpsf_edge_zero, image)
        call kernel%correct(image, wfpsf_edge_zero, image, residual=residual, passes=passes)
        call expect(maxval(abs(a - numbered(9, 7))) < 1e-11_real64, "correction")
        call expect(residual < 1e-14_real64 .and. passes > 0, "report of the correction")
        call rest%create_neumann(kernel, 2)
        call rest%create_composed(kernel, rest)
        call rest%transform(0.5_real64, 0.5_real64, value)
        call expect(abs(1 - value - 0.16_real64**3) < 1e-14_real64, "order 2")
        call noise%create_autocorrelation(kernel)
        call noise%get_taps(taps)
        call kernel%covariance(map, 0, 0, wfpsf_edge_wrap, map)
        call expect(maxval(abs(variance - taps(3, 3))) < 1e-15_real64, "variance")
    end subroutine corrects_ipc

    subroutine varies_ipc()
        type(wfpsf_varying_ipc) :: maps, smooth, regions
        type(wfpsf_ipc_kernel) :: kernels(2), kernel
        type(wfpsf_chain) :: chain
        type(wfpsf_image) :: image, alpha, index
        type(wfpsf_options) :: options
        real(real64), target :: a(9, 7), map(9, 7), label(9, 7)
        real(real64), allocatable :: taps(:, :)
        real(real64) :: margin, residual, noise
        integer(int64) :: not_finite
        integer :: x, y, stat

        a = numbered(9, 7)
        map = 0.01_real64
        map(8, 3) = 0.05_real64
        label = 1
        label(:, 5:) = 2
        call image%wrap(a, 1)
        call alpha%wrap(map, 1)
        call index%wrap(label, 1)
        call maps%create_maps(alpha)
        call maps%get_margin(margin, x, y)
        call expect(abs(margin - 0.6_real64) < 1e-14_real64 .and. x == 8 .and. y == 3, "weakest")
        call maps%get_kernel(8, 3, kernel)
        call kernel%get_taps(taps)
        call expect(taps(1, 2) == 0.05_real64, "kernel of a pixel")
        call maps%apply(image, wfpsf_edge_zero, image, not_finite=not_finite)
        call expect(not_finite == 0 .and. any(abs(a - numbered(9, 7)) > 1), "varying IPC")
        call maps%correct(image, wfpsf_edge_zero, image, residual=residual, &
            noise_amplification=noise)
        call expect(maxval(abs(a - numbered(9, 7))) < 1e-11_real64, "undone")
        call expect(residual < 1e-14_real64 .and. noise > 1, "its report")
        call maps%get_autocorrelation(8, 3, wfpsf_edge_zero, taps)
        call expect(size(taps, 1) == 5 .and. abs(taps(3, 3) - (0.64_real64 + 4e-4_real64)) < &
            1e-15_real64, "variance")
        label = 1
        call maps%covariance(index, -1, 0, wfpsf_edge_zero, image)
        call expect(abs(a(8, 3) - taps(2, 3)) < 1e-15_real64 .and. all(a(1, :) == 0), "covariance")
        call options%create()
        call options%set(wfpsf_option_ipc_form, wfpsf_ipc_gather)
        call maps%get_autocorrelation(8, 3, wfpsf_edge_zero, taps, index, options)
        call expect(abs(taps(3, 3) - 0.65_real64) < 1e-15_real64, "variance, gathered")
        call maps%get_autocorrelation(10, 3, wfpsf_edge_zero, taps, stat=stat)
        call expect(stat == wfpsf_error_range, "outside")
        a = numbered(9, 7)
        label(:, 5:) = 2

        call kernels(1)%create(0.01_real64, 0.0_real64, 0.0_real64)
        call kernels(2)%create(0.02_real64, 0.0_real64, 0.0_real64)
        call regions%create_regions(index, kernels)
        call regions%get_kernel(1, 5, kernel)
        call kernel%get_taps(taps)
        call expect(taps(1, 2) == 0.02_real64, "region 2")
        call smooth%create_polynomials(9, 7, 1, [0.02_real64, 0.009_real64, 0.0_real64])
        call smooth%get_kernel(9, 4, kernel)
        call kernel%get_taps(taps)
        call expect(abs(taps(1, 2) - 0.028_real64) < 1e-16_real64, "polynomial")
        call smooth%create_polynomials(9, 7, 2, [0.02_real64], stat=stat)
        call expect(stat == wfpsf_error_range, "too few coefficients")
        call chain%create()
        call chain%add_ipc(regions, wfpsf_ipc_scatter, wfpsf_edge_wrap)
        call image%set_record(1, 0.0_real64, 0)
        call chain%apply(image)
        call expect(abs(sum(a) - sum(numbered(9, 7))) < 1e-8_real64, "charge is conserved")
    end subroutine varies_ipc

    subroutine runs_a_chain()
        type(wfpsf_instrument) :: roman
        type(wfpsf_chain) :: chain, own
        type(wfpsf_options) :: options
        type(wfpsf_image) :: image, previous(1)
        real(real64), target :: a(9, 7), before(9, 7)
        real(real64), allocatable :: parameters(:)
        real(real64) :: level, electrons
        integer(int64) :: not_finite, saturated
        integer :: step, stat

        call roman%create("roman-c9")
        call chain%create_default(roman)
        call chain%get_step(4, step, parameters)
        call expect(step == wfpsf_step_reciprocity_failure .and. size(parameters) == 3, "step 4")
        call chain%get_step(12, step, parameters)
        call expect(step == 0, "past the last step")
        a = 1000
        before = 60000
        call image%wrap(a, 1)
        call previous(1)%wrap(before, 1)
        call options%create()
        call options%set(wfpsf_option_seed, 42)
        call chain%apply(image, previous, options, not_finite, saturated)
        call expect(not_finite == 0 .and. saturated == 0, "counts")
        call expect(abs(sum(a) / size(a) - 1000) < 100, "mean after the chain")
        call chain%apply(image, stat=stat)
        call expect(stat == wfpsf_error_already_applied, "twice")

        call own%create()
        call own%add(wfpsf_step_nonlinearity, [-1e-6_real64])
        call own%add(wfpsf_step_saturation, [50000.0_real64])
        call own%add_map(wfpsf_step_pixel_mask, [0.0_real64, 1.0_real64], previous(1))
        call own%apply(previous(1), saturated=saturated)
        call expect(all(before == 50000) .and. saturated == 63, "own chain")

        a = 0
        call wfpsf_add_noise(image, 3.0_real64)
        call expect(any(a > 0) .and. any(a < 0), "noise")
        call roman%get_sky_level("F184", 180.0_real64, 90.0_real64, level)
        call roman%get_sky_background("F184", 180.0_real64, 90.0_real64, 10.0_real64, &
            0.0121_real64, electrons)
        call expect(abs(electrons - 10 * (1.1 * 0.0121_real64 * level + 0.17_real64)) < 1e-5, "sky")
    end subroutine runs_a_chain

    subroutine passes_instrument_arrays()
        type(wfpsf_instrument) :: instrument
        type(wfpsf_options) :: options
        real(real64), allocatable :: coefficients(:)
        real(real64) :: throughput(2), blue, red, effective, diameter
        character(len=:), allocatable :: unit
        integer :: stat

        call instrument%create("wfirst-afta-c5")
        call instrument%constant("diameter", diameter, unit)
        call expect(abs(diameter - 2.36_real64) < 1e-12_real64 .and. unit == "m", "diameter")
        call expect(len(instrument%constant_name(1)) > 0, "first constant")
        call expect(instrument%constant_name(0) == "", "constant 0")
        call expect(len(instrument%band_name(1)) == 4, "first band")
        call expect(instrument%band_name(100) == "", "band past the last")
        call instrument%band("J129", wfpsf_band_paper, effective_nm=effective)
        call instrument%band("J129", wfpsf_band_tabulated, blue, red)
        call expect(blue < effective .and. effective < red, "band limits")
        call instrument%throughput("J129", [effective, red + 1000], throughput)
        call expect(throughput(1) > 0 .and. throughput(2) == 0, "throughput")
        call instrument%throughput("J129", [effective], throughput, stat)
        call expect(stat == wfpsf_error_size, "arrays of two sizes")
        call instrument%zernikes(7, coefficients)
        call expect(size(coefficients) > 4 .and. any(coefficients /= 0), "Zernikes")
        call options%create()
        call options%set_zernikes(-coefficients)
    end subroutine passes_instrument_arrays

    ! A design's band, field and map come through, and in pixels that count from 1.
    subroutine designs()
        type(wfpsf_design) :: design
        type(wfpsf_instrument) :: instrument
        type(wfpsf_options) :: options
        type(wfpsf_image) :: map, star, moved
        type(wfpsf_psf) :: psf
        real(real64) :: x(5), y(5), field(4, 5), value
        real(real64), target :: opd(8, 8)
        real(real64), allocatable :: pixels(:, :), shifted(:, :)
        integer :: i, stat

        x = [50, 1, 100, 1, 100]
        y = [50, 1, 1, 100, 100]
        field = 0
        field(4, :) = [0.1_real64, 0.2_real64, 0.2_real64, 0.2_real64, 0.2_real64]
        call design%create()
        call design%set_telescope(2.4_real64, 0.3_real64, 1000.0_real64)
        call design%add_strut(30.0_real64, 0.05_real64)
        call design%add_strut(210.0_real64, 0.05_real64, 0.1_real64)
        call design%set_detector(1, 0.1_real64, 100, 100)
        call design%set_field(1, x, y, field)
        call design%set_field(1, x(:4), y, field, stat)
        call expect(stat == wfpsf_error_range, "four field points")
        call design%add_band("mine", 900.0_real64, 100.0_real64, [0.5_real64, 1.0_real64])
        call design%set_zernikes(2, [0.0_real64])
        call instrument%create_from_design(design, stat)
        call expect(stat == wfpsf_error_range .and. instrument%is_empty(), "an SCA too many")

        call design%create()
        call design%set_telescope(2.4_real64, 0.3_real64, 1000.0_real64)
        call design%set_detector(1, 0.1_real64, 100, 100)
        call design%set_zernikes(1, [0.0_real64, 0.0_real64, 0.0_real64, 0.1_real64])
        call design%add_band("mine", 900.0_real64, 100.0_real64, [0.5_real64, 1.0_real64])
        call instrument%create_from_design(design)
        call instrument%constant("n_pix_y", value)
        call expect(nint(value) == 100, "a constant of a design")
        call expect(instrument%band_name(1) == "mine", "a band of a design")

        ! A tilt of one pixel moves the star by a pixel, against the phase.
        opd = spread([(i - 4.5_real64, i = 1, 8)], 2, 8) * 0.5_real64 * 0.1_real64 &
            * acos(-1.0_real64) / 180 / 3600
        call options%create()
        call options%set(wfpsf_option_psf_radius, 8.0_real64)
        call psf%create_in_band(instrument, "mine", 1, 50.0_real64, 50.0_real64, 0.0_real64, options)
        call star%create(wfpsf_float64, 11, 11, 1)
        call moved%create(wfpsf_float64, 11, 11, 1)
        call psf%draw(7.0_real64, 6.0_real64, 1.0_real64, star)
        call map%wrap(opd, 1)
        call options%set_opd(map, 0.5_real64, 4.5_real64, 4.5_real64)
        call psf%create_in_band(instrument, "mine", 1, 50.0_real64, 50.0_real64, 0.0_real64, options)
        call psf%draw(8.0_real64, 6.0_real64, 1.0_real64, moved)
        call star%get_pixels(pixels)
        call moved%get_pixels(shifted)
        call expect(maxval(abs(pixels - shifted)) < 4e-6_real64 * maxval(pixels), "a tilt")
        call options%set_opd(map, -0.5_real64, 4.5_real64, 4.5_real64, stat)
        call expect(stat == wfpsf_error_range, "a negative scale")
        call map%destroy()
        call options%set_opd(map, 0.5_real64, 4.5_real64, 4.5_real64)
    end subroutine designs

end program test_arrays
