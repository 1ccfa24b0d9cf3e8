# SPDX-License-Identifier: GPL-3.0-or-later
"""Observations: where a telescope's detectors are on the sky, and where it may point."""
import collections
import ctypes

import numpy as np

from . import _lib
from ._handle import Handle, text_from
from ._library import lib
from ._names import constants_of, integer
from ._options import chosen
from ._status import check

KEYS = constants_of("WFPSF_OBSERVATION_")
OBSERVATION_OPTIONS = ("wcs_rule", "pa_of_fpa")

Pixel = collections.namedtuple("Pixel", "x y")
Sky = collections.namedtuple("Sky", "ra_deg dec_deg")
Found = collections.namedtuple("Found", "sca x y")
Bounds = collections.namedtuple("Bounds", "x_first x_last y_first y_last")
Jacobian = collections.namedtuple("Jacobian", "jacobian pixel_area y_angle_deg")


def _pair(a, b):
    """Two arrays of doubles in one shape."""
    return [np.array(values, dtype=np.float64, order="C") for values in np.broadcast_arrays(a, b)]


class Observation(Handle):
    """A telescope that points somewhere, and where its detectors then are on the sky. Immutable:
    threads may share it.

    Degrees; RA and Dec in the ICRS; position angles east of north, ``pa_deg`` that of the
    observatory's +Y axis. The centre of a detector's first pixel is (0, 0). Options: wcs_rule (1: as
    GalSim has it), pa_of_fpa (1: ``pa_deg`` is the focal plane's).

    Positions are numbers or arrays; those that have no answer, such as more than 8192 pixels off a
    detector, give NaN.

    >>> from wfpsf import Instrument
    >>> observation = Observation(Instrument("roman-c9"), 60, -30, 30)
    >>> observation.find_sca(59.9, -30.0).sca.tolist()
    1
    """

    _kind = _lib.wfpsf_observation_p
    _destroy = "wfpsf_observation_destroy"

    def __init__(self, instrument, ra_deg, dec_deg, pa_deg, **options):
        with chosen(OBSERVATION_OPTIONS, options) as handle:
            self._make(lambda out: lib.wfpsf_observation_create(
                instrument, ra_deg, dec_deg, pa_deg, handle, out))

    @classmethod
    def on_date(cls, instrument, ra_deg, dec_deg, julian_date, **options):
        """With the best roll of a date (UTC)."""
        with chosen(OBSERVATION_OPTIONS, options) as handle:
            return cls._made(lambda out: lib.wfpsf_observation_create_on_date(
                instrument, ra_deg, dec_deg, julian_date, handle, out))

    @classmethod
    def aimed(cls, instrument, sca, x, y, ra_deg, dec_deg, pa_deg, **options):
        """That which has pixel (x, y) of a detector at a place on the sky."""
        with chosen(OBSERVATION_OPTIONS, options) as handle:
            return cls._made(lambda out: lib.wfpsf_observation_create_aimed(
                instrument, integer("sca", sca, 32), x, y, ra_deg, dec_deg, pa_deg, handle, out))

    def properties(self, sca):
        """Pointing, position angles and FITS keywords of a detector: a dict such as
        {"crval1": ...}."""
        value, found = ctypes.c_double(), {}
        for name, key in KEYS.items():
            check(lib.wfpsf_observation_get(self, integer("sca", sca, 32), key, value))
            found[name] = value.value
        return found

    def _convert(self, convert, sca, first, second):
        first, second = _pair(first, second)
        check(convert(self, integer("sca", sca, 32), first.size, first.ctypes.data,
                      second.ctypes.data, first.ctypes.data, second.ctypes.data, None))
        return first[()], second[()]

    def sky_to_pixel(self, sca, ra_deg, dec_deg):
        """(x, y) on one detector, on it or not."""
        return Pixel(*self._convert(lib.wfpsf_observation_sky_to_pixel, sca, ra_deg, dec_deg))

    def pixel_to_sky(self, sca, x, y):
        """(ra_deg, dec_deg) of pixels of a detector."""
        return Sky(*self._convert(lib.wfpsf_observation_pixel_to_sky, sca, x, y))

    def find_sca(self, ra_deg, dec_deg, with_gaps=False):
        """(sca, x, y): the detector that each position falls on, 0 if on none, and where;
        ``with_gaps`` counts a detector's halves of the gaps around it as its own."""
        ra, dec = _pair(ra_deg, dec_deg)
        sca, x, y = np.empty(ra.shape, dtype=np.int32), np.empty_like(ra), np.empty_like(ra)
        check(lib.wfpsf_observation_find_sca(self, bool(with_gaps), ra.size, ra.ctypes.data,
                                             dec.ctypes.data, sca.ctypes.data, x.ctypes.data,
                                             y.ctypes.data, None))
        return Found(sca[()], x[()], y[()])

    def bounds(self, sca, with_gaps=False):
        """(x_first, x_last, y_first, y_last) of a detector's pixels."""
        ends = [ctypes.c_int64() for _ in range(4)]
        check(lib.wfpsf_observation_bounds(self, integer("sca", sca, 32), bool(with_gaps), *ends))
        return Bounds(*(end.value for end in ends))

    def jacobian(self, sca, x, y):
        """(jacobian, pixel_area, y_angle_deg): [[east_x, east_y], [north_x, north_y]] in arcsec per
        pixel, arcsec^2, and the position angle of the y axis."""
        x, y = _pair(x, y)
        matrix, area, angle = np.empty(x.shape + (2, 2)), np.empty_like(x), np.empty_like(x)
        check(lib.wfpsf_observation_jacobian(self, integer("sca", sca, 32), x.size, x.ctypes.data,
                                             y.ctypes.data, matrix.ctypes.data, area.ctypes.data,
                                             angle.ctypes.data, None))
        return Jacobian(matrix, area[()], angle[()])

    def fits_header(self, sca):
        """The WCS keywords of a detector's FITS image: a list of cards of 80 characters."""
        sca = integer("sca", sca, 32)
        text = text_from(lambda *to: lib.wfpsf_observation_fits_header(self, sca, *to))
        return [text[i:i + 80] for i in range(0, len(text), 80)]


def julian_date(year, month, day, hour=0, minute=0, second=0.0):
    """The Julian date of a UTC date.

    >>> julian_date(2000, 1, 1, 12)
    2451545.0
    """
    date = ctypes.c_double()
    whole = [integer("date", value, 32) for value in (year, month, day, hour, minute)]
    check(lib.wfpsf_julian_date(*whole, second, date))
    return date.value


def sun_position(julian_date, **options):
    """(ra_deg, dec_deg) of the Sun from the Earth, ICRS. Option: wcs_rule."""
    ra, dec = ctypes.c_double(), ctypes.c_double()
    with chosen(("wcs_rule",), options) as handle:
        check(lib.wfpsf_sun_position(julian_date, handle, ra, dec))
    return Sky(ra.value, dec.value)
