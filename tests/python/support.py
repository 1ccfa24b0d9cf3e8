# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests share."""
import numpy as np
import wfpsf


def gaussian(dtype, ny, nx, x, y, mxx, mxy, myy):
    """An elliptical Gaussian of unit flux."""
    determinant = mxx * myy - mxy**2
    v, u = np.mgrid[:ny, :nx]
    u, v = u - x, v - y
    chi2 = (myy * u**2 - 2 * mxy * u * v + mxx * v**2) / determinant
    return (np.exp(-chi2 / 2) / (2 * np.pi * np.sqrt(determinant))).astype(dtype)


def status_of(call):
    """Name of the status that a call fails with, without WFPSF_."""
    try:
        call()
    except wfpsf.WfpsfError as failure:
        return failure.name[len("WFPSF_"):]
    return "OK"
