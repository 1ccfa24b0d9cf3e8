# SPDX-License-Identifier: GPL-3.0-or-later

const OTF_PROPERTIES = constants_of("WFPSF_OTF_")
const RESPONSES = constants_of("WFPSF_RESPONSE_")
const ORDERS = constants_of("WFPSF_ORDER_")

"""
    OTF(psf; eps)
    OTF(f, ...)

The optical transfer function of a PSF: the Fourier transform of the star that `draw` draws, one at
k = 0, zero beyond the cut-off. Immutable: threads may share it. The PSF may be closed afterwards.

Called as `otf(kx, ky; response = :effective)`, kx and ky in cycles per arcsec, two numbers or two
arrays of one size, it gives complex numbers: integral of I(θ) exp(-2πi k⋅θ). `response` is
`:effective` (with the native pixel, as in `draw`) or `:diffraction` (the telescope alone).

Properties are read as `otf.cutoff`: `error_estimate` (of a PSF made of it, in units of the PSF's
peak, which `eps` bounds), `value_error` (the largest of any value: near k = 0 and along struts),
`cutoff` (of kx and ky, cycles per arcsec), `pixels` (across the pupil).
"""
mutable struct OTF <: Handle
    pointer::Ptr{Cvoid}

    function OTF(psf::PSF; keywords...)
        pointer = with_options((:eps,), keywords) do options
            created() do out
                LibWfpsf.wfpsf_otf_create(psf, options, out)
            end
        end
        return finalizer(close, new(pointer))
    end
end

destroy(::OTF, pointer) = LibWfpsf.wfpsf_otf_destroy(pointer)

Base.propertynames(::OTF) = keys(OTF_PROPERTIES)

function Base.getproperty(otf::OTF, name::Symbol)
    value = Ref{Float64}()
    check(LibWfpsf.wfpsf_otf_get(otf, choose(OTF_PROPERTIES, :property, name), value))
    return value[]
end

function (otf::OTF)(kx::AbstractArray{<:Real}, ky::AbstractArray{<:Real};
                    response::Symbol = :effective)
    axes(kx) == axes(ky) || throw(DimensionMismatch(
        "kx and ky must have one size, not $(size(kx)) and $(size(ky))"))
    x, y = collect(Float64, kx), collect(Float64, ky)
    re, im = similar(x), similar(x)
    check(LibWfpsf.wfpsf_otf_values(otf, choose(RESPONSES, :response, response), length(x), x, y,
                                    re, im))
    return complex.(re, im)
end

(otf::OTF)(kx::Real, ky::Real; keywords...) = only(otf([kx], [ky]; keywords...))

"""
    otf_grid(otf, nx, ny, step; response = :effective, order = :wrapped)

A matrix of `nx` by `ny` complex numbers, `step` cycles per arcsec between neighbours. `order` is
`:wrapped` (as `fft` gives them), `:half` (as `rfft` does, nx = N÷2 + 1), or `:centred` (k = 0 at
element (nx÷2 + 1, ny÷2 + 1)). An image of N pixels of s arcsec a side takes `step = 1 / (N * s)`.
"""
function otf_grid(otf::OTF, nx::Integer, ny::Integer, step::Real; response::Symbol = :effective,
                  order::Symbol = :wrapped)
    re, im = Image(Float64, nx, ny), Image(Float64, nx, ny)
    check(LibWfpsf.wfpsf_otf_grid(otf, choose(RESPONSES, :response, response),
                                  choose(ORDERS, :order, order), step, re, im))
    return complex.(re.pixels, im.pixels)
end
