# SPDX-License-Identifier: GPL-3.0-or-later
"""Instruments, designs, SEDs, PSFs and transfer functions."""
import unittest

import numpy as np
import wfpsf
from support import status_of


class Instruments(unittest.TestCase):
    def test_figures(self):
        c5 = wfpsf.Instrument()
        self.assertEqual(c5.constant("diameter").unit, "m")
        self.assertIn("pixel_scale", c5.constants)
        self.assertEqual(c5.bands[0], "Z087")
        self.assertAlmostEqual(c5.band("J129", rule="paper").effective_nm, 1292.1, 0)
        self.assertEqual(c5.throughput("J129", 100.0), 0)
        self.assertEqual(c5.throughput("J129", [[1200, 1300]]).shape, (1, 2))
        self.assertEqual(c5.zernikes(7).shape, (11,))
        self.assertEqual(status_of(lambda: c5.zernikes(19)), "ERROR_RANGE")
        self.assertEqual(status_of(lambda: c5.band("J130")), "ERROR_UNKNOWN_NAME")

    def test_sky(self):
        roman = wfpsf.Instrument("roman-c9")
        level = roman.sky_level("H158", 90, 40)
        self.assertGreater(level, 0)
        self.assertGreater(roman.sky_background("H158", 90, 40, exposure_time=100,
                                                pixel_area=0.0121), level * 100 * 0.0121)
        self.assertEqual(status_of(lambda: roman.sky_level("H158", 0, 0)), "ERROR_SKY_SUN")

    def test_design(self):
        design = wfpsf.Design()
        self.assertNotEqual(status_of(lambda: wfpsf.Instrument(design)), "OK")
        design.set_telescope(diameter_m=2.4, obscuration=0.3, reference_wavelength_nm=1000)
        design.add_strut(45, 0.05, offset_m=0.1)
        design.set_detector(sca_count=2, pixel_scale_arcsec=0.1, n_pix_x=100, n_pix_y=80)
        design.set_zernikes(1, [0, 0, 0, 0.05])
        self.assertEqual(wfpsf.Instrument(design).zernikes(1)[3], 0.05)
        for sca in (1, 2):
            design.set_field(sca, [50, 0, 99, 0, 99], [40, 0, 0, 79, 79],
                             [[0, 0, 0, value] for value in (0, 0.1, 0.1, 0.1, 0.1)])
        design.add_band("mine", 900, 100, [0, 1, 0])
        mine = wfpsf.Instrument(design)
        self.assertEqual(mine.bands, ["mine"])
        self.assertEqual(mine.band("mine").effective_nm, 1000)
        self.assertGreater(wfpsf.PSF.in_band(mine, "mine", 2, 50, 40).peak,
                           wfpsf.PSF.in_band(mine, "mine", 2, 0, 0).peak)
        with self.assertRaises(ValueError):
            design.set_field(2, [1], [1], [[0]])

    def test_sed(self):
        sed = wfpsf.SED([1000, 1500, 2000], [1, 2, 1], unit="energy")
        shifted = sed.redshifted(1.0).photon_density([2000, 3000])
        np.testing.assert_allclose(shifted[1] / shifted[0], 3, rtol=1e-14)
        self.assertGreater(wfpsf.SED.black_body(5800).photon_density(1000), 0)
        with self.assertRaisesRegex(ValueError, "one length, not 2, 3"):
            wfpsf.SED([1, 2], [1, 2, 3])


