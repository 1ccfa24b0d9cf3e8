# SPDX-License-Identifier: GPL-3.0-or-later
"""Status codes become exceptions and warnings."""
import ctypes
import sys
import warnings

from ._library import lib


class WfpsfError(Exception):
    """A call of the library failed.

    Attributes
    ----------
    status : int
        The status code, such as ``wfpsf.constants.WFPSF_ERROR_RANGE``.
    name : str
        Its name, such as ``"WFPSF_ERROR_RANGE"``.
    message : str
        One line that names the argument, its value and the allowed range.
    """

    def __init__(self, status, message):
        super().__init__(status, message)
        self.status = status
        self.message = message

    @property
    def name(self):
        return status_name(self.status)

    def __str__(self):
        return "%s (%s)" % (self.message, self.name)


class WfpsfWarning(UserWarning):
    """A call of the library succeeded with a reservation."""


def status_name(status):
    """Name of a status code.

    >>> status_name(-30)
    'WFPSF_ERROR_RANGE'
    """
    return lib.wfpsf_status_name(status).decode()


def last_error():
    """The line that this thread's last failing or warning call left."""
    size = lib.wfpsf_last_error(None, 0) + 1
    buffer = ctypes.create_string_buffer(size)
    lib.wfpsf_last_error(buffer, size)
    return buffer.value.decode(errors="replace")


def _users_level():
    """The stacklevel at which a warning points to the first caller outside of this package."""
    level, frame = 0, sys._getframe(0)
    ours = (__name__.partition(".")[0], "contextlib")
    while frame and frame.f_globals.get("__name__", "").partition(".")[0] in ours:
        level, frame = level + 1, frame.f_back
    return level


def check(status):
    """Raises for an error, warns for a warning. Comes straight after the call."""
    if status < 0:
        raise WfpsfError(status, last_error())
    if status > 0:
        message = "%s (%s)" % (last_error(), status_name(status))
        warnings.warn(message, WfpsfWarning, stacklevel=_users_level())
