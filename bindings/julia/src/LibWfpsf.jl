# SPDX-License-Identifier: GPL-3.0-or-later
# Made by bindings/generate.py from the headers in capi/include/wfpsf: change those.

"""
The C interface as it stands: every function and constant, described in the C headers. Positions
count from (0, 0) here, handles are `Ptr{Cvoid}`. [`load`](@ref) comes first.
"""
module LibWfpsf

using Libdl

# version.h
const WFPSF_VERSION_MAJOR = Int32(1)
const WFPSF_VERSION_MINOR = Int32(0)
const WFPSF_VERSION_PATCH = Int32(0)
const WFPSF_ABI_NUMBER = Int32(1)

const wfpsf_version_pointer = Ref(C_NULL)
function wfpsf_version()
    return ccall(wfpsf_version_pointer[], Cstring, ())
end

const wfpsf_abi_number_pointer = Ref(C_NULL)
function wfpsf_abi_number()
    return ccall(wfpsf_abi_number_pointer[], Int32, ())
end

const wfpsf_abi_check_pointer = Ref(C_NULL)
function wfpsf_abi_check(expected)
    return ccall(wfpsf_abi_check_pointer[], Int32, (Int32,),
        expected)
end

# status.h
const WFPSF_OK = Int32(0)
const WFPSF_WARNING_NOT_CONVERGED = Int32(100)
const WFPSF_WARNING_NOT_CERTIFIED = Int32(110)
const WFPSF_WARNING_RESTARTED = Int32(120)
const WFPSF_WARNING_NEAR_DEGENERATE = Int32(130)
const WFPSF_WARNING_UNDERSAMPLED = Int32(140)
const WFPSF_ERROR_NULL = Int32(-10)
const WFPSF_ERROR_ARGUMENT = Int32(-20)
const WFPSF_ERROR_RANGE = Int32(-30)
const WFPSF_ERROR_SIZE = Int32(-40)
const WFPSF_ERROR_TYPE = Int32(-50)
const WFPSF_ERROR_NOT_FINITE = Int32(-60)
const WFPSF_ERROR_UNKNOWN_NAME = Int32(-70)
const WFPSF_ERROR_OVERLAP = Int32(-80)
const WFPSF_ERROR_ALREADY_APPLIED = Int32(-90)
const WFPSF_ERROR_KERNEL = Int32(-100)
const WFPSF_ERROR_KERNEL_SINGULAR = Int32(-110)
const WFPSF_ERROR_SKY_SUN = Int32(-120)
const WFPSF_ERROR_SUN_ANGLE = Int32(-130)
const WFPSF_ERROR_NO_WCS = Int32(-140)
const WFPSF_ERROR_FILE_OPEN = Int32(-200)
const WFPSF_ERROR_FILE_FORMAT = Int32(-210)
const WFPSF_ERROR_FILE_WRITE = Int32(-220)
const WFPSF_ERROR_MOMENTS_NO_PIXELS = Int32(-300)
const WFPSF_ERROR_MOMENTS_FLUX = Int32(-310)
const WFPSF_ERROR_MOMENTS_UNRESOLVED = Int32(-320)
const WFPSF_ERROR_MOMENTS_FILLS_IMAGE = Int32(-330)
const WFPSF_ERROR_MOMENTS_OUTSIDE = Int32(-340)
const WFPSF_ERROR_MOMENTS_STALLED = Int32(-350)
const WFPSF_ERROR_SIZE_NOT_REACHED = Int32(-400)
const WFPSF_ERROR_CANCELLED = Int32(-500)
const WFPSF_ERROR_MEMORY_LIMIT = Int32(-510)
const WFPSF_ERROR_NO_MEMORY = Int32(-900)
const WFPSF_ERROR_INTERNAL = Int32(-910)
const WFPSF_ERROR_ABI = Int32(-920)

const wfpsf_status_name_pointer = Ref(C_NULL)
function wfpsf_status_name(status)
    return ccall(wfpsf_status_name_pointer[], Cstring, (Int32,),
        status)
end

const wfpsf_status_string_pointer = Ref(C_NULL)
function wfpsf_status_string(status)
    return ccall(wfpsf_status_string_pointer[], Cstring, (Int32,),
        status)
end

const wfpsf_last_error_pointer = Ref(C_NULL)
function wfpsf_last_error(buffer, length)
    return ccall(wfpsf_last_error_pointer[], Int64, (Ptr{UInt8}, Int64),
        buffer, length)
end

# options.h
const WFPSF_OPTION_EPS = Int32(100)
const WFPSF_OPTION_STRUTS = Int32(110)
const WFPSF_OPTION_PSF_RADIUS = Int32(120)
const WFPSF_OPTION_PISTON_TILT = Int32(130)
const WFPSF_OPTION_FRAME = Int32(140)
const WFPSF_OPTION_FIELD_RULE = Int32(150)
const WFPSF_OPTION_JITTER_XX = Int32(160)
const WFPSF_OPTION_JITTER_XY = Int32(161)
const WFPSF_OPTION_JITTER_YY = Int32(162)
const WFPSF_OPTION_CHARGE_DIFFUSION = Int32(170)
const WFPSF_OPTION_MASK_POINTS = Int32(180)
const WFPSF_OPTION_PIXEL_RESPONSE = Int32(190)
const WFPSF_OPTION_FORCE = Int32(200)
const WFPSF_OPTION_IPC_FILL = Int32(210)
const WFPSF_OPTION_KERNEL_NEGATIVE = Int32(220)
const WFPSF_OPTION_KERNEL_NORMALISE = Int32(230)
const WFPSF_OPTION_IPC_FORM = Int32(240)
const WFPSF_OPTION_IPC_LEAST_MARGIN = Int32(250)
const WFPSF_OPTION_IPC_TOLERANCE = Int32(260)
const WFPSF_OPTION_IPC_MAX_PASSES = Int32(270)
const WFPSF_OPTION_MOMENTS_TOLERANCE = Int32(300)
const WFPSF_OPTION_MOMENTS_MAX_PASSES = Int32(310)
const WFPSF_OPTION_MOMENTS_GUESS_X = Int32(320)
const WFPSF_OPTION_MOMENTS_GUESS_Y = Int32(330)
const WFPSF_OPTION_MOMENTS_GUESS_SIGMA = Int32(340)
const WFPSF_OPTION_MOMENTS_METHOD = Int32(350)
const WFPSF_OPTION_MOMENTS_BACKGROUND = Int32(360)
const WFPSF_OPTION_MOMENTS_VARIANCE = Int32(370)
const WFPSF_OPTION_MOMENTS_RESTART = Int32(380)
const WFPSF_OPTION_MOMENTS_COVARIANCE_ORDER = Int32(390)
const WFPSF_OPTION_SIZE_TOTAL_FLUX = Int32(400)
const WFPSF_OPTION_SIZE_BANDWIDTH = Int32(410)
const WFPSF_OPTION_SIZE_EPS = Int32(420)
const WFPSF_OPTION_FITS_OVERWRITE = Int32(500)
const WFPSF_OPTION_THREADS = Int32(600)
const WFPSF_OPTION_MEMORY_LIMIT = Int32(610)
const WFPSF_OPTION_SEED = Int32(700)
const WFPSF_OPTION_STREAM = Int32(710)
const WFPSF_OPTION_ORIGIN_X = Int32(720)
const WFPSF_OPTION_ORIGIN_Y = Int32(730)
const WFPSF_OPTION_NOISE = Int32(740)
const WFPSF_OPTION_WCS_RULE = Int32(800)
const WFPSF_OPTION_PA_OF_FPA = Int32(810)
const WFPSF_OPTION_SCENE_NOISE = Int32(900)
const WFPSF_OPTION_SCENE_VARIANCE = Int32(910)
const WFPSF_OPTION_SCENE_FLUX = Int32(920)
const WFPSF_OPTION_SCENE_BACKGROUND = Int32(930)
const WFPSF_OPTION_EXPOSURE_TIME = Int32(940)
const WFPSF_OPTION_SCENE_EXPOSURES = Int32(950)
const WFPSF_OPTION_REAL = Int32(1)
const WFPSF_OPTION_INTEGER = Int32(2)

const wfpsf_options_create_pointer = Ref(C_NULL)
function wfpsf_options_create(out)
    return ccall(wfpsf_options_create_pointer[], Int32, (Ptr{Ptr{Cvoid}},),
        out)
end

const wfpsf_options_destroy_pointer = Ref(C_NULL)
function wfpsf_options_destroy(options)
    return ccall(wfpsf_options_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        options)
end

const wfpsf_options_set_real_pointer = Ref(C_NULL)
function wfpsf_options_set_real(options, key, value)
    return ccall(wfpsf_options_set_real_pointer[], Int32, (Ptr{Cvoid}, Int32, Float64),
        options, key, value)
end

const wfpsf_options_set_integer_pointer = Ref(C_NULL)
function wfpsf_options_set_integer(options, key, value)
    return ccall(wfpsf_options_set_integer_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64),
        options, key, value)
end

const wfpsf_options_get_pointer = Ref(C_NULL)
function wfpsf_options_get(options, key, value)
    return ccall(wfpsf_options_get_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}),
        options, key, value)
end

const wfpsf_options_reset_pointer = Ref(C_NULL)
function wfpsf_options_reset(options, key)
    return ccall(wfpsf_options_reset_pointer[], Int32, (Ptr{Cvoid}, Int32),
        options, key)
end

const wfpsf_options_set_zernikes_pointer = Ref(C_NULL)
function wfpsf_options_set_zernikes(options, count, coefficients)
    return ccall(wfpsf_options_set_zernikes_pointer[], Int32, (Ptr{Cvoid}, Int64, Ptr{Float64}),
        options, count, coefficients)
end

const wfpsf_options_set_progress_pointer = Ref(C_NULL)
function wfpsf_options_set_progress(options, progress, user)
    return ccall(wfpsf_options_set_progress_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid}),
        options, progress, user)
end

const wfpsf_option_describe_pointer = Ref(C_NULL)
function wfpsf_option_describe(key, name, text, kind, standard, smallest, largest)
    return ccall(wfpsf_option_describe_pointer[], Int32, (Int32, Ptr{Cstring}, Ptr{Cstring},
        Ptr{Int32}, Ptr{Float64}, Ptr{Float64}, Ptr{Float64}),
        key, name, text, kind, standard, smallest, largest)
end

# image.h
const WFPSF_FLOAT32 = Int32(32)
const WFPSF_FLOAT64 = Int32(64)
const WFPSF_EFFECT_PIXEL_RESPONSE = Int32(1)
const WFPSF_EFFECT_IPC = Int32(2)
const WFPSF_EFFECT_IPC_CORRECTION = Int32(4)
const WFPSF_EFFECT_CHARGE_DIFFUSION = Int32(8)
const WFPSF_EFFECT_BACKGROUND = Int32(16)
const WFPSF_EFFECT_POISSON_NOISE = Int32(32)
const WFPSF_EFFECT_RECIPROCITY_FAILURE = Int32(64)
const WFPSF_EFFECT_DARK_CURRENT = Int32(128)
const WFPSF_EFFECT_PERSISTENCE = Int32(256)
const WFPSF_EFFECT_NONLINEARITY = Int32(512)
const WFPSF_EFFECT_NONLINEARITY_CORRECTION = Int32(1024)
const WFPSF_EFFECT_CAPACITANCE = Int32(2048)
const WFPSF_EFFECT_READ_NOISE = Int32(4096)
const WFPSF_EFFECT_GAIN = Int32(8192)
const WFPSF_DITHER_DETECTOR = Int32(1)
const WFPSF_DITHER_OBJECT = Int32(2)

