// SPDX-License-Identifier: GPL-3.0-or-later
// Missing pixels, and the least-squares method for stars smaller than their pixels.
#include "gaussian_image.hpp"
#include "moments/adaptive.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace wfpsf {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A Gaussian is found whatever is missing, for its own fit fills the holes.
TEST(Masked, HolesDoNotMoveAGaussian) {
    const Gaussian truth = gaussian_of(31.3, 30.8, 3, 0.2, -0.1);
    const struct {
        int64_t x, y, width, height;
    } holes[] = {{31, 31, 1, 1}, {34, 30, 1, 1}, {30, 0, 2, 64}, {29, 28, 5, 5}, {33, 0, 31, 64}};
    for (const MomentsMethod method :
         {MomentsMethod::adaptive, MomentsMethod::least_squares, MomentsMethod::round})
        for (const auto &hole : holes) {
            const bool half = hole.width > 20;
            if (method == MomentsMethod::round && half)
                continue; // the missing half is filled by a round Gaussian
            const Gaussian shape =
                method == MomentsMethod::round ? gaussian_of(31.3, 30.8, 3, 0, 0) : truth;
            Plane<double> image = gaussian_image(64, 64, shape, 50);
            Plane<float> missing(64, 64);
            for (int64_t y = hole.y; y < hole.y + hole.height; ++y)
                for (int64_t x = hole.x; x < hole.x + hole.width; ++x) {
                    image(x, y) = (x + y) % 2 ? nan : 1e9;
                    missing(x, y) = 1;
                }
            const AdaptiveMoments m = adaptive_moments(view_of(image), Gaussian{31, 31, 9, 0, 9},
                                                       {.method = method}, missing.view());
            ASSERT_GE(m.status, 0) << m.line << " " << hole.x << " " << hole.width;
            EXPECT_LE(whitened_distance(shape, m.weight), 1e-8) << hole.x << " " << hole.width;
            EXPECT_NEAR(m.flux, 50, 1e-6);
            EXPECT_NEAR(m.e1, shape.Mxx > shape.Myy ? 0.2 : 0, 1e-8);
            if (method == MomentsMethod::adaptive) {
                EXPECT_NEAR(m.rho4, 2, 1e-5);
            }
            EXPECT_GT(m.missing_fraction, 0);
            EXPECT_LT(m.missing_fraction, 1);
        }
}

// A Gaussian on a background is fitted exactly, however small, cut off or full of holes.
TEST(Masked, AGaussianOnABackgroundIsFound) {
    for (const double background : {3.0, -40.0, 1e4})
        for (const double sigma : {0.6, 3.0, 9.0}) {
            const Gaussian truth = gaussian_of(31.3, 30.8, sigma, 0.2, -0.1);
            Plane<double> image = gaussian_image(64, 48, truth, 50 * sigma * sigma);
            Plane<float> missing(64, 48);
            for (int64_t y = 0; y < 48; ++y)
                for (int64_t x = 0; x < 64; ++x) {
                    image(x, y) += background;
                    missing(x, y) = y == 28 || x == 50 ? 1 : 0;
                    if (missing(x, y) != 0)
                        image(x, y) = nan;
                }
            const AdaptiveMoments m = adaptive_moments(
                view_of(image), Gaussian{31, 31, sigma * sigma, 0, sigma * sigma},
                {.tolerance = 1e-9, .method = MomentsMethod::with_background}, missing.view());
            ASSERT_EQ(m.status, WFPSF_OK) << m.line << sigma << " " << background;
            EXPECT_LE(whitened_distance(truth, m.weight), 1e-9 + m.error_estimate)
                << sigma << " " << background;
            EXPECT_NEAR(m.background, background, 1e-8 * (1 + std::abs(background)));
            EXPECT_NEAR(m.flux, 50 * sigma * sigma,
                        1e-7 * sigma * sigma * (1 + std::abs(background)));
        }
    // All pixels tell of it, so that none may be bad.
    Plane<double> image = gaussian_image(64, 64, gaussian_of(20, 20, 2, 0, 0));
    image(63, 62) = nan;
    const AdaptiveMoments m =
        adaptive_moments(view_of(image), {}, {.method = MomentsMethod::with_background});
    EXPECT_EQ(m.status, WFPSF_ERROR_NOT_FINITE);
    EXPECT_NE(m.line.find("(63, 62)"), std::string::npos) << m.line;
}

