# SPDX-License-Identifier: GPL-3.0-or-later
# Made by bindings/generate.py from the headers in capi/include/wfpsf: change those.
"""The C interface as it stands: every constant and function, described in the C headers.

Arrays of numbers and functions are addresses (``c_void_p``), text is bytes.
"""
import ctypes
from ctypes import CFUNCTYPE, POINTER, c_char_p, c_double, c_int32, c_int64, c_void_p


def _handle(name):
    """The type of pointers to an opaque struct."""
    return POINTER(type(name, (ctypes.Structure,), {}))


VERSION = "1.0.0"  # of the headers

# version.h
WFPSF_VERSION_MAJOR = 1
WFPSF_VERSION_MINOR = 0
WFPSF_VERSION_PATCH = 0
WFPSF_ABI_NUMBER = 1

# status.h
WFPSF_OK = 0
WFPSF_WARNING_NOT_CONVERGED = 100
WFPSF_WARNING_NOT_CERTIFIED = 110
WFPSF_WARNING_RESTARTED = 120
WFPSF_WARNING_NEAR_DEGENERATE = 130
WFPSF_WARNING_UNDERSAMPLED = 140
WFPSF_ERROR_NULL = -10
WFPSF_ERROR_ARGUMENT = -20
WFPSF_ERROR_RANGE = -30
WFPSF_ERROR_SIZE = -40
WFPSF_ERROR_TYPE = -50
WFPSF_ERROR_NOT_FINITE = -60
WFPSF_ERROR_UNKNOWN_NAME = -70
WFPSF_ERROR_OVERLAP = -80
WFPSF_ERROR_ALREADY_APPLIED = -90
WFPSF_ERROR_KERNEL = -100
WFPSF_ERROR_KERNEL_SINGULAR = -110
WFPSF_ERROR_SKY_SUN = -120
WFPSF_ERROR_SUN_ANGLE = -130
WFPSF_ERROR_NO_WCS = -140
WFPSF_ERROR_FILE_OPEN = -200
WFPSF_ERROR_FILE_FORMAT = -210
WFPSF_ERROR_FILE_WRITE = -220
WFPSF_ERROR_MOMENTS_NO_PIXELS = -300
WFPSF_ERROR_MOMENTS_FLUX = -310
WFPSF_ERROR_MOMENTS_UNRESOLVED = -320
WFPSF_ERROR_MOMENTS_FILLS_IMAGE = -330
WFPSF_ERROR_MOMENTS_OUTSIDE = -340
WFPSF_ERROR_MOMENTS_STALLED = -350
WFPSF_ERROR_SIZE_NOT_REACHED = -400
WFPSF_ERROR_CANCELLED = -500
WFPSF_ERROR_MEMORY_LIMIT = -510
WFPSF_ERROR_NO_MEMORY = -900
WFPSF_ERROR_INTERNAL = -910
WFPSF_ERROR_ABI = -920

# options.h
WFPSF_OPTION_EPS = 100
WFPSF_OPTION_STRUTS = 110
WFPSF_OPTION_PSF_RADIUS = 120
WFPSF_OPTION_PISTON_TILT = 130
WFPSF_OPTION_FRAME = 140
WFPSF_OPTION_FIELD_RULE = 150
WFPSF_OPTION_JITTER_XX = 160
WFPSF_OPTION_JITTER_XY = 161
WFPSF_OPTION_JITTER_YY = 162
WFPSF_OPTION_CHARGE_DIFFUSION = 170
WFPSF_OPTION_MASK_POINTS = 180
WFPSF_OPTION_PIXEL_RESPONSE = 190
WFPSF_OPTION_FORCE = 200
WFPSF_OPTION_IPC_FILL = 210
WFPSF_OPTION_KERNEL_NEGATIVE = 220
WFPSF_OPTION_KERNEL_NORMALISE = 230
WFPSF_OPTION_IPC_FORM = 240
WFPSF_OPTION_IPC_LEAST_MARGIN = 250
WFPSF_OPTION_IPC_TOLERANCE = 260
WFPSF_OPTION_IPC_MAX_PASSES = 270
WFPSF_OPTION_MOMENTS_TOLERANCE = 300
WFPSF_OPTION_MOMENTS_MAX_PASSES = 310
WFPSF_OPTION_MOMENTS_GUESS_X = 320
WFPSF_OPTION_MOMENTS_GUESS_Y = 330
WFPSF_OPTION_MOMENTS_GUESS_SIGMA = 340
WFPSF_OPTION_MOMENTS_METHOD = 350
WFPSF_OPTION_MOMENTS_BACKGROUND = 360
WFPSF_OPTION_MOMENTS_VARIANCE = 370
WFPSF_OPTION_MOMENTS_RESTART = 380
WFPSF_OPTION_MOMENTS_COVARIANCE_ORDER = 390
WFPSF_OPTION_SIZE_TOTAL_FLUX = 400
WFPSF_OPTION_SIZE_BANDWIDTH = 410
WFPSF_OPTION_SIZE_EPS = 420
WFPSF_OPTION_FITS_OVERWRITE = 500
WFPSF_OPTION_THREADS = 600
WFPSF_OPTION_MEMORY_LIMIT = 610
WFPSF_OPTION_SEED = 700
WFPSF_OPTION_STREAM = 710
WFPSF_OPTION_ORIGIN_X = 720
WFPSF_OPTION_ORIGIN_Y = 730
WFPSF_OPTION_NOISE = 740
WFPSF_OPTION_WCS_RULE = 800
WFPSF_OPTION_PA_OF_FPA = 810
WFPSF_OPTION_SCENE_NOISE = 900
WFPSF_OPTION_SCENE_VARIANCE = 910
WFPSF_OPTION_SCENE_FLUX = 920
WFPSF_OPTION_SCENE_BACKGROUND = 930
WFPSF_OPTION_EXPOSURE_TIME = 940
WFPSF_OPTION_SCENE_EXPOSURES = 950
WFPSF_OPTION_REAL = 1
WFPSF_OPTION_INTEGER = 2

