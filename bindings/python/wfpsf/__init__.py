# SPDX-License-Identifier: GPL-3.0-or-later
"""WFIRST/Roman PSFs, interpixel capacitance and moments of images, by the library libwfpsf.

>>> import wfpsf
>>> with wfpsf.Instrument("wfirst-afta-c5") as instrument:
...     wavelength = instrument.band("J129", rule="paper").effective_nm
...     star = wfpsf.PSF(instrument, 7, wavelength, eps=1e-7).draw(512, 512, oversampling=32)
>>> blurred = wfpsf.IPCKernel(0.02, 0.002).apply(star)
>>> round(wfpsf.adaptive_moments(blurred).sigma * 110 / 32, 2)  # milliarcsec
64.78

Arrays are ``pixels[y, x]``, of shape (ny, nx): x along the last, fast axis, y upwards. They are
float32 or float64, of any strides, and never copied on their way to the library.

Positions count from 0: the centre of the first pixel is (0, 0), in arguments and in results.

A call that fails raises a :class:`WfpsfError`; one that succeeds with a reservation gives a
:class:`WfpsfWarning`. What takes keyword options says which; :func:`options` lists their defaults
and bounds.

Objects that hold memory of the library free it when they are collected, at ``close()``, or at the
end of a ``with`` block.

During every call other Python threads run (ctypes lets go of the interpreter's lock). Instruments,
PSFs, OTFs, SEDs, kernels, varying PSFs and IPC, scenes, exposures and studies are immutable and may
be shared by threads; an image, a design, or a chain or catalogue that is being added to belongs to
one thread at a time, and nothing may be closed while it is in use.

The environment variable ``WFPSF_LIBRARY`` names the shared library when the package is imported;
without it, it is the one of the tree that the package was installed in, or else the one that the
system's loader finds. ``wfpsf.library`` is the C interface itself, ``wfpsf.constants`` its
constants.
"""
from . import _lib as constants
from ._chain import Chain, add_noise
from ._design import Design
from ._image import Image, read_fits, write_fits, zeros
from ._instrument import Instrument
from ._interleave import deinterleave, interleave
from ._ipc import IPCKernel, VaryingIPC, wfc3_deviations
from ._library import lib as library
from ._moments import (Moments, adaptive_moments, moment_sums, moments_covariance,
                       moments_derivative, moments_influence, unweighted_moments, weighted_moments)
from ._observation import Observation, julian_date, sun_position
from ._options import options
from ._otf import OTF
from ._psf import PSF, psfs
from ._scene import Catalogue, Exposure, Rendering, Scene, SceneStore
from ._sed import SED
from ._size import (ee_radius, ee_radius_derivative, encircled_energy, fwhm, profile_fwhm,
                    radial_profile)
from ._status import WfpsfError, WfpsfWarning, check, status_name
from ._study import Study
from ._varying_psf import VaryingPSF

check(library.wfpsf_abi_check(constants.WFPSF_ABI_NUMBER))

__version__ = library.wfpsf_version().decode()  # of the loaded library

__all__ = ["OTF", "PSF", "SED", "Catalogue", "Chain", "Design", "Exposure", "IPCKernel", "Image",
           "Instrument", "Moments", "Observation", "Rendering", "Scene", "SceneStore", "Study", "VaryingIPC",
           "VaryingPSF", "WfpsfError", "WfpsfWarning", "adaptive_moments", "add_noise", "constants",
           "deinterleave", "ee_radius", "ee_radius_derivative", "encircled_energy", "fwhm",
           "interleave", "julian_date", "library", "moment_sums", "moments_covariance",
           "moments_derivative", "moments_influence", "options", "profile_fwhm", "psfs",
           "radial_profile", "read_fits", "status_name", "sun_position", "unweighted_moments",
           "weighted_moments", "wfc3_deviations", "write_fits", "zeros"]
