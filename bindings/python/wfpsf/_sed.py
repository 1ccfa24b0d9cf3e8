# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectral energy distributions."""
import numpy as np

from . import _lib
from ._handle import Handle
from ._library import lib
from ._names import choose, constants_of, of_one_length
from ._status import check

SED_UNITS = constants_of("WFPSF_SED_")


class SED(Handle):
    """How a source's light is spread over wavelength, up to a factor. Immutable: threads may share
    it.

    Parameters
    ----------
    wavelength_nm, density : arrays of one length
        Linear between the samples, at rising wavelengths; a PSF can be made of it in bands that the
        table covers.
    unit : str
        What the density counts per unit of wavelength: "photons" (f_photon) or "energy" (f_lambda).

    >>> SED.power_law(1.0, unit="photons").photon_density([1000, 2000]).tolist()
    [1.0, 2.0]
    """

    _kind = _lib.wfpsf_sed_p
    _destroy = "wfpsf_sed_destroy"

    def __init__(self, wavelength_nm, density, unit="photons"):
        wavelengths, values = of_one_length(wavelength_nm=wavelength_nm, density=density)
        self._make(lambda out: lib.wfpsf_sed_create_table(
            choose(SED_UNITS, "unit", unit), len(values), wavelengths.ctypes.data,
            values.ctypes.data, out))

    @classmethod
    def power_law(cls, exponent, unit="photons"):
        """A density proportional to wavelength^exponent. Flat in f_lambda: ``power_law(0,
        "energy")``; flat in f_nu, an AB source: ``power_law(-2, "energy")``."""
        return cls._made(lambda out: lib.wfpsf_sed_create_power_law(
            choose(SED_UNITS, "unit", unit), exponent, out))

    @classmethod
    def black_body(cls, temperature_k):
        """A black body, kelvin."""
        return cls._made(lambda out: lib.wfpsf_sed_create_black_body(temperature_k, out))

    def redshifted(self, redshift):
        """Another SED, its wavelengths 1 + redshift times as long."""
        return self._made(lambda out: lib.wfpsf_sed_create_redshifted(self, redshift, out))

    def photon_density(self, wavelength_nm):
        """Photons per unit of wavelength at one wavelength or at each of an array, nm, up to a
        factor that is the same for all wavelengths."""
        wavelengths = np.array(wavelength_nm, dtype=np.float64, order="C")
        photons = np.empty_like(wavelengths)
        check(lib.wfpsf_sed_photon_density(self, photons.size, wavelengths.ctypes.data,
                                           photons.ctypes.data))
        return photons[()]
