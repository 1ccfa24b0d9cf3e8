# SPDX-License-Identifier: GPL-3.0-or-later
"""The GalSim plugin, against GalSim where it is installed, else against a stand-in."""
import copy
import os
import pickle
import sys
import unittest
import warnings

import numpy as np
import wfpsf

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # GalSim's own
    try:
        import galsim
    except ImportError:
        sys.path.append(os.path.join(os.path.dirname(__file__), "stand_in"))
        import galsim
    import wfpsf.galsim

SCALE = 0.11
TOLERANCE = 4e-6  # of the peak, at default settings


def draw(psf, n=24, offset=(0.0, 0.0)):
    return psf.drawImage(nx=n, ny=n, scale=SCALE, offset=offset).array


def stamp(x=100.0, y=200.0, n=24, offset=(0.0, 0.0), wavelength_nm=1500.0, **options):
    """What wfpsf draws itself, averaged over the pixel."""
    psf = wfpsf.PSF.in_band(wfpsf.Instrument("roman-c9"), "H158", 7, x, y, wavelength_nm, **options)
    return psf.draw(n, n, (n - 1) / 2 + offset[0], (n - 1) / 2 + offset[1]).pixels


class Plugin(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.psf = wfpsf.galsim.WfpsfPSF(7, "H158", 100, 200, 1500.0)

    def assertClose(self, found, expected, tolerance):
        self.assertLess(np.abs(found - expected).max() / expected.max(), tolerance)

    def test_drawn_as_by_wfpsf(self):
        for offset in ((0, 0), (0.3, -0.2)):
            self.assertClose(draw(self.psf, offset=offset), stamp(offset=offset), TOLERANCE)

    def test_k_space(self):
        self.assertAlmostEqual(self.psf.kValue(0, 0), 1, 12)
        with wfpsf.PSF.in_band(wfpsf.Instrument("roman-c9"), "H158", 7, 100, 200, 1500) as psf:
            otf = wfpsf.OTF(psf, eps=1e-4)
        expected = otf(3.0 / (2 * np.pi), -5.0 / (2 * np.pi), response="diffraction")
        self.assertAlmostEqual(self.psf.kValue(3.0, -5.0), expected, 5)
        self.assertAlmostEqual(self.psf.maxk, 2 * np.pi * otf.cutoff, 9)
        self.assertEqual(self.psf.kValue(1.01 * self.psf.maxk, 0), 0)

    def test_folding(self):
        coarse = self.psf.withGSParams(folding_threshold=1e-2)
        self.assertAlmostEqual(coarse.stepk / self.psf.stepk, 2, 9)

    def test_flux(self):
        bright = wfpsf.galsim.WfpsfPSF(7, "H158", 100, 200, 1500.0, flux=5)
        self.assertEqual(bright.flux, 5)
        np.testing.assert_allclose(draw(bright), 5 * draw(self.psf), rtol=1e-6, atol=1e-9)
        self.assertAlmostEqual(bright.max_sb, 5 * self.psf.max_sb)

    def test_centroid(self):
        tilted = wfpsf.galsim.WfpsfPSF(7, "H158", 100, 200, 1500.0, zernikes=[0, 0.1, 0.05])
        shift = tilted.centroid.x - self.psf.centroid.x, tilted.centroid.y - self.psf.centroid.y
        # A wave rms of Z_2 over the radius R is 2 waves across it.
        arcsec = 0.1 * 2 * 1293e-9 / (2.36 / 2) * 206264.8
        self.assertAlmostEqual(abs(shift[0]) / arcsec, 1, 1)
        self.assertAlmostEqual(abs(shift[1]) / arcsec, 0.5, 1)

    def test_blur(self):
        blur = {"jitter_xx": 2e-4, "jitter_xy": 1e-4, "jitter_yy": 3e-4, "charge_diffusion": 0.2}
        psf = wfpsf.galsim.WfpsfPSF(7, "H158", 100, 200, 1500.0, **blur)
        self.assertClose(draw(psf), stamp(**blur), TOLERANCE)

    def test_objects_are_values(self):
        same = wfpsf.galsim.WfpsfPSF(7, "H158", 100, 200, 1500)
        other = wfpsf.galsim.WfpsfPSF(7, "H158", 101, 200, 1500)
        coloured = wfpsf.galsim.WfpsfPSF(7, "H158", 1, 2, sed=([1000, 2000], [1, 2]),
                                         zernikes=[0, 0, 0, 0.01], eps=1e-3)
        self.assertEqual(self.psf, same)
        self.assertEqual(hash(self.psf), hash(same))
        self.assertNotEqual(self.psf, other)
        for psf in (self.psf, coloured):
            self.assertEqual(pickle.loads(pickle.dumps(psf)), psf)
            self.assertEqual(copy.deepcopy(psf), psf)
            self.assertEqual(eval(repr(psf)), psf)
        self.assertIn("7, 'H158'", str(self.psf))

    def test_errors_come_at_once(self):
        with self.assertRaises(wfpsf.WfpsfError):
            wfpsf.galsim.WfpsfPSF(19, "H158", 100, 200)
        with self.assertRaises(TypeError):
            wfpsf.galsim.WfpsfPSF(1, "H158", 100, 200, colour=1)

    def test_getPSF(self):
        # GalSim's positions count from (1, 1).
        position = galsim.PositionD(101, 201)
        psf = wfpsf.galsim.getPSF(7, "H158", SCA_pos=position, wavelength=1500.0)
        self.assertEqual(psf, self.psf)
        aberrated = wfpsf.galsim.getPSF(7, "H158", SCA_pos=position, wavelength=1500.0, eps=1e-4,
                                        extra_aberrations=[9, 9, 9, 9, 0.05])
        self.assertClose(draw(aberrated), stamp(zernikes=[0, 0, 0, 0.05]), 1e-3)
        coloured = wfpsf.galsim.getPSF(7, "H158", SCA_pos=position, eps=1e-3)
        self.assertEqual(coloured._recipe.sed, ((1.0, 1e5), (1.0, 1.0)))
        red = wfpsf.galsim.getPSF(7, "H158", sed=wfpsf.SED.power_law(3), eps=1e-3)
        self.assertGreater(red.stepk, 0)
        self.assertLess(red.max_sb, wfpsf.galsim.getPSF(7, "H158", eps=1e-3).max_sb)
        self.assertEqual((red._recipe.x, red._recipe.y), (2043.5, 2043.5))
        with self.assertRaises(TypeError):
            wfpsf.galsim.getPSF(7, "H158", wavelength=1500.0, sed=wfpsf.SED.power_law(3))

    def test_wcs(self):
        # A quarter turn of the sky: what was along x on the detector lies along y.
        turned = wfpsf.galsim.getPSF(7, "H158", SCA_pos=galsim.PositionD(101, 201),
                                     wavelength=1500.0,
                                     wcs=galsim.JacobianWCS(0, -SCALE, SCALE, 0))
        expected = stamp()
        self.assertClose(draw(turned), np.rot90(expected, -1), TOLERANCE)
        self.assertGreater(np.abs(draw(turned) - expected).max() / expected.max(), 1e-3)

    def test_frames(self):
        science, pupil = (wfpsf.galsim.WfpsfPSF(7, "H158", 100, 200, 1500.0, frame=frame)
                          for frame in (0, 1))
        np.testing.assert_allclose(draw(pupil), draw(science)[::-1], atol=1e-5)

    def test_config(self):
        field = {"type": "WfpsfPSF", "SCA": 7, "bandpass": "H158", "wavelength": 1500.0,
                 "frame": 1}
        psf, safe = galsim.config.BuildGSObject({"psf": dict(field)}, "psf")
        self.assertEqual(psf, wfpsf.galsim.getPSF(7, "H158", wavelength=1500.0, frame=1))
        self.assertFalse(safe)
        base = {"psf": dict(field, use_SCA_pos=True, extra_aberrations=[0.05]),
                "image_pos": galsim.PositionD(101, 201)}
        psf, _ = galsim.config.BuildGSObject(base, "psf", base)
        self.assertEqual(psf, wfpsf.galsim.WfpsfPSF(7, "H158", 100, 200, 1500.0, frame=1,
                                                    zernikes=[0, 0, 0, 0.05]))
        with self.assertRaises(Exception):
            galsim.config.BuildGSObject({"psf": {"type": "WfpsfPSF", "SCA": 7}}, "psf")
