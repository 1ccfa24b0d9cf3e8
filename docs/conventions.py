#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of docs/conventions.md with the Python package: scripts/pictures.sh."""
import numpy as np
import wfpsf
from matplotlib.patches import Ellipse, Rectangle
from pictures import extent, logarithmic, plt, save, show

SCALE = 0.11  # arcsec, Roman's pixel


def pixels():
    figure, (native, fine) = plt.subplots(1, 2, figsize=(8, 3.4))
    for axes in (native, fine):
        for x in range(4):
            for y in range(3):
                axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, fill=False, ec="0.6"))
        axes.set(xlim=(-0.7, 3.7), ylim=(-0.7, 2.7), aspect="equal", xticks=range(4),
                 yticks=range(3), xlabel="x, native pixels", ylabel="y, native pixels")
    grid = np.mgrid[0:3, 0:4]
    native.plot(grid[1].ravel(), grid[0].ravel(), "k.", ms=5)
    for x in range(4):
        for y in range(3):
            native.text(x, y + 0.12, f"({x}, {y})", ha="center", va="bottom", fontsize=7)
    native.plot(1.5, 1, "r+", ms=12, mew=2)
    native.text(1.5, 0.78, "centre ((nx-1)/2, (ny-1)/2)", color="r", ha="center", va="top",
                fontsize=7)
    native.set_title("an image of nx = 4, ny = 3 native pixels")
    # The first sample's centre is the first pixel's; sample i stands at i / N.
    samples = np.mgrid[0:6, 0:8] / 2
    fine.plot(samples[1].ravel(), samples[0].ravel(), ".", c="tab:blue", ms=6)
    fine.add_patch(Rectangle((0.5, 0.0), 1, 1, fill=True, fc="tab:orange", alpha=0.4))
    fine.plot(1.0, 0.5, "o", c="tab:orange", ms=7)
    fine.set_title("interleaved, oversampling N = 2: samples, and\n"
                   "the pixel that sample (2, 1) is the average over")
    save(figure, "pixels.svg")


def frames():
    roman = wfpsf.Instrument("roman-c9")
    figure, panels = plt.subplots(1, 2, figsize=(7.6, 3.7), sharey=True)
    images = []
    for frame, axes, title in zip((0, 1), panels,
                                  ("FRAME 0: science coordinates", "FRAME 1: exit pupil")):
        psf = wfpsf.PSF.in_band(roman, "F184", 18, 4087, 0, frame=frame)
        images.append(psf.draw(192, 192, oversampling=8).pixels.copy())
        shown, norm = logarithmic(images[-1], 4)
        picture = show(axes, shown, extent(24, SCALE), norm=norm, cmap="inferno")
        axes.set(title=title, xlabel="x, arcsec")
    panels[0].set_ylabel("y, arcsec")
    figure.colorbar(picture, ax=panels, label="in units of the peak")
    if np.abs(images[1] - images[0][::-1]).max() > 1e-6 * images[0].max():
        raise SystemExit("the frames are not each other's flip of y")
    save(figure, "frames.png")


def kernels():
    """What one charge becomes through taps without any symmetry."""
    taps = np.array([[0.001, 0.010, 0.002], [0.015, 0.0, 0.030], [0.003, 0.020, 0.004]])
    taps[1, 1] = 1 - taps.sum()
    kernel = wfpsf.IPCKernel.from_taps(taps)
    figure, panels = plt.subplots(1, 2, figsize=(6.6, 3.4), sharey=True)
    for form, axes, title in zip((0, 1), panels, ("IPC_FORM 0: scatter, a convolution",
                                                  "IPC_FORM 1: gather, a correlation")):
        response = kernel.self_test(ipc_form=form)
        show(axes, response, (-1.5, 1.5, -1.5, 1.5), cmap="Blues", vmin=0, vmax=0.04)
        for (j, i), value in np.ndenumerate(response):
            axes.text(i - 1, j - 1, f"{value:.3f}", ha="center", va="center",
                      color="w" if value > 0.025 else "k")
        axes.set(title=title, xlabel="dx, pixels", xticks=(-1, 0, 1), yticks=(-1, 0, 1))
    panels[0].set_ylabel("dy, pixels")
    save(figure, "kernels.svg")


def ellipticities():
    figure, panels = plt.subplots(1, 4, figsize=(8, 2.3), sharey=True)
    y, x = np.mgrid[0:61, 0:61] - 30.0
    for axes, (mxx, mxy, myy) in zip(panels, ((60, 0, 30), (30, 0, 60), (45, 15, 45),
                                              (45, -15, 45))):
        det = mxx * myy - mxy**2
        image = np.exp(-(myy * x**2 - 2 * mxy * x * y + mxx * y**2) / (2 * det))
        m = wfpsf.adaptive_moments(image)
        show(axes, image, (-30.5, 30.5, -30.5, 30.5), cmap="Greys")
        major = m.sigma * ((1 + m.e) / (1 - m.e)) ** 0.25
        minor = m.sigma**2 / major
        axes.add_patch(Ellipse((0, 0), 4 * major, 4 * minor, angle=np.degrees(m.beta), fill=False,
                               ec="r"))
        e1, e2 = (round(e, 3) + 0.0 for e in (m.e1, m.e2))
        axes.set_title(f"e1 = {e1:+.3f}, e2 = {e2:+.3f}\n"
                       f"beta = {np.degrees(m.beta):+.0f}°")
        axes.set_xlabel("x, pixels")
    panels[0].set_ylabel("y, pixels")
    save(figure, "ellipticities.png")


def focal_plane():
    """Roman's detectors on the sky, as one looks at it: north up, east to the left."""
    roman = wfpsf.Instrument("roman-c9")
    sky = wfpsf.Observation(roman, 0, 0, 0, pa_of_fpa=1)
    figure, axes = plt.subplots(figsize=(6.4, 4.3))
    last = 4087.5

    def place(sca, x, y):
        ra, dec = sky.pixel_to_sky(sca, np.asarray(x, float), np.asarray(y, float))
        return (ra + 180) % 360 - 180, dec

    for sca in range(1, 19):
        axes.plot(*place(sca, [-0.5, last, last, -0.5, -0.5], [-0.5, -0.5, last, last, -0.5]), "k-",
                  lw=0.8)
        (x0,), (y0,) = place(sca, [300], [300])
        for x, y, colour in ((1900, 300, "tab:red"), (300, 1900, "tab:blue")):
            (x1,), (y1,) = place(sca, [x], [y])
            axes.annotate("", (x1, y1), (x0, y0),
                          arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.5})
        (x,), (y,) = place(sca, [2600], [2400])
        axes.text(x, y, str(sca), ha="center", va="center")
    axes.plot([], [], c="tab:red", label="x of the detector")
    axes.plot([], [], c="tab:blue", label="y")
    axes.legend(loc="lower center", fontsize=8)
    axes.plot(0, 0, "g+", ms=10)
    axes.invert_xaxis()
    axes.set(aspect="equal", xlabel="RA, degrees (east to the left)", ylabel="Dec, degrees",
             title="roman-c9, focal plane at position angle 0")
    save(figure, "focal_plane.svg")


if __name__ == "__main__":
    for draw in (pixels, frames, kernels, ellipticities, focal_plane):
        draw()
