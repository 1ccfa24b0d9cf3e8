# SPDX-License-Identifier: GPL-3.0-or-later
"""Moments of images, their noise and their derivatives."""
import collections
import contextlib
import ctypes
import math

import numpy as np

from . import _lib
from ._handle import Handle
from ._image import as_image, zeros
from ._library import lib
from ._names import address, choose, constants_of, numbers
from ._options import chosen
from ._status import check

MOMENTS = constants_of("WFPSF_MOMENTS_")
MOMENTS_OPTIONS = ("moments_tolerance", "moments_max_passes", "moments_guess_x", "moments_guess_y",
                   "moments_guess_sigma", "moments_method", "moments_background",
                   "moments_variance", "moments_restart", "moments_covariance_order")

Moments = collections.namedtuple("Moments", ("status",) + tuple(MOMENTS))
Moments.__doc__ = """Moments of an image.

Lengths are in pixels of the image; the centroid counts from the centre of the first pixel at
(0, 0). What does not apply is NaN.

status : how the measurement ended; 0: well
centroid_x, centroid_y
mxx, mxy, myy : second moments, the matrix M
sigma : det(M)^(1/4); sigma_trace : sqrt(mxx + myy)
e1, e2 : (mxx - myy, 2 mxy) / (mxx + myy); e : |e|
beta : position angle of the major axis from x towards y, radians
flux : of the best-fit Gaussian; of the pixels for unweighted moments
rho4 : weighted fourth moment, 2 for a Gaussian
passes : over the image
error_estimate : whitened error of centroid and moments
residual : norm of the gradient at the end, whitened
curvature : smallest eigenvalue of minus the Hessian, whitened; 1/8 for a Gaussian
edge_fraction : fraction of the weight that falls outside the image
missing_fraction : fraction of the squared weight that falls on missing pixels
amplitude : central value of the best-fit Gaussian
last_step : length of the last step, whitened
pixels : visited, all passes together
"""


class _Result(Handle):
    _kind = _lib.wfpsf_moments_p
    _destroy = "wfpsf_moments_destroy"

    def __init__(self, measure, strict):
        """Runs ``measure(out)``, which makes a result in most cases of failure too."""
        out = self._kind()
        self.status = measure(ctypes.byref(out))
        if not out:
            check(self.status)
        self._own(out)
        if strict:
            try:
                check(self.status)
            except BaseException:
                self.close()
                raise

    def read(self):
        value, pointer = ctypes.c_double(), self._as_parameter_
        out, found = ctypes.byref(value), [self.status]
        for key in MOMENTS.values():
            check(lib.wfpsf_moments_get(pointer, key, out))
            found.append(value.value)
        return Moments._make(found)


def _copied(measure, strict):
    with _Result(measure, strict) as result:
        return result.read()


@contextlib.contextmanager
def _adaptive(image, missing, variance, strict, options):
    missing = None if missing is None else as_image(missing)
    variance = None if variance is None else as_image(variance)
    with chosen(MOMENTS_OPTIONS, options) as handle:
        result = _Result(lambda out: lib.wfpsf_moments_measure_masked(
            image, missing, variance, handle, out), strict)
    with result:
        yield result


def adaptive_moments(image, missing=None, variance=None, strict=True, **options):
    """:class:`Moments` of the best-fit elliptical Gaussian.

    Centroid x0 and matrix M such that, with the weight w = exp(-(x-x0)' M^-1 (x-x0) / 2), x0 is the
    weighted mean and M twice the weighted second moment (Kannawadi et al. 2016, Eqs. 13 and 18).

    Parameters
    ----------
    image : Image, or array of shape (ny, nx)
    missing : image, optional
        Not 0 where a pixel is missing; these are solved for.
    variance : image, optional
        Of each pixel's noise, for :func:`moments_covariance`.
    strict : bool
        If False, a measurement that fails, or ends with a warning, is returned as it stands, and
        its ``status`` says so.
    moments_guess_x, moments_guess_y, moments_guess_sigma : float, optional
        First guess, pixels of the image, the centre of the first one being (0, 0).
    moments_method : int, optional
        0: the adaptive weight; 1: least squares at pixel centres, for stars smaller than their
        pixels; 2: a round weight; 3: as 1, with a constant background that is fitted.
    moments_tolerance, moments_max_passes, moments_background, moments_variance, moments_restart

    >>> y, x = np.mgrid[:32, :32]
    >>> found = adaptive_moments(np.exp(-((x - 15.5)**2 + (y - 14.0)**2) / (2 * 3.0**2)))
    >>> round(found.sigma, 6), round(found.centroid_x, 6), round(found.centroid_y, 6)
    (3.0, 15.5, 14.0)
    """
    with _adaptive(as_image(image), missing, variance, strict, options) as result:
        return result.read()


