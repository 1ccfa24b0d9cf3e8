# SPDX-License-Identifier: GPL-3.0-or-later
"""What the programs that draw the documentation's pictures share."""
import pathlib

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402
from PIL import Image  # noqa: E402

FOLDER = pathlib.Path(__file__).parent / "pictures"
LARGEST = 150_000  # bytes of a picture

plt.rcParams.update({"svg.hashsalt": "wfpsf", "font.size": 9, "axes.titlesize": 9,
                     "figure.dpi": 100, "figure.constrained_layout.use": True})


def save(figure, name):
    """Writes a picture, the same bytes for the same data, and tells its size."""
    path = FOLDER / name
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else {"Software": None},
                   bbox_inches="tight", pad_inches=0.05)
    plt.close(figure)
    if path.suffix == ".png":
        # 256 colours are enough and take a third of the bytes.
        picture = Image.open(path).convert("RGB").quantize(256, Image.Quantize.MAXCOVERAGE)
        picture.save(path, optimize=True)
    size = path.stat().st_size
    if size > LARGEST:
        raise SystemExit(f"{path}: {size} bytes: at most {LARGEST}")
    print(f"{name}: {size} bytes")


def extent(side_pix, scale):
    """Of an image of native pixels about its middle, arcsec."""
    half = side_pix * scale / 2
    return (-half, half, -half, half)


def show(axes, pixels, half_extent, **how):
    """An image with y upwards; what is not positive is as dark as the scale goes."""
    return axes.imshow(pixels, origin="lower", extent=half_extent, interpolation="nearest", **how)


def logarithmic(pixels, decades):
    """The pixels in units of their peak, and a scale of so many decades."""
    relative = pixels / pixels.max()
    return relative.clip(10.0**-decades), LogNorm(10.0**-decades, 1)
