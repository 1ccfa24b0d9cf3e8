# SPDX-License-Identifier: GPL-3.0-or-later

const MOMENTS_PROPERTIES = constants_of("WFPSF_MOMENTS_")
const MOMENTS_OPTIONS = (:moments_tolerance, :moments_max_passes, :moments_guess_x,
                         :moments_guess_y, :moments_guess_sigma, :moments_method,
                         :moments_background, :moments_variance, :moments_restart,
                         :moments_covariance_order)

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
- `missing_fraction`: fraction of the squared weight that falls on missing pixels
- `amplitude`: central value of the best-fit Gaussian
- `last_step`: length of the last step, whitened
- `pixels`: visited, all passes together
- `background`: fitted, or as it was given

```jldoctest
julia> star = [exp(-((x - 16)^2 + (y - 15)^2) / (2 * 3^2)) for x = 1:32, y = 1:32];

julia> found = adaptive_moments(Image(star));

julia> round.((found.sigma, found.centroid_x, found.centroid_y), digits = 6)
(3.0, 16.0, 15.0)
```
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
    missing_fraction::Float64
    amplitude::Float64
    last_step::Float64
    pixels::Float64
    background::Float64
end

const MOMENTS_FIELDS = fieldnames(Moments)[2:end]
const MOMENTS_KEYS = Tuple(MOMENTS_PROPERTIES[name] for name in MOMENTS_FIELDS)
const MOMENTS_ORIGINS = Tuple(Int(startswith(String(name), "centroid")) for name in MOMENTS_FIELDS)

# Derivatives have no origin.
function copied(status, handle; origins = MOMENTS_ORIGINS)
    value = Ref{Float64}()
    numbers = ntuple(Val(length(MOMENTS_KEYS))) do k
        LibWfpsf.wfpsf_moments_get(handle, MOMENTS_KEYS[k], value)
        value[] + origins[k]
    end
    return Moments(status, numbers...)
end

# Runs `measure(out)`, which makes a result in most cases of failure too, and then `use(status,
# result)`.
function measured(use, measure, strict)
    out = Ref(C_NULL)
    status = measure(out)
    out[] == C_NULL && check(status)
    try
        strict && check(status)
        return use(status, out[])
    finally
        LibWfpsf.wfpsf_moments_destroy(out[])
    end
end
measured(measure, strict) = measured(copied, measure, strict)

# The same for adaptive moments.
function measured_adaptively(use, image, missing, variance, strict, keywords)
    pointer_or_null(handle) = handle === nothing ? C_NULL : handle
    with_options(MOMENTS_OPTIONS, keywords) do options
        measured(use, out -> LibWfpsf.wfpsf_moments_measure_masked(
                     image, pointer_or_null(missing), pointer_or_null(variance), options, out),
                 strict)
    end
end

moments_key(name::Symbol) = choose(MOMENTS_PROPERTIES, :name, name)

"""
    adaptive_moments(image; missing = nothing, variance = nothing, strict = true, options...)

[`Moments`](@ref) of the best-fit elliptical Gaussian: centroid x0 and matrix M such that, with the
weight w = exp(-(x-x0)' M^-1 (x-x0) / 2), x0 is the weighted mean and M twice the weighted second
moment (Kannawadi et al. 2016, Eqs. 13 and 18).

Options: `moments_tolerance`, `moments_max_passes`, and the first guess `moments_guess_x`,
`moments_guess_y`, `moments_guess_sigma`, in pixels of the image, the centre of the first pixel
being (1, 1); `moments_method` (0: the adaptive weight; 1: least squares at pixel centres, for stars
smaller than their pixels; 2: a round weight; 3: as 1, with a constant background that is fitted),
`moments_background`, `moments_variance` and `moments_restart`.

`missing`: an image that is not 0 where a pixel is missing; these are solved for. `variance`: an
image of each pixel's noise variance, for [`moments_covariance`](@ref).

With `strict = false` a measurement that fails, or ends with a warning, is returned as it stands,
and its `status` says so.
"""
function adaptive_moments(image::Image; missing = nothing, variance = nothing,
                          strict::Bool = true, keywords...)
    measured_adaptively(copied, image, missing, variance, strict, keywords)
end

"""
    moments_covariance(image, names; missing = nothing, variance = nothing, options...)

Covariance matrix of the named adaptive moments, such as `(:centroid_x, :sigma, :e1)`, to first
order in the noise, or to the second with `moments_covariance_order = 2`. The noise's variance comes
as an image or as the option `moments_variance`. Other arguments as for [`adaptive_moments`](@ref).
"""
function moments_covariance(image::Image, names; missing = nothing, variance = nothing,
                            keywords...)
    measured_adaptively(image, missing, variance, true, keywords) do status, moments
        value = Ref{Float64}()
        map(Iterators.product(names, names)) do (a, b)
            check(LibWfpsf.wfpsf_moments_covariance(moments, moments_key(a), moments_key(b), value))
            value[]
        end
    end
end

"""
    moments_derivative(image, change, second = nothing; missing = nothing, options...)

[`Moments`](@ref) that hold the derivatives of the adaptive moments of `image + t * change` by t at
0; with `second` the mixed second ones of `image + s * change + t * second`. Exact: no steps are
taken. What has no derivative is NaN. Other arguments as for [`adaptive_moments`](@ref).
"""
function moments_derivative(image::Image, change::Image, second = nothing; missing = nothing,
                            keywords...)
    measured_adaptively(image, missing, nothing, true, keywords) do status, moments
        measured((code, slopes) -> copied(code, slopes; origins = map(zero, MOMENTS_ORIGINS)),
                 out -> LibWfpsf.wfpsf_moments_differentiate(
                     moments, image, change, second === nothing ? C_NULL : second, out), true)
    end
end

"""
    moments_influence(image, name; missing = nothing, options...)

Matrix of the derivatives of one of the adaptive moments, such as `:sigma`, by every pixel. Other
arguments as for [`adaptive_moments`](@ref).
"""
function moments_influence(image::Image, name::Symbol; missing = nothing, keywords...)
    measured_adaptively(image, missing, nothing, true, keywords) do status, moments
        influence = Image(Float64, size(image)...)
        check(LibWfpsf.wfpsf_moments_influence(moments, image, moments_key(name), influence))
        influence.pixels
    end
end

"""
    weighted_moments(image, x, y, mxx, mxy, myy; strict = true)

[`Moments`](@ref) under a Gaussian weight of that matrix about (x, y), which stays as it is: `flux`
is the sum of I w, the second moments are about the weight's centre.
"""
weighted_moments(image::Image, x::Real, y::Real, mxx::Real, mxy::Real, myy::Real;
                 strict::Bool = true) =
    measured(out -> LibWfpsf.wfpsf_moments_measure_weighted(image, x - 1, y - 1, mxx, mxy, myy, out),
             strict)

"""
    moment_sums(image, x, y; weight = nothing)

The 15 sums of I w dx^j dy^k about (x, y) up to the fourth order, (j, k) = (0,0), (1,0), (0,1),
(2,0), ..., (0,4). `weight`: `(mxx, mxy, myy)` of a Gaussian.
"""
function moment_sums(image::Image, x::Real, y::Real; weight = nothing)
    sums = zeros(15)
    matrix = weight === nothing ? C_NULL : collect(Float64, weight)
    check(LibWfpsf.wfpsf_moments_sums(image, x - 1, y - 1, matrix, length(sums), sums))
    return sums
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
