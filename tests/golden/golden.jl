# SPDX-License-Identifier: GPL-3.0-or-later
# golden.jl CASES RESULTS: the golden cases in Julia; golden.c says what they are. Positions count
# from 1 here; those of the cases are such that adding 1 rounds nothing.
using Printf
using Wfpsf

number(word) = parse(Float64, word)
count(word) = parse(Int, word)

function run(out, fields)
    name, instrument_name, band, sca = fields[1], fields[2], fields[3], count(fields[4])
    x, y, wavelength_nm = number.(fields[5:7])
    struts, nx, ny, oversampling = count.(fields[8:11])
    star_x, star_y, flux, alpha, alpha_prime, alpha_plus, noise = number.(fields[12:18])
    places = ((1, 1), (nx ÷ 2 + 1, ny ÷ 2 + 1), (nx - 1, ny))
    tell(quantity, value) = @printf(out, "%s %s %.17g\n", name, quantity, value)
    tell_pixels(quantity, image) =
        foreach(i -> tell("$(quantity)_$(i - 1)", image.pixels[places[i]...]), 1:3)

    psf = Instrument(instrument_name) do instrument
        PSF(instrument, band, sca, x + 1, y + 1; wavelength_nm = wavelength_nm, struts = struts)
    end
    tell("wavelength_nm", psf.wavelength_nm)
    tell("peak", psf.peak)

    star = draw(psf, nx, ny; x = star_x + 1, y = star_y + 1, flux = flux,
                oversampling = oversampling)
    tell_pixels("drawn", star)

    blurred = apply_ipc(IPCKernel(alpha, alpha_prime, alpha_plus), star)
    tell_pixels("blurred", blurred)

    tell("ee25", ee_radius(blurred, star_x + 1, star_y + 1, 0.25;
                           method = :pixel_interpolated).radius)
    tell("unweighted_mxx", unweighted_moments(blurred, star_x + 1, star_y + 1).mxx)
    moments = adaptive_moments(blurred)
    foreach(quantity -> tell(quantity, getfield(moments, quantity)),
            (:sigma, :e1, :e2, :flux, :rho4))

    add_noise!(blurred, noise; seed = 20150901)
    tell_pixels("noisy", blurred)
end

open(ARGS[2], "w") do out
    println(out, "case quantity value")
    foreach(line -> run(out, split(line)), readlines(ARGS[1])[2:end])
end
