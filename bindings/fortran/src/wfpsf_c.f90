! SPDX-License-Identifier: GPL-3.0-or-later
! Made by bindings/generate.py from the headers in capi/include/wfpsf: change those.
!
! The C interface as it stands, described in the C headers. The module wfpsf is the comfortable way.

! Every constant.
module wfpsf_constants
    use, intrinsic :: iso_c_binding, only: c_int32_t
    implicit none
    private :: c_int32_t

    ! version.h
    integer(c_int32_t), parameter :: wfpsf_version_major = 1
    integer(c_int32_t), parameter :: wfpsf_version_minor = 0
    integer(c_int32_t), parameter :: wfpsf_version_patch = 0
    integer(c_int32_t), parameter :: wfpsf_headers_abi_number = 1

    ! status.h
    integer(c_int32_t), parameter :: wfpsf_ok = 0
    integer(c_int32_t), parameter :: wfpsf_warning_not_converged = 100
    integer(c_int32_t), parameter :: wfpsf_warning_not_certified = 110
    integer(c_int32_t), parameter :: wfpsf_warning_restarted = 120
    integer(c_int32_t), parameter :: wfpsf_warning_near_degenerate = 130
    integer(c_int32_t), parameter :: wfpsf_warning_undersampled = 140
    integer(c_int32_t), parameter :: wfpsf_error_null = -10
    integer(c_int32_t), parameter :: wfpsf_error_argument = -20
    integer(c_int32_t), parameter :: wfpsf_error_range = -30
    integer(c_int32_t), parameter :: wfpsf_error_size = -40
    integer(c_int32_t), parameter :: wfpsf_error_type = -50
    integer(c_int32_t), parameter :: wfpsf_error_not_finite = -60
    integer(c_int32_t), parameter :: wfpsf_error_unknown_name = -70
    integer(c_int32_t), parameter :: wfpsf_error_overlap = -80
    integer(c_int32_t), parameter :: wfpsf_error_already_applied = -90
    integer(c_int32_t), parameter :: wfpsf_error_kernel = -100
    integer(c_int32_t), parameter :: wfpsf_error_kernel_singular = -110
    integer(c_int32_t), parameter :: wfpsf_error_sky_sun = -120
    integer(c_int32_t), parameter :: wfpsf_error_sun_angle = -130
    integer(c_int32_t), parameter :: wfpsf_error_no_wcs = -140
    integer(c_int32_t), parameter :: wfpsf_error_file_open = -200
    integer(c_int32_t), parameter :: wfpsf_error_file_format = -210
    integer(c_int32_t), parameter :: wfpsf_error_file_write = -220
    integer(c_int32_t), parameter :: wfpsf_error_moments_no_pixels = -300
    integer(c_int32_t), parameter :: wfpsf_error_moments_flux = -310
    integer(c_int32_t), parameter :: wfpsf_error_moments_unresolved = -320
    integer(c_int32_t), parameter :: wfpsf_error_moments_fills_image = -330
    integer(c_int32_t), parameter :: wfpsf_error_moments_outside = -340
    integer(c_int32_t), parameter :: wfpsf_error_moments_stalled = -350
    integer(c_int32_t), parameter :: wfpsf_error_size_not_reached = -400
    integer(c_int32_t), parameter :: wfpsf_error_cancelled = -500
    integer(c_int32_t), parameter :: wfpsf_error_memory_limit = -510
    integer(c_int32_t), parameter :: wfpsf_error_no_memory = -900
    integer(c_int32_t), parameter :: wfpsf_error_internal = -910
    integer(c_int32_t), parameter :: wfpsf_error_abi = -920

    ! options.h
    integer(c_int32_t), parameter :: wfpsf_option_eps = 100
    integer(c_int32_t), parameter :: wfpsf_option_struts = 110
    integer(c_int32_t), parameter :: wfpsf_option_psf_radius = 120
    integer(c_int32_t), parameter :: wfpsf_option_piston_tilt = 130
    integer(c_int32_t), parameter :: wfpsf_option_frame = 140
    integer(c_int32_t), parameter :: wfpsf_option_field_rule = 150
    integer(c_int32_t), parameter :: wfpsf_option_jitter_xx = 160
    integer(c_int32_t), parameter :: wfpsf_option_jitter_xy = 161
    integer(c_int32_t), parameter :: wfpsf_option_jitter_yy = 162
    integer(c_int32_t), parameter :: wfpsf_option_charge_diffusion = 170
    integer(c_int32_t), parameter :: wfpsf_option_mask_points = 180
    integer(c_int32_t), parameter :: wfpsf_option_pixel_response = 190
    integer(c_int32_t), parameter :: wfpsf_option_force = 200
    integer(c_int32_t), parameter :: wfpsf_option_ipc_fill = 210
    integer(c_int32_t), parameter :: wfpsf_option_kernel_negative = 220
    integer(c_int32_t), parameter :: wfpsf_option_kernel_normalise = 230
    integer(c_int32_t), parameter :: wfpsf_option_ipc_form = 240
    integer(c_int32_t), parameter :: wfpsf_option_ipc_least_margin = 250
    integer(c_int32_t), parameter :: wfpsf_option_ipc_tolerance = 260
    integer(c_int32_t), parameter :: wfpsf_option_ipc_max_passes = 270
    integer(c_int32_t), parameter :: wfpsf_option_moments_tolerance = 300
    integer(c_int32_t), parameter :: wfpsf_option_moments_max_passes = 310
    integer(c_int32_t), parameter :: wfpsf_option_moments_guess_x = 320
    integer(c_int32_t), parameter :: wfpsf_option_moments_guess_y = 330
    integer(c_int32_t), parameter :: wfpsf_option_moments_guess_sigma = 340
    integer(c_int32_t), parameter :: wfpsf_option_moments_method = 350
    integer(c_int32_t), parameter :: wfpsf_option_moments_background = 360
    integer(c_int32_t), parameter :: wfpsf_option_moments_variance = 370
    integer(c_int32_t), parameter :: wfpsf_option_moments_restart = 380
    integer(c_int32_t), parameter :: wfpsf_option_moments_covariance_order = 390
    integer(c_int32_t), parameter :: wfpsf_option_size_total_flux = 400
    integer(c_int32_t), parameter :: wfpsf_option_size_bandwidth = 410
    integer(c_int32_t), parameter :: wfpsf_option_size_eps = 420
    integer(c_int32_t), parameter :: wfpsf_option_fits_overwrite = 500
    integer(c_int32_t), parameter :: wfpsf_option_threads = 600
    integer(c_int32_t), parameter :: wfpsf_option_memory_limit = 610
    integer(c_int32_t), parameter :: wfpsf_option_seed = 700
    integer(c_int32_t), parameter :: wfpsf_option_stream = 710
    integer(c_int32_t), parameter :: wfpsf_option_origin_x = 720
    integer(c_int32_t), parameter :: wfpsf_option_origin_y = 730
    integer(c_int32_t), parameter :: wfpsf_option_noise = 740
    integer(c_int32_t), parameter :: wfpsf_option_wcs_rule = 800
    integer(c_int32_t), parameter :: wfpsf_option_pa_of_fpa = 810
    integer(c_int32_t), parameter :: wfpsf_option_scene_noise = 900
    integer(c_int32_t), parameter :: wfpsf_option_scene_variance = 910
    integer(c_int32_t), parameter :: wfpsf_option_scene_flux = 920
    integer(c_int32_t), parameter :: wfpsf_option_scene_background = 930
    integer(c_int32_t), parameter :: wfpsf_option_exposure_time = 940
    integer(c_int32_t), parameter :: wfpsf_option_scene_exposures = 950
    integer(c_int32_t), parameter :: wfpsf_option_real = 1
    integer(c_int32_t), parameter :: wfpsf_option_integer = 2

    ! image.h
    integer(c_int32_t), parameter :: wfpsf_float32 = 32
    integer(c_int32_t), parameter :: wfpsf_float64 = 64
    integer(c_int32_t), parameter :: wfpsf_effect_pixel_response = 1
    integer(c_int32_t), parameter :: wfpsf_effect_ipc = 2
    integer(c_int32_t), parameter :: wfpsf_effect_ipc_correction = 4
    integer(c_int32_t), parameter :: wfpsf_effect_charge_diffusion = 8
    integer(c_int32_t), parameter :: wfpsf_effect_background = 16
    integer(c_int32_t), parameter :: wfpsf_effect_poisson_noise = 32
    integer(c_int32_t), parameter :: wfpsf_effect_reciprocity_failure = 64
    integer(c_int32_t), parameter :: wfpsf_effect_dark_current = 128
    integer(c_int32_t), parameter :: wfpsf_effect_persistence = 256
    integer(c_int32_t), parameter :: wfpsf_effect_nonlinearity = 512
    integer(c_int32_t), parameter :: wfpsf_effect_nonlinearity_correction = 1024
    integer(c_int32_t), parameter :: wfpsf_effect_capacitance = 2048
    integer(c_int32_t), parameter :: wfpsf_effect_read_noise = 4096
    integer(c_int32_t), parameter :: wfpsf_effect_gain = 8192
    integer(c_int32_t), parameter :: wfpsf_dither_detector = 1
    integer(c_int32_t), parameter :: wfpsf_dither_object = 2

    ! instrument.h
    integer(c_int32_t), parameter :: wfpsf_band_tabulated = 1
    integer(c_int32_t), parameter :: wfpsf_band_paper = 2

    ! sed.h
    integer(c_int32_t), parameter :: wfpsf_sed_photons = 1
    integer(c_int32_t), parameter :: wfpsf_sed_energy = 2

    ! psf.h
    integer(c_int32_t), parameter :: wfpsf_psf_wavelength_nm = 10
    integer(c_int32_t), parameter :: wfpsf_psf_pixel_scale_arcsec = 20
    integer(c_int32_t), parameter :: wfpsf_psf_error_estimate = 30
    integer(c_int32_t), parameter :: wfpsf_psf_model_error = 40
    integer(c_int32_t), parameter :: wfpsf_psf_peak = 50
    integer(c_int32_t), parameter :: wfpsf_psf_nodes = 60
    integer(c_int32_t), parameter :: wfpsf_psf_grid_size = 70
    integer(c_int32_t), parameter :: wfpsf_psf_grid_step_arcsec = 80
    integer(c_int32_t), parameter :: wfpsf_psf_radius = 90
    integer(c_int32_t), parameter :: wfpsf_psf_lit_area_m2 = 100
    integer(c_int32_t), parameter :: wfpsf_psf_wavelengths = 110

    ! varying_psf.h
    integer(c_int32_t), parameter :: wfpsf_varying_psf_error_estimate = 10
    integer(c_int32_t), parameter :: wfpsf_varying_psf_interpolation_error = 20
    integer(c_int32_t), parameter :: wfpsf_varying_psf_degree = 30
    integer(c_int32_t), parameter :: wfpsf_varying_psf_rank = 40
    integer(c_int32_t), parameter :: wfpsf_varying_psf_exact_psfs = 50
    integer(c_int32_t), parameter :: wfpsf_varying_psf_memory_bytes = 60
    integer(c_int32_t), parameter :: wfpsf_varying_psf_margin = 70

    ! otf.h
    integer(c_int32_t), parameter :: wfpsf_otf_error_estimate = 10
    integer(c_int32_t), parameter :: wfpsf_otf_value_error = 20
    integer(c_int32_t), parameter :: wfpsf_otf_cutoff = 30
    integer(c_int32_t), parameter :: wfpsf_otf_pixels = 40
    integer(c_int32_t), parameter :: wfpsf_response_diffraction = 1
    integer(c_int32_t), parameter :: wfpsf_response_effective = 2
    integer(c_int32_t), parameter :: wfpsf_order_centred = 1
    integer(c_int32_t), parameter :: wfpsf_order_wrapped = 2
    integer(c_int32_t), parameter :: wfpsf_order_half = 3

    ! ipc.h
    integer(c_int32_t), parameter :: wfpsf_kernel_sum = 10
    integer(c_int32_t), parameter :: wfpsf_kernel_centroid_x = 20
    integer(c_int32_t), parameter :: wfpsf_kernel_centroid_y = 30
    integer(c_int32_t), parameter :: wfpsf_kernel_mxx = 40
    integer(c_int32_t), parameter :: wfpsf_kernel_mxy = 50
    integer(c_int32_t), parameter :: wfpsf_kernel_myy = 60
    integer(c_int32_t), parameter :: wfpsf_kernel_left_right = 100
    integer(c_int32_t), parameter :: wfpsf_kernel_up_down = 110
    integer(c_int32_t), parameter :: wfpsf_kernel_half_turn = 120
    integer(c_int32_t), parameter :: wfpsf_kernel_transposed = 130
    integer(c_int32_t), parameter :: wfpsf_kernel_margin = 200
    integer(c_int32_t), parameter :: wfpsf_kernel_margin_frequency_x = 210
    integer(c_int32_t), parameter :: wfpsf_kernel_margin_frequency_y = 220
    integer(c_int32_t), parameter :: wfpsf_kernel_variance_ratio = 300
    integer(c_int32_t), parameter :: wfpsf_kernel_conversion_gain_bias = 310
    integer(c_int32_t), parameter :: wfpsf_kernel_quantum_efficiency_bias = 320
    integer(c_int32_t), parameter :: wfpsf_kernel_inverse_noise = 330
    integer(c_int32_t), parameter :: wfpsf_ipc_scatter = 0
    integer(c_int32_t), parameter :: wfpsf_ipc_gather = 1
    integer(c_int32_t), parameter :: wfpsf_edge_zero = 0
    integer(c_int32_t), parameter :: wfpsf_edge_replicate = 1
    integer(c_int32_t), parameter :: wfpsf_edge_wrap = 2
    integer(c_int32_t), parameter :: wfpsf_edge_crop = 3
    integer(c_int32_t), parameter :: wfpsf_edge_fill = 4
    integer(c_int32_t), parameter :: wfpsf_edge_valid = 5

    ! chain.h
    integer(c_int32_t), parameter :: wfpsf_step_clip_negative = 10
    integer(c_int32_t), parameter :: wfpsf_step_charge_diffusion = 20
    integer(c_int32_t), parameter :: wfpsf_step_background = 30
    integer(c_int32_t), parameter :: wfpsf_step_poisson_noise = 40
    integer(c_int32_t), parameter :: wfpsf_step_quantisation = 50
    integer(c_int32_t), parameter :: wfpsf_step_reciprocity_failure = 60
    integer(c_int32_t), parameter :: wfpsf_step_dark_current = 70
    integer(c_int32_t), parameter :: wfpsf_step_dark_current_map = 71
    integer(c_int32_t), parameter :: wfpsf_step_persistence_linear = 80
    integer(c_int32_t), parameter :: wfpsf_step_persistence_fermi = 81
    integer(c_int32_t), parameter :: wfpsf_step_nonlinearity = 90
    integer(c_int32_t), parameter :: wfpsf_step_nonlinearity_inverse = 100
    integer(c_int32_t), parameter :: wfpsf_step_capacitance_map = 110
    integer(c_int32_t), parameter :: wfpsf_step_ipc = 120
    integer(c_int32_t), parameter :: wfpsf_step_read_noise = 130
    integer(c_int32_t), parameter :: wfpsf_step_saturation = 140
    integer(c_int32_t), parameter :: wfpsf_step_gain = 150
    integer(c_int32_t), parameter :: wfpsf_step_pixel_mask = 160

    ! observation.h
    integer(c_int32_t), parameter :: wfpsf_observation_ra = 10
    integer(c_int32_t), parameter :: wfpsf_observation_dec = 20
    integer(c_int32_t), parameter :: wfpsf_observation_pa = 30
    integer(c_int32_t), parameter :: wfpsf_observation_pa_fpa = 40
    integer(c_int32_t), parameter :: wfpsf_observation_crpix1 = 100
    integer(c_int32_t), parameter :: wfpsf_observation_crpix2 = 110
    integer(c_int32_t), parameter :: wfpsf_observation_crval1 = 120
    integer(c_int32_t), parameter :: wfpsf_observation_crval2 = 130
    integer(c_int32_t), parameter :: wfpsf_observation_cd1_1 = 140
    integer(c_int32_t), parameter :: wfpsf_observation_cd1_2 = 150
    integer(c_int32_t), parameter :: wfpsf_observation_cd2_1 = 160
    integer(c_int32_t), parameter :: wfpsf_observation_cd2_2 = 170
    integer(c_int32_t), parameter :: wfpsf_observation_orientat = 180

    ! moments.h
    integer(c_int32_t), parameter :: wfpsf_moments_centroid_x = 10
    integer(c_int32_t), parameter :: wfpsf_moments_centroid_y = 20
    integer(c_int32_t), parameter :: wfpsf_moments_mxx = 30
    integer(c_int32_t), parameter :: wfpsf_moments_mxy = 40
    integer(c_int32_t), parameter :: wfpsf_moments_myy = 50
    integer(c_int32_t), parameter :: wfpsf_moments_sigma = 60
    integer(c_int32_t), parameter :: wfpsf_moments_sigma_trace = 70
    integer(c_int32_t), parameter :: wfpsf_moments_e1 = 80
    integer(c_int32_t), parameter :: wfpsf_moments_e2 = 90
    integer(c_int32_t), parameter :: wfpsf_moments_e = 100
    integer(c_int32_t), parameter :: wfpsf_moments_beta = 110
    integer(c_int32_t), parameter :: wfpsf_moments_flux = 120
    integer(c_int32_t), parameter :: wfpsf_moments_rho4 = 130
    integer(c_int32_t), parameter :: wfpsf_moments_passes = 140
    integer(c_int32_t), parameter :: wfpsf_moments_error_estimate = 150
    integer(c_int32_t), parameter :: wfpsf_moments_residual = 160
    integer(c_int32_t), parameter :: wfpsf_moments_curvature = 170
    integer(c_int32_t), parameter :: wfpsf_moments_edge_fraction = 180
    integer(c_int32_t), parameter :: wfpsf_moments_missing_fraction = 190
    integer(c_int32_t), parameter :: wfpsf_moments_amplitude = 200
    integer(c_int32_t), parameter :: wfpsf_moments_last_step = 210
    integer(c_int32_t), parameter :: wfpsf_moments_pixels = 220
    integer(c_int32_t), parameter :: wfpsf_moments_background = 230

    ! size.h
    integer(c_int32_t), parameter :: wfpsf_size_bandlimited = 1
    integer(c_int32_t), parameter :: wfpsf_size_pixel_sum = 2
    integer(c_int32_t), parameter :: wfpsf_size_pixel_interpolated = 3

    ! study.h
    integer(c_int32_t), parameter :: wfpsf_study_bands = 10
    integer(c_int32_t), parameter :: wfpsf_study_sizes = 20
    integer(c_int32_t), parameter :: wfpsf_study_sensitivities = 30
    integer(c_int32_t), parameter :: wfpsf_study_linear_law = 40
    integer(c_int32_t), parameter :: wfpsf_study_figure_3 = 103
    integer(c_int32_t), parameter :: wfpsf_study_figure_4 = 104
    integer(c_int32_t), parameter :: wfpsf_study_figure_5 = 105
    integer(c_int32_t), parameter :: wfpsf_study_figure_6 = 106
    integer(c_int32_t), parameter :: wfpsf_study_figure_7 = 107
    integer(c_int32_t), parameter :: wfpsf_study_figure_8 = 108
    integer(c_int32_t), parameter :: wfpsf_study_figure_9 = 109
    integer(c_int32_t), parameter :: wfpsf_study_figure_10 = 110
    integer(c_int32_t), parameter :: wfpsf_study_figure_11 = 111
    integer(c_int32_t), parameter :: wfpsf_study_requirements = 200
    integer(c_int32_t), parameter :: wfpsf_study_comparison = 210
    integer(c_int32_t), parameter :: wfpsf_study_convergence = 220

    ! catalogue.h
    integer(c_int32_t), parameter :: wfpsf_positions_detector = 1
    integer(c_int32_t), parameter :: wfpsf_positions_sky = 2
    integer(c_int32_t), parameter :: wfpsf_brightness_electrons = 1
    integer(c_int32_t), parameter :: wfpsf_brightness_ab_magnitude = 2

    ! scene.h
    integer(c_int32_t), parameter :: wfpsf_scene_sources = 10
    integer(c_int32_t), parameter :: wfpsf_scene_groups = 20
    integer(c_int32_t), parameter :: wfpsf_scene_error_allowed = 30
    integer(c_int32_t), parameter :: wfpsf_scene_error_expected = 40
    integer(c_int32_t), parameter :: wfpsf_scene_time_expected = 50
    integer(c_int32_t), parameter :: wfpsf_scene_memory_expected = 60
    integer(c_int32_t), parameter :: wfpsf_scene_group_colour = 10
    integer(c_int32_t), parameter :: wfpsf_scene_group_kind = 20
    integer(c_int32_t), parameter :: wfpsf_scene_group_flux_from = 30
    integer(c_int32_t), parameter :: wfpsf_scene_group_sources = 40
    integer(c_int32_t), parameter :: wfpsf_scene_group_drawing = 50
    integer(c_int32_t), parameter :: wfpsf_scene_group_radius = 60
    integer(c_int32_t), parameter :: wfpsf_scene_group_eps = 70
    integer(c_int32_t), parameter :: wfpsf_scene_group_far_floor = 75
    integer(c_int32_t), parameter :: wfpsf_scene_group_error_expected = 80
    integer(c_int32_t), parameter :: wfpsf_scene_group_time_expected = 90
    integer(c_int32_t), parameter :: wfpsf_rendering_time = 10
    integer(c_int32_t), parameter :: wfpsf_rendering_time_models = 20
    integer(c_int32_t), parameter :: wfpsf_rendering_time_shared = 30
    integer(c_int32_t), parameter :: wfpsf_rendering_time_own = 40
    integer(c_int32_t), parameter :: wfpsf_rendering_time_galaxies = 45
    integer(c_int32_t), parameter :: wfpsf_rendering_drawn = 50
    integer(c_int32_t), parameter :: wfpsf_rendering_exact_psfs = 60
    integer(c_int32_t), parameter :: wfpsf_rendering_error_estimate = 70
    integer(c_int32_t), parameter :: wfpsf_truth_group = 0
    integer(c_int32_t), parameter :: wfpsf_truth_position_x = 1
    integer(c_int32_t), parameter :: wfpsf_truth_position_y = 2
    integer(c_int32_t), parameter :: wfpsf_truth_flux = 3
    integer(c_int32_t), parameter :: wfpsf_truth_flux_in_stamp = 4
    integer(c_int32_t), parameter :: wfpsf_truth_status = 5
    integer(c_int32_t), parameter :: wfpsf_truth_centroid_x = 6
    integer(c_int32_t), parameter :: wfpsf_truth_centroid_y = 7
    integer(c_int32_t), parameter :: wfpsf_truth_sigma = 8
    integer(c_int32_t), parameter :: wfpsf_truth_e1 = 9
    integer(c_int32_t), parameter :: wfpsf_truth_e2 = 10
    integer(c_int32_t), parameter :: wfpsf_truth_ipc_centroid_x = 11
    integer(c_int32_t), parameter :: wfpsf_truth_ipc_centroid_y = 12
    integer(c_int32_t), parameter :: wfpsf_truth_ipc_sigma = 13
    integer(c_int32_t), parameter :: wfpsf_truth_ipc_e1 = 14
    integer(c_int32_t), parameter :: wfpsf_truth_ipc_e2 = 15
    integer(c_int32_t), parameter :: wfpsf_kind_star = 1
    integer(c_int32_t), parameter :: wfpsf_kind_galaxy = 2
    integer(c_int32_t), parameter :: wfpsf_drawing_shared = 1
    integer(c_int32_t), parameter :: wfpsf_drawing_own = 2
    integer(c_int32_t), parameter :: wfpsf_drawing_fourier = 3
    integer(c_int32_t), parameter :: wfpsf_drawing_fourier_own = 4
    integer(c_int32_t), parameter :: wfpsf_truth_columns = 16

