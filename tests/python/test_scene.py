# SPDX-License-Identifier: GPL-3.0-or-later
"""Catalogues, scenes and exposures: against PSFs drawn one by one, plans, truth, files, refusals."""
import ctypes
import os
import tempfile
import unittest

import numpy as np
import wfpsf
from support import status_of

X, Y, FLUX = [1010.3, 1040.7, 1e9], [1020.1, 1050.0, 0.0], [5000.0, 300.0, 8.0]
BUDGET = {"scene_noise": 0.01, "scene_variance": 100}


class Scenes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.roman = wfpsf.Instrument("roman-c9")

    def stars(self):
        catalogue = wfpsf.Catalogue("detector", "electrons")
        catalogue.add_stars(X, Y, FLUX)
        return catalogue

    def scene(self, catalogue, image=(64, 64), **options):
        return wfpsf.Scene(self.roman, "J129", 7, catalogue, image, 1000, 1000, **BUDGET, **options)

    def test_rendering(self):
        image, truth, told = wfpsf.zeros((64, 64)), wfpsf.zeros((64, 64)), []
        for x, y, flux in zip(X[:2], Y, FLUX):
            psf = wfpsf.PSF.in_band(self.roman, "J129", 7, x, y, eps=1e-8)
            psf.add_bright_star(truth, x - 1000, y - 1000, flux)
        scene = self.scene(self.stars(), image)
        rendering = scene.render(image, threads=2, progress=told.append)
        self.assertAlmostEqual(scene.error_allowed, 0.1, 12)
        self.assertLess(rendering.error_estimate, scene.error_allowed)
        self.assertEqual(rendering.drawn, 2)
        self.assertGreater(len(told), 0)
        worst = np.abs(image.pixels - truth.pixels).max()
        self.assertTrue(0 < worst <= scene.error_allowed, worst)
        self.assertEqual(image.record.applied, ("pixel_response",))
        again = np.ones((64, 64), dtype=np.float32)
        scene.render(again)
        np.testing.assert_allclose(again - 1, image.pixels, rtol=1e-5, atol=1e-4)
        self.assertEqual(status_of(lambda: scene.render(image, progress=lambda part: False)),
                         "ERROR_CANCELLED")

    def test_store(self):
        store = wfpsf.SceneStore()
        self.assertEqual(store.memory, 0)

        def made(**options):
            catalogue = wfpsf.Catalogue("detector", "electrons")
            catalogue.add_stars([1010.3, 1040.7], [1020.1, 1050], [5000, 300])
            scene = wfpsf.Scene(self.roman, "J129", 7, catalogue, (64, 64), 1000, 1000,
                                scene_noise=0.1, scene_variance=100, **options)
            return scene.render(wfpsf.zeros((64, 64))).exact_psfs

        self.assertGreater(made(scene_store=store, scene_exposures=50), 0)
        held = store.memory
        self.assertGreater(held, 0)
        self.assertEqual(made(scene_store=store, scene_exposures=50), 0)
        self.assertEqual(store.memory, held)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "roman.store")
            store.write(path)
            again = wfpsf.SceneStore()
            again.read(path)
            self.assertEqual(again.memory, held)
            self.assertEqual(made(scene_store=again, scene_exposures=50), 0)
            with self.assertRaises(wfpsf.WfpsfError):
                again.read(os.path.join(folder, "none"))
        self.assertGreater(made(), 0)
        with self.assertRaises((TypeError, ctypes.ArgumentError)):
            made(scene_store="store")

    def test_plan(self):
        scene = self.scene(self.stars())
        self.assertEqual((scene.sources, len(scene.groups)), (3, 3))
        bright, faint = (scene.groups[k] for k in scene.groups_of_sources[:2])
        self.assertEqual((bright["kind"], bright["sources"], bright["colour"]), ("star", 1, 0))
        self.assertIn(bright["drawing"], ("shared", "own"))
        self.assertEqual((bright["flux_from"], faint["flux_from"]), (4096, 256))
        self.assertGreater(bright["radius"], faint["radius"])
        self.assertIn("3 sources", str(scene))

    def test_truth(self):
        scene, kernel = self.scene(self.stars()), wfpsf.IPCKernel(0.02, 0.002)
        truth = scene.truth([1, 0], kernel)
        np.testing.assert_array_equal(truth["position_x"], [X[1], X[0]])
        np.testing.assert_array_equal(truth["flux"], [FLUX[1], FLUX[0]])
        np.testing.assert_array_equal(truth["group"], scene.groups_of_sources[[1, 0]])
        # The star's moments by other means.
        samples = 4
        psf = wfpsf.PSF.in_band(self.roman, "J129", 7, X[0], Y[0], eps=1e-8)
        star = psf.draw(64 * samples, 64 * samples, oversampling=samples)
        centre = (64 * samples - 1) / 2
        for image, prefix in ((star, ""), (kernel.apply(star), "ipc_")):
            m = wfpsf.adaptive_moments(image)
            self.assertAlmostEqual(truth[prefix + "sigma"][1], m.sigma / samples, 4)
            self.assertAlmostEqual(truth[prefix + "e1"][1], m.e1, 4)
            self.assertAlmostEqual(truth[prefix + "centroid_x"][1] - X[0],
                                   (m.centroid_x - centre) / samples, 4)
        without = scene.truth()
        self.assertEqual(without["sigma"][:2].tolist(), truth["sigma"][[1, 0]].tolist())
        self.assertTrue(np.isnan(without["ipc_sigma"]).all())
        self.assertEqual(scene.truth([])["sigma"].shape, (0,))
        self.assertEqual(status_of(lambda: scene.truth([3])), "ERROR_RANGE")
        with self.assertRaises(TypeError):
            scene.truth([0.5])

    def test_galaxies_and_colours(self):
        catalogue = wfpsf.Catalogue("detector", "electrons")
        self.assertEqual(catalogue.add_colour(1300), 0)
        self.assertEqual(catalogue.add_colour(sed=wfpsf.SED.black_body(5000)), 1)
        catalogue.add_galaxies([1016.0, 1046.0], [1016, 1046], [300, 600], [1, 0],
                               sersic_index=[0.5, 1], half_light_radius_arcsec=[0.3, 0.3],
                               e1=[0.3, 0])
        catalogue.add_stars([1060], [1000], [100], 1)
        self.assertEqual(len(catalogue), 3)
        scene = self.scene(catalogue)
        galaxy = scene.groups[scene.groups_of_sources[0]]
        self.assertEqual((galaxy["kind"], galaxy["drawing"], galaxy["colour"]),
                         ("galaxy", "fourier", 1))
        self.assertEqual(scene.groups[scene.groups_of_sources[2]]["colour"], 1)
        image = wfpsf.zeros((64, 64))
        self.assertGreater(scene.render(image).time_galaxies, 0)
        self.assertAlmostEqual(image.pixels[4:, 4:].sum() / 900, 1, 1)
        long, round_one = (wfpsf.adaptive_moments(image.pixels[k:k + 24, k:k + 24])
                           for k in (4, 34))
        self.assertGreater(long.e1, 0.2)
        self.assertLess(abs(round_one.e1), 0.1)
        self.assertEqual(status_of(lambda: catalogue.add_stars([1], [1], [1], [2])), "ERROR_RANGE")
        with self.assertRaisesRegex(ValueError, "colour has 2 elements for 1 sources"):
            catalogue.add_stars([1], [1], [1], [0, 0])
        with self.assertRaisesRegex(OverflowError, "colour"):
            catalogue.add_stars([1], [1], [1], [2**32])

    def test_sky(self):
        observation = wfpsf.Observation(self.roman, 60, -30, 30)
        sky = observation.pixel_to_sky(7, [1020, 1031], [1010, 1040])
        catalogue = wfpsf.Catalogue("sky", "ab_magnitude")
        catalogue.add_stars(*sky, [20, 22.5])
        scene = self.scene(catalogue, observation=observation, exposure_time=100)
        truth = scene.truth()
        np.testing.assert_allclose(truth["position_x"], [1020, 1031], atol=1e-7)
        rate = self.roman.ab_zero_rate("J129")
        self.assertAlmostEqual(2.5 * np.log10(rate), 26.4, delta=0.2)
        np.testing.assert_allclose(truth["flux"], 100 * rate * 10**(-0.4 * np.array([20, 22.5])))

    def test_refusals(self):
        catalogue = wfpsf.Catalogue("sky", "electrons")
        self.assertEqual(status_of(lambda: self.scene(catalogue)), "ERROR_ARGUMENT")
        self.assertEqual(status_of(lambda: catalogue.add_stars([0], [91], [1])), "ERROR_RANGE")
        self.assertEqual(status_of(lambda: self.roman.ab_zero_rate("X1")), "ERROR_UNKNOWN_NAME")
        with self.assertRaisesRegex(ValueError, "'detector', 'sky'"):
            wfpsf.Catalogue("pixels", "electrons")
        with self.assertRaisesRegex(TypeError, "no option eps here"):
            self.scene(catalogue, eps=1e-3)
        with self.assertRaisesRegex(ValueError, "one length"):
            catalogue.add_stars([0, 1], [1], [1])
        scene = self.scene(self.stars())
        self.assertEqual(status_of(lambda: scene.render(np.zeros((32, 64)))), "ERROR_SIZE")


