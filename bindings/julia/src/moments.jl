# SPDX-License-Identifier: GPL-3.0-or-later

const MOMENTS_PROPERTIES = constants_of("WFPSF_MOMENTS_")
const MOMENTS_OPTIONS = (:moments_tolerance, :moments_max_passes, :moments_guess_x,
                         :moments_guess_y, :moments_guess_sigma)

"""
Moments of an image. Lengths are in pixels of the image; the centroid counts from the centre of the
first pixel at (1, 1). What does not apply is NaN.

- `status`: how the measurement ended; 0: well
- `centroid_x`, `centroid_y`
- `mxx`, `mxy`, `myy`: second moments, the matrix M
- `sigma`: det(M)^(1/4); `sigma_trace`: sqrt(mxx + myy)
- `e1`, `e2`: (mxx - myy, 2 mxy) / (mxx + myy); `e`: |e|
- `beta`: position angle of the major axis from x towards y, radians
- `flux`: of the best-fit Gaussian; of the pixels for unweighted moments
- `rho4`: weighted fourth moment, 2 for a Gaussian
- `passes`: over the image
- `error_estimate`: whitened error of centroid and moments
- `residual`: norm of the gradient at the end, whitened
- `curvature`: smallest eigenvalue of minus the Hessian, whitened; 1/8 for a Gaussian
- `edge_fraction`: fraction of the weight that falls outside the image
"""
struct Moments
    status::Int32
    centroid_x::Float64
    centroid_y::Float64
    mxx::Float64
    mxy::Float64
    myy::Float64
    sigma::Float64
    sigma_trace::Float64
    e1::Float64
    e2::Float64
    e::Float64
    beta::Float64
    flux::Float64
    rho4::Float64
    passes::Float64
    error_estimate::Float64
    residual::Float64
    curvature::Float64
    edge_fraction::Float64
end

const MOMENTS_FIELDS = fieldnames(Moments)[2:end]
const MOMENTS_KEYS = Tuple(MOMENTS_PROPERTIES[name] for name in MOMENTS_FIELDS)
const MOMENTS_ORIGINS = Tuple(Int(startswith(String(name), "centroid")) for name in MOMENTS_FIELDS)

function copied(status, handle)
    value = Ref{Float64}()
    numbers = ntuple(Val(length(MOMENTS_KEYS))) do k
        LibWfpsf.wfpsf_moments_get(handle, MOMENTS_KEYS[k], value)
        value[] + MOMENTS_ORIGINS[k]
    end
    return Moments(status, numbers...)
end

# Runs `measure(out)`, which makes a result in most cases of failure too, and copies it.
function measured(measure, strict)
    out = Ref(C_NULL)
    status = measure(out)
    out[] == C_NULL && check(status)
    moments = copied(status, out[])
    LibWfpsf.wfpsf_moments_destroy(out[])
    strict && check(status)
    return moments
end

"""
    adaptive_moments(image; strict = true, options...)

[`Moments`](@ref) of the best-fit elliptical Gaussian: centroid x0 and matrix M such that, with the
weight w = exp(-(x-x0)' M^-1 (x-x0) / 2), x0 is the weighted mean and M twice the weighted second
moment (Kannawadi et al. 2016, Eqs. 13 and 18).

Options: `moments_tolerance`, `moments_max_passes`, and the first guess `moments_guess_x`,
`moments_guess_y`, `moments_guess_sigma`, in pixels of the image, the centre of the first pixel
being (1, 1).

With `strict = false` a measurement that fails, or ends with a warning, is returned as it stands,
and its `status` says so.
"""
function adaptive_moments(image::Image; strict::Bool = true, keywords...)
    with_options(MOMENTS_OPTIONS, keywords) do options
        measured(out -> LibWfpsf.wfpsf_moments_measure(image, options, out), strict)
    end
end

"""
    unweighted_moments(image; strict = true)
    unweighted_moments(image, x, y; strict = true)

[`Moments`](@ref) over the whole image about the centroid, or about the point (x, y), the centre of
the first pixel being (1, 1). `strict` as for [`adaptive_moments`](@ref).
"""
unweighted_moments(image::Image, x::Real, y::Real; strict::Bool = true) =
    measured(out -> LibWfpsf.wfpsf_moments_measure_unweighted(image, x - 1, y - 1, out), strict)

unweighted_moments(image::Image; strict::Bool = true) =
    unweighted_moments(image, NaN, NaN; strict = strict)
