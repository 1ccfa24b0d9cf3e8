// SPDX-License-Identifier: GPL-3.0-or-later
#include "gaussian_image.hpp"
#include "moments/adaptive.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Adaptive, FindsGaussiansOfEverySizeAndShape) {
    struct Case {
        double sigma, e, angle;
    };
    for (const Case c :
         {Case{2.2, 0, 0}, Case{3, 0.3, 20}, Case{4, 0.6, 75}, Case{6, 0.8, 45}, Case{9, 0.95, 30},
          Case{9, 0.95, 120}, Case{25, 0.5, 10}, Case{80, 0.3, 150}}) {
        const double beta = c.angle * pi / 180;
        const auto n = static_cast<int64_t>(
            std::min(900.0, 20 + 14 * c.sigma * std::pow((1 + c.e) / (1 - c.e), 0.25)));
        const double middle = static_cast<double>(n) / 2;
        const Gaussian truth = gaussian_of(middle + 0.23, middle - 0.41, c.sigma,
                                           c.e * std::cos(2 * beta), c.e * std::sin(2 * beta));
        const Plane<double> image = gaussian_image(n, n, truth, 1000);
        const Gaussian guess{middle, middle, 1.7 * c.sigma * c.sigma, 0, 1.7 * c.sigma * c.sigma};
        for (const double tolerance : {1e-4, 1e-8, 1e-12}) {
            AdaptiveOptions options;
            options.tolerance = tolerance;
            const AdaptiveMoments m = adaptive_moments(view_of(image), guess, options);
            ASSERT_EQ(m.status, WFPSF_OK) << m.line;
            const double error = whitened_distance(truth, m.weight);
            // The stamp of sigma = 80 holds 5.6 sigma.
            const double limit = c.sigma == 80 ? 3e-5 : 1e-11;
            EXPECT_LE(error, tolerance + limit) << c.sigma << " " << c.e;
            EXPECT_LE(error, m.error_estimate + limit) << c.sigma << " " << c.e;
            EXPECT_LE(m.error_estimate, tolerance);
            if (c.sigma == 80)
                continue;
            EXPECT_NEAR(m.sigma() / c.sigma, 1, tolerance + limit);
            EXPECT_NEAR(m.e(), c.e, tolerance + limit);
            if (c.e > 0) {
                EXPECT_NEAR(std::sin(2 * (m.beta() - beta)), 0, tolerance + limit);
            }
            EXPECT_NEAR(m.flux, 1000, 1000 * (tolerance + limit));
            EXPECT_NEAR(m.amplitude() * 2 * pi * c.sigma * c.sigma, 1000,
                        3000 * (tolerance + limit));
            EXPECT_NEAR(m.rho4, 2, 1000 * tolerance + limit);
            EXPECT_NEAR(m.curvature, 0.125, 0.02);
            EXPECT_NEAR(m.sigma_trace() * m.sigma_trace() * std::sqrt(1 - c.e * c.e),
                        2 * c.sigma * c.sigma, 4 * c.sigma * c.sigma * (tolerance + limit));
            EXPECT_EQ(m.edge_fraction, 0);
        }
    }
}

