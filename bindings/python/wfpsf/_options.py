# SPDX-License-Identifier: GPL-3.0-or-later
"""Keyword options: the library's own, by their names in lower case."""
import collections
import contextlib
import ctypes

from . import _lib
from ._handle import Handle
from ._library import lib
from ._names import constants_of, integer, numbers
from ._status import check

OPTIONS = {name: key for name, key in constants_of("WFPSF_OPTION_").items()
           if name not in ("real", "integer")}

Option = collections.namedtuple("Option", "name integer default smallest largest text")


def describe(name):
    text, kind = ctypes.c_char_p(), ctypes.c_int32()
    standard, smallest, largest = ctypes.c_double(), ctypes.c_double(), ctypes.c_double()
    check(lib.wfpsf_option_describe(OPTIONS[name], None, text, kind, standard, smallest, largest))
    default = standard.value
    return Option(name, kind.value == _lib.WFPSF_OPTION_INTEGER,
                  None if default != default else default, smallest.value, largest.value,
                  text.value.decode())


def options():
    """The keyword options: a list of (name, integer, default, smallest, largest, text).

    A default of None stands for "chosen by the library", and None as a value leaves any option at
    its default.

    >>> [option.default for option in options() if option.name == "eps"]
    [1e-06]
    """
    return [describe(name) for name in OPTIONS]


class Options(Handle):
    """The options of one call."""

    _kind = _lib.wfpsf_options_p
    _destroy = "wfpsf_options_destroy"

    def __init__(self):
        self._make(lib.wfpsf_options_create)
        self.failure = None  # what the progress function raised

    def set(self, name, value):
        if name == "zernikes":
            coefficients = numbers(name, value)
            check(lib.wfpsf_options_set_zernikes(self, len(coefficients),
                                                 coefficients.ctypes.data))
        elif name == "opd":
            from ._image import as_image  # which needs this module
            image, scale_m, axis_x, axis_y = value
            image = as_image(image)
            check(lib.wfpsf_options_set_opd(self, image, scale_m, axis_x, axis_y))
        elif name == "scene_store":
            check(lib.wfpsf_options_set_scene_store(self, value))
        elif name == "progress":
            self._tell = _lib.wfpsf_progress(self._progress(value))  # the library holds its address
            check(lib.wfpsf_options_set_progress(self, self._tell, None))
        elif describe(name).integer:
            check(lib.wfpsf_options_set_integer(self, OPTIONS[name], integer(name, value)))
        else:
            check(lib.wfpsf_options_set_real(self, OPTIONS[name], value))

    def _progress(self, tell):
        # Exceptions must not pass through C: they stop the work and are raised afterwards.
        def told_to_stop(part, _):
            try:
                return tell(part) is False
            except BaseException as failure:
                self.failure = failure
                return True
        return told_to_stop


@contextlib.contextmanager
def _chosen(taken, given):
    with Options() as handle:
        for name, value in given.items():
            if name not in taken:
                raise TypeError("no option %s here: there are %s" % (name, ", ".join(taken)))
            if value is not None:
                handle.set(name, value)
        try:
            yield handle
        except Exception:
            if handle.failure is not None:
                raise handle.failure from None
            raise


def chosen(taken, given):
    """A context of the options that a function was given, of those it takes."""
    return _chosen(taken, given) if given else contextlib.nullcontext()
