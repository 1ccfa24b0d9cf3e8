# SPDX-License-Identifier: GPL-3.0-or-later
"""Interpixel capacitance: one kernel for all pixels, or one that varies."""
import collections
import ctypes

import numpy as np

from . import _lib
from ._handle import Handle, get, pointers
from ._image import as_image, writable, zeros
from ._library import lib
from ._names import address, choose, constants_of, integer, numbers, text
from ._options import chosen
from ._status import check

EDGES = constants_of("WFPSF_EDGE_")
KERNEL_PROPERTIES = constants_of("WFPSF_KERNEL_")
APPLY_OPTIONS = ("ipc_form", "ipc_fill", "force", "threads")
CORRECT_OPTIONS = ("ipc_form", "ipc_least_margin", "ipc_tolerance", "ipc_max_passes", "force",
                   "threads")

Correction = collections.namedtuple("Correction",
                                    "image residual noise_amplification passes not_finite")
Weakest = collections.namedtuple("Weakest", "margin x y")


class _IPC(Handle):
    """What a kernel and varying IPC share."""

    def _reach(self):
        """How far the taps reach along y and x."""
        return 0, 0

    def apply(self, image, out=None, edge="zero", **options):
        """Applies the kernel, whose taps stand one native pixel apart: N samples of an image with
        oversampling N. Returns the result.

        Parameters
        ----------
        image : Image or array
        out : Image or array, optional
            Of the input's dtype and shape; it is the input, or shares no memory with it. Its record
            becomes the input's with IPC, or its correction, added. An image that has been through
            it is refused.
        edge : str
            What lies beyond the border: "zero", "replicate" (the nearest pixel), "wrap" (the other
            side), or what becomes of pixels within the kernel's reach of it: "crop" (they keep
            their value), "fill" (they get ``ipc_fill``), "valid" (they are left out: out is smaller
            by N times ``taps().shape[axis] // 2`` on each side).
        ipc_form, ipc_fill, force, threads : optional
            0: scatter, a convolution; 1: gather, a correlation. The fill. 1: apply it again.
        """
        image = as_image(image)
        if out is None:
            reach_y, reach_x = self._reach() if edge == "valid" else (0, 0)
            samples, (ny, nx) = image.record.oversampling, image.shape
            out = zeros((max(ny - 2 * samples * reach_y, 0), max(nx - 2 * samples * reach_x, 0)),
                        image.dtype)
        out = writable(out)
        with chosen(APPLY_OPTIONS, options) as handle:
            check(getattr(lib, self._apply)(self, image,
                                            choose(EDGES, "edge", edge), handle, out, None))
        return out

    def correct(self, image, out=None, edge="zero", **options):
        """Undoes IPC exactly: the image that ``apply`` turns into ``image``, which may be ``out``
        itself. ``edge`` is "zero", "replicate" or "wrap". Returns (image, residual,
        noise_amplification, passes, not_finite). Options: ipc_form, ipc_least_margin,
        ipc_tolerance, ipc_max_passes, force, threads."""
        image = as_image(image)
        out = zeros(image.shape, image.dtype) if out is None else writable(out)
        residual, noise = ctypes.c_double(), ctypes.c_double()
        passes, not_finite = ctypes.c_int64(), ctypes.c_int64()
        with chosen(CORRECT_OPTIONS, options) as handle:
            check(getattr(lib, self._correct)(
                self, image, choose(EDGES, "edge", edge), handle, out,
                residual, noise, passes, not_finite))
        return Correction(out, residual.value, noise.value, passes.value, not_finite.value)

    def covariance(self, variance, lag_x=0, lag_y=0, edge="zero", **options):
        """The covariance of pixels (lag_x, lag_y) apart after IPC, an image, from the image of the
        variances of independent pixels before it. ``edge`` is "zero" or "wrap". Options: ipc_form,
        threads."""
        variance = as_image(variance)
        out = zeros(variance.shape, variance.dtype)
        with chosen(("ipc_form", "threads"), options) as handle:
            check(getattr(lib, self._covariance)(
                self, variance, integer("lag_x", lag_x), integer("lag_y", lag_y),
                choose(EDGES, "edge", edge), handle, out))
        return out


