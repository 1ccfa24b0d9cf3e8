# SPDX-License-Identifier: GPL-3.0-or-later
"""Loading, handles, errors, warnings, options, doctests."""
import ctypes
import doctest
import gc
import importlib
import os
import pkgutil
import subprocess
import sys
import threading
import unittest
import warnings

import numpy as np
import wfpsf
from support import gaussian, status_of
from wfpsf import _chain, _ipc, _moments, _observation, _psf, _scene, _size, _study


def load_tests(loader, tests, pattern):
    for module in pkgutil.iter_modules(wfpsf.__path__):
        if module.name != "galsim":
            tests.addTests(doctest.DocTestSuite(importlib.import_module("wfpsf." + module.name)))
    tests.addTests(doctest.DocTestSuite(wfpsf))
    return tests


class Loading(unittest.TestCase):
    def run_python(self, code, **environment):
        return subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True,
                              env=dict(os.environ, **environment))

    def test_version(self):
        self.assertEqual(wfpsf.__version__, wfpsf.constants.VERSION)

    def test_a_library_that_is_not_there(self):
        result = self.run_python("import wfpsf", WFPSF_LIBRARY="/no/such.so")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("WFPSF_LIBRARY can name another: /no/such.so", result.stdout)

    def test_another_abi(self):
        with self.assertRaises(wfpsf.WfpsfError) as caught:
            wfpsf.check(wfpsf.library.wfpsf_abi_check(wfpsf.constants.WFPSF_ABI_NUMBER + 1))
        self.assertEqual(caught.exception.name, "WFPSF_ERROR_ABI")

    def test_names_are_all_there(self):
        self.assertEqual([name for name in wfpsf.__all__ if not hasattr(wfpsf, name)], [])


class Handles(unittest.TestCase):
    def test_closing(self):
        instrument = wfpsf.Instrument()
        self.assertFalse(instrument.closed)
        instrument.close()
        instrument.close()
        self.assertTrue(instrument.closed)
        with self.assertRaisesRegex(ctypes.ArgumentError, "the Instrument has been closed"):
            instrument.bands
        with self.assertRaises(ZeroDivisionError), wfpsf.Instrument() as kept:
            1 / 0
        self.assertTrue(kept.closed)
        self.assertEqual(repr(kept), "<Instrument, closed>")

    def test_collection(self):
        instrument = wfpsf.Instrument()
        for _ in range(20):
            wfpsf.PSF(instrument, 1, 1500, eps=1e-2, psf_radius=1).draw(3, 3)
        image = wfpsf.Image(np.ones((300, 300)))
        gc.collect()
        _ = [np.full((300, 300), np.nan) for _ in range(10)]
        self.assertEqual(wfpsf.unweighted_moments(image).flux, 300**2)
        self.assertEqual(len(instrument.bands), 6)

    def test_wrong_kinds(self):
        instrument = wfpsf.Instrument()
        with self.assertRaisesRegex(ctypes.ArgumentError, "LP_wfpsf_psf"):
            wfpsf.OTF(instrument)
        with self.assertRaises(ctypes.ArgumentError):
            wfpsf.IPCKernel(0.01).then(instrument)
        with self.assertRaises(TypeError):
            wfpsf.psfs(instrument, "J129", 7, 0, 0, [wfpsf.SED.power_law(0), instrument])
        self.assertEqual(status_of(lambda: wfpsf.psfs(instrument, "J129", 7, 0, 0, [])),
                         "ERROR_SIZE")

    def test_no_copies(self):
        import copy
        import pickle
        for action in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaisesRegex(TypeError, "cannot pickle"):
                action(wfpsf.IPCKernel(0.01))

    def test_threads(self):
        psf = wfpsf.PSF(wfpsf.Instrument(), 7, 1292, eps=1e-5, psf_radius=8)
        expected, stamps, texts = psf.draw(15, 17).pixels, [None] * 8, [None] * 8

        def work(k):
            stamps[k] = psf.draw(15, 17).pixels
            try:
                wfpsf.Instrument("number %d" % k)
            except wfpsf.WfpsfError as failure:
                texts[k] = failure.message

        threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for k in range(8):
            np.testing.assert_array_equal(stamps[k], expected)
            self.assertIn("number %d" % k, texts[k])


