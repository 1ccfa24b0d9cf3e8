#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs batteries of hard cases through the Python package and writes docs/stability.md of them.

usage: docs/stability.py [--check] BUILD [REFERENCE]

BUILD is a build folder, whose library and fuzz programs are taken; REFERENCE the folder of the
reference data, for the battery of hard images. --check writes nothing. The exit code is 1 if a case
fails. A case passes if its result is as good as it is promised, or is refused with a status that
says why.
"""
import csv
import itertools
import os
import subprocess
import sys
import warnings
from collections import Counter
from pathlib import Path

arguments = [argument for argument in sys.argv[1:] if argument != "--check"]
if len(arguments) not in (1, 2):
    sys.exit(__doc__)
BUILD = Path(arguments[0]).resolve()
ROOT = Path(__file__).resolve().parents[1]
os.environ["WFPSF_LIBRARY"] = str(BUILD / "capi/libwfpsf.so")
sys.path.insert(0, str(ROOT / "bindings/python"))

import numpy as np  # noqa: E402
import wfpsf  # noqa: E402

EDGES = ("zero", "replicate", "wrap", "crop", "fill", "valid")


class Battery:
    """Counts cases, keeps the worst error over what was allowed, and why calls were refused."""

    def __init__(self, name, against):
        self.name, self.against = name, against
        self.solved = self.refused = 0
        self.error, self.share = 0.0, 0.0  # the worst, and the largest part of the allowed
        self.faults = []
        self.reasons = {}  # status: [how often, a line]

    def right(self, what, error, allowed):
        self.solved += 1
        if not error <= allowed:
            self.faults.append(f"{what}: {error:.3g} above {allowed:.3g}")
        self.error = max(self.error, error)
        self.share = max(self.share, error / allowed if allowed else 0.0)

    def refusal(self, what, status, line, expected=None):
        self.refused += 1
        name = wfpsf.status_name(status).removeprefix("WFPSF_")
        if status >= 0 or name in ("ERROR_INTERNAL", "ERROR_NO_MEMORY") or not line or (
                expected and name not in expected):
            self.faults.append(f"{what}: {name}: {line}")
        self.reasons.setdefault(name, [0, line])[0] += 1

    def warned(self, status):
        """A result that its warning makes no result of this battery."""
        self.refused += 1
        name = wfpsf.status_name(status).removeprefix("WFPSF_")
        self.reasons.setdefault(name, [0, wfpsf._status.last_error()])[0] += 1

    def attempt(self, what, call, expected=None):
        """The result of a call, or None if it is refused."""
        try:
            return call()
        except wfpsf.WfpsfError as failure:
            self.refusal(what, failure.status, failure.message, expected)
            return None

    def must_refuse(self, what, call, expected=None):
        if self.attempt(what, call, expected) is not None:
            self.faults.append(f"{what}: not refused")


# ------------------------------------------------------------------------------------------ optics

def bessel_j1(x):
    """By the trapezoidal rule, which is exact to rounding for a periodic integrand."""
    n = int(np.max(np.abs(x), initial=0) + 60)
    t = np.pi * (np.arange(n) + 0.5) / n
    return np.mean(np.cos(t - np.multiply.outer(np.asarray(x, float), np.sin(t))), axis=-1)


def jinc(x):
    small = np.abs(x) < 1e-9
    return np.where(small, 1.0, 2 * bessel_j1(x) / np.where(small, 1.0, x))


def airy(diameter, obscuration, wavelength, scale, dx, dy):
    """Light per native pixel of an obscured circle, offsets in pixels of `scale` arcsec."""
    pixel = np.radians(scale / 3600)
    x = np.pi * diameter * pixel * np.hypot(dx, dy) / wavelength
    area = np.pi / 4 * diameter**2 * (1 - obscuration**2)
    field = (jinc(x) - obscuration**2 * jinc(obscuration * x)) / (1 - obscuration**2)
    return area * (pixel / wavelength) ** 2 * field**2


def psf_airy():
    battery = Battery("PSFs: circles from open to nearly dark, 300 nm to 10 µm, eps 1e-2 to 1e-10",
                      "the Airy pattern; allowed: eps, and the PSF's own estimate")
    places = np.array([(16, 16), (17, 15), (15, 16), (14, 20), (9, 16), (3, 30), (0, 0), (32, 32)])
    for obscuration, nm, eps in itertools.product((0, 1e-3, 0.33, 0.9), (300, 1300, 10000),
                                                  (1e-2, 1e-4, 1e-7, 1e-10)):
        design = wfpsf.Design()
        design.set_telescope(diameter_m=2.4, obscuration=obscuration, reference_wavelength_nm=1000)
        design.set_detector(pixel_scale_arcsec=0.11, n_pix_x=100, n_pix_y=100)
        psf = wfpsf.PSF(wfpsf.Instrument(design), 1, nm, eps=eps, pixel_response=0, psf_radius=17.5)
        for x, y in ((16.0, 16.0), (16.31, 15.83), (15.5, 16.5)):
            stamp = psf.draw(33, 33, x=x, y=y).pixels
            truth = airy(2.4, obscuration, nm * 1e-9, 0.11, places[:, 0] - x, places[:, 1] - y)
            error = np.abs(stamp[places[:, 1], places[:, 0]] - truth).max() / stamp.max()
            battery.right(f"{obscuration} {nm} nm {eps} ({x}, {y})", error,
                          min(psf.error_estimate, eps))
    return battery


def psf_fluxes():
    battery = Battery("Fluxes from 1e-300 to 1e300, of either sign and 0",
                      "a star of flux 1 times the flux")
    psf = wfpsf.PSF(wfpsf.Instrument("wfirst-afta-c5"), 7, 1293)
    one = psf.draw(9, 9).pixels
    for flux in (1e300, -1e300, 1e-300, 1e30, 0.0):
        error = np.abs(psf.draw(9, 9, flux=flux).pixels - flux * one).max()
        battery.right(f"flux {flux}", error / (abs(flux) or 1), 1e-15)
    for flux in (np.nan, np.inf, -np.inf):
        battery.must_refuse(f"flux {flux}", lambda: psf.draw(9, 9, flux=flux), ["ERROR_NOT_FINITE"])
    return battery


# ---------------------------------------------------------------------------------------- detector

def index(i, n, edge):
    """Where pixel i of an axis takes its value; None: nowhere."""
    if edge == "wrap":
        return i % n
    if edge == "replicate":
        return min(max(i, 0), n - 1)
    return i if 0 <= i < n else None


def brute_force(taps, image, edge, gather):
    ny, nx = image.shape
    reach_y, reach_x = taps.shape[0] // 2, taps.shape[1] // 2
    out = np.zeros_like(image)
    for y, x in np.ndindex(ny, nx):
        inside = reach_x <= x < nx - reach_x and reach_y <= y < ny - reach_y
        if edge in ("crop", "fill") and not inside:
            out[y, x] = image[y, x] if edge == "crop" else 0
            continue
        for j, i in np.ndindex(taps.shape):
            dy, dx = (j - reach_y, i - reach_x) if not gather else (reach_y - j, reach_x - i)
            v, u = index(y - dy, ny, edge), index(x - dx, nx, edge)
            if u is not None and v is not None:
                out[y, x] += taps[j, i] * image[v, u]
    return out


def ipc_sizes():
    battery = Battery("IPC on images of 1 x 1 to 9 x 7 pixels, kernels of 1 x 1 to 7 x 5 without "
                      "symmetry, all edges, both forms", "a sum over pixels, one by one")
    random = np.random.default_rng(1)
    for (ny, nx), (ky, kx), edge, form in itertools.product(
            ((1, 1), (1, 5), (6, 1), (2, 3), (9, 7)), ((1, 1), (3, 3), (1, 5), (5, 7)), EDGES[:5],
            (0, 1)):
        taps = random.uniform(0, 0.02, (ky, kx))
        taps[ky // 2, kx // 2] += 1 - taps.sum()
        image = random.normal(size=(ny, nx))
        out = wfpsf.IPCKernel.from_taps(taps).apply(image, edge=edge, ipc_form=form).pixels
        error = np.abs(out - brute_force(taps, image, edge, form)).max() / np.abs(image).max()
        battery.right(f"{nx} x {ny}, taps {kx} x {ky}, {edge}, {form}", error, 1e-15)
    return battery


def ipc_singular():
    battery = Battery("Exact inverse of IPC: margins of 0.5 to 1e-11, three edges, odd sizes",
                      "the image that IPC was applied to; allowed: 4e-15 / margin, error given "
                      "times the margin")
    random = np.random.default_rng(2)
    for margin, edge, shape in itertools.product(10.0 ** -np.arange(0.3, 11.1, 0.89),
                                                 ("zero", "replicate", "wrap"),
                                                 ((1, 1), (3, 40), (97, 64))):
        kernel = wfpsf.IPCKernel((1 - margin) / 8, 0)
        image = random.uniform(size=shape)
        blurred = kernel.apply(image, edge=edge).pixels
        what = f"margin {margin:.2g}, {edge}, {shape}"
        if margin < 1e-3:
            battery.must_refuse(what, lambda: kernel.correct(blurred, edge=edge),
                                ["ERROR_KERNEL_SINGULAR"])
        back = battery.attempt(what, lambda: kernel.correct(
            blurred, edge=edge, ipc_least_margin=0.0, ipc_max_passes=1000000))
        if back is not None:
            error = np.abs(back.image.pixels - image).max() / image.max()
            battery.right(what, error * margin, 4e-15)
    return battery


def ipc_not_finite():
    battery = Battery("NaN and infinities through IPC and its inverse",
                      "they reach the pixels that they couple to and no further: pixels too many "
                      "or too few")
    kernel = wfpsf.IPCKernel(0.02, 0.002, 0.001)
    for bad, edge in itertools.product((np.nan, np.inf, -np.inf), EDGES[:3]):
        image = np.ones((12, 15))
        image[4, 6] = bad
        out = kernel.apply(image, edge=edge).pixels
        expected = np.zeros(image.shape, bool)
        expected[3:6, 5:8] = True
        battery.right(f"{bad} {edge}", np.sum(~np.isfinite(out) != expected), 0)
        back = kernel.correct(out, edge=edge)
        battery.right(f"{bad} {edge} corrected",
                      np.sum(~np.isfinite(back.image.pixels) != expected), 0)
    return battery


# ----------------------------------------------------------------------------------------- moments

def gaussian(shape, x0, y0, mxx, mxy, myy):
    y, x = np.mgrid[0:shape[0], 0:shape[1]]
    dx, dy = x - x0, y - y0
    det = mxx * myy - mxy**2
    return np.exp(-(myy * dx**2 - 2 * mxy * dx * dy + mxx * dy**2) / (2 * det))


def whitened(found, x, y, mxx, mxy, myy):
    factor = np.linalg.inv(np.linalg.cholesky([[mxx, mxy], [mxy, myy]]))
    change = [[found.mxx - mxx, found.mxy - mxy], [found.mxy - mxy, found.myy - myy]]
    return max(np.linalg.norm(factor @ [found.centroid_x - x, found.centroid_y - y]),
               np.linalg.norm(factor @ change @ factor.T))


def measured(battery, what, image, expected=None, **options):
    """Moments, or None if they are refused."""
    return battery.attempt(what, lambda: wfpsf.adaptive_moments(image, **options), expected)


def moments_gaussians():
    battery = Battery("Moments of Gaussians: sigma 1.8 to 20 pixels, e up to 0.9, any phase, "
                      "amplitudes 1e-290 to 1e290, without a guess", "their own parameters")
    for sigma, e, beta, phase, amplitude in itertools.product(
            (1.8, 4.0, 20.0), (0.0, 0.5, 0.9), (0.0, 1.0), (0.0, 0.37), (1e-290, 1.0, 1e290)):
        half = sigma**2 / np.sqrt(1 - e**2)
        m = (half * (1 + e * np.cos(2 * beta)), half * e * np.sin(2 * beta),
             half * (1 - e * np.cos(2 * beta)))
        if half * (1 - e) < 2.6:
            continue  # across its minor axis, samples would not stand for integrals to 1e-8
        side = int(22 * np.sqrt(half)) + 9
        place = (side / 2 + phase, side / 2 - 2 * phase)
        image = amplitude * gaussian((side, side), *place, *m)
        result = measured(battery, f"sigma {sigma} e {e}", image)
        if result:
            battery.right(f"sigma {sigma} e {e} {beta} {phase} {amplitude}",
                          whitened(result, *place, *m), 1e-8)
    return battery


def moments_reference(folder):
    battery = Battery("The reference's hard images: tiny, elongated, at borders, blended, noisy, "
                      "masked, unsolvable", "answers found by a search from many starts")
    with open(folder / "cases.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        what = f"{row['id']} {row['category']} {row['name']}"
        image = wfpsf.read_fits(folder / row["image"])
        options = {f"moments_guess_{name}": float(row[f"guess_{name}"])
                   for name in ("x", "y", "sigma")}
        if row["ref_status"] == "OK":
            missing = wfpsf.read_fits(folder / row["image"], "BADPIX") if row["mask"] else None
            result = measured(battery, what, image, missing=missing, **options)
            if result is None:
                battery.faults.append(f"{what}: refused")
                continue
            sigma, e1, e2 = (float(row[f"ref_{name}"]) for name in ("sigma", "e1", "e2"))
            half = sigma**2 / np.sqrt(1 - e1**2 - e2**2)
            battery.right(what, whitened(result, float(row["ref_x"]), float(row["ref_y"]),
                                         half * (1 + e1), half * e2, half * (1 - e1)), 1e-8)
        elif row["ref_status"].startswith("NO_SOLUTION") or row["ref_status"] == "NONFINITE":
            if measured(battery, what, image, **options):
                battery.faults.append(f"{what}: solved what has no solution")
    return battery


def moments_native():
    """Stars as small as Roman's on its own pixels, by the field's method and by least squares."""
    adaptive = Battery("Roman stars on native pixels, 25 phases, eight bands: method 0",
                       "method 0 of the same star at 4 samples a pixel, if it is solved without a "
                       "warning; error of sigma, relative")
    squares = Battery("The same by least squares at pixel centres: method 1",
                      "all are solved; error: scatter of sigma over the phases, relative")
    roman = wfpsf.Instrument("roman-c9")
    for band in roman.bands:
        psf = wfpsf.PSF.in_band(roman, band, 7, 2043.5, 2043.5)
        fine = wfpsf.adaptive_moments(psf.draw(128, 128, oversampling=4)).sigma / 4
        sigmas = []
        for i, j in np.ndindex(5, 5):
            star = psf.draw(33, 33, x=16 + i / 5, y=16 + j / 5)
            result = measured(adaptive, band, star, ["ERROR_MOMENTS_UNRESOLVED"])
            if result and result.status == 0:
                adaptive.right(f"{band} {i} {j}", abs(result.sigma / fine - 1), 0.05)
            elif result:
                adaptive.warned(result.status)
            sigmas.append(wfpsf.adaptive_moments(star, moments_method=1).sigma)
        squares.right(band, np.ptp(sigmas) / np.mean(sigmas), np.inf)
        squares.solved += len(sigmas) - 1
    return adaptive, squares


def moments_background():
    battery = Battery("A star of amplitude 1 on backgrounds of up to 1e10, fitted too: method 3",
                      "the star's parameters; allowed: 3e-15 (1 + background)")
    truth = (31.2, 30.7, 9.0, 1.0, 7.0)
    for background in (0.0, 1.0, -1e3, 1e5, 1e8, 1e10):
        image = background + gaussian((64, 64), *truth)
        result = measured(battery, f"{background}", image, moments_method=3,
                          moments_guess_x=31.0, moments_guess_y=31.0, moments_guess_sigma=3.0)
        if result:
            battery.right(f"background {background}", whitened(result, *truth),
                          max(1e-8, 3e-15 * (1 + abs(background))))
    return battery


def moments_noise():
    batteries = []
    random = np.random.default_rng(3)
    for ratio, most in ((5, 0.03), (7, 0.01), (10, 0.0)):
        battery = Battery(f"500 noisy stars at S/N {ratio}, without a guess",
                          "refused at most: 3 % at S/N 5, 1 % at 7, none at 10; share refused")
        truth = (31.2, 30.7, 9.0, 1.0, 7.0)
        star = gaussian((64, 64), *truth)
        rms = np.sqrt(np.sum(star**2)) / ratio
        for trial in range(500):
            measured(battery, f"trial {trial}", star + random.normal(0, rms, star.shape))
        refused = battery.refused
        battery.right("share", refused / 500, most)
        battery.solved = 500 - refused
        batteries.append(battery)
    return batteries


# -------------------------------------------------------------------------------------- everything

def empty_and_tiny():
    battery = Battery("Every kind of call on images of 0 x 0, 1 x 1, 1 x 8, 8 x 1 and 2 x 2 "
                      "pixels, zeros and ones", "a result of finite numbers, or a refusal")
    c5 = wfpsf.Instrument("wfirst-afta-c5")
    psf, kernel = wfpsf.PSF(c5, 7, 1293), wfpsf.IPCKernel(0.02, 0.002)
    chain = wfpsf.Chain.default(c5)
    calls = {
        "draw": lambda image: psf.draw_into(image, 0, 0),
        "bright star": lambda image: psf.add_bright_star(image, 0, 0),
        "stars": lambda image: psf.add_stars(image, [0.0], [0.0], [1.0]),
        "galaxy": lambda image: psf.convolve_into(image, np.ones((2, 2)), 0, 0),
        **{f"IPC {edge}": lambda image, edge=edge: kernel.apply(image, edge=edge)
           for edge in EDGES},
        **{f"inverse {edge}": lambda image, edge=edge: kernel.correct(image, edge=edge).image
           for edge in EDGES},
        "covariance": lambda image: kernel.covariance(image),
        "chain": lambda image: chain.apply(image) and image,
        "noise": lambda image: wfpsf.add_noise(image, 1.0, kernel),
        **{f"moments {method}": lambda image, method=method: wfpsf.adaptive_moments(
            image, moments_method=method) for method in range(4)},
        "unweighted": wfpsf.unweighted_moments,
        "EE50": lambda image: wfpsf.ee_radius(image, 0, 0),
        "FWHM": lambda image: wfpsf.fwhm(image, 0, 0),
        "profile": lambda image: wfpsf.radial_profile(image, 0, 0, [0.0]),
    }
    for shape, value, (name, call) in itertools.product(
            ((0, 0), (1, 1), (1, 8), (8, 1), (2, 2)), (0.0, 1.0), calls.items()):
        image = wfpsf.Image(np.full(shape, value))
        what = f"{name} of {shape[1]} x {shape[0]}, {value}"
        result = battery.attempt(what, lambda: call(image))
        if isinstance(result, wfpsf.Image):
            battery.right(what, np.sum(~np.isfinite(result.pixels)), 0)
        elif result is not None:
            battery.right(what, 0.0, 0)
    return battery


def option_bounds():
    battery = Battery("Every option at and beyond its bounds, NaN and infinite",
                      "accepted at its bounds, refused beyond")
    from wfpsf import _options  # one option at a time, without a call that takes it
    for option in wfpsf.options():
        options = _options.Options()
        for bound, away in (("smallest", -1), ("largest", 1)):
            value = getattr(option, bound)
            options.set(option.name, int(value) if option.integer else value)
            battery.right(f"{option.name} at {value}", 0.0, 0)
            with np.errstate(over="ignore"):
                beyond = int(value) + away if option.integer else np.nextafter(value, away * np.inf)
            battery.must_refuse(f"{option.name} = {beyond}",
                                lambda: options.set(option.name, beyond) or True,
                                ["ERROR_RANGE", "ERROR_NOT_FINITE"])
        if not option.integer:
            for value in (np.nan, np.inf, -np.inf):
                battery.must_refuse(f"{option.name} = {value}",
                                    lambda: options.set(option.name, value) or True,
                                    ["ERROR_NOT_FINITE"])
    return battery


def large():
    battery = Battery("8192 x 8192 float32: IPC, its inverse, a chain, 1024 stars, moments",
                      "charge kept, the image had back, stars and moments as on small images")
    side = 8192
    random = np.random.default_rng(4)
    image = random.uniform(0.5, 1, (side, side)).astype(np.float32)
    kernel = wfpsf.IPCKernel(0.02, 0.002)
    blurred = kernel.apply(image, edge="wrap").pixels
    battery.right("IPC keeps the charge",
                  abs(blurred.sum(dtype=float) / image.sum(dtype=float) - 1), 1e-8)
    back = kernel.correct(blurred, edge="wrap").image.pixels
    battery.right("inverse", float(np.abs(back - image).max()), 3e-7)
    del back, blurred
    # Stars that do not touch, each against the same star on a small image.
    psf = wfpsf.PSF(wfpsf.Instrument("wfirst-afta-c5"), 7, 1293)
    image[:] = 0
    corners = [(x, y) for x in range(0, side, 256) for y in range(0, side, 256)]
    phases = random.uniform(100, 101, (len(corners), 2))
    places = np.array(corners) + phases
    psf.add_stars(image, *places.T, np.ones(len(corners)))
    for (x, y), phase in list(zip(corners, phases))[::51]:
        alone = np.zeros((256, 256), np.float32)
        psf.add_stars(alone, [phase[0]], [phase[1]], [1.0])
        error = np.abs(image[y:y + 256, x:x + 256] - alone).max() / alone.max()
        battery.right(f"star in the cell at {x}, {y}", error, 2e-7)
    image[:] = 0
    alone = psf.draw(64, 64, oversampling=4, dtype=np.float32).pixels
    image[4000:4064, 4000:4064] = alone
    found, expected = wfpsf.adaptive_moments(image), wfpsf.adaptive_moments(alone)
    battery.right("moments of one star", abs(found.sigma / expected.sigma - 1), 1e-8)
    image[:] = 100
    counts = wfpsf.Chain.default(wfpsf.Instrument("roman-c9")).apply(image)
    battery.right("chain", counts.not_finite, 0)
    return battery


def fuzz():
    for program in ("fuzz_fits", "fuzz_options"):
        path = BUILD / "tests/fuzz" / program
        if not path.exists():
            continue
        battery = Battery(f"{program}: damaged inputs for 5 s, seed 1", "no crash")
        ended = subprocess.run([path, "5", "1"], capture_output=True, text=True, cwd=BUILD)
        if ended.returncode:
            battery.faults.append(f"exit code {ended.returncode}: {ended.stderr}")
        battery.solved = int(ended.stdout.split()[0]) if not ended.returncode else 0
        yield battery


# ------------------------------------------------------------------------------------------ report

MEANING = {
    "ERROR_NOT_FINITE": "a NaN or an infinity would become the result",
    "ERROR_RANGE": "outside of what is defined, or of what an option allows",
    "ERROR_ARGUMENT": "it has no meaning: edges that throw pixels away have no inverse",
    "ERROR_KERNEL_SINGULAR": "the inverse would amplify noise, rounding too, by 1 / margin",
    "ERROR_MOMENTS_UNRESOLVED": "the fit has no maximum: the weight shrinks onto one pixel",
    "ERROR_MOMENTS_FILLS_IMAGE": "the fit grows beyond the image: what lies there is not known",
    "ERROR_MOMENTS_FLUX": "there is no positive light to weigh",
    "ERROR_MOMENTS_NO_PIXELS": "there are no pixels under the weight",
    "ERROR_MOMENTS_STALLED": "the fit stands at a saddle point: no measurement of an object",
    "ERROR_SIZE_NOT_REACHED": "the circle leaves the image: what lies there is not known",
    "WARNING_UNDERSAMPLED": "solved, but the phase changes it by some per cent: use method 1",
}


def number(value):
    return "0" if value == 0 else f"{value:.1e}"


def report(batteries):
    yield "# Numerical stability\n"
    yield f"""\
