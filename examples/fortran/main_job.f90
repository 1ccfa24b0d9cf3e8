! SPDX-License-Identifier: GPL-3.0-or-later
!
! Size, shape and half-light radius of the WFIRST-AFTA C5 PSF before and after interpixel
! capacitance, beside Table 2 of Kannawadi et al. 2016, and the six PSFs of its Figure 2.
!
! usage: main_job [output folder]
!
! Writes table_sizes.csv and psf_<BAND>.fits. A call that fails ends the program with the library's
! line on standard error and exit code 1.
program main_job
    use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
    use, intrinsic :: iso_fortran_env, only: error_unit, int64, real64
    use wfpsf
    implicit none

    interface
        function mkdir(path, mode) bind(c) result(code)
            import :: c_char, c_int
            implicit none
            character(kind=c_char), intent(in) :: path(*)
            integer(c_int), value :: mode
            integer(c_int) :: code
        end function mkdir

        function isatty(descriptor) bind(c) result(answer)
            import :: c_int
            implicit none
            integer(c_int), value :: descriptor
            integer(c_int) :: answer
        end function isatty
    end interface

    ! The paper's stamp: 16 x 16 native pixels in steps of 1/32 pixel, the star at the centre.
    integer, parameter :: sca = 7, native_side = 16, oversampling = 32
    integer, parameter :: side = native_side * oversampling
    real(real64), parameter :: centre = (side + 1) / 2.0_real64

    ! The field whose light counts as all of it for EE50, as in the paper: 32 x 32 native pixels.
    integer, parameter :: field_side = 32, field_sampling = 4, field = field_side * field_sampling

    integer, parameter :: sigma = 1, e1 = 2, e2 = 3, e = 4, ee50_centroid = 5, ee50_axis = 6
    integer, parameter :: quantities = 6
    character(len=*), parameter :: in_csv(quantities) = [character(len=13) :: &
        "sigma", "e1", "e2", "e", "ee50_centroid", "ee50_axis"]
    character(len=*), parameter :: in_table(quantities) = [character(len=19) :: &
        "sigma", "e1", "e2", "|e|", "EE50 about centroid", "EE50 about axis"]
    character(len=*), parameter :: unit_of(quantities) = [character(len=3) :: &
        "mas", "1", "1", "1", "mas", "mas"]

    ! Table 2 of the paper, (band, struts); it gives no more digits than these.
    integer, parameter :: table_bands = 3
    character(len=4), parameter :: table_band(table_bands) = ["J129", "H158", "F184"]
    character(len=6), parameter :: paper_sigma(table_bands, 0:1) = reshape( &
        ["60.480", "65.884", "72.452", "61.50 ", "66.16 ", "72.39 "], [table_bands, 2])
    character(len=6), parameter :: paper_hlr(table_bands, 0:1) = reshape( &
        ["95.06 ", "103.85", "113.21", "114.85", "123.72", "132.37"], [table_bands, 2])
    character(len=6), parameter :: paper_e(table_bands, 0:1) = reshape( &
        ["0.0652", "0.0417", "0.0292", "0.0646", "0.0379", "0.0246"], [table_bands, 2])

    character(len=4), parameter :: figure_band(6) = &
        ["Z087", "Y106", "J129", "W149", "H158", "F184"]

    type :: measurement
        real(real64) :: value(quantities), error(quantities), moments_ms, ee50_ms
    end type measurement

    type :: table_row
        character(len=4) :: band
        integer :: struts
        character(len=6) :: paper(quantities) ! blank where it prints nothing
        real(real64) :: nodes, grid, error, model_error, psf_ms, draw_ms, ipc_ms
        type(measurement) :: optics, with_ipc
    end type table_row

    type(wfpsf_instrument) :: instrument
    type(wfpsf_options) :: options
    type(table_row) :: rows(table_bands, 0:1)
    character(len=:), allocatable :: folder
    integer :: table, struts, band

    folder = output_folder()
    table = new_table(folder)

    call wfpsf_check_version()
    call instrument%create("wfirst-afta-c5")
    call options%create()
    call options%set(wfpsf_option_eps, 1e-7_real64)
    call options%set(wfpsf_option_psf_radius, field_side / 2.0_real64)
    call options%set(wfpsf_option_moments_tolerance, 1e-10_real64)
    call options%set(wfpsf_option_moments_guess_x, centre)
    call options%set(wfpsf_option_moments_guess_y, centre)
    call options%set(wfpsf_option_fits_overwrite, 1)

    do struts = 1, 0, -1
        do band = 1, table_bands
            call make_row(band, struts, rows(band, struts))
        end do
        call print_table(rows(:, struts))
        call write_rows(table, rows(:, struts))
    end do
    close (table)
    print "(a)", &
        "Differences and changes: per cent of the paper's figure, or of the one without IPC;", &
        "absolute for ellipticities. EE50: half of the star's light on 32 x 32 native pixels.", &
        "Errors are numerical, for a PSF in units of its peak; the pupil model's error is apart", &
        "from them."
    call draw_figure()

    call options%destroy()
    call instrument%destroy()