const wfpsf_image_create_pointer = Ref(C_NULL)
function wfpsf_image_create(pixel_type, nx, ny, oversampling, out)
    return ccall(wfpsf_image_create_pointer[], Int32, (Int32, Int64, Int64, Int64, Ptr{Ptr{Cvoid}}),
        pixel_type, nx, ny, oversampling, out)
end

const wfpsf_image_wrap_pointer = Ref(C_NULL)
function wfpsf_image_wrap(pixel_type, data, nx, ny, stride_x, stride_y, oversampling, out)
    return ccall(wfpsf_image_wrap_pointer[], Int32, (Int32, Ptr{Cvoid}, Int64, Int64, Int64, Int64,
        Int64, Ptr{Ptr{Cvoid}}),
        pixel_type, data, nx, ny, stride_x, stride_y, oversampling, out)
end

const wfpsf_image_destroy_pointer = Ref(C_NULL)
function wfpsf_image_destroy(image)
    return ccall(wfpsf_image_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        image)
end

const wfpsf_image_shape_pointer = Ref(C_NULL)
function wfpsf_image_shape(image, pixel_type, nx, ny)
    return ccall(wfpsf_image_shape_pointer[], Int32, (Ptr{Cvoid}, Ptr{Int32}, Ptr{Int64},
        Ptr{Int64}),
        image, pixel_type, nx, ny)
end

const wfpsf_image_record_pointer = Ref(C_NULL)
function wfpsf_image_record(image, oversampling, pixel_scale_arcsec, applied)
    return ccall(wfpsf_image_record_pointer[], Int32, (Ptr{Cvoid}, Ptr{Int64}, Ptr{Float64},
        Ptr{Int32}),
        image, oversampling, pixel_scale_arcsec, applied)
end

const wfpsf_image_set_record_pointer = Ref(C_NULL)
function wfpsf_image_set_record(image, oversampling, pixel_scale_arcsec, applied)
    return ccall(wfpsf_image_set_record_pointer[], Int32, (Ptr{Cvoid}, Int64, Float64, Int32),
        image, oversampling, pixel_scale_arcsec, applied)
end

const wfpsf_image_copy_pointer = Ref(C_NULL)
function wfpsf_image_copy(from, to)
    return ccall(wfpsf_image_copy_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}),
        from, to)
end

const wfpsf_image_read_fits_pointer = Ref(C_NULL)
function wfpsf_image_read_fits(path, hdu, pixel_type, out)
    return ccall(wfpsf_image_read_fits_pointer[], Int32, (Cstring, Cstring, Int32, Ptr{Ptr{Cvoid}}),
        path, hdu, pixel_type, out)
end

const wfpsf_image_write_fits_pointer = Ref(C_NULL)
function wfpsf_image_write_fits(image, path, options)
    return ccall(wfpsf_image_write_fits_pointer[], Int32, (Ptr{Cvoid}, Cstring, Ptr{Cvoid}),
        image, path, options)
end

const wfpsf_image_interleave_pointer = Ref(C_NULL)
function wfpsf_image_interleave(n_x, n_y, images, dx, dy, convention, out)
    return ccall(wfpsf_image_interleave_pointer[], Int32, (Int64, Int64, Ptr{Ptr{Cvoid}},
        Ptr{Float64}, Ptr{Float64}, Int32, Ptr{Cvoid}),
        n_x, n_y, images, dx, dy, convention, out)
end

const wfpsf_image_deinterleave_pointer = Ref(C_NULL)
function wfpsf_image_deinterleave(image, n_x, n_y, dx, dy, convention, out)
    return ccall(wfpsf_image_deinterleave_pointer[], Int32, (Ptr{Cvoid}, Int64, Int64, Ptr{Float64},
        Ptr{Float64}, Int32, Ptr{Ptr{Cvoid}}),
        image, n_x, n_y, dx, dy, convention, out)
end

# instrument.h
const WFPSF_BAND_TABULATED = Int32(1)
const WFPSF_BAND_PAPER = Int32(2)

const wfpsf_instrument_create_pointer = Ref(C_NULL)
function wfpsf_instrument_create(name, out)
    return ccall(wfpsf_instrument_create_pointer[], Int32, (Cstring, Ptr{Ptr{Cvoid}}),
        name, out)
end

const wfpsf_instrument_destroy_pointer = Ref(C_NULL)
function wfpsf_instrument_destroy(instrument)
    return ccall(wfpsf_instrument_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        instrument)
end

const wfpsf_instrument_constant_pointer = Ref(C_NULL)
function wfpsf_instrument_constant(instrument, name, value, unit)
    return ccall(wfpsf_instrument_constant_pointer[], Int32, (Ptr{Cvoid}, Cstring, Ptr{Float64},
        Ptr{Cstring}),
        instrument, name, value, unit)
end

const wfpsf_instrument_constant_name_pointer = Ref(C_NULL)
function wfpsf_instrument_constant_name(instrument, index)
    return ccall(wfpsf_instrument_constant_name_pointer[], Cstring, (Ptr{Cvoid}, Int64),
        instrument, index)
end

const wfpsf_instrument_band_name_pointer = Ref(C_NULL)
function wfpsf_instrument_band_name(instrument, index)
    return ccall(wfpsf_instrument_band_name_pointer[], Cstring, (Ptr{Cvoid}, Int64),
        instrument, index)
end

const wfpsf_instrument_band_pointer = Ref(C_NULL)
function wfpsf_instrument_band(instrument, band, rule, blue_nm, red_nm, effective_nm)
    return ccall(wfpsf_instrument_band_pointer[], Int32, (Ptr{Cvoid}, Cstring, Int32, Ptr{Float64},
        Ptr{Float64}, Ptr{Float64}),
        instrument, band, rule, blue_nm, red_nm, effective_nm)
end

const wfpsf_instrument_throughput_pointer = Ref(C_NULL)
function wfpsf_instrument_throughput(instrument, band, count, wavelength_nm, throughput)
    return ccall(wfpsf_instrument_throughput_pointer[], Int32, (Ptr{Cvoid}, Cstring, Int64,
        Ptr{Float64}, Ptr{Float64}),
        instrument, band, count, wavelength_nm, throughput)
end

const wfpsf_instrument_zernikes_pointer = Ref(C_NULL)
function wfpsf_instrument_zernikes(instrument, sca, capacity, coefficients, count)
    return ccall(wfpsf_instrument_zernikes_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64,
        Ptr{Float64}, Ptr{Int64}),
        instrument, sca, capacity, coefficients, count)
end

const wfpsf_instrument_pupil_pointer = Ref(C_NULL)
function wfpsf_instrument_pupil(instrument, band, sca, options, out, scale_m, axis_x, axis_y)
    return ccall(wfpsf_instrument_pupil_pointer[], Int32, (Ptr{Cvoid}, Cstring, Int32, Ptr{Cvoid},
        Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}, Ptr{Float64}),
        instrument, band, sca, options, out, scale_m, axis_x, axis_y)
end

# design.h
const wfpsf_design_create_pointer = Ref(C_NULL)
function wfpsf_design_create(out)
    return ccall(wfpsf_design_create_pointer[], Int32, (Ptr{Ptr{Cvoid}},),
        out)
end

const wfpsf_design_destroy_pointer = Ref(C_NULL)
function wfpsf_design_destroy(design)
    return ccall(wfpsf_design_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        design)
end

const wfpsf_design_set_telescope_pointer = Ref(C_NULL)
function wfpsf_design_set_telescope(design, diameter_m, obscuration, reference_wavelength_nm)
    return ccall(wfpsf_design_set_telescope_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64,
        Float64),
        design, diameter_m, obscuration, reference_wavelength_nm)
end

const wfpsf_design_add_strut_pointer = Ref(C_NULL)
function wfpsf_design_add_strut(design, azimuth_deg, width_m, offset_m)
    return ccall(wfpsf_design_add_strut_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Float64),
        design, azimuth_deg, width_m, offset_m)
end

const wfpsf_design_set_detector_pointer = Ref(C_NULL)
function wfpsf_design_set_detector(design, sca_count, pixel_scale_arcsec, n_pix_x, n_pix_y)
    return ccall(wfpsf_design_set_detector_pointer[], Int32, (Ptr{Cvoid}, Int32, Float64, Int64,
        Int64),
        design, sca_count, pixel_scale_arcsec, n_pix_x, n_pix_y)
end

const wfpsf_design_set_zernikes_pointer = Ref(C_NULL)
function wfpsf_design_set_zernikes(design, sca, count, coefficients)
    return ccall(wfpsf_design_set_zernikes_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64,
        Ptr{Float64}),
        design, sca, count, coefficients)
end

const wfpsf_design_set_field_pointer = Ref(C_NULL)
function wfpsf_design_set_field(design, sca, x, y, count, coefficients)
    return ccall(wfpsf_design_set_field_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Float64},
        Ptr{Float64}, Int64, Ptr{Float64}),
        design, sca, x, y, count, coefficients)
end

const wfpsf_design_add_band_pointer = Ref(C_NULL)
function wfpsf_design_add_band(design, name, first_nm, step_nm, count, throughput)
    return ccall(wfpsf_design_add_band_pointer[], Int32, (Ptr{Cvoid}, Cstring, Float64, Float64,
        Int64, Ptr{Float64}),
        design, name, first_nm, step_nm, count, throughput)
end

const wfpsf_instrument_create_from_design_pointer = Ref(C_NULL)
function wfpsf_instrument_create_from_design(design, out)
    return ccall(wfpsf_instrument_create_from_design_pointer[], Int32, (Ptr{Cvoid},
        Ptr{Ptr{Cvoid}}),
        design, out)
end

# sed.h
const WFPSF_SED_PHOTONS = Int32(1)
const WFPSF_SED_ENERGY = Int32(2)

const wfpsf_sed_create_table_pointer = Ref(C_NULL)
function wfpsf_sed_create_table(unit, count, wavelength_nm, density, out)
    return ccall(wfpsf_sed_create_table_pointer[], Int32, (Int32, Int64, Ptr{Float64}, Ptr{Float64},
        Ptr{Ptr{Cvoid}}),
        unit, count, wavelength_nm, density, out)
end

const wfpsf_sed_create_power_law_pointer = Ref(C_NULL)
function wfpsf_sed_create_power_law(unit, exponent, out)
    return ccall(wfpsf_sed_create_power_law_pointer[], Int32, (Int32, Float64, Ptr{Ptr{Cvoid}}),
        unit, exponent, out)
end

const wfpsf_sed_create_black_body_pointer = Ref(C_NULL)
function wfpsf_sed_create_black_body(temperature_k, out)
    return ccall(wfpsf_sed_create_black_body_pointer[], Int32, (Float64, Ptr{Ptr{Cvoid}}),
        temperature_k, out)
end

const wfpsf_sed_create_redshifted_pointer = Ref(C_NULL)
function wfpsf_sed_create_redshifted(sed, redshift, out)
    return ccall(wfpsf_sed_create_redshifted_pointer[], Int32, (Ptr{Cvoid}, Float64,
        Ptr{Ptr{Cvoid}}),
        sed, redshift, out)
end

const wfpsf_sed_destroy_pointer = Ref(C_NULL)
function wfpsf_sed_destroy(sed)
    return ccall(wfpsf_sed_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        sed)
end

const wfpsf_sed_photon_density_pointer = Ref(C_NULL)
function wfpsf_sed_photon_density(sed, count, wavelength_nm, photons)
    return ccall(wfpsf_sed_photon_density_pointer[], Int32, (Ptr{Cvoid}, Int64, Ptr{Float64},
        Ptr{Float64}),
        sed, count, wavelength_nm, photons)