end module wfpsf_constants

! Every function. Positions count from (0, 0) here. Handles are values of type(c_ptr), text ends
! with c_null_char. An optional argument that is absent is a NULL. Outputs are intent(inout) because
! an error leaves them alone.
module wfpsf_c
    use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr
    use wfpsf_constants
    implicit none
    private :: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_ptr

    interface
        ! version.h
        function wfpsf_version() bind(c, name="wfpsf_version") result(outcome)
            import :: c_ptr
            implicit none
            type(c_ptr) :: outcome
        end function wfpsf_version

        function wfpsf_abi_number() bind(c, name="wfpsf_abi_number") result(outcome)
            import :: c_int32_t
            implicit none
            integer(c_int32_t) :: outcome
        end function wfpsf_abi_number

        function wfpsf_abi_check(expected) bind(c, name="wfpsf_abi_check") result(outcome)
            import :: c_int32_t
            implicit none
            integer(c_int32_t), value :: expected
            integer(c_int32_t) :: outcome
        end function wfpsf_abi_check

        ! status.h
        function wfpsf_status_name(status) bind(c, name="wfpsf_status_name") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            integer(c_int32_t), value :: status
            type(c_ptr) :: outcome
        end function wfpsf_status_name

        function wfpsf_status_string(status) bind(c, name="wfpsf_status_string") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            integer(c_int32_t), value :: status
            type(c_ptr) :: outcome
        end function wfpsf_status_string

        function wfpsf_last_error(buffer, length) bind(c, name="wfpsf_last_error") result(outcome)
            import :: c_char, c_int64_t
            implicit none
            character(kind=c_char), intent(inout), optional :: buffer(*)
            integer(c_int64_t), value :: length
            integer(c_int64_t) :: outcome
        end function wfpsf_last_error

        ! options.h
        function wfpsf_options_create(out) bind(c, name="wfpsf_options_create") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_options_create

        subroutine wfpsf_options_destroy(options) bind(c, name="wfpsf_options_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: options
        end subroutine wfpsf_options_destroy

        function wfpsf_options_set_real(options, key, value) &
            bind(c, name="wfpsf_options_set_real") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: options
            integer(c_int32_t), value :: key
            real(c_double), value :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_options_set_real

        function wfpsf_options_set_integer(options, key, value) &
            bind(c, name="wfpsf_options_set_integer") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: options
            integer(c_int32_t), value :: key
            integer(c_int64_t), value :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_options_set_integer

        function wfpsf_options_get(options, key, value) &
            bind(c, name="wfpsf_options_get") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: options
            integer(c_int32_t), value :: key
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_options_get

        function wfpsf_options_reset(options, key) &
            bind(c, name="wfpsf_options_reset") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: options
            integer(c_int32_t), value :: key
            integer(c_int32_t) :: outcome
        end function wfpsf_options_reset

        function wfpsf_options_set_zernikes(options, count, coefficients) &
            bind(c, name="wfpsf_options_set_zernikes") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: options
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: coefficients(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_options_set_zernikes

        function wfpsf_options_set_progress(options, progress, user) &
            bind(c, name="wfpsf_options_set_progress") result(outcome)
            import :: c_funptr, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: options
            type(c_funptr), value :: progress
            type(c_ptr), value :: user
            integer(c_int32_t) :: outcome
        end function wfpsf_options_set_progress

        function wfpsf_option_describe(key, name, text, kind, standard, smallest, largest) &
            bind(c, name="wfpsf_option_describe") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            integer(c_int32_t), value :: key
            type(c_ptr), intent(inout), optional :: name
            type(c_ptr), intent(inout), optional :: text
            integer(c_int32_t), intent(inout), optional :: kind
            real(c_double), intent(inout), optional :: standard
            real(c_double), intent(inout), optional :: smallest
            real(c_double), intent(inout), optional :: largest
            integer(c_int32_t) :: outcome
        end function wfpsf_option_describe

        ! image.h
        function wfpsf_image_create(pixel_type, nx, ny, oversampling, out) &
            bind(c, name="wfpsf_image_create") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            integer(c_int32_t), value :: pixel_type
            integer(c_int64_t), value :: nx
            integer(c_int64_t), value :: ny
            integer(c_int64_t), value :: oversampling
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_image_create

        function wfpsf_image_wrap(pixel_type, data, nx, ny, stride_x, stride_y, oversampling, out) &
            bind(c, name="wfpsf_image_wrap") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            integer(c_int32_t), value :: pixel_type
            type(c_ptr), value :: data
            integer(c_int64_t), value :: nx
            integer(c_int64_t), value :: ny
            integer(c_int64_t), value :: stride_x
            integer(c_int64_t), value :: stride_y
            integer(c_int64_t), value :: oversampling
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_image_wrap

        subroutine wfpsf_image_destroy(image) bind(c, name="wfpsf_image_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: image
        end subroutine wfpsf_image_destroy

        function wfpsf_image_shape(image, pixel_type, nx, ny) &
            bind(c, name="wfpsf_image_shape") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            integer(c_int32_t), intent(inout), optional :: pixel_type
            integer(c_int64_t), intent(inout), optional :: nx
            integer(c_int64_t), intent(inout), optional :: ny
            integer(c_int32_t) :: outcome
        end function wfpsf_image_shape

        function wfpsf_image_record(image, oversampling, pixel_scale_arcsec, applied) &
            bind(c, name="wfpsf_image_record") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            integer(c_int64_t), intent(inout), optional :: oversampling
            real(c_double), intent(inout), optional :: pixel_scale_arcsec
            integer(c_int32_t), intent(inout), optional :: applied
            integer(c_int32_t) :: outcome
        end function wfpsf_image_record

        function wfpsf_image_set_record(image, oversampling, pixel_scale_arcsec, applied) &
            bind(c, name="wfpsf_image_set_record") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            integer(c_int64_t), value :: oversampling
            real(c_double), value :: pixel_scale_arcsec
            integer(c_int32_t), value :: applied
            integer(c_int32_t) :: outcome
        end function wfpsf_image_set_record

        function wfpsf_image_copy(from, to) bind(c, name="wfpsf_image_copy") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: from
            type(c_ptr), value :: to
            integer(c_int32_t) :: outcome
        end function wfpsf_image_copy

        function wfpsf_image_read_fits(path, hdu, pixel_type, out) &
            bind(c, name="wfpsf_image_read_fits") result(outcome)
            import :: c_char, c_int32_t, c_ptr
            implicit none
            character(kind=c_char), intent(in), optional :: path(*)
            character(kind=c_char), intent(in), optional :: hdu(*)
            integer(c_int32_t), value :: pixel_type
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_image_read_fits

        function wfpsf_image_write_fits(image, path, options) &
            bind(c, name="wfpsf_image_write_fits") result(outcome)
            import :: c_char, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            character(kind=c_char), intent(in), optional :: path(*)
            type(c_ptr), value :: options
            integer(c_int32_t) :: outcome
        end function wfpsf_image_write_fits

        function wfpsf_image_interleave(n_x, n_y, images, dx, dy, convention, out) &
            bind(c, name="wfpsf_image_interleave") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            integer(c_int64_t), value :: n_x
            integer(c_int64_t), value :: n_y
            type(c_ptr), intent(in), optional :: images(*)
            real(c_double), intent(in), optional :: dx(*)
            real(c_double), intent(in), optional :: dy(*)
            integer(c_int32_t), value :: convention
            type(c_ptr), value :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_image_interleave

        function wfpsf_image_deinterleave(image, n_x, n_y, dx, dy, convention, out) &
            bind(c, name="wfpsf_image_deinterleave") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            integer(c_int64_t), value :: n_x
            integer(c_int64_t), value :: n_y
            real(c_double), intent(in), optional :: dx(*)
            real(c_double), intent(in), optional :: dy(*)
            integer(c_int32_t), value :: convention
            type(c_ptr), intent(in), optional :: out(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_image_deinterleave

        ! instrument.h
        function wfpsf_instrument_create(name, out) &
            bind(c, name="wfpsf_instrument_create") result(outcome)
            import :: c_char, c_int32_t, c_ptr
            implicit none
            character(kind=c_char), intent(in), optional :: name(*)
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_instrument_create

        subroutine wfpsf_instrument_destroy(instrument) bind(c, name="wfpsf_instrument_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: instrument
        end subroutine wfpsf_instrument_destroy

        function wfpsf_instrument_constant(instrument, name, value, unit) &
            bind(c, name="wfpsf_instrument_constant") result(outcome)
            import :: c_char, c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            character(kind=c_char), intent(in), optional :: name(*)
            real(c_double), intent(inout), optional :: value
            type(c_ptr), intent(inout), optional :: unit
            integer(c_int32_t) :: outcome
        end function wfpsf_instrument_constant

        function wfpsf_instrument_constant_name(instrument, index) &
            bind(c, name="wfpsf_instrument_constant_name") result(outcome)
            import :: c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            integer(c_int64_t), value :: index
            type(c_ptr) :: outcome
        end function wfpsf_instrument_constant_name

        function wfpsf_instrument_band_name(instrument, index) &
            bind(c, name="wfpsf_instrument_band_name") result(outcome)
            import :: c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            integer(c_int64_t), value :: index
            type(c_ptr) :: outcome
        end function wfpsf_instrument_band_name

        function wfpsf_instrument_band(instrument, band, rule, blue_nm, red_nm, effective_nm) &
            bind(c, name="wfpsf_instrument_band") result(outcome)
            import :: c_char, c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            character(kind=c_char), intent(in), optional :: band(*)
            integer(c_int32_t), value :: rule
            real(c_double), intent(inout), optional :: blue_nm
            real(c_double), intent(inout), optional :: red_nm
            real(c_double), intent(inout), optional :: effective_nm
            integer(c_int32_t) :: outcome
        end function wfpsf_instrument_band

        function wfpsf_instrument_throughput(instrument, band, count, wavelength_nm, throughput) &
            bind(c, name="wfpsf_instrument_throughput") result(outcome)
            import :: c_char, c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            character(kind=c_char), intent(in), optional :: band(*)
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: wavelength_nm(*)
            real(c_double), intent(inout), optional :: throughput(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_instrument_throughput

        function wfpsf_instrument_zernikes(instrument, sca, capacity, coefficients, count) &
            bind(c, name="wfpsf_instrument_zernikes") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            integer(c_int32_t), value :: sca
            integer(c_int64_t), value :: capacity
            real(c_double), intent(inout), optional :: coefficients(*)
            integer(c_int64_t), intent(inout), optional :: count
            integer(c_int32_t) :: outcome
        end function wfpsf_instrument_zernikes

        function wfpsf_instrument_pupil(instrument, band, sca, options, out, scale_m, axis_x, &
            axis_y) bind(c, name="wfpsf_instrument_pupil") result(outcome)
            import :: c_char, c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            character(kind=c_char), intent(in), optional :: band(*)
            integer(c_int32_t), value :: sca
            type(c_ptr), value :: options
            type(c_ptr), value :: out
            real(c_double), intent(inout), optional :: scale_m
            real(c_double), intent(inout), optional :: axis_x
            real(c_double), intent(inout), optional :: axis_y
            integer(c_int32_t) :: outcome
        end function wfpsf_instrument_pupil

        ! design.h
        function wfpsf_design_create(out) bind(c, name="wfpsf_design_create") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_design_create

        subroutine wfpsf_design_destroy(design) bind(c, name="wfpsf_design_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: design
        end subroutine wfpsf_design_destroy

        function wfpsf_design_set_telescope(design, diameter_m, obscuration, &
            reference_wavelength_nm) bind(c, name="wfpsf_design_set_telescope") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: design
            real(c_double), value :: diameter_m
            real(c_double), value :: obscuration
            real(c_double), value :: reference_wavelength_nm
            integer(c_int32_t) :: outcome
        end function wfpsf_design_set_telescope

        function wfpsf_design_add_strut(design, azimuth_deg, width_m, offset_m) &
            bind(c, name="wfpsf_design_add_strut") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: design
            real(c_double), value :: azimuth_deg
            real(c_double), value :: width_m
            real(c_double), value :: offset_m
            integer(c_int32_t) :: outcome
        end function wfpsf_design_add_strut

        function wfpsf_design_set_detector(design, sca_count, pixel_scale_arcsec, n_pix_x, &
            n_pix_y) bind(c, name="wfpsf_design_set_detector") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: design
            integer(c_int32_t), value :: sca_count
            real(c_double), value :: pixel_scale_arcsec
            integer(c_int64_t), value :: n_pix_x
            integer(c_int64_t), value :: n_pix_y
            integer(c_int32_t) :: outcome
        end function wfpsf_design_set_detector

        function wfpsf_design_set_zernikes(design, sca, count, coefficients) &
            bind(c, name="wfpsf_design_set_zernikes") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: design
            integer(c_int32_t), value :: sca
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: coefficients(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_design_set_zernikes

        function wfpsf_design_set_field(design, sca, x, y, count, coefficients) &
            bind(c, name="wfpsf_design_set_field") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: design
            integer(c_int32_t), value :: sca
            real(c_double), intent(in), optional :: x(*)
            real(c_double), intent(in), optional :: y(*)
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: coefficients(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_design_set_field

        function wfpsf_design_add_band(design, name, first_nm, step_nm, count, throughput) &
            bind(c, name="wfpsf_design_add_band") result(outcome)
            import :: c_char, c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: design
            character(kind=c_char), intent(in), optional :: name(*)
            real(c_double), value :: first_nm
            real(c_double), value :: step_nm
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: throughput(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_design_add_band

        function wfpsf_instrument_create_from_design(design, out) &
            bind(c, name="wfpsf_instrument_create_from_design") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: design
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_instrument_create_from_design

        ! sed.h
        function wfpsf_sed_create_table(unit, count, wavelength_nm, density, out) &
            bind(c, name="wfpsf_sed_create_table") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            integer(c_int32_t), value :: unit
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: wavelength_nm(*)
            real(c_double), intent(in), optional :: density(*)
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_sed_create_table

        function wfpsf_sed_create_power_law(unit, exponent, out) &
            bind(c, name="wfpsf_sed_create_power_law") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            integer(c_int32_t), value :: unit
            real(c_double), value :: exponent
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_sed_create_power_law

        function wfpsf_sed_create_black_body(temperature_k, out) &
            bind(c, name="wfpsf_sed_create_black_body") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            real(c_double), value :: temperature_k
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_sed_create_black_body

        function wfpsf_sed_create_redshifted(sed, redshift, out) &
            bind(c, name="wfpsf_sed_create_redshifted") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: sed
            real(c_double), value :: redshift
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_sed_create_redshifted

        subroutine wfpsf_sed_destroy(sed) bind(c, name="wfpsf_sed_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: sed
        end subroutine wfpsf_sed_destroy

        function wfpsf_sed_photon_density(sed, count, wavelength_nm, photons) &
            bind(c, name="wfpsf_sed_photon_density") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: sed
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: wavelength_nm(*)
            real(c_double), intent(inout), optional :: photons(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_sed_photon_density

        ! psf.h
        function wfpsf_options_set_opd(options, map, scale_m, axis_x, axis_y) &
            bind(c, name="wfpsf_options_set_opd") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: options
            type(c_ptr), value :: map
            real(c_double), value :: scale_m
            real(c_double), value :: axis_x
            real(c_double), value :: axis_y
            integer(c_int32_t) :: outcome
        end function wfpsf_options_set_opd

        function wfpsf_psf_create(instrument, sca, wavelength_nm, options, out) &
            bind(c, name="wfpsf_psf_create") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            integer(c_int32_t), value :: sca
            real(c_double), value :: wavelength_nm
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_psf_create

        function wfpsf_psf_create_in_band(instrument, band, sca, x, y, wavelength_nm, options, &
            out) bind(c, name="wfpsf_psf_create_in_band") result(outcome)
            import :: c_char, c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            character(kind=c_char), intent(in), optional :: band(*)
            integer(c_int32_t), value :: sca
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), value :: wavelength_nm
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_psf_create_in_band

        function wfpsf_psf_create_chromatic(instrument, band, sca, x, y, count, seds, options, &
            out) bind(c, name="wfpsf_psf_create_chromatic") result(outcome)
            import :: c_char, c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            character(kind=c_char), intent(in), optional :: band(*)
            integer(c_int32_t), value :: sca
            real(c_double), value :: x
            real(c_double), value :: y
            integer(c_int64_t), value :: count
            type(c_ptr), intent(in), optional :: seds(*)
            type(c_ptr), value :: options
            type(c_ptr), intent(inout) :: out(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_psf_create_chromatic

        function wfpsf_psf_create_from_mask(instrument, mask, mask_scale_m, axis_x, axis_y, sca, &
            wavelength_nm, options, out) bind(c, name="wfpsf_psf_create_from_mask") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            type(c_ptr), value :: mask
            real(c_double), value :: mask_scale_m
            real(c_double), value :: axis_x
            real(c_double), value :: axis_y
            integer(c_int32_t), value :: sca
            real(c_double), value :: wavelength_nm
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_psf_create_from_mask

        subroutine wfpsf_psf_destroy(psf) bind(c, name="wfpsf_psf_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: psf
        end subroutine wfpsf_psf_destroy

        function wfpsf_psf_draw(psf, x, y, flux, options, image) &
            bind(c, name="wfpsf_psf_draw") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: psf
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), value :: flux
            type(c_ptr), value :: options
            type(c_ptr), value :: image
            integer(c_int32_t) :: outcome
        end function wfpsf_psf_draw

        function wfpsf_psf_add_bright_star(psf, x, y, flux, options, image) &
            bind(c, name="wfpsf_psf_add_bright_star") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: psf
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), value :: flux
            type(c_ptr), value :: options
            type(c_ptr), value :: image
            integer(c_int32_t) :: outcome
        end function wfpsf_psf_add_bright_star

        function wfpsf_psf_draw_memory(psf, x, y, image, least, most) &
            bind(c, name="wfpsf_psf_draw_memory") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: psf
            real(c_double), value :: x
            real(c_double), value :: y
            type(c_ptr), value :: image
            integer(c_int64_t), intent(inout), optional :: least
            integer(c_int64_t), intent(inout), optional :: most
            integer(c_int32_t) :: outcome
        end function wfpsf_psf_draw_memory

        function wfpsf_psf_add_stars(psf, count, x, y, flux, options, image) &
            bind(c, name="wfpsf_psf_add_stars") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: psf
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: x(*)
            real(c_double), intent(in), optional :: y(*)
            real(c_double), intent(in), optional :: flux(*)
            type(c_ptr), value :: options
            type(c_ptr), value :: image
            integer(c_int32_t) :: outcome
        end function wfpsf_psf_add_stars

        function wfpsf_psf_convolve(psf, galaxy, x, y, flux, options, image) &
            bind(c, name="wfpsf_psf_convolve") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: psf
            type(c_ptr), value :: galaxy
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), value :: flux
            type(c_ptr), value :: options
            type(c_ptr), value :: image
            integer(c_int32_t) :: outcome
        end function wfpsf_psf_convolve

        function wfpsf_psf_get(psf, key, value) bind(c, name="wfpsf_psf_get") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: psf
            integer(c_int32_t), value :: key
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_psf_get

        ! varying_psf.h
        function wfpsf_varying_psf_create(instrument, band, sca, wavelength_nm, sed, options, out) &
            bind(c, name="wfpsf_varying_psf_create") result(outcome)
            import :: c_char, c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            character(kind=c_char), intent(in), optional :: band(*)
            integer(c_int32_t), value :: sca
            real(c_double), value :: wavelength_nm
            type(c_ptr), value :: sed
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_psf_create

        subroutine wfpsf_varying_psf_destroy(varying) bind(c, name="wfpsf_varying_psf_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: varying
        end subroutine wfpsf_varying_psf_destroy

        function wfpsf_varying_psf_at(varying, x, y, out) &
            bind(c, name="wfpsf_varying_psf_at") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: varying
            real(c_double), value :: x
            real(c_double), value :: y
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_psf_at

        function wfpsf_varying_psf_add_stars(varying, x0, y0, count, x, y, flux, options, image) &
            bind(c, name="wfpsf_varying_psf_add_stars") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: varying
            real(c_double), value :: x0
            real(c_double), value :: y0
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: x(*)
            real(c_double), intent(in), optional :: y(*)
            real(c_double), intent(in), optional :: flux(*)
            type(c_ptr), value :: options
            type(c_ptr), value :: image
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_psf_add_stars

        function wfpsf_varying_psf_get(varying, key, value) &
            bind(c, name="wfpsf_varying_psf_get") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: varying
            integer(c_int32_t), value :: key
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_psf_get

        ! otf.h
        function wfpsf_otf_create(psf, options, out) &
            bind(c, name="wfpsf_otf_create") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: psf
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_otf_create

        subroutine wfpsf_otf_destroy(otf) bind(c, name="wfpsf_otf_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: otf
        end subroutine wfpsf_otf_destroy

        function wfpsf_otf_values(otf, response, count, kx, ky, re, im) &
            bind(c, name="wfpsf_otf_values") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: otf
            integer(c_int32_t), value :: response
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: kx(*)
            real(c_double), intent(in), optional :: ky(*)
            real(c_double), intent(inout), optional :: re(*)
            real(c_double), intent(inout), optional :: im(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_otf_values

        function wfpsf_otf_grid(otf, response, order, step, re, im) &
            bind(c, name="wfpsf_otf_grid") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: otf
            integer(c_int32_t), value :: response
            integer(c_int32_t), value :: order
            real(c_double), value :: step
            type(c_ptr), value :: re
            type(c_ptr), value :: im
            integer(c_int32_t) :: outcome
        end function wfpsf_otf_grid

        function wfpsf_otf_get(otf, key, value) bind(c, name="wfpsf_otf_get") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: otf
            integer(c_int32_t), value :: key
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_otf_get

        ! ipc.h
        function wfpsf_ipc_kernel_create(alpha, alpha_prime, alpha_plus, options, out) &
            bind(c, name="wfpsf_ipc_kernel_create") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            real(c_double), value :: alpha
            real(c_double), value :: alpha_prime
            real(c_double), value :: alpha_plus
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_create

        function wfpsf_ipc_kernel_create_taps(nx, ny, taps, options, out) &
            bind(c, name="wfpsf_ipc_kernel_create_taps") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            integer(c_int64_t), value :: nx
            integer(c_int64_t), value :: ny
            real(c_double), intent(in), optional :: taps(*)
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_create_taps

        function wfpsf_ipc_kernel_create_wfc3(out) &
            bind(c, name="wfpsf_ipc_kernel_create_wfc3") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_create_wfc3

        function wfpsf_ipc_kernel_create_default(instrument, out) &
            bind(c, name="wfpsf_ipc_kernel_create_default") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_create_default

        function wfpsf_ipc_kernel_create_correction(kernel, out) &
            bind(c, name="wfpsf_ipc_kernel_create_correction") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_create_correction

        function wfpsf_ipc_kernel_create_flipped(kernel, out) &
            bind(c, name="wfpsf_ipc_kernel_create_flipped") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_create_flipped

        function wfpsf_ipc_kernel_read_fits(path, hdu, options, out) &
            bind(c, name="wfpsf_ipc_kernel_read_fits") result(outcome)
            import :: c_char, c_int32_t, c_ptr
            implicit none
            character(kind=c_char), intent(in), optional :: path(*)
            character(kind=c_char), intent(in), optional :: hdu(*)
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_read_fits

        function wfpsf_ipc_kernel_create_composed(first, second, out) &
            bind(c, name="wfpsf_ipc_kernel_create_composed") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: first
            type(c_ptr), value :: second
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_create_composed

        function wfpsf_ipc_kernel_create_neumann(kernel, order, out) &
            bind(c, name="wfpsf_ipc_kernel_create_neumann") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            integer(c_int64_t), value :: order
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_create_neumann

        function wfpsf_ipc_kernel_create_autocorrelation(kernel, out) &
            bind(c, name="wfpsf_ipc_kernel_create_autocorrelation") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_create_autocorrelation

        function wfpsf_ipc_wfc3_deviations(capacity, deviations) &
            bind(c, name="wfpsf_ipc_wfc3_deviations") result(outcome)
            import :: c_double, c_int32_t, c_int64_t
            implicit none
            integer(c_int64_t), value :: capacity
            real(c_double), intent(inout), optional :: deviations(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_wfc3_deviations

        subroutine wfpsf_ipc_kernel_destroy(kernel) bind(c, name="wfpsf_ipc_kernel_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: kernel
        end subroutine wfpsf_ipc_kernel_destroy

        function wfpsf_ipc_kernel_taps(kernel, capacity, taps, nx, ny) &
            bind(c, name="wfpsf_ipc_kernel_taps") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            integer(c_int64_t), value :: capacity
            real(c_double), intent(inout), optional :: taps(*)
            integer(c_int64_t), intent(inout), optional :: nx
            integer(c_int64_t), intent(inout), optional :: ny
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_taps

        function wfpsf_ipc_kernel_get(kernel, key, value) &
            bind(c, name="wfpsf_ipc_kernel_get") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            integer(c_int32_t), value :: key
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_get

        function wfpsf_ipc_kernel_transform(kernel, frequency_x, frequency_y, real_part, &
            imaginary_part) bind(c, name="wfpsf_ipc_kernel_transform") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            real(c_double), value :: frequency_x
            real(c_double), value :: frequency_y
            real(c_double), intent(inout), optional :: real_part
            real(c_double), intent(inout), optional :: imaginary_part
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_transform

        function wfpsf_ipc_apply(kernel, in, edge, options, out, not_finite) &
            bind(c, name="wfpsf_ipc_apply") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            type(c_ptr), value :: in
            integer(c_int32_t), value :: edge
            type(c_ptr), value :: options
            type(c_ptr), value :: out
            integer(c_int64_t), intent(inout), optional :: not_finite
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_apply

        function wfpsf_ipc_kernel_self_test(kernel, options, capacity, response) &
            bind(c, name="wfpsf_ipc_kernel_self_test") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            type(c_ptr), value :: options
            integer(c_int64_t), value :: capacity
            real(c_double), intent(inout), optional :: response(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_kernel_self_test

        function wfpsf_ipc_correct(kernel, in, edge, options, out, residual, noise_amplification, &
            passes, not_finite) bind(c, name="wfpsf_ipc_correct") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            type(c_ptr), value :: in
            integer(c_int32_t), value :: edge
            type(c_ptr), value :: options
            type(c_ptr), value :: out
            real(c_double), intent(inout), optional :: residual
            real(c_double), intent(inout), optional :: noise_amplification
            integer(c_int64_t), intent(inout), optional :: passes
            integer(c_int64_t), intent(inout), optional :: not_finite
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_correct

        function wfpsf_ipc_covariance(kernel, variance, lag_x, lag_y, edge, options, out) &
            bind(c, name="wfpsf_ipc_covariance") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: kernel
            type(c_ptr), value :: variance
            integer(c_int64_t), value :: lag_x
            integer(c_int64_t), value :: lag_y
            integer(c_int32_t), value :: edge
            type(c_ptr), value :: options
            type(c_ptr), value :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_ipc_covariance

        ! varying_ipc.h
        function wfpsf_varying_ipc_create_maps(alpha, alpha_prime, alpha_plus, options, out) &
            bind(c, name="wfpsf_varying_ipc_create_maps") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: alpha
            type(c_ptr), value :: alpha_prime
            type(c_ptr), value :: alpha_plus
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_ipc_create_maps

        function wfpsf_varying_ipc_create_polynomials(nx, ny, degree, alpha, alpha_prime, &
            alpha_plus, options, out) &
            bind(c, name="wfpsf_varying_ipc_create_polynomials") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            integer(c_int64_t), value :: nx
            integer(c_int64_t), value :: ny
            integer(c_int64_t), value :: degree
            real(c_double), intent(in), optional :: alpha(*)
            real(c_double), intent(in), optional :: alpha_prime(*)
            real(c_double), intent(in), optional :: alpha_plus(*)
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_ipc_create_polynomials

        function wfpsf_varying_ipc_create_regions(regions, count, kernels, out) &
            bind(c, name="wfpsf_varying_ipc_create_regions") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: regions
            integer(c_int64_t), value :: count
            type(c_ptr), intent(in), optional :: kernels(*)
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_ipc_create_regions

        subroutine wfpsf_varying_ipc_destroy(varying) bind(c, name="wfpsf_varying_ipc_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: varying
        end subroutine wfpsf_varying_ipc_destroy

        function wfpsf_varying_ipc_kernel(varying, x, y, out) &
            bind(c, name="wfpsf_varying_ipc_kernel") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: varying
            integer(c_int64_t), value :: x
            integer(c_int64_t), value :: y
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_ipc_kernel

        function wfpsf_varying_ipc_margin(varying, margin, x, y) &
            bind(c, name="wfpsf_varying_ipc_margin") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: varying
            real(c_double), intent(inout), optional :: margin
            integer(c_int64_t), intent(inout), optional :: x
            integer(c_int64_t), intent(inout), optional :: y
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_ipc_margin

        function wfpsf_varying_ipc_apply(varying, in, edge, options, out, not_finite) &
            bind(c, name="wfpsf_varying_ipc_apply") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: varying
            type(c_ptr), value :: in
            integer(c_int32_t), value :: edge
            type(c_ptr), value :: options
            type(c_ptr), value :: out
            integer(c_int64_t), intent(inout), optional :: not_finite
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_ipc_apply

        function wfpsf_varying_ipc_correct(varying, in, edge, options, out, residual, &
            noise_amplification, passes, not_finite) &
            bind(c, name="wfpsf_varying_ipc_correct") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: varying
            type(c_ptr), value :: in
            integer(c_int32_t), value :: edge
            type(c_ptr), value :: options
            type(c_ptr), value :: out
            real(c_double), intent(inout), optional :: residual
            real(c_double), intent(inout), optional :: noise_amplification
            integer(c_int64_t), intent(inout), optional :: passes
            integer(c_int64_t), intent(inout), optional :: not_finite
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_ipc_correct

        function wfpsf_varying_ipc_covariance(varying, variance, lag_x, lag_y, edge, options, out) &
            bind(c, name="wfpsf_varying_ipc_covariance") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: varying
            type(c_ptr), value :: variance
            integer(c_int64_t), value :: lag_x
            integer(c_int64_t), value :: lag_y
            integer(c_int32_t), value :: edge
            type(c_ptr), value :: options
            type(c_ptr), value :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_ipc_covariance

        function wfpsf_varying_ipc_autocorrelation(varying, variance, x, y, edge, options, &
            capacity, covariances, nx, ny) &
            bind(c, name="wfpsf_varying_ipc_autocorrelation") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: varying
            type(c_ptr), value :: variance
            integer(c_int64_t), value :: x
            integer(c_int64_t), value :: y
            integer(c_int32_t), value :: edge
            type(c_ptr), value :: options
            integer(c_int64_t), value :: capacity
            real(c_double), intent(inout), optional :: covariances(*)
            integer(c_int64_t), intent(inout), optional :: nx
            integer(c_int64_t), intent(inout), optional :: ny
            integer(c_int32_t) :: outcome
        end function wfpsf_varying_ipc_autocorrelation

        ! chain.h
        function wfpsf_chain_create(out) bind(c, name="wfpsf_chain_create") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_chain_create

        function wfpsf_chain_create_default(instrument, exposure_time, out) &
            bind(c, name="wfpsf_chain_create_default") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            real(c_double), value :: exposure_time
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_chain_create_default

        subroutine wfpsf_chain_destroy(chain) bind(c, name="wfpsf_chain_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: chain
        end subroutine wfpsf_chain_destroy

        function wfpsf_chain_add(chain, step, count, parameters) &
            bind(c, name="wfpsf_chain_add") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: chain
            integer(c_int32_t), value :: step
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: parameters(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_chain_add

        function wfpsf_chain_add_ipc(chain, kernel, edge) &
            bind(c, name="wfpsf_chain_add_ipc") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: chain
            type(c_ptr), value :: kernel
            integer(c_int32_t), value :: edge
            integer(c_int32_t) :: outcome
        end function wfpsf_chain_add_ipc

        function wfpsf_chain_add_varying_ipc(chain, varying, form, edge) &
            bind(c, name="wfpsf_chain_add_varying_ipc") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: chain
            type(c_ptr), value :: varying
            integer(c_int32_t), value :: form
            integer(c_int32_t), value :: edge
            integer(c_int32_t) :: outcome
        end function wfpsf_chain_add_varying_ipc

        function wfpsf_chain_add_map(chain, step, count, parameters, map) &
            bind(c, name="wfpsf_chain_add_map") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: chain
            integer(c_int32_t), value :: step
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: parameters(*)
            type(c_ptr), value :: map
            integer(c_int32_t) :: outcome
        end function wfpsf_chain_add_map

        function wfpsf_chain_step(chain, index, capacity, parameters, count, step) &
            bind(c, name="wfpsf_chain_step") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: chain
            integer(c_int64_t), value :: index
            integer(c_int64_t), value :: capacity
            real(c_double), intent(inout), optional :: parameters(*)
            integer(c_int64_t), intent(inout), optional :: count
            integer(c_int32_t), intent(inout), optional :: step
            integer(c_int32_t) :: outcome
        end function wfpsf_chain_step

        function wfpsf_step_name(step) bind(c, name="wfpsf_step_name") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            integer(c_int32_t), value :: step
            type(c_ptr) :: outcome
        end function wfpsf_step_name

        function wfpsf_chain_apply(chain, image, previous_count, previous, options, not_finite, &
            saturated) bind(c, name="wfpsf_chain_apply") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: chain
            type(c_ptr), value :: image
            integer(c_int64_t), value :: previous_count
            type(c_ptr), intent(in), optional :: previous(*)
            type(c_ptr), value :: options
            integer(c_int64_t), intent(inout), optional :: not_finite
            integer(c_int64_t), intent(inout), optional :: saturated
            integer(c_int32_t) :: outcome
        end function wfpsf_chain_apply

        function wfpsf_noise_add(image, rms, kernel, options) &
            bind(c, name="wfpsf_noise_add") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            real(c_double), value :: rms
            type(c_ptr), value :: kernel
            type(c_ptr), value :: options
            integer(c_int32_t) :: outcome
        end function wfpsf_noise_add

        ! sky.h
        function wfpsf_sky_level(instrument, band, longitude, latitude, level) &
            bind(c, name="wfpsf_sky_level") result(outcome)
            import :: c_char, c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            character(kind=c_char), intent(in), optional :: band(*)
            real(c_double), value :: longitude
            real(c_double), value :: latitude
            real(c_double), intent(inout), optional :: level
            integer(c_int32_t) :: outcome
        end function wfpsf_sky_level

        function wfpsf_sky_background(instrument, band, longitude, latitude, exposure_time, &
            pixel_area, electrons) bind(c, name="wfpsf_sky_background") result(outcome)
            import :: c_char, c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            character(kind=c_char), intent(in), optional :: band(*)
            real(c_double), value :: longitude
            real(c_double), value :: latitude
            real(c_double), value :: exposure_time
            real(c_double), value :: pixel_area
            real(c_double), intent(inout), optional :: electrons
            integer(c_int32_t) :: outcome
        end function wfpsf_sky_background

        ! observation.h
        function wfpsf_observation_create(instrument, ra_deg, dec_deg, pa_deg, options, out) &
            bind(c, name="wfpsf_observation_create") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            real(c_double), value :: ra_deg
            real(c_double), value :: dec_deg
            real(c_double), value :: pa_deg
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_observation_create

        function wfpsf_observation_create_on_date(instrument, ra_deg, dec_deg, julian_date, &
            options, out) bind(c, name="wfpsf_observation_create_on_date") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            real(c_double), value :: ra_deg
            real(c_double), value :: dec_deg
            real(c_double), value :: julian_date
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_observation_create_on_date

        function wfpsf_observation_create_aimed(instrument, sca, x, y, ra_deg, dec_deg, pa_deg, &
            options, out) bind(c, name="wfpsf_observation_create_aimed") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            integer(c_int32_t), value :: sca
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), value :: ra_deg
            real(c_double), value :: dec_deg
            real(c_double), value :: pa_deg
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_observation_create_aimed

        subroutine wfpsf_observation_destroy(observation) bind(c, name="wfpsf_observation_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: observation
        end subroutine wfpsf_observation_destroy

        function wfpsf_observation_get(observation, sca, key, value) &
            bind(c, name="wfpsf_observation_get") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: observation
            integer(c_int32_t), value :: sca
            integer(c_int32_t), value :: key
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_observation_get

        function wfpsf_observation_sky_to_pixel(observation, sca, count, ra_deg, dec_deg, x, y, &
            undefined) bind(c, name="wfpsf_observation_sky_to_pixel") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: observation
            integer(c_int32_t), value :: sca
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: ra_deg(*)
            real(c_double), intent(in), optional :: dec_deg(*)
            real(c_double), intent(inout), optional :: x(*)
            real(c_double), intent(inout), optional :: y(*)
            integer(c_int64_t), intent(inout), optional :: undefined
            integer(c_int32_t) :: outcome
        end function wfpsf_observation_sky_to_pixel

        function wfpsf_observation_pixel_to_sky(observation, sca, count, x, y, ra_deg, dec_deg, &
            undefined) bind(c, name="wfpsf_observation_pixel_to_sky") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: observation
            integer(c_int32_t), value :: sca
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: x(*)
            real(c_double), intent(in), optional :: y(*)
            real(c_double), intent(inout), optional :: ra_deg(*)
            real(c_double), intent(inout), optional :: dec_deg(*)
            integer(c_int64_t), intent(inout), optional :: undefined
            integer(c_int32_t) :: outcome
        end function wfpsf_observation_pixel_to_sky

        function wfpsf_observation_find_sca(observation, with_gaps, count, ra_deg, dec_deg, sca, &
            x, y, found) bind(c, name="wfpsf_observation_find_sca") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: observation
            integer(c_int32_t), value :: with_gaps
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: ra_deg(*)
            real(c_double), intent(in), optional :: dec_deg(*)
            integer(c_int32_t), intent(inout), optional :: sca(*)
            real(c_double), intent(inout), optional :: x(*)
            real(c_double), intent(inout), optional :: y(*)
            integer(c_int64_t), intent(inout), optional :: found
            integer(c_int32_t) :: outcome
        end function wfpsf_observation_find_sca

        function wfpsf_observation_bounds(observation, sca, with_gaps, x_first, x_last, y_first, &
            y_last) bind(c, name="wfpsf_observation_bounds") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: observation
            integer(c_int32_t), value :: sca
            integer(c_int32_t), value :: with_gaps
            integer(c_int64_t), intent(inout), optional :: x_first
            integer(c_int64_t), intent(inout), optional :: x_last
            integer(c_int64_t), intent(inout), optional :: y_first
            integer(c_int64_t), intent(inout), optional :: y_last
            integer(c_int32_t) :: outcome
        end function wfpsf_observation_bounds

        function wfpsf_observation_jacobian(observation, sca, count, x, y, jacobian, pixel_area, &
            y_angle_deg, undefined) bind(c, name="wfpsf_observation_jacobian") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: observation
            integer(c_int32_t), value :: sca
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: x(*)
            real(c_double), intent(in), optional :: y(*)
            real(c_double), intent(inout), optional :: jacobian(*)
            real(c_double), intent(inout), optional :: pixel_area(*)
            real(c_double), intent(inout), optional :: y_angle_deg(*)
            integer(c_int64_t), intent(inout), optional :: undefined
            integer(c_int32_t) :: outcome
        end function wfpsf_observation_jacobian

        function wfpsf_observation_fits_header(observation, sca, capacity, text, length) &
            bind(c, name="wfpsf_observation_fits_header") result(outcome)
            import :: c_char, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: observation
            integer(c_int32_t), value :: sca
            integer(c_int64_t), value :: capacity
            character(kind=c_char), intent(inout), optional :: text(*)
            integer(c_int64_t), intent(inout), optional :: length
            integer(c_int32_t) :: outcome
        end function wfpsf_observation_fits_header

        function wfpsf_julian_date(year, month, day, hour, minute, second, julian_date) &
            bind(c, name="wfpsf_julian_date") result(outcome)
            import :: c_double, c_int32_t
            implicit none
            integer(c_int32_t), value :: year
            integer(c_int32_t), value :: month
            integer(c_int32_t), value :: day
            integer(c_int32_t), value :: hour
            integer(c_int32_t), value :: minute
            real(c_double), value :: second
            real(c_double), intent(inout), optional :: julian_date
            integer(c_int32_t) :: outcome
        end function wfpsf_julian_date

        function wfpsf_sun_position(julian_date, options, ra_deg, dec_deg) &
            bind(c, name="wfpsf_sun_position") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            real(c_double), value :: julian_date
            type(c_ptr), value :: options
            real(c_double), intent(inout), optional :: ra_deg
            real(c_double), intent(inout), optional :: dec_deg
            integer(c_int32_t) :: outcome
        end function wfpsf_sun_position

        function wfpsf_pointing_allowed(instrument, ra_deg, dec_deg, julian_date, options, &
            sun_angle_deg, allowed) bind(c, name="wfpsf_pointing_allowed") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            real(c_double), value :: ra_deg
            real(c_double), value :: dec_deg
            real(c_double), value :: julian_date
            type(c_ptr), value :: options
            real(c_double), intent(inout), optional :: sun_angle_deg
            integer(c_int32_t), intent(inout), optional :: allowed
            integer(c_int32_t) :: outcome
        end function wfpsf_pointing_allowed

        function wfpsf_pointing_best_pa(instrument, ra_deg, dec_deg, julian_date, options, pa_deg) &
            bind(c, name="wfpsf_pointing_best_pa") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            real(c_double), value :: ra_deg
            real(c_double), value :: dec_deg
            real(c_double), value :: julian_date
            type(c_ptr), value :: options
            real(c_double), intent(inout), optional :: pa_deg
            integer(c_int32_t) :: outcome
        end function wfpsf_pointing_best_pa

        ! moments.h
        function wfpsf_moments_measure(image, options, out) &
            bind(c, name="wfpsf_moments_measure") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_moments_measure

        function wfpsf_moments_measure_masked(image, missing, variance, options, out) &
            bind(c, name="wfpsf_moments_measure_masked") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            type(c_ptr), value :: missing
            type(c_ptr), value :: variance
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_moments_measure_masked

        function wfpsf_moments_measure_weighted(image, x, y, Mxx, Mxy, Myy, out) &
            bind(c, name="wfpsf_moments_measure_weighted") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), value :: Mxx
            real(c_double), value :: Mxy
            real(c_double), value :: Myy
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_moments_measure_weighted

        function wfpsf_moments_sums(image, x, y, weight, count, sums) &
            bind(c, name="wfpsf_moments_sums") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), intent(in), optional :: weight(*)
            integer(c_int64_t), value :: count
            real(c_double), intent(inout), optional :: sums(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_moments_sums

        function wfpsf_moments_measure_unweighted(image, x, y, out) &
            bind(c, name="wfpsf_moments_measure_unweighted") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            real(c_double), value :: x
            real(c_double), value :: y
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_moments_measure_unweighted

        subroutine wfpsf_moments_destroy(moments) bind(c, name="wfpsf_moments_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: moments
        end subroutine wfpsf_moments_destroy

        function wfpsf_moments_status(moments) bind(c, name="wfpsf_moments_status") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: moments
            integer(c_int32_t) :: outcome
        end function wfpsf_moments_status

        function wfpsf_moments_get(moments, key, value) &
            bind(c, name="wfpsf_moments_get") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: moments
            integer(c_int32_t), value :: key
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_moments_get

        function wfpsf_moments_covariance(moments, key_a, key_b, value) &
            bind(c, name="wfpsf_moments_covariance") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: moments
            integer(c_int32_t), value :: key_a
            integer(c_int32_t), value :: key_b
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_moments_covariance

        function wfpsf_moments_differentiate(moments, image, change, second, out) &
            bind(c, name="wfpsf_moments_differentiate") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: moments
            type(c_ptr), value :: image
            type(c_ptr), value :: change
            type(c_ptr), value :: second
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_moments_differentiate

        function wfpsf_moments_influence(moments, image, key, influence) &
            bind(c, name="wfpsf_moments_influence") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: moments
            type(c_ptr), value :: image
            integer(c_int32_t), value :: key
            type(c_ptr), value :: influence
            integer(c_int32_t) :: outcome
        end function wfpsf_moments_influence

        ! size.h
        function wfpsf_size_encircled_energy(image, x, y, radius, options, fraction, error) &
            bind(c, name="wfpsf_size_encircled_energy") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), value :: radius
            type(c_ptr), value :: options
            real(c_double), intent(inout), optional :: fraction
            real(c_double), intent(inout), optional :: error
            integer(c_int32_t) :: outcome
        end function wfpsf_size_encircled_energy

        function wfpsf_size_ee_radius(image, x, y, fraction, method, options, radius, error) &
            bind(c, name="wfpsf_size_ee_radius") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), value :: fraction
            integer(c_int32_t), value :: method
            type(c_ptr), value :: options
            real(c_double), intent(inout), optional :: radius
            real(c_double), intent(inout), optional :: error
            integer(c_int32_t) :: outcome
        end function wfpsf_size_ee_radius

        function wfpsf_size_fwhm(image, x, y, fwhm) bind(c, name="wfpsf_size_fwhm") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), intent(inout), optional :: fwhm
            integer(c_int32_t) :: outcome
        end function wfpsf_size_fwhm

        function wfpsf_size_ee_radius_derivative(image, change, second, x, y, fraction, options, &
            derivative, error) bind(c, name="wfpsf_size_ee_radius_derivative") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            type(c_ptr), value :: change
            type(c_ptr), value :: second
            real(c_double), value :: x
            real(c_double), value :: y
            real(c_double), value :: fraction
            type(c_ptr), value :: options
            real(c_double), intent(inout), optional :: derivative
            real(c_double), intent(inout), optional :: error
            integer(c_int32_t) :: outcome
        end function wfpsf_size_ee_radius_derivative

        function wfpsf_size_profile(image, x, y, count, radii, options, profile, errors) &
            bind(c, name="wfpsf_size_profile") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            real(c_double), value :: x
            real(c_double), value :: y
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: radii(*)
            type(c_ptr), value :: options
            real(c_double), intent(inout), optional :: profile(*)
            real(c_double), intent(inout), optional :: errors(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_size_profile

        function wfpsf_size_profile_fwhm(image, x, y, options, fwhm, error) &
            bind(c, name="wfpsf_size_profile_fwhm") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: image
            real(c_double), value :: x
            real(c_double), value :: y
            type(c_ptr), value :: options
            real(c_double), intent(inout), optional :: fwhm
            real(c_double), intent(inout), optional :: error
            integer(c_int32_t) :: outcome
        end function wfpsf_size_profile_fwhm

        ! study.h
        function wfpsf_study_create(instrument, sca, options, out) &
            bind(c, name="wfpsf_study_create") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            integer(c_int32_t), value :: sca
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_study_create

        subroutine wfpsf_study_destroy(study) bind(c, name="wfpsf_study_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: study
        end subroutine wfpsf_study_destroy

        function wfpsf_study_size(study, table, rows, columns) &
            bind(c, name="wfpsf_study_size") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: study
            integer(c_int32_t), value :: table
            integer(c_int64_t), intent(inout), optional :: rows
            integer(c_int64_t), intent(inout), optional :: columns
            integer(c_int32_t) :: outcome
        end function wfpsf_study_size

        function wfpsf_study_column(study, table, column) &
            bind(c, name="wfpsf_study_column") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: study
            integer(c_int32_t), value :: table
            integer(c_int64_t), value :: column
            type(c_ptr) :: outcome
        end function wfpsf_study_column

        function wfpsf_study_value(study, table, row, column, value) &
            bind(c, name="wfpsf_study_value") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: study
            integer(c_int32_t), value :: table
            integer(c_int64_t), value :: row
            integer(c_int64_t), value :: column
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_study_value

        function wfpsf_study_text(study, table, row, column) &
            bind(c, name="wfpsf_study_text") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: study
            integer(c_int32_t), value :: table
            integer(c_int64_t), value :: row
            integer(c_int64_t), value :: column
            type(c_ptr) :: outcome
        end function wfpsf_study_text

        function wfpsf_study_write_csv(study, folder) &
            bind(c, name="wfpsf_study_write_csv") result(outcome)
            import :: c_char, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: study
            character(kind=c_char), intent(in), optional :: folder(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_study_write_csv

        ! catalogue.h
        function wfpsf_catalogue_create(positions, brightness, out) &
            bind(c, name="wfpsf_catalogue_create") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            integer(c_int32_t), value :: positions
            integer(c_int32_t), value :: brightness
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_catalogue_create

        subroutine wfpsf_catalogue_destroy(catalogue) bind(c, name="wfpsf_catalogue_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: catalogue
        end subroutine wfpsf_catalogue_destroy

        function wfpsf_catalogue_add_colour(catalogue, wavelength_nm, sed, colour) &
            bind(c, name="wfpsf_catalogue_add_colour") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: catalogue
            real(c_double), value :: wavelength_nm
            type(c_ptr), value :: sed
            integer(c_int32_t), intent(inout), optional :: colour
            integer(c_int32_t) :: outcome
        end function wfpsf_catalogue_add_colour

        function wfpsf_catalogue_add_stars(catalogue, count, x, y, brightness, colour) &
            bind(c, name="wfpsf_catalogue_add_stars") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: catalogue
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: x(*)
            real(c_double), intent(in), optional :: y(*)
            real(c_double), intent(in), optional :: brightness(*)
            integer(c_int32_t), intent(in), optional :: colour(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_catalogue_add_stars

        function wfpsf_catalogue_add_galaxies(catalogue, count, x, y, brightness, colour, &
            sersic_index, half_light_radius_arcsec, e1, e2) &
            bind(c, name="wfpsf_catalogue_add_galaxies") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: catalogue
            integer(c_int64_t), value :: count
            real(c_double), intent(in), optional :: x(*)
            real(c_double), intent(in), optional :: y(*)
            real(c_double), intent(in), optional :: brightness(*)
            integer(c_int32_t), intent(in), optional :: colour(*)
            real(c_double), intent(in), optional :: sersic_index(*)
            real(c_double), intent(in), optional :: half_light_radius_arcsec(*)
            real(c_double), intent(in), optional :: e1(*)
            real(c_double), intent(in), optional :: e2(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_catalogue_add_galaxies

        function wfpsf_catalogue_size(catalogue, count) &
            bind(c, name="wfpsf_catalogue_size") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: catalogue
            integer(c_int64_t), intent(inout), optional :: count
            integer(c_int32_t) :: outcome
        end function wfpsf_catalogue_size

        function wfpsf_instrument_ab_zero_rate(instrument, band, rate) &
            bind(c, name="wfpsf_instrument_ab_zero_rate") result(outcome)
            import :: c_char, c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            character(kind=c_char), intent(in), optional :: band(*)
            real(c_double), intent(inout), optional :: rate
            integer(c_int32_t) :: outcome
        end function wfpsf_instrument_ab_zero_rate

        ! scene.h
        function wfpsf_scene_store_create(out) &
            bind(c, name="wfpsf_scene_store_create") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_store_create

        subroutine wfpsf_scene_store_destroy(store) bind(c, name="wfpsf_scene_store_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: store
        end subroutine wfpsf_scene_store_destroy

        function wfpsf_scene_store_memory(store, bytes) &
            bind(c, name="wfpsf_scene_store_memory") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: store
            integer(c_int64_t), intent(inout), optional :: bytes
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_store_memory

        function wfpsf_scene_store_write(store, path) &
            bind(c, name="wfpsf_scene_store_write") result(outcome)
            import :: c_char, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: store
            character(kind=c_char), intent(in), optional :: path(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_store_write

        function wfpsf_scene_store_read(store, path) &
            bind(c, name="wfpsf_scene_store_read") result(outcome)
            import :: c_char, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: store
            character(kind=c_char), intent(in), optional :: path(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_store_read

        function wfpsf_options_set_scene_store(options, store) &
            bind(c, name="wfpsf_options_set_scene_store") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: options
            type(c_ptr), value :: store
            integer(c_int32_t) :: outcome
        end function wfpsf_options_set_scene_store

        function wfpsf_scene_create(instrument, observation, band, sca, catalogue, image, x0, y0, &
            options, out) bind(c, name="wfpsf_scene_create") result(outcome)
            import :: c_char, c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            type(c_ptr), value :: observation
            character(kind=c_char), intent(in), optional :: band(*)
            integer(c_int32_t), value :: sca
            type(c_ptr), value :: catalogue
            type(c_ptr), value :: image
            real(c_double), value :: x0
            real(c_double), value :: y0
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_create

        subroutine wfpsf_scene_destroy(scene) bind(c, name="wfpsf_scene_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: scene
        end subroutine wfpsf_scene_destroy

        function wfpsf_scene_get(scene, key, value) bind(c, name="wfpsf_scene_get") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: scene
            integer(c_int32_t), value :: key
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_get

        function wfpsf_scene_get_group(scene, group, key, value) &
            bind(c, name="wfpsf_scene_get_group") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: scene
            integer(c_int64_t), value :: group
            integer(c_int32_t), value :: key
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_get_group

        function wfpsf_scene_groups_of(scene, count, group) &
            bind(c, name="wfpsf_scene_groups_of") result(outcome)
            import :: c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: scene
            integer(c_int64_t), value :: count
            integer(c_int32_t), intent(inout), optional :: group(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_groups_of

        function wfpsf_scene_text(scene, capacity, text, length) &
            bind(c, name="wfpsf_scene_text") result(outcome)
            import :: c_char, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: scene
            integer(c_int64_t), value :: capacity
            character(kind=c_char), intent(inout), optional :: text(*)
            integer(c_int64_t), intent(inout), optional :: length
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_text

        function wfpsf_scene_render(scene, options, image, out) &
            bind(c, name="wfpsf_scene_render") result(outcome)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: scene
            type(c_ptr), value :: options
            type(c_ptr), value :: image
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_render

        subroutine wfpsf_rendering_destroy(rendering) bind(c, name="wfpsf_rendering_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: rendering
        end subroutine wfpsf_rendering_destroy

        function wfpsf_rendering_get(rendering, key, value) &
            bind(c, name="wfpsf_rendering_get") result(outcome)
            import :: c_double, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: rendering
            integer(c_int32_t), value :: key
            real(c_double), intent(inout), optional :: value
            integer(c_int32_t) :: outcome
        end function wfpsf_rendering_get

        function wfpsf_scene_truth(scene, count, sources, kernel, options, values) &
            bind(c, name="wfpsf_scene_truth") result(outcome)
            import :: c_double, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: scene
            integer(c_int64_t), value :: count
            integer(c_int64_t), intent(in), optional :: sources(*)
            type(c_ptr), value :: kernel
            type(c_ptr), value :: options
            real(c_double), intent(inout), optional :: values(*)
            integer(c_int32_t) :: outcome
        end function wfpsf_scene_truth

        ! exposure.h
        function wfpsf_exposure_create(instrument, observation, band, catalogue, chain, options, &
            out) bind(c, name="wfpsf_exposure_create") result(outcome)
            import :: c_char, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: instrument
            type(c_ptr), value :: observation
            character(kind=c_char), intent(in), optional :: band(*)
            type(c_ptr), value :: catalogue
            type(c_ptr), value :: chain
            type(c_ptr), value :: options
            type(c_ptr), intent(out) :: out
            integer(c_int32_t) :: outcome
        end function wfpsf_exposure_create

        subroutine wfpsf_exposure_destroy(exposure) bind(c, name="wfpsf_exposure_destroy")
            import :: c_ptr
            implicit none
            type(c_ptr), value :: exposure
        end subroutine wfpsf_exposure_destroy

        function wfpsf_exposure_path(exposure, folder, sca, capacity, text, length) &
            bind(c, name="wfpsf_exposure_path") result(outcome)
            import :: c_char, c_int32_t, c_int64_t, c_ptr
            implicit none
            type(c_ptr), value :: exposure
            character(kind=c_char), intent(in), optional :: folder(*)
            integer(c_int32_t), value :: sca
            integer(c_int64_t), value :: capacity
            character(kind=c_char), intent(inout), optional :: text(*)
            integer(c_int64_t), intent(inout), optional :: length
            integer(c_int32_t) :: outcome
        end function wfpsf_exposure_path

        function wfpsf_exposure_make(exposure, sca, folder, options, made) &
            bind(c, name="wfpsf_exposure_make") result(outcome)
            import :: c_char, c_int32_t, c_ptr
            implicit none
            type(c_ptr), value :: exposure
            integer(c_int32_t), value :: sca
            character(kind=c_char), intent(in), optional :: folder(*)
            type(c_ptr), value :: options
            integer(c_int32_t), intent(inout), optional :: made
            integer(c_int32_t) :: outcome
        end function wfpsf_exposure_make
    end interface

end module wfpsf_c
