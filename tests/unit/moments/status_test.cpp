// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever the pixels hold, adaptive_moments() comes back with the status that says what happened.
#include "error/error.hpp"
#include "gaussian_image.hpp"
#include "moments/adaptive.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace wfpsf {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Gaussian truth = gaussian_of(31.3, 30.8, 3, 0.2, 0.1);
const Gaussian good_guess{31, 31, 9, 0, 9};

wfpsf_status status_of(const Plane<double> &image, const std::optional<Gaussian> &guess = {}) {
    const AdaptiveMoments m = adaptive_moments(view_of(image), guess);
    EXPECT_EQ(m.status == WFPSF_OK, m.line.empty());
    return m.status;
}

TEST(AdaptiveStatus, BadArgumentsThrow) {
    const Plane<double> image = gaussian_image(64, 64, truth);
    const auto thrown = [&](const std::optional<Gaussian> &guess, AdaptiveOptions options) {
        try {
            adaptive_moments(view_of(image), guess, options);
        } catch (const Error &error) {
            return error.status();
        }
        return static_cast<wfpsf_status>(WFPSF_OK);
    };
    EXPECT_EQ(thrown({}, {.tolerance = 0}), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown({}, {.tolerance = nan}), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown({}, {.max_passes = 0}), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown({}, {.sigma_min = 0}), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown(Gaussian{31, nan, 9, 0, 9}, {}), WFPSF_ERROR_NOT_FINITE);
    EXPECT_EQ(thrown(Gaussian{31, 31, 9, 10, 9}, {}), WFPSF_ERROR_RANGE);
    EXPECT_EQ(thrown(Gaussian{31, 31, -1, 0, -1}, {}), WFPSF_ERROR_RANGE);
}

TEST(AdaptiveStatus, EmptyAndTinyImages) {
    EXPECT_EQ(adaptive_moments(View<const double>{}).status, WFPSF_ERROR_MOMENTS_NO_PIXELS);
    Plane<double> one(1, 1);
    EXPECT_EQ(status_of(one), WFPSF_ERROR_MOMENTS_FLUX);
    one(0, 0) = 1;
    EXPECT_EQ(status_of(one), WFPSF_ERROR_MOMENTS_UNRESOLVED);
    Plane<double> line(40, 1);
    for (int64_t x = 0; x < 40; ++x)
        line(x, 0) = std::exp(-static_cast<double>((x - 20) * (x - 20)) / 18);
    EXPECT_EQ(status_of(line), WFPSF_ERROR_MOMENTS_UNRESOLVED);
}

TEST(AdaptiveStatus, FluxThatIsNotPositive) {
    Plane<double> image(32, 32);
    EXPECT_EQ(status_of(image), WFPSF_ERROR_MOMENTS_FLUX);
    EXPECT_EQ(status_of(image, Gaussian{15, 15, 4, 0, 4}), WFPSF_ERROR_MOMENTS_FLUX);
    add_gaussian(image.view(), gaussian_of(16, 16, 3, 0, 0), -1);
    EXPECT_EQ(status_of(image), WFPSF_ERROR_MOMENTS_FLUX);
    EXPECT_EQ(status_of(image, Gaussian{15, 15, 4, 0, 4}), WFPSF_ERROR_MOMENTS_FLUX);
}

TEST(AdaptiveStatus, PixelsThatAreNotFinite) {
    for (const double bad : {nan, std::numeric_limits<double>::infinity(), -1 / 0.0}) {
        Plane<double> image = gaussian_image(64, 64, truth);
        image(2, 3) = bad;
        EXPECT_EQ(status_of(image, good_guess), WFPSF_OK);
        EXPECT_EQ(status_of(image), WFPSF_OK);
        image(36, 31) = bad;
        for (const bool guessed : {true, false}) {
            const AdaptiveMoments m = adaptive_moments(
                view_of(image), guessed ? std::optional<Gaussian>(good_guess) : std::nullopt);
            EXPECT_EQ(m.status, WFPSF_ERROR_NOT_FINITE);
            EXPECT_NE(m.line.find("(36, 31)"), std::string::npos) << m.line;
            EXPECT_TRUE(std::isfinite(m.sigma()));
        }
    }
    Plane<double> huge(16, 16);
    for (int64_t y = 0; y < 16; ++y)
        for (int64_t x = 0; x < 16; ++x)
            huge(x, y) = 1e308;
    EXPECT_EQ(status_of(huge, Gaussian{8, 8, 16, 0, 16}), WFPSF_ERROR_NOT_FINITE);
}

