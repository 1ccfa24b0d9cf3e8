# SPDX-License-Identifier: GPL-3.0-or-later
#=
Size, shape and half-light radius of the WFIRST-AFTA C5 PSF before and after interpixel capacitance,
beside Table 2 of Kannawadi et al. 2016, and the six PSFs of its Figure 2.

usage: julia --project=bindings/julia examples/julia/main_job.jl [output folder]

Writes table_sizes.csv and psf_<BAND>.fits.
=#
using Logging
using Printf
using Wfpsf

# The paper's stamp: 16 x 16 native pixels in steps of 1/32 pixel, the star at the centre.
const SCA = 7
const NATIVE_SIDE = 16
const OVERSAMPLING = 32
const SIDE = NATIVE_SIDE * OVERSAMPLING
const CENTRE = (SIDE + 1) / 2

# The field whose light counts as all of it for EE50, as in the paper: 32 x 32 native pixels.
const FIELD_SIDE = 32
const FIELD_SAMPLING = 4

const PSF_OPTIONS = (eps = 1e-7, psf_radius = FIELD_SIDE / 2)

const QUANTITIES = [(in_csv = "sigma", in_table = "sigma", unit = "mas"),
                    (in_csv = "e1", in_table = "e1", unit = "1"),
                    (in_csv = "e2", in_table = "e2", unit = "1"),
                    (in_csv = "e", in_table = "|e|", unit = "1"),
                    (in_csv = "ee50_centroid", in_table = "EE50 about centroid", unit = "mas"),
                    (in_csv = "ee50_axis", in_table = "EE50 about axis", unit = "mas")]

# Table 2 of the paper by band and struts, in the order of the quantities and with the digits that
# it gives; empty where it prints nothing.
const TABLE_BANDS = ["J129", "H158", "F184"]
const PAPER = Dict(("J129", 1) => ["61.50", "", "", "0.0646", "114.85", ""],
                   ("H158", 1) => ["66.16", "", "", "0.0379", "123.72", ""],
                   ("F184", 1) => ["72.39", "", "", "0.0246", "132.37", ""],
                   ("J129", 0) => ["60.480", "", "", "0.0652", "95.06", ""],
                   ("H158", 0) => ["65.884", "", "", "0.0417", "103.85", ""],
                   ("F184", 0) => ["72.452", "", "", "0.0292", "113.21", ""])

progress(text) = stderr isa Base.TTY && print(stderr, "\r\e[K", text)

effective_wavelength_nm(instrument, name) = band(instrument, name; rule = :paper).effective_nm

# The light of a star of unit flux that falls on the field around it.
function field_flux(psf)
    side = FIELD_SIDE * FIELD_SAMPLING
    field = draw(psf, side, side; oversampling = FIELD_SAMPLING)
    flux = sum(field.pixels)
    close(field)
    return flux
end

# The errors are numerical ones: that of the measurement and that of the PSF's pixels. How well the
# pupil's geometry fits the published mask is another matter: `model_error`.
function measure(image, sigma_guess, flux, mas_per_sample, psf_error)
    moments_s = @elapsed m = adaptive_moments(image; moments_tolerance = 1e-10,
                                              moments_guess_x = CENTRE, moments_guess_y = CENTRE,
                                              moments_guess_sigma = sigma_guess)
    ee50_s = @elapsed begin
        about_centroid = ee_radius(image, m.centroid_x, m.centroid_y; size_total_flux = flux)
        about_axis = ee_radius(image, CENTRE, CENTRE; size_total_flux = flux)
    end

    sigma, radii = m.sigma * mas_per_sample, (about_centroid.radius, about_axis.radius)
    error = m.error_estimate / 2 + 2 * psf_error
    ee50_error(ee50) = (ee50.error + ee50.radius * 2 * psf_error) * mas_per_sample
    return (value = [sigma, m.e1, m.e2, m.e, (radii .* mas_per_sample)...],
            error = [sigma * error, 2 * error, 2 * error, 2 * error, ee50_error(about_centroid),
                     ee50_error(about_axis)],
            moments_ms = 1e3 * moments_s, ee50_ms = 1e3 * ee50_s)
end

function make_row(instrument, name, struts)
    wavelength_nm = effective_wavelength_nm(instrument, name)
    mas_per_sample = 1000 * constant(instrument, "pixel_scale").value / OVERSAMPLING
    sigma_guess = 0.55 * OVERSAMPLING * wavelength_nm / 1292

    progress("$name: PSF")
    psf_s = @elapsed psf = PSF(instrument, SCA, wavelength_nm; struts = struts, PSF_OPTIONS...)
    flux = field_flux(psf)
    optics = Image(Float64, SIDE, SIDE; oversampling = OVERSAMPLING)
    draw_s = @elapsed draw!(optics, psf, CENTRE, CENTRE)

    progress("$name: moments and EE50")
    before = measure(optics, sigma_guess, flux, mas_per_sample, psf.error_estimate)

    progress("$name: IPC")
    with_ipc = Image(Float64, SIDE, SIDE; oversampling = OVERSAMPLING)
    after, ipc_s = IPCKernel(0.02, 0.002) do kernel
        seconds = @elapsed apply_ipc!(with_ipc, kernel, optics; edge = :zero)
        measure(with_ipc, sigma_guess, flux, mas_per_sample, psf.error_estimate), seconds
    end
    progress("")

    row = (band = name, struts = struts, paper = PAPER[name, struts], nodes = psf.nodes,
           grid = psf.grid_size, error = psf.error_estimate, model_error = psf.model_error,
           psf_ms = 1e3 * psf_s, draw_ms = 1e3 * draw_s, ipc_ms = 1e3 * ipc_s, optics = before,
           with_ipc = after)
    foreach(close, (with_ipc, optics, psf))
    return row
