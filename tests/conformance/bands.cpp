// SPDX-License-Identifier: GPL-3.0-or-later
// Limits and effective wavelengths of the bands; the paper's Table 1 to its last digit.
#include "csv.hpp"
#include "handles.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace {

struct Wavelengths {
    double blue, red, effective;
};

Wavelengths wavelengths(const Instrument &c5, const std::string &band, int32_t rule) {
    Wavelengths w{};
    require(wfpsf_instrument_band(c5.get(), band.c_str(), rule, &w.blue, &w.red, &w.effective));
    return w;
}

TEST(Bands, Summary) {
    const Instrument c5 = make_c5();
    int compared = 0;
    for (const Row &row : Table("bandpass_summary.csv")) {
        if (row.text("config") != "wfirst-afta-c5")
            continue;
        const std::string &band = row.text("band");
        SCOPED_TRACE(band);
        const Wavelengths paper = wavelengths(c5, band, WFPSF_BAND_PAPER);
        EXPECT_EQ(paper.blue, row.number("v13_blue"));
        EXPECT_EQ(paper.red, row.number("v13_red"));
        EXPECT_NEAR(paper.effective, row.number("v13_eff"), 1e-9 * paper.effective);
        const Wavelengths table = wavelengths(c5, band, WFPSF_BAND_TABULATED);
        EXPECT_EQ(table.blue, row.number("table_blue"));
        EXPECT_EQ(table.red, row.number("table_red"));
        EXPECT_NEAR(table.effective, row.number("table_eff_linear"), 1e-9 * table.effective);
        ++compared;
    }
    EXPECT_EQ(compared, 6);
}

TEST(Bands, PaperTable1) {
    const Instrument c5 = make_c5();
    for (const Row &row : Table("paper_table1.csv")) {
        SCOPED_TRACE(row.text("band"));
        const Wavelengths w = wavelengths(c5, row.text("band"), WFPSF_BAND_PAPER);
        EXPECT_EQ(w.blue, row.number("min_nm"));
        EXPECT_EQ(w.red, row.number("max_nm"));
        EXPECT_DOUBLE_EQ(std::round(w.effective * 100) / 100, row.number("eff_nm"));
    }
}

// The largest throughput is that of a tabulated point, every 5 nm.
TEST(Bands, LargestThroughput) {
    const Instrument c5 = make_c5();
    for (const Row &row : Table("bandpass_summary.csv")) {
        if (row.text("config") != "wfirst-afta-c5")
            continue;
        std::vector<double> wavelength, throughput(401);
        for (int i = 0; i <= 400; ++i)
            wavelength.push_back(500 + 5 * i);
        require(wfpsf_instrument_throughput(c5.get(), row.text("band").c_str(), 401,
                                            wavelength.data(), throughput.data()));
        EXPECT_EQ(*std::max_element(throughput.begin(), throughput.end()),
                  row.number("max_throughput"));
    }
}

} // namespace
