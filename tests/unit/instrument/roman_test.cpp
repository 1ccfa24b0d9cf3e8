// SPDX-License-Identifier: GPL-3.0-or-later
#include "expect_failure.hpp"
#include "instrument/instrument.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace wfpsf {
namespace {

const Instrument &c9() {
    return Instrument::get("roman-c9");
}
const RomanPupil &pupil(int sca, const char *band) {
    return std::get<RomanPupil>(c9().pupil(sca, band));
}

TEST(Roman, HasThePublishedConstants) {
    ASSERT_EQ(c9().constants.size(), 25u);
    double sum = 0;
    for (const Constant &constant : c9().constants)
        sum += constant.value;
    EXPECT_NEAR(sum, 66275.81949940001, 1e-10);
    EXPECT_EQ(c9().constant("read_noise").value, 8.5);
    EXPECT_EQ(c9().constant("collecting_area").value, 37570);
    EXPECT_STREQ(c9().constant("collecting_area").unit, "cm2");
    EXPECT_EQ(c9().sca_count(), 18);
    EXPECT_EQ(c9().obscuration(), 0.32);
    EXPECT_EQ(c9().reference_wavelength_nm(), 1293);
    EXPECT_EQ(c9().ipc_kernel, Instrument::get("wfirst-afta-c5").ipc_kernel);
}

// Worked out in Python from the published effective areas.
TEST(Roman, HasThePublishedBands) {
    struct Expected {
        const char *name;
        double blue, red, effective, peak, integral, thermal_background;
    };
    constexpr Expected expected[] = {
        {"R062", 455, 800, 633.9944930885816, 0.62017567207878621, 149.71386744743151, 0},
        {"Z087", 720, 1025, 871.9081197472417, 0.75017301038062278, 153.15730636145864, 0},
        {"Y106", 880, 1250, 1059.5131835127368, 0.74594091030077203, 196.52049507585832, 0},
        {"J129", 1075, 1525, 1293.6037310202814, 0.76382752195900983, 243.52515304764441, 0},
        {"H158", 1310, 1865, 1579.1092446523016, 0.79579451690178327, 306.87410167686977, 0.04},
        {"F184", 1600, 2100, 1841.8149260479051, 0.74926803300505718, 236.67567207878633, 0.17},
        {"K213", 1855, 2415, 2125.5413682260564, 0.75789193505456476, 262.65531008783603, 4.52},
        {"W146", 880, 2100, 1472.4306070131638, 0.80045248868778285, 825.28174075059906, 0.98},
    };
    ASSERT_EQ(c9().bands.size(), std::size(expected));
    for (const Expected &e : expected) {
        const Band &band = c9().band(e.name);
        EXPECT_EQ(band.thermal_background, e.thermal_background) << e.name;
        EXPECT_DOUBLE_EQ(*std::ranges::max_element(band.throughput), e.peak) << e.name;
        EXPECT_NEAR(integral_nm(band), e.integral, 1e-12 * e.integral) << e.name;
        const BandWavelengths w = tabulated_wavelengths(band);
        EXPECT_EQ(w.blue_nm, e.blue) << e.name;
        EXPECT_EQ(w.red_nm, e.red) << e.name;
        EXPECT_NEAR(w.effective_nm, e.effective, 1e-12 * e.effective) << e.name;
        const auto inner = band.throughput.subspan(1, band.throughput.size() - 2);
        EXPECT_TRUE(std::ranges::all_of(inner, [](double t) { return t > 0; })) << e.name;
    }
}

TEST(Roman, HasThePublishedZernikes) {
    // Sums over SCAs and field points, Noll j = 1..22; then sums that tell rows, columns and
    // points apart.
    constexpr double sums[] = {24.79427, 0.12138, -0.05018, -2.32621, 1.04099,  1.00883,
                               0.77416,  1.80695, -0.34167, -0.33337, 0.4011,   -0.50049,
                               -0.10091, 0.16246, 0.09931,  -0.12757, -0.22492, -0.21648,
                               0.35602,  0.17572, -0.31319, 0.10148};
    double sum[22] = {}, weighted = 0, squares = 0, x = 0, y = 0;
    for (int sca = 1; sca <= 18; ++sca) {
        const auto points = c9().field_points(sca);
        ASSERT_EQ(points.size(), 5u);
        EXPECT_EQ(c9().zernikes(sca).data(), points[0].zernikes.data());
        for (size_t i = 0; i < points.size(); ++i) {
            const double number = sca * static_cast<double>(i + 1);
            x += points[i].x_pix * number;
            y += points[i].y_pix * number;
            ASSERT_EQ(points[i].zernikes.size(), 22u);
            for (size_t j = 0; j < 22; ++j) {
                const double z = points[i].zernikes[j];
                sum[j] += z;
                weighted += z * number * static_cast<double>(j + 1);
                squares += z * z;
            }
        }
    }
    for (size_t j = 0; j < 22; ++j)
        EXPECT_NEAR(sum[j], sums[j], 1e-13) << j;
    EXPECT_NEAR(weighted, 1337.77192, 1e-10);
    EXPECT_NEAR(squares, 80.58550589720002, 1e-12);
    EXPECT_NEAR(x, 4871336, 1e-6);
    EXPECT_NEAR(y, 5225380, 1e-6);
}

double weighted_sum(std::span<const double> zernikes) { // from Z4 on
    double sum = 0;
    for (size_t i = 3; i < zernikes.size(); ++i)
        sum += zernikes[i] * static_cast<double>(i + 1);
    return sum;
}

// Coefficients that GalSim 2.8.4 uses at (2044, 2044) and (1, 1), counted from 1: Z4, Z11, Z22 and
// the sum of j Z_j over j = 4..22.
TEST(Roman, CornerRuleIsGalsims) {
    struct Expected {
        int sca;
        double x_pix, y_pix, z4, z11, z22, sum;
    };
    constexpr Expected expected[] = {
        {1, 2043, 2043, -0.01476842822029596, 0.0049594062247861, 0.0008716417745695749,
         0.19126041173714692},
        {1, 0, 0, 0.003991199595570839, 0.005595202013228804, 0.000573975271141563,
         0.26187557701628494},
        {7, 2043, 2043, -0.020879969161917714, 0.00535374402391643, 0.0015548823059302079,
         0.15777023236289606},
        {7, 0, 0, 0.0009063386433183975, 0.005179780236297149, 0.0017390430595392121,
         0.13702920226747153},
        {18, 2043, 2043, -0.020852637459976, 0.003933903411794014, 0.0009155262807155441,
         0.020866013588299842},
        {18, 0, 0, -0.018384057551222178, 0.004061854148211634, 0.0005501699035107204,
         -0.09790078401084473},
    };
    for (const Expected &e : expected) {
        const auto z = c9().zernikes(e.sca, e.x_pix, e.y_pix, FieldRule::corners);
        ASSERT_EQ(z.size(), 22u);
        EXPECT_NEAR(z[3], e.z4, 1e-16) << e.sca;
        EXPECT_NEAR(z[10], e.z11, 1e-16) << e.sca;
        EXPECT_NEAR(z[21], e.z22, 1e-16) << e.sca;
        EXPECT_NEAR(weighted_sum(z), e.sum, 1e-15) << e.sca;
    }
}

TEST(Roman, FivePointRuleMeetsAllFieldPoints) {
    for (int sca = 1; sca <= 18; ++sca)
        for (const FieldPoint &point : c9().field_points(sca)) {
            const auto z = c9().zernikes(sca, point.x_pix, point.y_pix);
            for (size_t j = 0; j < z.size(); ++j)
                EXPECT_NEAR(z[j], point.zernikes[j], 1e-15 + 1e-15 * std::abs(point.zernikes[j]))
                    << sca << ' ' << j;
        }
}

// The rules differ by a paraboloid that is as high as the centre point is off the corners' plane.
TEST(Roman, FieldRulesDifferByAParaboloid) {
    for (int sca = 1; sca <= 18; ++sca) {
        const auto difference = [&](double x, double y) {
            return c9().zernikes(sca, x, y)[3] - c9().zernikes(sca, x, y, FieldRule::corners)[3];
        };
        const FieldPoint &centre = c9().field_points(sca)[0];
        const double height = difference(centre.x_pix, centre.y_pix);
        const double side = difference(centre.x_pix + 2042, centre.y_pix);
        EXPECT_GT(std::abs(height), 1e-4) << sca;
        EXPECT_NEAR(side / height, 0.5, 0.01) << sca;
    }
}

TEST(Roman, OneFieldPointServesItsDetector) {
    const Instrument &c5 = Instrument::get("wfirst-afta-c5");
    const auto z = c5.zernikes(7, -100.0, 4000.0);
    EXPECT_TRUE(std::ranges::equal(z, c5.zernikes(7)));
}

TEST(Roman, NamesThePositionOffTheDetector) {
    EXPECT_NO_THROW(c9().zernikes(1, -512, 4599));
    expect_failure([] { c9().zernikes(1, -512.5, 0); }, WFPSF_ERROR_RANGE,
                   "x_pix = -512.5: must be -512..4599, the detector and 512 pixels around it");
    expect_failure([] { c9().zernikes(1, 0, 4600); }, WFPSF_ERROR_RANGE, "y_pix = 4600: must be");
    expect_failure([] { c9().zernikes(1, std::numeric_limits<double>::infinity(), 0); },
                   WFPSF_ERROR_NOT_FINITE, "x_pix = inf: must be finite");
    expect_failure([] { c9().zernikes(19, 0, 0); }, WFPSF_ERROR_RANGE, "sca = 19: must be 1..18");
    expect_failure([] { c9().pupil(0, "J129"); }, WFPSF_ERROR_RANGE, "sca = 0: must be 1..18");
    expect_failure([] { c9().pupil(1, "W149"); }, WFPSF_ERROR_UNKNOWN_NAME,
                   "band = \"W149\": must");
}

TEST(Roman, BandsSeeTheirMasks) {
    for (int sca = 1; sca <= 18; ++sca) {
        for (const char *name : {"R062", "Z087", "Y106", "J129", "H158", "W146"}) {
            EXPECT_EQ(&c9().pupil(sca, name), &c9().pupil(sca, "J129"));
            EXPECT_TRUE(std::holds_alternative<ShortWaveMask>(pupil(sca, name).mask));
        }
        EXPECT_EQ(&c9().pupil(sca, "F184"), &c9().pupil(sca, "K213"));
        EXPECT_TRUE(std::holds_alternative<LongWaveMask>(pupil(sca, "F184").mask));
    }
}

// Sums over all 36 pupils of what was published, in pixels of the mask and normalised units.
TEST(Roman, HasThePublishedPupils) {
    constexpr double pixel = 1.17978731902147e-3;
    double conics = 0, discs = 0, struts = 0, widths = 0, clips = 0, errors = 0;
    const auto sum = [](const Ellipse &e, double unit) {
        return e.x / unit + 2 * e.y / unit + 3 * e.radius / unit + 4 * e.p + 5 * e.q;
    };
    for (int sca = 1; sca <= 18; ++sca)
        for (const char *band : {"J129", "F184"}) {
            const RomanPupil &p = pupil(sca, band);
            conics += sca * (sum(p.primary, pixel) + sum(p.vignetting, 1));
            clips += sca * (p.clip->low + 2 * p.clip->high) / pixel;
            errors += sca * p.fit_error;
            if (const auto *mask = std::get_if<LongWaveMask>(&p.mask))
                conics += sca * (sum(mask->outer, 1) + sum(mask->inner, 1));
            else {
                const auto &[upper, lower, enlarged] = std::get<ShortWaveMask>(p.mask);
                discs += sca * (upper.x + 2 * upper.y + 3 * upper.radius + 4 * lower.x +
                                5 * lower.y + 6 * lower.radius + 7 * enlarged);
            }
            for (size_t k = 0; k < 6; ++k) {
                const double number = sca * static_cast<double>(k + 1);
                // Whichever way the normal points, the strut's middle is the same line.
                const Strut &t = p.telescope_struts[k], &m = p.mask_struts[k];
                struts += number * (t.nx * t.offset + 2 * t.ny * t.offset);
                struts += number * (3 * m.nx * m.offset + 4 * m.ny * m.offset);
                widths += number * (t.width + 2 * m.width);
            }
        }
    EXPECT_NEAR(conics, 1037963.9059489997, 1e-8);
    EXPECT_NEAR(discs, 854.589658, 1e-11);
    EXPECT_NEAR(struts, -1276.3182913942446, 1e-11);
    EXPECT_NEAR(widths, 1103.7235440000004, 1e-11);
    EXPECT_NEAR(clips, 345313.0, 1e-8);
    EXPECT_NEAR(errors, 0.016747000000000005, 1e-15);
}

TEST(Roman, StrutsRunOutwardsCounterclockwise) {
    constexpr double azimuths[] = {-119, -61, 1, 57.5, 122.3, 178.5};
    for (int sca = 1; sca <= 18; ++sca)
        for (const char *band : {"J129", "F184"})
            for (size_t k = 0; k < 6; ++k)
                for (const Strut &s :
                     {pupil(sca, band).telescope_struts[k], pupil(sca, band).mask_struts[k]}) {
                    EXPECT_NEAR(std::hypot(s.nx, s.ny), 1, 1e-15);
                    // Where the strut's middle leaves the unit disc.
                    const double along = std::sqrt(1 - s.offset * s.offset);
                    const double azimuth =
                        std::atan2(s.ny * s.offset + s.nx * along, s.nx * s.offset - s.ny * along);
                    const double degrees = azimuth * 180 / std::acos(-1.0);
                    EXPECT_LT(std::abs(std::remainder(degrees - azimuths[k], 360)), 12) << k;
                }
}

} // namespace
} // namespace wfpsf