end

# psf.h
const WFPSF_PSF_WAVELENGTH_NM = Int32(10)
const WFPSF_PSF_PIXEL_SCALE_ARCSEC = Int32(20)
const WFPSF_PSF_ERROR_ESTIMATE = Int32(30)
const WFPSF_PSF_MODEL_ERROR = Int32(40)
const WFPSF_PSF_PEAK = Int32(50)
const WFPSF_PSF_NODES = Int32(60)
const WFPSF_PSF_GRID_SIZE = Int32(70)
const WFPSF_PSF_GRID_STEP_ARCSEC = Int32(80)
const WFPSF_PSF_RADIUS = Int32(90)
const WFPSF_PSF_LIT_AREA_M2 = Int32(100)
const WFPSF_PSF_WAVELENGTHS = Int32(110)

const wfpsf_options_set_opd_pointer = Ref(C_NULL)
function wfpsf_options_set_opd(options, map, scale_m, axis_x, axis_y)
    return ccall(wfpsf_options_set_opd_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Float64, Float64,
        Float64),
        options, map, scale_m, axis_x, axis_y)
end

const wfpsf_psf_create_pointer = Ref(C_NULL)
function wfpsf_psf_create(instrument, sca, wavelength_nm, options, out)
    return ccall(wfpsf_psf_create_pointer[], Int32, (Ptr{Cvoid}, Int32, Float64, Ptr{Cvoid},
        Ptr{Ptr{Cvoid}}),
        instrument, sca, wavelength_nm, options, out)
end

const wfpsf_psf_create_in_band_pointer = Ref(C_NULL)
function wfpsf_psf_create_in_band(instrument, band, sca, x, y, wavelength_nm, options, out)
    return ccall(wfpsf_psf_create_in_band_pointer[], Int32, (Ptr{Cvoid}, Cstring, Int32, Float64,
        Float64, Float64, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        instrument, band, sca, x, y, wavelength_nm, options, out)
end

const wfpsf_psf_create_chromatic_pointer = Ref(C_NULL)
function wfpsf_psf_create_chromatic(instrument, band, sca, x, y, count, seds, options, out)
    return ccall(wfpsf_psf_create_chromatic_pointer[], Int32, (Ptr{Cvoid}, Cstring, Int32, Float64,
        Float64, Int64, Ptr{Ptr{Cvoid}}, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        instrument, band, sca, x, y, count, seds, options, out)
end

const wfpsf_psf_create_from_mask_pointer = Ref(C_NULL)
function wfpsf_psf_create_from_mask(instrument, mask, mask_scale_m, axis_x, axis_y, sca,
    wavelength_nm, options, out)
    return ccall(wfpsf_psf_create_from_mask_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Float64,
        Float64, Float64, Int32, Float64, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        instrument, mask, mask_scale_m, axis_x, axis_y, sca, wavelength_nm, options, out)
end

const wfpsf_psf_destroy_pointer = Ref(C_NULL)
function wfpsf_psf_destroy(psf)
    return ccall(wfpsf_psf_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        psf)
end

const wfpsf_psf_draw_pointer = Ref(C_NULL)
function wfpsf_psf_draw(psf, x, y, flux, options, image)
    return ccall(wfpsf_psf_draw_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Float64,
        Ptr{Cvoid}, Ptr{Cvoid}),
        psf, x, y, flux, options, image)
end

const wfpsf_psf_add_bright_star_pointer = Ref(C_NULL)
function wfpsf_psf_add_bright_star(psf, x, y, flux, options, image)
    return ccall(wfpsf_psf_add_bright_star_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Float64,
        Ptr{Cvoid}, Ptr{Cvoid}),
        psf, x, y, flux, options, image)
end

const wfpsf_psf_draw_memory_pointer = Ref(C_NULL)
function wfpsf_psf_draw_memory(psf, x, y, image, least, most)
    return ccall(wfpsf_psf_draw_memory_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Ptr{Cvoid},
        Ptr{Int64}, Ptr{Int64}),
        psf, x, y, image, least, most)
end

const wfpsf_psf_add_stars_pointer = Ref(C_NULL)
function wfpsf_psf_add_stars(psf, count, x, y, flux, options, image)
    return ccall(wfpsf_psf_add_stars_pointer[], Int32, (Ptr{Cvoid}, Int64, Ptr{Float64},
        Ptr{Float64}, Ptr{Float64}, Ptr{Cvoid}, Ptr{Cvoid}),
        psf, count, x, y, flux, options, image)
end

const wfpsf_psf_convolve_pointer = Ref(C_NULL)
function wfpsf_psf_convolve(psf, galaxy, x, y, flux, options, image)
    return ccall(wfpsf_psf_convolve_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Float64, Float64,
        Float64, Ptr{Cvoid}, Ptr{Cvoid}),
        psf, galaxy, x, y, flux, options, image)
end

const wfpsf_psf_get_pointer = Ref(C_NULL)
function wfpsf_psf_get(psf, key, value)
    return ccall(wfpsf_psf_get_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}),
        psf, key, value)
end

# varying_psf.h
const WFPSF_VARYING_PSF_ERROR_ESTIMATE = Int32(10)
const WFPSF_VARYING_PSF_INTERPOLATION_ERROR = Int32(20)
const WFPSF_VARYING_PSF_DEGREE = Int32(30)
const WFPSF_VARYING_PSF_RANK = Int32(40)
const WFPSF_VARYING_PSF_EXACT_PSFS = Int32(50)
const WFPSF_VARYING_PSF_MEMORY_BYTES = Int32(60)
const WFPSF_VARYING_PSF_MARGIN = Int32(70)

const wfpsf_varying_psf_create_pointer = Ref(C_NULL)
function wfpsf_varying_psf_create(instrument, band, sca, wavelength_nm, sed, options, out)
    return ccall(wfpsf_varying_psf_create_pointer[], Int32, (Ptr{Cvoid}, Cstring, Int32, Float64,
        Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        instrument, band, sca, wavelength_nm, sed, options, out)
end

const wfpsf_varying_psf_destroy_pointer = Ref(C_NULL)
function wfpsf_varying_psf_destroy(varying)
    return ccall(wfpsf_varying_psf_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        varying)
end

const wfpsf_varying_psf_at_pointer = Ref(C_NULL)
function wfpsf_varying_psf_at(varying, x, y, out)
    return ccall(wfpsf_varying_psf_at_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64,
        Ptr{Ptr{Cvoid}}),
        varying, x, y, out)
end

const wfpsf_varying_psf_add_stars_pointer = Ref(C_NULL)
function wfpsf_varying_psf_add_stars(varying, x0, y0, count, x, y, flux, options, image)
    return ccall(wfpsf_varying_psf_add_stars_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Int64,
        Ptr{Float64}, Ptr{Float64}, Ptr{Float64}, Ptr{Cvoid}, Ptr{Cvoid}),
        varying, x0, y0, count, x, y, flux, options, image)
end

const wfpsf_varying_psf_get_pointer = Ref(C_NULL)
function wfpsf_varying_psf_get(varying, key, value)
    return ccall(wfpsf_varying_psf_get_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}),
        varying, key, value)
end

# otf.h
const WFPSF_OTF_ERROR_ESTIMATE = Int32(10)
const WFPSF_OTF_VALUE_ERROR = Int32(20)
const WFPSF_OTF_CUTOFF = Int32(30)
const WFPSF_OTF_PIXELS = Int32(40)
const WFPSF_RESPONSE_DIFFRACTION = Int32(1)
const WFPSF_RESPONSE_EFFECTIVE = Int32(2)
const WFPSF_ORDER_CENTRED = Int32(1)
const WFPSF_ORDER_WRAPPED = Int32(2)
const WFPSF_ORDER_HALF = Int32(3)

const wfpsf_otf_create_pointer = Ref(C_NULL)
function wfpsf_otf_create(psf, options, out)
    return ccall(wfpsf_otf_create_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        psf, options, out)
end

const wfpsf_otf_destroy_pointer = Ref(C_NULL)
function wfpsf_otf_destroy(otf)
    return ccall(wfpsf_otf_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        otf)
end

const wfpsf_otf_values_pointer = Ref(C_NULL)
function wfpsf_otf_values(otf, response, count, kx, ky, re, im)
    return ccall(wfpsf_otf_values_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64, Ptr{Float64},
        Ptr{Float64}, Ptr{Float64}, Ptr{Float64}),
        otf, response, count, kx, ky, re, im)
end

const wfpsf_otf_grid_pointer = Ref(C_NULL)
function wfpsf_otf_grid(otf, response, order, step, re, im)
    return ccall(wfpsf_otf_grid_pointer[], Int32, (Ptr{Cvoid}, Int32, Int32, Float64, Ptr{Cvoid},
        Ptr{Cvoid}),
        otf, response, order, step, re, im)
end

const wfpsf_otf_get_pointer = Ref(C_NULL)
function wfpsf_otf_get(otf, key, value)
    return ccall(wfpsf_otf_get_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}),
        otf, key, value)
end

# ipc.h
const WFPSF_KERNEL_SUM = Int32(10)
const WFPSF_KERNEL_CENTROID_X = Int32(20)
const WFPSF_KERNEL_CENTROID_Y = Int32(30)
const WFPSF_KERNEL_MXX = Int32(40)
const WFPSF_KERNEL_MXY = Int32(50)
const WFPSF_KERNEL_MYY = Int32(60)
const WFPSF_KERNEL_LEFT_RIGHT = Int32(100)
const WFPSF_KERNEL_UP_DOWN = Int32(110)
const WFPSF_KERNEL_HALF_TURN = Int32(120)
const WFPSF_KERNEL_TRANSPOSED = Int32(130)
const WFPSF_KERNEL_MARGIN = Int32(200)
const WFPSF_KERNEL_MARGIN_FREQUENCY_X = Int32(210)
const WFPSF_KERNEL_MARGIN_FREQUENCY_Y = Int32(220)
const WFPSF_KERNEL_VARIANCE_RATIO = Int32(300)
const WFPSF_KERNEL_CONVERSION_GAIN_BIAS = Int32(310)
const WFPSF_KERNEL_QUANTUM_EFFICIENCY_BIAS = Int32(320)
const WFPSF_KERNEL_INVERSE_NOISE = Int32(330)
const WFPSF_IPC_SCATTER = Int32(0)
const WFPSF_IPC_GATHER = Int32(1)
const WFPSF_EDGE_ZERO = Int32(0)
const WFPSF_EDGE_REPLICATE = Int32(1)
const WFPSF_EDGE_WRAP = Int32(2)
const WFPSF_EDGE_CROP = Int32(3)
const WFPSF_EDGE_FILL = Int32(4)
const WFPSF_EDGE_VALID = Int32(5)

const wfpsf_ipc_kernel_create_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_create(alpha, alpha_prime, alpha_plus, options, out)
    return ccall(wfpsf_ipc_kernel_create_pointer[], Int32, (Float64, Float64, Float64, Ptr{Cvoid},
        Ptr{Ptr{Cvoid}}),
        alpha, alpha_prime, alpha_plus, options, out)
end

