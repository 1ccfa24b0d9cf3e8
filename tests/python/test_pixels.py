# SPDX-License-Identifier: GPL-3.0-or-later
"""Interpixel capacitance, chains, moments, sizes and the study."""
import os
import tempfile
import unittest

import numpy as np
import wfpsf
from support import gaussian, status_of

ASYMMETRIC = [[0.01, 0.02, 0.03], [0.04, 0.7, 0.05], [0.06, 0.07, 0.02]]


class IPC(unittest.TestCase):
    def test_convolution(self):
        kernel = wfpsf.IPCKernel.from_taps(ASYMMETRIC)
        image = np.random.default_rng(1).normal(size=(7, 9))
        expected = np.zeros_like(image)
        for dy in (-1, 0, 1):
            for dx in (-1, 0, 1):
                for y in range(7):
                    for x in range(9):
                        if 0 <= y - dy < 7 and 0 <= x - dx < 9:
                            expected[y, x] += ASYMMETRIC[dy + 1][dx + 1] * image[y - dy, x - dx]
        np.testing.assert_allclose(kernel.apply(image).pixels, expected, atol=1e-14)
        np.testing.assert_allclose(kernel.apply(image[::-1], out=np.zeros((7, 9))[:, ::-1],
                                                edge="wrap").pixels,
                                   kernel.apply(image[::-1], edge="wrap").pixels, atol=1e-14)
        np.testing.assert_array_equal(kernel.taps(), ASYMMETRIC)
        np.testing.assert_allclose(kernel.self_test(), ASYMMETRIC, atol=1e-16)
        np.testing.assert_allclose(kernel.self_test(ipc_form=1), np.array(ASYMMETRIC)[::-1, ::-1],
                                   atol=1e-16)
        np.testing.assert_array_equal(kernel.flipped().taps(), np.array(ASYMMETRIC)[::-1, ::-1])
        self.assertEqual(kernel.apply(image, edge="valid").shape, (5, 7))

    def test_correction(self):
        kernel = wfpsf.IPCKernel(0.02, 0.002)
        image = wfpsf.Image(np.random.default_rng(1).normal(size=(20, 21)))
        blurred = kernel.apply(image)
        self.assertEqual(blurred.record.applied, ("ipc",))
        self.assertEqual(status_of(lambda: kernel.apply(blurred)), "ERROR_ALREADY_APPLIED")
        corrected = kernel.correct(blurred)
        np.testing.assert_allclose(corrected.image.pixels, image.pixels, atol=1e-13)
        self.assertGreater(corrected.noise_amplification, 1)
        first = kernel.correction().apply(blurred, edge="wrap")
        self.assertEqual(first.record.applied, ("ipc", "ipc_correction"))
        self.assertEqual(kernel.correction(3).taps().shape, (7, 7))

    def test_algebra(self):
        kernel = wfpsf.IPCKernel(0.02, 0.002, 0.001)
        self.assertEqual(kernel.then(kernel).taps().shape, (5, 5))
        properties = kernel.properties()
        self.assertAlmostEqual(properties["sum"], 1, 12)
        self.assertAlmostEqual(kernel.transform(0, 0), 1, 12)
        auto = kernel.autocorrelation().taps()
        self.assertAlmostEqual(auto[2, 2], properties["variance_ratio"], 12)
        variance = kernel.covariance(np.ones((9, 9)), lag_x=1, edge="wrap")
        self.assertAlmostEqual(variance.pixels[4, 4], auto[2, 3], 12)
        self.assertEqual(wfpsf.IPCKernel.wfc3().taps().shape, wfpsf.wfc3_deviations().shape)
        self.assertEqual(wfpsf.IPCKernel.default(wfpsf.Instrument()).taps().shape, (3, 3))
        self.assertEqual(status_of(lambda: wfpsf.IPCKernel(0.3)), "ERROR_KERNEL")

    def test_varying(self):
        image = np.random.default_rng(1).normal(size=(8, 9))
        alike = wfpsf.VaryingIPC.from_maps(np.full((8, 9), 0.02), np.full((8, 9), 0.002))
        about = alike.autocorrelation(4, 3)
        self.assertEqual(about.shape, (5, 5))
        for dy, dx in ((0, 0), (1, 0), (2, -1)):
            noise = alike.covariance(np.ones((8, 9)), dx, dy).pixels
            self.assertAlmostEqual(noise[3, 4], about[2 + dy, 2 + dx], 15)
        kernel = wfpsf.IPCKernel(0.02, 0.002)
        blurred = alike.apply(image)
        np.testing.assert_allclose(blurred.pixels, kernel.apply(image).pixels, atol=1e-14)
        np.testing.assert_allclose(alike.correct(blurred).image.pixels, image, atol=1e-13)
        plane = wfpsf.VaryingIPC.from_polynomials(9, 8, 1, [0.02, 0.01, 0])
        self.assertGreater(plane.at(8, 0).taps()[1, 0], plane.at(0, 0).taps()[1, 0])
        self.assertEqual(plane.weakest().x, 8)
        regions = np.zeros((8, 9))
        regions[:, 5:] = 1
        two = wfpsf.VaryingIPC.from_regions(regions, [kernel, wfpsf.IPCKernel(0.01)])
        np.testing.assert_array_equal(two.at(0, 0).taps(), kernel.taps())
        np.testing.assert_array_equal(two.at(8, 0).taps(), wfpsf.IPCKernel(0.01).taps())
        with self.assertRaises(ValueError):
            wfpsf.VaryingIPC.from_polynomials(9, 8, 2, [0.02])


