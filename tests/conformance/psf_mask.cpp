// SPDX-License-Identifier: GPL-3.0-or-later
// The published mask, read from FITS, every pixel a square, against the converged truth.
#include "psf_truth.hpp"

#include <gtest/gtest.h>

namespace {

// The farthest lit pixel lies on the rim of the primary, 1.18 m from the axis.
constexpr double mask_scale_m = 1.18 / 849.0400461697905, axis = 2048;

Psf make_masked(int32_t sca, double wavelength_nm) {
    static const Pixels mask =
        read_fits("instrument/pupil_c5/WFIRST-AFTA_Pupil_Mask_C5_20141010_PLT.fits.gz");
    const Instrument c5 = make_c5();
    wfpsf_psf *psf = nullptr;
    require(wfpsf_psf_create_from_mask(c5.get(), mask.image.get(), mask_scale_m, axis, axis, sca,
                                       wavelength_nm, precise_options(true).get(), &psf));
    return Psf(psf);
}

TEST(Mask, Truth) {
    expect_truth(true, make_masked, {.stamp = 1e-6, .sigma = 1e-6, .e = 1e-6, .sensitivity = 1e-4});
}

TEST(Mask, Stamps) {
    expect_stamps(make_masked, 1e-6);
}

} // namespace
