// SPDX-License-Identifier: GPL-3.0-or-later
#include "expect_failure.hpp"
#include "instrument/instrument.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace wfpsf {
namespace {

const Instrument &c5() {
    return Instrument::get("wfirst-afta-c5");
}

TEST(Instrument, IsFoundByItsName) {
    EXPECT_STREQ(c5().name, "wfirst-afta-c5");
    EXPECT_EQ(&c5(), &Instrument::get("wfirst-afta-c5"));
    ASSERT_EQ(instruments().size(), 2u);
    EXPECT_EQ(&instruments()[0], &c5());
}

TEST(Instrument, HasThePublishedConstants) {
    ASSERT_EQ(c5().constants.size(), 24u);
    EXPECT_EQ(c5().constant("nonlinearity_beta").value, -3.57e-7);
    EXPECT_STREQ(c5().constant("nonlinearity_beta").unit, "1/e-");
    EXPECT_EQ(c5().constant("reciprocity_alpha").value, 0.0065);
    EXPECT_EQ(c5().constant("exptime").value, 168.1);
    EXPECT_EQ(c5().constant("n_pix").value, 4088);
    EXPECT_EQ(c5().constant("theta_fpa").value, 32.5);
    double sum = 0;
    for (const Constant &constant : c5().constants)
        sum += constant.value;
    EXPECT_NEAR(sum, 28461.865499643, 1e-10);

    EXPECT_EQ(c5().sca_count(), 18);
    EXPECT_EQ(c5().diameter_m(), 2.36);
    EXPECT_EQ(c5().obscuration(), 0.3);
    EXPECT_EQ(c5().pixel_scale_arcsec(), 0.11);
    EXPECT_EQ(c5().reference_wavelength_nm(), 1293);
}

TEST(Instrument, HasThePublishedThermalBackgrounds) {
    for (const char *name : {"Z087", "Y106", "J129", "W149"})
        EXPECT_EQ(c5().band(name).thermal_background, 0.06) << name;
    EXPECT_EQ(c5().band("H158").thermal_background, 0.08);
    EXPECT_EQ(c5().band("F184").thermal_background, 1.18);
}

TEST(Instrument, HasThePublishedZernikes) {
    // Sums over the SCAs, Noll j = 1..11, and two sums that tell rows and columns apart.
    constexpr double sums[] = {-0.86550965, -0.36390975, 1.15647287, -0.37717956,
                               -0.63355811, -0.39754583, 0.43823423, -0.14732256,
                               0.01794517,  0.09741404,  0.10499151};
    double sum[11] = {}, weighted = 0, squares = 0;
    for (int sca = 1; sca <= 18; ++sca) {
        const auto z = c5().zernikes(sca);
        ASSERT_EQ(z.size(), 11u);
        for (size_t i = 0; i < z.size(); ++i) {
            sum[i] += z[i];
            weighted += z[i] * sca * static_cast<double>(i + 1);
            squares += z[i] * z[i];
        }
    }
    for (size_t i = 0; i < 11; ++i)
        EXPECT_NEAR(sum[i], sums[i], 1e-15) << i;
    EXPECT_NEAR(weighted, -7.77849449, 1e-14);
    EXPECT_NEAR(squares, 0.22616005899690259, 1e-15);
    EXPECT_EQ(c5().zernikes(7)[3], -0.032239);
    EXPECT_EQ(c5().zernikes(18)[10], 0.005359);
}

TEST(Instrument, HasOneFieldPointInTheMiddleOfEachDetector) {
    for (int sca = 1; sca <= 18; ++sca) {
        const auto points = c5().field_points(sca);
        ASSERT_EQ(points.size(), 1u);
        EXPECT_EQ(points[0].x_pix, (c5().constant("n_pix").value - 1) / 2);
        EXPECT_EQ(c5().constant("n_pix").value, static_cast<double>(c5().pixels.x));
        EXPECT_EQ(points[0].y_pix, (c5().constant("n_pix").value - 1) / 2);
        EXPECT_EQ(points[0].zernikes.data(), c5().zernikes(sca).data());
    }
}

TEST(Instrument, KeepsTheIpcKernelAsAConvolution) {
    // Published as raw weights of the neighbour at (x + dx, y + dy); rows dy = -1, 0, +1.
    constexpr double raw[3][3] = {{0.001269938, 0.015399776, 0.001199862},
                                  {0.013800177, 1.0, 0.015600367},
                                  {0.001270391, 0.016129619, 0.001200137}};
    double raw_sum = 0, sum = 0;
    for (const auto &row : raw)
        for (const double weight : row)
            raw_sum += weight;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const double tap = (*c5().ipc_kernel)[static_cast<size_t>(3 * (dy + 1) + dx + 1)];
            EXPECT_NEAR(tap, raw[1 - dy][1 - dx] / raw_sum, 1e-15) << dx << ' ' << dy;
            sum += tap;
        }
    EXPECT_NEAR(sum, 1, 1e-15);
}

TEST(Instrument, NamesTheUnknownNameAndThoseItKnows) {
    expect_failure([] { Instrument::get("roman-c8"); }, WFPSF_ERROR_UNKNOWN_NAME,
                   "instrument = \"roman-c8\": must be one of wfirst-afta-c5, roman-c9");
    expect_failure([] { Instrument::get(""); }, WFPSF_ERROR_UNKNOWN_NAME, "instrument = \"\": ");
    expect_failure([] { Instrument::get({}); }, WFPSF_ERROR_UNKNOWN_NAME, "instrument = \"\": ");
    expect_failure([] { c5().band("W146"); }, WFPSF_ERROR_UNKNOWN_NAME,
                   "band = \"W146\": must be one of Z087, Y106, J129, W149, H158, F184");
    expect_failure([] { c5().band("J129 "); }, WFPSF_ERROR_UNKNOWN_NAME, "band = \"J129 \"");
    expect_failure([] { c5().constant("Gain"); }, WFPSF_ERROR_UNKNOWN_NAME,
                   "constant = \"Gain\": must be one of gain, pixel_scale, diameter, ");
    expect_failure([] { c5().pupil(1, "K213"); }, WFPSF_ERROR_UNKNOWN_NAME, "band = \"K213\"");
    const std::string endless(100000, 'x');
    expect_failure([&] { c5().band(endless); }, WFPSF_ERROR_UNKNOWN_NAME,
                   "band = \"" + endless.substr(0, 64) + "\": must be one of Z087");
}

TEST(Instrument, NamesTheScaThatDoesNotExist) {
    expect_failure([] { c5().zernikes(0); }, WFPSF_ERROR_RANGE, "sca = 0: must be 1..18");
    for (const int sca :
         {0, 19, -1, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
        const std::string line = "sca = " + std::to_string(sca) + ": must be 1..18";
        expect_failure([=] { c5().zernikes(sca); }, WFPSF_ERROR_RANGE, line);
        expect_failure([=] { c5().field_points(sca); }, WFPSF_ERROR_RANGE, line);
        expect_failure([=] { c5().pupil(sca, "J129"); }, WFPSF_ERROR_RANGE, line);
    }
}

} // namespace
} // namespace wfpsf