// Averaged over the unit pixel the fixed point is not Mxx + 1/12 (the square is no Gaussian), but
// its stationarity can be checked by brute force: M = 2 <(x - x0)(x - x0)^T> to the last digits.
TEST(Adaptive, PixelIntegratedGaussianIsAFixedPoint) {
    const double sx = 1.6, sy = 1.1, x0 = 12.3, y0 = 11.8;
    const auto cell = [](double i, double c, double s) {
        return (std::erf((i + 0.5 - c) / (s * std::sqrt(2.0))) -
                std::erf((i - 0.5 - c) / (s * std::sqrt(2.0)))) /
               2;
    };
    Plane<double> image(25, 24);
    for (int64_t y = 0; y < 24; ++y)
        for (int64_t x = 0; x < 25; ++x)
            image(x, y) =
                cell(static_cast<double>(x), x0, sx) * cell(static_cast<double>(y), y0, sy);
    AdaptiveOptions options;
    options.tolerance = 1e-12;
    const AdaptiveMoments m = adaptive_moments(view_of(image), {}, options);
    ASSERT_EQ(m.status, WFPSF_OK) << m.line;
    long double a = 0, x1 = 0, y1 = 0, xx = 0, xy = 0, yy = 0, r4 = 0;
    for (int64_t y = 0; y < 24; ++y)
        for (int64_t x = 0; x < 25; ++x) {
            const double dx = static_cast<double>(x) - m.weight.x;
            const double dy = static_cast<double>(y) - m.weight.y;
            const double r2 = rho2(m.weight, static_cast<double>(x), static_cast<double>(y));
            const long double f = image(x, y) * std::exp(-r2 / 2);
            a += f;
            x1 += f * dx;
            y1 += f * dy;
            xx += f * dx * dx;
            xy += f * dx * dy;
            yy += f * dy * dy;
            r4 += f * r2 * r2;
        }
    EXPECT_NEAR(static_cast<double>(x1 / a), 0, 1e-12);
    EXPECT_NEAR(static_cast<double>(y1 / a), 0, 1e-12);
    EXPECT_NEAR(m.weight.Mxx, static_cast<double>(2 * xx / a), 1e-11);
    EXPECT_NEAR(m.weight.Mxy, static_cast<double>(2 * xy / a), 1e-11);
    EXPECT_NEAR(m.weight.Myy, static_cast<double>(2 * yy / a), 1e-11);
    EXPECT_NEAR(m.flux, static_cast<double>(2 * a), 1e-12);
    EXPECT_NEAR(m.rho4, static_cast<double>(r4 / a), 1e-9);
    EXPECT_NEAR(m.weight.Mxx, sx * sx + 1.0 / 12, 2e-3);
    EXPECT_NEAR(m.weight.Myy, sy * sy + 1.0 / 12, 2e-3);
}

// Kannawadi et al. 2016, Eqs. 20 and 21.
TEST(Adaptive, ScalingAndShiftingActAsTheyShould) {
    Plane<double> image = gaussian_image(60, 60, gaussian_of(28.2, 30.1, 3, 0.2, 0.1));
    add_gaussian(image.view(), gaussian_of(31.2, 27.1, 4, 0, 0), 0.5);
    const AdaptiveMoments m = adaptive_moments(view_of(image));
    Plane<double> changed(60, 60);
    for (int64_t y = 0; y < 50; ++y)
        for (int64_t x = 0; x < 57; ++x)
            changed(x, y) = 7 * image(x + 3, y + 10);
    const AdaptiveMoments n = adaptive_moments(view_of(changed));
    ASSERT_EQ(m.status, WFPSF_OK);
    ASSERT_EQ(n.status, WFPSF_OK);
    EXPECT_NEAR(n.weight.x, m.weight.x - 3, 1e-7);
    EXPECT_NEAR(n.weight.y, m.weight.y - 10, 1e-7);
    EXPECT_NEAR(n.weight.Mxx, m.weight.Mxx, 1e-7);
    EXPECT_NEAR(n.weight.Mxy, m.weight.Mxy, 1e-7);
    EXPECT_NEAR(n.amplitude(), 7 * m.amplitude(), 1e-7);
}

TEST(Adaptive, FlippedStridedAndFloatViewsSeeTheSameObject) {
    const Gaussian truth = gaussian_of(20.3, 24.6, 2.5, 0.3, 0.2);
    const int64_t nx = 48, ny = 44;
    const Plane<double> image = gaussian_image(nx, ny, truth);
    const View<const double> plain = view_of(image);
    const AdaptiveMoments m = adaptive_moments(plain);

    const View<const double> flipped{&image(nx - 1, ny - 1), nx, ny, -1, -nx};
    const AdaptiveMoments f = adaptive_moments(flipped);
    EXPECT_NEAR(f.weight.x, static_cast<double>(nx - 1) - m.weight.x, 1e-8);
    EXPECT_NEAR(f.weight.y, static_cast<double>(ny - 1) - m.weight.y, 1e-8);
    EXPECT_NEAR(f.e2, m.e2, 1e-8);

    const View<const double> turned{plain.data, ny, nx, nx, 1};
    const AdaptiveMoments t = adaptive_moments(turned);
    EXPECT_NEAR(t.weight.x, m.weight.y, 1e-8);
    EXPECT_NEAR(t.e1, -m.e1, 1e-8);

    std::vector<float> wide(static_cast<size_t>(3 * nx * ny), 1e9f);
    const View<float> every_third{wide.data(), nx, ny, 3, 3 * nx};
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x)
            every_third(x, y) = static_cast<float>(image(x, y));
    const AdaptiveMoments s = adaptive_moments(View<const float>(every_third));
    ASSERT_EQ(s.status, WFPSF_OK) << s.line;
    EXPECT_LE(whitened_distance(m.weight, s.weight), 1e-7);
}

