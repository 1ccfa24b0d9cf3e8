# SPDX-License-Identifier: GPL-3.0-or-later

const SIZE_METHODS = constants_of("WFPSF_SIZE_")
const SIZE_OPTIONS = (:size_total_flux, :size_bandwidth, :size_eps)

"""
    encircled_energy(image, x, y, radius; options...)

`(fraction, error)`: fraction of the light inside a circle, by the integral of the band-limited
image, and an estimate of its error. Lengths are in pixels of the image, the centre of the first
pixel being (1, 1). The circle must lie inside the image.

Options: `size_total_flux` (what counts as 100%; by default the sum of all pixels),
`size_bandwidth` (highest frequency in the image, cycles per pixel of the image) and `size_eps` (the
error asked for).
"""
function encircled_energy(image::Image, x::Real, y::Real, radius::Real; keywords...)
    fraction, error = Ref{Float64}(), Ref{Float64}()
    with_options(SIZE_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_size_encircled_energy(image, x - 1, y - 1, radius, options, fraction,
                                                   error))
    end
    return (fraction = fraction[], error = error[])
end

"""
    ee_radius(image, x, y, fraction = 0.5; method = :bandlimited, options...)

`(radius, error)`: radius of the circle about (x, y) that holds a fraction of the light, by default
the half-light radius, and an estimate of its error. Lengths are in pixels of the image, the centre
of the first pixel being (1, 1).

`method`: `:bandlimited` (the band-limited image integrated over the disc), `:pixel_sum` (pixels
whose centre lies in the circle; Kannawadi et al. 2016, Eq. 25) or `:pixel_interpolated` (GalSim's
calculateHLR); the last two have NaN for an error. Options as for [`encircled_energy`](@ref).

```jldoctest
julia> gaussian = [exp(-((x - 41)^2 + (y - 41)^2) / (2 * 4^2)) for x = 1:81, y = 1:81];

julia> half, error = ee_radius(Image(gaussian), 41, 41);

julia> (round(half / 4, digits = 6), error < 1e-9)
(1.17741, true)
```
"""
function ee_radius(image::Image, x::Real, y::Real, fraction::Real = 0.5;
                   method::Symbol = :bandlimited, keywords...)
    radius, error = Ref{Float64}(), Ref{Float64}()
    with_options(SIZE_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_size_ee_radius(image, x - 1, y - 1, fraction,
                                            choose(SIZE_METHODS, :method, method), options, radius,
                                            error))
    end
    return (radius = radius[], error = error[])
end

"""
    fwhm(image, x, y)

Full width at half maximum about (x, y) from pixels sorted by distance, as GalSim's calculateFWHM;
pixels of the image, the centre of the first pixel being (1, 1).
"""
function fwhm(image::Image, x::Real, y::Real)
    width = Ref{Float64}()
    check(LibWfpsf.wfpsf_size_fwhm(image, x - 1, y - 1, width))
    return width[]
end

"""
    ee_radius_derivative(image, change, x, y, fraction = 0.5; second = nothing, options...)

`(derivative, error)`: derivative of [`ee_radius`](@ref), of the band-limited image, as
`image + t * change` departs from t = 0, and an estimate of its error. With a `second` change, the
mixed second derivative by both. Options as for [`encircled_energy`](@ref).
"""
function ee_radius_derivative(image::Image, change::Image, x::Real, y::Real, fraction::Real = 0.5;
                              second = nothing, keywords...)
    derivative, error = Ref{Float64}(), Ref{Float64}()
    other = second === nothing ? C_NULL : second
    with_options(SIZE_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_size_ee_radius_derivative(image, change, other, x - 1, y - 1, fraction,
                                                       options, derivative, error))
    end
    return (derivative = derivative[], error = error[])
end

"""
    radial_profile(image, x, y, radii; options...)

`(profile, errors)`: means of the band-limited image on circles about (x, y), and estimates of their
errors. Options: `size_bandwidth`, `size_eps`.
"""
function radial_profile(image::Image, x::Real, y::Real, radii; keywords...)
    given = collect(Float64, radii)
    profile, errors = similar(given), similar(given)
    with_options(SIZE_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_size_profile(image, x - 1, y - 1, length(given), given, options,
                                          profile, errors))
    end
    return (profile = profile, errors = errors)
end

"""
    profile_fwhm(image, x, y; options...)

`(fwhm, error)`: full width at half maximum of the [`radial_profile`](@ref) about (x, y), and an
estimate of its error.
"""
function profile_fwhm(image::Image, x::Real, y::Real; keywords...)
    width, error = Ref{Float64}(), Ref{Float64}()
    with_options(SIZE_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_size_profile_fwhm(image, x - 1, y - 1, options, width, error))
    end
    return (fwhm = width[], error = error[])
end