TEST(AdaptiveStatus, AGuessInTheDarkIsReplaced) {
    const Plane<double> image = gaussian_image(200, 200, truth);
    EXPECT_EQ(status_of(image, Gaussian{180, 180, 4, 0, 4}), WFPSF_WARNING_RESTARTED);
    EXPECT_EQ(status_of(image, Gaussian{-500, 20, 4, 0, 4}), WFPSF_WARNING_RESTARTED);
    EXPECT_EQ(status_of(image, Gaussian{31, 31, 1e-6, 0, 1e-6}), WFPSF_OK);
}

TEST(AdaptiveStatus, PassesRunOut) {
    const Plane<double> image = gaussian_image(64, 64, truth);
    const AdaptiveMoments m = adaptive_moments(view_of(image), {}, {.max_passes = 2});
    EXPECT_EQ(m.status, WFPSF_WARNING_NOT_CONVERGED);
    EXPECT_EQ(m.passes, 2);
    EXPECT_GT(m.last_step, 0);
    EXPECT_NEAR(m.sigma(), 3, 0.5);
}

TEST(AdaptiveStatus, ObjectsSmallerThanAPixelAreRefused) {
    for (const double sigma : {0.1, 0.3, 0.5}) {
        const Plane<double> image = gaussian_image(33, 33, gaussian_of(16, 16, sigma, 0.1, 0));
        EXPECT_EQ(status_of(image), WFPSF_ERROR_MOMENTS_UNRESOLVED);
        EXPECT_EQ(status_of(image, Gaussian{16, 16, 1, 0, 1}), WFPSF_ERROR_MOMENTS_UNRESOLVED);
    }
}

// Down to 0.9 pixels the integral of w^2 stands for its sum to a per cent; below, a warning says
// that it does not.
TEST(AdaptiveStatus, SmallObjectsThatAreSolvedCarryAWarning) {
    for (int phase = 0; phase < 16; ++phase) {
        const double x = 16 + 0.25 * (phase % 4), y = 16 + 0.25 * (phase / 4);
        const Gaussian fine = gaussian_of(x, y, 0.97, 0.05, 0);
        const AdaptiveMoments m = adaptive_moments(view_of(gaussian_image(33, 33, fine)));
        EXPECT_EQ(m.status, WFPSF_OK) << m.line;
        EXPECT_LE(whitened_distance(fine, m.weight), 2e-2);
        const Gaussian coarse = gaussian_of(x, y, 0.75, 0.05, 0);
        const wfpsf_status status = status_of(gaussian_image(33, 33, coarse));
        EXPECT_TRUE(status == WFPSF_WARNING_UNDERSAMPLED || status < 0) << status;
    }
    EXPECT_EQ(status_of(gaussian_image(33, 33, gaussian_of(16.5, 16.5, 0.75, 0, 0))),
              WFPSF_WARNING_UNDERSAMPLED);
}

TEST(AdaptiveStatus, AFrameFillsTheImage) {
    // The light lies along the border: the best weight reaches far beyond it.
    Plane<double> image(9, 9);
    for (int64_t i = 0; i < 9; ++i)
        image(i, 0) = image(i, 8) = image(0, i) = image(8, i) = 1;
    const AdaptiveMoments m = adaptive_moments(view_of(image));
    EXPECT_EQ(m.status, WFPSF_ERROR_MOMENTS_FILLS_IMAGE) << m.line;
    EXPECT_GT(m.edge_fraction, 0.5);
}

// Noise of several kinds: always an answer, never an endless loop, and what is called a solution is
// a fixed point by brute force.
TEST(AdaptiveStatus, NoiseAlwaysGetsAnHonestStatus) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 600; ++trial) {
        const int64_t n = 3 + trial % 28;
        Plane<double> image(n, n);
        for (int64_t y = 0; y < n; ++y)
            for (int64_t x = 0; x < n; ++x) {
                const double value = normal(random);
                const double kinds[4] = {value, std::abs(value), std::pow(value, 7),
                                         x == 0 ? 5 : -3 * std::abs(value)};
                image(x, y) = kinds[trial % 4];
            }
        const double middle = static_cast<double>(n) / 2, variance = 1 + trial % 17;
        std::optional<Gaussian> guess;
        if (trial % 3 > 0)
            guess = Gaussian{middle, middle, variance, 0, variance};
        const AdaptiveMoments m = adaptive_moments(view_of(image), guess);
        if (m.status != WFPSF_OK && m.status != WFPSF_WARNING_RESTARTED) {
            EXPECT_FALSE(m.line.empty());
            continue;
        }
        long double a = 0, xx = 0;
        for (int64_t y = 0; y < n; ++y)
            for (int64_t x = 0; x < n; ++x) {
                const auto px = static_cast<double>(x), py = static_cast<double>(y);
                const long double f = image(x, y) * std::exp(-rho2(m.weight, px, py) / 2);
                a += f;
                xx += f * (px - m.weight.x) * (px - m.weight.x);
            }
        EXPECT_GT(a, 0);
        EXPECT_NEAR(static_cast<double>(2 * xx / a) / m.weight.Mxx, 1, 1e-6);
        EXPECT_TRUE(std::isfinite(m.flux + m.rho4 + m.error_estimate + m.edge_fraction));
    }
}