contains

    ! The folder of the command line, made if missing.
    function output_folder() result(name)
        character(len=:), allocatable :: name
        integer :: length
        integer(c_int) :: code

        if (command_argument_count() > 1) error stop "usage: main_job [output folder]"
        name = "out"
        if (command_argument_count() == 1) then
            call get_command_argument(1, length=length)
            deallocate (name)
            allocate (character(len=length) :: name)
            call get_command_argument(1, name)
        end if
        ! It fails if the folder is there, too: opening the table tells the two apart.
        code = mkdir(name // c_null_char, int(o"777", c_int))
    end function output_folder

    function new_table(folder) result(unit)
        character(len=*), intent(in) :: folder
        integer :: unit, stat
        character(len=1000) :: line

        open (newunit=unit, file=folder // "/table_sizes.csv", status="replace", &
            action="write", iostat=stat, iomsg=line)
        if (stat /= 0) error stop trim(line)
        write (unit, "(a)") "band,struts,ipc,quantity,unit,paper,value,error_estimate"
    end function new_table

    subroutine progress(band, step)
        character(len=*), intent(in) :: band, step
        character(len=*), parameter :: clear_line = achar(13) // achar(27) // "[K"

        if (isatty(2_c_int) == 0) return
        write (error_unit, "(a)", advance="no") clear_line // band // step
        flush (error_unit)
    end subroutine progress

    ! Ends the program on an error; a warning comes with a valid result, so it is only told.
    subroutine check(stat, line)
        integer, intent(in) :: stat
        character(len=*), intent(in) :: line

        if (stat /= wfpsf_ok) call progress("", "")
        if (stat < 0) error stop trim(line)
        if (stat > 0) print "(2a)", "warning: ", trim(line)
    end subroutine check

    function now_ms() result(ms)
        real(real64) :: ms
        integer(int64) :: count, rate

        call system_clock(count, rate)
        ms = 1e3_real64 * real(count, real64) / real(rate, real64)
    end function now_ms

    function effective_wavelength_nm(band) result(nm)
        character(len=*), intent(in) :: band
        real(real64) :: nm

        call instrument%band(band, wfpsf_band_paper, effective_nm=nm)
    end function effective_wavelength_nm

    ! The light of a star of unit flux that falls on the field around it.
    function field_flux(psf) result(flux)
        type(wfpsf_psf), intent(in) :: psf
        real(real64) :: flux
        real(real64), allocatable, target :: pixels(:, :)
        type(wfpsf_image) :: image
        real(real64), parameter :: middle = (field + 1) / 2.0_real64

        allocate (pixels(field, field))
        call image%wrap(pixels, field_sampling)
        call psf%draw(middle, middle, 1.0_real64, image)
        flux = sum(pixels)
    end function field_flux

    subroutine make_row(band, struts, row)
        integer, intent(in) :: band, struts
        type(table_row), intent(out) :: row
        type(wfpsf_psf) :: psf
        type(wfpsf_image) :: optics, with_ipc
        type(wfpsf_ipc_kernel) :: kernel
        real(real64) :: wavelength_nm, pixel_arcsec, mas_per_sample, start
        integer :: stat
        character(len=1000) :: line

        row%band = table_band(band)
        row%struts = struts
        row%paper = ""
        row%paper(sigma) = paper_sigma(band, struts)
        row%paper(e) = paper_e(band, struts)
        row%paper(ee50_centroid) = paper_hlr(band, struts)

        wavelength_nm = effective_wavelength_nm(row%band)
        call instrument%constant("pixel_scale", pixel_arcsec)
        mas_per_sample = 1000 * pixel_arcsec / oversampling
        call options%set(wfpsf_option_struts, struts)
        call options%set(wfpsf_option_moments_guess_sigma, &
            0.55_real64 * oversampling * wavelength_nm / 1292)

        call progress(row%band, ": PSF")
        start = now_ms()
        call psf%create(instrument, sca, wavelength_nm, options, stat, line)
        call check(stat, line)
        row%psf_ms = now_ms() - start
        call psf%get(wfpsf_psf_nodes, row%nodes)
        call psf%get(wfpsf_psf_grid_size, row%grid)
        call psf%get(wfpsf_psf_error_estimate, row%error)
        call psf%get(wfpsf_psf_model_error, row%model_error)

        call options%set(wfpsf_option_size_total_flux, field_flux(psf))

        call optics%create(wfpsf_float64, side, side, oversampling)
        call with_ipc%create(wfpsf_float64, side, side, oversampling)
        start = now_ms()
        call psf%draw(centre, centre, 1.0_real64, optics)
        row%draw_ms = now_ms() - start

        call progress(row%band, ": moments and EE50")
        call measure(optics, mas_per_sample, row%error, row%optics)

        call progress(row%band, ": IPC")
        call kernel%create(0.02_real64, 0.002_real64, 0.0_real64)
        start = now_ms()
        call kernel%apply(optics, wfpsf_edge_zero, with_ipc)
        row%ipc_ms = now_ms() - start
        call measure(with_ipc, mas_per_sample, row%error, row%with_ipc)
        call progress("", "")
    end subroutine make_row

    ! The errors are numerical ones: that of the measurement and that of the PSF's pixels. How well
    ! the pupil's geometry fits the published mask is another matter: wfpsf_psf_model_error.
    subroutine measure(image, mas_per_sample, psf_error, m)
        type(wfpsf_image), intent(in) :: image
        real(real64), intent(in) :: mas_per_sample, psf_error
        type(measurement), intent(out) :: m
        type(wfpsf_moments) :: moments
        real(real64) :: start, error, x, y
        integer :: stat
        character(len=1000) :: line

        start = now_ms()
        call moments%measure(image, options, stat, line)
        call check(stat, line)
        m%moments_ms = now_ms() - start

        call moments%get(wfpsf_moments_error_estimate, error)
        error = error / 2 + 2 * psf_error
        call moments%get(wfpsf_moments_sigma, m%value(sigma))
        m%value(sigma) = m%value(sigma) * mas_per_sample
        call moments%get(wfpsf_moments_e1, m%value(e1))
        call moments%get(wfpsf_moments_e2, m%value(e2))
        call moments%get(wfpsf_moments_e, m%value(e))
        m%error(sigma) = m%value(sigma) * error
        m%error([e1, e2, e]) = 2 * error

        start = now_ms()
        call moments%get(wfpsf_moments_centroid_x, x)
        call moments%get(wfpsf_moments_centroid_y, y)
        call measure_ee50(image, x, y, mas_per_sample, psf_error, m%value(ee50_centroid), &
            m%error(ee50_centroid))
        call measure_ee50(image, centre, centre, mas_per_sample, psf_error, m%value(ee50_axis), &
            m%error(ee50_axis))
        m%ee50_ms = now_ms() - start
    end subroutine measure

    subroutine measure_ee50(image, x, y, mas_per_sample, psf_error, value, error)
        type(wfpsf_image), intent(in) :: image
        real(real64), intent(in) :: x, y, mas_per_sample, psf_error
        real(real64), intent(out) :: value, error
        real(real64) :: radius, radius_error

        call image%ee_radius(x, y, 0.5_real64, wfpsf_size_bandlimited, radius, radius_error, &
            options)
        value = radius * mas_per_sample
        error = radius_error * mas_per_sample + value * 2 * psf_error
    end subroutine measure_ee50

    ! Lengths differ by per cent, ellipticities by absolute numbers.
    function change(q, from, to) result(text)
        integer, intent(in) :: q
        real(real64), intent(in) :: from, to
        character(len=12) :: text

        if (unit_of(q) == "mas") then
            write (text, "(sp, f10.3, ' %')") 100 * (to / from - 1)
        else
            write (text, "(sp, f12.6)") to - from
        end if
    end function change

    function figure(q, value) result(text)
        integer, intent(in) :: q
        real(real64), intent(in) :: value
        character(len=12) :: text

        if (unit_of(q) == "mas") then
            write (text, "(f12.5)") value
        else
            write (text, "(f12.8)") value
        end if
    end function figure

    subroutine print_table(rows)
        type(table_row), intent(in) :: rows(:)
        character(len=7) :: which
        character(len=12) :: difference
        real(real64) :: paper
        integer :: band, q

        which = merge("with   ", "without", rows(1)%struts == 1)
        print "(a, i0, 4a, /)", "WFIRST-AFTA C5, SCA ", sca, ", ", trim(which), " struts; ", &
            "IPC: alpha 0.02, alpha' 0.002"
        print "(2a)", &
            "band  quantity             unit   this work  error est.   paper  difference", &
            "    with IPC  error est.      change"
        do band = 1, size(rows)
            associate (row => rows(band), optics => rows(band)%optics, &
                with_ipc => rows(band)%with_ipc)
                do q = 1, quantities
                    difference = ""
                    if (row%paper(q) /= "") then
                        read (row%paper(q), *) paper
                        difference = change(q, paper, optics%value(q))
                    end if
                    print "(a, 2x, a, 2x, a, 1x, a, es12.1e2, 2x, a, a, a, es12.1e2, a)", &
                        row%band, in_table(q), unit_of(q), figure(q, optics%value(q)), &
                        optics%error(q), adjustr(row%paper(q)), difference, &
                        figure(q, with_ipc%value(q)), with_ipc%error(q), &
                        change(q, optics%value(q), with_ipc%value(q))
                end do
            end associate
        end do
        print "(/, 2a)", "PSF   nodes   grid  error est.  pupil model error", &
            "      ms: PSF   draw  moments   EE50    IPC  moments   EE50"
        do band = 1, size(rows)
            associate (row => rows(band))
                print "(a, i7, i7, es12.1e2, es19.1e2, f13.2, f7.2, 2(f9.2, f7.2, :, f7.2))", &
                    row%band, nint(row%nodes), nint(row%grid), row%error, row%model_error, &
                    row%psf_ms, row%draw_ms, row%optics%moments_ms, row%optics%ee50_ms, &
                    row%ipc_ms, row%with_ipc%moments_ms, row%with_ipc%ee50_ms
            end associate
        end do
        print "()"
    end subroutine print_table

    subroutine write_rows(unit, rows)
        integer, intent(in) :: unit
        type(table_row), intent(in) :: rows(:)
        character(len=6), parameter :: no_paper(quantities) = ""
        integer :: band

        do band = 1, size(rows)
            call write_measurement(unit, rows(band), 0, rows(band)%paper, rows(band)%optics)
            call write_measurement(unit, rows(band), 1, no_paper, rows(band)%with_ipc)
        end do
    end subroutine write_rows

    subroutine write_measurement(unit, row, ipc, paper, m)
        integer, intent(in) :: unit, ipc
        type(table_row), intent(in) :: row
        character(len=*), intent(in) :: paper(quantities)
        type(measurement), intent(in) :: m
        integer :: q, stat
        character(len=1000) :: line

        do q = 1, quantities
            write (unit, "(a, ',', i0, ',', i0, 3(',', a), 2(',', es0.16e2))", iostat=stat, &
                iomsg=line) row%band, row%struts, ipc, trim(in_csv(q)), trim(unit_of(q)), &
                trim(paper(q)), m%value(q), m%error(q)
            if (stat /= 0) error stop trim(line)
        end do
    end subroutine write_measurement

    ! Figure 2 of the paper: the monochromatic PSFs of six bands.
    subroutine draw_figure()
        real(real64), allocatable, target :: pixels(:, :)
        type(wfpsf_psf) :: psf
        type(wfpsf_image) :: image
        integer :: i, stat
        character(len=1000) :: line

        call options%set(wfpsf_option_struts, 1)
        allocate (pixels(side, side))
        call image%wrap(pixels, oversampling)
        do i = 1, size(figure_band)
            call progress(figure_band(i), ": PSF")
            call psf%create(instrument, sca, effective_wavelength_nm(figure_band(i)), options, &
                stat, line)
            call check(stat, line)
            call psf%draw(centre, centre, 1.0_real64, image)
            call image%write_fits(folder // "/psf_" // figure_band(i) // ".fits", options)
        end do
        call progress("", "")
    end subroutine draw_figure

end program main_job
