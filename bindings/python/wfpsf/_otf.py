# SPDX-License-Identifier: GPL-3.0-or-later
"""PSFs in k space."""
import numpy as np

from . import _lib
from ._handle import Handle, Properties
from ._image import Image
from ._library import lib
from ._names import choose, constants_of
from ._options import chosen
from ._status import check

RESPONSES = constants_of("WFPSF_RESPONSE_")
ORDERS = constants_of("WFPSF_ORDER_")


class OTF(Properties, Handle):
    """The optical transfer function of a PSF: the Fourier transform of the star that ``draw``
    draws, one at k = 0, zero beyond the cut-off. Immutable: threads may share it. The PSF may be
    closed afterwards. Option: eps.

    Attributes: error_estimate (of a PSF made of it, in units of the PSF's peak, which ``eps``
    bounds), value_error (the largest of any value: near k = 0 and along struts), cutoff (of kx and
    ky, cycles per arcsec), pixels (across the pupil).

    >>> from wfpsf import PSF, Instrument
    >>> otf = OTF(PSF(Instrument(), 7, 1292.11, eps=1e-4), eps=1e-3)
    >>> complex(otf(0, 0))
    (1+0j)
    """

    _kind = _lib.wfpsf_otf_p
    _destroy = "wfpsf_otf_destroy"
    _getter = "wfpsf_otf_get"
    _properties = constants_of("WFPSF_OTF_")

    def __init__(self, psf, **options):
        with chosen(("eps",), options) as handle:
            self._make(lambda out: lib.wfpsf_otf_create(psf, handle, out))

    def __call__(self, kx, ky, response="effective"):
        """Complex numbers, integral of I(theta) exp(-2 pi i k.theta), at kx and ky in cycles per
        arcsec, two numbers or two arrays of one shape. ``response``: "effective" (with the native
        pixel, as in ``draw``) or "diffraction" (the telescope alone)."""
        x = np.array(kx, dtype=np.float64, order="C")
        y = np.array(ky, dtype=np.float64, order="C")
        if x.shape != y.shape:
            raise ValueError("kx and ky must have one shape, not %s and %s" % (x.shape, y.shape))
        re, im = np.empty_like(x), np.empty_like(x)
        check(lib.wfpsf_otf_values(self, choose(RESPONSES, "response", response), x.size,
                                   x.ctypes.data, y.ctypes.data, re.ctypes.data, im.ctypes.data))
        return (re + 1j * im)[()]

    def grid(self, nx, ny, step, response="effective", order="wrapped"):
        """An array of shape (ny, nx) of complex numbers, ``step`` cycles per arcsec between
        neighbours.

        ``order`` is "wrapped" (as ``numpy.fft.fft2`` gives them), "half" (as ``rfft2`` does, nx =
        N//2 + 1), or "centred" (k = 0 at element [ny//2, nx//2]). An image of N pixels of s arcsec
        a side takes ``step = 1 / (N * s)``.
        """
        values = np.zeros((ny, nx), np.complex128)
        with Image(values.real) as re, Image(values.imag) as im:
            check(lib.wfpsf_otf_grid(self, choose(RESPONSES, "response", response),
                                     choose(ORDERS, "order", order), step, re, im))
        return values
