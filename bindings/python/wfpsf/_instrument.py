# SPDX-License-Identifier: GPL-3.0-or-later
"""Telescopes and their detectors."""
import collections
import ctypes

import numpy as np

from . import _lib
from ._design import Design
from ._handle import Handle
from ._image import zeros
from ._library import lib
from ._names import choose, constants_of, integer, text
from ._options import chosen
from ._status import check

BAND_RULES = constants_of("WFPSF_BAND_")

Quantity = collections.namedtuple("Quantity", "value unit")
Band = collections.namedtuple("Band", "blue_nm red_nm effective_nm")
Allowed = collections.namedtuple("Allowed", "allowed sun_angle_deg")
Pupil = collections.namedtuple("Pupil", "mask scale_m axis_x axis_y")


class Instrument(Handle):
    """The figures of a telescope and its detectors: published ones by name, "wfirst-afta-c5" (the
    paper's) or "roman-c9", or those of a :class:`Design`. Immutable: threads may share it.

    >>> with Instrument("roman-c9") as roman:
    ...     roman.constant("pixel_scale")
    Quantity(value=0.11, unit='arcsec/pixel')
    """

    _kind = _lib.wfpsf_instrument_p
    _destroy = "wfpsf_instrument_destroy"

    def __init__(self, source="wfirst-afta-c5"):
        if isinstance(source, Design):
            self._make(lambda out: lib.wfpsf_instrument_create_from_design(source, out))
        else:
            self._make(lambda out: lib.wfpsf_instrument_create(text("instrument", source), out))

    def constant(self, name):
        """(value, unit) of a constant, such as "diameter" or "pixel_scale"."""
        value, unit = ctypes.c_double(), ctypes.c_char_p()
        check(lib.wfpsf_instrument_constant(self, text("name", name), value, unit))
        return Quantity(value.value, unit.value.decode())

    def _names(self, name_of):
        found = []
        while True:
            name = name_of(self, len(found))
            if name is None:
                return found
            found.append(name.decode())

    @property
    def constants(self):
        """Names of the constants."""
        return self._names(lib.wfpsf_instrument_constant_name)

    @property
    def bands(self):
        """Names of the bands, in order of wavelength."""
        return self._names(lib.wfpsf_instrument_band_name)

    def band(self, name, rule="tabulated"):
        """(blue_nm, red_nm, effective_nm): limits and throughput-weighted mean wavelength of a
        band, from the tabulated throughput, or by the rule "paper" from the same table thinned as
        for Table 1 of Kannawadi et al. (2016)."""
        blue, red, effective = ctypes.c_double(), ctypes.c_double(), ctypes.c_double()
        check(lib.wfpsf_instrument_band(self, text("band", name),
                                        choose(BAND_RULES, "rule", rule), blue, red, effective))
        return Band(blue.value, red.value, effective.value)

    def throughput(self, band, wavelength_nm):
        """Throughput of a band at one wavelength or at each of an array, nm; linear between
        tabulated points, zero outside."""
        wavelengths = np.array(wavelength_nm, dtype=np.float64, order="C")
        values = np.empty_like(wavelengths)
        check(lib.wfpsf_instrument_throughput(self, text("band", band), values.size,
                                              wavelengths.ctypes.data, values.ctypes.data))
        return values[()]

    def zernikes(self, sca):
        """Aberrations at the centre of detector ``sca`` in Noll's order, element j - 1 being the
        coefficient of Z_j; waves rms over the full circle at the constant "zemax_wavelength"."""
        count, sca = ctypes.c_int64(), integer("sca", sca, 32)
        check(lib.wfpsf_instrument_zernikes(self, sca, 0, None, count))
        coefficients = np.empty(count.value)
        check(lib.wfpsf_instrument_zernikes(self, sca, coefficients.size,
                                            coefficients.ctypes.data, None))
        return coefficients

    def pupil(self, band, sca, nx, ny, **options):
        """The pupil that detector ``sca`` sees through a band, drawn in the middle of an image:
        (mask, scale_m, axis_x, axis_y).

        Each pixel of ``mask`` is the lit fraction of its area; ``scale_m`` is its side in metres;
        (axis_x, axis_y) is the optical axis, the centre of the first pixel being (0, 0). All four
        are what ``PSF.from_mask`` takes. Option: struts.
        """
        mask = zeros((ny, nx))
        scale, axis_x, axis_y = ctypes.c_double(), ctypes.c_double(), ctypes.c_double()
        with chosen(("struts",), options) as handle:
            check(lib.wfpsf_instrument_pupil(self, text("band", band),
                                             integer("sca", sca, 32), handle, mask, scale,
                                             axis_x, axis_y))
        return Pupil(mask, scale.value, axis_x.value, axis_y.value)

    def pointing_allowed(self, ra_deg, dec_deg, julian_date, **options):
        """(allowed, sun_angle_deg): whether the Sun lets the telescope point there. Option:
        wcs_rule."""
        angle, allowed = ctypes.c_double(), ctypes.c_int32()
        with chosen(("wcs_rule",), options) as handle:
            check(lib.wfpsf_pointing_allowed(self, ra_deg, dec_deg, julian_date, handle, angle,
                                             allowed))
        return Allowed(allowed.value == 1, angle.value)

    def best_pa(self, ra_deg, dec_deg, julian_date, **options):
        """Position angle of the observatory's +Y axis at the best roll, degrees east of north.
        Option: wcs_rule."""
        angle = ctypes.c_double()
        with chosen(("wcs_rule",), options) as handle:
            check(lib.wfpsf_pointing_best_pa(self, ra_deg, dec_deg, julian_date, handle, angle))
        return angle.value

    def sky_level(self, band, longitude, latitude):
        """Zodiacal light in e-/s/arcsec^2 at ecliptic coordinates in degrees, the longitude from
        the Sun."""
        level = ctypes.c_double()
        check(lib.wfpsf_sky_level(self, text("band", band), longitude, latitude, level))
        return level.value

    def sky_background(self, band, longitude, latitude, *, exposure_time, pixel_area):
        """Zodiacal, stray and thermal background of a pixel (area in arcsec^2) in an exposure (s),
        electrons."""
        electrons = ctypes.c_double()
        check(lib.wfpsf_sky_background(self, text("band", band), longitude, latitude,
                                       exposure_time, pixel_area, electrons))
        return electrons.value

    def ab_zero_rate(self, band):
        """Electrons a second that a source of AB magnitude 0 gives in a band, e-/s."""
        rate = ctypes.c_double()
        check(lib.wfpsf_instrument_ab_zero_rate(self, text("band", band), rate))
        return rate.value
