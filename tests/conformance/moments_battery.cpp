// SPDX-License-Identifier: GPL-3.0-or-later
// Hard images that have a solution: it is found, from the table's first guess, and is right
// to its tolerance.
#include "csv.hpp"
#include "handles.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace {

// max(|L^-1 dx0|, |L^-1 dM L^-T|), M = L L^T of the reference.
double whitened_error(const Ellipse &m, const Row &row) {
    const double sigma = row.number("ref_sigma"), e1 = row.number("ref_e1"),
                 e2 = row.number("ref_e2");
    const double half_trace = sigma * sigma / std::sqrt(1 - e1 * e1 - e2 * e2);
    const double Mxx = half_trace * (1 + e1), Myy = half_trace * (1 - e1), Mxy = half_trace * e2;
    const double a = std::sqrt(Mxx), b = Mxy / a, c = std::sqrt(Myy - b * b);
    const double dx = m.x - row.number("ref_x"), dy = m.y - row.number("ref_y");
    const double centroid = std::hypot(dx / a, (dy - b * dx / a) / c);
    const double xx = (m.Mxx - Mxx) / (a * a), xy = ((m.Mxy - Mxy) - b * a * xx) / (a * c);
    const double yy = ((m.Myy - Myy) - 2 * b * c * xy - b * b * xx) / (c * c);
    return std::max(centroid, std::sqrt(xx * xx + 2 * xy * xy + yy * yy));
}

Options guess_of(const Row &row) {
    Options options = make_options();
    require(
        wfpsf_options_set_real(options.get(), WFPSF_OPTION_MOMENTS_GUESS_X, row.number("guess_x")));
    require(
        wfpsf_options_set_real(options.get(), WFPSF_OPTION_MOMENTS_GUESS_Y, row.number("guess_y")));
    require(wfpsf_options_set_real(options.get(), WFPSF_OPTION_MOMENTS_GUESS_SIGMA,
                                   row.number("guess_sigma")));
    return options;
}

TEST(MomentsBattery, Solvable) {
    int compared = 0;
    for (const Row &row : Table("moments_battery/cases.csv")) {
        if (row.text("ref_status") != "OK" || row.has("mask"))
            continue;
        SCOPED_TRACE(row.text("id") + " " + row.text("category") + " " + row.text("name"));
        const Options options = guess_of(row);
        const Ellipse m = measure(read_fits("moments_battery/" + row.text("image")), options.get());
        EXPECT_GE(m.status, 0) << wfpsf_status_name(m.status);
        EXPECT_LE(whitened_error(m, row), 1e-8) << wfpsf_status_name(m.status);
        ++compared;
    }
    EXPECT_GE(compared, 100);
}

// Against the truth, by both ways to solve for what is missing.
TEST(MomentsBattery, Masked) {
    int compared = 0;
    for (const Row &row : Table("moments_battery/cases.csv")) {
        if (!row.has("mask"))
            continue;
        SCOPED_TRACE(row.text("id") + " " + row.text("name"));
        const std::string file = "moments_battery/" + row.text("image");
        const Pixels image = read_fits(file), mask = read_fits(file, "BADPIX");
        const Options options = guess_of(row);
        for (const int method : {0, 1}) {
            require(wfpsf_options_set_integer(options.get(), WFPSF_OPTION_MOMENTS_METHOD, method));
            const Ellipse m = measure_masked(image, mask, options.get());
            EXPECT_EQ(m.status, WFPSF_OK) << wfpsf_status_name(m.status);
            EXPECT_LE(whitened_error(m, row), 1e-8) << method;
        }
        ++compared;
    }
    EXPECT_EQ(compared, 3);
}

// What has no solution is never called solved where the table's own search found none.
TEST(MomentsBattery, Unsolvable) {
    int refused = 0;
    for (const Row &row : Table("moments_battery/cases.csv")) {
        const std::string &status = row.text("ref_status");
        if (!status.starts_with("NO_SOLUTION") && status != "NONFINITE")
            continue;
        SCOPED_TRACE(row.text("id") + " " + row.text("category") + " " + row.text("name"));
        const Ellipse m =
            measure(read_fits("moments_battery/" + row.text("image")), guess_of(row).get());
        EXPECT_LT(m.status, 0) << m.sigma << " at " << m.x << " " << m.y;
        ++refused;
    }
    EXPECT_GE(refused, 20);
}

} // namespace
