# SPDX-License-Identifier: GPL-3.0-or-later

"""
    pupil(instrument, band, sca, nx, ny; struts = true)

The pupil that detector `sca` sees through a band, drawn in the middle of an image: `(mask, scale_m,
axis_x, axis_y)`. Each pixel of `mask` is the lit fraction of its area; `scale_m` is its side in
metres; (`axis_x`, `axis_y`) is the optical axis, the centre of the first pixel being (1, 1). All
four are what the constructor of a [`PSF`](@ref) from a mask takes.
"""
function pupil(instrument::Instrument, band::AbstractString, sca::Integer, nx::Integer, ny::Integer;
               keywords...)
    mask = Image(Float64, nx, ny)
    scale, axis_x, axis_y = Ref{Float64}(), Ref{Float64}(), Ref{Float64}()
    with_options((:struts,), keywords) do options
        check(LibWfpsf.wfpsf_instrument_pupil(instrument, band, sca, options, mask, scale, axis_x,
                                              axis_y))
    end
    return (mask = mask, scale_m = scale[], axis_x = axis_x[] + 1, axis_y = axis_y[] + 1)
end
