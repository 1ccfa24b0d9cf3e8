// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/noise.hpp"
#include "detector/random.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace wfpsf {
namespace {

// Moments of a sample, to be held against theory within five of its own standard errors.
struct Sample {
    double mean = 0, variance = 0, third = 0, fourth = 0, count = 0;
    explicit Sample(const std::vector<double> &values) : count(static_cast<double>(values.size())) {
        mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
        for (const double value : values) {
            const double d = value - mean;
            variance += d * d / count;
            third += d * d * d / count;
            fourth += d * d * d * d / count;
        }
    }
    double mean_error() const { return std::sqrt(variance / count); }
    double variance_error() const { return std::sqrt((fourth - variance * variance) / count); }
};

std::vector<double> poissons(double mean, int64_t count, RandomSource source = {.seed = 7}) {
    std::vector<double> values(static_cast<size_t>(count), mean);
    constexpr int64_t row = 1000;
    for (int64_t y = 0; y * row < count; ++y)
        draw_poisson(source, 0, y, row, values.data() + y * row);
    return values;
}

TEST(Random, NormalNumbersHaveTheirMoments) {
    constexpr int64_t n = 1'000'000;
    std::vector<double> values(n);
    for (int64_t y = 0; y < 1000; ++y)
        fill_normal({.seed = 3}, 0, y, 1000, values.data() + y * 1000);
    const Sample sample(values);
    EXPECT_NEAR(sample.mean, 0, 5e-3);
    EXPECT_NEAR(sample.variance, 1, 5 * std::sqrt(2e-6));
    EXPECT_NEAR(sample.third, 0, 5 * std::sqrt(15e-6));
    EXPECT_NEAR(sample.fourth, 3, 5 * std::sqrt(96e-6));
    double neighbours = 0;
    for (size_t i = 1; i < values.size(); ++i)
        neighbours += values[i] * values[i - 1] / n;
    EXPECT_NEAR(neighbours, 0, 5e-3);
}

TEST(Random, PoissonNumbersHaveTheirMoments) {
    for (const double mean : {0.01, 0.7, 5.0, 10.01, 23.99, 24.01, 37.0, 1e3, 1e6, 1e10, 1e14}) {
        const Sample sample(poissons(mean, 400'000));
        EXPECT_NEAR(sample.mean, mean, 5 * std::sqrt(mean / sample.count)) << mean;
        EXPECT_NEAR(sample.variance, mean, 5 * sample.variance_error()) << mean;
        if (mean < 1e4) { // its skewness
            EXPECT_NEAR(
                sample.third, mean,
                5 * std::sqrt((15 * std::pow(mean, 3) + 25 * mean * mean + mean) / sample.count))
                << mean;
        }
    }
}

// Every value's frequency, by chi squared.
TEST(Random, PoissonNumbersFollowTheirLaw) {
    for (const double mean : {0.5, 8.0, 23.5, 24.5, 40.0, 300.0}) {
        std::map<int64_t, double> seen;
        constexpr double n = 400'000;
        for (const double value : poissons(mean, static_cast<int64_t>(n)))
            ++seen[static_cast<int64_t>(value)];
        double chi2 = 0, bins = 0, probability = std::exp(-mean);
        for (int64_t k = 0; k < 500; probability *= mean / static_cast<double>(++k))
            if (n * probability > 20) {
                chi2 += std::pow(seen[k] - n * probability, 2) / (n * probability);
                ++bins;
            }
        EXPECT_LT(chi2, bins + 5 * std::sqrt(2 * bins)) << mean;
    }
}

TEST(Random, WhatIsNoMeanStays) {
    double values[] = {0, -3.5, NAN, INFINITY, -INFINITY};
    draw_poisson({}, 0, 0, 5, values);
    EXPECT_EQ(values[0], 0);
    EXPECT_EQ(values[1], -3.5);
    EXPECT_TRUE(std::isnan(values[2]));
    EXPECT_EQ(values[3], INFINITY);
}

TEST(Random, APixelDrawsTheSameInAnyTile) {
    double row[101], normal[101];
    std::fill_n(row, 101, 55.0);
    draw_poisson({.seed = 5, .stream = 2}, 0, 9, 101, row);
    fill_normal({.seed = 5, .stream = 2}, 0, 9, 101, normal);
    for (int64_t begin = 0; begin < 101; begin += 17)
        for (const int64_t count : {1, 2, 16, 17}) {
            const int64_t n = std::min(count, 101 - begin);
            double part[17], part_normal[17];
            std::fill_n(part, n, 55.0);
            draw_poisson({.seed = 5, .stream = 2, .x0 = begin - 3, .y0 = 4}, 3, 5, n, part);
            fill_normal({.seed = 5, .stream = 2, .x0 = begin - 3, .y0 = 4}, 3, 5, n, part_normal);
            EXPECT_TRUE(std::equal(part, part + n, row + begin));
            EXPECT_TRUE(std::equal(part_normal, part_normal + n, normal + begin));
        }
}

TEST(Random, SeedsStreamsAndDrawsDiffer) {
    std::set<double> first;
    for (const RandomSource source : {RandomSource{},
                                      {.seed = 1},
                                      {.seed = uint64_t{1} << 40},
                                      {.stream = 1},
                                      {.draw = 1},
                                      {.x0 = 2},
                                      {.y0 = 1},
                                      {.x0 = -2}}) {
        double value = 0;
        fill_normal(source, 0, 0, 1, &value);
        first.insert(value);
    }
    EXPECT_EQ(first.size(), 8U);
}

// Covariances of realisations at every lag, against the kernel's autocorrelation, within five of
// their standard errors; the errors by Bartlett's formula.
TEST(Noise, RealisationsHaveTheClosedFormCovariance) {
    const double taps[9] = {.001, .02, .003, .03, .87, .04, .002, .03, .004};
    const IpcKernel kernel = IpcKernel::from_table({taps, 3, 3, 1, 3});
    for (const IpcKernel &through :
         {kernel, kernel.neumann_correction(2).composed(kernel), kernel.first_order_correction()}) {
        constexpr int64_t n = 700;
        Plane<double> image(n, n);
        add_noise(3, &through, {.seed = 11}, 2, image.view());
        const IpcKernel wanted = through.autocorrelation();
        double squares = 0;
        for (int64_t dy = -wanted.reach_y(); dy <= wanted.reach_y(); ++dy)
            for (int64_t dx = -wanted.reach_x(); dx <= wanted.reach_x(); ++dx)
                squares += wanted(dx, dy) * wanted(dx, dy);
        for (int64_t ly = 0; ly <= 3; ++ly)
            for (int64_t lx = -3; lx <= 3; ++lx) {
                double sum = 0, count = 0;
                for (int64_t y = 0; y + ly < n; ++y)
                    for (int64_t x = std::max<int64_t>(0, -lx); x + std::max<int64_t>(lx, 0) < n;
                         ++x) {
                        sum += image(x, y) * image(x + lx, y + ly) / 9;
                        ++count;
                    }
                const bool inside = std::abs(lx) <= wanted.reach_x() && ly <= wanted.reach_y();
                EXPECT_NEAR(sum / count, inside ? wanted(lx, ly) : 0,
                            5 * std::sqrt(2 * squares / count))
                    << lx << ", " << ly;
            }
    }
}

TEST(Noise, TilesFitTogether) {
    const IpcKernel kernel = IpcKernel::parametric(0.02, 0.002, 0.001);
    Plane<double> whole(40, 30), tile(12, 9);
    add_noise(2, &kernel, {.seed = 4}, 1, whole.view());
    add_noise(2, &kernel, {.seed = 4, .x0 = 21, .y0 = 13}, 3, tile.view());
    for (int64_t y = 0; y < 9; ++y)
        for (int64_t x = 0; x < 12; ++x)
            EXPECT_EQ(tile(x, y), whole(x + 21, y + 13));
}

} // namespace
} // namespace wfpsf
