# SPDX-License-Identifier: GPL-3.0-or-later
"""The PSF all over a detector."""
from . import _lib
from ._handle import Handle, Properties
from ._image import writable
from ._library import lib
from ._names import constants_of, integer, of_one_length, text
from ._options import chosen
from ._psf import PSF, PSF_OPTIONS, STAR_OPTIONS
from ._status import check


class VaryingPSF(Properties, Handle):
    """The PSF all over detector ``sca`` and some pixels around it: made once, then cheap at any
    place. Immutable: threads may share it.

    Of one colour (``wavelength_nm = 0``: the band's effective wavelength), or of the source of an
    SED seen through the band. The options are those of :class:`PSF`; ``eps`` is of any pixel at any
    place.

    Attributes: error_estimate, interpolation_error (the part of it that comes from the
    interpolation), degree (of the polynomials in each coordinate), rank (images that all PSFs are
    sums of), exact_psfs (that were made for it), memory_bytes, margin (pixels around the detector).
    """

    _kind = _lib.wfpsf_varying_psf_p
    _destroy = "wfpsf_varying_psf_destroy"
    _getter = "wfpsf_varying_psf_get"
    _properties = constants_of("WFPSF_VARYING_PSF_")

    def __init__(self, instrument, band, sca, wavelength_nm=0.0, sed=None, **options):
        with chosen(PSF_OPTIONS + ("threads",), options) as handle:
            self._make(lambda out: lib.wfpsf_varying_psf_create(
                instrument, text("band", band), integer("sca", sca, 32), wavelength_nm,
                sed, handle, out))

    def at(self, x, y):
        """The PSF at (x, y), pixels of the detector, the first one's centre at (0, 0)."""
        return PSF._made(lambda out: lib.wfpsf_varying_psf_at(self, x, y, out))

    def add_stars(self, image, x0, y0, x, y, flux, **options):
        """Adds stars as ``PSF.add_stars`` does, each with the PSF of its own place. (x0, y0) is
        where the centre of the image's first native pixel stands on the detector."""
        image = writable(image)
        x, y, flux = of_one_length(x=x, y=y, flux=flux)
        with chosen(STAR_OPTIONS, options) as handle:
            check(lib.wfpsf_varying_psf_add_stars(
                self, x0, y0, len(x), x.ctypes.data, y.ctypes.data, flux.ctypes.data,
                handle, image))
        return image
