// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/elementary.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace wfpsf {
namespace {

using Limits = std::numeric_limits<double>;

void expect_log(double x) {
    const long double truth = std::log(static_cast<long double>(x));
    EXPECT_LE(std::fabs(branchless_log(x) - truth), 2 * Limits::epsilon() * std::fabs(truth)) << x;
}

TEST(Elementary, LogIsGoodToTwoUnitsInTheLastPlace) {
    for (double x = Limits::min(); x < Limits::max() / 1.7; x *= 1.6180339)
        expect_log(x);
    for (int i = 1; i < 100'000; ++i)
        expect_log(i / 50'000.0);
    for (const double x : {Limits::min(), 1 - 0x1p-53, 1.0, 1 + 0x1p-52, Limits::max()})
        expect_log(x);
}

TEST(Elementary, ExpIsGoodToTwoUnitsInTheLastPlace) {
    for (double x = -700; x < 700; x += 0.0137) {
        const long double truth = std::exp(static_cast<long double>(x));
        EXPECT_LE(std::fabs(branchless_exp(x) - truth), 2 * Limits::epsilon() * truth) << x;
    }
    EXPECT_EQ(branchless_exp(0), 1);
    EXPECT_EQ(branchless_exp(1e-300), 1);
}

} // namespace
} // namespace wfpsf