# image.h
WFPSF_FLOAT32 = 32
WFPSF_FLOAT64 = 64
WFPSF_EFFECT_PIXEL_RESPONSE = 1
WFPSF_EFFECT_IPC = 2
WFPSF_EFFECT_IPC_CORRECTION = 4
WFPSF_EFFECT_CHARGE_DIFFUSION = 8
WFPSF_EFFECT_BACKGROUND = 16
WFPSF_EFFECT_POISSON_NOISE = 32
WFPSF_EFFECT_RECIPROCITY_FAILURE = 64
WFPSF_EFFECT_DARK_CURRENT = 128
WFPSF_EFFECT_PERSISTENCE = 256
WFPSF_EFFECT_NONLINEARITY = 512
WFPSF_EFFECT_NONLINEARITY_CORRECTION = 1024
WFPSF_EFFECT_CAPACITANCE = 2048
WFPSF_EFFECT_READ_NOISE = 4096
WFPSF_EFFECT_GAIN = 8192
WFPSF_DITHER_DETECTOR = 1
WFPSF_DITHER_OBJECT = 2

# instrument.h
WFPSF_BAND_TABULATED = 1
WFPSF_BAND_PAPER = 2

# sed.h
WFPSF_SED_PHOTONS = 1
WFPSF_SED_ENERGY = 2

# psf.h
WFPSF_PSF_WAVELENGTH_NM = 10
WFPSF_PSF_PIXEL_SCALE_ARCSEC = 20
WFPSF_PSF_ERROR_ESTIMATE = 30
WFPSF_PSF_MODEL_ERROR = 40
WFPSF_PSF_PEAK = 50
WFPSF_PSF_NODES = 60
WFPSF_PSF_GRID_SIZE = 70
WFPSF_PSF_GRID_STEP_ARCSEC = 80
WFPSF_PSF_RADIUS = 90
WFPSF_PSF_LIT_AREA_M2 = 100
WFPSF_PSF_WAVELENGTHS = 110

# varying_psf.h
WFPSF_VARYING_PSF_ERROR_ESTIMATE = 10
WFPSF_VARYING_PSF_INTERPOLATION_ERROR = 20
WFPSF_VARYING_PSF_DEGREE = 30
WFPSF_VARYING_PSF_RANK = 40
WFPSF_VARYING_PSF_EXACT_PSFS = 50
WFPSF_VARYING_PSF_MEMORY_BYTES = 60
WFPSF_VARYING_PSF_MARGIN = 70

# otf.h
WFPSF_OTF_ERROR_ESTIMATE = 10
WFPSF_OTF_VALUE_ERROR = 20
WFPSF_OTF_CUTOFF = 30
WFPSF_OTF_PIXELS = 40
WFPSF_RESPONSE_DIFFRACTION = 1
WFPSF_RESPONSE_EFFECTIVE = 2
WFPSF_ORDER_CENTRED = 1
WFPSF_ORDER_WRAPPED = 2
WFPSF_ORDER_HALF = 3

# ipc.h
WFPSF_KERNEL_SUM = 10
WFPSF_KERNEL_CENTROID_X = 20
WFPSF_KERNEL_CENTROID_Y = 30
WFPSF_KERNEL_MXX = 40
WFPSF_KERNEL_MXY = 50
WFPSF_KERNEL_MYY = 60
WFPSF_KERNEL_LEFT_RIGHT = 100
WFPSF_KERNEL_UP_DOWN = 110
WFPSF_KERNEL_HALF_TURN = 120
WFPSF_KERNEL_TRANSPOSED = 130
WFPSF_KERNEL_MARGIN = 200
WFPSF_KERNEL_MARGIN_FREQUENCY_X = 210
WFPSF_KERNEL_MARGIN_FREQUENCY_Y = 220
WFPSF_KERNEL_VARIANCE_RATIO = 300
WFPSF_KERNEL_CONVERSION_GAIN_BIAS = 310
WFPSF_KERNEL_QUANTUM_EFFICIENCY_BIAS = 320
WFPSF_KERNEL_INVERSE_NOISE = 330
WFPSF_IPC_SCATTER = 0
WFPSF_IPC_GATHER = 1
WFPSF_EDGE_ZERO = 0
WFPSF_EDGE_REPLICATE = 1
WFPSF_EDGE_WRAP = 2
WFPSF_EDGE_CROP = 3
WFPSF_EDGE_FILL = 4
WFPSF_EDGE_VALID = 5

# chain.h
WFPSF_STEP_CLIP_NEGATIVE = 10
WFPSF_STEP_CHARGE_DIFFUSION = 20
WFPSF_STEP_BACKGROUND = 30
WFPSF_STEP_POISSON_NOISE = 40
WFPSF_STEP_QUANTISATION = 50
WFPSF_STEP_RECIPROCITY_FAILURE = 60
WFPSF_STEP_DARK_CURRENT = 70
WFPSF_STEP_DARK_CURRENT_MAP = 71
WFPSF_STEP_PERSISTENCE_LINEAR = 80
WFPSF_STEP_PERSISTENCE_FERMI = 81
WFPSF_STEP_NONLINEARITY = 90
WFPSF_STEP_NONLINEARITY_INVERSE = 100
WFPSF_STEP_CAPACITANCE_MAP = 110
WFPSF_STEP_IPC = 120
WFPSF_STEP_READ_NOISE = 130
WFPSF_STEP_SATURATION = 140
WFPSF_STEP_GAIN = 150
WFPSF_STEP_PIXEL_MASK = 160

