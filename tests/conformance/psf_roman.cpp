// SPDX-License-Identifier: GPL-3.0-or-later
// Roman's PSFs against plain sums over the published masks (psf_c9/, rows `fullmask`): the fitted
// geometry in the peer's frame and field rule, and the masks themselves, their pixels squares.
#include "roman_masks.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <string>

namespace {

std::string key_of(const Row &row) {
    std::string key = row.text("sca");
    key += row.text("band");
    key += row.text("position");
    return key;
}

void expect_moments(const Psf &psf, const Row &row, double sigma_tolerance, double e_tolerance) {
    const Options options = make_options();
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_MOMENTS_TOLERANCE, 1e-10));
    const Ellipse m = measure(draw(psf, 129, 4), options.get());
    EXPECT_NEAR(m.sigma / row.number("sigma_pix"), 1, sigma_tolerance);
    EXPECT_NEAR(m.e1, row.number("e1"), e_tolerance);
    EXPECT_NEAR(m.e2, row.number("e2"), e_tolerance);
}

// Calls `check` with the row of the aberrations and that of the moments of every unbinned case.
template <class Check> void for_every_case(Check check) {
    const Table aberrations("psf_c9/psf_aberrations.csv"), moments("psf_c9/psf_moments.csv");
    std::map<std::string, const Row *> measured;
    for (const Row &row : moments)
        if (row.text("source") == "fullmask" && row.text("image") == "over4")
            measured[key_of(row)] = &row;
    for (const Row &row : aberrations) {
        SCOPED_TRACE(key_of(row));
        ASSERT_TRUE(measured.count(key_of(row)));
        check(row, *measured[key_of(row)]);
    }
}

// What the fit of the geometry is worth, and half a mask pixel between the two axes.
TEST(Roman, FittedGeometryMeetsTheMasks) {
    const Instrument roman = make_roman();
    const Options options = peer_options();
    for_every_case([&](const Row &row, const Row &measured) {
        wfpsf_psf *psf = nullptr;
        require(wfpsf_psf_create_in_band(roman.get(), row.text("band").c_str(), row.integer("sca"),
                                         row.number("xpix") - 1, row.number("ypix") - 1,
                                         row.number("lam_nm"), options.get(), &psf));
        expect_moments(Psf(psf), measured, 2e-4, 2e-4);
    });
}

TEST(Roman, MasksMeetTheirPlainSums) {
    for_every_case([](const Row &row, const Row &measured) {
        const Pixels mask = read_mask(row.integer("sca"), row.text("band"));
        const Psf psf = make_masked(row, {mask, mask_scale_m, 1023.5, 1023.5}, row.number("lam_nm"),
                                    peer_options());
        expect_moments(psf, measured, 1e-6, 1e-6);
    });
}

} // namespace
