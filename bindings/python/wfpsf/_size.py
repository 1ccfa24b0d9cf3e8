# SPDX-License-Identifier: GPL-3.0-or-later
"""Sizes by the light in circles. All lengths are in pixels of the image, the centre of the first
one being (0, 0)."""
import collections
import ctypes

import numpy as np

from ._image import as_image
from ._library import lib
from ._names import choose, constants_of, numbers
from ._options import chosen
from ._status import check

SIZE_METHODS = constants_of("WFPSF_SIZE_")
SIZE_OPTIONS = ("size_total_flux", "size_bandwidth", "size_eps")

Energy = collections.namedtuple("Energy", "fraction error")
Radius = collections.namedtuple("Radius", "radius error")
Derivative = collections.namedtuple("Derivative", "derivative error")
Profile = collections.namedtuple("Profile", "profile errors")
Width = collections.namedtuple("Width", "fwhm error")


def encircled_energy(image, x, y, radius, **options):
    """(fraction, error): fraction of the light inside a circle, which must lie inside the image, by
    the integral of the band-limited image, and an estimate of its error.

    Options: size_total_flux (what counts as 100%; by default the sum of all pixels), size_bandwidth
    (highest frequency in the image, cycles per pixel of the image) and size_eps (the error asked
    for).
    """
    image, fraction, error = as_image(image), ctypes.c_double(), ctypes.c_double()
    with chosen(SIZE_OPTIONS, options) as handle:
        check(lib.wfpsf_size_encircled_energy(image, x, y, radius, handle, fraction, error))
    return Energy(fraction.value, error.value)


def ee_radius(image, x, y, fraction=0.5, method="bandlimited", **options):
    """(radius, error): radius of the circle about (x, y) that holds a fraction of the light, by
    default the half-light radius, and an estimate of its error.

    ``method``: "bandlimited" (the band-limited image integrated over the disc), "pixel_sum" (pixels
    whose centre lies in the circle; Kannawadi et al. 2016, Eq. 25) or "pixel_interpolated"
    (GalSim's calculateHLR); the last two have NaN for an error. Options as for
    :func:`encircled_energy`.
    """
    image, radius, error = as_image(image), ctypes.c_double(), ctypes.c_double()
    with chosen(SIZE_OPTIONS, options) as handle:
        check(lib.wfpsf_size_ee_radius(image, x, y, fraction,
                                       choose(SIZE_METHODS, "method", method), handle, radius,
                                       error))
    return Radius(radius.value, error.value)


def ee_radius_derivative(image, change, x, y, fraction=0.5, second=None, **options):
    """(derivative, error): derivative of :func:`ee_radius`, of the band-limited image, as
    ``image + t * change`` departs from t = 0, and an estimate of its error. With ``second``, another
    change, the mixed second derivative. Options as for :func:`encircled_energy`."""
    image, change = as_image(image), as_image(change)
    second = None if second is None else as_image(second)
    derivative, error = ctypes.c_double(), ctypes.c_double()
    with chosen(SIZE_OPTIONS, options) as handle:
        check(lib.wfpsf_size_ee_radius_derivative(image, change, second, x, y, fraction, handle,
                                                  derivative, error))
    return Derivative(derivative.value, error.value)


def fwhm(image, x, y):
    """Full width at half maximum about (x, y) from pixels sorted by distance, as GalSim's
    calculateFWHM."""
    image, width = as_image(image), ctypes.c_double()
    check(lib.wfpsf_size_fwhm(image, x, y, width))
    return width.value


def radial_profile(image, x, y, radii, **options):
    """(profile, errors): means of the band-limited image on circles about (x, y), and estimates of
    their errors, arrays. Options: size_bandwidth, size_eps."""
    image, radii = as_image(image), numbers("radii", radii)
    profile, errors = np.empty_like(radii), np.empty_like(radii)
    with chosen(SIZE_OPTIONS, options) as handle:
        check(lib.wfpsf_size_profile(image, x, y, len(radii), radii.ctypes.data, handle,
                                     profile.ctypes.data, errors.ctypes.data))
    return Profile(profile, errors)


def profile_fwhm(image, x, y, **options):
    """(fwhm, error): full width at half maximum of the :func:`radial_profile` about (x, y), and an
    estimate of its error."""
    image, width, error = as_image(image), ctypes.c_double(), ctypes.c_double()
    with chosen(SIZE_OPTIONS, options) as handle:
        check(lib.wfpsf_size_profile_fwhm(image, x, y, handle, width, error))
    return Width(width.value, error.value)