const wfpsf_ipc_kernel_create_taps_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_create_taps(nx, ny, taps, options, out)
    return ccall(wfpsf_ipc_kernel_create_taps_pointer[], Int32, (Int64, Int64, Ptr{Float64},
        Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        nx, ny, taps, options, out)
end

const wfpsf_ipc_kernel_create_wfc3_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_create_wfc3(out)
    return ccall(wfpsf_ipc_kernel_create_wfc3_pointer[], Int32, (Ptr{Ptr{Cvoid}},),
        out)
end

const wfpsf_ipc_kernel_create_default_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_create_default(instrument, out)
    return ccall(wfpsf_ipc_kernel_create_default_pointer[], Int32, (Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        instrument, out)
end

const wfpsf_ipc_kernel_create_correction_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_create_correction(kernel, out)
    return ccall(wfpsf_ipc_kernel_create_correction_pointer[], Int32, (Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        kernel, out)
end

const wfpsf_ipc_kernel_create_flipped_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_create_flipped(kernel, out)
    return ccall(wfpsf_ipc_kernel_create_flipped_pointer[], Int32, (Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        kernel, out)
end

const wfpsf_ipc_kernel_read_fits_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_read_fits(path, hdu, options, out)
    return ccall(wfpsf_ipc_kernel_read_fits_pointer[], Int32, (Cstring, Cstring, Ptr{Cvoid},
        Ptr{Ptr{Cvoid}}),
        path, hdu, options, out)
end

const wfpsf_ipc_kernel_create_composed_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_create_composed(first, second, out)
    return ccall(wfpsf_ipc_kernel_create_composed_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid},
        Ptr{Ptr{Cvoid}}),
        first, second, out)
end

const wfpsf_ipc_kernel_create_neumann_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_create_neumann(kernel, order, out)
    return ccall(wfpsf_ipc_kernel_create_neumann_pointer[], Int32, (Ptr{Cvoid}, Int64,
        Ptr{Ptr{Cvoid}}),
        kernel, order, out)
end

const wfpsf_ipc_kernel_create_autocorrelation_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_create_autocorrelation(kernel, out)
    return ccall(wfpsf_ipc_kernel_create_autocorrelation_pointer[], Int32, (Ptr{Cvoid},
        Ptr{Ptr{Cvoid}}),
        kernel, out)
end

const wfpsf_ipc_wfc3_deviations_pointer = Ref(C_NULL)
function wfpsf_ipc_wfc3_deviations(capacity, deviations)
    return ccall(wfpsf_ipc_wfc3_deviations_pointer[], Int32, (Int64, Ptr{Float64}),
        capacity, deviations)
end

const wfpsf_ipc_kernel_destroy_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_destroy(kernel)
    return ccall(wfpsf_ipc_kernel_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        kernel)
end

const wfpsf_ipc_kernel_taps_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_taps(kernel, capacity, taps, nx, ny)
    return ccall(wfpsf_ipc_kernel_taps_pointer[], Int32, (Ptr{Cvoid}, Int64, Ptr{Float64},
        Ptr{Int64}, Ptr{Int64}),
        kernel, capacity, taps, nx, ny)
end

const wfpsf_ipc_kernel_get_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_get(kernel, key, value)
    return ccall(wfpsf_ipc_kernel_get_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}),
        kernel, key, value)
end

const wfpsf_ipc_kernel_transform_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_transform(kernel, frequency_x, frequency_y, real_part, imaginary_part)
    return ccall(wfpsf_ipc_kernel_transform_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64,
        Ptr{Float64}, Ptr{Float64}),
        kernel, frequency_x, frequency_y, real_part, imaginary_part)
end

const wfpsf_ipc_apply_pointer = Ref(C_NULL)
function wfpsf_ipc_apply(kernel, input, edge, options, out, not_finite)
    return ccall(wfpsf_ipc_apply_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int32, Ptr{Cvoid},
        Ptr{Cvoid}, Ptr{Int64}),
        kernel, input, edge, options, out, not_finite)
end

const wfpsf_ipc_kernel_self_test_pointer = Ref(C_NULL)
function wfpsf_ipc_kernel_self_test(kernel, options, capacity, response)
    return ccall(wfpsf_ipc_kernel_self_test_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int64,
        Ptr{Float64}),
        kernel, options, capacity, response)
end

const wfpsf_ipc_correct_pointer = Ref(C_NULL)
function wfpsf_ipc_correct(kernel, input, edge, options, out, residual, noise_amplification, passes,
    not_finite)
    return ccall(wfpsf_ipc_correct_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int32, Ptr{Cvoid},
        Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}, Ptr{Int64}, Ptr{Int64}),
        kernel, input, edge, options, out, residual, noise_amplification, passes, not_finite)
end

const wfpsf_ipc_covariance_pointer = Ref(C_NULL)
function wfpsf_ipc_covariance(kernel, variance, lag_x, lag_y, edge, options, out)
    return ccall(wfpsf_ipc_covariance_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int64, Int64,
        Int32, Ptr{Cvoid}, Ptr{Cvoid}),
        kernel, variance, lag_x, lag_y, edge, options, out)
end

# varying_ipc.h
const wfpsf_varying_ipc_create_maps_pointer = Ref(C_NULL)
function wfpsf_varying_ipc_create_maps(alpha, alpha_prime, alpha_plus, options, out)
    return ccall(wfpsf_varying_ipc_create_maps_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid},
        Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        alpha, alpha_prime, alpha_plus, options, out)
end

const wfpsf_varying_ipc_create_polynomials_pointer = Ref(C_NULL)
function wfpsf_varying_ipc_create_polynomials(nx, ny, degree, alpha, alpha_prime, alpha_plus,
    options, out)
    return ccall(wfpsf_varying_ipc_create_polynomials_pointer[], Int32, (Int64, Int64, Int64,
        Ptr{Float64}, Ptr{Float64}, Ptr{Float64}, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        nx, ny, degree, alpha, alpha_prime, alpha_plus, options, out)
end

const wfpsf_varying_ipc_create_regions_pointer = Ref(C_NULL)
function wfpsf_varying_ipc_create_regions(regions, count, kernels, out)
    return ccall(wfpsf_varying_ipc_create_regions_pointer[], Int32, (Ptr{Cvoid}, Int64,
        Ptr{Ptr{Cvoid}}, Ptr{Ptr{Cvoid}}),
        regions, count, kernels, out)
end

const wfpsf_varying_ipc_destroy_pointer = Ref(C_NULL)
function wfpsf_varying_ipc_destroy(varying)
    return ccall(wfpsf_varying_ipc_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        varying)
end

const wfpsf_varying_ipc_kernel_pointer = Ref(C_NULL)
function wfpsf_varying_ipc_kernel(varying, x, y, out)
    return ccall(wfpsf_varying_ipc_kernel_pointer[], Int32, (Ptr{Cvoid}, Int64, Int64,
        Ptr{Ptr{Cvoid}}),
        varying, x, y, out)
end

const wfpsf_varying_ipc_margin_pointer = Ref(C_NULL)
function wfpsf_varying_ipc_margin(varying, margin, x, y)
    return ccall(wfpsf_varying_ipc_margin_pointer[], Int32, (Ptr{Cvoid}, Ptr{Float64}, Ptr{Int64},
        Ptr{Int64}),
        varying, margin, x, y)
end

const wfpsf_varying_ipc_apply_pointer = Ref(C_NULL)
function wfpsf_varying_ipc_apply(varying, input, edge, options, out, not_finite)
    return ccall(wfpsf_varying_ipc_apply_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int32,
        Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Int64}),
        varying, input, edge, options, out, not_finite)
end

const wfpsf_varying_ipc_correct_pointer = Ref(C_NULL)
function wfpsf_varying_ipc_correct(varying, input, edge, options, out, residual,
    noise_amplification, passes, not_finite)
    return ccall(wfpsf_varying_ipc_correct_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int32,
        Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}, Ptr{Int64}, Ptr{Int64}),
        varying, input, edge, options, out, residual, noise_amplification, passes, not_finite)
end

const wfpsf_varying_ipc_covariance_pointer = Ref(C_NULL)
function wfpsf_varying_ipc_covariance(varying, variance, lag_x, lag_y, edge, options, out)
    return ccall(wfpsf_varying_ipc_covariance_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int64,
        Int64, Int32, Ptr{Cvoid}, Ptr{Cvoid}),
        varying, variance, lag_x, lag_y, edge, options, out)
end

const wfpsf_varying_ipc_autocorrelation_pointer = Ref(C_NULL)
function wfpsf_varying_ipc_autocorrelation(varying, variance, x, y, edge, options, capacity,
    covariances, nx, ny)
    return ccall(wfpsf_varying_ipc_autocorrelation_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int64,
        Int64, Int32, Ptr{Cvoid}, Int64, Ptr{Float64}, Ptr{Int64}, Ptr{Int64}),
        varying, variance, x, y, edge, options, capacity, covariances, nx, ny)
end

# chain.h
const WFPSF_STEP_CLIP_NEGATIVE = Int32(10)
const WFPSF_STEP_CHARGE_DIFFUSION = Int32(20)
const WFPSF_STEP_BACKGROUND = Int32(30)
const WFPSF_STEP_POISSON_NOISE = Int32(40)
const WFPSF_STEP_QUANTISATION = Int32(50)
const WFPSF_STEP_RECIPROCITY_FAILURE = Int32(60)
const WFPSF_STEP_DARK_CURRENT = Int32(70)
const WFPSF_STEP_DARK_CURRENT_MAP = Int32(71)
const WFPSF_STEP_PERSISTENCE_LINEAR = Int32(80)
const WFPSF_STEP_PERSISTENCE_FERMI = Int32(81)
const WFPSF_STEP_NONLINEARITY = Int32(90)
const WFPSF_STEP_NONLINEARITY_INVERSE = Int32(100)
const WFPSF_STEP_CAPACITANCE_MAP = Int32(110)
const WFPSF_STEP_IPC = Int32(120)
const WFPSF_STEP_READ_NOISE = Int32(130)
const WFPSF_STEP_SATURATION = Int32(140)
const WFPSF_STEP_GAIN = Int32(150)
const WFPSF_STEP_PIXEL_MASK = Int32(160)

const wfpsf_chain_create_pointer = Ref(C_NULL)
function wfpsf_chain_create(out)
    return ccall(wfpsf_chain_create_pointer[], Int32, (Ptr{Ptr{Cvoid}},),
        out)
end

const wfpsf_chain_create_default_pointer = Ref(C_NULL)
function wfpsf_chain_create_default(instrument, exposure_time, out)
    return ccall(wfpsf_chain_create_default_pointer[], Int32, (Ptr{Cvoid}, Float64,
        Ptr{Ptr{Cvoid}}),
        instrument, exposure_time, out)
end

const wfpsf_chain_destroy_pointer = Ref(C_NULL)
function wfpsf_chain_destroy(chain)
    return ccall(wfpsf_chain_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        chain)
end

const wfpsf_chain_add_pointer = Ref(C_NULL)
function wfpsf_chain_add(chain, step, count, parameters)
    return ccall(wfpsf_chain_add_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64, Ptr{Float64}),
        chain, step, count, parameters)
end

const wfpsf_chain_add_ipc_pointer = Ref(C_NULL)
function wfpsf_chain_add_ipc(chain, kernel, edge)
    return ccall(wfpsf_chain_add_ipc_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int32),
        chain, kernel, edge)
end

const wfpsf_chain_add_varying_ipc_pointer = Ref(C_NULL)
function wfpsf_chain_add_varying_ipc(chain, varying, form, edge)
    return ccall(wfpsf_chain_add_varying_ipc_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int32,
        Int32),
        chain, varying, form, edge)
end

const wfpsf_chain_add_map_pointer = Ref(C_NULL)
function wfpsf_chain_add_map(chain, step, count, parameters, map)
    return ccall(wfpsf_chain_add_map_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64, Ptr{Float64},
        Ptr{Cvoid}),
        chain, step, count, parameters, map)
end

