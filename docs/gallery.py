#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of docs/gallery.md with the Python package: scripts/pictures.sh."""
import numpy as np
import wfpsf
from matplotlib.colors import LogNorm
from matplotlib.patches import Polygon
from pictures import extent, logarithmic, plt, save, show

SCALE = 0.11  # arcsec, the pixel of both telescopes
CENTRE = 2043.5  # of a detector, pixels
COLOURS = {"shared": "tab:blue", "own": "tab:red", "fourier": "tab:green",
           "fourier_own": "tab:olive"}


def finish(figure, panels, picture, name):
    """Labels and writes a table of PSFs."""
    for axes in panels[-1]:
        axes.set_xlabel("x, arcsec")
    for axes in panels[:, 0]:
        axes.set_ylabel("y, arcsec")
    figure.colorbar(picture, ax=panels, label="in units of the peak", shrink=0.9)
    save(figure, name)


def bands():
    """PSFs of all Roman bands at SCA 7."""
    roman = wfpsf.Instrument("roman-c9")
    names = roman.bands
    figure, panels = plt.subplots(2, -(-len(names) // 2), figsize=(9, 4.9), sharex=True,
                                  sharey=True)
    for axes in panels.ravel()[len(names):]:
        axes.remove()
    for name, axes in zip(names, panels.ravel()):
        psf = wfpsf.PSF.in_band(roman, name, 7, CENTRE, CENTRE)
        shown, norm = logarithmic(psf.draw(128, 128, oversampling=8).pixels, 4)
        picture = show(axes, shown, extent(16, SCALE), norm=norm, cmap="inferno")
        axes.set_title(f"{name}, {psf.wavelength_nm:.0f} nm")
    finish(figure, panels, picture, "bands.png")


def detectors():
    """PSFs of the 18 detectors' centres in J129."""
    roman = wfpsf.Instrument("roman-c9")
    figure, panels = plt.subplots(3, 6, figsize=(9, 5), sharex=True, sharey=True)
    for sca, axes in enumerate(panels.ravel(), 1):
        psf = wfpsf.PSF.in_band(roman, "J129", sca, CENTRE, CENTRE)
        shown, norm = logarithmic(psf.draw(60, 60, oversampling=6).pixels, 3)
        picture = show(axes, shown, extent(10, SCALE), norm=norm, cmap="inferno")
        axes.set_title(f"SCA {sca}")
    finish(figure, panels, picture, "detectors.png")


def ipc():
    """A star before and after IPC, and the difference."""
    c5 = wfpsf.Instrument("wfirst-afta-c5")
    psf = wfpsf.PSF(c5, 7, c5.band("J129", rule="paper").effective_nm)
    before = psf.draw(96, 96, oversampling=8)
    after = wfpsf.IPCKernel(0.02, 0.002).apply(before)
    peak = before.pixels.max()
    change = (after.pixels - before.pixels) / peak
    figure, panels = plt.subplots(1, 3, figsize=(9, 2.9), sharey=True)
    for axes, pixels, title in zip(panels, (before.pixels, after.pixels),
                                   ("before", "after: alpha = 0.02, alpha' = 0.002")):
        shown, norm = logarithmic(pixels / peak, 3)
        picture = show(axes, shown, extent(12, SCALE), norm=norm, cmap="inferno")
        axes.set_title(title)
    figure.colorbar(picture, ax=panels[:2], label="in units of the peak before")
    largest = np.abs(change).max()
    picture = show(panels[2], change, extent(12, SCALE), cmap="RdBu_r", vmin=-largest,
                   vmax=largest)
    panels[2].set_title("after - before")
    figure.colorbar(picture, ax=panels[2], label="in units of the peak before")
    for axes in panels:
        axes.set_xlabel("x, arcsec")
    panels[0].set_ylabel("y, arcsec")
    save(figure, "ipc.png")


FIGURES = {  # name of the table: title
    "figure_3": "Fig. 3: sigma, %", "figure_4": "Fig. 4: EE50, %",
    "figure_5": "Fig. 5: change of e1", "figure_6": "Fig. 6: change of e2",
    "figure_7": "Fig. 7: change of e1", "figure_8": "Fig. 8: change of e2",
    "figure_9": "Fig. 9: sigma, %", "figure_10": "Fig. 10: 1000 x change of e1",
    "figure_11": "Fig. 11: 1000 x change of e2"}
LABELS = {"alpha": "alpha", "alpha_prime": "alpha'", "alpha_plus": "alpha+",
          "delta_alpha": "change of alpha", "delta_alpha_prime": "change of alpha'",
          "delta_alpha_plus": "change of alpha+"}


def contours():
    """The paper's Figures 3 to 11: J129, H158 and F184 side by side."""
    study = wfpsf.Study(wfpsf.Instrument("wfirst-afta-c5"), 7)
    for part, names in (("sizes", ("figure_3", "figure_4", "figure_9")),
                        ("shapes", ("figure_5", "figure_6", "figure_7", "figure_8")),
                        ("errors", ("figure_10", "figure_11"))):
        shown = ("J129", "H158", "F184")
        figure, panels = plt.subplots(len(names), 3, figsize=(8.6, 2.5 * len(names)))
        for name, row in zip(names, panels):
            table = study.table(name)
            x_name, y_name = list(table)[:2]
            x, y = np.unique(table[x_name]), np.unique(table[y_name])
            order = np.lexsort((table[x_name], table[y_name]))
            for band, axes in zip(shown, row):
                values = table[band][order].reshape(len(y), len(x))
                levels = np.linspace(values.min(), values.max(), 9)[1:-1]
                # The palest colours would not be read on white.
                lines = axes.contour(x, y, values, levels, cmap="viridis",
                                     vmax=levels[-1] + 0.4 * np.ptp(levels))
                axes.clabel(lines, fontsize=7, fmt="%.2g")
                axes.set(title=f"{FIGURES[name]}, {band}", xlabel=LABELS[x_name],
                         ylabel=LABELS[y_name] if band == shown[0] else None)
                axes.locator_params(nbins=4)
        save(figure, f"contours_{part}.png")


def sensitivities():
    """How sizes and shapes answer to IPC, over the focal plane."""
    roman = wfpsf.Instrument("roman-c9")
    sky = wfpsf.Observation(roman, 0, 0, 0, pa_of_fpa=1)
    scale, samples = 1000 * SCALE / 6, 6
    low, nominal, high, plus = (wfpsf.IPCKernel(*parameters) for parameters in (
        (0.015, 0.002), (0.02, 0.002), (0.025, 0.002), (0.02, 0.002, 0.005)))
    rows = []
    for sca in range(1, 19):
        star = wfpsf.PSF.in_band(roman, "J129", sca, CENTRE, CENTRE).draw(144, 144,
                                                                          oversampling=samples)
        image = nominal.apply(star).pixels
        # IPC is linear in its parameters: these differences are its derivatives.
        by_alpha = (high.apply(star).pixels - low.apply(star).pixels) / 0.01
        by_plus = (plus.apply(star).pixels - image) / 0.005
        m = wfpsf.adaptive_moments(image)
        rows.append((m.sigma * scale, wfpsf.moments_derivative(image, by_alpha).sigma / m.sigma,
                     wfpsf.moments_derivative(image, by_plus).e1))
    figure, panels = plt.subplots(1, 3, figsize=(9.4, 3.1), sharey=True)
    titles = (("sigma with IPC, mas", ".1f"), ("(dsigma / dalpha) / sigma", ".2f"),
              ("de1 / dalpha+", ".2f"))
    last = 4087.5
    corners = np.array([[-0.5, -0.5], [last, -0.5], [last, last], [-0.5, last]])
    for axes, values, (title, digits) in zip(panels, np.array(rows).T, titles):
        norm = plt.Normalize(values.min(), values.max())
        for sca, value in enumerate(values, 1):
            ra, dec = sky.pixel_to_sky(sca, *corners.T)
            ra = (ra + 180) % 360 - 180
            colour = plt.cm.viridis(norm(value))
            axes.add_patch(Polygon(np.transpose([ra, dec]), fc=colour, ec="k", lw=0.5))
            axes.text(ra.mean(), dec.mean(), format(value, digits), ha="center", va="center",
                      fontsize=6.5, color="k" if norm(value) > 0.5 else "w")
        axes.set(xlim=(0.44, -0.44), ylim=(-0.22, 0.33), aspect="equal", title=title,
                 xlabel="RA, degrees (east to the left)")
        figure.colorbar(plt.cm.ScalarMappable(norm, "viridis"), ax=axes, orientation="horizontal")
    panels[0].set_ylabel("Dec, degrees")
    save(figure, "sensitivities.svg")


def spikes():
    """A bright star on 512 x 512 native pixels: nothing is folded back from the border."""
    roman = wfpsf.Instrument("roman-c9")
    psf = wfpsf.PSF.in_band(roman, "H158", 7, CENTRE, CENTRE)
    pixels = psf.draw(512, 512).pixels
    shown, norm = logarithmic(pixels.reshape(256, 2, 256, 2).mean((1, 3)), 8)
    figure, axes = plt.subplots(figsize=(5.4, 4.4))
    picture = show(axes, shown, extent(512, SCALE), norm=norm, cmap="inferno")
    axes.set(xlabel="x, arcsec", ylabel="y, arcsec", title="H158, means of 2 x 2 native pixels")
    figure.colorbar(picture, ax=axes, label="in units of the brightest")
    save(figure, "spikes.png")


def scene():
    """A part of a detector with stars and galaxies, and how the plan drew which."""
    first, side, stars, galaxies = 1600, 512, 1500, 600
    random = np.random.default_rng(7)
    roman = wfpsf.Instrument("roman-c9")
    catalogue = wfpsf.Catalogue("detector", "ab_magnitude")
    catalogue.add_colour(sed=wfpsf.SED.black_body(5000))
    least = 10 ** (0.35 * (16 - 27))  # counts rise as 10^(0.35 m) from 16 to 27
    magnitude = 27 + np.log10(least + random.random(stars) * (1 - least)) / 0.35
    magnitude[:3] = 15.5, 16.5, 18
    x, y = side * random.random((2, stars + galaxies))
    x[:3], y[:3] = (200, 410, 90), (280, 120, 60)
    x, y = x + first, y + first
    catalogue.add_stars(x[:stars], y[:stars], magnitude)
    shear, angle = 0.3 * random.random(galaxies), 2 * np.pi * random.random(galaxies)
    catalogue.add_galaxies(x[stars:], y[stars:], random.uniform(23, 26, galaxies),
                           sersic_index=random.choice([1.0, 4.0], galaxies),
                           half_light_radius_arcsec=random.uniform(0.15, 0.6, galaxies),
                           e1=shear * np.cos(angle), e2=shear * np.sin(angle))
    background = 40
    plan = wfpsf.Scene(roman, "J129", 7, catalogue, (side, side), first, first, scene_noise=0.3,
                       scene_background=background)
    image = wfpsf.zeros((side, side))
    plan.render(image)
    light = image.pixels + background
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.4, 4.3), width_ratios=(1.2, 1))
    picture = show(left, light, extent(side, SCALE), cmap="inferno",
                   norm=LogNorm(background * 0.98, 2e4))
    left.set(xlabel="x, arcsec", ylabel="y, arcsec", title="light on 512 x 512 pixels of SCA 7")
    figure.colorbar(picture, ax=left, label="electrons a pixel")
    for group in plan.groups:
        kind = "o" if group["kind"] == "star" else "s"
        right.scatter(group["flux_from"], group["radius"], 4 + 12 * np.log10(group["sources"]),
                      marker=kind, color=COLOURS[group["drawing"]])
    for name, colour in COLOURS.items():
        right.scatter([], [], color=colour, label=name)
    right.set(xscale="log", yscale="log", xlabel="flux, electrons",
              ylabel="half size of the stamp, pixels",
              title="the plan: stars (round), galaxies (square)")
    right.legend(fontsize=7)
    save(figure, "scene.png")


if __name__ == "__main__":
    for draw in (bands, detectors, ipc, contours, sensitivities, spikes, scene):
        draw()