class Chains(unittest.TestCase):
    def test_steps(self):
        chain = wfpsf.Chain()
        chain.add("background", 100)
        chain.add("capacitance_map", map=np.full((4, 5), 2.0))
        chain.add_ipc(wfpsf.IPCKernel(0.02), edge="wrap")
        self.assertEqual([name for name, _ in chain.steps],
                         ["background", "capacitance_map", "ipc"])
        image = np.zeros((4, 5))
        self.assertEqual(chain.apply(image), (0, 0))
        np.testing.assert_allclose(image, 50, rtol=1e-14)
        with self.assertRaisesRegex(ValueError, "step = 'magic'"):
            chain.add("magic")
        varying = wfpsf.Chain()
        varying.add_ipc(wfpsf.VaryingIPC.from_maps(np.full((4, 5), 0.02)), ipc_form=1)
        varying.apply(image)
        self.assertAlmostEqual(image[2, 2], 50, 12)

    def test_default(self):
        chain = wfpsf.Chain.default(wfpsf.Instrument("roman-c9"), exposure_time=100)
        first, second, other = (wfpsf.zeros((8, 8)) for _ in range(3))
        for image, seed in ((first, 1), (second, 1), (other, 2)):
            image.pixels[:] = 1000
            chain.apply(image, previous=[np.full((8, 8), 1e5)], seed=seed)
        np.testing.assert_array_equal(first.pixels, second.pixels)
        self.assertFalse(np.array_equal(first.pixels, other.pixels))

    def test_noise(self):
        white = wfpsf.add_noise(np.zeros((64, 64)), 2.0, seed=5).pixels
        self.assertAlmostEqual(white.std(), 2, 1)
        smooth = wfpsf.add_noise(np.zeros((64, 64)), 2.0, kernel=wfpsf.IPCKernel(0.05), seed=5)
        self.assertLess(smooth.pixels.std(), white.std())


