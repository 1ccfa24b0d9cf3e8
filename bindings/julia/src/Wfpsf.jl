# SPDX-License-Identifier: GPL-3.0-or-later

"""
WFIRST/Roman PSFs, interpixel capacitance and moments of images, by the shared library `libwfpsf`.

    using Wfpsf

    instrument = Instrument("wfirst-afta-c5")
    wavelength = band(instrument, "J129"; rule = :paper).effective_nm
    star = PSF(psf -> draw(psf, 512, 512; oversampling = 32), instrument, 7, wavelength; eps = 1e-7)
    blurred = IPCKernel(kernel -> apply_ipc(kernel, star), 0.02, 0.002)
    adaptive_moments(blurred).sigma

- Positions count from 1: the centre of the first pixel is (1, 1), as in FITS, both in arguments
  and in results. The texts of errors come from the C library and count from (0, 0).
- Images are matrices of size `(nx, ny)`: `pixels[x, y]`, x along the fast axis.
- A call that fails throws a [`WfpsfError`](@ref); one that succeeds with a reservation logs a
  warning.
- What takes keyword options says which; [`options`](@ref) lists their defaults and bounds.
- Objects that hold memory of the library free it when they are collected, or at `close`, which may
  be called twice; every constructor has a `do`-block form that closes at the end of the block.

The environment variable `WFPSF_LIBRARY` names the shared library when the package is loaded;
without it, it is the one of the tree that the package was installed in, or else the one that the
system's loader finds.
"""
module Wfpsf

export WfpsfError, options,
    Design, set_telescope!, add_strut!, set_detector!, set_zernikes!, add_band!,
    Instrument, constant, constants, band, bands, throughput, zernikes, pupil,
    Image, record, set_record!, read_fits, write_fits,
    interleave, interleave!, deinterleave, deinterleave!,
    Observation, aimed, on_date, sky_to_pixel, pixel_to_sky, find_sca, sca_bounds, pixel_jacobian,
    fits_header, julian_date, sun_position, pointing_allowed, best_pa,
    SED, power_law, black_body, redshifted, photon_density,
    PSF, psfs, draw, draw!, add_stars!, add_bright_star!, draw_memory, convolve!,
    VaryingPSF,
    OTF, otf_grid,
    Study, study_table, write_csv,
    IPCKernel, wfc3_kernel, wfc3_deviations, read_kernel, correction, flipped, compose,
    autocorrelation, taps, properties, transform, self_test, apply_ipc, apply_ipc!, correct_ipc!,
    covariance,
    VaryingIPC, weakest,
    Chain, add!, steps, apply_chain!, add_noise!, sky_level, sky_background,
    Catalogue, add_colour!, add_galaxies!, ab_zero_rate,
    Scene, SceneStore, write_scene_store, read_scene_store!,
    scene_groups, groups_of_sources, render!, scene_truth,
    Exposure, exposure_path, make_exposure,
    Moments, adaptive_moments, unweighted_moments, weighted_moments, moment_sums,
    moments_covariance, moments_derivative, moments_influence,
    encircled_energy, ee_radius, ee_radius_derivative, radial_profile, profile_fwhm, fwhm

include("LibWfpsf.jl")
using .LibWfpsf

include("status.jl")
include("names.jl")
include("handle.jl")
include("options.jl")
include("design.jl")
include("instrument.jl")
include("image.jl")
include("interleave.jl")
include("pupil.jl")
include("observation.jl")
include("sed.jl")
include("psf.jl")
include("varying_psf.jl")
include("otf.jl")
include("ipc.jl")
include("varying_ipc.jl")
include("chain.jl")
include("scene.jl")
include("moments.jl")
include("size.jl")
include("study.jl")

"Version of the loaded library."
version() = VersionNumber(unsafe_string(LibWfpsf.wfpsf_version()))

# Installed, the package stands in <prefix>/share/wfpsf/julia, and says where the library is from
# there; the file is not in the source tree.
const INSTALLED = joinpath(dirname(@__DIR__), "installed.txt")

function default_library()
    name = "libwfpsf.so.$(LibWfpsf.WFPSF_ABI_NUMBER)"
    return isfile(INSTALLED) ?
           normpath(joinpath(dirname(INSTALLED), readline(INSTALLED), name)) : name
end

function __init__()
    path = get(default_library, ENV, "WFPSF_LIBRARY")
    try
        LibWfpsf.load(path)
    catch failure
        error("cannot load the library $path; the environment variable WFPSF_LIBRARY can name ",
              "another: ", sprint(showerror, failure))
    end
    check(LibWfpsf.wfpsf_abi_check(LibWfpsf.WFPSF_ABI_NUMBER))
end

end
