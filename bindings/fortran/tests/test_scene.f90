! SPDX-License-Identifier: GPL-3.0-or-later
! Catalogues, scenes and exposures: against PSFs drawn one by one, plans, truth, files, refusals.
! The first pixel is (1, 1); the first source, colour and group are number 1.
program test_scene
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    use, intrinsic :: iso_fortran_env, only: int32, int64, real64
    use expectations, only: expect
    use wfpsf
    implicit none
    real(real64), parameter :: x(3) = [1011.3_real64, 1041.7_real64, 1e9_real64], &
        y(3) = [1021.1_real64, 1051.0_real64, 1.0_real64], &
        flux(3) = [5000.0_real64, 300.0_real64, 8.0_real64], corner = 1001
    type(wfpsf_instrument) :: roman
    type(wfpsf_options) :: budget
    integer :: stat
    character(len=200) :: line

    call roman%create("roman-c9")
    call budget%create()
    call budget%set(wfpsf_option_scene_noise, 0.01_real64)
    call budget%set(wfpsf_option_scene_variance, 100.0_real64)
    call check_stars()
    call check_store()
    call check_galaxies()
    call check_sky()

contains

    ! A store serves a second scene, and outlives its own handle.
    subroutine check_store()
        type(wfpsf_scene_store) :: store
        type(wfpsf_options) :: options
        type(wfpsf_catalogue) :: catalogue
        type(wfpsf_scene) :: scene
        type(wfpsf_image) :: image
        type(wfpsf_rendering) :: rendering
        real(real64), target :: drawn(64, 64)
        real(real64) :: made(2)
        integer(int64) :: bytes(2)
        integer :: k, status, file

        bytes = -1
        made = -1
        drawn = 0
        call store%create()
        call store%memory(bytes(1))
        call expect(bytes(1) == 0, "an empty store")
        call options%create()
        call options%set(wfpsf_option_scene_noise, 0.1_real64)
        call options%set(wfpsf_option_scene_variance, 100.0_real64)
        call options%set(wfpsf_option_scene_exposures, 50)
        call options%set_scene_store(store)
        call catalogue%create(wfpsf_positions_detector, wfpsf_brightness_electrons)
        call catalogue%add_stars(x(:2), y(:2), flux(:2))
        call image%wrap(drawn, 1)
        do k = 1, 2
            call scene%create(roman, "J129", 7, catalogue, image, corner, corner, options=options)
            call scene%render(image, rendering)
            call rendering%get(wfpsf_rendering_exact_psfs, made(k))
            call store%memory(bytes(k))
        end do
        call expect(made(1) > 0 .and. nint(made(2)) == 0, "PSFs are made once")
        call expect(bytes(1) > 0 .and. bytes(2) == bytes(1), "memory of a store")
        call store%write("test_scene.store")
        call store%destroy()
        call scene%create(roman, "J129", 7, catalogue, image, corner, corner, options=options)
        call scene%render(image, rendering)
        call rendering%get(wfpsf_rendering_exact_psfs, made(2))
        call expect(nint(made(2)) == 0, "options share the store")
        call store%create()
        call store%read("test_scene.store")
        call store%memory(bytes(2))
        call expect(bytes(2) == bytes(1), "a store from a file")
        call store%read("no such file", stat=status)
        call expect(status == wfpsf_error_file_open, "no such file")
        open(newunit=file, file="test_scene.store")
        close(file, status="delete")
        call options%set_scene_store()
        call scene%create(roman, "J129", 7, catalogue, image, corner, corner, options=options)
        call scene%render(image, rendering)
        call rendering%get(wfpsf_rendering_exact_psfs, made(2))
        call expect(made(2) > 0, "a scene alone")
    end subroutine check_store

    subroutine check_stars()
        type(wfpsf_catalogue) :: catalogue
        type(wfpsf_scene) :: scene
        type(wfpsf_image) :: image, one_by_one
        type(wfpsf_rendering) :: rendering
        type(wfpsf_psf) :: psf
        type(wfpsf_options) :: fine
        type(wfpsf_ipc_kernel) :: kernel
        real(real64), target :: drawn(64, 64), truth(64, 64)
        real(real64) :: value, allowed, table(0:wfpsf_truth_columns - 1, 2)
        integer(int32) :: group(3)
        integer(int64) :: count
        integer :: k
        character(len=:), allocatable :: text

        call catalogue%create(wfpsf_positions_detector, wfpsf_brightness_electrons)
        call catalogue%add_stars(x, y, flux)
        count = 0
        call catalogue%size(count)
        call expect(count == 3_int64, "size")
        drawn = 0
        truth = 0
        call image%wrap(drawn, 1)
        call one_by_one%wrap(truth, 1)
        call scene%create(roman, "J129", 7, catalogue, image, corner, corner, options=budget)
        call scene%render(image, rendering)
        call fine%create()
        call fine%set(wfpsf_option_eps, 1e-8_real64)
        do k = 1, 2
            call psf%create_in_band(roman, "J129", 7, x(k), y(k), 0.0_real64, fine)
            call psf%add_bright_star(x(k) - corner + 1, y(k) - corner + 1, flux(k), one_by_one)
        end do
        allowed = 0
        call scene%get(wfpsf_scene_error_allowed, allowed)
        call expect(abs(allowed - 0.1_real64) < 1e-12_real64, "error_allowed")
        value = 2 * allowed
        call rendering%get(wfpsf_rendering_error_estimate, value)
        call expect(value <= allowed, "error_estimate")
        value = maxval(abs(drawn - truth))
        call expect(value > 0 .and. value <= allowed, "pixels")

        call scene%groups_of(group)
        call expect(minval(group) == 1 .and. maxval(group) == 3, "groups_of")
        call scene%get_group(group(1), wfpsf_scene_group_flux_from, value)
        call expect(nint(value) == 4096, "flux_from")
        call scene%get_group(group(1), wfpsf_scene_group_colour, value)
        call expect(nint(value) == 1, "colour")
        call scene%get_group(4, wfpsf_scene_group_colour, value, stat=stat)
        call expect(stat == wfpsf_error_range, "group")
        call scene%text(text)
        call expect(index(text, "3 sources") == 1, "text")

        call kernel%create(0.02_real64, 0.002_real64, 0.0_real64)
        call scene%truth(table, [2_int64, 1_int64], kernel)
        call expect(all(abs(table(wfpsf_truth_position_x, :) - x([2, 1])) < 1e-9_real64), &
            "position")
        call expect(all(nint(table(wfpsf_truth_group, :)) == group([2, 1])), "group of truth")
        call expect(all(abs(table(wfpsf_truth_centroid_y, :) - y([2, 1])) < 0.3_real64), "centroid")
        ! the paper's 6 %
        call expect(all(abs(table(wfpsf_truth_ipc_sigma, :) / table(wfpsf_truth_sigma, :) &
            - 1.06_real64) < 0.01_real64), "ipc_sigma")
        value = table(wfpsf_truth_sigma, 1)
        call scene%truth(table)
        call expect(abs(table(wfpsf_truth_sigma, 2) - value) < 1e-12_real64, "the first two")
        call expect(ieee_is_nan(table(wfpsf_truth_ipc_sigma, 1)), "no kernel")
        call scene%truth(table(1:, :), stat=stat)
        call expect(stat == wfpsf_error_size, "rows of truth")
        call scene%truth(table, [1_int64], stat=stat)
        call expect(stat == wfpsf_error_size, "sources of truth")
    end subroutine check_stars

    subroutine check_galaxies()
        type(wfpsf_catalogue) :: catalogue
        type(wfpsf_scene) :: scene
        type(wfpsf_image) :: image
        type(wfpsf_moments) :: moments
        type(wfpsf_sed) :: sed
        real(real64), target :: drawn(64, 64)
        real(real64), parameter :: place(1) = 1032, light(1) = 300, exponential(1) = 1, &
            radius(1) = 0.3_real64, long(1) = 0.3_real64
        real(real64) :: value
        integer :: colour

        call catalogue%create(wfpsf_positions_detector, wfpsf_brightness_electrons)
        call catalogue%add_colour(wavelength_nm=1250.0_real64, colour=colour)
        call expect(colour == 1, "first colour")
        call sed%create_black_body(5000.0_real64)
        call catalogue%add_colour(sed=sed, colour=colour)
        call expect(colour == 2, "second colour")
        call catalogue%add_galaxies(place, place, light, exponential, radius, e2=long, colour=[1])
        drawn = 0
        call image%wrap(drawn, 1)
        call scene%create(roman, "J129", 7, catalogue, image, corner, corner, options=budget)
        call scene%get_group(1, wfpsf_scene_group_kind, value)
        call expect(nint(value) == wfpsf_kind_galaxy, "kind")
        call scene%render(image)
        call moments%measure(image)
        call moments%get(wfpsf_moments_e2, value)
        call expect(value > 0.2_real64, "e2")
        call moments%get(wfpsf_moments_centroid_x, value)
        call expect(abs(value - 32) < 0.1_real64, "centre")
        call catalogue%add_galaxies(place, place, light, exponential, radius, [0.1_real64, &
            0.1_real64], stat=stat)
        call expect(stat == wfpsf_error_size, "sizes of galaxies")
        call catalogue%add_stars(place, place, light, [3], stat=stat, errmsg=line)
        call expect(stat == wfpsf_error_range, "colour of a star")
        call catalogue%add_stars(place, place, flux, stat=stat)
        call expect(stat == wfpsf_error_size, "sizes of stars")
    end subroutine check_galaxies

    subroutine check_sky()
        type(wfpsf_observation) :: observation
        type(wfpsf_catalogue) :: catalogue
        type(wfpsf_scene) :: scene
        type(wfpsf_image) :: image
        type(wfpsf_options) :: options
        type(wfpsf_chain) :: chain
        type(wfpsf_exposure) :: exposure
        real(real64) :: ra(1), dec(1), rate, table(0:wfpsf_truth_columns - 1, 1)
        logical :: made
        integer :: unit
        character(len=:), allocatable :: path

        call observation%create(roman, 60.0_real64, -30.0_real64, 30.0_real64)
        call observation%pixel_to_sky(7, x(:1), y(:1), ra, dec)
        call catalogue%create(wfpsf_positions_sky, wfpsf_brightness_ab_magnitude)
        call catalogue%add_stars(ra, dec, [20.0_real64])
        call image%create(wfpsf_float64, 64, 64, 1)
        call options%create()
        call options%set(wfpsf_option_exposure_time, 100.0_real64)
        call scene%create(roman, "J129", 7, catalogue, image, corner, corner, stat=stat)
        call expect(stat == wfpsf_error_argument .and. scene%is_empty(), "no observation")
        call scene%create(roman, "J129", 7, catalogue, image, corner, corner, observation, options)
        call scene%truth(table)
        call expect(abs(table(wfpsf_truth_position_x, 1) - x(1)) < 1e-7_real64, "place of RA, Dec")
        call roman%get_ab_zero_rate("J129", rate)
        call expect(abs(table(wfpsf_truth_flux, 1) / (100 * rate * 1e-8_real64) - 1) &
            < 1e-12_real64, "flux of a magnitude")

        call chain%create()
        call chain%add(wfpsf_step_gain, [2.0_real64])
        call options%set(wfpsf_option_stream, 4321)
        call options%set(wfpsf_option_scene_background, 50.0_real64)
        call exposure%create(roman, observation, "J129", catalogue, chain, options)
        call exposure%path(".", 7, path)
        call expect(path == "./exposure_04321_sca07.fits", "path")
        call options%set(wfpsf_option_fits_overwrite, 1)
        call exposure%make(7, ".", options=options)
        call exposure%make(7, ".", made)
        call expect(.not. made, "made twice")
        call image%read_fits(path)
        open (newunit=unit, file=path)
        close (unit, status="delete")
        call exposure%make(19, ".", made, stat=stat, errmsg=line)
        call expect(stat == wfpsf_error_range .and. index(line, "sca = 19") == 1, "sca")
    end subroutine check_sky

end program test_scene