class IPCKernel(_IPC):
    """The 3 x 3 kernels of interpixel capacitance of Kannawadi et al. (2016), Eqs. 7-9. Immutable:
    threads may share it.

    Kernels are convolved: out(p) = sum over d of K(d) in(p - d), the paper's Eq. 4. Taps lie in
    [0, 1] and sum to 1 within 1e-12, unless the options say otherwise.

    >>> kernel = IPCKernel(0.02, 0.002)
    >>> kernel.taps()[1].round(3).tolist()
    [0.02, 0.912, 0.02]
    """

    _kind = _lib.wfpsf_ipc_kernel_p
    _destroy = "wfpsf_ipc_kernel_destroy"
    _apply = "wfpsf_ipc_apply"
    _correct = "wfpsf_ipc_correct"
    _covariance = "wfpsf_ipc_covariance"

    def __init__(self, alpha, alpha_prime=0.0, alpha_plus=0.0, **options):
        with chosen(("kernel_negative",), options) as handle:
            self._make(lambda out: lib.wfpsf_ipc_kernel_create(
                alpha, alpha_prime, alpha_plus, handle, out))

    @classmethod
    def from_taps(cls, taps, **options):
        """A kernel from an array of odd sizes, ``taps[y, x]``, whose central element is K(0, 0).
        Options: kernel_negative, kernel_normalise."""
        taps = numbers("taps", taps, 2)
        with chosen(("kernel_negative", "kernel_normalise"), options) as handle:
            return cls._made(lambda out: lib.wfpsf_ipc_kernel_create_taps(
                taps.shape[1], taps.shape[0], taps.ctypes.data, handle, out))

    @classmethod
    def default(cls, instrument):
        """The instrument's own."""
        return cls._made(lambda out: lib.wfpsf_ipc_kernel_create_default(instrument, out))

    @classmethod
    def wfc3(cls):
        """The kernel measured for WFC3/IR (Kannawadi et al. 2016, Eq. 11), divided by its printed
        sum."""
        return cls._made(lib.wfpsf_ipc_kernel_create_wfc3)

    @classmethod
    def read_fits(cls, path, hdu=None, **options):
        """A kernel from a FITS image of its taps; the middle pixel is K(0, 0). Options:
        kernel_negative, kernel_normalise."""
        name = None if hdu is None else text("hdu", str(hdu))
        with chosen(("kernel_negative", "kernel_normalise"), options) as handle:
            return cls._made(lambda out: lib.wfpsf_ipc_kernel_read_fits(
                text("path", path), name, handle, out))

    def correction(self, order=1):
        """The correction of an order (the first is the paper's Eq. 12): it undoes the kernel to
        ``order + 1`` in the coupling."""
        order = integer("order", order)
        if order == 1:
            return self._made(lambda out: lib.wfpsf_ipc_kernel_create_correction(self, out))
        return self._made(lambda out: lib.wfpsf_ipc_kernel_create_neumann(self, order, out))

    def flipped(self):
        """K(-d): convolution with it is correlation with K."""
        return self._made(lambda out: lib.wfpsf_ipc_kernel_create_flipped(self, out))

    def then(self, second):
        """One kernel that does what this one does and then ``second``, image borders aside."""
        return self._made(lambda out: lib.wfpsf_ipc_kernel_create_composed(self, second, out))

    def autocorrelation(self):
        """The covariance, by lag, of white noise of variance 1 after the kernel."""
        return self._made(lambda out: lib.wfpsf_ipc_kernel_create_autocorrelation(self, out))

    def _shape(self):
        nx, ny = ctypes.c_int64(), ctypes.c_int64()
        check(lib.wfpsf_ipc_kernel_taps(self, 0, None, nx, ny))
        return ny.value, nx.value

    def _reach(self):
        ny, nx = self._shape()
        return ny // 2, nx // 2

    def taps(self):
        """The taps as an array: K(dx, dy) at ``[dy + ny//2, dx + nx//2]``."""
        taps = np.empty(self._shape())
        check(lib.wfpsf_ipc_kernel_taps(self, taps.size, taps.ctypes.data, None, None))
        return taps

    def properties(self):
        """What is known of the kernel, a dict: sum, centroid, second moments, its asymmetries, the
        stability margin ``min |K^|`` with its frequency, what it does to noise and to the gain and
        efficiency measured without regard to it. The C header ipc.h has the list."""
        return {name: get(lib.wfpsf_ipc_kernel_get, self, key)
                for name, key in KERNEL_PROPERTIES.items()}

    def transform(self, frequency_x, frequency_y):
        """The sum over d of K(d) exp(-2 pi i f.d), f in cycles per pixel."""
        re, im = ctypes.c_double(), ctypes.c_double()
        check(lib.wfpsf_ipc_kernel_transform(self, frequency_x, frequency_y, re, im))
        return complex(re.value, im.value)

    def self_test(self, **options):
        """What ``apply`` makes of one unit of charge, an array: look at it before you believe a
        kernel. Option: ipc_form."""
        response = np.empty(self._shape())
        with chosen(("ipc_form",), options) as handle:
            check(lib.wfpsf_ipc_kernel_self_test(self, handle, response.size,
                                                 response.ctypes.data))
        return response