TEST(Adaptive, RangeOfFluxesDoesNotMatter) {
    const Gaussian truth = gaussian_of(30.3, 31.6, 3, 0.2, 0.1);
    for (const double flux : {1e-300, 1e-30, 1e30, 1e300}) {
        const Plane<double> image = gaussian_image(64, 64, truth, flux);
        for (const bool guessed : {true, false}) {
            std::optional<Gaussian> guess;
            if (guessed)
                guess = Gaussian{31, 31, 9, 0, 9};
            const AdaptiveMoments m = adaptive_moments(view_of(image), guess);
            ASSERT_EQ(m.status, WFPSF_OK) << m.line;
            EXPECT_LE(whitened_distance(truth, m.weight), 1e-8);
            EXPECT_NEAR(m.flux / flux, 1, 1e-8);
        }
    }
    for (const double flux : {1e-36, 1e38}) {
        Plane<float> image(64, 64);
        add_gaussian(image.view(), truth, flux);
        const AdaptiveMoments m = adaptive_moments(std::as_const(image).view());
        ASSERT_EQ(m.status, WFPSF_OK) << m.line;
        EXPECT_LE(whitened_distance(truth, m.weight), 1e-6);
    }
}

// A core with wings: the truncated weight and the last step must stay within the estimate.
TEST(Adaptive, ErrorEstimateHoldsOverToleranceSweep) {
    Plane<double> image(120, 120);
    for (int64_t y = 0; y < 120; ++y)
        for (int64_t x = 0; x < 120; ++x) {
            const double dx = static_cast<double>(x) - 60.2, dy = static_cast<double>(y) - 58.9;
            image(x, y) = std::pow(1 + (dx * dx + 1.3 * dy * dy + 0.2 * dx * dy) / 16, -1.5);
        }
    AdaptiveOptions options;
    options.tolerance = 1e-12;
    const AdaptiveMoments truth = adaptive_moments(view_of(image), {}, options);
    for (double tolerance = 1e-2; tolerance > 3e-12; tolerance /= 10) {
        options.tolerance = tolerance;
        const AdaptiveMoments m = adaptive_moments(view_of(image), {}, options);
        ASSERT_EQ(m.status, WFPSF_OK) << m.line;
        const double error = whitened_distance(truth.weight, m.weight);
        EXPECT_LE(error, tolerance);
        EXPECT_LE(error, m.error_estimate + truth.error_estimate);
        EXPECT_LE(m.error_estimate, tolerance);
    }
}

TEST(Adaptive, EdgeFractionIsTheShareBeyondTheBorder) {
    Plane<double> image = gaussian_image(60, 60, gaussian_of(-0.5, 30.2, 4, 0, 0));
    add_gaussian(image.view(), gaussian_of(3.5, 30.2, 4, 0, 0), 3);
    const AdaptiveMoments m = adaptive_moments(view_of(image), Gaussian{4, 30, 12, 0, 12});
    ASSERT_EQ(m.status, WFPSF_OK) << m.line;
    const double beyond = std::erfc((m.weight.x + 0.5) / std::sqrt(2 * m.weight.Mxx)) / 2;
    EXPECT_NEAR(m.edge_fraction, beyond, 1e-3);
    EXPECT_GT(beyond, 0.05);
}

} // namespace
} // namespace wfpsf