end

# Lengths differ by per cent, ellipticities by absolute numbers.
change(unit, from, to) =
    unit == "mas" ? @sprintf("%+8.3f %%", 100 * (to / from - 1)) : @sprintf("%+10.6f", to - from)

figure(unit, value) = unit == "mas" ? @sprintf("%10.5f", value) : @sprintf("%10.8f", value)

function print_table(rows)
    @printf("WFIRST-AFTA C5, SCA %d, %s struts; IPC: alpha 0.02, alpha' 0.002\n\n", SCA,
            rows[1].struts == 1 ? "with" : "without")
    println("band  quantity             unit   this work  error est.   paper  difference",
            "    with IPC  error est.      change")
    for row in rows, (q, (_, label, unit)) in enumerate(QUANTITIES)
        value, value_with_ipc, paper = row.optics.value[q], row.with_ipc.value[q], row.paper[q]
        difference = isempty(paper) ? "" : change(unit, parse(Float64, paper), value)
        @printf("%-4s  %-19s  %-4s  %10s  %10.1e  %6s  %10s  %10s  %10.1e  %s\n", row.band, label,
                unit, figure(unit, value), row.optics.error[q], paper, difference,
                figure(unit, value_with_ipc), row.with_ipc.error[q],
                change(unit, value, value_with_ipc))
    end
    println("\nPSF   nodes   grid  error est.  pupil model error",
            "      ms: PSF   draw  moments   EE50    IPC  moments   EE50")
    for row in rows
        @printf("%-4s  %5.0f  %5.0f  %10.1e  %17.1e", row.band, row.nodes, row.grid, row.error,
                row.model_error)
        @printf("  %11.2f  %5.2f  %7.2f  %5.2f  %5.2f  %7.2f  %5.2f\n", row.psf_ms, row.draw_ms,
                row.optics.moments_ms, row.optics.ee50_ms, row.ipc_ms, row.with_ipc.moments_ms,
                row.with_ipc.ee50_ms)
    end
    println()
end

function write_csv(path, rows)
    open(path, "w") do file
        println(file, "band,struts,ipc,quantity,unit,paper,value,error_estimate")
        for row in rows, (ipc, measured) in ((0, row.optics), (1, row.with_ipc))
            for (q, (name, _, unit)) in enumerate(QUANTITIES)
                @printf(file, "%s,%d,%d,%s,%s,%s,%.17g,%.17g\n", row.band, row.struts, ipc, name,
                        unit, ipc == 0 ? row.paper[q] : "", measured.value[q], measured.error[q])
            end
        end
    end
end

# Figure 2 of the paper: the monochromatic PSFs of six bands.
function write_figure(folder, instrument)
    for name in ["Z087", "Y106", "J129", "W149", "H158", "F184"]
        progress("$name: PSF")
        wavelength_nm = effective_wavelength_nm(instrument, name)
        PSF(instrument, SCA, wavelength_nm; struts = 1, PSF_OPTIONS...) do psf
            image = draw(psf, SIDE, SIDE; oversampling = OVERSAMPLING)
            write_fits(joinpath(folder, "psf_$name.fits"), image; fits_overwrite = true)
        end
    end
    progress("")
end

function make_folder(path)
    ispath(path) && return
    try
        mkdir(path)
    catch failure
        error("$path: ", sprint(showerror, failure))
    end
end

function main(arguments)
    length(arguments) <= 1 || error("usage: main_job.jl [output folder]")
    folder = isempty(arguments) ? "out" : arguments[1]
    make_folder(folder)

    Instrument("wfirst-afta-c5") do instrument
        rows = map(Iterators.product(TABLE_BANDS, (1, 0))) do (name, struts)
            make_row(instrument, name, struts)
        end
        foreach(print_table, eachcol(rows))
        print("""
              Differences and changes: per cent of the paper's figure, or of the one without IPC;
              absolute for ellipticities. EE50: half of the star's light on 32 x 32 native pixels.
              Errors are numerical, for a PSF in units of its peak; the pupil model's error is apart
              from them. The first time of every step includes its compilation by Julia.
              """)
        write_csv(joinpath(folder, "table_sizes.csv"), rows)
        write_figure(folder, instrument)
    end
end

try
    # A warning comes with a valid result, so it is only told.
    with_logger(() -> main(ARGS), ConsoleLogger(stdout))
catch failure
    progress("")
    println(stderr, "main_job: ", sprint(showerror, failure))
    exit(1)
end