# observation.h
WFPSF_OBSERVATION_RA = 10
WFPSF_OBSERVATION_DEC = 20
WFPSF_OBSERVATION_PA = 30
WFPSF_OBSERVATION_PA_FPA = 40
WFPSF_OBSERVATION_CRPIX1 = 100
WFPSF_OBSERVATION_CRPIX2 = 110
WFPSF_OBSERVATION_CRVAL1 = 120
WFPSF_OBSERVATION_CRVAL2 = 130
WFPSF_OBSERVATION_CD1_1 = 140
WFPSF_OBSERVATION_CD1_2 = 150
WFPSF_OBSERVATION_CD2_1 = 160
WFPSF_OBSERVATION_CD2_2 = 170
WFPSF_OBSERVATION_ORIENTAT = 180

# moments.h
WFPSF_MOMENTS_CENTROID_X = 10
WFPSF_MOMENTS_CENTROID_Y = 20
WFPSF_MOMENTS_MXX = 30
WFPSF_MOMENTS_MXY = 40
WFPSF_MOMENTS_MYY = 50
WFPSF_MOMENTS_SIGMA = 60
WFPSF_MOMENTS_SIGMA_TRACE = 70
WFPSF_MOMENTS_E1 = 80
WFPSF_MOMENTS_E2 = 90
WFPSF_MOMENTS_E = 100
WFPSF_MOMENTS_BETA = 110
WFPSF_MOMENTS_FLUX = 120
WFPSF_MOMENTS_RHO4 = 130
WFPSF_MOMENTS_PASSES = 140
WFPSF_MOMENTS_ERROR_ESTIMATE = 150
WFPSF_MOMENTS_RESIDUAL = 160
WFPSF_MOMENTS_CURVATURE = 170
WFPSF_MOMENTS_EDGE_FRACTION = 180
WFPSF_MOMENTS_MISSING_FRACTION = 190
WFPSF_MOMENTS_AMPLITUDE = 200
WFPSF_MOMENTS_LAST_STEP = 210
WFPSF_MOMENTS_PIXELS = 220
WFPSF_MOMENTS_BACKGROUND = 230

# size.h
WFPSF_SIZE_BANDLIMITED = 1
WFPSF_SIZE_PIXEL_SUM = 2
WFPSF_SIZE_PIXEL_INTERPOLATED = 3

# study.h
WFPSF_STUDY_BANDS = 10
WFPSF_STUDY_SIZES = 20
WFPSF_STUDY_SENSITIVITIES = 30
WFPSF_STUDY_LINEAR_LAW = 40
WFPSF_STUDY_FIGURE_3 = 103
WFPSF_STUDY_FIGURE_4 = 104
WFPSF_STUDY_FIGURE_5 = 105
WFPSF_STUDY_FIGURE_6 = 106
WFPSF_STUDY_FIGURE_7 = 107
WFPSF_STUDY_FIGURE_8 = 108
WFPSF_STUDY_FIGURE_9 = 109
WFPSF_STUDY_FIGURE_10 = 110
WFPSF_STUDY_FIGURE_11 = 111
WFPSF_STUDY_REQUIREMENTS = 200
WFPSF_STUDY_COMPARISON = 210
WFPSF_STUDY_CONVERGENCE = 220

# catalogue.h
WFPSF_POSITIONS_DETECTOR = 1
WFPSF_POSITIONS_SKY = 2
WFPSF_BRIGHTNESS_ELECTRONS = 1
WFPSF_BRIGHTNESS_AB_MAGNITUDE = 2

# scene.h
WFPSF_SCENE_SOURCES = 10
WFPSF_SCENE_GROUPS = 20
WFPSF_SCENE_ERROR_ALLOWED = 30
WFPSF_SCENE_ERROR_EXPECTED = 40
WFPSF_SCENE_TIME_EXPECTED = 50
WFPSF_SCENE_MEMORY_EXPECTED = 60
WFPSF_SCENE_GROUP_COLOUR = 10
WFPSF_SCENE_GROUP_KIND = 20
WFPSF_SCENE_GROUP_FLUX_FROM = 30
WFPSF_SCENE_GROUP_SOURCES = 40
WFPSF_SCENE_GROUP_DRAWING = 50
WFPSF_SCENE_GROUP_RADIUS = 60
WFPSF_SCENE_GROUP_EPS = 70
WFPSF_SCENE_GROUP_FAR_FLOOR = 75
WFPSF_SCENE_GROUP_ERROR_EXPECTED = 80
WFPSF_SCENE_GROUP_TIME_EXPECTED = 90
WFPSF_RENDERING_TIME = 10
WFPSF_RENDERING_TIME_MODELS = 20
WFPSF_RENDERING_TIME_SHARED = 30
WFPSF_RENDERING_TIME_OWN = 40
WFPSF_RENDERING_TIME_GALAXIES = 45
WFPSF_RENDERING_DRAWN = 50
WFPSF_RENDERING_EXACT_PSFS = 60
WFPSF_RENDERING_ERROR_ESTIMATE = 70
WFPSF_TRUTH_GROUP = 0
WFPSF_TRUTH_POSITION_X = 1
WFPSF_TRUTH_POSITION_Y = 2
WFPSF_TRUTH_FLUX = 3
WFPSF_TRUTH_FLUX_IN_STAMP = 4
WFPSF_TRUTH_STATUS = 5
WFPSF_TRUTH_CENTROID_X = 6
WFPSF_TRUTH_CENTROID_Y = 7
WFPSF_TRUTH_SIGMA = 8
WFPSF_TRUTH_E1 = 9
WFPSF_TRUTH_E2 = 10
WFPSF_TRUTH_IPC_CENTROID_X = 11
WFPSF_TRUTH_IPC_CENTROID_Y = 12
WFPSF_TRUTH_IPC_SIGMA = 13
WFPSF_TRUTH_IPC_E1 = 14
WFPSF_TRUTH_IPC_E2 = 15
WFPSF_KIND_STAR = 1
WFPSF_KIND_GALAXY = 2
WFPSF_DRAWING_SHARED = 1
WFPSF_DRAWING_OWN = 2
WFPSF_DRAWING_FOURIER = 3
WFPSF_DRAWING_FOURIER_OWN = 4
WFPSF_TRUTH_COLUMNS = 16

