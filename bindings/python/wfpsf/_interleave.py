# SPDX-License-Identifier: GPL-3.0-or-later
"""Dithered images into one, and back."""
import numpy as np

from ._handle import pointers
from ._image import Image, as_image, writable, zeros
from ._library import lib
from ._names import choose, constants_of, numbers
from ._status import check

DITHERS = constants_of("WFPSF_DITHER_")


def _offsets(shape, dx, dy):
    dx, dy = numbers("dx", dx, 2), numbers("dy", dy, 2)
    if not shape == dx.shape == dy.shape:
        raise ValueError("images, dx and dy of shapes %s, %s and %s: must be one shape"
                         % (shape, dx.shape, dy.shape))
    return dx, dy


def interleave(images, dx, dy, out=None, convention="detector"):
    """Interleaves dithered images into one that is sampled finer, with the same pixel response
    (Kannawadi et al. 2016, Eqs. 26-29). Values are kept, so the flux grows n_x n_y times.

    Parameters
    ----------
    images : n_y lists of n_x images each
    dx, dy : arrays of shape (n_y, n_x)
        Offset of each image, native pixels.
    out : image of shape (n_y * ny, n_x * nx), optional
    convention : str
        "detector": the detector moved by (dx, dy), 0 <= dx < 1; "object": the object did,
        -1/2 < dx < 1/2.
    """
    rows = [[as_image(image) for image in row] for row in images]
    flat = [image for row in rows for image in row]
    if not flat or len(flat) != len(rows) * len(rows[0]):
        raise ValueError("images must hold lists of one length, with at least one image")
    dx, dy = _offsets((len(rows), len(rows[0])), dx, dy)
    ny, nx = flat[0].shape
    out = (zeros((len(rows) * ny, len(rows[0]) * nx), flat[0].dtype) if out is None
           else writable(out))
    check(lib.wfpsf_image_interleave(len(rows[0]), len(rows), pointers(Image._kind, flat),
                                     dx.ctypes.data, dy.ctypes.data,
                                     choose(DITHERS, "convention", convention), out))
    return out


def deinterleave(image, dx, dy, convention="detector"):
    """The inverse of :func:`interleave`: n_y lists of n_x images."""
    image = as_image(image)
    dx, dy = _offsets(np.shape(dx), dx, dy)
    if not dx.size:
        raise ValueError("dx is empty: must hold at least one offset")
    n_y, n_x = dx.shape
    ny, nx = image.shape
    flat = [zeros((ny // n_y, nx // n_x), image.dtype) for _ in range(n_x * n_y)]
    check(lib.wfpsf_image_deinterleave(image, n_x, n_y, dx.ctypes.data, dy.ctypes.data,
                                       choose(DITHERS, "convention", convention),
                                       pointers(Image._kind, flat)))
    return [flat[row * n_x:(row + 1) * n_x] for row in range(n_y)]