class Moments(unittest.TestCase):
    def test_adaptive(self):
        for dtype, tolerance in ((np.float64, 1e-9), (np.float32, 1e-5)):
            found = wfpsf.adaptive_moments(gaussian(dtype, 70, 60, 31.2, 33.7, 9, 1, 6))
            for name, value in (("centroid_x", 31.2), ("centroid_y", 33.7), ("mxx", 9),
                                ("mxy", 1), ("myy", 6)):
                self.assertAlmostEqual(getattr(found, name), value, delta=tolerance * 40)
            self.assertAlmostEqual(found.rho4, 2, 5)
            self.assertEqual(found.status, 0)

    def test_failure(self):
        self.assertEqual(status_of(lambda: wfpsf.adaptive_moments(np.zeros((9, 9)))),
                         "ERROR_MOMENTS_FLUX")
        found = wfpsf.adaptive_moments(np.zeros((9, 9)), strict=False)
        self.assertEqual(found.status, wfpsf.constants.WFPSF_ERROR_MOMENTS_FLUX)
        self.assertEqual(status_of(lambda: wfpsf.adaptive_moments(np.zeros((0, 9)), strict=False)
                                   and None), "OK")

    def test_missing(self):
        image = gaussian(float, 40, 40, 20, 19, 9, 1, 8)
        missing = np.zeros_like(image)
        missing[22, 21] = 1
        image[22, 21] = np.nan
        self.assertAlmostEqual(wfpsf.adaptive_moments(image, missing=missing).mxx, 9, 6)

    def test_derivatives(self):
        image = gaussian(float, 40, 40, 20, 19, 9, 1, 8)
        change = gaussian(float, 40, 40, 20, 19, 16, 1, 16)
        slope = wfpsf.moments_derivative(image, change).sigma
        step = 1e-4
        ends = [wfpsf.adaptive_moments(image + sign * step * change).sigma for sign in (1, -1)]
        self.assertAlmostEqual(slope, (ends[0] - ends[1]) / (2 * step), 6)
        influence = wfpsf.moments_influence(image, "sigma")
        self.assertAlmostEqual((influence * change).sum(), slope, 9)
        covariance = wfpsf.moments_covariance(image, ("sigma", "e1"), moments_variance=1e-6)
        self.assertAlmostEqual(covariance[0, 0], 1e-6 * (influence**2).sum(), 12)

    def test_others(self):
        image = gaussian(float, 70, 60, 30, 33, 9, 1, 8)
        self.assertAlmostEqual(wfpsf.unweighted_moments(image).mxx, 9, 6)
        self.assertAlmostEqual(wfpsf.unweighted_moments(image, 31, 33).mxx, 10, 6)
        self.assertAlmostEqual(wfpsf.weighted_moments(image, 30, 33, 9, 1, 8).flux, 0.5, 6)
        sums = wfpsf.moment_sums(image, 30, 33)
        self.assertAlmostEqual(sums[3], 9, 6)
        with self.assertRaises(ValueError):
            wfpsf.moment_sums(image, 30, 33, weight=[1])


class Sizes(unittest.TestCase):
    def test_gaussian(self):
        sigma = 5.0
        image = gaussian(float, 80, 80, 39, 40, sigma**2, 0, sigma**2)
        half = sigma * np.sqrt(2 * np.log(2))
        self.assertAlmostEqual(wfpsf.ee_radius(image, 39, 40).radius, half, 6)
        self.assertAlmostEqual(wfpsf.encircled_energy(image, 39, 40, half).fraction, 0.5, 6)
        self.assertTrue(np.isnan(wfpsf.ee_radius(image, 39, 40, method="pixel_sum").error))
        self.assertAlmostEqual(wfpsf.profile_fwhm(image, 39, 40).fwhm, 2 * half, 5)
        self.assertAlmostEqual(wfpsf.fwhm(image, 39, 40), 2 * half, 0)
        profile, errors = wfpsf.radial_profile(image, 39, 40, [0, half])
        self.assertAlmostEqual(profile[1] / profile[0], 0.5, 6)
        self.assertLess(max(errors), 1e-6)
        self.assertAlmostEqual(wfpsf.ee_radius_derivative(image, image, 39, 40).derivative, 0, 6)
        curved = wfpsf.ee_radius_derivative(image, image, 39, 40, second=image)
        self.assertAlmostEqual(curved.derivative, 0, 6)
        self.assertEqual(status_of(lambda: wfpsf.ee_radius(image, 39, 40, 0.9, size_total_flux=2)),
                         "ERROR_SIZE_NOT_REACHED")


class Study(unittest.TestCase):
    def test_tables(self):
        study = wfpsf.Study(wfpsf.Instrument(), 7)
        sizes = study.table("sizes")
        self.assertEqual(len(sizes["value"]), len(sizes["quantity"]))
        self.assertIsInstance(sizes["quantity"][0], str)
        with tempfile.TemporaryDirectory() as folder:
            study.write_csv(folder)
            self.assertIn("table_sizes.csv", os.listdir(folder))
