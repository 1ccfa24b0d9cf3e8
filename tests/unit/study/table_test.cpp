// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/linear_fit.hpp"
#include "study/table.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace wfpsf {
namespace {

TEST(StudyTable, WritesNumbersWordsAndNothing) {
    const StudyTable table{{"band", "value", "reason"},
                           {{"J129", 0.1, "sampled, say \"twice\""}, {"", std::nan(""), -2.0}}};
    EXPECT_EQ(as_csv(table), "band,value,reason\n"
                             "J129,0.10000000000000001,\"sampled, say \"\"twice\"\"\"\n"
                             ",,-2\n");
    EXPECT_EQ(as_csv({{"x"}, {}}), "x\n");
}

TEST(LinearFit, FindsAPlaneAndTheErrorOfACurve) {
    std::vector<GridPoint> points;
    for (size_t j = 0; j < grid_side; ++j)
        for (size_t i = 0; i < grid_side; ++i) {
            const double a = grid_value(i, 5e-3), b = grid_value(j, 5e-4);
            points.push_back({a, b, 3 * a - 2 * b + 40 * a * a});
        }
    const auto fit = fit_linear(points);
    EXPECT_NEAR(fit[0], 3, 1e-12);
    EXPECT_NEAR(fit[1], -2, 1e-11);
    EXPECT_NEAR(largest_error(points, fit), 40 * 25e-6, 1e-12);
    EXPECT_NEAR(largest_change(points), 0.017, 1e-12);
}

TEST(LinearFit, InterpolatesPolynomialsOfTheSixthDegree) {
    const auto f = [](size_t i, size_t j) {
        const double a = grid_value(i, 1), b = grid_value(j, 2);
        return 1 + a * (2 - a * a * (a + b)) + std::pow(b, 6) * std::pow(a, 5);
    };
    GridNodes nodes;
    for (size_t row = 0; row < grid_nodes.size(); ++row)
        for (size_t column = 0; column < grid_nodes.size(); ++column)
            nodes[row][column] = f(grid_nodes[column], grid_nodes[row]);
    for (size_t j = 0; j < grid_side; ++j)
        for (size_t i = 0; i < grid_side; ++i)
            EXPECT_NEAR(interpolate_grid(nodes, i, j), f(i, j), 1e-12);
}

} // namespace
} // namespace wfpsf
