# SPDX-License-Identifier: GPL-3.0-or-later
"""What all owners of a C handle share."""
import ctypes
import weakref

from ._library import lib
from ._status import check


class Handle:
    """Owns an object of the library.

    It is freed when the Python object is collected, at ``close()``, which may be called twice, or
    at the end of a ``with`` block. ctypes lets other Python threads run during every call;
    immutable objects may be shared by threads, and none may be closed while another thread uses
    it. A closed one gives a ``ctypes.ArgumentError`` that says so.
    """

    _kind = None  # the type of its pointer: ctypes refuses another
    _destroy = None  # the name of the function that frees it

    def _make(self, call):
        """Owns what ``call(out)`` makes, then checks the status: a warning may be an exception."""
        out = self._kind()
        status = call(ctypes.byref(out))
        if out:
            self._own(out)
        check(status)

    def _own(self, pointer):
        self._pointer = pointer
        self._finalizer = weakref.finalize(self, getattr(lib, self._destroy), pointer)
        self._finalizer.atexit = False

    @classmethod
    def _of(cls, pointer):
        """An object that owns this pointer."""
        handle = cls.__new__(cls)
        handle._own(pointer)
        return handle

    @classmethod
    def _made(cls, call):
        """An object that owns what ``call(out)`` makes."""
        handle = cls.__new__(cls)
        handle._make(call)
        return handle

    @property
    def _as_parameter_(self):
        """What ctypes passes to a function that is given the object, which it keeps meanwhile."""
        if not self._pointer:
            raise ValueError("the %s has been closed" % type(self).__name__)
        return self._pointer

    @property
    def closed(self):
        return not self._pointer

    def close(self):
        self._pointer = None
        self._finalizer()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __repr__(self):
        return "<%s%s>" % (type(self).__name__, ", closed" if self.closed else "")

    def __reduce__(self):
        raise TypeError("cannot pickle a %s" % type(self).__name__)


def pointers(kind, handles):
    """The array of the pointers, of that type, of handles, which the caller keeps."""
    return (kind * len(handles))(*(handle._as_parameter_ for handle in handles))


def get(function, handle, key):
    """The number that ``function(handle, key, out)`` stores."""
    value = ctypes.c_double()
    check(function(handle, key, ctypes.byref(value)))
    return value.value


def text_from(call):
    """The text that ``call(capacity, buffer, length)`` stores."""
    length = ctypes.c_int64()
    check(call(0, None, length))
    buffer = ctypes.create_string_buffer(length.value + 1)
    check(call(len(buffer), buffer, None))
    return buffer.value.decode()


class Properties:
    """Mixin: numbers that the library knows of an object, as attributes."""

    _properties = {}  # name: key
    _getter = None  # the name of the function that reads them

    def __getattr__(self, name):
        key = self._properties.get(name)
        if key is None:
            raise AttributeError("%s has no attribute %r" % (type(self).__name__, name))
        return get(getattr(lib, self._getter), self, key)

    def __dir__(self):
        return [*super().__dir__(), *self._properties]