Made by `docs/stability.py build/release REFERENCE` (`REFERENCE`: the reference data), from a run of
wfpsf {wfpsf.__version__}; test `docs.stability` runs it without reference and fuzzing. A case passes if
its result is as good as is promised, or is refused with a status that says why. The worst error is
that of results; *of allowed* is the largest share of what its case may have.
"""
    yield ("| Battery | Held against | Cases | Results | Refused | Failed | Worst error "
           "| Of allowed |")
    yield "|---|---|---|---|---|---|---|---|"
    for battery in batteries:
        share = f"{100 * battery.share:.0f} %" if battery.share else ""
        yield (f"| {battery.name} | {battery.against} | {battery.solved + battery.refused} "
               f"| {battery.solved} | {battery.refused} | {len(battery.faults)} "
               f"| {number(battery.error)} | {share} |")
    yield """
## Why calls were refused

Every status of the refusals above, and an example of the line that the call left.
"""
    yield "| Status | Times | Reason | For example |"
    yield "|---|---|---|---|"
    times, lines = Counter(), {}
    for battery in batteries:
        for name, (count, line) in battery.reasons.items():
            times[name] += count
            lines.setdefault(name, line)
    for name in sorted(times):
        line = lines[name].replace("|", "\\|")
        yield f"| `{name}` | {times[name]} | {MEANING[name]} | {line} |"
    yield """
Statuses that these batteries do not meet stand in [the list](api/status.rst), each with its text; the
tests of `tests/capi` meet all that a caller can bring about."""


def main():
    warnings.simplefilter("ignore", wfpsf.WfpsfWarning)
    batteries = [psf_airy(), psf_fluxes(), ipc_sizes(), ipc_singular(), ipc_not_finite(),
                 moments_gaussians()]
    if len(arguments) == 2:
        batteries.append(moments_reference(Path(arguments[1]) / "moments_battery"))
    batteries += [*moments_native(), moments_background(), *moments_noise(), empty_and_tiny(),
                  option_bounds(), large()]
    if "--check" not in sys.argv:
        batteries += fuzz()
    for battery in batteries:
        for fault in battery.faults[:10]:
            print(f"{battery.name}: {fault}", file=sys.stderr)
    text = "\n".join(report(batteries)) + "\n"
    if "--check" not in sys.argv:
        (ROOT / "docs/stability.md").write_text(text)
    print(text)
    sys.exit(any(battery.faults for battery in batteries))


if __name__ == "__main__":
    main()
