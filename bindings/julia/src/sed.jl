# SPDX-License-Identifier: GPL-3.0-or-later

const SED_UNITS = constants_of("WFPSF_SED_")

"""
    SED(wavelength_nm, density; unit = :photons)
    SED(f, ...)

A spectral energy distribution: how a source's light is spread over wavelength, up to a factor. It
is linear between its samples, at rising wavelengths; a [`PSF`](@ref) can be made of it in bands
that the table covers. `unit` is what the density counts per unit of wavelength: `:photons`
(f_photon) or `:energy` (f_lambda). Immutable: threads may share it.

Others are made by [`power_law`](@ref), [`black_body`](@ref) and [`redshifted`](@ref).

```jldoctest
julia> photon_density(SED([900, 1000, 1100], [1, 2, 4]), [950, 1050])
[1.5, 3.0]
```
"""
mutable struct SED <: Handle
    pointer::Ptr{Cvoid}
    SED(pointer::Ptr{Cvoid}) = finalizer(close, new(pointer))
end

function SED(wavelength_nm::AbstractVector{<:Real}, density::AbstractVector{<:Real};
             unit::Symbol = :photons)
    length(wavelength_nm) == length(density) || throw(DimensionMismatch(
        "wavelength_nm and density must have one length, not $(length(wavelength_nm)) and " *
        "$(length(density))"))
    return SED(created() do out
        LibWfpsf.wfpsf_sed_create_table(choose(SED_UNITS, :unit, unit), length(density),
                                        collect(Float64, wavelength_nm),
                                        collect(Float64, density), out)
    end)
end

destroy(::SED, pointer) = LibWfpsf.wfpsf_sed_destroy(pointer)

"""
    power_law(exponent; unit = :photons)

The [`SED`](@ref) of a density proportional to wavelength^exponent. Flat in f_lambda:
`power_law(0; unit = :energy)`; flat in f_nu, an AB source: `power_law(-2; unit = :energy)`.
"""
power_law(exponent::Real; unit::Symbol = :photons) = SED(created(
    out -> LibWfpsf.wfpsf_sed_create_power_law(choose(SED_UNITS, :unit, unit), exponent, out)))

"""
    black_body(temperature_k)

The [`SED`](@ref) of a black body, kelvin.
"""
black_body(temperature_k::Real) =
    SED(created(out -> LibWfpsf.wfpsf_sed_create_black_body(temperature_k, out)))

"""
    redshifted(sed, z)

Another [`SED`](@ref), its wavelengths 1 + z times as long.
"""
redshifted(sed::SED, z::Real) =
    SED(created(out -> LibWfpsf.wfpsf_sed_create_redshifted(sed, z, out)))

"""
    photon_density(sed, wavelength_nm)

Photons per unit of wavelength at one wavelength or at each of an array, nm, up to a factor that is
the same for all wavelengths.
"""
function photon_density(sed::SED, wavelength_nm::AbstractArray{<:Real})
    wavelengths = collect(Float64, wavelength_nm)
    photons = similar(wavelengths)
    check(LibWfpsf.wfpsf_sed_photon_density(sed, length(photons), wavelengths, photons))
    return photons
end

photon_density(sed::SED, wavelength_nm::Real) = only(photon_density(sed, [wavelength_nm]))
