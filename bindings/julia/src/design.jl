# SPDX-License-Identifier: GPL-3.0-or-later

"""
    Design()
    Design(f)

Figures of one's own, of which [`Instrument`](@ref) makes an instrument that serves wherever a
built-in one does. The pupil is a circular primary about the optical axis, less a circular
obscuration, less the struts. [`set_telescope!`](@ref) and [`set_detector!`](@ref) must be called;
[`add_strut!`](@ref), [`set_zernikes!`](@ref) and [`add_band!`](@ref) need not be.

    design = Design()
    set_telescope!(design, diameter_m = 2.4, obscuration = 0.33, reference_wavelength_nm = 633)
    foreach(azimuth -> add_strut!(design, azimuth, 0.03), 45:90:315)
    set_detector!(design, pixel_scale_arcsec = 0.04, n_pix_x = 4096, n_pix_y = 2048)
    instrument = Instrument(design)
"""
mutable struct Design <: Handle
    pointer::Ptr{Cvoid}
    Design() = finalizer(close, new(created(LibWfpsf.wfpsf_design_create)))
end

destroy(::Design, pointer) = LibWfpsf.wfpsf_design_destroy(pointer)

"""
    set_telescope!(design; diameter_m, obscuration, reference_wavelength_nm)

The mirrors. The obscuration is linear, a fraction of the diameter, 0 to 0.99; Zernike coefficients
are given at the reference wavelength.
"""
function set_telescope!(design::Design; diameter_m::Real, obscuration::Real,
                        reference_wavelength_nm::Real)
    check(LibWfpsf.wfpsf_design_set_telescope(design, diameter_m, obscuration,
                                              reference_wavelength_nm))
    return design
end

"""
    add_strut!(design, azimuth_deg, width_m; offset_m = 0)

One more dark bar with parallel sides, from the optical axis outwards in the direction `azimuth_deg`
(from x towards y). `offset_m` moves it towards `azimuth_deg + 90`.
"""
function add_strut!(design::Design, azimuth_deg::Real, width_m::Real; offset_m::Real = 0)
    check(LibWfpsf.wfpsf_design_add_strut(design, azimuth_deg, width_m, offset_m))
    return design
end

"""
    set_detector!(design; sca_count = 1, pixel_scale_arcsec, n_pix_x, n_pix_y)

The detectors (SCAs), all of one kind.
"""
function set_detector!(design::Design; sca_count::Integer = 1, pixel_scale_arcsec::Real,
                       n_pix_x::Integer, n_pix_y::Integer)
    check(LibWfpsf.wfpsf_design_set_detector(design, sca_count, pixel_scale_arcsec, n_pix_x,
                                             n_pix_y))
    return design
end

"""
    set_zernikes!(design, sca, coefficients)
    set_zernikes!(design, sca, x, y, coefficients)

Aberrations of a detector: Noll's order from j = 1, waves rms over the full circle at the reference
wavelength. A vector holds all over the detector; of a matrix, column i at pixel (x[i], y[i]) of five,
first one near the centre, then one towards each corner. The first pixel's centre is (1, 1).
"""
function set_zernikes!(design::Design, sca::Integer, coefficients::AbstractVector)
    numbers = collect(Float64, coefficients)
    check(LibWfpsf.wfpsf_design_set_zernikes(design, sca, length(numbers), numbers))
    return design
end

function set_zernikes!(design::Design, sca::Integer, x::AbstractVector, y::AbstractVector,
                       coefficients::AbstractMatrix)
    length(x) == length(y) == size(coefficients, 2) == 5 ||
        throw(DimensionMismatch("x, y and the columns of coefficients must be five"))
    check(LibWfpsf.wfpsf_design_set_field(design, sca, collect(Float64, x) .- 1,
                                          collect(Float64, y) .- 1, size(coefficients, 1),
                                          collect(Float64, coefficients)))
    return design
end

"""
    add_band!(design, name, first_nm, step_nm, throughput)

One more filter band: its throughput (0 to 1) at equal steps of wavelength, linear in between and
zero outside.
"""
function add_band!(design::Design, name::AbstractString, first_nm::Real, step_nm::Real,
                   throughput::AbstractVector)
    numbers = collect(Float64, throughput)
    check(LibWfpsf.wfpsf_design_add_band(design, name, first_nm, step_nm, length(numbers), numbers))
    return design
end
