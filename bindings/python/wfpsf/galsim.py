# SPDX-License-Identifier: GPL-3.0-or-later
"""wfpsf's PSFs as GalSim objects, and as a type in GalSim's configuration files.

In place of ``galsim.roman.getPSF(SCA, "H158", wavelength=band)``:

    import wfpsf.galsim
    psf = wfpsf.galsim.getPSF(SCA, "H158", wavelength=band)

and in a configuration file, in place of ``type: RomanPSF``:

    modules:
        - galsim.roman
        - wfpsf.galsim
    psf:
        type: WfpsfPSF
        SCA: 7
        bandpass: H158

The object is the PSF before the pixel, like all of GalSim's: convolve it, shear it, put it through
a WCS, and draw with GalSim's pixel (``method="auto"``). In k space it is wfpsf's optical transfer
function itself, not an interpolated image of it. docs/galsim.md says what changes in the numbers.
"""
import collections
import functools

import galsim
import galsim.config
import numpy as np

from ._instrument import Instrument
from ._otf import OTF
from ._psf import PSF
from ._sed import SED

__all__ = ["WfpsfPSF", "getPSF"]

KEPT_MODELS = 16  # PSFs whose handles are kept
KEPT_GRIDS = 4  # k images of each
NEAR_ZERO = 0.02  # of the cut-off: where the OTF's slopes at zero are taken
FLAT_SED = ((1.0, 1e5), (1.0, 1.0))  # photons equally at all wavelengths

# What a PSF is made of: it can be compared, hashed and pickled, which handles cannot.
Recipe = collections.namedtuple("Recipe", "instrument band sca x y wavelength_nm sed eps options")


class _Model:
    """What wfpsf makes of a recipe."""

    def __init__(self, recipe):
        options = dict(recipe.options, eps=recipe.eps)
        blur = [options.pop(name, None) or 0.0
                for name in ("jitter_xx", "jitter_xy", "jitter_yy", "charge_diffusion")]
        sed = None if recipe.sed is None else SED(*recipe.sed)
        with Instrument(recipe.instrument) as instrument:
            with PSF.in_band(instrument, recipe.band, recipe.sca, recipe.x, recipe.y,
                             recipe.wavelength_nm, sed, **options) as psf:
                self.scale, self.peak = psf.pixel_scale_arcsec, psf.peak
                self.otf = OTF(psf, eps=recipe.eps)
        xx, xy, yy, diffusion = blur
        diffused = (diffusion * self.scale)**2
        self.blur = np.array([[xx + diffused, xy], [xy, yy + diffused]])
        self.cutoff = self.otf.cutoff
        self.slope, self.centroid = self._near_zero()
        self.grids = collections.OrderedDict()

    def _near_zero(self):
        """c of the OTF's fall, 1 - c |k|, about k = 0, and the centroid, arcsec."""
        k = NEAR_ZERO * self.cutoff
        angle = np.arange(16) * np.pi / 16
        values = self.values(k * np.cos(angle), k * np.sin(angle))
        return (np.mean(1 - np.abs(values)) / k,
                tuple(-np.angle(values[[0, 8]]) / (2 * np.pi * k)))

    def values(self, kx, ky):
        """Of the PSF of flux 1 without the pixel; cycles per arcsec."""
        values = self.otf(kx, ky, response="diffraction")
        if self.blur.any():
            (xx, xy), (_, yy) = self.blur
            values = values * np.exp(-2 * np.pi**2 * (xx * kx**2 + 2 * xy * kx * ky + yy * ky**2))
        return values

    def grid(self, bounds, step, jacobian):
        """The values on a k image; those of the last few are kept, so that stars at other places in
        their pixels cost no more than their FFT."""
        key = bounds, step, jacobian
        values = self.grids.get(key)
        if values is None:
            xmin, xmax, ymin, ymax = bounds
            kx, ky = np.meshgrid(step * np.arange(xmin, xmax + 1), step * np.arange(ymin, ymax + 1))
            if jacobian is not None:
                (a, b), (c, d) = jacobian
                kx, ky = a * kx + c * ky, b * kx + d * ky
            values = self.grids[key] = self.values(kx, ky)
            while len(self.grids) > KEPT_GRIDS:
                self.grids.popitem(last=False)
        return values


_model = functools.lru_cache(maxsize=KEPT_MODELS)(_Model)