const wfpsf_chain_step_pointer = Ref(C_NULL)
function wfpsf_chain_step(chain, index, capacity, parameters, count, step)
    return ccall(wfpsf_chain_step_pointer[], Int32, (Ptr{Cvoid}, Int64, Int64, Ptr{Float64},
        Ptr{Int64}, Ptr{Int32}),
        chain, index, capacity, parameters, count, step)
end

const wfpsf_step_name_pointer = Ref(C_NULL)
function wfpsf_step_name(step)
    return ccall(wfpsf_step_name_pointer[], Cstring, (Int32,),
        step)
end

const wfpsf_chain_apply_pointer = Ref(C_NULL)
function wfpsf_chain_apply(chain, image, previous_count, previous, options, not_finite, saturated)
    return ccall(wfpsf_chain_apply_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int64,
        Ptr{Ptr{Cvoid}}, Ptr{Cvoid}, Ptr{Int64}, Ptr{Int64}),
        chain, image, previous_count, previous, options, not_finite, saturated)
end

const wfpsf_noise_add_pointer = Ref(C_NULL)
function wfpsf_noise_add(image, rms, kernel, options)
    return ccall(wfpsf_noise_add_pointer[], Int32, (Ptr{Cvoid}, Float64, Ptr{Cvoid}, Ptr{Cvoid}),
        image, rms, kernel, options)
end

# sky.h
const wfpsf_sky_level_pointer = Ref(C_NULL)
function wfpsf_sky_level(instrument, band, longitude, latitude, level)
    return ccall(wfpsf_sky_level_pointer[], Int32, (Ptr{Cvoid}, Cstring, Float64, Float64,
        Ptr{Float64}),
        instrument, band, longitude, latitude, level)
end

const wfpsf_sky_background_pointer = Ref(C_NULL)
function wfpsf_sky_background(instrument, band, longitude, latitude, exposure_time, pixel_area,
    electrons)
    return ccall(wfpsf_sky_background_pointer[], Int32, (Ptr{Cvoid}, Cstring, Float64, Float64,
        Float64, Float64, Ptr{Float64}),
        instrument, band, longitude, latitude, exposure_time, pixel_area, electrons)
end

# observation.h
const WFPSF_OBSERVATION_RA = Int32(10)
const WFPSF_OBSERVATION_DEC = Int32(20)
const WFPSF_OBSERVATION_PA = Int32(30)
const WFPSF_OBSERVATION_PA_FPA = Int32(40)
const WFPSF_OBSERVATION_CRPIX1 = Int32(100)
const WFPSF_OBSERVATION_CRPIX2 = Int32(110)
const WFPSF_OBSERVATION_CRVAL1 = Int32(120)
const WFPSF_OBSERVATION_CRVAL2 = Int32(130)
const WFPSF_OBSERVATION_CD1_1 = Int32(140)
const WFPSF_OBSERVATION_CD1_2 = Int32(150)
const WFPSF_OBSERVATION_CD2_1 = Int32(160)
const WFPSF_OBSERVATION_CD2_2 = Int32(170)
const WFPSF_OBSERVATION_ORIENTAT = Int32(180)

const wfpsf_observation_create_pointer = Ref(C_NULL)
function wfpsf_observation_create(instrument, ra_deg, dec_deg, pa_deg, options, out)
    return ccall(wfpsf_observation_create_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Float64,
        Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        instrument, ra_deg, dec_deg, pa_deg, options, out)
end

const wfpsf_observation_create_on_date_pointer = Ref(C_NULL)
function wfpsf_observation_create_on_date(instrument, ra_deg, dec_deg, julian_date, options, out)
    return ccall(wfpsf_observation_create_on_date_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64,
        Float64, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        instrument, ra_deg, dec_deg, julian_date, options, out)
end

const wfpsf_observation_create_aimed_pointer = Ref(C_NULL)
function wfpsf_observation_create_aimed(instrument, sca, x, y, ra_deg, dec_deg, pa_deg, options,
    out)
    return ccall(wfpsf_observation_create_aimed_pointer[], Int32, (Ptr{Cvoid}, Int32, Float64,
        Float64, Float64, Float64, Float64, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        instrument, sca, x, y, ra_deg, dec_deg, pa_deg, options, out)
end

const wfpsf_observation_destroy_pointer = Ref(C_NULL)
function wfpsf_observation_destroy(observation)
    return ccall(wfpsf_observation_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        observation)
end

const wfpsf_observation_get_pointer = Ref(C_NULL)
function wfpsf_observation_get(observation, sca, key, value)
    return ccall(wfpsf_observation_get_pointer[], Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{Float64}),
        observation, sca, key, value)
end

const wfpsf_observation_sky_to_pixel_pointer = Ref(C_NULL)
function wfpsf_observation_sky_to_pixel(observation, sca, count, ra_deg, dec_deg, x, y, undefined)
    return ccall(wfpsf_observation_sky_to_pixel_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64,
        Ptr{Float64}, Ptr{Float64}, Ptr{Float64}, Ptr{Float64}, Ptr{Int64}),
        observation, sca, count, ra_deg, dec_deg, x, y, undefined)
end

const wfpsf_observation_pixel_to_sky_pointer = Ref(C_NULL)
function wfpsf_observation_pixel_to_sky(observation, sca, count, x, y, ra_deg, dec_deg, undefined)
    return ccall(wfpsf_observation_pixel_to_sky_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64,
        Ptr{Float64}, Ptr{Float64}, Ptr{Float64}, Ptr{Float64}, Ptr{Int64}),
        observation, sca, count, x, y, ra_deg, dec_deg, undefined)
end

const wfpsf_observation_find_sca_pointer = Ref(C_NULL)
function wfpsf_observation_find_sca(observation, with_gaps, count, ra_deg, dec_deg, sca, x, y,
    found)
    return ccall(wfpsf_observation_find_sca_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64,
        Ptr{Float64}, Ptr{Float64}, Ptr{Int32}, Ptr{Float64}, Ptr{Float64}, Ptr{Int64}),
        observation, with_gaps, count, ra_deg, dec_deg, sca, x, y, found)
end

const wfpsf_observation_bounds_pointer = Ref(C_NULL)
function wfpsf_observation_bounds(observation, sca, with_gaps, x_first, x_last, y_first, y_last)
    return ccall(wfpsf_observation_bounds_pointer[], Int32, (Ptr{Cvoid}, Int32, Int32, Ptr{Int64},
        Ptr{Int64}, Ptr{Int64}, Ptr{Int64}),
        observation, sca, with_gaps, x_first, x_last, y_first, y_last)
end

const wfpsf_observation_jacobian_pointer = Ref(C_NULL)
function wfpsf_observation_jacobian(observation, sca, count, x, y, jacobian, pixel_area,
    y_angle_deg, undefined)
    return ccall(wfpsf_observation_jacobian_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64,
        Ptr{Float64}, Ptr{Float64}, Ptr{Float64}, Ptr{Float64}, Ptr{Float64}, Ptr{Int64}),
        observation, sca, count, x, y, jacobian, pixel_area, y_angle_deg, undefined)
end

const wfpsf_observation_fits_header_pointer = Ref(C_NULL)
function wfpsf_observation_fits_header(observation, sca, capacity, text, length)
    return ccall(wfpsf_observation_fits_header_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64,
        Ptr{UInt8}, Ptr{Int64}),
        observation, sca, capacity, text, length)
end

const wfpsf_julian_date_pointer = Ref(C_NULL)
function wfpsf_julian_date(year, month, day, hour, minute, second, julian_date)
    return ccall(wfpsf_julian_date_pointer[], Int32, (Int32, Int32, Int32, Int32, Int32, Float64,
        Ptr{Float64}),
        year, month, day, hour, minute, second, julian_date)
end

const wfpsf_sun_position_pointer = Ref(C_NULL)
function wfpsf_sun_position(julian_date, options, ra_deg, dec_deg)
    return ccall(wfpsf_sun_position_pointer[], Int32, (Float64, Ptr{Cvoid}, Ptr{Float64},
        Ptr{Float64}),
        julian_date, options, ra_deg, dec_deg)
end

const wfpsf_pointing_allowed_pointer = Ref(C_NULL)
function wfpsf_pointing_allowed(instrument, ra_deg, dec_deg, julian_date, options, sun_angle_deg,
    allowed)
    return ccall(wfpsf_pointing_allowed_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Float64,
        Ptr{Cvoid}, Ptr{Float64}, Ptr{Int32}),
        instrument, ra_deg, dec_deg, julian_date, options, sun_angle_deg, allowed)
end

const wfpsf_pointing_best_pa_pointer = Ref(C_NULL)
function wfpsf_pointing_best_pa(instrument, ra_deg, dec_deg, julian_date, options, pa_deg)
    return ccall(wfpsf_pointing_best_pa_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Float64,
        Ptr{Cvoid}, Ptr{Float64}),
        instrument, ra_deg, dec_deg, julian_date, options, pa_deg)
end

# moments.h
const WFPSF_MOMENTS_CENTROID_X = Int32(10)
const WFPSF_MOMENTS_CENTROID_Y = Int32(20)
const WFPSF_MOMENTS_MXX = Int32(30)
const WFPSF_MOMENTS_MXY = Int32(40)
const WFPSF_MOMENTS_MYY = Int32(50)
const WFPSF_MOMENTS_SIGMA = Int32(60)
const WFPSF_MOMENTS_SIGMA_TRACE = Int32(70)
const WFPSF_MOMENTS_E1 = Int32(80)
const WFPSF_MOMENTS_E2 = Int32(90)
const WFPSF_MOMENTS_E = Int32(100)
const WFPSF_MOMENTS_BETA = Int32(110)
const WFPSF_MOMENTS_FLUX = Int32(120)
const WFPSF_MOMENTS_RHO4 = Int32(130)
const WFPSF_MOMENTS_PASSES = Int32(140)
const WFPSF_MOMENTS_ERROR_ESTIMATE = Int32(150)
const WFPSF_MOMENTS_RESIDUAL = Int32(160)
const WFPSF_MOMENTS_CURVATURE = Int32(170)
const WFPSF_MOMENTS_EDGE_FRACTION = Int32(180)
const WFPSF_MOMENTS_MISSING_FRACTION = Int32(190)
const WFPSF_MOMENTS_AMPLITUDE = Int32(200)
const WFPSF_MOMENTS_LAST_STEP = Int32(210)
const WFPSF_MOMENTS_PIXELS = Int32(220)
const WFPSF_MOMENTS_BACKGROUND = Int32(230)

const wfpsf_moments_measure_pointer = Ref(C_NULL)
function wfpsf_moments_measure(image, options, out)
    return ccall(wfpsf_moments_measure_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        image, options, out)
end

const wfpsf_moments_measure_masked_pointer = Ref(C_NULL)
function wfpsf_moments_measure_masked(image, missing, variance, options, out)
    return ccall(wfpsf_moments_measure_masked_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid},
        Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        image, missing, variance, options, out)
end

const wfpsf_moments_measure_weighted_pointer = Ref(C_NULL)
function wfpsf_moments_measure_weighted(image, x, y, Mxx, Mxy, Myy, out)
    return ccall(wfpsf_moments_measure_weighted_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64,
        Float64, Float64, Float64, Ptr{Ptr{Cvoid}}),
        image, x, y, Mxx, Mxy, Myy, out)
end

const wfpsf_moments_sums_pointer = Ref(C_NULL)
function wfpsf_moments_sums(image, x, y, weight, count, sums)
    return ccall(wfpsf_moments_sums_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Ptr{Float64},
        Int64, Ptr{Float64}),
        image, x, y, weight, count, sums)