class Exposures(unittest.TestCase):
    def test_files(self):
        roman = wfpsf.Instrument("roman-c9")
        observation = wfpsf.Observation(roman, 60, -30, 30)
        catalogue = wfpsf.Catalogue("sky", "electrons")
        sky = observation.pixel_to_sky(3, 2000, 1000)
        catalogue.add_stars([sky.ra_deg], [sky.dec_deg], [1e5])
        chain = wfpsf.Chain()
        chain.add("gain", 2.0)
        exposure = wfpsf.Exposure(roman, observation, "J129", catalogue, chain, stream=12,
                                  scene_background=50)
        with tempfile.TemporaryDirectory() as folder:
            path = exposure.path(folder, 3)
            self.assertEqual(path, os.path.join(folder, "exposure_00012_sca03.fits"))
            self.assertTrue(exposure.make(3, folder, threads=2))
            self.assertFalse(exposure.make(3, folder))
            self.assertEqual(os.listdir(folder), [os.path.basename(path)])
            pixels = wfpsf.read_fits(path).pixels
            self.assertEqual(pixels.shape, (4088, 4088))
            self.assertAlmostEqual(pixels[3000, 50], 25, 3)
            self.assertEqual(np.unravel_index(pixels.argmax(), pixels.shape), (1000, 2000))
            other = wfpsf.Exposure(roman, observation, "J129", catalogue, stream=12)
            self.assertEqual(status_of(lambda: other.make(3, folder)), "ERROR_FILE_WRITE")
            self.assertTrue(other.make(3, folder, fits_overwrite=1))
        self.assertEqual(status_of(lambda: exposure.path("folder", 19)), "ERROR_RANGE")


if __name__ == "__main__":
    unittest.main()
