# SPDX-License-Identifier: GPL-3.0-or-later

const STEPS = constants_of("WFPSF_STEP_")

"""
    Chain()
    Chain(instrument; exposure_time = nothing)
    Chain(f, ...)

A detector's effects in a stated order: none yet, to be filled by [`add!`](@ref), or the instrument's
own. [`apply_chain!`](@ref) applies it to an image.
"""
mutable struct Chain <: Handle
    pointer::Ptr{Cvoid}
    Chain(pointer::Ptr{Cvoid}) = finalizer(close, new(pointer))
end

Chain() = Chain(created(LibWfpsf.wfpsf_chain_create))

function Chain(instrument::Instrument; exposure_time = nothing)
    time = exposure_time === nothing ? NaN : exposure_time
    return Chain(created(out -> LibWfpsf.wfpsf_chain_create_default(instrument, time, out)))
end

destroy(::Chain, pointer) = LibWfpsf.wfpsf_chain_destroy(pointer)

"""
    add!(chain, step, parameters...)
    add!(chain, kernel; edge = :zero)
    add!(chain, varying; edge = :zero, ipc_form = 0)
    add!(chain, step, map, parameters...)

Adds a step at the end: one of numbers, IPC, or one with a map (an image, which is copied):
`:dark_current_map`, `:capacitance_map`, `:pixel_mask`. The C header chain.h lists the steps and
their parameters; here they are symbols in lower case.
"""
function add!(chain::Chain, step::Symbol, parameters::Real...)
    numbers = collect(Float64, parameters)
    check(LibWfpsf.wfpsf_chain_add(chain, choose(STEPS, :step, step), length(numbers), numbers))
    return chain
end

function add!(chain::Chain, kernel::IPCKernel; edge::Symbol = :zero)
    check(LibWfpsf.wfpsf_chain_add_ipc(chain, kernel, choose(EDGES, :edge, edge)))
    return chain
end

function add!(chain::Chain, varying::VaryingIPC; edge::Symbol = :zero, ipc_form::Integer = 0)
    check(LibWfpsf.wfpsf_chain_add_varying_ipc(chain, varying, ipc_form,
                                               choose(EDGES, :edge, edge)))
    return chain
end

function add!(chain::Chain, step::Symbol, map::Image, parameters::Real...)
    numbers = collect(Float64, parameters)
    check(LibWfpsf.wfpsf_chain_add_map(chain, choose(STEPS, :step, step), length(numbers), numbers,
                                       map))
    return chain
end

"""
    steps(chain)

The steps and their parameters, in their order: a vector of `step => parameters`.
"""
function steps(chain::Chain)
    found = Pair{Symbol,Vector{Float64}}[]
    count, step = Ref{Int64}(), Ref{Int32}()
    while true
        index = length(found)
        check(LibWfpsf.wfpsf_chain_step(chain, index, 0, C_NULL, count, step))
        step[] == 0 && return found
        numbers = Vector{Float64}(undef, count[])
        check(LibWfpsf.wfpsf_chain_step(chain, index, count[], numbers, C_NULL, step))
        push!(found, Symbol(unsafe_string(LibWfpsf.wfpsf_step_name(step[]))) => numbers)
    end
end

const NOISE_OPTIONS = (:seed, :stream, :origin_x, :origin_y, :threads)
const CHAIN_OPTIONS = (NOISE_OPTIONS..., :noise, :force)

"""
    apply_chain!(image, chain; previous = Image[], options...)

Applies a chain in place and returns `(not_finite, saturated)`, counts of pixels. `previous` holds
the exposures before this one, the latest first. What a pixel draws depends on `seed`, `stream` and
its place on the detector, offset by `origin_x` and `origin_y`, alone. Options: `seed`, `stream`,
`origin_x`, `origin_y`, `noise` (0: means alone), `force`, `threads`.
"""
function apply_chain!(image::Image, chain::Chain; previous = Image[], keywords...)
    not_finite, saturated = Ref{Int64}(), Ref{Int64}()
    before = collect(previous)
    GC.@preserve before begin
        pointers = Ptr{Cvoid}[Base.unsafe_convert(Ptr{Cvoid}, exposure) for exposure in before]
        with_options(CHAIN_OPTIONS, keywords) do options
            check(LibWfpsf.wfpsf_chain_apply(chain, image, length(pointers), pointers, options,
                                             not_finite, saturated))
        end
    end
    return (not_finite = not_finite[], saturated = saturated[])
end

"""
    add_noise!(image, rms; kernel = nothing, options...)

Adds normal noise: white, or white noise through a kernel. Options: `seed`, `stream`, `origin_x`,
`origin_y`, `threads`.
"""
function add_noise!(image::Image, rms::Real; kernel = nothing, keywords...)
    through = kernel === nothing ? C_NULL : kernel
    with_options(NOISE_OPTIONS, keywords) do options
        check(LibWfpsf.wfpsf_noise_add(image, rms, through, options))
    end
    return image
end

"""
    sky_level(instrument, band, longitude, latitude)

Zodiacal light in e-/s/arcsec^2 at ecliptic coordinates in degrees, the longitude from the Sun.
"""
function sky_level(instrument::Instrument, band::AbstractString, longitude::Real, latitude::Real)
    level = Ref{Float64}()
    check(LibWfpsf.wfpsf_sky_level(instrument, band, longitude, latitude, level))
    return level[]
end

"""
    sky_background(instrument, band, longitude, latitude; exposure_time, pixel_area)

Zodiacal, stray and thermal background of a pixel (area in arcsec^2) in an exposure (s), electrons.
"""
function sky_background(instrument::Instrument, band::AbstractString, longitude::Real,
                        latitude::Real; exposure_time::Real, pixel_area::Real)
    electrons = Ref{Float64}()
    check(LibWfpsf.wfpsf_sky_background(instrument, band, longitude, latitude, exposure_time,
                                        pixel_area, electrons))
    return electrons[]
end
