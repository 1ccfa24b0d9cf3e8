# SPDX-License-Identifier: GPL-3.0-or-later
"""The library's constants by lower-case name, and arguments on their way into C."""
import operator
import os

import numpy as np

from . import _lib


def constants_of(prefix):
    """{"wrap": WFPSF_EDGE_WRAP, ...} for the prefix ``WFPSF_EDGE_``, in order of their numbers."""
    found = {name[len(prefix):].lower(): value for name, value in vars(_lib).items()
             if name.startswith(prefix)}
    return dict(sorted(found.items(), key=lambda item: item[1]))


def choose(table, argument, name):
    try:
        return table[name]
    except (KeyError, TypeError):
        raise ValueError("%s = %r: must be one of %s"
                         % (argument, name, ", ".join(map(repr, table)))) from None


def integer(argument, value, bits=64):
    """An integer that fits; ctypes would cut it without a word."""
    number = operator.index(value)
    if not -1 << (bits - 1) <= number < 1 << (bits - 1):
        raise OverflowError("%s = %d: must be an integer of %d bits" % (argument, number, bits))
    return number


def text(argument, value):
    """The bytes of a string, or of a path."""
    encoded = value.encode() if isinstance(value, str) else os.fsencode(value)
    if b"\0" in encoded:
        raise ValueError("%s = %r: must not hold a NUL" % (argument, value))
    return encoded


def numbers(argument, values, dimensions=1):
    """A contiguous array of doubles; ``.ctypes.data`` is its address."""
    array = np.asarray(values, dtype=np.float64, order="C")
    if array.ndim != dimensions:
        raise ValueError("%s has %d dimensions: must have %d" % (argument, array.ndim, dimensions))
    return array


def integers(argument, values, bits=64):
    """A contiguous array of integers that fit; NumPy would cut them without a word."""
    array = np.asarray(values)
    if array.ndim != 1:
        raise ValueError("%s has %d dimensions: must have 1" % (argument, array.ndim))
    if array.size and array.dtype.kind not in "iu":
        raise TypeError("%s must be integers, not %s" % (argument, array.dtype))
    for value in (array.min(), array.max()) if array.size else ():
        integer(argument, value, bits)
    return np.ascontiguousarray(array, dtype="int%d" % bits)


def address(array):
    return None if array is None else array.ctypes.data


def of_one_length(**arrays):
    """The arguments as arrays of numbers, when they have one length."""
    found = [numbers(name, values) for name, values in arrays.items()]
    if len({len(array) for array in found}) > 1:
        raise ValueError("%s must have one length, not %s"
                         % (", ".join(arrays), ", ".join(str(len(array)) for array in found)))
    return found