end

const wfpsf_moments_measure_unweighted_pointer = Ref(C_NULL)
function wfpsf_moments_measure_unweighted(image, x, y, out)
    return ccall(wfpsf_moments_measure_unweighted_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64,
        Ptr{Ptr{Cvoid}}),
        image, x, y, out)
end

const wfpsf_moments_destroy_pointer = Ref(C_NULL)
function wfpsf_moments_destroy(moments)
    return ccall(wfpsf_moments_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        moments)
end

const wfpsf_moments_status_pointer = Ref(C_NULL)
function wfpsf_moments_status(moments)
    return ccall(wfpsf_moments_status_pointer[], Int32, (Ptr{Cvoid},),
        moments)
end

const wfpsf_moments_get_pointer = Ref(C_NULL)
function wfpsf_moments_get(moments, key, value)
    return ccall(wfpsf_moments_get_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}),
        moments, key, value)
end

const wfpsf_moments_covariance_pointer = Ref(C_NULL)
function wfpsf_moments_covariance(moments, key_a, key_b, value)
    return ccall(wfpsf_moments_covariance_pointer[], Int32, (Ptr{Cvoid}, Int32, Int32,
        Ptr{Float64}),
        moments, key_a, key_b, value)
end

const wfpsf_moments_differentiate_pointer = Ref(C_NULL)
function wfpsf_moments_differentiate(moments, image, change, second, out)
    return ccall(wfpsf_moments_differentiate_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid},
        Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        moments, image, change, second, out)
end

const wfpsf_moments_influence_pointer = Ref(C_NULL)
function wfpsf_moments_influence(moments, image, key, influence)
    return ccall(wfpsf_moments_influence_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Int32,
        Ptr{Cvoid}),
        moments, image, key, influence)
end

# size.h
const WFPSF_SIZE_BANDLIMITED = Int32(1)
const WFPSF_SIZE_PIXEL_SUM = Int32(2)
const WFPSF_SIZE_PIXEL_INTERPOLATED = Int32(3)

const wfpsf_size_encircled_energy_pointer = Ref(C_NULL)
function wfpsf_size_encircled_energy(image, x, y, radius, options, fraction, error)
    return ccall(wfpsf_size_encircled_energy_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64,
        Float64, Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}),
        image, x, y, radius, options, fraction, error)
end

const wfpsf_size_ee_radius_pointer = Ref(C_NULL)
function wfpsf_size_ee_radius(image, x, y, fraction, method, options, radius, error)
    return ccall(wfpsf_size_ee_radius_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Float64,
        Int32, Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}),
        image, x, y, fraction, method, options, radius, error)
end

const wfpsf_size_fwhm_pointer = Ref(C_NULL)
function wfpsf_size_fwhm(image, x, y, fwhm)
    return ccall(wfpsf_size_fwhm_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Ptr{Float64}),
        image, x, y, fwhm)
end

const wfpsf_size_ee_radius_derivative_pointer = Ref(C_NULL)
function wfpsf_size_ee_radius_derivative(image, change, second, x, y, fraction, options, derivative,
    error)
    return ccall(wfpsf_size_ee_radius_derivative_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid},
        Ptr{Cvoid}, Float64, Float64, Float64, Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}),
        image, change, second, x, y, fraction, options, derivative, error)
end

const wfpsf_size_profile_pointer = Ref(C_NULL)
function wfpsf_size_profile(image, x, y, count, radii, options, profile, errors)
    return ccall(wfpsf_size_profile_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64, Int64,
        Ptr{Float64}, Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}),
        image, x, y, count, radii, options, profile, errors)
end

const wfpsf_size_profile_fwhm_pointer = Ref(C_NULL)
function wfpsf_size_profile_fwhm(image, x, y, options, fwhm, error)
    return ccall(wfpsf_size_profile_fwhm_pointer[], Int32, (Ptr{Cvoid}, Float64, Float64,
        Ptr{Cvoid}, Ptr{Float64}, Ptr{Float64}),
        image, x, y, options, fwhm, error)
end

# study.h
const WFPSF_STUDY_BANDS = Int32(10)
const WFPSF_STUDY_SIZES = Int32(20)
const WFPSF_STUDY_SENSITIVITIES = Int32(30)
const WFPSF_STUDY_LINEAR_LAW = Int32(40)
const WFPSF_STUDY_FIGURE_3 = Int32(103)
const WFPSF_STUDY_FIGURE_4 = Int32(104)
const WFPSF_STUDY_FIGURE_5 = Int32(105)
const WFPSF_STUDY_FIGURE_6 = Int32(106)
const WFPSF_STUDY_FIGURE_7 = Int32(107)
const WFPSF_STUDY_FIGURE_8 = Int32(108)
const WFPSF_STUDY_FIGURE_9 = Int32(109)
const WFPSF_STUDY_FIGURE_10 = Int32(110)
const WFPSF_STUDY_FIGURE_11 = Int32(111)
const WFPSF_STUDY_REQUIREMENTS = Int32(200)
const WFPSF_STUDY_COMPARISON = Int32(210)
const WFPSF_STUDY_CONVERGENCE = Int32(220)

const wfpsf_study_create_pointer = Ref(C_NULL)
function wfpsf_study_create(instrument, sca, options, out)
    return ccall(wfpsf_study_create_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Cvoid},
        Ptr{Ptr{Cvoid}}),
        instrument, sca, options, out)
end

const wfpsf_study_destroy_pointer = Ref(C_NULL)
function wfpsf_study_destroy(study)
    return ccall(wfpsf_study_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        study)
end

const wfpsf_study_size_pointer = Ref(C_NULL)
function wfpsf_study_size(study, table, rows, columns)
    return ccall(wfpsf_study_size_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Int64}, Ptr{Int64}),
        study, table, rows, columns)
end

const wfpsf_study_column_pointer = Ref(C_NULL)
function wfpsf_study_column(study, table, column)
    return ccall(wfpsf_study_column_pointer[], Cstring, (Ptr{Cvoid}, Int32, Int64),
        study, table, column)
end

const wfpsf_study_value_pointer = Ref(C_NULL)
function wfpsf_study_value(study, table, row, column, value)
    return ccall(wfpsf_study_value_pointer[], Int32, (Ptr{Cvoid}, Int32, Int64, Int64,
        Ptr{Float64}),
        study, table, row, column, value)
end

const wfpsf_study_text_pointer = Ref(C_NULL)
function wfpsf_study_text(study, table, row, column)
    return ccall(wfpsf_study_text_pointer[], Cstring, (Ptr{Cvoid}, Int32, Int64, Int64),
        study, table, row, column)
end

const wfpsf_study_write_csv_pointer = Ref(C_NULL)
function wfpsf_study_write_csv(study, folder)
    return ccall(wfpsf_study_write_csv_pointer[], Int32, (Ptr{Cvoid}, Cstring),
        study, folder)
end

# catalogue.h
const WFPSF_POSITIONS_DETECTOR = Int32(1)
const WFPSF_POSITIONS_SKY = Int32(2)
const WFPSF_BRIGHTNESS_ELECTRONS = Int32(1)
const WFPSF_BRIGHTNESS_AB_MAGNITUDE = Int32(2)

const wfpsf_catalogue_create_pointer = Ref(C_NULL)
function wfpsf_catalogue_create(positions, brightness, out)
    return ccall(wfpsf_catalogue_create_pointer[], Int32, (Int32, Int32, Ptr{Ptr{Cvoid}}),
        positions, brightness, out)
end

const wfpsf_catalogue_destroy_pointer = Ref(C_NULL)
function wfpsf_catalogue_destroy(catalogue)
    return ccall(wfpsf_catalogue_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        catalogue)
end

const wfpsf_catalogue_add_colour_pointer = Ref(C_NULL)
function wfpsf_catalogue_add_colour(catalogue, wavelength_nm, sed, colour)
    return ccall(wfpsf_catalogue_add_colour_pointer[], Int32, (Ptr{Cvoid}, Float64, Ptr{Cvoid},
        Ptr{Int32}),
        catalogue, wavelength_nm, sed, colour)
end

const wfpsf_catalogue_add_stars_pointer = Ref(C_NULL)
function wfpsf_catalogue_add_stars(catalogue, count, x, y, brightness, colour)
    return ccall(wfpsf_catalogue_add_stars_pointer[], Int32, (Ptr{Cvoid}, Int64, Ptr{Float64},
        Ptr{Float64}, Ptr{Float64}, Ptr{Int32}),
        catalogue, count, x, y, brightness, colour)
end

const wfpsf_catalogue_add_galaxies_pointer = Ref(C_NULL)
function wfpsf_catalogue_add_galaxies(catalogue, count, x, y, brightness, colour, sersic_index,
    half_light_radius_arcsec, e1, e2)
    return ccall(wfpsf_catalogue_add_galaxies_pointer[], Int32, (Ptr{Cvoid}, Int64, Ptr{Float64},
        Ptr{Float64}, Ptr{Float64}, Ptr{Int32}, Ptr{Float64}, Ptr{Float64}, Ptr{Float64},
        Ptr{Float64}),
        catalogue, count, x, y, brightness, colour, sersic_index, half_light_radius_arcsec, e1, e2)
end

const wfpsf_catalogue_size_pointer = Ref(C_NULL)
function wfpsf_catalogue_size(catalogue, count)
    return ccall(wfpsf_catalogue_size_pointer[], Int32, (Ptr{Cvoid}, Ptr{Int64}),
        catalogue, count)
end

const wfpsf_instrument_ab_zero_rate_pointer = Ref(C_NULL)
function wfpsf_instrument_ab_zero_rate(instrument, band, rate)
    return ccall(wfpsf_instrument_ab_zero_rate_pointer[], Int32, (Ptr{Cvoid}, Cstring,
        Ptr{Float64}),
        instrument, band, rate)
end

# scene.h
const WFPSF_SCENE_SOURCES = Int32(10)
const WFPSF_SCENE_GROUPS = Int32(20)
const WFPSF_SCENE_ERROR_ALLOWED = Int32(30)
const WFPSF_SCENE_ERROR_EXPECTED = Int32(40)
const WFPSF_SCENE_TIME_EXPECTED = Int32(50)
const WFPSF_SCENE_MEMORY_EXPECTED = Int32(60)
const WFPSF_SCENE_GROUP_COLOUR = Int32(10)
const WFPSF_SCENE_GROUP_KIND = Int32(20)
const WFPSF_SCENE_GROUP_FLUX_FROM = Int32(30)
const WFPSF_SCENE_GROUP_SOURCES = Int32(40)
const WFPSF_SCENE_GROUP_DRAWING = Int32(50)
const WFPSF_SCENE_GROUP_RADIUS = Int32(60)
const WFPSF_SCENE_GROUP_EPS = Int32(70)
const WFPSF_SCENE_GROUP_FAR_FLOOR = Int32(75)
const WFPSF_SCENE_GROUP_ERROR_EXPECTED = Int32(80)
const WFPSF_SCENE_GROUP_TIME_EXPECTED = Int32(90)
const WFPSF_RENDERING_TIME = Int32(10)
const WFPSF_RENDERING_TIME_MODELS = Int32(20)
const WFPSF_RENDERING_TIME_SHARED = Int32(30)
const WFPSF_RENDERING_TIME_OWN = Int32(40)
const WFPSF_RENDERING_TIME_GALAXIES = Int32(45)
const WFPSF_RENDERING_DRAWN = Int32(50)
const WFPSF_RENDERING_EXACT_PSFS = Int32(60)
const WFPSF_RENDERING_ERROR_ESTIMATE = Int32(70)
const WFPSF_TRUTH_GROUP = Int32(0)
const WFPSF_TRUTH_POSITION_X = Int32(1)
const WFPSF_TRUTH_POSITION_Y = Int32(2)
const WFPSF_TRUTH_FLUX = Int32(3)
const WFPSF_TRUTH_FLUX_IN_STAMP = Int32(4)
const WFPSF_TRUTH_STATUS = Int32(5)
const WFPSF_TRUTH_CENTROID_X = Int32(6)
const WFPSF_TRUTH_CENTROID_Y = Int32(7)
const WFPSF_TRUTH_SIGMA = Int32(8)
const WFPSF_TRUTH_E1 = Int32(9)
const WFPSF_TRUTH_E2 = Int32(10)
const WFPSF_TRUTH_IPC_CENTROID_X = Int32(11)
const WFPSF_TRUTH_IPC_CENTROID_Y = Int32(12)
const WFPSF_TRUTH_IPC_SIGMA = Int32(13)
const WFPSF_TRUTH_IPC_E1 = Int32(14)
const WFPSF_TRUTH_IPC_E2 = Int32(15)
const WFPSF_KIND_STAR = Int32(1)
const WFPSF_KIND_GALAXY = Int32(2)
const WFPSF_DRAWING_SHARED = Int32(1)
const WFPSF_DRAWING_OWN = Int32(2)
const WFPSF_DRAWING_FOURIER = Int32(3)
const WFPSF_DRAWING_FOURIER_OWN = Int32(4)
const WFPSF_TRUTH_COLUMNS = Int32(16)