class WfpsfPSF(galsim.GSObject):
    """A PSF of wfpsf, without the pixel response, as a GalSim object in arcsec.

    Parameters
    ----------
    SCA : int
        Detector, from 1.
    bandpass : str
        Name of a band, such as "H158".
    x, y : float
        Position on the detector, pixels, the first one's centre at (0, 0).
    wavelength : float, optional
        nm; 0: the band's effective wavelength.
    sed : (wavelengths, photons), optional
        Two sequences, nm and photons per nm up to a factor: the PSF of a source of these colours
        seen through the band.
    flux : float
    instrument : str
    eps : float
        Bound of the PSF's error, in units of its peak; stamps of 32 x 32 native pixels are good to
        4e-6 by default. 1e-5 takes 0.3 s for a PSF in place of 0.1 s.
    options
        Those of :class:`wfpsf.PSF` that are numbers, and ``zernikes``.
    gsparams : galsim.GSParams
        Its ``folding_threshold`` is the part of the light that may lie beyond half the period of
        GalSim's FFTs.

    It cannot be drawn by shooting photons, nor in real space.
    """

    _has_hard_edges = False
    _is_axisymmetric = False
    _is_analytic_x = False
    _is_analytic_k = True

    def __init__(self, SCA, bandpass, x, y, wavelength=0.0, sed=None, flux=1.0,
                 instrument="roman-c9", eps=1e-4, gsparams=None, **options):
        if sed is not None:
            sed = tuple(tuple(map(float, numbers)) for numbers in sed)
        if options.get("zernikes") is not None:
            options["zernikes"] = tuple(map(float, options["zernikes"]))
        self._recipe = Recipe(instrument, bandpass, int(SCA), float(x), float(y), float(wavelength),
                              sed, float(eps), tuple(sorted(options.items())))
        self._flux = float(flux)
        self._gsparams = galsim.GSParams.check(gsparams)
        self._model  # errors come now

    @property
    def _model(self):
        return _model(self._recipe)

    @property
    def _maxk(self):
        return 2 * np.pi * self._model.cutoff

    @property
    def _stepk(self):
        # Where the OTF falls like 1 - c |k|, all but c / (2 pi R) of the light is within R.
        return np.pi / (self._model.slope / (2 * np.pi * self.gsparams.folding_threshold))

    @property
    def _centroid(self):
        return galsim.PositionD(*self._model.centroid)

    @property
    def _max_sb(self):
        return abs(self._flux) * self._model.peak / self._model.scale**2

    def _kValue(self, kpos):
        return self._flux * complex(self._model.values(kpos.x / (2 * np.pi), kpos.y / (2 * np.pi)))

    def _drawKImage(self, image, jac=None):
        bounds = image.xmin, image.xmax, image.ymin, image.ymax
        jacobian = None if jac is None else tuple(map(tuple, np.asarray(jac).tolist()))
        values = self._model.grid(bounds, image.scale / (2 * np.pi), jacobian)
        np.multiply(values, self._flux, out=image.array, casting="same_kind")

    def _key(self):
        return self._recipe, self._flux, self._gsparams

    def __eq__(self, other):
        return self is other or (isinstance(other, WfpsfPSF) and self._key() == other._key())

    def __hash__(self):
        return hash(("wfpsf.galsim.WfpsfPSF",) + self._key())

    def __repr__(self):
        recipe = self._recipe
        options = "".join(", %s=%r" % option for option in recipe.options)
        return ("wfpsf.galsim.WfpsfPSF(%r, %r, %r, %r, wavelength=%r, sed=%r, flux=%r, "
                "instrument=%r, eps=%r, gsparams=%r%s)"
                % (recipe.sca, recipe.band, recipe.x, recipe.y, recipe.wavelength_nm, recipe.sed,
                   self._flux, recipe.instrument, recipe.eps, self._gsparams, options))

    def __str__(self):
        return "wfpsf.galsim.WfpsfPSF(%r, %r)" % (self._recipe.sca, self._recipe.band)


def _table(sed, instrument, band):
    """An SED of GalSim's or wfpsf's as a table over the band."""
    with Instrument(instrument) as figures:
        blue, red, _ = figures.band(band)
    wavelengths = np.linspace(blue, red, 1 + max(200, int(red - blue)))
    photons = sed.photon_density(wavelengths) if isinstance(sed, SED) else sed(wavelengths)
    return wavelengths, photons


