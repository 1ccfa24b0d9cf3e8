# SPDX-License-Identifier: GPL-3.0-or-later

const PSF_PROPERTIES = constants_of("WFPSF_PSF_")
const PSF_OPTIONS = (:eps, :struts, :psf_radius, :piston_tilt, :frame, :field_rule, :jitter_xx,
                     :jitter_xy, :jitter_yy, :charge_diffusion, :mask_points, :pixel_response,
                     :zernikes, :opd, :memory_limit, :progress)
const STAR_OPTIONS = (:threads, :force)
const DRAW_OPTIONS = (:memory_limit, :progress)

"""
    PSF(instrument, sca, wavelength_nm; options...)
    PSF(instrument, band, sca, x, y; wavelength_nm = 0, options...)
    PSF(instrument, band, sca, x, y, sed; options...)
    PSF(instrument, sca, wavelength_nm, mask; mask_scale_m, axis_x, axis_y, options...)
    PSF(f, ...)

The effective PSF at the centre of detector `sca`: the diffraction image of a star,
averaged over the native pixel. Immutable: threads may share it. The instrument may be closed
afterwards.

Options: `eps` (largest error of any pixel, in units of the stamp's peak), `struts`, `psf_radius`
(native pixels made in advance), `piston_tilt`, `zernikes`, a vector of extra aberrations in Noll's
order (waves rms at the instrument's reference wavelength), and `opd = (map = image, scale_m = s,
axis_x = x, axis_y = y)`, an [`Image`](@ref) of optical path differences in metres, `s` metres from
sample to sample, with the optical axis at sample (x, y), the first one's centre being (1, 1).
`jitter_xx`, `jitter_xy`, `jitter_yy` (arcsec²) are the covariance of the telescope's jitter,
`charge_diffusion` (native pixels) the standard deviation of the detector's. `pixel_response = 0`
leaves out the average over the native pixel. `progress` is a
function that long work calls now and then with the part that is done, 0 to 1: if it returns
`false`, the work stops with a [`WfpsfError`](@ref) of code `WFPSF_ERROR_CANCELLED`; if it throws,
the work stops with that exception.

The second form is the PSF at (x, y), pixels of the detector (the first one's centre is (1, 1)), and
takes the pupil that the band is used with; `"roman-c9"` needs it. `wavelength_nm = 0` is the band's
effective wavelength. Its options also are `frame` (0: science coordinates, 1: exit pupil) and
`field_rule` (0: all field points are met, 1: bilinear between the corners).

The third form is the PSF of a source of many colours, seen through the band: the sum of
monochromatic ones over the photons detected, an [`SED`](@ref) times the band's throughput, at as
many wavelengths as `eps` needs. [`psfs`](@ref) makes those of several SEDs.

The fourth form takes the pupil from an image of transmissions with pixels of `mask_scale_m` metres
and the optical axis at (`axis_x`, `axis_y`), the centre of the mask's first pixel being (1, 1). It
takes a second for a mask of 4096 × 4096.

Properties are read as `psf.error_estimate`: `wavelength_nm` (of many, the mean by photons
detected), `pixel_scale_arcsec`, `error_estimate` (numerical error of any pixel, in units of the
peak), `model_error` (of the pupil's geometry against the published mask, same units), `peak`
(largest fraction of the light in one native pixel), `nodes`, `grid_size`, `grid_step_arcsec`,
`radius`, `lit_area_m2`, `wavelengths` (how many the PSF is a sum over).

```jldoctest
julia> psf = PSF(Instrument(), 7, 1292.11; eps = 1e-5);

julia> psf.error_estimate < 1e-5
true

julia> star = draw(psf, 32, 32);

julia> (size(star), record(star).applied)
((32, 32), [:pixel_response])
```
"""
mutable struct PSF <: Handle
    pointer::Ptr{Cvoid}
    PSF(pointer::Ptr{Cvoid}) = finalizer(close, new(pointer))
end

function PSF(instrument::Instrument, sca::Integer, wavelength_nm::Real; keywords...)
    with_options(PSF_OPTIONS, keywords) do options
        PSF(created() do out
            LibWfpsf.wfpsf_psf_create(instrument, sca, wavelength_nm, options, out)
        end)
    end
end

function PSF(instrument::Instrument, band::AbstractString, sca::Integer, x::Real, y::Real;
             wavelength_nm::Real = 0, keywords...)
    with_options(PSF_OPTIONS, keywords) do options
        PSF(created() do out
            LibWfpsf.wfpsf_psf_create_in_band(instrument, band, sca, x - 1, y - 1, wavelength_nm,
                                              options, out)
        end)
    end
end

PSF(instrument::Instrument, band::AbstractString, sca::Integer, x::Real, y::Real, sed::SED;
    keywords...) = only(psfs(instrument, band, sca, x, y, [sed]; keywords...))

function PSF(instrument::Instrument, sca::Integer, wavelength_nm::Real, mask::Image;
             mask_scale_m::Real, axis_x::Real, axis_y::Real, keywords...)
    with_options(PSF_OPTIONS, keywords) do options
        PSF(created() do out
            LibWfpsf.wfpsf_psf_create_from_mask(instrument, mask, mask_scale_m, axis_x - 1,
                                                axis_y - 1, sca, wavelength_nm, options, out)
        end)
    end
end

