# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of one's own."""
from . import _lib
from ._handle import Handle
from ._library import lib
from ._names import integer, numbers, text
from ._status import check


class Design(Handle):
    """Figures of one's own, of which :class:`Instrument` makes an instrument that serves wherever a
    built-in one does.

    The pupil is a circular primary about the optical axis, less a circular obscuration, less the
    struts. ``set_telescope`` and ``set_detector`` must be called; the others need not be.

    >>> design = Design()
    >>> design.set_telescope(diameter_m=2.4, obscuration=0.33, reference_wavelength_nm=633)
    >>> for azimuth in (45, 135, 225, 315):
    ...     design.add_strut(azimuth, 0.03)
    >>> design.set_detector(pixel_scale_arcsec=0.04, n_pix_x=4096, n_pix_y=2048)
    """

    _kind = _lib.wfpsf_design_p
    _destroy = "wfpsf_design_destroy"

    def __init__(self):
        self._make(lib.wfpsf_design_create)

    def set_telescope(self, *, diameter_m, obscuration, reference_wavelength_nm):
        """The mirrors. The obscuration is linear, a fraction of the diameter, 0 to 0.99; Zernike
        coefficients are given at the reference wavelength."""
        check(lib.wfpsf_design_set_telescope(self, diameter_m, obscuration,
                                             reference_wavelength_nm))

    def add_strut(self, azimuth_deg, width_m, offset_m=0.0):
        """One more dark bar with parallel sides, from the optical axis outwards in the direction
        ``azimuth_deg`` (from x towards y). ``offset_m`` moves it towards ``azimuth_deg + 90``."""
        check(lib.wfpsf_design_add_strut(self, azimuth_deg, width_m, offset_m))

    def set_detector(self, *, pixel_scale_arcsec, n_pix_x, n_pix_y, sca_count=1):
        """The detectors (SCAs), all of one kind."""
        check(lib.wfpsf_design_set_detector(
            self, integer("sca_count", sca_count, 32), pixel_scale_arcsec,
            integer("n_pix_x", n_pix_x), integer("n_pix_y", n_pix_y)))

    def set_zernikes(self, sca, coefficients):
        """Aberrations all over a detector: Noll's order from j = 1, waves rms over the full circle
        at the reference wavelength."""
        given = numbers("coefficients", coefficients)
        check(lib.wfpsf_design_set_zernikes(self, integer("sca", sca, 32), len(given),
                                            given.ctypes.data))

    def set_field(self, sca, x, y, coefficients):
        """Aberrations that vary: row i of ``coefficients`` at pixel (x[i], y[i]) of five, the first
        one near the centre, then one towards each corner. The first pixel's centre is (0, 0)."""
        x, y, given = numbers("x", x), numbers("y", y), numbers("coefficients", coefficients, 2)
        if not len(x) == len(y) == len(given) == 5:
            raise ValueError("x, y and the rows of coefficients must be five")
        check(lib.wfpsf_design_set_field(self, integer("sca", sca, 32), x.ctypes.data,
                                         y.ctypes.data, given.shape[1], given.ctypes.data))

    def add_band(self, name, first_nm, step_nm, throughput):
        """One more filter band: its throughput (0 to 1) at equal steps of wavelength, linear in
        between and zero outside."""
        given = numbers("throughput", throughput)
        check(lib.wfpsf_design_add_band(self, text("name", name), first_nm, step_nm,
                                        len(given), given.ctypes.data))
