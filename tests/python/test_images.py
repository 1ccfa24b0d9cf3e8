# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays without copies, records, FITS files, dithers."""
import os
import tempfile
import unittest

import numpy as np
import wfpsf
from support import status_of


class Arrays(unittest.TestCase):
    def test_strides(self):
        for dtype in (np.float32, np.float64):
            parent = np.arange(120, dtype=dtype).reshape(10, 12)
            for pixels in (parent, parent[2:9, 1:5], parent[::-2, ::-3], parent[3:4],
                           parent[:, 3:4], parent.T, np.asfortranarray(parent),
                           np.zeros((0, 3), dtype),
                           np.broadcast_to(parent[3:4, 3:4], (1, 1))):
                image = wfpsf.Image(pixels)
                self.assertEqual((image.shape, image.dtype), (pixels.shape, pixels.dtype))
                self.assertIs(image.pixels, pixels)
                np.testing.assert_array_equal(image.copy().pixels, pixels)

    def test_writing_through_strides(self):
        parent = np.zeros((20, 20))
        wfpsf.Image(np.ones((10, 10))).copy_to(parent[19::-2, 0:19:2])
        self.assertTrue(np.all(parent[1::2, ::2] == 1))
        self.assertEqual(parent.sum(), 100)

    def test_types_are_converted(self):
        image = wfpsf.Image(np.arange(6.0).reshape(2, 3), oversampling=3)
        other = wfpsf.zeros((2, 3), np.float32)
        image.copy_to(other)
        np.testing.assert_array_equal(other.pixels, image.pixels)
        self.assertEqual(other.record.oversampling, 3)

    def test_what_is_no_image(self):
        for wrong in (np.zeros((3, 3), int), [[1.0]], np.zeros((3, 3), ">f8"),
                      np.zeros((3, 3), complex), np.ma.zeros((3, 3))):
            with self.assertRaises(TypeError):
                wfpsf.Image(wrong)
        for wrong in (np.zeros(3), np.zeros((2, 2, 2)),
                      np.zeros((3, 3), "f8,i4")["f0"], np.broadcast_to(0.0, (3, 0, 3))):
            with self.assertRaises(ValueError):
                wfpsf.Image(wrong)
        overlapping = np.broadcast_to(0.0, (3, 3))
        self.assertEqual(status_of(lambda: wfpsf.Image(overlapping)), "ERROR_SIZE")
        self.assertEqual(status_of(lambda: wfpsf.zeros((3, 3)).copy_to(np.zeros((3, 4)))),
                         "ERROR_SIZE")

    def test_read_only(self):
        pixels = np.ones((5, 5))
        pixels.flags.writeable = False
        self.assertEqual(wfpsf.unweighted_moments(pixels).flux, 25)
        with self.assertRaisesRegex(ValueError, "read-only"):
            wfpsf.IPCKernel(0.01).apply(np.zeros((5, 5)), out=pixels)

    def test_as_array(self):
        image = wfpsf.zeros((2, 3))
        self.assertIs(np.asarray(image), image.pixels)
        self.assertEqual(repr(image), "<Image of shape (2, 3), float64>")

    def test_record(self):
        image = wfpsf.zeros((2, 2), oversampling=4, pixel_scale_arcsec=0.11, applied=["ipc"])
        self.assertEqual(image.record, (4, 0.11, ("ipc",)))
        image.set_record(applied=["ipc_correction", "pixel_response"])
        self.assertEqual(image.record, (4, 0.11, ("pixel_response", "ipc_correction")))
        with self.assertRaises(ValueError):
            image.set_record(applied=["magic"])
        self.assertEqual(status_of(lambda: image.set_record(oversampling=0)), "ERROR_RANGE")


class Files(unittest.TestCase):
    def test_fits(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "image.fits")
            image = wfpsf.Image(np.arange(15, dtype=np.float32).reshape(3, 5), oversampling=2,
                                applied=["ipc"])
            wfpsf.write_fits(path, image)
            with open(path, "rb") as file:
                self.assertIn(b"NAXIS1  =                    5", file.read())
            again = wfpsf.read_fits(path)
            np.testing.assert_array_equal(again.pixels, image.pixels)
            self.assertEqual(again.dtype, np.float32)
            self.assertEqual(again.record, image.record)
            self.assertEqual(wfpsf.read_fits(path, hdu=0, dtype=float).dtype, np.float64)
            self.assertLess(wfpsf.constants.WFPSF_ERROR_FILE_OPEN, 0)
            for hdu in (1, "SCI"):
                self.assertNotEqual(status_of(lambda: wfpsf.read_fits(path, hdu=hdu)), "OK")
            self.assertEqual(status_of(lambda: wfpsf.write_fits(path, image)), "ERROR_FILE_WRITE")
            wfpsf.write_fits(path, image, fits_overwrite=True)
            self.assertEqual(status_of(lambda: wfpsf.read_fits(os.path.join(folder, "none"))),
                             "ERROR_FILE_OPEN")
            taps = np.full((3, 3), 0.01)
            taps[1, 1] = 0.92
            wfpsf.write_fits(path, taps, fits_overwrite=1)
            np.testing.assert_array_equal(wfpsf.IPCKernel.read_fits(path).taps(), taps)


class Dithers(unittest.TestCase):
    def test_interleave(self):
        fine = np.arange(8.0 * 9).reshape(8, 9)
        dx, dy = np.meshgrid(np.arange(3) / 3, np.arange(2) / 2)
        coarse = wfpsf.deinterleave(fine, dx, dy)
        self.assertEqual((len(coarse), len(coarse[0]), coarse[0][0].shape), (2, 3, (4, 3)))
        np.testing.assert_array_equal(wfpsf.interleave(coarse, dx, dy).pixels, fine)
        with self.assertRaisesRegex(ValueError, "one shape"):
            wfpsf.interleave(coarse, dx.T, dy)
        with self.assertRaises(ValueError):
            wfpsf.interleave([], dx, dy)
        self.assertEqual(status_of(lambda: wfpsf.interleave(coarse, dx + 0.1, dy)), "ERROR_RANGE")
