// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "gaussian_image.hpp"
#include "moments/radial.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace wfpsf {
namespace {

template <class F> wfpsf_status thrown(F call) {
    try {
        call();
    } catch (const Error &error) {
        return error.status();
    }
    return WFPSF_OK;
}

// A cross by hand: r^2 = 0 holds 4, the four pixels at 1 hold 1 each, the corners 0.5 each.
Plane<double> cross() {
    Plane<double> image(3, 3);
    for (int64_t y = 0; y < 3; ++y)
        for (int64_t x = 0; x < 3; ++x) {
            const int64_t r2 = (x - 1) * (x - 1) + (y - 1) * (y - 1);
            image(x, y) = r2 == 0 ? 4 : r2 == 1 ? 1 : 0.5;
        }
    return image;
}

TEST(Radial, SumsByHand) {
    const Plane<double> image = cross();
    const View<const double> v = view_of(image);
    EXPECT_EQ(enclosing_radius(v, 1, 1, 0.4), 0);
    EXPECT_EQ(enclosing_radius(v, 1, 1, 0.41), 1);
    EXPECT_EQ(enclosing_radius(v, 1, 1, 0.8), 1);
    EXPECT_EQ(enclosing_radius(v, 1, 1, 1.0), std::sqrt(2.0));
    EXPECT_EQ(enclosing_radius(v, 1, 1, 0.5, 16.0), 1);
    // 4.5 of 10 lies half way through the first pixel at r^2 = 1, which follows one at 0.
    EXPECT_DOUBLE_EQ(half_light_radius(v, 1, 1, 0.45), std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(half_light_radius(v, 1, 1, 0.55), 1);
    EXPECT_EQ(half_light_radius(v, 1, 1, 0.3), 0);
    // 2 of 4 lies at 2/3 of the way from 4 at r^2 = 0 to 1 at r^2 = 1.
    EXPECT_DOUBLE_EQ(full_width_half_maximum(v, 1, 1), 2 * std::sqrt(2.0 / 3));
}

TEST(Radial, WideGaussianHasItsKnownSizes) {
    const double sigma = 20, half_light = sigma * std::sqrt(2 * std::log(2.0));
    const Plane<double> image = gaussian_image(241, 241, gaussian_of(120, 120, sigma, 0, 0));
    const View<const double> v = view_of(image);
    EXPECT_NEAR(enclosing_radius(v, 120, 120), half_light, 0.1);
    EXPECT_NEAR(half_light_radius(v, 120, 120), half_light, 0.1);
    EXPECT_NEAR(full_width_half_maximum(v, 120, 120), 2 * half_light, 0.01);
}

TEST(Radial, ErrorsNameTheCause) {
    Plane<double> image = cross();
    const View<const double> v = view_of(image);
    EXPECT_EQ(thrown([&] { enclosing_radius(v, 1, 1, 0); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown([&] { half_light_radius(v, 1, 1, 1.1); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown([&] { enclosing_radius(v, 1, 1, 0.5, -1.0); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown([&] { enclosing_radius(v, 1, 1, 0.5, 100.0); }), WFPSF_ERROR_SIZE_NOT_REACHED);
    EXPECT_EQ(thrown([&] { half_light_radius(v, 1, 1, 0.5, 100.0); }),
              WFPSF_ERROR_SIZE_NOT_REACHED);
    EXPECT_EQ(thrown([&] { enclosing_radius(View<const double>{}, 0, 0); }), WFPSF_ERROR_RANGE);
    Plane<double> flat(3, 3);
    EXPECT_EQ(thrown([&] { full_width_half_maximum(view_of(flat), 1, 1); }),
              WFPSF_ERROR_MOMENTS_FLUX);
    for (int64_t i = 0; i < 9; ++i)
        flat(i % 3, i / 3) = 1;
    EXPECT_EQ(thrown([&] { full_width_half_maximum(view_of(flat), 1, 1); }),
              WFPSF_ERROR_SIZE_NOT_REACHED);
    image(2, 2) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(thrown([&] { half_light_radius(v, 1, 1); }), WFPSF_ERROR_NOT_FINITE);
    EXPECT_EQ(thrown([&] { enclosing_radius(v, NAN, 1); }), WFPSF_ERROR_NOT_FINITE);
}

} // namespace
} // namespace wfpsf
