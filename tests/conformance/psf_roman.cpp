// SPDX-License-Identifier: GPL-3.0-or-later
// Roman's PSFs against plain sums over the published masks (psf_c9/, rows `fullmask`): the fitted
// geometry in the peer's frame and field rule, and the masks themselves. (The EXACT stamps are sums
// over points, one a binned cell of 4.7 mm; here a mask's pixels are squares.)
#include "csv.hpp"
#include "handles.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace {

constexpr double mask_scale_m = 1.17978731902147e-3;

Instrument make_roman() {
    wfpsf_instrument *instrument = nullptr;
    require(wfpsf_instrument_create("roman-c9", &instrument));
    return Instrument(instrument);
}

Options peer_options() {
    Options options = make_options();
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_EPS, 1e-10));
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_PSF_RADIUS, 17));
    require(wfpsf_options_set_integer(options.get(), WFPSF_OPTION_FRAME, 1));
    require(wfpsf_options_set_integer(options.get(), WFPSF_OPTION_FIELD_RULE, 1));
    return options;
}

std::string key_of(const Row &row) {
    std::string key = row.text("sca");
    key += row.text("band");
    key += row.text("position");
    return key;
}

// Transmissions of the mask that a band sees through.
Pixels read_mask(int sca, const std::string &band) {
    char file[80];
    std::snprintf(file, sizeof file, "instrument/pupil_c9/RST_WIM_Filter_%s_SCA_%d.fits.gz",
                  band == "F184" ? "F184" : "skinny", sca);
    Pixels mask = read_fits(file);
    for (double &pixel : mask.data)
        pixel /= 255;
    return mask;
}

// The PSF of a mask with the aberrations of a row of psf_aberrations.csv.
Psf make_masked(const Row &aberrations, const Pixels &mask) {
    const Instrument roman = make_roman();
    const Options options = peer_options();
    std::vector<double> own(22), extra(22);
    require(wfpsf_instrument_zernikes(roman.get(), aberrations.integer("sca"), 22, own.data(),
                                      nullptr));
    for (size_t j = 4; j <= 22; ++j) {
        char column[8];
        std::snprintf(column, sizeof column, "z%zu", j);
        extra[j - 1] = aberrations.number(column) - own[j - 1];
    }
    require(wfpsf_options_set_zernikes(options.get(), 22, extra.data()));
    wfpsf_psf *psf = nullptr;
    require(wfpsf_psf_create_from_mask(roman.get(), mask.image.get(), mask_scale_m, 1023.5, 1023.5,
                                       aberrations.integer("sca"), aberrations.number("lam_nm"),
                                       options.get(), &psf));
    return Psf(psf);
}

Pixels draw(const Psf &psf, int side, int oversampling) {
    Pixels stamp(side, side, oversampling);
    require(wfpsf_psf_draw(psf.get(), (side - 1) / 2.0, (side - 1) / 2.0, 1, nullptr,
                           stamp.image.get()));
    return stamp;
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
        expect_moments(make_masked(row, mask), measured, 1e-6, 1e-6);
    });
}

} // namespace
