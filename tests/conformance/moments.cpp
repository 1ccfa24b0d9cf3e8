// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive moments against the exact fixed points; images without a solution must fail.
#include "csv.hpp"
#include "images.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace {

TEST(Moments, FixedPoints) {
    const std::map<std::string, Pixels> images = read_images();
    int compared = 0;
    for (const Row &row : Table("moments/moments.csv")) {
        if (row.text("opt") != "fixed_point" || row.integer("status") != 0)
            continue;
        SCOPED_TRACE(row.text("id"));
        const Ellipse m = measure(images.at(row.text("id")));
        EXPECT_GE(m.status, 0) << wfpsf_status_name(m.status);
        EXPECT_NEAR(m.x + 1, row.number("x"), 1e-8);
        EXPECT_NEAR(m.y + 1, row.number("y"), 1e-8);
        EXPECT_NEAR(m.sigma, row.number("sigma"), 1e-6 * row.number("sigma"));
        EXPECT_NEAR(m.flux, row.number("amp"), 1e-6 * row.number("amp"));
        EXPECT_NEAR(m.e1, row.number("e1"), 1e-7);
        EXPECT_NEAR(m.e2, row.number("e2"), 1e-7);
        EXPECT_NEAR(m.rho4, row.number("rho4"), 5e-6);
        ++compared;
    }
    EXPECT_EQ(compared, 15);
}

// The peer's round weight, to its single precision and its tolerance of 1e-6.
TEST(Moments, RoundWeight) {
    const std::map<std::string, Pixels> images = read_images();
    const Options options = make_options();
    require(wfpsf_options_set_integer(options.get(), WFPSF_OPTION_MOMENTS_METHOD, 2));
    int compared = 0;
    for (const Row &row : Table("moments/moments.csv")) {
        if (row.text("opt") != "round" || row.integer("status") != 0)
            continue;
        SCOPED_TRACE(row.text("id"));
        const Ellipse m = measure(images.at(row.text("id")), options.get());
        EXPECT_GE(m.status, 0) << wfpsf_status_name(m.status);
        EXPECT_NEAR(m.x + 1, row.number("x"), 1e-6);
        EXPECT_NEAR(m.y + 1, row.number("y"), 1e-6);
        EXPECT_NEAR(m.sigma, row.number("sigma"), 1e-6 * row.number("sigma"));
        EXPECT_NEAR(m.flux, row.number("amp"), 1e-6 * row.number("amp"));
        EXPECT_NEAR(m.e1, row.number("e1"), 1e-6);
        EXPECT_NEAR(m.e2, row.number("e2"), 1e-6);
        ++compared;
    }
    EXPECT_EQ(compared, 15);
}

TEST(Moments, NoSolution) {
    const std::map<std::string, Pixels> images = read_images();
    for (const char *id : {"GS04", "GP03", "GP04"}) {
        const Ellipse m = measure(images.at(id));
        EXPECT_LT(m.status, 0) << id << ": sigma " << m.sigma << " at " << m.x << " " << m.y;
    }
}

} // namespace
