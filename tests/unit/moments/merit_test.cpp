// SPDX-License-Identifier: GPL-3.0-or-later
#include "gaussian_image.hpp"
#include "moments/merit.hpp"

#include <gtest/gtest.h>

namespace wfpsf {
namespace {

constexpr double everything = 1e6; // reach beyond the image: no pixel comes and goes

Plane<double> lopsided_image() {
    Plane<double> image = gaussian_image(48, 40, gaussian_of(22.3, 19.1, 3.1, 0.2, -0.3));
    add_gaussian(image.view(), gaussian_of(27.8, 23.4, 2.2, -0.1, 0.2), 0.4);
    add_gaussian(image.view(), gaussian_of(18.0, 12.5, 4.0, 0.0, 0.0), -0.1);
    return image;
}

// Long double, pixel by pixel, nothing in common with the library's kernel.
long double merit_value(const Plane<double> &image, const Gaussian &g) {
    long double sum = 0;
    for (int64_t y = 0; y < image.ny(); ++y)
        for (int64_t x = 0; x < image.nx(); ++x) {
            const long double dx = static_cast<long double>(x) - g.x;
            const long double dy = static_cast<long double>(y) - g.y;
            const long double det =
                static_cast<long double>(g.Mxx) * g.Myy - static_cast<long double>(g.Mxy) * g.Mxy;
            const long double r2 = (g.Myy * dx * dx - 2 * g.Mxy * dx * dy + g.Mxx * dy * dy) / det;
            sum += image(x, y) * std::exp(-r2 / 2);
        }
    const long double det =
        static_cast<long double>(g.Mxx) * g.Myy - static_cast<long double>(g.Mxy) * g.Mxy;
    return std::log(sum) - std::log(std::numbers::pi_v<long double> * std::sqrt(det)) / 2;
}

WhitenedStep along(int i, double length) {
    WhitenedStep step;
    double *const component[5] = {&step.t, &step.v, &step.htt, &step.hs, &step.hvv};
    *component[i] = length;
    return step;
}

WhitenedStep sum(const WhitenedStep &a, const WhitenedStep &b) {
    return {a.t + b.t, a.v + b.v, a.htt + b.htt, a.hs + b.hs, a.hvv + b.hvv};
}

TEST(Merit, GradientAndHessianAgreeWithFiniteDifferences) {
    const Plane<double> image = lopsided_image();
    const Gaussian g = gaussian_of(23.1, 18.2, 2.7, 0.35, 0.25);
    const Merit phi = merit(weighted_sums(view_of(image), g, everything), g);
    EXPECT_NEAR(phi.value, static_cast<double>(merit_value(image, g)), 1e-14);
    const auto value = [&](const WhitenedStep &step) { return merit_value(image, g.moved(step)); };
    const double h = 1e-3;
    for (int i = 0; i < 5; ++i) {
        const auto slope = [&](double d) {
            return static_cast<double>(value(along(i, d)) - value(along(i, -d))) / (2 * d);
        };
        EXPECT_NEAR(phi.gradient[i], (4 * slope(h) - slope(2 * h)) / 3, 1e-9) << i;
        for (int k = 0; k < 5; ++k) {
            const auto second = [&](double d) {
                return static_cast<double>(value(sum(along(i, d), along(k, d))) -
                                           value(sum(along(i, d), along(k, -d))) -
                                           value(sum(along(i, -d), along(k, d))) +
                                           value(sum(along(i, -d), along(k, -d)))) /
                       (4 * d * d);
            };
            EXPECT_NEAR(phi.hessian[i][k], (4 * second(h) - second(2 * h)) / 3, 1e-8) << i << k;
        }
    }
}

TEST(Merit, AtAGaussianTheHessianIsDiagonal) {
    const Gaussian g = gaussian_of(40.2, 39.7, 4.0, 0.4, -0.3);
    const Plane<double> image = gaussian_image(80, 80, g);
    const Merit phi = merit(weighted_sums(view_of(image), g, everything), g);
    const double diagonal[5] = {-0.5, -0.5, -0.125, -0.125, -0.125};
    for (int i = 0; i < 5; ++i) {
        EXPECT_NEAR(phi.gradient[i], 0, 1e-13);
        for (int k = 0; k < 5; ++k)
            EXPECT_NEAR(phi.hessian[i][k], i == k ? diagonal[i] : 0, 1e-12);
    }
}

TEST(WeightedSums, AgreeWithLongDoubleAtEveryWidth) {
    for (const double sigma : {0.4, 0.9, 1.1, 3.0, 20.0, 80.0, 400.0}) {
        const auto n = static_cast<int64_t>(std::min(700.0, 20 + 14 * sigma));
        const double c = static_cast<double>(n) / 2;
        Plane<double> image(n, n / 4);
        for (int64_t y = 0; y < image.ny(); ++y)
            for (int64_t x = 0; x < n; ++x)
                image(x, y) = 1 + 0.3 * static_cast<double>((7 * x + 5 * y) % 11);
        const Gaussian g = gaussian_of(c + 0.3, c / 4 + 0.1, sigma, 0.2, 0.4);
        const WeightedSums sums = weighted_sums(view_of(image), g, 100);
        long double exact[5][5] = {}, size[5][5] = {};
        const long double s = g.s(), root = g.root_yy(), k = g.shear();
        for (int64_t y = 0; y < image.ny(); ++y)
            for (int64_t x = 0; x < n; ++x) {
                const long double v = (static_cast<long double>(y) - g.y) / root;
                const long double t = (static_cast<long double>(x) - g.x - k * root * v) / s;
                const long double f = image(x, y) * std::exp(-(t * t + v * v) / 2);
                for (int i = 0; i < 5; ++i)
                    for (int j = 0; i + j < 5; ++j) {
                        const long double term = f * std::pow(t, i) * std::pow(v, j);
                        exact[i][j] += term;
                        size[i][j] += std::abs(term);
                    }
            }
        for (int i = 0; i < 5; ++i)
            for (int j = 0; i + j < 5; ++j)
                EXPECT_NEAR(sums.sum[i][j], static_cast<double>(exact[i][j]),
                            1e-12 * static_cast<double>(size[i][j]))
                    << sigma << i << j;
    }
}

TEST(WeightedSums, LargeCoordinatesLoseNothing) {
    // The same pixels, named from 4000 on: columns before them do not exist in memory.
    const Plane<double> image = lopsided_image();
    const Gaussian g = gaussian_of(23.1, 18.2, 2.7, 0.35, 0.25);
    const WeightedSums near = weighted_sums(view_of(image), g, 40);
    Plane<double> wide(4048, 40);
    for (int64_t y = 0; y < 40; ++y)
        for (int64_t x = 0; x < 48; ++x)
            wide(4000 + x, y) = image(x, y);
    Gaussian far = g;
    far.x += 4000;
    const WeightedSums sums = weighted_sums(view_of(wide), far, 40);
    for (int i = 0; i < 5; ++i)
        for (int j = 0; i + j < 5; ++j)
            EXPECT_NEAR(sums.sum[i][j], near.sum[i][j], 1e-11);
}

} // namespace
} // namespace wfpsf
