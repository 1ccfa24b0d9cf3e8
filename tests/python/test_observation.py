# SPDX-License-Identifier: GPL-3.0-or-later
"""Observations: positions both ways, headers, the Sun, refusals."""
import unittest

import numpy as np
import wfpsf
from support import status_of


class Observations(unittest.TestCase):
    def setUp(self):
        self.roman = wfpsf.Instrument("roman-c9")
        self.observation = wfpsf.Observation(self.roman, 60, -30, 30)

    def test_positions(self):
        keywords = self.observation.properties(7)
        sky = self.observation.pixel_to_sky(7, 2043, 2043)
        self.assertAlmostEqual(sky.ra_deg, keywords["crval1"], 12)
        self.assertAlmostEqual(keywords["pa_fpa"], 150, 12)
        x = np.array([[0, 4087.0], [np.nan, 5]])
        there = self.observation.pixel_to_sky(7, x, 100)
        back = self.observation.sky_to_pixel(7, *there)
        np.testing.assert_allclose(back.x, x, atol=1e-8)
        found = self.observation.find_sca(*there, with_gaps=True)
        self.assertEqual(found.sca.tolist(), [[7, 7], [0, 7]])
        self.assertEqual(self.observation.bounds(7), (0, 4087, 0, 4087))
        self.assertEqual(self.observation.bounds(7, with_gaps=True), (-169, 4087, -414, 4501))
        slopes = self.observation.jacobian(7, x, 100)
        self.assertEqual(slopes.jacobian.shape, (2, 2, 2, 2))
        self.assertAlmostEqual(abs(np.linalg.det(slopes.jacobian[0, 1])), slopes.pixel_area[0, 1])
        aimed = wfpsf.Observation.aimed(self.roman, 3, 0, 0, 10, 5, 0)
        np.testing.assert_allclose(aimed.pixel_to_sky(3, 0, 0), (10, 5), rtol=1e-12)

    def test_header(self):
        cards = self.observation.fits_header(1)
        self.assertEqual({len(card) for card in cards}, {80})
        self.assertIn("RA---TAN-SIP", cards[1])

    def test_sun(self):
        date = wfpsf.julian_date(2026, 3, 20, 14, 46)
        sun = wfpsf.sun_position(date)
        self.assertTrue(self.roman.pointing_allowed(sun.ra_deg + 90, 0, date).allowed)
        self.assertAlmostEqual(self.roman.best_pa(sun.ra_deg + 90, 0, date), sun.dec_deg)
        there = wfpsf.Observation.on_date(self.roman, sun.ra_deg + 90, 0, date)
        self.assertAlmostEqual(there.properties(1)["pa"], sun.dec_deg)
        self.assertEqual(status_of(lambda: self.roman.best_pa(*sun, date)),
                         "ERROR_SUN_ANGLE")

    def test_refusals(self):
        self.assertEqual(status_of(lambda: wfpsf.Observation(self.roman, 0, 91, 0)),
                         "ERROR_RANGE")
        self.assertEqual(status_of(lambda: self.observation.properties(19)),
                         "ERROR_RANGE")


if __name__ == "__main__":
    unittest.main()
