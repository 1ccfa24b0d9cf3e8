# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands in for GalSim where it is not installed: as much of its interface as wfpsf.galsim meets, and
plain Fourier drawing."""
import copy
import math

import numpy as np

from . import config

__version__ = "stand-in"


class PositionD:
    def __init__(self, x, y):
        self.x, self.y = float(x), float(y)


class GSParams:
    def __init__(self, folding_threshold=5e-3):
        self.folding_threshold = folding_threshold

    @staticmethod
    def check(gsparams, default=None, **keywords):
        return GSParams(**keywords) if keywords else gsparams or default or GSParams()

    def __eq__(self, other):
        return vars(self) == vars(other)

    def __hash__(self):
        return hash(self.folding_threshold)

    def __repr__(self):
        return "galsim.GSParams(folding_threshold=%r)" % self.folding_threshold


class Image:
    """A k image: rows from ymin, columns from xmin, ``scale`` between them."""

    def __init__(self, xmin, xmax, ymin, ymax, scale):
        self.xmin, self.xmax, self.ymin, self.ymax = xmin, xmax, ymin, ymax
        self.scale = scale
        self.array = np.zeros((ymax - ymin + 1, xmax - xmin + 1), np.complex128)


class Drawn:
    def __init__(self, array):
        self.array = array


class GSObject:
    gsparams = property(lambda self: self._gsparams)
    flux = property(lambda self: self._flux)
    maxk = property(lambda self: self._maxk)
    stepk = property(lambda self: self._stepk)
    centroid = property(lambda self: self._centroid)
    max_sb = property(lambda self: self._max_sb)

    def kValue(self, kx, ky):
        return self._kValue(PositionD(kx, ky))

    def withGSParams(self, gsparams=None, **keywords):
        other = copy.copy(self)
        other._gsparams = GSParams.check(gsparams, self._gsparams, **keywords)
        return other

    def drawImage(self, nx, ny, scale, offset=(0.0, 0.0)):
        """The object at the centre of the image, offset in pixels, averaged over the pixel."""
        n = max(math.ceil(2 * math.pi / (self.stepk * scale)), 2 * max(nx, ny))
        step = 2 * math.pi / (n * scale)
        half = math.ceil(self.maxk / step)
        image = Image(-half, half, -half, half, step)
        self._drawKImage(image)
        index = np.arange(-half, half + 1)
        k = index * step

        def axis(count, shift):  # sum over the k of one axis, at each of its pixels
            place = (np.arange(count) - (count - 1) / 2 - shift) * scale
            return np.exp(1j * np.outer(place, k)) * np.sinc(k * scale / (2 * math.pi))

        return Drawn((axis(ny, offset[1]) @ image.array @ axis(nx, offset[0]).T).real / n**2)


class _Scaled(GSObject):
    """An object in other units, or other axes: original(x) -> original(J^-1 x) / det J."""

    def __init__(self, original, jacobian):
        self._original, self._jacobian = original, np.array(jacobian, float)
        self._flux, self._gsparams = original.flux, original.gsparams
        size = np.linalg.svd(self._jacobian, compute_uv=False)
        self._maxk, self._stepk = original.maxk / size[-1], original.stepk / size[0]

    def _drawKImage(self, image, jac=None):
        self._original._drawKImage(image, self._jacobian if jac is None
                                   else np.asarray(jac) @ self._jacobian)


class JacobianWCS:
    """World = J image."""

    def __init__(self, dudx, dudy, dvdx, dvdy):
        self.jacobian = np.array([[dudx, dudy], [dvdx, dvdy]], float)

    def toWorld(self, profile, image_pos=None):
        self.asked_at = image_pos
        return _Scaled(profile, self.jacobian)

    def toImage(self, profile):
        return _Scaled(profile, np.linalg.inv(self.jacobian))


class PixelScale(JacobianWCS):
    def __init__(self, scale):
        super().__init__(scale, 0, 0, scale)
