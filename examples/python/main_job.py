#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Size, shape and half-light radius of the WFIRST-AFTA C5 PSF before and after interpixel
capacitance, beside Table 2 of Kannawadi et al. 2016, and the six PSFs of its Figure 2.

usage: PYTHONPATH=bindings/python python3 examples/python/main_job.py [output folder]

Writes table_sizes.csv and psf_<BAND>.fits.
"""
import math
import os
import sys
import time
import warnings
from types import SimpleNamespace

import wfpsf

# The paper's stamp: 16 x 16 native pixels in steps of 1/32 pixel, the star at the centre.
SCA = 7
NATIVE_SIDE = 16
OVERSAMPLING = 32
SIDE = NATIVE_SIDE * OVERSAMPLING
CENTRE = (SIDE - 1) / 2

# The field whose light counts as all of it for EE50, as in the paper: 32 x 32 native pixels.
FIELD_SIDE = 32
FIELD_SAMPLING = 4

PSF_OPTIONS = {"eps": 1e-7, "psf_radius": FIELD_SIDE / 2}

# Name in the CSV file, name in the table, unit.
QUANTITIES = (("sigma", "sigma", "mas"), ("e1", "e1", "1"), ("e2", "e2", "1"), ("e", "|e|", "1"),
              ("ee50_centroid", "EE50 about centroid", "mas"),
              ("ee50_axis", "EE50 about axis", "mas"))

# Table 2 of the paper by band and struts, in the order of the quantities and with the digits that
# it gives; empty where it prints nothing.
TABLE_BANDS = ("J129", "H158", "F184")
PAPER = {("J129", 1): ("61.50", "", "", "0.0646", "114.85", ""),
         ("H158", 1): ("66.16", "", "", "0.0379", "123.72", ""),
         ("F184", 1): ("72.39", "", "", "0.0246", "132.37", ""),
         ("J129", 0): ("60.480", "", "", "0.0652", "95.06", ""),
         ("H158", 0): ("65.884", "", "", "0.0417", "103.85", ""),
         ("F184", 0): ("72.452", "", "", "0.0292", "113.21", "")}

NOTE = """\
Differences and changes: per cent of the paper's figure, or of the one without IPC; absolute for
ellipticities. EE50: half of the star's light on 32 x 32 native pixels. Errors are numerical, for a
PSF in units of its peak; the pupil model's error is apart from them."""


def progress(text):
    if sys.stderr.isatty():
        print("\r\033[K" + text, end="", file=sys.stderr, flush=True)


def effective_wavelength_nm(instrument, name):
    return instrument.band(name, rule="paper").effective_nm


def timed(work):
    """The result of ``work()`` and the milliseconds that it took."""
    start = time.perf_counter()
    result = work()
    return result, 1e3 * (time.perf_counter() - start)


def field_flux(psf):
    """The light of a star of unit flux that falls on the field around it."""
    side = FIELD_SIDE * FIELD_SAMPLING
    with psf.draw(side, side, oversampling=FIELD_SAMPLING) as field:
        return math.fsum(field.pixels.flat)


def measure(image, sigma_guess, flux, mas_per_sample, psf_error):
    """The errors are numerical ones: that of the measurement and that of the PSF's pixels. How well
    the pupil's geometry fits the published mask is another matter: ``model_error``."""
    m, moments_ms = timed(lambda: wfpsf.adaptive_moments(
        image, moments_tolerance=1e-10, moments_guess_x=CENTRE, moments_guess_y=CENTRE,
        moments_guess_sigma=sigma_guess))
    radii, ee50_ms = timed(lambda: [wfpsf.ee_radius(image, x, y, size_total_flux=flux) for x, y in
                                    ((m.centroid_x, m.centroid_y), (CENTRE, CENTRE))])

    error = m.error_estimate / 2 + 2 * psf_error
    value = [m.sigma * mas_per_sample, m.e1, m.e2, m.e]
    errors = [value[0] * error, 2 * error, 2 * error, 2 * error]
    for ee50 in radii:
        value.append(ee50.radius * mas_per_sample)
        errors.append((ee50.error + ee50.radius * 2 * psf_error) * mas_per_sample)
    return SimpleNamespace(value=value, error=errors, moments_ms=moments_ms, ee50_ms=ee50_ms)


