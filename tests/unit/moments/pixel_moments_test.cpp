// SPDX-License-Identifier: GPL-3.0-or-later
#include "gaussian_image.hpp"
#include "moments/pixel_moments.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace wfpsf {
namespace {

// Long double, pixel by pixel.
std::array<long double, 15> brute(View<const double> image, const Gaussian &g, bool weighted) {
    std::array<long double, 15> sums{};
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x) {
            const long double dx = static_cast<long double>(x) - g.x;
            const long double dy = static_cast<long double>(y) - g.y;
            const double r2 = rho2(g, static_cast<double>(x), static_cast<double>(y));
            const long double f = image(x, y) * (weighted ? std::exp(-r2 / 2) : 1.0);
            size_t index = 0;
            for (int n = 0; n <= 4; ++n)
                for (int k = 0; k <= n; ++k)
                    sums[index++] += f * std::pow(dx, n - k) * std::pow(dy, k);
        }
    return sums;
}

TEST(PixelSums, AgreeWithLongDouble) {
    Plane<double> image = gaussian_image(41, 37, gaussian_of(20.2, 17.9, 3, 0.3, -0.2), 1e5);
    add_gaussian(image.view(), gaussian_of(26, 12, 2, 0, 0.4), -3e4);
    const Gaussian weight = gaussian_of(21, 17.3, 3.5, -0.1, 0.3);
    const View<const double> flipped{&image(40, 36), 41, 37, -1, -41};
    for (const View<const double> &view : {view_of(image), flipped})
        for (const bool weighted : {false, true}) {
            const auto expected = brute(view, weight, weighted);
            const PixelSums got =
                weighted ? pixel_sums(view, weight) : pixel_sums(view, weight.x, weight.y);
            for (size_t i = 0; i < 15; ++i)
                EXPECT_NEAR(got[i], static_cast<double>(expected[i]),
                            1e-12 * std::abs(static_cast<double>(expected[0])) *
                                std::pow(10.0, i > 9 ? 4 : 2))
                    << i << weighted;
        }
}

// What sums lose to rounding is put back: small pixels beside huge ones that cancel.
TEST(PixelSums, AreCompensated) {
    Plane<double> image(1000, 1);
    for (int64_t x = 0; x < 1000; ++x)
        image(x, 0) = x % 2 ? 1e16 : 1;
    for (int64_t x = 1; x < 1000; x += 4)
        image(x, 0) = -1e16;
    EXPECT_EQ(pixel_sums(view_of(image), 0, 0)[0], 500);
}

TEST(PixelSums, HardImages) {
    EXPECT_EQ(pixel_sums(View<const double>{}, 3, 4)[0], 0);
    EXPECT_EQ(pixel_sums(View<const float>{}, Gaussian{})[0], 0);
    Plane<double> one(1, 1);
    one(0, 0) = -2;
    const PixelSums sums = pixel_sums(view_of(one), 1, 3);
    EXPECT_EQ(sums[0], -2);
    EXPECT_EQ(sums[14], -2 * 81);
    // A NaN counts where the weight reaches, and not beyond.
    Plane<double> image = gaussian_image(64, 64, gaussian_of(20, 20, 1.5, 0, 0));
    image(60, 60) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isfinite(pixel_sums(view_of(image), gaussian_of(20, 20, 1.5, 0, 0))[14]));
    EXPECT_TRUE(std::isnan(pixel_sums(view_of(image), gaussian_of(55, 55, 1.5, 0, 0))[0]));
    EXPECT_TRUE(std::isnan(pixel_sums(view_of(image), 20, 20)[0]));
}

} // namespace
} // namespace wfpsf