wfpsf_options_p = _handle("wfpsf_options")
wfpsf_image_p = _handle("wfpsf_image")
wfpsf_instrument_p = _handle("wfpsf_instrument")
wfpsf_design_p = _handle("wfpsf_design")
wfpsf_sed_p = _handle("wfpsf_sed")
wfpsf_psf_p = _handle("wfpsf_psf")
wfpsf_varying_psf_p = _handle("wfpsf_varying_psf")
wfpsf_otf_p = _handle("wfpsf_otf")
wfpsf_ipc_kernel_p = _handle("wfpsf_ipc_kernel")
wfpsf_varying_ipc_p = _handle("wfpsf_varying_ipc")
wfpsf_chain_p = _handle("wfpsf_chain")
wfpsf_observation_p = _handle("wfpsf_observation")
wfpsf_moments_p = _handle("wfpsf_moments")
wfpsf_study_p = _handle("wfpsf_study")
wfpsf_catalogue_p = _handle("wfpsf_catalogue")
wfpsf_scene_store_p = _handle("wfpsf_scene_store")
wfpsf_scene_p = _handle("wfpsf_scene")
wfpsf_rendering_p = _handle("wfpsf_rendering")
wfpsf_exposure_p = _handle("wfpsf_exposure")

wfpsf_progress = CFUNCTYPE(c_int32, c_double, c_void_p)