def make_row(instrument, name, struts):
    wavelength_nm = effective_wavelength_nm(instrument, name)
    mas_per_sample = 1000 * instrument.constant("pixel_scale").value / OVERSAMPLING
    sigma_guess = 0.55 * OVERSAMPLING * wavelength_nm / 1292

    progress(name + ": PSF")
    psf, psf_ms = timed(lambda: wfpsf.PSF(instrument, SCA, wavelength_nm, struts=struts,
                                          **PSF_OPTIONS))
    with psf, wfpsf.zeros((SIDE, SIDE), oversampling=OVERSAMPLING) as optics, \
            wfpsf.zeros((SIDE, SIDE), oversampling=OVERSAMPLING) as with_ipc, \
            wfpsf.IPCKernel(0.02, 0.002) as kernel:
        flux = field_flux(psf)
        _, draw_ms = timed(lambda: psf.draw_into(optics, CENTRE, CENTRE))

        progress(name + ": moments and EE50")
        before = measure(optics, sigma_guess, flux, mas_per_sample, psf.error_estimate)

        progress(name + ": IPC")
        _, ipc_ms = timed(lambda: kernel.apply(optics, with_ipc, edge="zero"))
        after = measure(with_ipc, sigma_guess, flux, mas_per_sample, psf.error_estimate)
        progress("")

        return SimpleNamespace(band=name, struts=struts, paper=PAPER[name, struts],
                               nodes=psf.nodes, grid=psf.grid_size, error=psf.error_estimate,
                               model_error=psf.model_error, psf_ms=psf_ms, draw_ms=draw_ms,
                               ipc_ms=ipc_ms, optics=before, with_ipc=after)


def change(unit, old, new):
    """Lengths differ by per cent, ellipticities by absolute numbers."""
    return "%+8.3f %%" % (100 * (new / old - 1)) if unit == "mas" else "%+10.6f" % (new - old)


def figure(unit, value):
    return "%10.5f" % value if unit == "mas" else "%10.8f" % value


def print_table(rows):
    print("WFIRST-AFTA C5, SCA %d, %s struts; IPC: alpha 0.02, alpha' 0.002\n"
          % (SCA, "with" if rows[0].struts else "without"))
    print("band  quantity             unit   this work  error est.   paper  difference"
          "    with IPC  error est.      change")
    for row in rows:
        for q, (_, label, unit) in enumerate(QUANTITIES):
            value, with_ipc, paper = row.optics.value[q], row.with_ipc.value[q], row.paper[q]
            difference = change(unit, float(paper), value) if paper else ""
            print("%-4s  %-19s  %-4s  %10s  %10.1e  %6s  %10s  %10s  %10.1e  %s"
                  % (row.band, label, unit, figure(unit, value), row.optics.error[q], paper,
                     difference, figure(unit, with_ipc), row.with_ipc.error[q],
                     change(unit, value, with_ipc)))
    print("\nPSF   nodes   grid  error est.  pupil model error"
          "      ms: PSF   draw  moments   EE50    IPC  moments   EE50")
    for row in rows:
        print("%-4s  %5.0f  %5.0f  %10.1e  %17.1e  %11.2f  %5.2f  %7.2f  %5.2f  %5.2f  %7.2f  %5.2f"
              % (row.band, row.nodes, row.grid, row.error, row.model_error, row.psf_ms,
                 row.draw_ms, row.optics.moments_ms, row.optics.ee50_ms, row.ipc_ms,
                 row.with_ipc.moments_ms, row.with_ipc.ee50_ms))
    print()


def write_csv(path, rows):
    with open(path, "w", encoding="ascii") as file:
        print("band,struts,ipc,quantity,unit,paper,value,error_estimate", file=file)
        for row in rows:
            for ipc, measured in enumerate((row.optics, row.with_ipc)):
                for q, (name, _, unit) in enumerate(QUANTITIES):
                    print("%s,%d,%d,%s,%s,%s,%.17g,%.17g"
                          % (row.band, row.struts, ipc, name, unit, "" if ipc else row.paper[q],
                             measured.value[q], measured.error[q]), file=file)


def write_figure(folder, instrument):
    """Figure 2 of the paper: the monochromatic PSFs of six bands."""
    for name in ("Z087", "Y106", "J129", "W149", "H158", "F184"):
        progress(name + ": PSF")
        wavelength_nm = effective_wavelength_nm(instrument, name)
        with wfpsf.PSF(instrument, SCA, wavelength_nm, struts=1, **PSF_OPTIONS) as psf:
            image = psf.draw(SIDE, SIDE, oversampling=OVERSAMPLING)
            wfpsf.write_fits(os.path.join(folder, "psf_%s.fits" % name), image, fits_overwrite=1)
    progress("")


def main(arguments):
    if len(arguments) > 1:
        raise ValueError("usage: main_job.py [output folder]")
    folder = arguments[0] if arguments else "out"
    if not os.path.exists(folder):
        os.mkdir(folder)

    with wfpsf.Instrument("wfirst-afta-c5") as instrument:
        tables = [[make_row(instrument, name, struts) for name in TABLE_BANDS]
                  for struts in (1, 0)]
        for rows in tables:
            print_table(rows)
        print(NOTE)
        write_csv(os.path.join(folder, "table_sizes.csv"), [row for rows in tables for row in rows])
        write_figure(folder, instrument)


if __name__ == "__main__":
    # A warning comes with a valid result, so it is only told.
    warnings.showwarning = lambda message, *_, **__: print(message)
    try:
        main(sys.argv[1:])
    except (OSError, ValueError, wfpsf.WfpsfError) as failure:
        progress("")
        print("main_job: %s" % failure, file=sys.stderr)
        sys.exit(1)
