# SPDX-License-Identifier: GPL-3.0-or-later
"""A detector's effects in their order."""
import collections
import ctypes
import math

import numpy as np

from . import _lib
from ._handle import Handle, pointers
from ._image import Image, as_image, writable
from ._ipc import EDGES, VaryingIPC
from ._library import lib
from ._names import choose, constants_of, integer, numbers
from ._options import chosen
from ._status import check

STEPS = constants_of("WFPSF_STEP_")
NOISE_OPTIONS = ("seed", "stream", "origin_x", "origin_y", "threads")
CHAIN_OPTIONS = NOISE_OPTIONS + ("noise", "force")

Counts = collections.namedtuple("Counts", "not_finite saturated")


class Chain(Handle):
    """A detector's effects in a stated order: none yet, or the instrument's own
    (:meth:`default`).

    >>> chain = Chain()
    >>> chain.add("background", 100.0)
    >>> chain.add("gain", 2.0)
    >>> chain.steps[1]
    ('gain', [2.0])
    """

    _kind = _lib.wfpsf_chain_p
    _destroy = "wfpsf_chain_destroy"

    def __init__(self):
        self._make(lib.wfpsf_chain_create)

    @classmethod
    def default(cls, instrument, exposure_time=None):
        """The instrument's own chain; exposure time in seconds, None: the instrument's."""
        time = math.nan if exposure_time is None else exposure_time
        return cls._made(lambda out: lib.wfpsf_chain_create_default(instrument, time, out))

    def add(self, step, *parameters, map=None):
        """Adds a step of numbers at the end, or one with a map (an image, which is copied):
        "dark_current_map", "capacitance_map", "pixel_mask". The C header chain.h lists the steps
        and their parameters; here they are strings in lower case."""
        key, given = choose(STEPS, "step", step), numbers("parameters", parameters)
        if map is None:
            check(lib.wfpsf_chain_add(self, key, len(given), given.ctypes.data))
        else:
            map = as_image(map)
            check(lib.wfpsf_chain_add_map(self, key, len(given), given.ctypes.data,
                                          map))

    def add_ipc(self, ipc, edge="zero", ipc_form=0):
        """Adds a kernel, or varying IPC. ``ipc_form`` is for the latter: 0: scatter, 1: gather."""
        edge = choose(EDGES, "edge", edge)
        if isinstance(ipc, VaryingIPC):
            check(lib.wfpsf_chain_add_varying_ipc(self, ipc,
                                                  integer("ipc_form", ipc_form, 32), edge))
        elif ipc_form:
            raise ValueError("ipc_form is for varying IPC: take kernel.flipped()")
        else:
            check(lib.wfpsf_chain_add_ipc(self, ipc, edge))

    @property
    def steps(self):
        """The steps and their parameters in their order: a list of (step, parameters)."""
        found = []
        count, step = ctypes.c_int64(), ctypes.c_int32()
        while True:
            check(lib.wfpsf_chain_step(self, len(found), 0, None, count, step))
            if step.value == 0:
                return found
            parameters = np.empty(count.value)
            check(lib.wfpsf_chain_step(self, len(found), parameters.size,
                                       parameters.ctypes.data, None, step))
            found.append((lib.wfpsf_step_name(step).decode(), parameters.tolist()))

    def apply(self, image, previous=(), **options):
        """Applies the chain in place and returns (not_finite, saturated), counts of pixels.

        ``previous`` holds the exposures before this one, the latest first. What a pixel draws
        depends on ``seed``, ``stream`` and its place on the detector, offset by ``origin_x`` and
        ``origin_y``, alone. Options: these, ``noise`` (0: means alone), ``force``, ``threads``.
        """
        image, before = writable(image), [as_image(exposure) for exposure in previous]
        not_finite, saturated = ctypes.c_int64(), ctypes.c_int64()
        with chosen(CHAIN_OPTIONS, options) as handle:
            check(lib.wfpsf_chain_apply(self, image, len(before), pointers(Image._kind, before),
                                        handle, not_finite, saturated))
        return Counts(not_finite.value, saturated.value)


def add_noise(image, rms, kernel=None, **options):
    """Adds normal noise to an image and returns it: white, or white noise through a kernel.
    Options: seed, stream, origin_x, origin_y, threads."""
    image = writable(image)
    with chosen(NOISE_OPTIONS, options) as handle:
        check(lib.wfpsf_noise_add(image, rms, kernel, handle))
    return image