class PSFs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.instrument = wfpsf.Instrument()
        cls.psf = wfpsf.PSF(cls.instrument, 7, 1292, eps=1e-5, psf_radius=8)

    def test_properties(self):
        psf = self.psf
        self.assertEqual(psf.wavelength_nm, 1292)
        self.assertTrue(0 < psf.error_estimate <= 1e-5)
        self.assertIn("lit_area_m2", dir(psf))
        with self.assertRaises(AttributeError):
            psf.colour

    def test_draw(self):
        star = self.psf.draw(15, 17, oversampling=3, flux=2)
        self.assertEqual(star.record, (3, self.psf.pixel_scale_arcsec, ("pixel_response",)))
        self.assertEqual(star.shape, (17, 15))
        again = wfpsf.zeros((17, 15), oversampling=3)
        self.assertIs(self.psf.draw_into(again, 7, 8, flux=2), again)
        np.testing.assert_array_equal(star.pixels, again.pixels)
        # x runs along the last axis.
        moved = self.psf.draw(19, 20, x=7 + 4, y=8 + 2, oversampling=3, flux=2).pixels
        np.testing.assert_allclose(moved[2:19, 4:19], star.pixels, atol=3e-5 * star.pixels.max())
        # The same pixels through any strides.
        view = np.zeros((40, 40), np.float32)[33::-2, 28::-2]
        flipped = self.psf.draw_into(wfpsf.Image(view, oversampling=3), 7, 8, flux=2)
        np.testing.assert_array_equal(flipped.pixels, star.pixels.astype(np.float32))
        self.assertEqual(status_of(lambda: self.psf.draw(5, 5, flux=np.nan)), "ERROR_NOT_FINITE")

    def test_roman_frames(self):
        roman = wfpsf.Instrument("roman-c9")
        science, pupil = (wfpsf.PSF.in_band(roman, "H158", 3, 11.5, 3999, frame=frame, eps=1e-5)
                          for frame in (0, 1))
        np.testing.assert_allclose(science.draw(21, 21).pixels, pupil.draw(21, 21).pixels[::-1],
                                   atol=1e-9)
        self.assertAlmostEqual(science.wavelength_nm, roman.band("H158").effective_nm, 9)
        self.assertEqual(status_of(lambda: wfpsf.PSF(roman, 3, 1500)), "ERROR_ARGUMENT")
        self.assertEqual(status_of(lambda: wfpsf.PSF.in_band(roman, "H158", 3, 1, 9999)),
                         "ERROR_RANGE")

    def test_stars(self):
        field = np.zeros((37, 41))
        self.psf.add_stars(field, [11.3, 11.3, -500], np.arange(0, 9, 3), [3, 1, 1e9], threads=2)
        self.psf.add_stars(field, [11.3, 29], (0, 35), np.array([-3, 0], np.float32))
        alone = self.psf.draw(41, 37, x=11.3, y=3).pixels
        y, x = np.mgrid[:37, :41]
        near = (abs(x - 11.3) <= self.psf.radius) & (abs(y - 3) <= self.psf.radius)
        np.testing.assert_allclose(field, near * alone, atol=1e-8)
        with self.assertRaisesRegex(ValueError, "one length"):
            self.psf.add_stars(field, [1, 2], [1, 2], [1])
        with self.assertRaisesRegex(ValueError, "dimensions"):
            self.psf.add_stars(field, 1, 2, 1)

    def test_bright_star(self):
        small = wfpsf.PSF(self.instrument, 7, 1292, psf_radius=3, eps=1e-5)
        memory = small.draw_memory(np.zeros((31, 33)), 16, 15)
        self.assertTrue(0 < memory.least < memory.most)
        image = small.draw(33, 31, memory_limit=memory.least)
        np.testing.assert_allclose(image.pixels, self.psf.draw(33, 31).pixels,
                                   atol=3e-5 * image.pixels.max())
        before = image.pixels.copy()
        small.add_bright_star(image, 16, 15, flux=2)
        np.testing.assert_allclose(image.pixels, 3 * before, rtol=1e-9)
        self.assertEqual(status_of(lambda: small.draw(33, 31, memory_limit=1e4)),
                         "ERROR_MEMORY_LIMIT")

    def test_galaxy(self):
        galaxy = wfpsf.zeros((5, 5), oversampling=4)
        galaxy.pixels[2, 2] = 2
        image = self.psf.convolve_into(np.zeros((17, 15)), galaxy, 6.3, 8.1, flux=3)
        np.testing.assert_allclose(image.pixels, self.psf.draw(15, 17, 6.3, 8.1, flux=6).pixels,
                                   atol=1e-9)
        self.assertEqual(image.record.applied, ("pixel_response",))
        self.assertEqual(status_of(lambda: self.psf.convolve_into(image, self.psf.draw(5, 5), 7,
                                                                  9)), "ERROR_ALREADY_APPLIED")

    def test_mask(self):
        drawn = self.instrument.pupil("J129", 7, 300, 256)
        self.assertEqual(drawn.mask.shape, (256, 300))
        by_mask = wfpsf.PSF.from_mask(self.instrument, 7, 1292, drawn.mask, scale_m=drawn.scale_m,
                                      axis_x=drawn.axis_x, axis_y=drawn.axis_y)
        np.testing.assert_allclose(by_mask.draw(9, 9).pixels, self.psf.draw(9, 9).pixels,
                                   atol=1e-4)

    def test_opd(self):
        # Waves of Z_4, as a coefficient and as a map in metres.
        reference = self.instrument.constant("zemax_wavelength").value
        scale, side, radius = 0.02, 141, self.instrument.constant("diameter").value / 2
        y, x = (np.mgrid[:side, :side] - side // 2) * scale
        defocus = 0.1 * reference * 1e-9 * np.sqrt(3) * (2 * (x**2 + y**2) / radius**2 - 1)
        by_map = wfpsf.PSF(self.instrument, 7, 1292, eps=1e-5,
                           opd=(defocus, scale, side // 2, side // 2))
        by_term = wfpsf.PSF(self.instrument, 7, 1292, eps=1e-5, zernikes=[0, 0, 0, 0.1])
        np.testing.assert_allclose(by_map.draw(9, 9).pixels, by_term.draw(9, 9).pixels, atol=1e-6)

    def test_colours(self):
        seds = [wfpsf.SED.power_law(exponent) for exponent in (-2, 2)]
        blue, red = wfpsf.psfs(self.instrument, "J129", 7, 100, 100, seds, eps=1e-4)
        self.assertLess(blue.wavelength_nm, red.wavelength_nm)
        self.assertGreater(blue.wavelengths, 1)
        again = wfpsf.PSF.in_band(self.instrument, "J129", 7, 100, 100, sed=seds[1], eps=1e-4)
        np.testing.assert_allclose(again.draw(9, 9).pixels, red.draw(9, 9).pixels, atol=1e-5)
        with self.assertRaises(TypeError):
            wfpsf.PSF.in_band(self.instrument, "J129", 7, 1, 1, 1292, seds[0])

    def test_varying(self):
        roman = wfpsf.Instrument("roman-c9")
        varying = wfpsf.VaryingPSF(roman, "H158", 5, eps=1e-3, psf_radius=4)
        self.assertLessEqual(varying.error_estimate, 1e-3)
        exact = wfpsf.PSF.in_band(roman, "H158", 5, 3000, 100, eps=1e-4, psf_radius=4)
        np.testing.assert_allclose(varying.at(3000, 100).draw(9, 9).pixels,
                                   exact.draw(9, 9).pixels, atol=1e-3 * exact.peak)
        field = varying.add_stars(np.zeros((9, 9)), 2996, 96, [4], [4], [1.0])
        np.testing.assert_allclose(field.pixels, exact.draw(9, 9).pixels, atol=1e-3 * exact.peak)

    def test_otf(self):
        psf = wfpsf.PSF(self.instrument, 7, 1292, eps=1e-4)
        otf = wfpsf.OTF(psf, eps=1e-3)
        psf.close()
        self.assertTrue(0 < otf.error_estimate <= 1e-3)
        kx, ky = 0.2 * otf.cutoff, -0.3 * otf.cutoff
        self.assertEqual(otf(0, 0), 1)
        self.assertEqual(otf(-kx, -ky), np.conj(otf(kx, ky)))
        self.assertAlmostEqual(otf(kx, ky), otf(kx, ky, response="diffraction")
                               * np.sinc(0.11 * kx) * np.sinc(0.11 * ky), 12)
        step = otf.cutoff / 7
        wrapped = otf.grid(6, 5, step)
        self.assertEqual(wrapped.shape, (5, 6))
        self.assertEqual(wrapped[2, 1], otf(step, 2 * step))
        self.assertEqual(wrapped[4, 4], otf(-2 * step, -step))
        np.testing.assert_array_equal(np.fft.fftshift(wrapped),
                                      otf.grid(6, 5, step, order="centred"))
        np.testing.assert_array_equal(otf.grid(4, 5, step, order="half")[:, :3], wrapped[:, :3])
        with self.assertRaises(ValueError):
            otf([1, 2], [1])
