# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds and opens the shared library."""
import os

from . import _lib

try:
    from ._installed import LIBRARY as _BESIDE  # written by CMake's install: a relative path
except ImportError:
    _BESIDE = None


def _path():
    named = os.environ.get("WFPSF_LIBRARY")
    if named:
        return named
    if _BESIDE:
        return os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), _BESIDE))
    return "libwfpsf.so.%d" % _lib.WFPSF_ABI_NUMBER  # the system's loader looks for it


def _open(path):
    try:
        return _lib.load(path)
    except (OSError, AttributeError) as failure:
        raise ImportError("cannot load the library %s; the environment variable WFPSF_LIBRARY can "
                          "name another: %s" % (path, failure)) from failure


lib = _open(_path())