const wfpsf_scene_store_create_pointer = Ref(C_NULL)
function wfpsf_scene_store_create(out)
    return ccall(wfpsf_scene_store_create_pointer[], Int32, (Ptr{Ptr{Cvoid}},),
        out)
end

const wfpsf_scene_store_destroy_pointer = Ref(C_NULL)
function wfpsf_scene_store_destroy(store)
    return ccall(wfpsf_scene_store_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        store)
end

const wfpsf_scene_store_memory_pointer = Ref(C_NULL)
function wfpsf_scene_store_memory(store, bytes)
    return ccall(wfpsf_scene_store_memory_pointer[], Int32, (Ptr{Cvoid}, Ptr{Int64}),
        store, bytes)
end

const wfpsf_scene_store_write_pointer = Ref(C_NULL)
function wfpsf_scene_store_write(store, path)
    return ccall(wfpsf_scene_store_write_pointer[], Int32, (Ptr{Cvoid}, Cstring),
        store, path)
end

const wfpsf_scene_store_read_pointer = Ref(C_NULL)
function wfpsf_scene_store_read(store, path)
    return ccall(wfpsf_scene_store_read_pointer[], Int32, (Ptr{Cvoid}, Cstring),
        store, path)
end

const wfpsf_options_set_scene_store_pointer = Ref(C_NULL)
function wfpsf_options_set_scene_store(options, store)
    return ccall(wfpsf_options_set_scene_store_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}),
        options, store)
end

const wfpsf_scene_create_pointer = Ref(C_NULL)
function wfpsf_scene_create(instrument, observation, band, sca, catalogue, image, x0, y0, options,
    out)
    return ccall(wfpsf_scene_create_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Cstring, Int32,
        Ptr{Cvoid}, Ptr{Cvoid}, Float64, Float64, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        instrument, observation, band, sca, catalogue, image, x0, y0, options, out)
end

const wfpsf_scene_destroy_pointer = Ref(C_NULL)
function wfpsf_scene_destroy(scene)
    return ccall(wfpsf_scene_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        scene)
end

const wfpsf_scene_get_pointer = Ref(C_NULL)
function wfpsf_scene_get(scene, key, value)
    return ccall(wfpsf_scene_get_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}),
        scene, key, value)
end

const wfpsf_scene_get_group_pointer = Ref(C_NULL)
function wfpsf_scene_get_group(scene, group, key, value)
    return ccall(wfpsf_scene_get_group_pointer[], Int32, (Ptr{Cvoid}, Int64, Int32, Ptr{Float64}),
        scene, group, key, value)
end

const wfpsf_scene_groups_of_pointer = Ref(C_NULL)
function wfpsf_scene_groups_of(scene, count, group)
    return ccall(wfpsf_scene_groups_of_pointer[], Int32, (Ptr{Cvoid}, Int64, Ptr{Int32}),
        scene, count, group)
end

const wfpsf_scene_text_pointer = Ref(C_NULL)
function wfpsf_scene_text(scene, capacity, text, length)
    return ccall(wfpsf_scene_text_pointer[], Int32, (Ptr{Cvoid}, Int64, Ptr{UInt8}, Ptr{Int64}),
        scene, capacity, text, length)
end

const wfpsf_scene_render_pointer = Ref(C_NULL)
function wfpsf_scene_render(scene, options, image, out)
    return ccall(wfpsf_scene_render_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid},
        Ptr{Ptr{Cvoid}}),
        scene, options, image, out)
end

const wfpsf_rendering_destroy_pointer = Ref(C_NULL)
function wfpsf_rendering_destroy(rendering)
    return ccall(wfpsf_rendering_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        rendering)
end

const wfpsf_rendering_get_pointer = Ref(C_NULL)
function wfpsf_rendering_get(rendering, key, value)
    return ccall(wfpsf_rendering_get_pointer[], Int32, (Ptr{Cvoid}, Int32, Ptr{Float64}),
        rendering, key, value)
end

const wfpsf_scene_truth_pointer = Ref(C_NULL)
function wfpsf_scene_truth(scene, count, sources, kernel, options, values)
    return ccall(wfpsf_scene_truth_pointer[], Int32, (Ptr{Cvoid}, Int64, Ptr{Int64}, Ptr{Cvoid},
        Ptr{Cvoid}, Ptr{Float64}),
        scene, count, sources, kernel, options, values)
end

# exposure.h
const wfpsf_exposure_create_pointer = Ref(C_NULL)
function wfpsf_exposure_create(instrument, observation, band, catalogue, chain, options, out)
    return ccall(wfpsf_exposure_create_pointer[], Int32, (Ptr{Cvoid}, Ptr{Cvoid}, Cstring,
        Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Cvoid}, Ptr{Ptr{Cvoid}}),
        instrument, observation, band, catalogue, chain, options, out)
end

const wfpsf_exposure_destroy_pointer = Ref(C_NULL)
function wfpsf_exposure_destroy(exposure)
    return ccall(wfpsf_exposure_destroy_pointer[], Cvoid, (Ptr{Cvoid},),
        exposure)
end

const wfpsf_exposure_path_pointer = Ref(C_NULL)
function wfpsf_exposure_path(exposure, folder, sca, capacity, text, length)
    return ccall(wfpsf_exposure_path_pointer[], Int32, (Ptr{Cvoid}, Cstring, Int32, Int64,
        Ptr{UInt8}, Ptr{Int64}),
        exposure, folder, sca, capacity, text, length)
end

const wfpsf_exposure_make_pointer = Ref(C_NULL)
function wfpsf_exposure_make(exposure, sca, folder, options, made)
    return ccall(wfpsf_exposure_make_pointer[], Int32, (Ptr{Cvoid}, Int32, Cstring, Ptr{Cvoid},
        Ptr{Int32}),
        exposure, sca, folder, options, made)
end