def getPSF(SCA, bandpass, SCA_pos=None, wcs=None, wavelength=None, sed=None, extra_aberrations=None,
           gsparams=None, instrument="roman-c9", **options):
    """The PSF as ``galsim.roman.getPSF`` gives it, from wfpsf; the arguments are that function's.

    Parameters
    ----------
    SCA : int
    bandpass : str
    SCA_pos : galsim.PositionD, optional
        GalSim's image position on the detector, the first pixel's centre at (1, 1); None: the
        centre of the detector.
    wcs : galsim.BaseWCS, optional
        Turns the PSF from the detector's axes to those of the sky.
    wavelength : float or galsim.Bandpass, optional
        nm, or a bandpass whose effective wavelength is taken. None: the PSF of a source of many
        colours, an object for use with any source of the colours of ``sed``.
    sed : galsim.SED or wfpsf.SED, optional
        The source's photons; None: equally many at all wavelengths that the band passes.
    extra_aberrations : array, optional
        Waves rms at 1293 nm, element j for Noll's Z_j; elements 0 to 3 are not used.
    gsparams : galsim.GSParams, optional
    instrument : str
    options
        ``flux``, ``eps`` and the options of :class:`wfpsf.PSF`. ``frame=1, field_rule=1`` are the
        axes and the field interpolation of GalSim up to 2.8.4.
    """
    if SCA_pos is None:
        with Instrument(instrument) as figures:
            n_pix = figures.constant("n_pix").value
        x = y = (n_pix - 1) / 2
    else:
        x, y = SCA_pos.x - 1, SCA_pos.y - 1
    if extra_aberrations is not None:
        options["zernikes"] = [0.0, 0.0, 0.0, *extra_aberrations[4:]]  # no piston, tip and tilt
    if wavelength is None:
        table = FLAT_SED if sed is None else _table(sed, instrument, bandpass)
        psf = WfpsfPSF(SCA, bandpass, x, y, sed=table, instrument=instrument, gsparams=gsparams,
                       **options)
    elif sed is not None:
        raise TypeError("wavelength and sed: give one of them")
    else:
        psf = WfpsfPSF(SCA, bandpass, x, y, getattr(wavelength, "effective_wavelength", wavelength),
                       instrument=instrument, gsparams=gsparams, **options)
    if wcs is None:
        return psf
    position = galsim.PositionD(x + 1, y + 1)
    return wcs.toWorld(galsim.PixelScale(psf._model.scale).toImage(psf), image_pos=position)


REQUIRED = {"SCA": int, "bandpass": str}
OPTIONAL = {"wavelength": float, "use_SCA_pos": bool, "flux": float, "eps": float, "frame": int,
            "field_rule": int, "struts": int, "jitter_xx": float, "jitter_xy": float,
            "jitter_yy": float, "charge_diffusion": float, "instrument": str}


def _build(config, base, ignore, gsparams, logger):
    """The type WfpsfPSF of configuration files: RomanPSF's keys and the numbers of OPTIONAL.

    Like RomanPSF, SCA and bandpass come from the image when it states them, and there is one PSF
    for an image unless use_SCA_pos is true.
    """
    stated = {"SCA": base.get("SCA"), "bandpass": getattr(base.get("bandpass"), "name", None)}
    required = {key: kind for key, kind in REQUIRED.items() if stated[key] is None}
    optional = dict(OPTIONAL, **{key: kind for key, kind in REQUIRED.items()
                                 if key not in required})
    given, _ = galsim.config.GetAllParams(config, base, req=required, opt=optional,
                                          ignore=ignore + ["extra_aberrations"])
    for key in optional.keys() & REQUIRED.keys():
        given.setdefault(key, stated[key])
    if given.pop("use_SCA_pos", False):
        given["SCA_pos"] = base["image_pos"]
    else:
        config["index_key"] = "image_num"
    aberrations = galsim.config.ParseAberrations("extra_aberrations", config, base, "WfpsfPSF")
    psf = getPSF(wcs=base.get("wcs"), extra_aberrations=aberrations,
                 gsparams=galsim.GSParams(**gsparams) if gsparams else None, **given)
    return psf, False


galsim.config.RegisterObjectType("WfpsfPSF", _build)