def moments_covariance(image, names, missing=None, variance=None, **options):
    """Covariance matrix of the named adaptive moments, such as ("centroid_x", "sigma", "e1"), to
    first order in the noise, or to second with ``moments_covariance_order=2``. The noise's variance
    comes as an image or as the option ``moments_variance``. Other arguments as for :func:`adaptive_moments`."""
    keys = [choose(MOMENTS, "name", name) for name in names]
    value = ctypes.c_double()
    with _adaptive(as_image(image), missing, variance, True, options) as result:
        matrix = np.empty((len(keys), len(keys)))
        for i, a in enumerate(keys):
            for j, b in enumerate(keys):
                check(lib.wfpsf_moments_covariance(result, a, b, value))
                matrix[i, j] = value.value
        return matrix


def moments_derivative(image, change, second=None, missing=None, **options):
    """:class:`Moments` that hold the derivatives of the adaptive moments of ``image + t * change``
    by t at 0; with ``second`` the mixed second ones of ``image + s * change + t * second``. Exact:
    no steps are taken. What has no derivative is NaN. Other arguments as for
    :func:`adaptive_moments`."""
    image, change = as_image(image), as_image(change)
    second = None if second is None else as_image(second)
    with _adaptive(image, missing, None, True, options) as result:
        return _copied(lambda out: lib.wfpsf_moments_differentiate(
            result, image, change, second, out), True)


def moments_influence(image, name, missing=None, **options):
    """Array of the derivatives of one of the adaptive moments, such as "sigma", by every pixel.
    Other arguments as for :func:`adaptive_moments`."""
    image = as_image(image)
    with _adaptive(image, missing, None, True, options) as result:
        influence = zeros(image.shape)
        check(lib.wfpsf_moments_influence(result, image,
                                          choose(MOMENTS, "name", name), influence))
        return influence.pixels


def weighted_moments(image, x, y, mxx, mxy, myy, strict=True):
    """:class:`Moments` under a Gaussian weight of that matrix about (x, y), which stays as it is:
    ``flux`` is the sum of I w, the second moments are about the weight's centre."""
    image = as_image(image)
    return _copied(lambda out: lib.wfpsf_moments_measure_weighted(
        image, x, y, mxx, mxy, myy, out), strict)


def moment_sums(image, x, y, weight=None):
    """The 15 sums of I w dx^j dy^k about (x, y) up to the fourth order, (j, k) = (0,0), (1,0),
    (0,1), (2,0), ..., (0,4). ``weight``: (mxx, mxy, myy) of a Gaussian."""
    image = as_image(image)
    matrix = None if weight is None else numbers("weight", weight)
    if matrix is not None and len(matrix) != 3:
        raise ValueError("weight has %d numbers: must have 3" % len(matrix))
    sums = np.empty(15)
    check(lib.wfpsf_moments_sums(image, x, y, address(matrix), sums.size, sums.ctypes.data))
    return sums


def unweighted_moments(image, x=math.nan, y=math.nan, strict=True):
    """:class:`Moments` over the whole image about the centroid, or about the point (x, y), the
    centre of the first pixel being (0, 0). ``strict`` as for :func:`adaptive_moments`."""
    image = as_image(image)
    return _copied(lambda out: lib.wfpsf_moments_measure_unweighted(image, x, y, out),
                   strict)