"""
    psfs(instrument, band, sca, x, y, seds; options...)

A vector of the [`PSF`](@ref)s of a vector of [`SED`](@ref)s, which share their monochromatic
images: many cost little more than one.
"""
function psfs(instrument::Instrument, band::AbstractString, sca::Integer, x::Real, y::Real,
              seds::AbstractVector{SED}; keywords...)
    with_options(PSF_OPTIONS, keywords) do options
        out = fill(C_NULL, length(seds))
        GC.@preserve seds check(LibWfpsf.wfpsf_psf_create_chromatic(
            instrument, band, sca, x - 1, y - 1, length(seds), handle_pointers(seds), options, out))
        return PSF.(out)
    end
end

destroy(::PSF, pointer) = LibWfpsf.wfpsf_psf_destroy(pointer)

Base.propertynames(::PSF) = keys(PSF_PROPERTIES)

function Base.getproperty(psf::PSF, name::Symbol)
    value = Ref{Float64}()
    check(LibWfpsf.wfpsf_psf_get(psf, choose(PSF_PROPERTIES, :property, name), value))
    return value[]
end

"""
    draw!(image, psf, x, y; flux = 1, options...)
    draw(psf, nx, ny; x = (nx+1)/2, y = (ny+1)/2, flux = 1, oversampling = 1, pixel_type = Float64,
         options...)

Draws one star, overwriting the image; the second form makes the image. (x, y), in pixels of the
image, is where the optical axis falls, not the centroid; the centre of the first pixel is (1, 1).

Each pixel gets `flux / N^2` times the fraction of the light that a native pixel centred there
receives, N the image's oversampling: the sum over an infinite image is the flux at any N. The
record becomes the PSF's pixel scale, with the pixel response applied.

The image may be of any size. Beyond the PSF's `radius` its light is drawn from the diffraction
image anew, with nothing folded back, in a time that goes with the area and in no more memory than
`memory_limit` bytes; `progress` is called meanwhile.
"""
function draw!(image::Image, psf::PSF, x::Real, y::Real; flux::Real = 1, keywords...)
    with_options(DRAW_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_psf_draw(psf, x - 1, y - 1, flux, options, image))
    end
    return image
end

"""
    add_bright_star!(image, psf, x, y; flux = 1, force = false, options...)

Adds a star to what the image holds, on all of its pixels: for stars whose spikes are seen far from
them. Otherwise as `draw!`; `force` as in `add_stars!`.
"""
function add_bright_star!(image::Image, psf::PSF, x::Real, y::Real; flux::Real = 1, keywords...)
    with_options((DRAW_OPTIONS..., :force), keywords) do options
        check(LibWfpsf.wfpsf_psf_add_bright_star(psf, x - 1, y - 1, flux, options, image))
    end
    return image
end

"""
    draw_memory(psf, image, x, y)

The bytes that drawing a star at (x, y) into the image would take: `(least, most)`, without which it
cannot be done and with which it is done in one go.
"""
function draw_memory(psf::PSF, image::Image, x::Real, y::Real)
    least, most = Ref{Int64}(), Ref{Int64}()
    check(LibWfpsf.wfpsf_psf_draw_memory(psf, x - 1, y - 1, image, least, most))
    return (least = least[], most = most[])
end

"""
    add_stars!(image, psf, x, y, flux; threads = 1, force = false)

Adds stars at the positions `x`, `y` with the given fluxes, three vectors of one length, to the
image: each with the light that falls within the PSF's `radius` (native pixels) of it along both
axes, clipped at the image's borders. (x, y) are pixels of the image, the centre of the first one
being (1, 1). The result does not depend on the number of threads. An image that has been through
IPC is refused unless `force` is set.
"""
function add_stars!(image::Image, psf::PSF, x::AbstractVector{<:Real}, y::AbstractVector{<:Real},
                    flux::AbstractVector{<:Real}; keywords...)
    length(x) == length(y) == length(flux) || throw(DimensionMismatch(
        "x, y and flux must have one length, not $(length(x)), $(length(y)) and $(length(flux))"))
    with_options(STAR_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_psf_add_stars(psf, length(x), Vector{Float64}(x) .- 1,
                                           Vector{Float64}(y) .- 1, Vector{Float64}(flux), options,
                                           image))
    end
    return image
end

"""
    convolve!(image, psf, galaxy, x, y; flux = 1, force = false)

Draws an extended source, overwriting the image: `galaxy`, an image of the flux of each sample, its
oversampling a multiple of the image's, convolved with the PSF. It is what `draw!` gives for a star
at every sample, added up; nothing wraps around. The centre of `galaxy` falls on (x, y), pixels of
the image, the centre of the first one being (1, 1). `flux` multiplies the samples. A galaxy that
holds the pixel response or IPC already is refused unless `force` is set.
"""
function convolve!(image::Image, psf::PSF, galaxy::Image, x::Real, y::Real; flux::Real = 1,
                   keywords...)
    with_options((:force,), keywords) do options
        check(LibWfpsf.wfpsf_psf_convolve(psf, galaxy, x - 1, y - 1, flux, options, image))
    end
    return image
end

function draw(psf::PSF, nx::Integer, ny::Integer; x::Real = (nx + 1) / 2, y::Real = (ny + 1) / 2,
              flux::Real = 1, oversampling::Integer = 1, pixel_type::Type{<:PixelType} = Float64,
              keywords...)
    image = Image(pixel_type, nx, ny; oversampling = oversampling)
    return draw!(image, psf, x, y; flux = flux, keywords...)
end