// Stationarity by brute force, of an object that is no Gaussian: minimal squares over seen pixels.
TEST(Masked, LeastSquaresIsLeast) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    Plane<double> image = gaussian_image(31, 31, gaussian_of(15.2, 14.7, 1.1, 0.2, 0.1), 10);
    add_gaussian(image.view(), gaussian_of(16, 15, 3, 0, 0), 4);
    Plane<float> missing(31, 31);
    for (int64_t i = 0; i < 31; ++i) {
        image(i, 16) = nan;
        missing(i, 16) = 1;
    }
    for (const MomentsMethod method :
         {MomentsMethod::least_squares, MomentsMethod::with_background}) {
        const AdaptiveMoments m =
            adaptive_moments(view_of(image), Gaussian{15, 15, 2, 0, 2},
                             {.tolerance = 1e-10, .method = method}, missing.view());
        ASSERT_EQ(m.status, WFPSF_OK) << m.line;
        EXPECT_EQ(m.background == 0, method == MomentsMethod::least_squares);
        const auto squares = [&](const Gaussian &g, double flux, double background) {
            const double peak = flux / (2 * std::numbers::pi * std::sqrt(g.det()));
            long double sum = 0;
            for (int64_t y = 0; y < 31; ++y)
                for (int64_t x = 0; x < 31; ++x) {
                    if (y == 16)
                        continue;
                    const double rho = rho2(g, static_cast<double>(x), static_cast<double>(y));
                    const long double d = image(x, y) - background - peak * std::exp(-rho / 2);
                    sum += d * d;
                }
            return static_cast<double>(sum);
        };
        const double least = squares(m.weight, m.flux, m.background);
        for (int trial = 0; trial < 200; ++trial) {
            const double h = 1e-3;
            const Gaussian near =
                m.weight.moved({h * normal(random), h * normal(random), h * normal(random),
                                h * normal(random), h * normal(random)});
            const double background =
                m.background + (method == MomentsMethod::with_background ? h * normal(random) : 0);
            EXPECT_GT(squares(near, m.flux * (1 + h * normal(random)), background), least);
        }
    }
}

TEST(Masked, SmallStarsHaveALeastSquaresFit) {
    for (const double sigma : {0.45, 0.55, 0.7})
        for (int phase = 0; phase < 25; ++phase) {
            const double x = 12 + 0.2 * (phase % 5), y = 12 + 0.2 * (phase / 5);
            const Gaussian truth = gaussian_of(x, y, sigma, 0.1, -0.05);
            const Plane<double> image = gaussian_image(25, 25, truth, 7);
            const AdaptiveMoments m = adaptive_moments(view_of(image), Gaussian{12, 12, 1, 0, 1},
                                                       {.method = MomentsMethod::least_squares});
            ASSERT_GE(m.status, 0) << m.line << " sigma " << sigma << " at " << x << " " << y;
            EXPECT_LE(whitened_distance(truth, m.weight), 1e-7) << sigma << " " << x << " " << y;
            EXPECT_NEAR(m.flux, 7, 1e-6);
        }
    // The adaptive method has no solution there, and says so.
    const Plane<double> image = gaussian_image(25, 25, gaussian_of(12, 12, 0.55, 0.1, 0), 7);
    EXPECT_EQ(adaptive_moments(view_of(image), Gaussian{12, 12, 1, 0, 1}).status,
              WFPSF_ERROR_MOMENTS_UNRESOLVED);
}

TEST(Masked, NothingSeenIsSaid) {
    const Plane<double> image = gaussian_image(21, 21, gaussian_of(10, 10, 2, 0, 0));
    Plane<float> missing(21, 21);
    for (int64_t y = 0; y < 21; ++y)
        for (int64_t x = 0; x < 21; ++x)
            missing(x, y) = 1;
    for (const MomentsMethod method : {MomentsMethod::adaptive, MomentsMethod::least_squares,
                                       MomentsMethod::round, MomentsMethod::with_background}) {
        EXPECT_EQ(adaptive_moments(view_of(image), {}, {.method = method}, missing.view()).status,
                  WFPSF_ERROR_MOMENTS_NO_PIXELS);
    }
    // One pixel far from a guess that must not be left.
    missing(0, 0) = 0;
    EXPECT_EQ(adaptive_moments(view_of(image), Gaussian{17, 17, 2, 0, 2},
                               {.method = MomentsMethod::least_squares, .restart = false},
                               missing.view())
                  .status,
              WFPSF_ERROR_MOMENTS_NO_PIXELS);
}

