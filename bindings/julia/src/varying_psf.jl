# SPDX-License-Identifier: GPL-3.0-or-later

const VARYING_PSF_PROPERTIES = constants_of("WFPSF_VARYING_PSF_")

"""
    VaryingPSF(instrument, band, sca; wavelength_nm = 0, options...)
    VaryingPSF(instrument, band, sca, sed; options...)
    VaryingPSF(f, ...)

The PSF all over detector `sca` and some pixels around it: made once, then cheap at any place. Of one
colour (`wavelength_nm = 0`: the band's effective wavelength), or of a source's seen through the
band. The options are those of `PSF`; `eps` is of any pixel at any place.

`PSF(varying, x, y)` is the PSF at (x, y), pixels of the detector, the first one's centre at (1, 1).

Properties: `error_estimate`, `interpolation_error` (the part of it that comes from the
interpolation), `degree` (of the polynomials in each coordinate), `rank` (images that all PSFs are
sums of), `exact_psfs` (that were made for it), `memory_bytes`, `margin` (pixels around the detector).
"""
mutable struct VaryingPSF <: Handle
    pointer::Ptr{Cvoid}

    function VaryingPSF(instrument::Instrument, band::AbstractString, sca::Integer;
                        wavelength_nm::Real = 0, keywords...)
        return finalizer(close, new(varying(instrument, band, sca, wavelength_nm, C_NULL, keywords)))
    end

    function VaryingPSF(instrument::Instrument, band::AbstractString, sca::Integer, sed::SED;
                        keywords...)
        return finalizer(close, new(varying(instrument, band, sca, 0, sed, keywords)))
    end
end

function varying(instrument, band, sca, wavelength_nm, sed, keywords)
    return with_options((PSF_OPTIONS..., :threads), keywords) do options
        created() do out
            LibWfpsf.wfpsf_varying_psf_create(instrument, band, sca, wavelength_nm, sed, options,
                                              out)
        end
    end
end

destroy(::VaryingPSF, pointer) = LibWfpsf.wfpsf_varying_psf_destroy(pointer)

Base.propertynames(::VaryingPSF) = keys(VARYING_PSF_PROPERTIES)

function Base.getproperty(varying::VaryingPSF, name::Symbol)
    value = Ref{Float64}()
    check(LibWfpsf.wfpsf_varying_psf_get(
        varying, choose(VARYING_PSF_PROPERTIES, :property, name), value))
    return value[]
end

PSF(varying::VaryingPSF, x::Real, y::Real) =
    PSF(created(out -> LibWfpsf.wfpsf_varying_psf_at(varying, x - 1, y - 1, out)))

"""
    add_stars!(image, varying, x0, y0, x, y, flux; threads = 1, force = false)

Adds stars as the other method does, each with the PSF of its own place. (x0, y0) is where the
centre of the image's first native pixel stands on the detector, whose first pixel's is (1, 1).
"""
function add_stars!(image::Image, varying::VaryingPSF, x0::Real, y0::Real,
                    x::AbstractVector{<:Real}, y::AbstractVector{<:Real},
                    flux::AbstractVector{<:Real}; keywords...)
    length(x) == length(y) == length(flux) || throw(DimensionMismatch(
        "x, y and flux must have one length, not $(length(x)), $(length(y)) and $(length(flux))"))
    with_options(STAR_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_varying_psf_add_stars(
            varying, x0 - 1, y0 - 1, length(x), Vector{Float64}(x) .- 1, Vector{Float64}(y) .- 1,
            Vector{Float64}(flux), options, image))
    end
    return image
end
