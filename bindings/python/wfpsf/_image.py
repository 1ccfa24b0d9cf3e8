# SPDX-License-Identifier: GPL-3.0-or-later
"""Images: NumPy arrays with a record of what has been done to them."""
import collections
import ctypes

import numpy as np

from . import _lib
from ._handle import Handle
from ._library import lib
from ._names import choose, constants_of, integer, text
from ._options import chosen
from ._status import check

EFFECTS = constants_of("WFPSF_EFFECT_")
PIXEL_TYPES = {np.dtype(np.float32): _lib.WFPSF_FLOAT32, np.dtype(np.float64): _lib.WFPSF_FLOAT64}

Record = collections.namedtuple("Record", "oversampling pixel_scale_arcsec applied")


def pixel_type(dtype):
    return choose(PIXEL_TYPES, "dtype", np.dtype(dtype))


class Image(Handle):
    """A view of a NumPy array of float32 or float64, which is not copied.

    What the library writes appears in ``image.pixels``, the array itself; its strides may be any,
    negative ones too. ``pixels[y, x]``: shape (ny, nx), x along the last axis, y upwards; the
    centre of the first pixel is (0, 0), that of the image ((nx-1)/2, (ny-1)/2).

    Wherever an image is asked for, an array will do: one sample per pixel, no effects applied.

    Parameters
    ----------
    pixels : array of shape (ny, nx)
    oversampling : int
        Samples per native detector pixel along each axis; "pixels of the image" are its samples.
    pixel_scale_arcsec : float
        Side of a native pixel; 0: not stated.
    applied : iterable of str
        Effects that the image has been through ("pixel_response", "ipc", "read_noise", ...), so
        that none is applied twice.

    >>> pixels = np.zeros((4, 6))
    >>> with Image(pixels[::-1], oversampling=2) as image:
    ...     image.record
    Record(oversampling=2, pixel_scale_arcsec=0.0, applied=())
    """

    _kind = _lib.wfpsf_image_p
    _destroy = "wfpsf_image_destroy"

    def __init__(self, pixels, oversampling=1, pixel_scale_arcsec=0.0, applied=()):
        if isinstance(pixels, np.ma.MaskedArray):
            raise TypeError("pixels is a masked array: give its data, and the mask as ``missing``")
        if not isinstance(pixels, np.ndarray) or pixels.dtype not in PIXEL_TYPES:
            raise TypeError("pixels must be an array of float32 or float64, not %s"
                            % getattr(pixels, "dtype", type(pixels).__name__))
        if pixels.ndim != 2:
            raise ValueError("pixels has %d dimensions: must have 2" % pixels.ndim)
        if not pixels.flags.aligned or any(step % pixels.itemsize for step in pixels.strides):
            raise ValueError("pixels has strides that are no multiples of its elements")
        ny, nx = pixels.shape
        # NumPy leaves the stride of an axis of one element undefined.
        stride_y, stride_x = (step // pixels.itemsize if size > 1 else other for step, size, other
                              in zip(pixels.strides, pixels.shape, (nx, 1)))
        self.pixels = pixels
        self._make(lambda out: lib.wfpsf_image_wrap(
            PIXEL_TYPES[pixels.dtype], pixels.ctypes.data, nx, ny, stride_x, stride_y,
            integer("oversampling", oversampling), out))
        if pixel_scale_arcsec or applied:
            self.set_record(oversampling, pixel_scale_arcsec, applied)

    @property
    def shape(self):
        return self.pixels.shape

    @property
    def dtype(self):
        return self.pixels.dtype

    @property
    def record(self):
        """(oversampling, pixel_scale_arcsec, applied): samples per native pixel, side of a native
        pixel (0: not stated), and the names of the effects applied."""
        oversampling, scale, applied = ctypes.c_int64(), ctypes.c_double(), ctypes.c_int32()
        check(lib.wfpsf_image_record(self, oversampling, scale, applied))
        return Record(oversampling.value, scale.value,
                      tuple(name for name, bit in EFFECTS.items() if applied.value & bit))

    def set_record(self, oversampling=None, pixel_scale_arcsec=None, applied=None):
        """States the record of pixels that come from elsewhere; what is not given stays."""
        record = self.record
        effects = record.applied if applied is None else applied
        bits = 0
        for name in effects:
            bits |= choose(EFFECTS, "applied", name)
        check(lib.wfpsf_image_set_record(
            self,
            record.oversampling if oversampling is None else integer("oversampling", oversampling),
            record.pixel_scale_arcsec if pixel_scale_arcsec is None else pixel_scale_arcsec, bits))

    def copy_to(self, other):
        """Copies pixels, converting their type, and the record to an image of the same shape that
        shares no memory with this one."""
        check(lib.wfpsf_image_copy(self, writable(other)))

    def copy(self):
        other = zeros(self.shape, self.dtype)
        self.copy_to(other)
        return other

    def __array__(self, dtype=None, copy=None):
        array = self.pixels if dtype is None else self.pixels.astype(dtype, copy=False)
        return array.copy() if copy and array is self.pixels else array

    def __repr__(self):
        return "<Image of shape %s, %s%s>" % (self.shape, self.dtype,
                                              ", closed" if self.closed else "")


def zeros(shape, dtype=np.float64, **record):
    """An image of zeros; keywords as for :class:`Image`."""
    pixel_type(dtype)
    return Image(np.zeros(shape, dtype), **record)


def as_image(image):
    """An image, made of an array if it is one."""
    return image if isinstance(image, Image) else Image(image)


def writable(image):
    """The same for an image that the library will write into."""
    image = as_image(image)
    if not image.pixels.flags.writeable:
        raise ValueError("the array is read-only")
    return image


def read_fits(path, hdu=None, dtype=None):
    """Reads a two-dimensional FITS image, plain or gzipped, with the record that this library
    wrote.

    ``hdu`` is the name of an extension or its number, the primary HDU being 0; None takes the first
    image found. ``dtype`` is float32 or float64; None chooses by the file's BITPIX.
    """
    name = None if hdu is None else text("hdu", str(hdu))
    asked = 0 if dtype is None else pixel_type(dtype)
    source = Image._made(
        lambda out: lib.wfpsf_image_read_fits(text("path", path), name, asked, out))
    with source:
        code, nx, ny = ctypes.c_int32(), ctypes.c_int64(), ctypes.c_int64()
        check(lib.wfpsf_image_shape(source, code, nx, ny))
        image = zeros((ny.value, nx.value),
                      np.float32 if code.value == _lib.WFPSF_FLOAT32 else np.float64)
        source.copy_to(image)
        return image


def write_fits(path, image, **options):
    """Writes an image and its record as the primary HDU of a FITS file, gzipped if the path ends in
    ``.gz``. The file appears whole or not at all. Option: fits_overwrite."""
    image = as_image(image)
    with chosen(("fits_overwrite",), options) as handle:
        check(lib.wfpsf_image_write_fits(image, text("path", path), handle))
