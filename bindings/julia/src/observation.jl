# SPDX-License-Identifier: GPL-3.0-or-later

const OBSERVATION_KEYS = constants_of("WFPSF_OBSERVATION_")
const OBSERVATION_OPTIONS = (:wcs_rule, :pa_of_fpa)

"""
    Observation(instrument, ra_deg, dec_deg, pa_deg; options...)
    Observation(f, ...)

A telescope that points somewhere, and where its detectors then are on the sky. Degrees; RA and Dec
in the ICRS; position angles east of north, `pa_deg` that of the observatory's +Y axis. The centre
of a detector's first pixel is (1, 1). Immutable: threads may share it.

Options: `wcs_rule` (1: as GalSim has it) and `pa_of_fpa` (1: `pa_deg` is the focal plane's). Others
are made by [`aimed`](@ref) and [`on_date`](@ref); [`properties`](@ref) tells the FITS keywords.
"""
mutable struct Observation <: Handle
    pointer::Ptr{Cvoid}
    Observation(pointer::Ptr{Cvoid}) = finalizer(close, new(pointer))
end

destroy(::Observation, pointer) = LibWfpsf.wfpsf_observation_destroy(pointer)

function Observation(instrument::Instrument, ra_deg::Real, dec_deg::Real, pa_deg::Real; keywords...)
    return with_options(OBSERVATION_OPTIONS, keywords) do options
        Observation(created(out -> LibWfpsf.wfpsf_observation_create(
            instrument, ra_deg, dec_deg, pa_deg, options, out)))
    end
end

"""
    on_date(instrument, ra_deg, dec_deg, julian_date; options...)

The [`Observation`](@ref) with the best roll of a date (UTC).
"""
function on_date(instrument::Instrument, ra_deg::Real, dec_deg::Real, julian_date::Real; keywords...)
    return with_options(OBSERVATION_OPTIONS, keywords) do options
        Observation(created(out -> LibWfpsf.wfpsf_observation_create_on_date(
            instrument, ra_deg, dec_deg, julian_date, options, out)))
    end
end

"""
    aimed(instrument, sca, x, y, ra_deg, dec_deg, pa_deg; options...)

The [`Observation`](@ref) that has pixel (x, y) of a detector at a place on the sky.
"""
function aimed(instrument::Instrument, sca::Integer, x::Real, y::Real, ra_deg::Real, dec_deg::Real,
               pa_deg::Real; keywords...)
    return with_options(OBSERVATION_OPTIONS, keywords) do options
        Observation(created(out -> LibWfpsf.wfpsf_observation_create_aimed(
            instrument, sca, x - 1, y - 1, ra_deg, dec_deg, pa_deg, options, out)))
    end
end

"""
    properties(observation, sca)

Pointing, position angles and FITS keywords of a detector, by name, such as `crval1`.
"""
function properties(observation::Observation, sca::Integer)
    return map(OBSERVATION_KEYS) do key
        value = Ref{Float64}()
        check(LibWfpsf.wfpsf_observation_get(observation, sca, key, value))
        value[]
    end
end

# Two arrays of one shape as arrays of Float64.
function pairs_of(a, b)
    size(a) == size(b) ||
        throw(DimensionMismatch("positions have the sizes $(size(a)) and $(size(b))"))
    return collect(Float64, a), collect(Float64, b)
end

"""
    sky_to_pixel(observation, sca, ra_deg, dec_deg)

`(x, y)`: pixels of one detector, on it or not, of arrays of positions or of one; NaN more than 8192
pixels off it.
"""
function sky_to_pixel(observation::Observation, sca::Integer, ra_deg::AbstractArray{<:Real},
                      dec_deg::AbstractArray{<:Real})
    ra, dec = pairs_of(ra_deg, dec_deg)
    x, y = similar(ra), similar(ra)
    check(LibWfpsf.wfpsf_observation_sky_to_pixel(observation, sca, length(ra), ra, dec, x, y,
                                                  C_NULL))
    return (x = x .+ 1, y = y .+ 1)
end

sky_to_pixel(observation::Observation, sca::Integer, ra_deg::Real, dec_deg::Real) =
    map(only, sky_to_pixel(observation, sca, [ra_deg], [dec_deg]))

"""
    pixel_to_sky(observation, sca, x, y)

`(ra_deg, dec_deg)` of arrays of pixels of a detector or of one; NaN more than 8192 pixels off it.
"""
function pixel_to_sky(observation::Observation, sca::Integer, x::AbstractArray{<:Real},
                      y::AbstractArray{<:Real})
    xs, ys = pairs_of(x, y)
    xs .-= 1
    ys .-= 1
    ra, dec = similar(xs), similar(xs)
    check(LibWfpsf.wfpsf_observation_pixel_to_sky(observation, sca, length(xs), xs, ys, ra, dec,
                                                  C_NULL))
    return (ra_deg = ra, dec_deg = dec)