TEST(Masked, ABackgroundIsTakenOff) {
    const Gaussian truth = gaussian_of(31.3, 30.8, 3, 0.2, -0.1);
    Plane<double> image = gaussian_image(64, 64, truth, 50);
    for (int64_t y = 0; y < 64; ++y)
        for (int64_t x = 0; x < 64; ++x)
            image(x, y) += 3;
    const AdaptiveMoments m = adaptive_moments(view_of(image), {}, {.background = 3});
    ASSERT_EQ(m.status, WFPSF_OK) << m.line;
    EXPECT_LE(whitened_distance(truth, m.weight), 1e-8);
}

TEST(Masked, HardImagesGetAStatus) {
    for (const MomentsMethod method : {MomentsMethod::adaptive, MomentsMethod::least_squares,
                                       MomentsMethod::round, MomentsMethod::with_background}) {
        const AdaptiveOptions options{.method = method};
        const auto status = [&](const Plane<double> &image, View<const float> missing) {
            return adaptive_moments(view_of(image), {}, options, missing).status;
        };
        EXPECT_EQ(adaptive_moments(View<const double>{}, {}, options).status,
                  WFPSF_ERROR_MOMENTS_NO_PIXELS);
        Plane<double> one(1, 1);
        Plane<float> seen(1, 1);
        EXPECT_EQ(status(one, seen.view()), WFPSF_ERROR_MOMENTS_FLUX);
        one(0, 0) = 1;
        EXPECT_LT(status(one, seen.view()), 0);
        // Negative light, and a NaN that is not said to be missing.
        Plane<double> image = gaussian_image(21, 21, gaussian_of(10, 10, 2, 0, 0), -1);
        Plane<float> missing(21, 21);
        missing(3, 3) = 1;
        if (method == MomentsMethod::with_background) // to which the corners are bright
            EXPECT_LT(status(image, missing.view()), 0);
        else
            EXPECT_EQ(status(image, missing.view()), WFPSF_ERROR_MOMENTS_FLUX);
        image = gaussian_image(21, 21, gaussian_of(10, 10, 2, 0, 0));
        image(10, 11) = nan;
        EXPECT_EQ(status(image, missing.view()), WFPSF_ERROR_NOT_FINITE);
        missing(10, 11) = 1;
        EXPECT_EQ(status(image, missing.view()), WFPSF_OK);
        // Fluxes at the ends of the range of doubles.
        for (const double flux : {1e-300, 1e300}) {
            Plane<double> extreme = gaussian_image(21, 21, gaussian_of(10, 10, 1.5, 0, 0), flux);
            extreme(10, 11) = nan;
            const AdaptiveMoments m =
                adaptive_moments(view_of(extreme), {}, options, missing.view());
            EXPECT_EQ(m.status, WFPSF_OK) << m.line;
            EXPECT_NEAR(m.flux / flux, 1, 1e-5);
        }
    }
}

// Whatever is missing of whatever noise, an answer comes, and a solution is stationary.
TEST(Masked, NoiseAlwaysGetsAStatus) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 600; ++trial) {
        const int64_t n = 3 + trial % 21;
        Plane<double> image(n, n);
        Plane<float> missing(n, n);
        for (int64_t y = 0; y < n; ++y)
            for (int64_t x = 0; x < n; ++x) {
                missing(x, y) = normal(random) > 0.1 * (trial % 20) ? 1 : 0;
                image(x, y) = missing(x, y) != 0 ? nan : std::pow(normal(random), 1 + trial % 3);
            }
        const AdaptiveOptions options{.method = static_cast<MomentsMethod>(trial % 4)};
        const AdaptiveMoments m = adaptive_moments(view_of(image), {}, options, missing.view());
        EXPECT_EQ(m.status == WFPSF_OK, m.line.empty());
        if (m.status == WFPSF_OK) {
            EXPECT_TRUE(std::isfinite(m.flux + m.rho4 + m.error_estimate + m.missing_fraction));
            EXPECT_GE(m.missing_fraction, 0);
            EXPECT_LE(m.gradient, 1e-5);
        }
    }
}

} // namespace
} // namespace wfpsf
