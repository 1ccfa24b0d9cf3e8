! SPDX-License-Identifier: GPL-3.0-or-later
!
! WFIRST/Roman PSFs, interpixel capacitance, moments and sizes.
!
! Positions count from 1: the centre of the first pixel is (1, 1), as in FITS, and the centre of an
! image is ((nx+1)/2, (ny+1)/2). That holds for positions given and returned, the options
! moments_guess_x and _y among them. Arrays are (nx, ny). The C headers describe each quantity in
! full; lines of error text come from the library, whose first pixel is (0, 0).
!
! Errors: stat becomes 0, a negative error or a positive warning (wfpsf_error_*, wfpsf_warning_*,
! whose outputs are valid), and errmsg the library's line on it; success leaves errmsg alone. An
! error without stat to take it ends the program with that line; a warning without stat passes.
!
! Objects: create, measure or read_fits fills one, destroy empties it; both may be called again, and
! an object that goes out of scope is emptied. An object cannot be assigned to another.
module wfpsf
    use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_null_ptr, c_ptr
    use, intrinsic :: iso_fortran_env, only: int64, real32, real64
    use wfpsf_constants
    implicit none
    private :: c_double, c_int32_t, c_null_ptr, c_ptr, int64, real32, real64, handle

    ! What all objects have in common: a pointer to the library's own.
    type :: handle
        private
        type(c_ptr) :: pointer = c_null_ptr
    contains
        procedure :: is_empty
        procedure, private :: refuse_assignment
        generic :: assignment(=) => refuse_assignment
    end type handle

    ! Tolerances and choices by key (wfpsf_option_*). Left out, or empty: all at their defaults.
    type, extends(handle) :: wfpsf_options
    contains
        procedure :: create => options_create
        procedure :: destroy => options_destroy
        procedure, private :: options_set_real, options_set_integer
        generic :: set => options_set_real, options_set_integer
        procedure :: get => options_get
        procedure :: reset => options_reset
        procedure :: set_zernikes => options_set_zernikes
        procedure :: set_opd => options_set_opd
        procedure :: set_scene_store => options_set_scene_store
        procedure :: set_progress => options_set_progress
        final :: options_finalize
    end type wfpsf_options

    ! The figures of a telescope and its detectors, published or of a design.
    type, extends(handle) :: wfpsf_instrument
    contains
        procedure :: create => instrument_create
        procedure :: create_from_design => instrument_create_from_design
        procedure :: destroy => instrument_destroy
        procedure :: constant => instrument_constant
        procedure :: constant_name => instrument_constant_name
        procedure :: band => instrument_band
        procedure :: band_name => instrument_band_name
        procedure :: throughput => instrument_throughput
        procedure :: zernikes => instrument_zernikes
        procedure :: pupil => instrument_pupil
        procedure :: get_sky_level => instrument_get_sky_level
        procedure :: get_sky_background => instrument_get_sky_background
        procedure :: get_ab_zero_rate => instrument_get_ab_zero_rate
        final :: instrument_finalize
    end type wfpsf_instrument

    ! Figures of one's own, to make an instrument of.
    type, extends(handle) :: wfpsf_design
    contains
        procedure :: create => design_create
        procedure :: destroy => design_destroy
        procedure :: set_telescope => design_set_telescope
        procedure :: add_strut => design_add_strut
        procedure :: set_detector => design_set_detector
        procedure :: set_zernikes => design_set_zernikes
        procedure :: set_field => design_set_field
        procedure :: add_band => design_add_band
        final :: design_finalize
    end type wfpsf_design

    ! Pixels and the record of what has been done to them. An image either owns its pixels (create,
    ! read_fits) or stands on an array of the caller's (wrap).
    type, extends(handle) :: wfpsf_image
    contains
        procedure :: create => image_create
        procedure, private :: image_wrap_real32, image_wrap_real64
        generic :: wrap => image_wrap_real32, image_wrap_real64
        procedure :: read_fits => image_read_fits
        procedure :: write_fits => image_write_fits
        procedure :: destroy => image_destroy
        procedure :: get_shape => image_get_shape
        procedure :: get_record => image_get_record
        procedure :: set_record => image_set_record
        procedure :: copy_from => image_copy_from
        procedure, private :: image_get_pixels_real32, image_get_pixels_real64
        generic :: get_pixels => image_get_pixels_real32, image_get_pixels_real64
        procedure :: interleave => image_interleave
        procedure :: deinterleave => image_deinterleave
        procedure :: encircled_energy => image_encircled_energy
        procedure :: ee_radius => image_ee_radius
        procedure :: ee_radius_derivative => image_ee_radius_derivative
        procedure :: fwhm => image_fwhm
        procedure :: radial_profile => image_radial_profile
        procedure :: profile_fwhm => image_profile_fwhm
        procedure :: moment_sums => image_moment_sums
        final :: image_finalize
    end type wfpsf_image

    ! A telescope that points somewhere, and where its detectors then are on the sky. Degrees; RA and
    ! Dec in the ICRS, position angles east of north.
    type, extends(handle) :: wfpsf_observation
    contains
        procedure :: create => observation_create
        procedure :: create_on_date => observation_create_on_date
        procedure :: create_aimed => observation_create_aimed
        procedure :: destroy => observation_destroy
        procedure :: get => observation_get
        procedure :: sky_to_pixel => observation_sky_to_pixel
        procedure :: pixel_to_sky => observation_pixel_to_sky
        procedure :: find_sca => observation_find_sca
        procedure :: get_bounds => observation_get_bounds
        procedure :: jacobian => observation_jacobian
        procedure :: fits_header => observation_fits_header
        final :: observation_finalize
    end type wfpsf_observation

    ! A spectral energy distribution: how light is spread over wavelength, up to a factor.
    type, extends(handle) :: wfpsf_sed
    contains
        procedure :: create_table => sed_create_table
        procedure :: create_power_law => sed_create_power_law
        procedure :: create_black_body => sed_create_black_body
        procedure :: create_redshifted => sed_create_redshifted
        procedure :: destroy => sed_destroy
        procedure :: photon_density => sed_photon_density
        final :: sed_finalize
    end type wfpsf_sed

    ! The image of a star, pixel response included.
    type, extends(handle) :: wfpsf_psf
    contains
        procedure :: create => psf_create
        procedure :: create_from_mask => psf_create_from_mask
        procedure :: destroy => psf_destroy
        procedure :: draw => psf_draw
        procedure :: add_bright_star => psf_add_bright_star
        procedure :: draw_memory => psf_draw_memory
        procedure :: add_stars => psf_add_stars
        procedure :: convolve => psf_convolve
        procedure :: create_in_band => psf_create_in_band
        procedure :: create_chromatic => psf_create_chromatic
        procedure :: get => psf_get
        final :: psf_finalize
    end type wfpsf_psf

    ! The PSF all over a detector.
    type, extends(handle) :: wfpsf_varying_psf
    contains
        procedure :: create => varying_psf_create
        procedure :: destroy => varying_psf_destroy
        procedure :: at => varying_psf_at
        procedure :: add_stars => varying_psf_add_stars
        procedure :: get => varying_psf_get
        final :: varying_psf_finalize
    end type wfpsf_varying_psf

    ! A PSF in k space.
    type, extends(handle) :: wfpsf_otf
    contains
        procedure :: create => otf_create
        procedure :: destroy => otf_destroy
        procedure :: values => otf_values
        procedure :: grid => otf_grid
        procedure :: get => otf_get
        final :: otf_finalize
    end type wfpsf_otf

    ! The tables of the paper, all at once.
    type, extends(handle) :: wfpsf_study
    contains
        procedure :: create => study_create
        procedure :: destroy => study_destroy
        procedure :: size => study_size
        procedure :: column => study_column
        procedure :: value => study_value
        procedure :: text => study_text
        procedure :: write_csv => study_write_csv
        final :: study_finalize
    end type wfpsf_study

    ! An interpixel capacitance kernel, applied by convolution.
    type, extends(handle) :: wfpsf_ipc_kernel
    contains
        procedure :: create => kernel_create
        procedure :: create_taps => kernel_create_taps
        procedure :: create_wfc3 => kernel_create_wfc3
        procedure :: create_default => kernel_create_default
        procedure :: create_correction => kernel_create_correction
        procedure :: create_flipped => kernel_create_flipped
        procedure :: read_fits => kernel_read_fits
        procedure :: create_composed => kernel_create_composed
        procedure :: create_neumann => kernel_create_neumann
        procedure :: create_autocorrelation => kernel_create_autocorrelation
        procedure :: destroy => kernel_destroy
        procedure :: get_taps => kernel_get_taps
        procedure :: get => kernel_get
        procedure :: transform => kernel_transform
        procedure :: self_test => kernel_self_test
        procedure :: apply => kernel_apply
        procedure :: correct => kernel_correct
        procedure :: covariance => kernel_covariance
        final :: kernel_finalize
    end type wfpsf_ipc_kernel

    ! IPC whose kernel varies from pixel to pixel.
    type, extends(handle) :: wfpsf_varying_ipc
    contains
        procedure :: create_maps => varying_ipc_create_maps
        procedure :: create_polynomials => varying_ipc_create_polynomials
        procedure :: create_regions => varying_ipc_create_regions
        procedure :: destroy => varying_ipc_destroy
        procedure :: get_kernel => varying_ipc_get_kernel
        procedure :: get_margin => varying_ipc_get_margin
        procedure :: apply => varying_ipc_apply
        procedure :: correct => varying_ipc_correct
        procedure :: covariance => varying_ipc_covariance
        procedure :: get_autocorrelation => varying_ipc_get_autocorrelation
        final :: varying_ipc_finalize
    end type wfpsf_varying_ipc

    ! A detector's effects in a stated order.
    type, extends(handle) :: wfpsf_chain
    contains
        procedure :: create => chain_create
        procedure :: create_default => chain_create_default
        procedure :: destroy => chain_destroy
        procedure :: add => chain_add
        procedure, private :: chain_add_ipc, chain_add_varying_ipc
        generic :: add_ipc => chain_add_ipc, chain_add_varying_ipc
        procedure :: add_map => chain_add_map
        procedure :: get_step => chain_get_step
        procedure :: apply => chain_apply
        final :: chain_finalize
    end type wfpsf_chain

    ! The stars and small galaxies that a scene is made of. Their numbers and those of colours count
    ! from 1 in the order of adding.
    type, extends(handle) :: wfpsf_catalogue
        real(real64), private :: origin = 0 ! of its positions, which the library counts from 0
    contains
        procedure :: create => catalogue_create
        procedure :: destroy => catalogue_destroy
        procedure :: add_colour => catalogue_add_colour
        procedure :: add_stars => catalogue_add_stars
        procedure :: add_galaxies => catalogue_add_galaxies
        procedure :: size => catalogue_size
        final :: catalogue_finalize
    end type wfpsf_catalogue

    ! What rendering a scene came to.
    type, extends(handle) :: wfpsf_rendering
    contains
        procedure :: destroy => rendering_destroy
        procedure :: get => rendering_get
        final :: rendering_finalize
    end type wfpsf_rendering

    ! What scenes are drawn with, kept for the next ones of the same optics and image:
    ! options%set_scene_store() and the option scene_exposures. Threads may share it.
    type, extends(handle) :: wfpsf_scene_store
    contains
        procedure :: create => scene_store_create
        procedure :: destroy => scene_store_destroy
        procedure :: memory => scene_store_memory
        procedure :: write => scene_store_write
        procedure :: read => scene_store_read
        final :: scene_store_finalize
    end type wfpsf_scene_store

    ! All sources of a catalogue on an image of a detector, within an error budget.
    type, extends(handle) :: wfpsf_scene
    contains
        procedure :: create => scene_create
        procedure :: destroy => scene_destroy
        procedure :: get => scene_get
        procedure :: get_group => scene_get_group
        procedure :: groups_of => scene_groups_of
        procedure :: text => scene_text
        procedure :: render => scene_render
        procedure :: truth => scene_truth
        final :: scene_finalize
    end type wfpsf_scene

    ! The scenes of all detectors, with background and effects, each in a FITS file of its own.
    type, extends(handle) :: wfpsf_exposure
    contains
        procedure :: create => exposure_create
        procedure :: destroy => exposure_destroy
        procedure :: path => exposure_path
        procedure :: make => exposure_make
        final :: exposure_finalize
    end type wfpsf_exposure

    ! The result of a measurement.
    type, extends(handle) :: wfpsf_moments
        logical, private :: are_derivatives = .false. ! which no origin moves
    contains
        procedure :: measure => moments_measure
        procedure :: measure_masked => moments_measure_masked
        procedure :: measure_weighted => moments_measure_weighted
        procedure :: measure_unweighted => moments_measure_unweighted
        procedure :: differentiate => moments_differentiate
        procedure :: influence => moments_influence
        procedure :: covariance => moments_covariance
        procedure :: destroy => moments_destroy
        procedure :: status => moments_status
        procedure :: get => moments_get
        final :: moments_finalize
    end type wfpsf_moments

    ! Common to all.
    private :: is_empty, refuse_assignment, pointer_of
    interface
        ! True before create and after destroy.
        pure module function is_empty(self)
            class(handle), intent(in) :: self
            logical :: is_empty
        end function is_empty

        ! Two owners of one handle would free it twice.
        module subroutine refuse_assignment(self, other)
            class(handle), intent(inout) :: self
            class(handle), intent(in) :: other
        end subroutine refuse_assignment

        ! NULL for options that are left out.
        module function pointer_of(options) result(pointer)
            type(wfpsf_options), intent(in), optional :: options
            type(c_ptr) :: pointer
        end function pointer_of

        ! Fails if the loaded library's binary interface is not the one these modules describe.
        module subroutine wfpsf_check_version(stat, errmsg)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine wfpsf_check_version

        ! "major.minor.patch" of the loaded library.
        module function wfpsf_library_version() result(version)
            character(len=:), allocatable :: version
        end function wfpsf_library_version
    end interface

    abstract interface
        ! What long work calls now and then, on the thread that asked for it, with the part that is
        ! done, 0 to 1. Other than 0 as outcome: stop; the work then fails with
        ! wfpsf_error_cancelled. C calls it: it must have bind(c), and not end by other means than
        ! its return.
        function wfpsf_progress(part, user) bind(c) result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            real(c_double), value :: part
            type(c_ptr), value :: user
            integer(c_int32_t) :: outcome
        end function wfpsf_progress
    end interface

    ! Options.
    private :: options_create, options_destroy, options_set_real, options_set_integer
    private :: options_get, options_reset, options_set_zernikes, options_set_opd
    private :: options_set_scene_store, options_set_progress, options_finalize
    interface
        module subroutine options_create(self, stat, errmsg)
            class(wfpsf_options), intent(inout) :: self
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine options_create

        module subroutine options_destroy(self)
            class(wfpsf_options), intent(inout) :: self
        end subroutine options_destroy

        ! Options of the kind wfpsf_option_real take a real value, the others an integer.
        module subroutine options_set_real(self, key, value, stat, errmsg)
            class(wfpsf_options), intent(inout) :: self
            integer, intent(in) :: key
            real(real64), intent(in) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine options_set_real

        module subroutine options_set_integer(self, key, value, stat, errmsg)
            class(wfpsf_options), intent(inout) :: self
            integer, intent(in) :: key
            integer, intent(in) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine options_set_integer

        ! Whatever its kind, as a real; NaN if it is left to the library.
        module subroutine options_get(self, key, value, stat, errmsg)
            class(wfpsf_options), intent(in) :: self
            integer, intent(in) :: key
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine options_get

        module subroutine options_reset(self, key, stat, errmsg)
            class(wfpsf_options), intent(inout) :: self
            integer, intent(in) :: key
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine options_reset

        ! Extra aberrations: Noll order from j = 1, waves rms at the instrument's reference
        ! wavelength.
        module subroutine options_set_zernikes(self, coefficients, stat, errmsg)
            class(wfpsf_options), intent(inout) :: self
            real(real64), intent(in), contiguous :: coefficients(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine options_set_zernikes

        ! An optical path difference map in metres, added to the wavefront; scale_m between samples,
        ! the optical axis at sample (axis_x, axis_y). An empty map takes the present one away.
        module subroutine options_set_opd(self, map, scale_m, axis_x, axis_y, stat, errmsg)
            class(wfpsf_options), intent(inout) :: self
            type(wfpsf_image), intent(in) :: map
            real(real64), intent(in) :: scale_m, axis_x, axis_y
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine options_set_opd

        ! Scenes and exposures that are created with these options share a store; absent: each makes
        ! its own.
        module subroutine options_set_scene_store(self, store, stat, errmsg)
            class(wfpsf_options), intent(inout) :: self
            type(wfpsf_scene_store), intent(in), optional :: store
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine options_set_scene_store

        ! A function of the caller's, such as
        !
        !     function show(part, user) bind(c) result(outcome)
        !         real(c_double), value :: part
        !         type(c_ptr), value :: user
        !         integer(c_int32_t) :: outcome
        !         print "(f6.1, a)", 100 * part, " %"
        !         outcome = 0
        !     end function show
        !
        ! in a module, and what it gets as user: c_loc of a target, or c_null_ptr if left out. An
        ! internal function must not be called when its host has returned. Without progress: none.
        module subroutine options_set_progress(self, progress, user, stat, errmsg)
            class(wfpsf_options), intent(inout) :: self
            procedure(wfpsf_progress), optional :: progress
            type(c_ptr), intent(in), optional :: user
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine options_set_progress

        impure elemental module subroutine options_finalize(self)
            type(wfpsf_options), intent(inout) :: self
        end subroutine options_finalize
    end interface

    ! Instruments.
    private :: instrument_create, instrument_destroy, instrument_constant, instrument_constant_name
    private :: instrument_band, instrument_band_name, instrument_throughput, instrument_zernikes
    private :: instrument_create_from_design, instrument_pupil, instrument_finalize
    interface
        ! name: "wfirst-afta-c5" or "roman-c9".
        module subroutine instrument_create(self, name, stat, errmsg)
            class(wfpsf_instrument), intent(inout) :: self
            character(len=*), intent(in) :: name
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine instrument_create

        module subroutine instrument_create_from_design(self, design, stat, errmsg)
            class(wfpsf_instrument), intent(inout) :: self
            type(wfpsf_design), intent(in) :: design
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine instrument_create_from_design

        module subroutine instrument_destroy(self)
            class(wfpsf_instrument), intent(inout) :: self
        end subroutine instrument_destroy

        ! A constant by name, such as "diameter" or "pixel_scale".
        module subroutine instrument_constant(self, name, value, unit, stat, errmsg)
            class(wfpsf_instrument), intent(in) :: self
            character(len=*), intent(in) :: name
            real(real64), intent(inout) :: value
            character(len=:), allocatable, intent(out), optional :: unit
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine instrument_constant

        ! Name of the index-th constant, index = 1, 2, ...; empty past the last.
        module function instrument_constant_name(self, index) result(name)
            class(wfpsf_instrument), intent(in) :: self
            integer, intent(in) :: index
            character(len=:), allocatable :: name
        end function instrument_constant_name

        ! Limits and effective wavelength of a band; rule: wfpsf_band_*.
        module subroutine instrument_band(self, band, rule, blue_nm, red_nm, effective_nm, stat, &
            errmsg)
            class(wfpsf_instrument), intent(in) :: self
            character(len=*), intent(in) :: band
            integer, intent(in) :: rule
            real(real64), intent(inout), optional :: blue_nm, red_nm, effective_nm
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine instrument_band

        ! Name of the index-th band in order of wavelength, index = 1, 2, ...; empty past the last.
        module function instrument_band_name(self, index) result(name)
            class(wfpsf_instrument), intent(in) :: self
            integer, intent(in) :: index
            character(len=:), allocatable :: name
        end function instrument_band_name

        ! Throughput of a band; the two arrays have one size.
        module subroutine instrument_throughput(self, band, wavelength_nm, throughput, stat, errmsg)
            class(wfpsf_instrument), intent(in) :: self
            character(len=*), intent(in) :: band
            real(real64), intent(in), contiguous :: wavelength_nm(:)
            real(real64), intent(inout), contiguous :: throughput(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine instrument_throughput

        ! Aberrations at the centre of a detector, as options%set_zernikes takes them.
        module subroutine instrument_zernikes(self, sca, coefficients, stat, errmsg)
            class(wfpsf_instrument), intent(in) :: self
            integer, intent(in) :: sca
            real(real64), allocatable, intent(out) :: coefficients(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine instrument_zernikes

        ! Draws the pupil that an SCA sees through a band: lit fractions of the pixels, their side in
        ! metres, and the optical axis, the first pixel being (1, 1). Option: struts.
        module subroutine instrument_pupil(self, band, sca, image, scale_m, axis_x, axis_y, &
            options, stat, errmsg)
            class(wfpsf_instrument), intent(in) :: self
            character(len=*), intent(in) :: band
            integer, intent(in) :: sca
            type(wfpsf_image), intent(inout) :: image
            real(real64), intent(inout) :: scale_m, axis_x, axis_y
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine instrument_pupil

        impure elemental module subroutine instrument_finalize(self)
            type(wfpsf_instrument), intent(inout) :: self
        end subroutine instrument_finalize
    end interface

    ! Designs.
    private :: design_create, design_destroy, design_set_telescope, design_add_strut
    private :: design_set_detector, design_set_zernikes, design_set_field, design_add_band
    private :: design_finalize
    interface
        module subroutine design_create(self, stat, errmsg)
            class(wfpsf_design), intent(inout) :: self
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine design_create

        module subroutine design_destroy(self)
            class(wfpsf_design), intent(inout) :: self
        end subroutine design_destroy

        ! obscuration: linear, of the diameter. reference_wavelength_nm: of Zernike coefficients.
        module subroutine design_set_telescope(self, diameter_m, obscuration, &
            reference_wavelength_nm, stat, errmsg)
            class(wfpsf_design), intent(inout) :: self
            real(real64), intent(in) :: diameter_m, obscuration, reference_wavelength_nm
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine design_set_telescope

        ! A dark bar from the axis outwards; offset_m (0 if left out) moves it towards
        ! azimuth_deg + 90.
        module subroutine design_add_strut(self, azimuth_deg, width_m, offset_m, stat, errmsg)
            class(wfpsf_design), intent(inout) :: self
            real(real64), intent(in) :: azimuth_deg, width_m
            real(real64), intent(in), optional :: offset_m
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine design_add_strut

        module subroutine design_set_detector(self, sca_count, pixel_scale_arcsec, n_pix_x, n_pix_y, &
            stat, errmsg)
            class(wfpsf_design), intent(inout) :: self
            integer, intent(in) :: sca_count, n_pix_x, n_pix_y
            real(real64), intent(in) :: pixel_scale_arcsec
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine design_set_detector

        ! Aberrations all over a detector: Noll order from j = 1, waves rms at the reference
        ! wavelength.
        module subroutine design_set_zernikes(self, sca, coefficients, stat, errmsg)
            class(wfpsf_design), intent(inout) :: self
            integer, intent(in) :: sca
            real(real64), intent(in), contiguous :: coefficients(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine design_set_zernikes

        ! Aberrations at five points of a detector, the centre first: coefficients(:, i) at pixel
        ! (x(i), y(i)).
        module subroutine design_set_field(self, sca, x, y, coefficients, stat, errmsg)
            class(wfpsf_design), intent(inout) :: self
            integer, intent(in) :: sca
            real(real64), intent(in), contiguous :: x(:), y(:), coefficients(:, :)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine design_set_field

        ! Throughput at first_nm, first_nm + step_nm, ...; linear in between, zero outside.
        module subroutine design_add_band(self, name, first_nm, step_nm, throughput, stat, errmsg)
            class(wfpsf_design), intent(inout) :: self
            character(len=*), intent(in) :: name
            real(real64), intent(in) :: first_nm, step_nm
            real(real64), intent(in), contiguous :: throughput(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine design_add_band

        impure elemental module subroutine design_finalize(self)
            type(wfpsf_design), intent(inout) :: self
        end subroutine design_finalize
    end interface

    ! Images.
    private :: image_create, image_wrap_real32, image_wrap_real64, image_read_fits
    private :: image_write_fits, image_destroy, image_get_shape, image_get_record, image_set_record
    private :: image_copy_from, image_get_pixels_real32, image_get_pixels_real64, image_interleave
    private :: image_deinterleave, image_encircled_energy, image_ee_radius, image_fwhm
    private :: image_ee_radius_derivative, image_radial_profile, image_profile_fwhm
    private :: image_moment_sums
    private :: image_finalize
    interface
        ! Zeros that the image owns; pixel_type: wfpsf_float32 or wfpsf_float64; oversampling:
        ! samples per native pixel along each axis.
        module subroutine image_create(self, pixel_type, nx, ny, oversampling, stat, errmsg)
            class(wfpsf_image), intent(inout) :: self
            integer, intent(in) :: pixel_type, nx, ny, oversampling
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_create

        ! The image stands on the array, without a copy: what is drawn appears there. The array is a
        ! pointer or has the target attribute; it may be a section with any strides. (A component
        ! of an array of a derived type: point to it and give the pointer; gfortran 12 mistakes the
        ! address if given the component itself.) The array must outlive the image and keep its
        ! place: destroy or wrap again before it is deallocated, reallocated, or leaves its scope.
        module subroutine image_wrap_real32(self, array, oversampling, stat, errmsg)
            class(wfpsf_image), intent(inout) :: self
            real(real32), pointer, intent(in) :: array(:, :)
            integer, intent(in) :: oversampling
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_wrap_real32

        module subroutine image_wrap_real64(self, array, oversampling, stat, errmsg)
            class(wfpsf_image), intent(inout) :: self
            real(real64), pointer, intent(in) :: array(:, :)
            integer, intent(in) :: oversampling
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_wrap_real64

        ! hdu: the extension's name, or its number from 0; absent: the first image. pixel_type:
        ! absent: as the file suggests. Trailing blanks of a path do not count.
        module subroutine image_read_fits(self, path, hdu, pixel_type, stat, errmsg)
            class(wfpsf_image), intent(inout) :: self
            character(len=*), intent(in) :: path
            character(len=*), intent(in), optional :: hdu
            integer, intent(in), optional :: pixel_type
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_read_fits

        ! Option: fits_overwrite.
        module subroutine image_write_fits(self, path, options, stat, errmsg)
            class(wfpsf_image), intent(in) :: self
            character(len=*), intent(in) :: path
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_write_fits

        module subroutine image_destroy(self)
            class(wfpsf_image), intent(inout) :: self
        end subroutine image_destroy

        module subroutine image_get_shape(self, pixel_type, nx, ny, stat, errmsg)
            class(wfpsf_image), intent(in) :: self
            integer, intent(inout), optional :: pixel_type, nx, ny
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_get_shape

        ! applied: sum of wfpsf_effect_*.
        module subroutine image_get_record(self, oversampling, pixel_scale_arcsec, applied, stat, &
            errmsg)
            class(wfpsf_image), intent(in) :: self
            integer, intent(inout), optional :: oversampling
            real(real64), intent(inout), optional :: pixel_scale_arcsec
            integer, intent(inout), optional :: applied
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_get_record

        module subroutine image_set_record(self, oversampling, pixel_scale_arcsec, applied, stat, &
            errmsg)
            class(wfpsf_image), intent(inout) :: self
            integer, intent(in) :: oversampling
            real(real64), intent(in) :: pixel_scale_arcsec
            integer, intent(in) :: applied
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_set_record

        ! Pixels, converted to this image's type, and record of an image of the same size.
        module subroutine image_copy_from(self, other, stat, errmsg)
            class(wfpsf_image), intent(inout) :: self
            class(wfpsf_image), intent(in) :: other
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_copy_from

        ! A copy of the pixels, in an array made to fit.
        module subroutine image_get_pixels_real32(self, array, stat, errmsg)
            class(wfpsf_image), intent(in) :: self
            real(real32), allocatable, target, intent(out) :: array(:, :)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_get_pixels_real32

        module subroutine image_get_pixels_real64(self, array, stat, errmsg)
            class(wfpsf_image), intent(in) :: self
            real(real64), allocatable, target, intent(out) :: array(:, :)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_get_pixels_real64

        ! Makes this image of n_x * n_y dithered ones with offsets dx, dy in native pixels.
        module subroutine image_interleave(self, images, n_x, n_y, dx, dy, convention, stat, errmsg)
            class(wfpsf_image), intent(inout) :: self
            type(wfpsf_image), intent(in) :: images(:)
            integer, intent(in) :: n_x, n_y
            real(real64), intent(in), contiguous :: dx(:), dy(:)
            integer, intent(in) :: convention
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_interleave

        ! The inverse: makes the dithered images of this one.
        module subroutine image_deinterleave(self, images, n_x, n_y, dx, dy, convention, stat, &
            errmsg)
            class(wfpsf_image), intent(in) :: self
            type(wfpsf_image), intent(inout) :: images(:)
            integer, intent(in) :: n_x, n_y
            real(real64), intent(in), contiguous :: dx(:), dy(:)
            integer, intent(in) :: convention
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_deinterleave

        ! Fraction of the light in the circle about (x, y), pixels of the image.
        ! Options: size_total_flux, size_bandwidth, size_eps.
        module subroutine image_encircled_energy(self, x, y, radius, fraction, error, options, &
            stat, errmsg)
            class(wfpsf_image), intent(in) :: self
            real(real64), intent(in) :: x, y, radius
            real(real64), intent(inout) :: fraction
            real(real64), intent(inout), optional :: error
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_encircled_energy

        ! Radius of the circle about (x, y) that holds a fraction of the light; method:
        ! wfpsf_size_*. Options: size_total_flux, size_bandwidth, size_eps.
        module subroutine image_ee_radius(self, x, y, fraction, method, radius, error, options, &
            stat, errmsg)
            class(wfpsf_image), intent(in) :: self
            real(real64), intent(in) :: x, y, fraction
            integer, intent(in) :: method
            real(real64), intent(inout) :: radius
            real(real64), intent(inout), optional :: error
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_ee_radius

        ! The derivative of that radius, of the band-limited image, by a change of the image; the
        ! mixed one by change and second.
        module subroutine image_ee_radius_derivative(self, change, x, y, fraction, derivative, &
            error, second, options, stat, errmsg)
            class(wfpsf_image), intent(in) :: self
            type(wfpsf_image), intent(in) :: change
            real(real64), intent(in) :: x, y, fraction
            real(real64), intent(inout) :: derivative
            real(real64), intent(inout), optional :: error
            type(wfpsf_image), intent(in), optional :: second
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_ee_radius_derivative

        ! Means of the band-limited image on circles about (x, y), and estimates of their errors;
        ! both are as long as radii. Options: size_bandwidth, size_eps.
        module subroutine image_radial_profile(self, x, y, radii, profile, errors, options, stat, &
            errmsg)
            class(wfpsf_image), intent(in) :: self
            real(real64), intent(in) :: x, y
            real(real64), intent(in), contiguous :: radii(:)
            real(real64), intent(inout), contiguous :: profile(:)
            real(real64), intent(inout), contiguous, optional :: errors(:)
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_radial_profile

        ! Full width at half maximum of that profile.
        module subroutine image_profile_fwhm(self, x, y, fwhm, error, options, stat, errmsg)
            class(wfpsf_image), intent(in) :: self
            real(real64), intent(in) :: x, y
            real(real64), intent(inout) :: fwhm
            real(real64), intent(inout), optional :: error
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_profile_fwhm

        ! Sums of I w dx^j dy^k about (x, y), (j, k) = (0,0), (1,0), (0,1), (2,0), ..., as many as
        ! sums holds, at most 15. weight: mxx, mxy, myy of a Gaussian.
        module subroutine image_moment_sums(self, x, y, sums, weight, stat, errmsg)
            class(wfpsf_image), intent(in) :: self
            real(real64), intent(in) :: x, y
            real(real64), intent(inout), contiguous :: sums(:)
            real(real64), intent(in), optional :: weight(3)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_moment_sums

        module subroutine image_fwhm(self, x, y, fwhm, stat, errmsg)
            class(wfpsf_image), intent(in) :: self
            real(real64), intent(in) :: x, y
            real(real64), intent(inout) :: fwhm
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine image_fwhm

        impure elemental module subroutine image_finalize(self)
            type(wfpsf_image), intent(inout) :: self
        end subroutine image_finalize
    end interface

    ! Observations. Positions without an answer give NaN and are counted in undefined. The arrays of a
    ! call have one size.
    private :: observation_create, observation_create_on_date, observation_create_aimed
    private :: observation_destroy, observation_get, observation_sky_to_pixel
    private :: observation_pixel_to_sky, observation_find_sca, observation_get_bounds
    private :: observation_jacobian, observation_fits_header, observation_finalize
    interface
        ! pa_deg: of the observatory's +Y axis, or with wfpsf_option_pa_of_fpa of the focal plane.
        module subroutine observation_create(self, instrument, ra_deg, dec_deg, pa_deg, options, &
            stat, errmsg)
            class(wfpsf_observation), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            real(real64), intent(in) :: ra_deg, dec_deg, pa_deg
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine observation_create

        ! With the best roll of the date (UTC).
        module subroutine observation_create_on_date(self, instrument, ra_deg, dec_deg, &
            julian_date, options, stat, errmsg)
            class(wfpsf_observation), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            real(real64), intent(in) :: ra_deg, dec_deg, julian_date
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine observation_create_on_date

        ! That which has pixel (x, y) of a detector at a place on the sky.
        module subroutine observation_create_aimed(self, instrument, sca, x, y, ra_deg, dec_deg, &
            pa_deg, options, stat, errmsg)
            class(wfpsf_observation), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            integer, intent(in) :: sca
            real(real64), intent(in) :: x, y, ra_deg, dec_deg, pa_deg
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine observation_create_aimed

        module subroutine observation_destroy(self)
            class(wfpsf_observation), intent(inout) :: self
        end subroutine observation_destroy

        ! key: wfpsf_observation_*.
        module subroutine observation_get(self, sca, key, value, stat, errmsg)
            class(wfpsf_observation), intent(in) :: self
            integer, intent(in) :: sca, key
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine observation_get

        module subroutine observation_sky_to_pixel(self, sca, ra_deg, dec_deg, x, y, undefined, &
            stat, errmsg)
            class(wfpsf_observation), intent(in) :: self
            integer, intent(in) :: sca
            real(real64), intent(in), contiguous :: ra_deg(:), dec_deg(:)
            real(real64), intent(inout), contiguous :: x(:), y(:)
            integer(int64), intent(out), optional :: undefined
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine observation_sky_to_pixel

        module subroutine observation_pixel_to_sky(self, sca, x, y, ra_deg, dec_deg, undefined, &
            stat, errmsg)
            class(wfpsf_observation), intent(in) :: self
            integer, intent(in) :: sca
            real(real64), intent(in), contiguous :: x(:), y(:)
            real(real64), intent(inout), contiguous :: ra_deg(:), dec_deg(:)
            integer(int64), intent(out), optional :: undefined
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine observation_pixel_to_sky

        ! sca: 0 where a position falls on no detector; x and y are NaN there.
        module subroutine observation_find_sca(self, with_gaps, ra_deg, dec_deg, sca, x, y, &
            stat, errmsg)
            class(wfpsf_observation), intent(in) :: self
            logical, intent(in) :: with_gaps
            real(real64), intent(in), contiguous :: ra_deg(:), dec_deg(:)
            integer(c_int32_t), intent(inout), contiguous :: sca(:)
            real(real64), intent(inout), contiguous :: x(:), y(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine observation_find_sca

        ! First and last pixels, the active ones being 1 to n_pix.
        module subroutine observation_get_bounds(self, sca, with_gaps, x_first, x_last, y_first, &
            y_last, stat, errmsg)
            class(wfpsf_observation), intent(in) :: self
            integer, intent(in) :: sca
            logical, intent(in) :: with_gaps
            integer(int64), intent(out) :: x_first, x_last, y_first, y_last
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine observation_get_bounds

        ! jacobian(2, 2, n): of each position the changes by x and by y, first to the east, then to the
        ! north: jacobian(1, 2, i) is that to the north by x; arcsec per pixel. pixel_area: arcsec**2.
        module subroutine observation_jacobian(self, sca, x, y, jacobian, pixel_area, &
            y_angle_deg, undefined, stat, errmsg)
            class(wfpsf_observation), intent(in) :: self
            integer, intent(in) :: sca
            real(real64), intent(in), contiguous :: x(:), y(:)
            real(real64), intent(inout), contiguous :: jacobian(:, :, :), pixel_area(:), y_angle_deg(:)
            integer(int64), intent(out), optional :: undefined
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine observation_jacobian

        ! WCS keywords: cards of 80 characters one after another, no END.
        module subroutine observation_fits_header(self, sca, text, stat, errmsg)
            class(wfpsf_observation), intent(in) :: self
            integer, intent(in) :: sca
            character(len=:), allocatable, intent(out) :: text
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine observation_fits_header

        impure elemental module subroutine observation_finalize(self)
            type(wfpsf_observation), intent(inout) :: self
        end subroutine observation_finalize
    end interface

    ! The Sun and what it allows. Dates are Julian, UTC.
    interface
        module subroutine wfpsf_get_julian_date(year, month, day, hour, minute, second, julian_date, &
            stat, errmsg)
            integer, intent(in) :: year, month, day, hour, minute
            real(real64), intent(in) :: second
            real(real64), intent(inout) :: julian_date
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine wfpsf_get_julian_date

        module subroutine wfpsf_get_sun_position(julian_date, ra_deg, dec_deg, options, stat, errmsg)
            real(real64), intent(in) :: julian_date
            real(real64), intent(inout) :: ra_deg, dec_deg
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine wfpsf_get_sun_position

        module subroutine wfpsf_check_pointing(instrument, ra_deg, dec_deg, julian_date, &
            sun_angle_deg, allowed, options, stat, errmsg)
            type(wfpsf_instrument), intent(in) :: instrument
            real(real64), intent(in) :: ra_deg, dec_deg, julian_date
            real(real64), intent(inout) :: sun_angle_deg
            logical, intent(out) :: allowed
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine wfpsf_check_pointing

        module subroutine wfpsf_get_best_pa(instrument, ra_deg, dec_deg, julian_date, pa_deg, &
            options, stat, errmsg)
            type(wfpsf_instrument), intent(in) :: instrument
            real(real64), intent(in) :: ra_deg, dec_deg, julian_date
            real(real64), intent(inout) :: pa_deg
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine wfpsf_get_best_pa
    end interface

    ! SEDs.
    private :: sed_create_table, sed_create_power_law, sed_create_black_body, sed_create_redshifted
    private :: sed_destroy, sed_photon_density, sed_finalize
    interface
        ! Linear between samples at rising wavelengths; the two arrays have one size. unit of the
        ! density: wfpsf_sed_photons or wfpsf_sed_energy, per unit of wavelength.
        module subroutine sed_create_table(self, unit, wavelength_nm, density, stat, errmsg)
            class(wfpsf_sed), intent(inout) :: self
            integer, intent(in) :: unit
            real(real64), intent(in), contiguous :: wavelength_nm(:), density(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine sed_create_table

        ! A density of wavelength**exponent.
        module subroutine sed_create_power_law(self, unit, exponent, stat, errmsg)
            class(wfpsf_sed), intent(inout) :: self
            integer, intent(in) :: unit
            real(real64), intent(in) :: exponent
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine sed_create_power_law

        module subroutine sed_create_black_body(self, temperature_k, stat, errmsg)
            class(wfpsf_sed), intent(inout) :: self
            real(real64), intent(in) :: temperature_k
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine sed_create_black_body

        ! Another SED with wavelengths 1 + redshift times as long.
        module subroutine sed_create_redshifted(self, sed, redshift, stat, errmsg)
            class(wfpsf_sed), intent(inout) :: self
            type(wfpsf_sed), intent(in) :: sed
            real(real64), intent(in) :: redshift
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine sed_create_redshifted

        module subroutine sed_destroy(self)
            class(wfpsf_sed), intent(inout) :: self
        end subroutine sed_destroy

        ! Photons per unit of wavelength, up to one factor; the two arrays have one size.
        module subroutine sed_photon_density(self, wavelength_nm, photons, stat, errmsg)
            class(wfpsf_sed), intent(in) :: self
            real(real64), intent(in), contiguous :: wavelength_nm(:)
            real(real64), intent(inout), contiguous :: photons(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine sed_photon_density

        impure elemental module subroutine sed_finalize(self)
            type(wfpsf_sed), intent(inout) :: self
        end subroutine sed_finalize
    end interface

    ! PSFs.
    private :: psf_create, psf_create_from_mask, psf_destroy, psf_draw, psf_add_bright_star, &
        psf_draw_memory, psf_add_stars, &
        psf_convolve, psf_create_in_band, psf_create_chromatic, psf_get, psf_finalize
    interface
        ! At the centre of detector sca, 1..18. Options: eps, struts, psf_radius, piston_tilt,
        ! jitter_*, charge_diffusion, extra Zernikes, an OPD map and progress.
        module subroutine psf_create(self, instrument, sca, wavelength_nm, options, stat, errmsg)
            class(wfpsf_psf), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            integer, intent(in) :: sca
            real(real64), intent(in) :: wavelength_nm
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine psf_create

        ! The same with a mask for pupil; (axis_x, axis_y): the optical axis in the mask, whose
        ! first pixel is (1, 1).
        module subroutine psf_create_from_mask(self, instrument, mask, mask_scale_m, axis_x, &
            axis_y, sca, wavelength_nm, options, stat, errmsg)
            class(wfpsf_psf), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            type(wfpsf_image), intent(in) :: mask
            real(real64), intent(in) :: mask_scale_m, axis_x, axis_y
            integer, intent(in) :: sca
            real(real64), intent(in) :: wavelength_nm
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine psf_create_from_mask

        ! At position (x, y) of a detector, in its pixels, through the pupil of a band;
        ! wavelength_nm = 0: the band's effective one.
        module subroutine psf_create_in_band(self, instrument, band, sca, x, y, wavelength_nm, &
            options, stat, errmsg)
            class(wfpsf_psf), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            character(len=*), intent(in) :: band
            integer, intent(in) :: sca
            real(real64), intent(in) :: x, y, wavelength_nm
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine psf_create_in_band

        ! Of a source of many colours, seen through the band: the sum over the photons detected.
        module subroutine psf_create_chromatic(self, instrument, band, sca, x, y, sed, options, &
            stat, errmsg)
            class(wfpsf_psf), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            character(len=*), intent(in) :: band
            integer, intent(in) :: sca
            real(real64), intent(in) :: x, y
            type(wfpsf_sed), intent(in) :: sed
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine psf_create_chromatic

        ! One PSF for each of several SEDs, in little more time than one takes. An error empties all
        ! of psfs, which has the size of seds.
        module subroutine wfpsf_psf_create_chromatic_each(instrument, band, sca, x, y, seds, psfs, &
            options, stat, errmsg)
            type(wfpsf_instrument), intent(in) :: instrument
            character(len=*), intent(in) :: band
            integer, intent(in) :: sca
            real(real64), intent(in) :: x, y
            type(wfpsf_sed), intent(in) :: seds(:)
            type(wfpsf_psf), intent(inout) :: psfs(:)
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine wfpsf_psf_create_chromatic_each

        module subroutine psf_destroy(self)
            class(wfpsf_psf), intent(inout) :: self
        end subroutine psf_destroy

        ! Overwrites the image with a star whose optical axis falls on (x, y), pixels of the image,
        ! whatever its size; options: memory_limit and the progress function, for stamps beyond the
        ! PSF's radius.
        module subroutine psf_draw(self, x, y, flux, image, options, stat, errmsg)
            class(wfpsf_psf), intent(in) :: self
            real(real64), intent(in) :: x, y, flux
            type(wfpsf_image), intent(inout) :: image
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine psf_draw

        ! The same, added to what the image holds, on all of its pixels. Option also: force.
        module subroutine psf_add_bright_star(self, x, y, flux, image, options, stat, errmsg)
            class(wfpsf_psf), intent(in) :: self
            real(real64), intent(in) :: x, y, flux
            type(wfpsf_image), intent(inout) :: image
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine psf_add_bright_star

        ! Bytes that drawing into the image would take: at least, and to be done in one go.
        module subroutine psf_draw_memory(self, x, y, image, least, most, stat, errmsg)
            class(wfpsf_psf), intent(in) :: self
            real(real64), intent(in) :: x, y
            type(wfpsf_image), intent(in) :: image
            integer(int64), intent(inout) :: least, most
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine psf_draw_memory

        ! Adds stars, each within the PSF's radius of it, clipped at the image's borders. The arrays
        ! are of one size; options: threads, force.
        module subroutine psf_add_stars(self, x, y, flux, image, options, stat, errmsg)
            class(wfpsf_psf), intent(in) :: self
            real(real64), intent(in), contiguous :: x(:), y(:), flux(:)
            type(wfpsf_image), intent(inout) :: image
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine psf_add_stars

        ! Overwrites the image with an extended source: an image of flux per sample, convolved. Its
        ! centre falls on (x, y), pixels of the image. Option: force.
        module subroutine psf_convolve(self, galaxy, x, y, flux, image, options, stat, errmsg)
            class(wfpsf_psf), intent(in) :: self
            type(wfpsf_image), intent(in) :: galaxy
            real(real64), intent(in) :: x, y, flux
            type(wfpsf_image), intent(inout) :: image
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine psf_convolve

        ! key: wfpsf_psf_*.
        module subroutine psf_get(self, key, value, stat, errmsg)
            class(wfpsf_psf), intent(in) :: self
            integer, intent(in) :: key
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine psf_get

        impure elemental module subroutine psf_finalize(self)
            type(wfpsf_psf), intent(inout) :: self
        end subroutine psf_finalize
    end interface

    ! The PSF all over a detector.
    private :: varying_psf_create, varying_psf_destroy, varying_psf_at, varying_psf_add_stars, &
        varying_psf_get, varying_psf_finalize
    interface
        ! Of one colour, by its wavelength or the band's effective one, or of an SED's; options as
        ! for PSFs.
        module subroutine varying_psf_create(self, instrument, band, sca, wavelength_nm, sed, &
                options, stat, errmsg)
            class(wfpsf_varying_psf), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            character(len=*), intent(in) :: band
            integer, intent(in) :: sca
            real(real64), intent(in), optional :: wavelength_nm
            type(wfpsf_sed), intent(in), optional :: sed
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_psf_create

        module subroutine varying_psf_destroy(self)
            class(wfpsf_varying_psf), intent(inout) :: self
        end subroutine varying_psf_destroy

        ! The PSF at (x, y), pixels of the detector.
        module subroutine varying_psf_at(self, x, y, psf, stat, errmsg)
            class(wfpsf_varying_psf), intent(in) :: self
            real(real64), intent(in) :: x, y
            type(wfpsf_psf), intent(inout) :: psf
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_psf_at

        ! As the PSF's, each star with the PSF of its own place; the centre of the image's first
        ! native pixel stands at (x0, y0) of the detector.
        module subroutine varying_psf_add_stars(self, x0, y0, x, y, flux, image, options, stat, &
                errmsg)
            class(wfpsf_varying_psf), intent(in) :: self
            real(real64), intent(in) :: x0, y0
            real(real64), intent(in), contiguous :: x(:), y(:), flux(:)
            type(wfpsf_image), intent(inout) :: image
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_psf_add_stars

        ! key: wfpsf_varying_psf_*.
        module subroutine varying_psf_get(self, key, value, stat, errmsg)
            class(wfpsf_varying_psf), intent(in) :: self
            integer, intent(in) :: key
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_psf_get

        impure elemental module subroutine varying_psf_finalize(self)
            type(wfpsf_varying_psf), intent(inout) :: self
        end subroutine varying_psf_finalize
    end interface

    ! Optical transfer functions.
    private :: otf_create, otf_destroy, otf_values, otf_grid, otf_get, otf_finalize
    interface
        ! Of a PSF, which may be destroyed afterwards. Option: eps.
        module subroutine otf_create(self, psf, options, stat, errmsg)
            class(wfpsf_otf), intent(inout) :: self
            type(wfpsf_psf), intent(in) :: psf
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine otf_create

        module subroutine otf_destroy(self)
            class(wfpsf_otf), intent(inout) :: self
        end subroutine otf_destroy

        ! At (kx, ky), cycles per arcsec, four arrays of one size; response: wfpsf_response_*.
        module subroutine otf_values(self, response, kx, ky, re, im, stat, errmsg)
            class(wfpsf_otf), intent(in) :: self
            integer, intent(in) :: response
            real(real64), intent(in), contiguous :: kx(:), ky(:)
            real(real64), intent(inout), contiguous :: re(:), im(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine otf_values

        ! On two images of one size; order: wfpsf_order_*, step: cycles per arcsec.
        module subroutine otf_grid(self, response, order, step, re, im, stat, errmsg)
            class(wfpsf_otf), intent(in) :: self
            integer, intent(in) :: response, order
            real(real64), intent(in) :: step
            type(wfpsf_image), intent(inout) :: re, im
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine otf_grid

        ! key: wfpsf_otf_*.
        module subroutine otf_get(self, key, value, stat, errmsg)
            class(wfpsf_otf), intent(in) :: self
            integer, intent(in) :: key
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine otf_get

        impure elemental module subroutine otf_finalize(self)
            type(wfpsf_otf), intent(inout) :: self
        end subroutine otf_finalize
    end interface

    ! IPC kernels.
    private :: kernel_create, kernel_create_taps, kernel_create_wfc3, kernel_create_default
    private :: kernel_create_correction, kernel_create_flipped, kernel_destroy, kernel_get_taps
    private :: kernel_read_fits, kernel_create_composed, kernel_create_neumann
    private :: kernel_create_autocorrelation, kernel_get, kernel_transform, kernel_self_test
    private :: kernel_apply, kernel_correct, kernel_covariance, kernel_finalize
    interface
        ! The paper's 3 x 3 kernel. Option: kernel_negative.
        module subroutine kernel_create(self, alpha, alpha_prime, alpha_plus, options, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(inout) :: self
            real(real64), intent(in) :: alpha, alpha_prime, alpha_plus
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_create

        ! taps: odd sizes, the centre in the middle. Options: kernel_negative, kernel_normalise.
        module subroutine kernel_create_taps(self, taps, options, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(inout) :: self
            real(real64), intent(in), contiguous :: taps(:, :)
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_create_taps

        ! The kernel measured for WFC3/IR.
        module subroutine kernel_create_wfc3(self, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(inout) :: self
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_create_wfc3

        ! The instrument's own.
        module subroutine kernel_create_default(self, instrument, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_create_default

        ! The first-order correction of another kernel.
        module subroutine kernel_create_correction(self, kernel, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(inout) :: self
            type(wfpsf_ipc_kernel), intent(in) :: kernel
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_create_correction

        ! Another kernel turned by 180 degrees.
        module subroutine kernel_create_flipped(self, kernel, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(inout) :: self
            type(wfpsf_ipc_kernel), intent(in) :: kernel
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_create_flipped

        ! From a FITS image of the taps. Options: kernel_negative, kernel_normalise.
        module subroutine kernel_read_fits(self, path, hdu, options, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(inout) :: self
            character(len=*), intent(in) :: path
            character(len=*), intent(in), optional :: hdu
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_read_fits

        ! What `first` does and then `second`.
        module subroutine kernel_create_composed(self, first, second, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(inout) :: self
            type(wfpsf_ipc_kernel), intent(in) :: first, second
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_create_composed

        ! The correction of an order >= 0.
        module subroutine kernel_create_neumann(self, kernel, order, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(inout) :: self
            type(wfpsf_ipc_kernel), intent(in) :: kernel
            integer, intent(in) :: order
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_create_neumann

        ! Covariance, by lag, of white noise of variance 1 after another kernel.
        module subroutine kernel_create_autocorrelation(self, kernel, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(inout) :: self
            type(wfpsf_ipc_kernel), intent(in) :: kernel
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_create_autocorrelation

        module subroutine kernel_destroy(self)
            class(wfpsf_ipc_kernel), intent(inout) :: self
        end subroutine kernel_destroy

        module subroutine kernel_get_taps(self, taps, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(in) :: self
            real(real64), allocatable, intent(out) :: taps(:, :)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_get_taps

        ! A property, wfpsf_kernel_*.
        module subroutine kernel_get(self, key, value, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(in) :: self
            integer, intent(in) :: key
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_get

        ! The transform at a frequency, cycles per pixel.
        module subroutine kernel_transform(self, frequency_x, frequency_y, value, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(in) :: self
            real(real64), intent(in) :: frequency_x, frequency_y
            complex(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_transform

        ! What apply makes of one unit of charge in the middle. Option: ipc_form.
        module subroutine kernel_self_test(self, response, options, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(in) :: self
            real(real64), allocatable, intent(out) :: response(:, :)
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_self_test

        ! Applies the kernel; edge: wfpsf_edge_*. `to` may be `from`. Options: ipc_form, ipc_fill,
        ! force, threads.
        module subroutine kernel_apply(self, from, edge, to, options, not_finite, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(in) :: self
            type(wfpsf_image), intent(in) :: from
            integer, intent(in) :: edge
            type(wfpsf_image), intent(inout) :: to
            type(wfpsf_options), intent(in), optional :: options
            integer(int64), intent(inout), optional :: not_finite
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_apply

        ! Undoes the kernel exactly; edge: wfpsf_edge_zero, _replicate or _wrap. `to` may be `from`.
        ! Options: ipc_form, ipc_least_margin, ipc_tolerance, ipc_max_passes, force, threads.
        module subroutine kernel_correct(self, from, edge, to, options, residual, noise_amplification, &
                passes, not_finite, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(in) :: self
            type(wfpsf_image), intent(in) :: from
            integer, intent(in) :: edge
            type(wfpsf_image), intent(inout) :: to
            type(wfpsf_options), intent(in), optional :: options
            real(real64), intent(inout), optional :: residual, noise_amplification
            integer(int64), intent(inout), optional :: passes, not_finite
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_correct

        ! Covariance of pixels (lag_x, lag_y) apart, of noise of that variance before the kernel; 0
        ! where there is no such pixel. Options: ipc_form, threads.
        module subroutine kernel_covariance(self, variance, lag_x, lag_y, edge, to, options, stat, errmsg)
            class(wfpsf_ipc_kernel), intent(in) :: self
            type(wfpsf_image), intent(in) :: variance
            integer, intent(in) :: lag_x, lag_y, edge
            type(wfpsf_image), intent(inout) :: to
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine kernel_covariance

        impure elemental module subroutine kernel_finalize(self)
            type(wfpsf_ipc_kernel), intent(inout) :: self
        end subroutine kernel_finalize
    end interface

    ! IPC that varies over a detector.
    private :: varying_ipc_create_maps, varying_ipc_create_polynomials, varying_ipc_create_regions
    private :: varying_ipc_destroy, varying_ipc_get_kernel, varying_ipc_get_margin
    private :: varying_ipc_apply, varying_ipc_correct, varying_ipc_covariance
    private :: varying_ipc_get_autocorrelation, varying_ipc_finalize
    interface
        ! Maps of the parameters of kernels; absent: 0. Option: kernel_negative.
        module subroutine varying_ipc_create_maps(self, alpha, alpha_prime, alpha_plus, options, stat, errmsg)
            class(wfpsf_varying_ipc), intent(inout) :: self
            type(wfpsf_image), intent(in) :: alpha
            type(wfpsf_image), intent(in), optional :: alpha_prime, alpha_plus
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_ipc_create_maps

        ! Polynomials over nx x ny pixels: coefficients of 1, X, Y, X^2, XY, Y^2, ..., X and Y from -1
        ! to 1 between the borders. Option: kernel_negative.
        module subroutine varying_ipc_create_polynomials(self, nx, ny, degree, alpha, alpha_prime, &
                alpha_plus, options, stat, errmsg)
            class(wfpsf_varying_ipc), intent(inout) :: self
            integer, intent(in) :: nx, ny, degree
            real(real64), intent(in), contiguous :: alpha(:)
            real(real64), intent(in), contiguous, optional :: alpha_prime(:), alpha_plus(:)
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_ipc_create_polynomials

        ! One kernel per region: regions holds the number of each pixel's, from 1.
        module subroutine varying_ipc_create_regions(self, regions, kernels, stat, errmsg)
            class(wfpsf_varying_ipc), intent(inout) :: self
            type(wfpsf_image), intent(in) :: regions
            type(wfpsf_ipc_kernel), intent(in) :: kernels(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_ipc_create_regions

        module subroutine varying_ipc_destroy(self)
            class(wfpsf_varying_ipc), intent(inout) :: self
        end subroutine varying_ipc_destroy

        ! The kernel of pixel (x, y), from 1.
        module subroutine varying_ipc_get_kernel(self, x, y, kernel, stat, errmsg)
            class(wfpsf_varying_ipc), intent(in) :: self
            integer, intent(in) :: x, y
            type(wfpsf_ipc_kernel), intent(inout) :: kernel
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_ipc_get_kernel

        ! The least min |K^| of any pixel, and the pixel.
        module subroutine varying_ipc_get_margin(self, margin, x, y, stat, errmsg)
            class(wfpsf_varying_ipc), intent(in) :: self
            real(real64), intent(inout) :: margin
            integer, intent(out), optional :: x, y
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_ipc_get_margin

        ! Applies it; edge: wfpsf_edge_*. `to` may be `from`. Options: ipc_form, ipc_fill, force,
        ! threads.
        module subroutine varying_ipc_apply(self, from, edge, to, options, not_finite, stat, errmsg)
            class(wfpsf_varying_ipc), intent(in) :: self
            type(wfpsf_image), intent(in) :: from
            integer, intent(in) :: edge
            type(wfpsf_image), intent(inout) :: to
            type(wfpsf_options), intent(in), optional :: options
            integer(int64), intent(inout), optional :: not_finite
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_ipc_apply

        ! Undoes it, as a kernel's correct does; noise_amplification is measured if it is asked for.
        module subroutine varying_ipc_correct(self, from, edge, to, options, residual, noise_amplification, &
                passes, not_finite, stat, errmsg)
            class(wfpsf_varying_ipc), intent(in) :: self
            type(wfpsf_image), intent(in) :: from
            integer, intent(in) :: edge
            type(wfpsf_image), intent(inout) :: to
            type(wfpsf_options), intent(in), optional :: options
            real(real64), intent(inout), optional :: residual, noise_amplification
            integer(int64), intent(inout), optional :: passes, not_finite
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_ipc_correct

        ! Covariance of pixels (lag_x, lag_y) apart, of noise of that variance before IPC; 0 where
        ! there is no such pixel. Options: ipc_form, threads.
        module subroutine varying_ipc_covariance(self, variance, lag_x, lag_y, edge, to, options, stat, &
                errmsg)
            class(wfpsf_varying_ipc), intent(in) :: self
            type(wfpsf_image), intent(in) :: variance
            integer, intent(in) :: lag_x, lag_y, edge
            type(wfpsf_image), intent(inout) :: to
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_ipc_covariance

        ! Covariances of the pixel (x, y) with its neighbours, itself in the middle. Without variance:
        ! of white noise of variance 1. Option: ipc_form.
        module subroutine varying_ipc_get_autocorrelation(self, x, y, edge, covariances, variance, &
                options, stat, errmsg)
            class(wfpsf_varying_ipc), intent(in) :: self
            integer, intent(in) :: x, y, edge
            real(real64), allocatable, intent(out) :: covariances(:, :)
            type(wfpsf_image), intent(in), optional :: variance
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine varying_ipc_get_autocorrelation

        impure elemental module subroutine varying_ipc_finalize(self)
            type(wfpsf_varying_ipc), intent(inout) :: self
        end subroutine varying_ipc_finalize
    end interface

    ! Detector chains, noise, the sky.
    private :: chain_create, chain_create_default, chain_destroy, chain_add, chain_add_ipc
    private :: chain_add_varying_ipc
    private :: chain_add_map, chain_get_step, chain_apply, chain_finalize
    private :: instrument_get_sky_level, instrument_get_sky_background
    interface
        ! An empty chain.
        module subroutine chain_create(self, stat, errmsg)
            class(wfpsf_chain), intent(inout) :: self
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine chain_create

        ! The instrument's own, for its own exposure time (s) or another.
        module subroutine chain_create_default(self, instrument, exposure_time, stat, errmsg)
            class(wfpsf_chain), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            real(real64), intent(in), optional :: exposure_time
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine chain_create_default

        module subroutine chain_destroy(self)
            class(wfpsf_chain), intent(inout) :: self
        end subroutine chain_destroy

        ! Adds wfpsf_step_* at the end, with its parameters.
        module subroutine chain_add(self, step, parameters, stat, errmsg)
            class(wfpsf_chain), intent(inout) :: self
            integer, intent(in) :: step
            real(real64), intent(in), contiguous :: parameters(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine chain_add

        ! edge: wfpsf_edge_zero, _replicate, _wrap or _crop.
        module subroutine chain_add_ipc(self, kernel, edge, stat, errmsg)
            class(wfpsf_chain), intent(inout) :: self
            type(wfpsf_ipc_kernel), intent(in) :: kernel
            integer, intent(in) :: edge
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine chain_add_ipc

        ! The same with kernels that vary; form: wfpsf_ipc_scatter or _gather.
        module subroutine chain_add_varying_ipc(self, varying, form, edge, stat, errmsg)
            class(wfpsf_chain), intent(inout) :: self
            type(wfpsf_varying_ipc), intent(in) :: varying
            integer, intent(in) :: form, edge
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine chain_add_varying_ipc

        ! Adds a step with a map, which is copied.
        module subroutine chain_add_map(self, step, parameters, map, stat, errmsg)
            class(wfpsf_chain), intent(inout) :: self
            integer, intent(in) :: step
            real(real64), intent(in), contiguous :: parameters(:)
            type(wfpsf_image), intent(in) :: map
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine chain_add_map

        ! The index-th step, from 1; step is 0 past the last one.
        module subroutine chain_get_step(self, index, step, parameters, stat, errmsg)
            class(wfpsf_chain), intent(in) :: self
            integer, intent(in) :: index
            integer, intent(out) :: step
            real(real64), allocatable, intent(out) :: parameters(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine chain_get_step

        ! Applies the chain in place. previous: exposures before this one, the latest first.
        ! Options: seed, stream, origin_x, origin_y, noise, force, threads.
        module subroutine chain_apply(self, image, previous, options, not_finite, saturated, stat, errmsg)
            class(wfpsf_chain), intent(in) :: self
            type(wfpsf_image), intent(inout) :: image
            type(wfpsf_image), intent(in), optional :: previous(:)
            type(wfpsf_options), intent(in), optional :: options
            integer(int64), intent(inout), optional :: not_finite, saturated
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine chain_apply

        impure elemental module subroutine chain_finalize(self)
            type(wfpsf_chain), intent(inout) :: self
        end subroutine chain_finalize

        ! Adds normal noise, white or through a kernel. Options: seed, stream, origin_x, origin_y,
        ! threads.
        module subroutine wfpsf_add_noise(image, rms, kernel, options, stat, errmsg)
            type(wfpsf_image), intent(inout) :: image
            real(real64), intent(in) :: rms
            type(wfpsf_ipc_kernel), intent(in), optional :: kernel
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine wfpsf_add_noise

        ! Zodiacal light, e-/s/arcsec2; degrees, the longitude from the Sun.
        module subroutine instrument_get_sky_level(self, band, longitude, latitude, level, stat, errmsg)
            class(wfpsf_instrument), intent(in) :: self
            character(len=*), intent(in) :: band
            real(real64), intent(in) :: longitude, latitude
            real(real64), intent(inout) :: level
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine instrument_get_sky_level

        ! Zodiacal, stray and thermal background of a pixel (area in arcsec2) in an exposure (s).
        module subroutine instrument_get_sky_background(self, band, longitude, latitude, exposure_time, &
                pixel_area, electrons, stat, errmsg)
            class(wfpsf_instrument), intent(in) :: self
            character(len=*), intent(in) :: band
            real(real64), intent(in) :: longitude, latitude, exposure_time, pixel_area
            real(real64), intent(inout) :: electrons
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine instrument_get_sky_background
    end interface

    ! Catalogues. The arrays of a call have one size; nothing is added by a call that fails.
    private :: catalogue_create, catalogue_destroy, catalogue_add_colour, catalogue_add_stars
    private :: catalogue_add_galaxies, catalogue_size, catalogue_finalize
    private :: instrument_get_ab_zero_rate
    interface
        ! positions: wfpsf_positions_*: pixels of a detector, or RA and Dec in degrees; brightness:
        ! wfpsf_brightness_*.
        module subroutine catalogue_create(self, positions, brightness, stat, errmsg)
            class(wfpsf_catalogue), intent(inout) :: self
            integer, intent(in) :: positions, brightness
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine catalogue_create

        module subroutine catalogue_destroy(self)
            class(wfpsf_catalogue), intent(inout) :: self
        end subroutine catalogue_destroy

        ! A colour that sources may have: one wavelength, or the light of an SED seen through the
        ! band; neither: the band's effective wavelength. A catalogue without any has that as its
        ! first.
        module subroutine catalogue_add_colour(self, wavelength_nm, sed, colour, stat, errmsg)
            class(wfpsf_catalogue), intent(inout) :: self
            real(real64), intent(in), optional :: wavelength_nm
            type(wfpsf_sed), intent(in), optional :: sed
            integer, intent(out), optional :: colour
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine catalogue_add_colour

        ! colour: the number of each star's; absent: the first.
        module subroutine catalogue_add_stars(self, x, y, brightness, colour, stat, errmsg)
            class(wfpsf_catalogue), intent(inout) :: self
            real(real64), intent(in), contiguous :: x(:), y(:), brightness(:)
            integer, intent(in), optional :: colour(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine catalogue_add_stars

        ! Sersic profiles. e1 and e2: (a - b) / (a + b) times cosine and sine of twice the angle of
        ! the major axis from x towards y; absent: 0.
        module subroutine catalogue_add_galaxies(self, x, y, brightness, sersic_index, &
            half_light_radius_arcsec, e1, e2, colour, stat, errmsg)
            class(wfpsf_catalogue), intent(inout) :: self
            real(real64), intent(in), contiguous :: x(:), y(:), brightness(:), sersic_index(:), &
                half_light_radius_arcsec(:)
            real(real64), intent(in), optional :: e1(:), e2(:)
            integer, intent(in), optional :: colour(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine catalogue_add_galaxies

        ! How many sources there are.
        module subroutine catalogue_size(self, count, stat, errmsg)
            class(wfpsf_catalogue), intent(in) :: self
            integer(int64), intent(inout) :: count
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine catalogue_size

        impure elemental module subroutine catalogue_finalize(self)
            type(wfpsf_catalogue), intent(inout) :: self
        end subroutine catalogue_finalize

        ! Electrons a second that a source of AB magnitude 0 gives in a band, e-/s.
        module subroutine instrument_get_ab_zero_rate(self, band, rate, stat, errmsg)
            class(wfpsf_instrument), intent(in) :: self
            character(len=*), intent(in) :: band
            real(real64), intent(inout) :: rate
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine instrument_get_ab_zero_rate
    end interface

    ! Scenes. Their groups count from 1.
    private :: scene_create, scene_destroy, scene_get, scene_get_group, scene_groups_of, scene_text
    private :: scene_render, scene_truth, scene_finalize
    private :: rendering_destroy, rendering_get, rendering_finalize
    private :: scene_store_create, scene_store_destroy, scene_store_memory, scene_store_write
    private :: scene_store_read, scene_store_finalize
    interface
        module subroutine scene_store_create(self, stat, errmsg)
            class(wfpsf_scene_store), intent(inout) :: self
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_store_create

        ! Options and scenes that share it keep it.
        module subroutine scene_store_destroy(self)
            class(wfpsf_scene_store), intent(inout) :: self
        end subroutine scene_store_destroy

        ! Bytes that it holds, about.
        module subroutine scene_store_memory(self, bytes, stat, errmsg)
            class(wfpsf_scene_store), intent(in) :: self
            integer(int64), intent(inout) :: bytes
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_store_memory

        ! What it holds to a file, for other processes: in place of one that is there, and for this
        ! version of the library on machines of this kind alone.
        module subroutine scene_store_write(self, path, stat, errmsg)
            class(wfpsf_scene_store), intent(in) :: self
            character(len=*), intent(in) :: path
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_store_write

        ! Adds what such a file holds.
        module subroutine scene_store_read(self, path, stat, errmsg)
            class(wfpsf_scene_store), intent(in) :: self
            character(len=*), intent(in) :: path
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_store_read

        impure elemental module subroutine scene_store_finalize(self)
            type(wfpsf_scene_store), intent(inout) :: self
        end subroutine scene_store_finalize

        ! Plans a scene for images of the size and oversampling of this one; the centre of its first
        ! native pixel stands at (x0, y0) of the detector. observation: for positions on the sky.
        ! Options: scene_*, exposure_time, and those of the PSF but eps and psf_radius.
        module subroutine scene_create(self, instrument, band, sca, catalogue, image, x0, y0, &
            observation, options, stat, errmsg)
            class(wfpsf_scene), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            character(len=*), intent(in) :: band
            integer, intent(in) :: sca
            type(wfpsf_catalogue), intent(in) :: catalogue
            type(wfpsf_image), intent(in) :: image
            real(real64), intent(in) :: x0, y0
            type(wfpsf_observation), intent(in), optional :: observation
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_create

        module subroutine scene_destroy(self)
            class(wfpsf_scene), intent(inout) :: self
        end subroutine scene_destroy

        ! key: wfpsf_scene_*.
        module subroutine scene_get(self, key, value, stat, errmsg)
            class(wfpsf_scene), intent(in) :: self
            integer, intent(in) :: key
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_get

        ! key: wfpsf_scene_group_*.
        module subroutine scene_get_group(self, group, key, value, stat, errmsg)
            class(wfpsf_scene), intent(in) :: self
            integer, intent(in) :: group, key
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_get_group

        ! The group of each source of the catalogue; 0: it has no place.
        module subroutine scene_groups_of(self, group, stat, errmsg)
            class(wfpsf_scene), intent(in) :: self
            integer(c_int32_t), intent(inout), contiguous :: group(:)
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_groups_of

        ! The plan, a line a group.
        module subroutine scene_text(self, text, stat, errmsg)
            class(wfpsf_scene), intent(in) :: self
            character(len=:), allocatable, intent(out) :: text
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_text

        ! Adds all sources to the image, electrons. Options: threads, memory_limit, force, the
        ! progress function.
        module subroutine scene_render(self, image, rendering, options, stat, errmsg)
            class(wfpsf_scene), intent(in) :: self
            type(wfpsf_image), intent(inout) :: image
            type(wfpsf_rendering), intent(inout), optional :: rendering
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_render

        ! What is true of some sources, by their numbers in the catalogue; absent: of the first n.
        ! values(0:wfpsf_truth_columns - 1, n): its rows are wfpsf_truth_*. Without a kernel those
        ! of IPC are NaN. Options: eps, moments_tolerance, threads.
        module subroutine scene_truth(self, values, sources, kernel, options, stat, errmsg)
            class(wfpsf_scene), intent(in) :: self
            real(real64), intent(inout), contiguous :: values(0:, :)
            integer(int64), intent(in), optional :: sources(:)
            type(wfpsf_ipc_kernel), intent(in), optional :: kernel
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine scene_truth

        impure elemental module subroutine scene_finalize(self)
            type(wfpsf_scene), intent(inout) :: self
        end subroutine scene_finalize

        module subroutine rendering_destroy(self)
            class(wfpsf_rendering), intent(inout) :: self
        end subroutine rendering_destroy

        ! key: wfpsf_rendering_*.
        module subroutine rendering_get(self, key, value, stat, errmsg)
            class(wfpsf_rendering), intent(in) :: self
            integer, intent(in) :: key
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine rendering_get

        impure elemental module subroutine rendering_finalize(self)
            type(wfpsf_rendering), intent(inout) :: self
        end subroutine rendering_finalize
    end interface

    ! Exposures.
    private :: exposure_create, exposure_destroy, exposure_path, exposure_make, exposure_finalize
    interface
        ! chain: what the detectors do, after the option scene_background is added; absent: nothing.
        ! Options: those of scenes; seed, stream (the exposure's number), noise.
        module subroutine exposure_create(self, instrument, observation, band, catalogue, chain, &
            options, stat, errmsg)
            class(wfpsf_exposure), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            type(wfpsf_observation), intent(in) :: observation
            character(len=*), intent(in) :: band
            type(wfpsf_catalogue), intent(in) :: catalogue
            type(wfpsf_chain), intent(in), optional :: chain
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine exposure_create

        module subroutine exposure_destroy(self)
            class(wfpsf_exposure), intent(inout) :: self
        end subroutine exposure_destroy

        ! The path of a detector's file.
        module subroutine exposure_path(self, folder, sca, path, stat, errmsg)
            class(wfpsf_exposure), intent(in) :: self
            character(len=*), intent(in) :: folder
            integer, intent(in) :: sca
            character(len=:), allocatable, intent(out) :: path
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine exposure_path

        ! Makes a detector's file. made: false: it was there, made of the same. Options:
        ! fits_overwrite, threads, memory_limit, the progress function.
        module subroutine exposure_make(self, sca, folder, made, options, stat, errmsg)
            class(wfpsf_exposure), intent(in) :: self
            integer, intent(in) :: sca
            character(len=*), intent(in) :: folder
            logical, intent(out), optional :: made
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine exposure_make

        impure elemental module subroutine exposure_finalize(self)
            type(wfpsf_exposure), intent(inout) :: self
        end subroutine exposure_finalize
    end interface

    ! Moments.
    private :: moments_measure, moments_measure_unweighted, moments_destroy, moments_status
    private :: moments_get, moments_finalize, moments_measure_masked, moments_measure_weighted
    private :: moments_differentiate, moments_influence, moments_covariance
    interface
        ! The best-fit elliptical Gaussian. A measurement that fails leaves its last iterate here.
        ! Options: moments_*.
        module subroutine moments_measure(self, image, options, stat, errmsg)
            class(wfpsf_moments), intent(inout) :: self
            type(wfpsf_image), intent(in) :: image
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine moments_measure

        ! The same; missing is not 0 where a pixel is missing, variance that of each pixel's noise.
        module subroutine moments_measure_masked(self, image, missing, variance, options, stat, &
            errmsg)
            class(wfpsf_moments), intent(inout) :: self
            type(wfpsf_image), intent(in) :: image
            type(wfpsf_image), intent(in), optional :: missing, variance
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine moments_measure_masked

        ! Under a Gaussian weight about (x, y) that stays as it is.
        module subroutine moments_measure_weighted(self, image, x, y, mxx, mxy, myy, stat, errmsg)
            class(wfpsf_moments), intent(inout) :: self
            type(wfpsf_image), intent(in) :: image
            real(real64), intent(in) :: x, y, mxx, mxy, myy
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine moments_measure_weighted

        ! Becomes the derivatives of moments, measured on image, by a change of it; with second, the
        ! mixed second ones.
        module subroutine moments_differentiate(self, moments, image, change, second, stat, errmsg)
            class(wfpsf_moments), intent(inout) :: self
            type(wfpsf_moments), intent(in) :: moments
            type(wfpsf_image), intent(in) :: image, change
            type(wfpsf_image), intent(in), optional :: second
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine moments_differentiate

        ! The derivative of one number by every pixel of the image that was measured.
        module subroutine moments_influence(self, image, key, influence, stat, errmsg)
            class(wfpsf_moments), intent(in) :: self
            type(wfpsf_image), intent(in) :: image
            integer, intent(in) :: key
            type(wfpsf_image), intent(inout) :: influence
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine moments_influence

        ! Covariance of two numbers, if a variance was given.
        module subroutine moments_covariance(self, key_a, key_b, value, stat, errmsg)
            class(wfpsf_moments), intent(in) :: self
            integer, intent(in) :: key_a, key_b
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine moments_covariance

        ! Over the whole image about the point (x, y); both absent: the centroid.
        module subroutine moments_measure_unweighted(self, image, x, y, stat, errmsg)
            class(wfpsf_moments), intent(inout) :: self
            type(wfpsf_image), intent(in) :: image
            real(real64), intent(in), optional :: x, y
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine moments_measure_unweighted

        module subroutine moments_destroy(self)
            class(wfpsf_moments), intent(inout) :: self
        end subroutine moments_destroy

        ! The status with which the measurement ended.
        module function moments_status(self) result(status)
            class(wfpsf_moments), intent(in) :: self
            integer :: status
        end function moments_status

        ! key: wfpsf_moments_*.
        module subroutine moments_get(self, key, value, stat, errmsg)
            class(wfpsf_moments), intent(in) :: self
            integer, intent(in) :: key
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine moments_get

        impure elemental module subroutine moments_finalize(self)
            type(wfpsf_moments), intent(inout) :: self
        end subroutine moments_finalize
    end interface

    private :: study_create, study_destroy, study_size, study_column, study_value, study_text
    private :: study_write_csv, study_finalize

    interface
        module subroutine study_create(self, instrument, sca, options, stat, errmsg)
            class(wfpsf_study), intent(inout) :: self
            type(wfpsf_instrument), intent(in) :: instrument
            integer, intent(in) :: sca
            type(wfpsf_options), intent(in), optional :: options
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine study_create

        module subroutine study_destroy(self)
            class(wfpsf_study), intent(inout) :: self
        end subroutine study_destroy

        ! table: wfpsf_study_*, here and below.
        module subroutine study_size(self, table, rows, columns, stat, errmsg)
            class(wfpsf_study), intent(in) :: self
            integer, intent(in) :: table
            integer(int64), intent(inout), optional :: rows, columns
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine study_size

        ! The name of a column, from 1; empty past the last one.
        module function study_column(self, table, column) result(name)
            class(wfpsf_study), intent(in) :: self
            integer, intent(in) :: table
            integer(int64), intent(in) :: column
            character(len=:), allocatable :: name
        end function study_column

        ! Row and column from 1. NaN where nothing is known, or where words stand.
        module subroutine study_value(self, table, row, column, value, stat, errmsg)
            class(wfpsf_study), intent(in) :: self
            integer, intent(in) :: table
            integer(int64), intent(in) :: row, column
            real(real64), intent(inout) :: value
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine study_value

        ! The words in a place; empty where a number stands, or past the end.
        module function study_text(self, table, row, column) result(words)
            class(wfpsf_study), intent(in) :: self
            integer, intent(in) :: table
            integer(int64), intent(in) :: row, column
            character(len=:), allocatable :: words
        end function study_text

        ! Every table as CSV into a folder that exists.
        module subroutine study_write_csv(self, folder, stat, errmsg)
            class(wfpsf_study), intent(in) :: self
            character(len=*), intent(in) :: folder
            integer, intent(out), optional :: stat
            character(len=*), intent(inout), optional :: errmsg
        end subroutine study_write_csv

        impure elemental module subroutine study_finalize(self)
            type(wfpsf_study), intent(inout) :: self
        end subroutine study_finalize
    end interface

end module wfpsf