def wfc3_deviations():
    """Standard deviations of the taps of ``IPCKernel.wfc3``, an array of 3 x 3."""
    deviations = np.empty((3, 3))
    check(lib.wfpsf_ipc_wfc3_deviations(deviations.size, deviations.ctypes.data))
    return deviations


class VaryingIPC(_IPC):
    """Interpixel capacitance whose kernel varies over a detector, made by :meth:`from_maps`,
    :meth:`from_polynomials` or :meth:`from_regions`. ``apply`` and ``correct`` are those of a
    kernel. Immutable: threads may share it.

    ``ipc_form = 0``, scatter, spreads each charge by its own pixel's kernel and conserves it; 1,
    gather, collects by the kernel of the pixel that collects.
    """

    _kind = _lib.wfpsf_varying_ipc_p
    _destroy = "wfpsf_varying_ipc_destroy"
    _apply = "wfpsf_varying_ipc_apply"
    _correct = "wfpsf_varying_ipc_correct"
    _covariance = "wfpsf_varying_ipc_covariance"

    def __init__(self):
        raise TypeError("made by from_maps(), from_polynomials() or from_regions()")

    @classmethod
    def from_maps(cls, alpha, alpha_prime=None, alpha_plus=None, **options):
        """From images of the parameters of each pixel's kernel. Option: kernel_negative."""
        maps = [None if given is None else as_image(given)
                for given in (alpha, alpha_prime, alpha_plus)]
        with chosen(("kernel_negative",), options) as handle:
            return cls._made(lambda out: lib.wfpsf_varying_ipc_create_maps(*maps, handle, out))

    @classmethod
    def from_polynomials(cls, nx, ny, degree, alpha, alpha_prime=None, alpha_plus=None, **options):
        """From polynomials over nx x ny pixels: coefficients of 1, X, Y, X^2, XY, Y^2, ... with X
        and Y from -1 to 1 between the borders. Option: kernel_negative."""
        degree = integer("degree", degree)
        wanted = (degree + 1) * (degree + 2) // 2
        given = [None if values is None else numbers("coefficients", values)
                 for values in (alpha, alpha_prime, alpha_plus)]
        if any(values is not None and len(values) != wanted for values in given):
            raise ValueError("a polynomial of degree %d has %d coefficients" % (degree, wanted))
        with chosen(("kernel_negative",), options) as handle:
            return cls._made(lambda out: lib.wfpsf_varying_ipc_create_polynomials(
                integer("nx", nx), integer("ny", ny), degree, *map(address, given), handle, out))

    @classmethod
    def from_regions(cls, regions, kernels):
        """From an image of regions, numbered from 0, and a kernel for each."""
        regions, kernels = as_image(regions), list(kernels)
        return cls._made(lambda out: lib.wfpsf_varying_ipc_create_regions(
            regions, len(kernels), pointers(IPCKernel._kind, kernels), out))

    def at(self, x, y):
        """The kernel of pixel (x, y), the first one being (0, 0)."""
        return IPCKernel._made(lambda out: lib.wfpsf_varying_ipc_kernel(
            self, integer("x", x), integer("y", y), out))

    def weakest(self):
        """The least stability margin, ``min |K^|``, of any pixel's kernel, and that pixel: (margin,
        x, y)."""
        margin, x, y = ctypes.c_double(), ctypes.c_int64(), ctypes.c_int64()
        check(lib.wfpsf_varying_ipc_margin(self, margin, x, y))
        return Weakest(margin.value, x.value, y.value)

    def autocorrelation(self, x, y, variance=None, edge="zero", **options):
        """The covariance of pixel (x, y) with its neighbours after IPC, an array of odd size: with
        the pixel (dx, dy) from it at ``[ny // 2 + dy, nx // 2 + dx]``. ``variance`` is the image of
        the variances of independent pixels before IPC, 1 by default. Option: ipc_form."""
        given = None if variance is None else as_image(variance)
        nx, ny = ctypes.c_int64(), ctypes.c_int64()
        with chosen(("ipc_form",), options) as handle:
            def ask(capacity, out):
                check(lib.wfpsf_varying_ipc_autocorrelation(
                    self, given, integer("x", x), integer("y", y), choose(EDGES, "edge", edge),
                    handle, capacity, out, nx, ny))
            ask(0, None)
            covariances = np.empty((ny.value, nx.value))
            ask(covariances.size, address(covariances))
        return covariances