const pointers = [
    :wfpsf_version => wfpsf_version_pointer,
    :wfpsf_abi_number => wfpsf_abi_number_pointer,
    :wfpsf_abi_check => wfpsf_abi_check_pointer,
    :wfpsf_status_name => wfpsf_status_name_pointer,
    :wfpsf_status_string => wfpsf_status_string_pointer,
    :wfpsf_last_error => wfpsf_last_error_pointer,
    :wfpsf_options_create => wfpsf_options_create_pointer,
    :wfpsf_options_destroy => wfpsf_options_destroy_pointer,
    :wfpsf_options_set_real => wfpsf_options_set_real_pointer,
    :wfpsf_options_set_integer => wfpsf_options_set_integer_pointer,
    :wfpsf_options_get => wfpsf_options_get_pointer,
    :wfpsf_options_reset => wfpsf_options_reset_pointer,
    :wfpsf_options_set_zernikes => wfpsf_options_set_zernikes_pointer,
    :wfpsf_options_set_progress => wfpsf_options_set_progress_pointer,
    :wfpsf_option_describe => wfpsf_option_describe_pointer,
    :wfpsf_image_create => wfpsf_image_create_pointer,
    :wfpsf_image_wrap => wfpsf_image_wrap_pointer,
    :wfpsf_image_destroy => wfpsf_image_destroy_pointer,
    :wfpsf_image_shape => wfpsf_image_shape_pointer,
    :wfpsf_image_record => wfpsf_image_record_pointer,
    :wfpsf_image_set_record => wfpsf_image_set_record_pointer,
    :wfpsf_image_copy => wfpsf_image_copy_pointer,
    :wfpsf_image_read_fits => wfpsf_image_read_fits_pointer,
    :wfpsf_image_write_fits => wfpsf_image_write_fits_pointer,
    :wfpsf_image_interleave => wfpsf_image_interleave_pointer,
    :wfpsf_image_deinterleave => wfpsf_image_deinterleave_pointer,
    :wfpsf_instrument_create => wfpsf_instrument_create_pointer,
    :wfpsf_instrument_destroy => wfpsf_instrument_destroy_pointer,
    :wfpsf_instrument_constant => wfpsf_instrument_constant_pointer,
    :wfpsf_instrument_constant_name => wfpsf_instrument_constant_name_pointer,
    :wfpsf_instrument_band_name => wfpsf_instrument_band_name_pointer,
    :wfpsf_instrument_band => wfpsf_instrument_band_pointer,
    :wfpsf_instrument_throughput => wfpsf_instrument_throughput_pointer,
    :wfpsf_instrument_zernikes => wfpsf_instrument_zernikes_pointer,
    :wfpsf_instrument_pupil => wfpsf_instrument_pupil_pointer,
    :wfpsf_design_create => wfpsf_design_create_pointer,
    :wfpsf_design_destroy => wfpsf_design_destroy_pointer,
    :wfpsf_design_set_telescope => wfpsf_design_set_telescope_pointer,
    :wfpsf_design_add_strut => wfpsf_design_add_strut_pointer,
    :wfpsf_design_set_detector => wfpsf_design_set_detector_pointer,
    :wfpsf_design_set_zernikes => wfpsf_design_set_zernikes_pointer,
    :wfpsf_design_set_field => wfpsf_design_set_field_pointer,
    :wfpsf_design_add_band => wfpsf_design_add_band_pointer,
    :wfpsf_instrument_create_from_design => wfpsf_instrument_create_from_design_pointer,
    :wfpsf_sed_create_table => wfpsf_sed_create_table_pointer,
    :wfpsf_sed_create_power_law => wfpsf_sed_create_power_law_pointer,
    :wfpsf_sed_create_black_body => wfpsf_sed_create_black_body_pointer,
    :wfpsf_sed_create_redshifted => wfpsf_sed_create_redshifted_pointer,
    :wfpsf_sed_destroy => wfpsf_sed_destroy_pointer,
    :wfpsf_sed_photon_density => wfpsf_sed_photon_density_pointer,
    :wfpsf_options_set_opd => wfpsf_options_set_opd_pointer,
    :wfpsf_psf_create => wfpsf_psf_create_pointer,
    :wfpsf_psf_create_in_band => wfpsf_psf_create_in_band_pointer,
    :wfpsf_psf_create_chromatic => wfpsf_psf_create_chromatic_pointer,
    :wfpsf_psf_create_from_mask => wfpsf_psf_create_from_mask_pointer,
    :wfpsf_psf_destroy => wfpsf_psf_destroy_pointer,
    :wfpsf_psf_draw => wfpsf_psf_draw_pointer,
    :wfpsf_psf_add_bright_star => wfpsf_psf_add_bright_star_pointer,
    :wfpsf_psf_draw_memory => wfpsf_psf_draw_memory_pointer,
    :wfpsf_psf_add_stars => wfpsf_psf_add_stars_pointer,
    :wfpsf_psf_convolve => wfpsf_psf_convolve_pointer,
    :wfpsf_psf_get => wfpsf_psf_get_pointer,
    :wfpsf_varying_psf_create => wfpsf_varying_psf_create_pointer,
    :wfpsf_varying_psf_destroy => wfpsf_varying_psf_destroy_pointer,
    :wfpsf_varying_psf_at => wfpsf_varying_psf_at_pointer,
    :wfpsf_varying_psf_add_stars => wfpsf_varying_psf_add_stars_pointer,
    :wfpsf_varying_psf_get => wfpsf_varying_psf_get_pointer,
    :wfpsf_otf_create => wfpsf_otf_create_pointer,
    :wfpsf_otf_destroy => wfpsf_otf_destroy_pointer,
    :wfpsf_otf_values => wfpsf_otf_values_pointer,
    :wfpsf_otf_grid => wfpsf_otf_grid_pointer,
    :wfpsf_otf_get => wfpsf_otf_get_pointer,
    :wfpsf_ipc_kernel_create => wfpsf_ipc_kernel_create_pointer,
    :wfpsf_ipc_kernel_create_taps => wfpsf_ipc_kernel_create_taps_pointer,
    :wfpsf_ipc_kernel_create_wfc3 => wfpsf_ipc_kernel_create_wfc3_pointer,
    :wfpsf_ipc_kernel_create_default => wfpsf_ipc_kernel_create_default_pointer,
    :wfpsf_ipc_kernel_create_correction => wfpsf_ipc_kernel_create_correction_pointer,
    :wfpsf_ipc_kernel_create_flipped => wfpsf_ipc_kernel_create_flipped_pointer,
    :wfpsf_ipc_kernel_read_fits => wfpsf_ipc_kernel_read_fits_pointer,
    :wfpsf_ipc_kernel_create_composed => wfpsf_ipc_kernel_create_composed_pointer,
    :wfpsf_ipc_kernel_create_neumann => wfpsf_ipc_kernel_create_neumann_pointer,
    :wfpsf_ipc_kernel_create_autocorrelation => wfpsf_ipc_kernel_create_autocorrelation_pointer,
    :wfpsf_ipc_wfc3_deviations => wfpsf_ipc_wfc3_deviations_pointer,
    :wfpsf_ipc_kernel_destroy => wfpsf_ipc_kernel_destroy_pointer,
    :wfpsf_ipc_kernel_taps => wfpsf_ipc_kernel_taps_pointer,
    :wfpsf_ipc_kernel_get => wfpsf_ipc_kernel_get_pointer,
    :wfpsf_ipc_kernel_transform => wfpsf_ipc_kernel_transform_pointer,
    :wfpsf_ipc_apply => wfpsf_ipc_apply_pointer,
    :wfpsf_ipc_kernel_self_test => wfpsf_ipc_kernel_self_test_pointer,
    :wfpsf_ipc_correct => wfpsf_ipc_correct_pointer,
    :wfpsf_ipc_covariance => wfpsf_ipc_covariance_pointer,
    :wfpsf_varying_ipc_create_maps => wfpsf_varying_ipc_create_maps_pointer,
    :wfpsf_varying_ipc_create_polynomials => wfpsf_varying_ipc_create_polynomials_pointer,
    :wfpsf_varying_ipc_create_regions => wfpsf_varying_ipc_create_regions_pointer,
    :wfpsf_varying_ipc_destroy => wfpsf_varying_ipc_destroy_pointer,
    :wfpsf_varying_ipc_kernel => wfpsf_varying_ipc_kernel_pointer,
    :wfpsf_varying_ipc_margin => wfpsf_varying_ipc_margin_pointer,
    :wfpsf_varying_ipc_apply => wfpsf_varying_ipc_apply_pointer,
    :wfpsf_varying_ipc_correct => wfpsf_varying_ipc_correct_pointer,
    :wfpsf_varying_ipc_covariance => wfpsf_varying_ipc_covariance_pointer,
    :wfpsf_varying_ipc_autocorrelation => wfpsf_varying_ipc_autocorrelation_pointer,
    :wfpsf_chain_create => wfpsf_chain_create_pointer,
    :wfpsf_chain_create_default => wfpsf_chain_create_default_pointer,
    :wfpsf_chain_destroy => wfpsf_chain_destroy_pointer,
    :wfpsf_chain_add => wfpsf_chain_add_pointer,
    :wfpsf_chain_add_ipc => wfpsf_chain_add_ipc_pointer,
    :wfpsf_chain_add_varying_ipc => wfpsf_chain_add_varying_ipc_pointer,
    :wfpsf_chain_add_map => wfpsf_chain_add_map_pointer,
    :wfpsf_chain_step => wfpsf_chain_step_pointer,
    :wfpsf_step_name => wfpsf_step_name_pointer,
    :wfpsf_chain_apply => wfpsf_chain_apply_pointer,
    :wfpsf_noise_add => wfpsf_noise_add_pointer,
    :wfpsf_sky_level => wfpsf_sky_level_pointer,
    :wfpsf_sky_background => wfpsf_sky_background_pointer,
    :wfpsf_observation_create => wfpsf_observation_create_pointer,
    :wfpsf_observation_create_on_date => wfpsf_observation_create_on_date_pointer,
    :wfpsf_observation_create_aimed => wfpsf_observation_create_aimed_pointer,
    :wfpsf_observation_destroy => wfpsf_observation_destroy_pointer,
    :wfpsf_observation_get => wfpsf_observation_get_pointer,
    :wfpsf_observation_sky_to_pixel => wfpsf_observation_sky_to_pixel_pointer,
    :wfpsf_observation_pixel_to_sky => wfpsf_observation_pixel_to_sky_pointer,
    :wfpsf_observation_find_sca => wfpsf_observation_find_sca_pointer,
    :wfpsf_observation_bounds => wfpsf_observation_bounds_pointer,
    :wfpsf_observation_jacobian => wfpsf_observation_jacobian_pointer,
    :wfpsf_observation_fits_header => wfpsf_observation_fits_header_pointer,
    :wfpsf_julian_date => wfpsf_julian_date_pointer,
    :wfpsf_sun_position => wfpsf_sun_position_pointer,
    :wfpsf_pointing_allowed => wfpsf_pointing_allowed_pointer,
    :wfpsf_pointing_best_pa => wfpsf_pointing_best_pa_pointer,
    :wfpsf_moments_measure => wfpsf_moments_measure_pointer,
    :wfpsf_moments_measure_masked => wfpsf_moments_measure_masked_pointer,
    :wfpsf_moments_measure_weighted => wfpsf_moments_measure_weighted_pointer,
    :wfpsf_moments_sums => wfpsf_moments_sums_pointer,
    :wfpsf_moments_measure_unweighted => wfpsf_moments_measure_unweighted_pointer,
    :wfpsf_moments_destroy => wfpsf_moments_destroy_pointer,
    :wfpsf_moments_status => wfpsf_moments_status_pointer,
    :wfpsf_moments_get => wfpsf_moments_get_pointer,
    :wfpsf_moments_covariance => wfpsf_moments_covariance_pointer,
    :wfpsf_moments_differentiate => wfpsf_moments_differentiate_pointer,
    :wfpsf_moments_influence => wfpsf_moments_influence_pointer,
    :wfpsf_size_encircled_energy => wfpsf_size_encircled_energy_pointer,
    :wfpsf_size_ee_radius => wfpsf_size_ee_radius_pointer,
    :wfpsf_size_fwhm => wfpsf_size_fwhm_pointer,
    :wfpsf_size_ee_radius_derivative => wfpsf_size_ee_radius_derivative_pointer,
    :wfpsf_size_profile => wfpsf_size_profile_pointer,
    :wfpsf_size_profile_fwhm => wfpsf_size_profile_fwhm_pointer,
    :wfpsf_study_create => wfpsf_study_create_pointer,
    :wfpsf_study_destroy => wfpsf_study_destroy_pointer,
    :wfpsf_study_size => wfpsf_study_size_pointer,
    :wfpsf_study_column => wfpsf_study_column_pointer,
    :wfpsf_study_value => wfpsf_study_value_pointer,
    :wfpsf_study_text => wfpsf_study_text_pointer,
    :wfpsf_study_write_csv => wfpsf_study_write_csv_pointer,
    :wfpsf_catalogue_create => wfpsf_catalogue_create_pointer,
    :wfpsf_catalogue_destroy => wfpsf_catalogue_destroy_pointer,
    :wfpsf_catalogue_add_colour => wfpsf_catalogue_add_colour_pointer,
    :wfpsf_catalogue_add_stars => wfpsf_catalogue_add_stars_pointer,
    :wfpsf_catalogue_add_galaxies => wfpsf_catalogue_add_galaxies_pointer,
    :wfpsf_catalogue_size => wfpsf_catalogue_size_pointer,
    :wfpsf_instrument_ab_zero_rate => wfpsf_instrument_ab_zero_rate_pointer,
    :wfpsf_scene_store_create => wfpsf_scene_store_create_pointer,
    :wfpsf_scene_store_destroy => wfpsf_scene_store_destroy_pointer,
    :wfpsf_scene_store_memory => wfpsf_scene_store_memory_pointer,
    :wfpsf_scene_store_write => wfpsf_scene_store_write_pointer,
    :wfpsf_scene_store_read => wfpsf_scene_store_read_pointer,
    :wfpsf_options_set_scene_store => wfpsf_options_set_scene_store_pointer,
    :wfpsf_scene_create => wfpsf_scene_create_pointer,
    :wfpsf_scene_destroy => wfpsf_scene_destroy_pointer,
    :wfpsf_scene_get => wfpsf_scene_get_pointer,
    :wfpsf_scene_get_group => wfpsf_scene_get_group_pointer,
    :wfpsf_scene_groups_of => wfpsf_scene_groups_of_pointer,
    :wfpsf_scene_text => wfpsf_scene_text_pointer,
    :wfpsf_scene_render => wfpsf_scene_render_pointer,
    :wfpsf_rendering_destroy => wfpsf_rendering_destroy_pointer,
    :wfpsf_rendering_get => wfpsf_rendering_get_pointer,
    :wfpsf_scene_truth => wfpsf_scene_truth_pointer,
    :wfpsf_exposure_create => wfpsf_exposure_create_pointer,
    :wfpsf_exposure_destroy => wfpsf_exposure_destroy_pointer,
    :wfpsf_exposure_path => wfpsf_exposure_path_pointer,
    :wfpsf_exposure_make => wfpsf_exposure_make_pointer,
]

"""
    load(path)

Opens the shared library and finds its functions. Call it when the program starts, as `__init__`
does: pointers do not outlive a process.
"""
function load(path::AbstractString)
    # Without Julia's default RTLD_DEEPBIND: it would give the library another unwinder than the one
    # that libstdc++ has in this process, and the first C++ exception would abort.
    library = Libdl.dlopen(path, Libdl.RTLD_LAZY | Libdl.RTLD_LOCAL)
    for (name, pointer) in pointers
        pointer[] = Libdl.dlsym(library, name)
    end
    return nothing
end

end