class Errors(unittest.TestCase):
    def test_error(self):
        with self.assertRaises(wfpsf.WfpsfError) as caught:
            wfpsf.Instrument("hubble")
        self.assertEqual(caught.exception.status, wfpsf.constants.WFPSF_ERROR_UNKNOWN_NAME)
        self.assertIn("hubble", caught.exception.message)
        self.assertIn("WFPSF_ERROR_UNKNOWN_NAME", str(caught.exception))

    def test_warning(self):
        image = gaussian(float, 40, 40, 20, 20, 4, 0, 4)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            wfpsf.adaptive_moments(image, moments_max_passes=1)
        self.assertEqual([warning.category for warning in caught], [wfpsf.WfpsfWarning])
        self.assertIn("WFPSF_WARNING_NOT_CONVERGED", str(caught[0].message))
        self.assertEqual(caught[0].filename, __file__)
        quiet = wfpsf.adaptive_moments(image, moments_max_passes=1, strict=False)
        self.assertEqual(quiet.status, wfpsf.constants.WFPSF_WARNING_NOT_CONVERGED)

    def test_warnings_as_errors(self):
        # What was made is owned all the same, and freed.
        owned = []

        class Kernel(wfpsf.IPCKernel):
            def _own(self, pointer):
                owned.append(pointer)
                super()._own(pointer)

        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(wfpsf.WfpsfWarning):
                Kernel._made(lambda out: wfpsf.library.wfpsf_ipc_kernel_create_wfc3(out) or
                             wfpsf.constants.WFPSF_WARNING_NOT_CERTIFIED)
        self.assertEqual(len(owned), 1)

    def test_arguments(self):
        instrument = wfpsf.Instrument()
        with self.assertRaisesRegex(OverflowError, "sca = 4294967303"):
            wfpsf.PSF(instrument, 2**32 + 7, 1292)
        with self.assertRaises(TypeError):
            wfpsf.PSF(instrument, 7.5, 1292)
        with self.assertRaises(TypeError):
            wfpsf.Instrument(None)
        with self.assertRaisesRegex(ValueError, "NUL"):
            wfpsf.Instrument("roman-c9\0")
        with self.assertRaisesRegex(ValueError, "'tabulated', 'paper'"):
            instrument.band("J129", rule="guess")
        self.assertEqual(wfpsf.PSF(instrument, np.int16(7), np.float32(1292)).wavelength_nm, 1292)


class Options(unittest.TestCase):
    def test_descriptions(self):
        known = {option.name: option for option in wfpsf.options()}
        self.assertEqual(known["eps"].default, 1e-6)
        self.assertTrue(known["struts"].integer)
        self.assertIsNone(known["moments_guess_sigma"].default)
        # Every option is taken by some function, and no function takes an unknown one.
        taken = {*_psf.PSF_OPTIONS, *_psf.STAR_OPTIONS, *_psf.DRAW_OPTIONS, *_ipc.APPLY_OPTIONS,
                 *_ipc.CORRECT_OPTIONS, *_chain.CHAIN_OPTIONS, *_moments.MOMENTS_OPTIONS,
                 *_size.SIZE_OPTIONS, *_study.STUDY_OPTIONS, *_observation.OBSERVATION_OPTIONS,
                 *_scene.EXPOSURE_OPTIONS, *_scene.RENDER_OPTIONS, *_scene.TRUTH_OPTIONS,
                 *_scene.MAKE_OPTIONS, "kernel_negative", "kernel_normalise"}
        self.assertEqual(taken, {*known, "zernikes", "opd", "scene_store", "progress"})

    def test_values(self):
        instrument = wfpsf.Instrument()
        with self.assertRaisesRegex(TypeError, "no option moments_tolerance here"):
            wfpsf.PSF(instrument, 7, 1292, moments_tolerance=1e-3)
        self.assertEqual(status_of(lambda: wfpsf.PSF(instrument, 7, 1292, eps=1)), "ERROR_RANGE")
        self.assertEqual(status_of(lambda: wfpsf.PSF(instrument, 7, 1292, eps=np.nan)),
                         "ERROR_NOT_FINITE")
        with self.assertRaises(TypeError):
            wfpsf.PSF(instrument, 7, 1292, struts=0.5)
        self.assertGreaterEqual(
            wfpsf.PSF(instrument, 7, 1292, psf_radius=5, eps=None, struts=True).radius, 5)

    def test_progress(self):
        sed, told = wfpsf.SED.power_law(0), []
        arguments = (wfpsf.Instrument(), "J129", 7, 100, 100)

        def fails(part):
            raise KeyError(part)

        wfpsf.PSF.in_band(*arguments, sed=sed, eps=1e-3, progress=told.append)
        self.assertGreater(len(told), 1)
        self.assertTrue(all(0 <= part <= 1 for part in told))
        self.assertEqual(status_of(lambda: wfpsf.PSF.in_band(
            *arguments, sed=sed, eps=1e-3, progress=lambda part: False)), "ERROR_CANCELLED")
        with self.assertRaises(KeyError):
            wfpsf.PSF.in_band(*arguments, sed=sed, eps=1e-3, progress=fails)