// A cross of two bars. The round weight on it is a maximum over sizes, but over shapes only if the
// bars' axes are in a ratio below 3 + sqrt(8): else either bar alone is the better object.
Plane<double> cross(double ratio) {
    Plane<double> image = gaussian_image(241, 241, {120, 120, 9 * ratio * ratio, 0, 9});
    add_gaussian(image.view(), {120, 120, 9, 0, 9 * ratio * ratio}, 1);
    return image;
}
const Gaussian on_cross{120, 120, 50, 0, 50};

TEST(AdaptiveStatus, ASaddlePointIsNoSolution) {
    const AdaptiveMoments m = adaptive_moments(view_of(cross(9)), on_cross, {.restart = false});
    EXPECT_EQ(m.status, WFPSF_ERROR_MOMENTS_STALLED) << m.line;
}

TEST(AdaptiveStatus, NearASaddlePointTheSolutionIsDegenerate) {
    const AdaptiveMoments m = adaptive_moments(view_of(cross(3 + std::sqrt(8.0) - 0.01)), on_cross);
    EXPECT_EQ(m.status, WFPSF_WARNING_NEAR_DEGENERATE) << m.line;
    EXPECT_GT(m.curvature, 0);
    EXPECT_LT(m.curvature, 1e-3);
    EXPECT_EQ(adaptive_moments(view_of(cross(4)), on_cross).status, WFPSF_OK);
}

TEST(AdaptiveStatus, BetweenTwoStarsAnAnswerIsAMaximum) {
    Plane<double> image = gaussian_image(81, 61, gaussian_of(25, 30, 3, 0, 0));
    add_gaussian(image.view(), gaussian_of(55, 30, 3, 0, 0), 1);
    const AdaptiveMoments m = adaptive_moments(view_of(image), Gaussian{40, 30, 9, 0, 9});
    EXPECT_GE(m.status, 0) << m.line;
    EXPECT_GT(m.curvature, 0);
}

// The fit to the wing of a star beyond the border has its centre there.
TEST(AdaptiveStatus, AStarOutsideIsSaidToBe) {
    const Plane<double> image = gaussian_image(40, 40, gaussian_of(-3, 20, 3, 0, 0));
    const AdaptiveMoments m =
        adaptive_moments(view_of(image), Gaussian{1, 20, 9, 0, 9},
                         {.method = MomentsMethod::least_squares, .restart = false});
    EXPECT_EQ(m.status, WFPSF_ERROR_MOMENTS_OUTSIDE) << m.line;
}

// Failures of 500 noisy stars, from a good guess.
TEST(AdaptiveStatus, NoisyStarsAreFound) {
    struct Case {
        double signal_to_noise;
        int failures_allowed;
    };
    for (const Case &c : {Case{5, 15}, Case{7, 5}, Case{10, 0}}) {
        std::mt19937 random(20160828);
        std::normal_distribution<double> normal;
        int failures = 0;
        for (int trial = 0; trial < 500; ++trial) {
            const Gaussian star =
                gaussian_of(20 + normal(random) / 4, 20 + normal(random) / 4, 2.5, 0.1, 0.05);
            // S/N of the flux under the star's own shape: sqrt(sum I^2)/noise.
            const double flux =
                c.signal_to_noise * 2 * std::sqrt(std::numbers::pi * std::sqrt(star.det()));
            Plane<double> image = gaussian_image(41, 41, star, flux);
            for (int64_t y = 0; y < 41; ++y)
                for (int64_t x = 0; x < 41; ++x)
                    image(x, y) += normal(random);
            const AdaptiveMoments m =
                adaptive_moments(view_of(image), Gaussian{20, 20, 6.25, 0, 6.25});
            failures += m.status < 0 || m.status == WFPSF_WARNING_NOT_CONVERGED;
        }
        EXPECT_LE(failures, c.failures_allowed) << "S/N " << c.signal_to_noise;
        RecordProperty("failures_at_" + std::to_string(static_cast<int>(c.signal_to_noise)),
                       failures);
    }
}

} // namespace
} // namespace wfpsf