end

pixel_to_sky(observation::Observation, sca::Integer, x::Real, y::Real) =
    map(only, pixel_to_sky(observation, sca, [x], [y]))

"""
    find_sca(observation, ra_deg, dec_deg; with_gaps = false)

`(sca, x, y)` of arrays of positions: the detector that each falls on, 0 if on none, and where;
`with_gaps` counts a detector's halves of the gaps around it as its own.
"""
function find_sca(observation::Observation, ra_deg::AbstractArray{<:Real},
                  dec_deg::AbstractArray{<:Real}; with_gaps::Bool = false)
    ra, dec = pairs_of(ra_deg, dec_deg)
    sca, x, y = similar(ra, Int32), similar(ra), similar(ra)
    check(LibWfpsf.wfpsf_observation_find_sca(observation, with_gaps, length(ra), ra, dec, sca, x, y,
                                              C_NULL))
    return (sca = sca, x = x .+ 1, y = y .+ 1)
end

"""
    sca_bounds(observation, sca; with_gaps = false)

`(x, y)`: the ranges of a detector's pixels.
"""
function sca_bounds(observation::Observation, sca::Integer; with_gaps::Bool = false)
    ends = [Ref{Int64}() for _ = 1:4]
    check(LibWfpsf.wfpsf_observation_bounds(observation, sca, with_gaps, ends...))
    first_x, last_x, first_y, last_y = (value[] + 1 for value in ends)
    return (x = first_x:last_x, y = first_y:last_y)
end

"""
    pixel_jacobian(observation, sca, x, y)

`(jacobian, area, y_angle_deg)` at a pixel: the changes on the sky, `[east_x east_y; north_x
north_y]` in arcsec per pixel, the pixel's area in arcsec^2 and the position angle of the y axis.
"""
function pixel_jacobian(observation::Observation, sca::Integer, x::Real, y::Real)
    jacobian = Vector{Float64}(undef, 4)
    area, angle = Ref{Float64}(), Ref{Float64}()
    check(LibWfpsf.wfpsf_observation_jacobian(observation, sca, 1, Ref(x - 1.0), Ref(y - 1.0),
                                              jacobian, area, angle, C_NULL))
    return (jacobian = permutedims(reshape(jacobian, 2, 2)), area = area[], y_angle_deg = angle[])
end

"""
    fits_header(observation, sca)

The WCS keywords of a detector's FITS image: a vector of cards of 80 characters.
"""
function fits_header(observation::Observation, sca::Integer)
    text = text_from((to...) -> LibWfpsf.wfpsf_observation_fits_header(observation, sca, to...))
    return [text[i:i+79] for i = 1:80:length(text)]
end

"""
    julian_date(year, month, day, hour = 0, minute = 0, second = 0)

The Julian date of a UTC date.
"""
function julian_date(year::Integer, month::Integer, day::Integer, hour::Integer = 0,
                     minute::Integer = 0, second::Real = 0)
    date = Ref{Float64}()
    check(LibWfpsf.wfpsf_julian_date(year, month, day, hour, minute, second, date))
    return date[]
end

"""
    sun_position(julian_date; options...)

`(ra_deg, dec_deg)` of the Sun from the Earth, ICRS. Option: `wcs_rule`.
"""
function sun_position(julian_date::Real; keywords...)
    ra, dec = Ref{Float64}(), Ref{Float64}()
    with_options((:wcs_rule,), keywords) do options
        check(LibWfpsf.wfpsf_sun_position(julian_date, options, ra, dec))
    end
    return (ra_deg = ra[], dec_deg = dec[])
end

"""
    pointing_allowed(instrument, ra_deg, dec_deg, julian_date; options...)

`(allowed, sun_angle_deg)`: whether the Sun lets the telescope point there. Option: `wcs_rule`.
"""
function pointing_allowed(instrument::Instrument, ra_deg::Real, dec_deg::Real, julian_date::Real;
                          keywords...)
    angle, allowed = Ref{Float64}(), Ref{Int32}()
    with_options((:wcs_rule,), keywords) do options
        check(LibWfpsf.wfpsf_pointing_allowed(instrument, ra_deg, dec_deg, julian_date, options,
                                              angle, allowed))
    end
    return (allowed = allowed[] == 1, sun_angle_deg = angle[])
end

"""
    best_pa(instrument, ra_deg, dec_deg, julian_date; options...)

Position angle of the observatory's +Y axis at the best roll, east of north. Option: `wcs_rule`.
"""
function best_pa(instrument::Instrument, ra_deg::Real, dec_deg::Real, julian_date::Real; keywords...)
    pa = Ref{Float64}()
    with_options((:wcs_rule,), keywords) do options
        check(LibWfpsf.wfpsf_pointing_best_pa(instrument, ra_deg, dec_deg, julian_date, options, pa))
    end
    return pa[]
end