# name: (type of the result, types of the arguments)
FUNCTIONS = {
    "wfpsf_version": (c_char_p, []),
    "wfpsf_abi_number": (c_int32, []),
    "wfpsf_abi_check": (c_int32, [c_int32]),
    "wfpsf_status_name": (c_char_p, [c_int32]),
    "wfpsf_status_string": (c_char_p, [c_int32]),
    "wfpsf_last_error": (c_int64, [c_char_p, c_int64]),
    "wfpsf_options_create": (c_int32, [POINTER(wfpsf_options_p)]),
    "wfpsf_options_destroy": (None, [wfpsf_options_p]),
    "wfpsf_options_set_real": (c_int32, [wfpsf_options_p, c_int32, c_double]),
    "wfpsf_options_set_integer": (c_int32, [wfpsf_options_p, c_int32, c_int64]),
    "wfpsf_options_get": (c_int32, [wfpsf_options_p, c_int32, POINTER(c_double)]),
    "wfpsf_options_reset": (c_int32, [wfpsf_options_p, c_int32]),
    "wfpsf_options_set_zernikes": (c_int32, [wfpsf_options_p, c_int64, c_void_p]),
    "wfpsf_options_set_progress": (c_int32, [wfpsf_options_p, c_void_p, c_void_p]),
    "wfpsf_option_describe": (c_int32, [c_int32, POINTER(c_char_p), POINTER(c_char_p),
        POINTER(c_int32), POINTER(c_double), POINTER(c_double), POINTER(c_double)]),
    "wfpsf_image_create": (c_int32, [c_int32, c_int64, c_int64, c_int64, POINTER(wfpsf_image_p)]),
    "wfpsf_image_wrap": (c_int32, [c_int32, c_void_p, c_int64, c_int64, c_int64, c_int64, c_int64,
        POINTER(wfpsf_image_p)]),
    "wfpsf_image_destroy": (None, [wfpsf_image_p]),
    "wfpsf_image_shape": (c_int32, [wfpsf_image_p, POINTER(c_int32), POINTER(c_int64),
        POINTER(c_int64)]),
    "wfpsf_image_record": (c_int32, [wfpsf_image_p, POINTER(c_int64), POINTER(c_double),
        POINTER(c_int32)]),
    "wfpsf_image_set_record": (c_int32, [wfpsf_image_p, c_int64, c_double, c_int32]),
    "wfpsf_image_copy": (c_int32, [wfpsf_image_p, wfpsf_image_p]),
    "wfpsf_image_read_fits": (c_int32, [c_char_p, c_char_p, c_int32, POINTER(wfpsf_image_p)]),
    "wfpsf_image_write_fits": (c_int32, [wfpsf_image_p, c_char_p, wfpsf_options_p]),
    "wfpsf_image_interleave": (c_int32, [c_int64, c_int64, POINTER(wfpsf_image_p), c_void_p,
        c_void_p, c_int32, wfpsf_image_p]),
    "wfpsf_image_deinterleave": (c_int32, [wfpsf_image_p, c_int64, c_int64, c_void_p, c_void_p,
        c_int32, POINTER(wfpsf_image_p)]),
    "wfpsf_instrument_create": (c_int32, [c_char_p, POINTER(wfpsf_instrument_p)]),
    "wfpsf_instrument_destroy": (None, [wfpsf_instrument_p]),
    "wfpsf_instrument_constant": (c_int32, [wfpsf_instrument_p, c_char_p, POINTER(c_double),
        POINTER(c_char_p)]),
    "wfpsf_instrument_constant_name": (c_char_p, [wfpsf_instrument_p, c_int64]),
    "wfpsf_instrument_band_name": (c_char_p, [wfpsf_instrument_p, c_int64]),
    "wfpsf_instrument_band": (c_int32, [wfpsf_instrument_p, c_char_p, c_int32, POINTER(c_double),
        POINTER(c_double), POINTER(c_double)]),
    "wfpsf_instrument_throughput": (c_int32, [wfpsf_instrument_p, c_char_p, c_int64, c_void_p,
        c_void_p]),
    "wfpsf_instrument_zernikes": (c_int32, [wfpsf_instrument_p, c_int32, c_int64, c_void_p,
        POINTER(c_int64)]),
    "wfpsf_instrument_pupil": (c_int32, [wfpsf_instrument_p, c_char_p, c_int32, wfpsf_options_p,
        wfpsf_image_p, POINTER(c_double), POINTER(c_double), POINTER(c_double)]),
    "wfpsf_design_create": (c_int32, [POINTER(wfpsf_design_p)]),
    "wfpsf_design_destroy": (None, [wfpsf_design_p]),
    "wfpsf_design_set_telescope": (c_int32, [wfpsf_design_p, c_double, c_double, c_double]),
    "wfpsf_design_add_strut": (c_int32, [wfpsf_design_p, c_double, c_double, c_double]),
    "wfpsf_design_set_detector": (c_int32, [wfpsf_design_p, c_int32, c_double, c_int64, c_int64]),
    "wfpsf_design_set_zernikes": (c_int32, [wfpsf_design_p, c_int32, c_int64, c_void_p]),
    "wfpsf_design_set_field": (c_int32, [wfpsf_design_p, c_int32, c_void_p, c_void_p, c_int64,
        c_void_p]),
    "wfpsf_design_add_band": (c_int32, [wfpsf_design_p, c_char_p, c_double, c_double, c_int64,
        c_void_p]),
    "wfpsf_instrument_create_from_design": (c_int32, [wfpsf_design_p, POINTER(wfpsf_instrument_p)]),
    "wfpsf_sed_create_table": (c_int32, [c_int32, c_int64, c_void_p, c_void_p,
        POINTER(wfpsf_sed_p)]),
    "wfpsf_sed_create_power_law": (c_int32, [c_int32, c_double, POINTER(wfpsf_sed_p)]),
    "wfpsf_sed_create_black_body": (c_int32, [c_double, POINTER(wfpsf_sed_p)]),
    "wfpsf_sed_create_redshifted": (c_int32, [wfpsf_sed_p, c_double, POINTER(wfpsf_sed_p)]),
    "wfpsf_sed_destroy": (None, [wfpsf_sed_p]),
    "wfpsf_sed_photon_density": (c_int32, [wfpsf_sed_p, c_int64, c_void_p, c_void_p]),
    "wfpsf_options_set_opd": (c_int32, [wfpsf_options_p, wfpsf_image_p, c_double, c_double,
        c_double]),
    "wfpsf_psf_create": (c_int32, [wfpsf_instrument_p, c_int32, c_double, wfpsf_options_p,
        POINTER(wfpsf_psf_p)]),
    "wfpsf_psf_create_in_band": (c_int32, [wfpsf_instrument_p, c_char_p, c_int32, c_double,
        c_double, c_double, wfpsf_options_p, POINTER(wfpsf_psf_p)]),
    "wfpsf_psf_create_chromatic": (c_int32, [wfpsf_instrument_p, c_char_p, c_int32, c_double,
        c_double, c_int64, POINTER(wfpsf_sed_p), wfpsf_options_p, POINTER(wfpsf_psf_p)]),
    "wfpsf_psf_create_from_mask": (c_int32, [wfpsf_instrument_p, wfpsf_image_p, c_double, c_double,
        c_double, c_int32, c_double, wfpsf_options_p, POINTER(wfpsf_psf_p)]),
    "wfpsf_psf_destroy": (None, [wfpsf_psf_p]),
    "wfpsf_psf_draw": (c_int32, [wfpsf_psf_p, c_double, c_double, c_double, wfpsf_options_p,
        wfpsf_image_p]),
    "wfpsf_psf_add_bright_star": (c_int32, [wfpsf_psf_p, c_double, c_double, c_double,
        wfpsf_options_p, wfpsf_image_p]),
    "wfpsf_psf_draw_memory": (c_int32, [wfpsf_psf_p, c_double, c_double, wfpsf_image_p,
        POINTER(c_int64), POINTER(c_int64)]),
    "wfpsf_psf_add_stars": (c_int32, [wfpsf_psf_p, c_int64, c_void_p, c_void_p, c_void_p,
        wfpsf_options_p, wfpsf_image_p]),
    "wfpsf_psf_convolve": (c_int32, [wfpsf_psf_p, wfpsf_image_p, c_double, c_double, c_double,
        wfpsf_options_p, wfpsf_image_p]),
    "wfpsf_psf_get": (c_int32, [wfpsf_psf_p, c_int32, POINTER(c_double)]),
    "wfpsf_varying_psf_create": (c_int32, [wfpsf_instrument_p, c_char_p, c_int32, c_double,
        wfpsf_sed_p, wfpsf_options_p, POINTER(wfpsf_varying_psf_p)]),
    "wfpsf_varying_psf_destroy": (None, [wfpsf_varying_psf_p]),
    "wfpsf_varying_psf_at": (c_int32, [wfpsf_varying_psf_p, c_double, c_double,
        POINTER(wfpsf_psf_p)]),
    "wfpsf_varying_psf_add_stars": (c_int32, [wfpsf_varying_psf_p, c_double, c_double, c_int64,
        c_void_p, c_void_p, c_void_p, wfpsf_options_p, wfpsf_image_p]),
    "wfpsf_varying_psf_get": (c_int32, [wfpsf_varying_psf_p, c_int32, POINTER(c_double)]),
    "wfpsf_otf_create": (c_int32, [wfpsf_psf_p, wfpsf_options_p, POINTER(wfpsf_otf_p)]),
    "wfpsf_otf_destroy": (None, [wfpsf_otf_p]),
    "wfpsf_otf_values": (c_int32, [wfpsf_otf_p, c_int32, c_int64, c_void_p, c_void_p, c_void_p,
        c_void_p]),
    "wfpsf_otf_grid": (c_int32, [wfpsf_otf_p, c_int32, c_int32, c_double, wfpsf_image_p,
        wfpsf_image_p]),
    "wfpsf_otf_get": (c_int32, [wfpsf_otf_p, c_int32, POINTER(c_double)]),
    "wfpsf_ipc_kernel_create": (c_int32, [c_double, c_double, c_double, wfpsf_options_p,
        POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_ipc_kernel_create_taps": (c_int32, [c_int64, c_int64, c_void_p, wfpsf_options_p,
        POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_ipc_kernel_create_wfc3": (c_int32, [POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_ipc_kernel_create_default": (c_int32, [wfpsf_instrument_p, POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_ipc_kernel_create_correction": (c_int32, [wfpsf_ipc_kernel_p,
        POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_ipc_kernel_create_flipped": (c_int32, [wfpsf_ipc_kernel_p, POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_ipc_kernel_read_fits": (c_int32, [c_char_p, c_char_p, wfpsf_options_p,
        POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_ipc_kernel_create_composed": (c_int32, [wfpsf_ipc_kernel_p, wfpsf_ipc_kernel_p,
        POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_ipc_kernel_create_neumann": (c_int32, [wfpsf_ipc_kernel_p, c_int64,
        POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_ipc_kernel_create_autocorrelation": (c_int32, [wfpsf_ipc_kernel_p,
        POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_ipc_wfc3_deviations": (c_int32, [c_int64, c_void_p]),
    "wfpsf_ipc_kernel_destroy": (None, [wfpsf_ipc_kernel_p]),
    "wfpsf_ipc_kernel_taps": (c_int32, [wfpsf_ipc_kernel_p, c_int64, c_void_p, POINTER(c_int64),
        POINTER(c_int64)]),
    "wfpsf_ipc_kernel_get": (c_int32, [wfpsf_ipc_kernel_p, c_int32, POINTER(c_double)]),
    "wfpsf_ipc_kernel_transform": (c_int32, [wfpsf_ipc_kernel_p, c_double, c_double,
        POINTER(c_double), POINTER(c_double)]),
    "wfpsf_ipc_apply": (c_int32, [wfpsf_ipc_kernel_p, wfpsf_image_p, c_int32, wfpsf_options_p,
        wfpsf_image_p, POINTER(c_int64)]),
    "wfpsf_ipc_kernel_self_test": (c_int32, [wfpsf_ipc_kernel_p, wfpsf_options_p, c_int64,
        c_void_p]),
    "wfpsf_ipc_correct": (c_int32, [wfpsf_ipc_kernel_p, wfpsf_image_p, c_int32, wfpsf_options_p,
        wfpsf_image_p, POINTER(c_double), POINTER(c_double), POINTER(c_int64), POINTER(c_int64)]),
    "wfpsf_ipc_covariance": (c_int32, [wfpsf_ipc_kernel_p, wfpsf_image_p, c_int64, c_int64, c_int32,
        wfpsf_options_p, wfpsf_image_p]),
    "wfpsf_varying_ipc_create_maps": (c_int32, [wfpsf_image_p, wfpsf_image_p, wfpsf_image_p,
        wfpsf_options_p, POINTER(wfpsf_varying_ipc_p)]),
    "wfpsf_varying_ipc_create_polynomials": (c_int32, [c_int64, c_int64, c_int64, c_void_p,
        c_void_p, c_void_p, wfpsf_options_p, POINTER(wfpsf_varying_ipc_p)]),
    "wfpsf_varying_ipc_create_regions": (c_int32, [wfpsf_image_p, c_int64,
        POINTER(wfpsf_ipc_kernel_p), POINTER(wfpsf_varying_ipc_p)]),
    "wfpsf_varying_ipc_destroy": (None, [wfpsf_varying_ipc_p]),
    "wfpsf_varying_ipc_kernel": (c_int32, [wfpsf_varying_ipc_p, c_int64, c_int64,
        POINTER(wfpsf_ipc_kernel_p)]),
    "wfpsf_varying_ipc_margin": (c_int32, [wfpsf_varying_ipc_p, POINTER(c_double), POINTER(c_int64),
        POINTER(c_int64)]),
    "wfpsf_varying_ipc_apply": (c_int32, [wfpsf_varying_ipc_p, wfpsf_image_p, c_int32,
        wfpsf_options_p, wfpsf_image_p, POINTER(c_int64)]),
    "wfpsf_varying_ipc_correct": (c_int32, [wfpsf_varying_ipc_p, wfpsf_image_p, c_int32,
        wfpsf_options_p, wfpsf_image_p, POINTER(c_double), POINTER(c_double), POINTER(c_int64),
        POINTER(c_int64)]),
    "wfpsf_varying_ipc_covariance": (c_int32, [wfpsf_varying_ipc_p, wfpsf_image_p, c_int64, c_int64,
        c_int32, wfpsf_options_p, wfpsf_image_p]),
    "wfpsf_varying_ipc_autocorrelation": (c_int32, [wfpsf_varying_ipc_p, wfpsf_image_p, c_int64,
        c_int64, c_int32, wfpsf_options_p, c_int64, c_void_p, POINTER(c_int64), POINTER(c_int64)]),
    "wfpsf_chain_create": (c_int32, [POINTER(wfpsf_chain_p)]),
    "wfpsf_chain_create_default": (c_int32, [wfpsf_instrument_p, c_double, POINTER(wfpsf_chain_p)]),
    "wfpsf_chain_destroy": (None, [wfpsf_chain_p]),
    "wfpsf_chain_add": (c_int32, [wfpsf_chain_p, c_int32, c_int64, c_void_p]),
    "wfpsf_chain_add_ipc": (c_int32, [wfpsf_chain_p, wfpsf_ipc_kernel_p, c_int32]),
    "wfpsf_chain_add_varying_ipc": (c_int32, [wfpsf_chain_p, wfpsf_varying_ipc_p, c_int32,
        c_int32]),
    "wfpsf_chain_add_map": (c_int32, [wfpsf_chain_p, c_int32, c_int64, c_void_p, wfpsf_image_p]),
    "wfpsf_chain_step": (c_int32, [wfpsf_chain_p, c_int64, c_int64, c_void_p, POINTER(c_int64),
        POINTER(c_int32)]),
    "wfpsf_step_name": (c_char_p, [c_int32]),
    "wfpsf_chain_apply": (c_int32, [wfpsf_chain_p, wfpsf_image_p, c_int64, POINTER(wfpsf_image_p),
        wfpsf_options_p, POINTER(c_int64), POINTER(c_int64)]),
    "wfpsf_noise_add": (c_int32, [wfpsf_image_p, c_double, wfpsf_ipc_kernel_p, wfpsf_options_p]),
    "wfpsf_sky_level": (c_int32, [wfpsf_instrument_p, c_char_p, c_double, c_double,
        POINTER(c_double)]),
    "wfpsf_sky_background": (c_int32, [wfpsf_instrument_p, c_char_p, c_double, c_double, c_double,
        c_double, POINTER(c_double)]),
    "wfpsf_observation_create": (c_int32, [wfpsf_instrument_p, c_double, c_double, c_double,
        wfpsf_options_p, POINTER(wfpsf_observation_p)]),
    "wfpsf_observation_create_on_date": (c_int32, [wfpsf_instrument_p, c_double, c_double, c_double,
        wfpsf_options_p, POINTER(wfpsf_observation_p)]),
    "wfpsf_observation_create_aimed": (c_int32, [wfpsf_instrument_p, c_int32, c_double, c_double,
        c_double, c_double, c_double, wfpsf_options_p, POINTER(wfpsf_observation_p)]),
    "wfpsf_observation_destroy": (None, [wfpsf_observation_p]),
    "wfpsf_observation_get": (c_int32, [wfpsf_observation_p, c_int32, c_int32, POINTER(c_double)]),
    "wfpsf_observation_sky_to_pixel": (c_int32, [wfpsf_observation_p, c_int32, c_int64, c_void_p,
        c_void_p, c_void_p, c_void_p, POINTER(c_int64)]),
    "wfpsf_observation_pixel_to_sky": (c_int32, [wfpsf_observation_p, c_int32, c_int64, c_void_p,
        c_void_p, c_void_p, c_void_p, POINTER(c_int64)]),
    "wfpsf_observation_find_sca": (c_int32, [wfpsf_observation_p, c_int32, c_int64, c_void_p,
        c_void_p, c_void_p, c_void_p, c_void_p, POINTER(c_int64)]),
    "wfpsf_observation_bounds": (c_int32, [wfpsf_observation_p, c_int32, c_int32, POINTER(c_int64),
        POINTER(c_int64), POINTER(c_int64), POINTER(c_int64)]),
    "wfpsf_observation_jacobian": (c_int32, [wfpsf_observation_p, c_int32, c_int64, c_void_p,
        c_void_p, c_void_p, c_void_p, c_void_p, POINTER(c_int64)]),
    "wfpsf_observation_fits_header": (c_int32, [wfpsf_observation_p, c_int32, c_int64, c_char_p,
        POINTER(c_int64)]),
    "wfpsf_julian_date": (c_int32, [c_int32, c_int32, c_int32, c_int32, c_int32, c_double,
        POINTER(c_double)]),
    "wfpsf_sun_position": (c_int32, [c_double, wfpsf_options_p, POINTER(c_double),
        POINTER(c_double)]),
    "wfpsf_pointing_allowed": (c_int32, [wfpsf_instrument_p, c_double, c_double, c_double,
        wfpsf_options_p, POINTER(c_double), POINTER(c_int32)]),
    "wfpsf_pointing_best_pa": (c_int32, [wfpsf_instrument_p, c_double, c_double, c_double,
        wfpsf_options_p, POINTER(c_double)]),
    "wfpsf_moments_measure": (c_int32, [wfpsf_image_p, wfpsf_options_p, POINTER(wfpsf_moments_p)]),
    "wfpsf_moments_measure_masked": (c_int32, [wfpsf_image_p, wfpsf_image_p, wfpsf_image_p,
        wfpsf_options_p, POINTER(wfpsf_moments_p)]),
    "wfpsf_moments_measure_weighted": (c_int32, [wfpsf_image_p, c_double, c_double, c_double,
        c_double, c_double, POINTER(wfpsf_moments_p)]),
    "wfpsf_moments_sums": (c_int32, [wfpsf_image_p, c_double, c_double, c_void_p, c_int64,
        c_void_p]),
    "wfpsf_moments_measure_unweighted": (c_int32, [wfpsf_image_p, c_double, c_double,
        POINTER(wfpsf_moments_p)]),
    "wfpsf_moments_destroy": (None, [wfpsf_moments_p]),
    "wfpsf_moments_status": (c_int32, [wfpsf_moments_p]),
    "wfpsf_moments_get": (c_int32, [wfpsf_moments_p, c_int32, POINTER(c_double)]),
    "wfpsf_moments_covariance": (c_int32, [wfpsf_moments_p, c_int32, c_int32, POINTER(c_double)]),
    "wfpsf_moments_differentiate": (c_int32, [wfpsf_moments_p, wfpsf_image_p, wfpsf_image_p,
        wfpsf_image_p, POINTER(wfpsf_moments_p)]),
    "wfpsf_moments_influence": (c_int32, [wfpsf_moments_p, wfpsf_image_p, c_int32, wfpsf_image_p]),
    "wfpsf_size_encircled_energy": (c_int32, [wfpsf_image_p, c_double, c_double, c_double,
        wfpsf_options_p, POINTER(c_double), POINTER(c_double)]),
    "wfpsf_size_ee_radius": (c_int32, [wfpsf_image_p, c_double, c_double, c_double, c_int32,
        wfpsf_options_p, POINTER(c_double), POINTER(c_double)]),
    "wfpsf_size_fwhm": (c_int32, [wfpsf_image_p, c_double, c_double, POINTER(c_double)]),
    "wfpsf_size_ee_radius_derivative": (c_int32, [wfpsf_image_p, wfpsf_image_p, wfpsf_image_p,
        c_double, c_double, c_double, wfpsf_options_p, POINTER(c_double), POINTER(c_double)]),
    "wfpsf_size_profile": (c_int32, [wfpsf_image_p, c_double, c_double, c_int64, c_void_p,
        wfpsf_options_p, c_void_p, c_void_p]),
    "wfpsf_size_profile_fwhm": (c_int32, [wfpsf_image_p, c_double, c_double, wfpsf_options_p,
        POINTER(c_double), POINTER(c_double)]),
    "wfpsf_study_create": (c_int32, [wfpsf_instrument_p, c_int32, wfpsf_options_p,
        POINTER(wfpsf_study_p)]),
    "wfpsf_study_destroy": (None, [wfpsf_study_p]),
    "wfpsf_study_size": (c_int32, [wfpsf_study_p, c_int32, POINTER(c_int64), POINTER(c_int64)]),
    "wfpsf_study_column": (c_char_p, [wfpsf_study_p, c_int32, c_int64]),
    "wfpsf_study_value": (c_int32, [wfpsf_study_p, c_int32, c_int64, c_int64, POINTER(c_double)]),
    "wfpsf_study_text": (c_char_p, [wfpsf_study_p, c_int32, c_int64, c_int64]),
    "wfpsf_study_write_csv": (c_int32, [wfpsf_study_p, c_char_p]),
    "wfpsf_catalogue_create": (c_int32, [c_int32, c_int32, POINTER(wfpsf_catalogue_p)]),
    "wfpsf_catalogue_destroy": (None, [wfpsf_catalogue_p]),
    "wfpsf_catalogue_add_colour": (c_int32, [wfpsf_catalogue_p, c_double, wfpsf_sed_p,
        POINTER(c_int32)]),
    "wfpsf_catalogue_add_stars": (c_int32, [wfpsf_catalogue_p, c_int64, c_void_p, c_void_p,
        c_void_p, c_void_p]),
    "wfpsf_catalogue_add_galaxies": (c_int32, [wfpsf_catalogue_p, c_int64, c_void_p, c_void_p,
        c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p]),
    "wfpsf_catalogue_size": (c_int32, [wfpsf_catalogue_p, POINTER(c_int64)]),
    "wfpsf_instrument_ab_zero_rate": (c_int32, [wfpsf_instrument_p, c_char_p, POINTER(c_double)]),
    "wfpsf_scene_store_create": (c_int32, [POINTER(wfpsf_scene_store_p)]),
    "wfpsf_scene_store_destroy": (None, [wfpsf_scene_store_p]),
    "wfpsf_scene_store_memory": (c_int32, [wfpsf_scene_store_p, POINTER(c_int64)]),
    "wfpsf_scene_store_write": (c_int32, [wfpsf_scene_store_p, c_char_p]),
    "wfpsf_scene_store_read": (c_int32, [wfpsf_scene_store_p, c_char_p]),
    "wfpsf_options_set_scene_store": (c_int32, [wfpsf_options_p, wfpsf_scene_store_p]),
    "wfpsf_scene_create": (c_int32, [wfpsf_instrument_p, wfpsf_observation_p, c_char_p, c_int32,
        wfpsf_catalogue_p, wfpsf_image_p, c_double, c_double, wfpsf_options_p,
        POINTER(wfpsf_scene_p)]),
    "wfpsf_scene_destroy": (None, [wfpsf_scene_p]),
    "wfpsf_scene_get": (c_int32, [wfpsf_scene_p, c_int32, POINTER(c_double)]),
    "wfpsf_scene_get_group": (c_int32, [wfpsf_scene_p, c_int64, c_int32, POINTER(c_double)]),
    "wfpsf_scene_groups_of": (c_int32, [wfpsf_scene_p, c_int64, c_void_p]),
    "wfpsf_scene_text": (c_int32, [wfpsf_scene_p, c_int64, c_char_p, POINTER(c_int64)]),
    "wfpsf_scene_render": (c_int32, [wfpsf_scene_p, wfpsf_options_p, wfpsf_image_p,
        POINTER(wfpsf_rendering_p)]),
    "wfpsf_rendering_destroy": (None, [wfpsf_rendering_p]),
    "wfpsf_rendering_get": (c_int32, [wfpsf_rendering_p, c_int32, POINTER(c_double)]),
    "wfpsf_scene_truth": (c_int32, [wfpsf_scene_p, c_int64, c_void_p, wfpsf_ipc_kernel_p,
        wfpsf_options_p, c_void_p]),
    "wfpsf_exposure_create": (c_int32, [wfpsf_instrument_p, wfpsf_observation_p, c_char_p,
        wfpsf_catalogue_p, wfpsf_chain_p, wfpsf_options_p, POINTER(wfpsf_exposure_p)]),
    "wfpsf_exposure_destroy": (None, [wfpsf_exposure_p]),
    "wfpsf_exposure_path": (c_int32, [wfpsf_exposure_p, c_char_p, c_int32, c_int64, c_char_p,
        POINTER(c_int64)]),
    "wfpsf_exposure_make": (c_int32, [wfpsf_exposure_p, c_int32, c_char_p, wfpsf_options_p,
        POINTER(c_int32)]),
}


def load(path):
    """The library with all of its functions declared."""
    library = ctypes.CDLL(path)
    for name, (result, arguments) in FUNCTIONS.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
    return library
