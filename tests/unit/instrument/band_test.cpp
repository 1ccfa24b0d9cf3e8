// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "instrument/band.hpp"
#include "instrument/instrument.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

namespace wfpsf {
namespace {

// Worked out in Python from the published table: the curve itself, and GalSim 1.3.0's thinned one.
struct Expected {
    const char *name;
    double blue, red, effective, peak, integral;
    double thinned_blue, thinned_red, thinned_effective;
    size_t thinned_count;
    double paper_effective; // Kannawadi et al. 2016, Table 1
};
constexpr Expected expected[] = {
    {"Z087", 725, 1025, 873.1828866752803, 0.5945, 119.965, 735, 1010, 873.3933061459361, 28,
     873.39},
    {"Y106", 885, 1245, 1061.3794234078139, 0.6389, 166.218, 900, 1230, 1061.427581453653, 30,
     1061.43},
    {"J129", 1080, 1520, 1292.163359353866, 0.6491, 207.016, 1095, 1500, 1292.1131049444007, 31,
     1292.11},
    {"W149", 885, 2090, 1458.0475516241777, 0.6491, 670.955, 905, 2050, 1458.0053310575956, 30,
     1458.01},
    {"H158", 1315, 1855, 1577.0270679041405, 0.638, 249.5945, 1340, 1830, 1577.047993643465, 29,
     1577.05},
    {"F184", 1605, 2090, 1837.3650774601223, 0.6473, 191.647, 1630, 2060, 1837.3021359284116, 34,
     1837.30},
};

const Instrument &c5() {
    return Instrument::get("wfirst-afta-c5");
}

TEST(Band, CurvesStandBetweenTwoZeros) {
    ASSERT_EQ(c5().bands.size(), std::size(expected));
    for (const Band &band : c5().bands) {
        const auto &t = band.throughput;
        EXPECT_EQ(t.front(), 0) << band.name;
        EXPECT_EQ(t.back(), 0) << band.name;
        for (const double inner : t.subspan(1, t.size() - 2))
            EXPECT_GT(inner, 0) << band.name;
    }
}

TEST(Band, TabulatedCurveHasThePublishedPeakIntegralLimitsAndMean) {
    for (const Expected &e : expected) {
        const Band &band = c5().band(e.name);
        EXPECT_EQ(*std::ranges::max_element(band.throughput), e.peak) << e.name;
        EXPECT_NEAR(integral_nm(band), e.integral, 1e-12 * e.integral) << e.name;
        const BandWavelengths w = tabulated_wavelengths(band);
        EXPECT_EQ(w.blue_nm, e.blue) << e.name;
        EXPECT_EQ(w.red_nm, e.red) << e.name;
        EXPECT_NEAR(w.effective_nm, e.effective, 1e-12 * e.effective) << e.name;
    }
}

TEST(Band, ThinnedCurveGivesTableOneOfThePaper) {
    for (const Expected &e : expected) {
        const Band &band = c5().band(e.name);
        EXPECT_EQ(thinned_samples(band).size(), e.thinned_count) << e.name;
        const BandWavelengths w = thinned_wavelengths(band);
        EXPECT_EQ(w.blue_nm, e.thinned_blue) << e.name;
        EXPECT_EQ(w.red_nm, e.thinned_red) << e.name;
        EXPECT_NEAR(w.effective_nm, e.thinned_effective, 1e-12 * e.thinned_effective) << e.name;
        EXPECT_EQ(std::round(100 * w.effective_nm), std::round(100 * e.paper_effective)) << e.name;
    }
}

TEST(Band, ThinningKeepsEveryBendOfASawtoothAndNoSampleOfALine) {
    const double line[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 0};
    const Band triangle{"triangle", 500, 10, line, 0};
    EXPECT_EQ(thinned_samples(triangle), (std::vector<size_t>{0, 8, 9}));
    const double teeth[] = {0, 1, 0.5, 1, 0.5, 1, 0};
    const Band sawtooth{"sawtooth", 500, 10, teeth, 0};
    EXPECT_EQ(thinned_samples(sawtooth), (std::vector<size_t>{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_NEAR(thinned_wavelengths(sawtooth).effective_nm, 530, 1e-12 * 530);
}

TEST(Band, MeanOfATriangleIsItsCentroid) {
    const double samples[] = {0, 1, 0.75, 0.5, 0.25, 0};
    const Band band{"triangle", 1000, 5, samples, 0};
    EXPECT_NEAR(integral_nm(band), 12.5, 1e-13);
    EXPECT_NEAR(tabulated_wavelengths(band).effective_nm, (1000 + 1005 + 1025) / 3., 1e-12);
}

TEST(Band, ThroughputIsLinearBetweenSamplesAndZeroOutside) {
    const Band &band = c5().band("Z087");
    EXPECT_EQ(throughput(band, 730), 0.0002);
    EXPECT_EQ(throughput(band, 750), 0.0604);
    EXPECT_NEAR(throughput(band, 752), 0.0604 + 0.4 * (0.1341 - 0.0604), 1e-15);
    EXPECT_NEAR(throughput(band, 1022.5), 0.00005, 1e-18);
    for (const double outside : {-1., 0., 1e-300, 724.999, 725., 1025., 1025.001, 1e300})
        EXPECT_EQ(throughput(band, outside), 0) << outside;
    for (const Band &each : c5().bands)
        for (size_t i = 0; i < each.throughput.size(); ++i)
            EXPECT_EQ(throughput(each, each.wavelength_nm(i)), each.throughput[i]) << each.name;
}

TEST(Band, ThroughputRefusesAWavelengthThatIsNotFinite) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {std::nan(""), infinity, -infinity})
        try {
            throughput(c5().band("J129"), bad);
            ADD_FAILURE() << bad;
        } catch (const Error &error) {
            EXPECT_EQ(error.status(), WFPSF_ERROR_NOT_FINITE);
            EXPECT_NE(std::string(error.what()).find("wavelength_nm = "), std::string::npos);
        }
}

} // namespace
} // namespace wfpsf
