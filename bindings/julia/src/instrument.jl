# SPDX-License-Identifier: GPL-3.0-or-later

const BAND_RULES = constants_of("WFPSF_BAND_")

"""
    Instrument(name = "wfirst-afta-c5")
    Instrument(design)
    Instrument(f, ...)

The figures of a telescope and its detectors, published ones or those of a [`Design`](@ref).
Immutable: threads may share it.
"""
mutable struct Instrument <: Handle
    pointer::Ptr{Cvoid}
    Instrument(name::AbstractString = "wfirst-afta-c5") =
        finalizer(close, new(created(out -> LibWfpsf.wfpsf_instrument_create(name, out))))
    Instrument(design::Design) = finalizer(
        close, new(created(out -> LibWfpsf.wfpsf_instrument_create_from_design(design, out))))
end

destroy(::Instrument, pointer) = LibWfpsf.wfpsf_instrument_destroy(pointer)

"""
    constant(instrument, name)

`(value, unit)` of a constant, such as `"diameter"` or `"pixel_scale"`.

```jldoctest
julia> constant(Instrument("roman-c9"), "pixel_scale")
(value = 0.11, unit = "arcsec/pixel")
```
"""
function constant(instrument::Instrument, name::AbstractString)
    value, unit = Ref{Float64}(), Ref{Cstring}()
    check(LibWfpsf.wfpsf_instrument_constant(instrument, name, value, unit))
    return (value = value[], unit = unsafe_string(unit[]))
end

# The names that `name_of(instrument, 0)`, `name_of(instrument, 1)` ... give, up to the first NULL.
function name_list(name_of, instrument)
    list = String[]
    while true
        name = convert(Ptr{UInt8}, name_of(instrument, length(list)))
        name == C_NULL && return list
        push!(list, unsafe_string(name))
    end
end

"Names of the constants of an instrument."
constants(instrument::Instrument) =
    name_list(LibWfpsf.wfpsf_instrument_constant_name, instrument)

"Names of the bands of an instrument, in order of wavelength."
bands(instrument::Instrument) = name_list(LibWfpsf.wfpsf_instrument_band_name, instrument)

"""
    band(instrument, name; rule = :tabulated)

`(blue_nm, red_nm, effective_nm)`: limits and throughput-weighted mean wavelength of a band, from
the tabulated throughput, or by the rule `:paper` from the same table thinned as for Table 1 of
Kannawadi et al. (2016).
"""
function band(instrument::Instrument, name::AbstractString; rule::Symbol = :tabulated)
    blue, red, effective = Ref{Float64}(), Ref{Float64}(), Ref{Float64}()
    check(LibWfpsf.wfpsf_instrument_band(instrument, name, choose(BAND_RULES, :rule, rule), blue,
                                         red, effective))
    return (blue_nm = blue[], red_nm = red[], effective_nm = effective[])
end

"""
    throughput(instrument, band, wavelength_nm)

Throughput of a band at one wavelength or at each of an array, nm; linear between tabulated points,
zero outside.
"""
function throughput(instrument::Instrument, band::AbstractString, wavelength_nm::AbstractArray)
    wavelengths = collect(Float64, wavelength_nm)
    values = similar(wavelengths)
    check(LibWfpsf.wfpsf_instrument_throughput(instrument, band, length(values), wavelengths,
                                               values))
    return values
end

throughput(instrument::Instrument, band::AbstractString, wavelength_nm::Real) =
    only(throughput(instrument, band, [wavelength_nm]))

"""
    zernikes(instrument, sca)

Aberrations at the centre of detector `sca` in Noll's order, element j being the coefficient of Z_j;
waves rms over the full circle at the constant `"zemax_wavelength"`.
"""
function zernikes(instrument::Instrument, sca::Integer)
    count = Ref{Int64}()
    check(LibWfpsf.wfpsf_instrument_zernikes(instrument, sca, 0, C_NULL, count))
    coefficients = Vector{Float64}(undef, count[])
    check(LibWfpsf.wfpsf_instrument_zernikes(instrument, sca, length(coefficients), coefficients,
                                             C_NULL))
    return coefficients
end
