# SPDX-License-Identifier: GPL-3.0-or-later
"""Effective PSFs: the diffraction image of a star, averaged over the native pixel."""
import collections
import ctypes

import numpy as np

from . import _lib
from ._handle import Handle, Properties, pointers
from ._image import as_image, writable, zeros
from ._library import lib
from ._names import constants_of, integer, of_one_length, text
from ._options import chosen
from ._status import check

PSF_OPTIONS = ("eps", "struts", "psf_radius", "piston_tilt", "frame", "field_rule", "jitter_xx",
               "jitter_xy", "jitter_yy", "charge_diffusion", "mask_points", "pixel_response",
               "zernikes", "opd", "memory_limit", "progress")
STAR_OPTIONS = ("threads", "force")
DRAW_OPTIONS = ("memory_limit", "progress")

Memory = collections.namedtuple("Memory", "least most")


class PSF(Properties, Handle):
    """The effective PSF at the centre of detector ``sca`` at one wavelength, for an instrument with
    one pupil. Others: :meth:`in_band`, :meth:`from_mask`, :func:`psfs`. Immutable: threads may
    share it. The instrument may be closed afterwards.

    Parameters
    ----------
    instrument : Instrument
    sca : int
        Detector, from 1.
    wavelength_nm : float
    eps : float, optional
        Largest error of any pixel, in units of the stamp's peak.
    struts, psf_radius, piston_tilt : optional
        With struts (1) or without (0); native pixels made in advance; keep the instrument's Zernike
        terms 1 to 3.
    zernikes : array, optional
        Extra aberrations in Noll's order from j = 1, waves rms at the instrument's reference
        wavelength.
    opd : (image, scale_m, axis_x, axis_y), optional
        An image of optical path differences in metres, ``scale_m`` metres from sample to sample,
        with the optical axis at sample (axis_x, axis_y), the first one's centre being (0, 0).
    jitter_xx, jitter_xy, jitter_yy : float, optional
        Covariance of the telescope's jitter, arcsec^2.
    charge_diffusion : float, optional
        Standard deviation of the detector's, native pixels.
    pixel_response : int, optional
        0 leaves out the average over the native pixel.
    progress : callable, optional
        Called now and then by long work with the part that is done, 0 to 1: if it returns False,
        the work stops with a WfpsfError of status ERROR_CANCELLED; if it raises, with that
        exception.

    Attributes: wavelength_nm (of many, the mean by photons detected), pixel_scale_arcsec,
    error_estimate (numerical error of any pixel, in units of the peak), model_error (of the pupil's
    geometry against the published mask, same units), peak (largest fraction of the light in one
    native pixel), nodes, grid_size, grid_step_arcsec, radius (native pixels), lit_area_m2,
    wavelengths (how many the PSF is a sum over).

    >>> from wfpsf import Instrument
    >>> psf = PSF(Instrument("wfirst-afta-c5"), 7, 1292.11, eps=1e-5)
    >>> stamp = psf.draw(32, 32, flux=1000)
    >>> stamp.pixels.shape, stamp.record.applied
    ((32, 32), ('pixel_response',))
    """

    _kind = _lib.wfpsf_psf_p
    _destroy = "wfpsf_psf_destroy"
    _getter = "wfpsf_psf_get"
    _properties = constants_of("WFPSF_PSF_")

    def __init__(self, instrument, sca, wavelength_nm, **options):
        with chosen(PSF_OPTIONS, options) as handle:
            self._make(lambda out: lib.wfpsf_psf_create(
                instrument, integer("sca", sca, 32), wavelength_nm, handle, out))

    @classmethod
    def in_band(cls, instrument, band, sca, x, y, wavelength_nm=0.0, sed=None, **options):
        """The PSF at (x, y), pixels of the detector (the first one's centre is (0, 0)), with the
        pupil that the band is used with; "roman-c9" needs it.

        ``wavelength_nm = 0`` is the band's effective wavelength. With a ``sed`` it is the PSF of a
        source of many colours, seen through the band: the sum of monochromatic ones over the
        photons detected, an :class:`SED` times the band's throughput, at as many wavelengths as
        ``eps`` needs; :func:`psfs` makes those of several SEDs.

        Further options: ``frame`` (0: science coordinates, 1: exit pupil) and ``field_rule`` (0:
        all field points are met, 1: bilinear between the corners).
        """
        if sed is not None:
            if wavelength_nm:
                raise TypeError("wavelength_nm and sed: give one of them")
            return psfs(instrument, band, sca, x, y, [sed], **options)[0]
        with chosen(PSF_OPTIONS, options) as handle:
            return cls._made(lambda out: lib.wfpsf_psf_create_in_band(
                instrument, text("band", band), integer("sca", sca, 32), x, y,
                wavelength_nm, handle, out))

    @classmethod
    def from_mask(cls, instrument, sca, wavelength_nm, mask, *, scale_m, axis_x, axis_y, **options):
        """The PSF of a pupil that is an image of transmissions with pixels of ``scale_m`` metres
        and the optical axis at (axis_x, axis_y), the centre of the mask's first pixel being (0, 0).
        It takes a second for a mask of 4096 x 4096."""
        mask = as_image(mask)
        with chosen(PSF_OPTIONS, options) as handle:
            return cls._made(lambda out: lib.wfpsf_psf_create_from_mask(
                instrument, mask, scale_m, axis_x, axis_y,
                integer("sca", sca, 32), wavelength_nm, handle, out))

    def draw_into(self, image, x, y, flux=1.0, **options):
        """Draws one star, overwriting the image, and returns it.

        (x, y), in pixels of the image, is where the optical axis falls, not the centroid; the
        centre of the first pixel is (0, 0). Each pixel gets ``flux / N^2`` times the fraction of
        the light that a native pixel centred there receives, N the image's oversampling: the sum
        over an infinite image is the flux at any N. The record becomes the PSF's pixel scale, with
        the pixel response applied.

        The image may be of any size. Beyond the PSF's ``radius`` its light is drawn from the
        diffraction image anew, with nothing folded back, in a time that goes with the area and in
        no more memory than the option ``memory_limit``; ``progress`` is called meanwhile.
        """
        image = writable(image)
        with chosen(DRAW_OPTIONS, options) as handle:
            check(lib.wfpsf_psf_draw(self, x, y, flux, handle, image))
        return image

    def draw(self, nx, ny, x=None, y=None, flux=1.0, oversampling=1, dtype=np.float64, **options):
        """The same into a new image of shape (ny, nx), by default at its centre."""
        image = zeros((ny, nx), dtype, oversampling=oversampling)
        return self.draw_into(image, (nx - 1) / 2 if x is None else x,
                              (ny - 1) / 2 if y is None else y, flux, **options)

    def add_bright_star(self, image, x, y, flux=1.0, **options):
        """Adds a star to what the image holds, on all of its pixels: for stars whose spikes are
        seen far from them. Otherwise as ``draw_into``; ``force`` as in ``add_stars``."""
        image = writable(image)
        with chosen(DRAW_OPTIONS + ("force",), options) as handle:
            check(lib.wfpsf_psf_add_bright_star(self, x, y, flux, handle, image))
        return image

    def draw_memory(self, image, x, y):
        """The bytes that drawing a star at (x, y) into the image would take: (least, most), without
        which it cannot be done and with which it is done in one go."""
        image, least, most = as_image(image), ctypes.c_int64(), ctypes.c_int64()
        check(lib.wfpsf_psf_draw_memory(self, x, y, image, least, most))
        return Memory(least.value, most.value)

    def add_stars(self, image, x, y, flux, **options):
        """Adds stars at the positions x, y with the given fluxes, three arrays of one length, to
        the image, and returns it.

        Each is added with the light that falls within the PSF's ``radius`` (native pixels) of it
        along both axes, clipped at the image's borders. (x, y) are pixels of the image, the centre
        of the first one being (0, 0). Options: threads, which changes no bit of the result; force,
        without which an image that has been through IPC is refused.
        """
        image = writable(image)
        x, y, flux = of_one_length(x=x, y=y, flux=flux)
        with chosen(STAR_OPTIONS, options) as handle:
            check(lib.wfpsf_psf_add_stars(self, len(x), x.ctypes.data, y.ctypes.data,
                                          flux.ctypes.data, handle, image))
        return image

    def convolve_into(self, image, galaxy, x, y, flux=1.0, **options):
        """Draws an extended source, overwriting the image, and returns it.

        ``galaxy`` is an image of the flux of each sample, its oversampling a multiple of the
        image's. The result is what ``draw_into`` gives for a star at every sample, added up;
        nothing wraps around. The centre of ``galaxy`` falls on (x, y), pixels of the image, the
        centre of the first one being (0, 0). ``flux`` multiplies the samples. A galaxy that holds
        the pixel response or IPC already is refused unless the option ``force`` is set.
        """
        image, galaxy = writable(image), as_image(galaxy)
        with chosen(("force",), options) as handle:
            check(lib.wfpsf_psf_convolve(self, galaxy, x, y, flux, handle,
                                         image))
        return image


def psfs(instrument, band, sca, x, y, seds, **options):
    """A list of the PSFs of several SEDs, which share their monochromatic images: many cost little
    more than one. Arguments as for ``PSF.in_band``."""
    seds = list(seds)
    with chosen(PSF_OPTIONS, options) as handle:
        out = (PSF._kind * len(seds))()
        status = lib.wfpsf_psf_create_chromatic(
            instrument, text("band", band), integer("sca", sca, 32), x, y, len(seds),
            pointers(_lib.wfpsf_sed_p, seds), handle, out)
        made = [PSF._of(pointer) for pointer in out if pointer]
        check(status)
    return made
