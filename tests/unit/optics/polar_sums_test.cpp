// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over colours on rays against sums of the colours one by one, of terms whose values are known
// everywhere: waves of all frequencies in the band.
#include "optics/polar_sums.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <vector>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;

struct Waves {
    struct Wave {
        double x, y, phase;
    };
    std::vector<Wave> waves;

    explicit Waves(double band) {
        std::mt19937 random(2);
        std::uniform_real_distribution<double> any(0, 1);
        for (int i = 0; i < 12; ++i) {
            const double f = band * std::sqrt(any(random)), angle = 2 * pi * any(random);
            waves.push_back({f * std::cos(angle), f * std::sin(angle), any(random)});
        }
        waves.push_back({band, 0, 0.1}); // the highest ones, along an axis and into a corner
        waves.push_back({band / std::numbers::sqrt2, -band / std::numbers::sqrt2, 0.2});
    }
    double operator()(double x, double y) const {
        double sum = 0;
        for (const Wave &wave : waves)
            sum += std::cos(2 * pi * (wave.x * x + wave.y * y + wave.phase));
        return sum / static_cast<double>(waves.size());
    }
};

// Terms that become dimmer, as those of a polynomial do.
constexpr double dimmer = 0.2;
constexpr PolarBand band{0.3, 0.3 * std::numbers::sqrt2};
constexpr double outer = 120, inner = 40, smallest = 0.8;

struct Case {
    int count; // of terms
    Waves waves{band.along_axes};
    std::vector<ScaledColour> colours;

    explicit Case(int terms) : count(terms) {
        constexpr int n = 30;
        for (int k = 0; k < n; ++k) {
            const double x = 2 * (k + 0.5) / n - 1;
            // A smooth spectrum, and lines of either sign.
            colours.push_back({x,
                               std::lerp(smallest, 1, (x + 1) / 2),
                               {1 + 0.3 * x, k % 7 == 3 ? 1.0 - 0.2 * k : 0.0}});
        }
    }

    // Far enough for double precision.
    ScalingTerms terms() const {
        const int64_t half = PolarSums::reach(band, outer, smallest, 1e-12), size = 2 * half + 1;
        Plane<double> plane(size, size);
        for (int64_t y = 0; y < size; ++y)
            for (int64_t x = 0; x < size; ++x)
                plane(x, y) = waves(static_cast<double>(x - half), static_cast<double>(y - half));
        std::vector<Plane<double>> planes;
        for (int m = 0; m < count; ++m) {
            planes.push_back(plane);
            for (int64_t y = 0; y < size; ++y)
                for (int64_t x = 0; x < size; ++x)
                    plane(x, y) *= dimmer;
        }
        return ScalingTerms(std::move(planes));
    }

    double sum(size_t s, double x, double y) const {
        double sum = 0;
        for (const ScaledColour &colour : colours) {
            double terms = 0;
            for (int m = 0; m < count; ++m)
                terms += std::pow(dimmer, m) * std::cos(m * std::acos(colour.x));
            if (colour.weights[s] != 0)
                sum += colour.weights[s] * terms * waves(colour.ratio * x, colour.ratio * y);
        }
        return sum;
    }

    double weight(size_t s) const {
        double sum = 0;
        for (const ScaledColour &colour : colours)
            sum += std::abs(colour.weights[s]);
        return sum;
    }
};

void expect_met(const Case &of, double eps) {
    constexpr int64_t middle = static_cast<int64_t>(outer), size = 2 * middle + 1;
    const ScalingTerms terms = of.terms();
    const PolarSums polar(terms, band, eps, 0);
    std::vector<Plane<double>> sums(2, Plane<double>(size, size));
    ASSERT_EQ(polar.set(of.colours, inner, outer, sums, {}), inner);
    std::mt19937 random(1);
    std::uniform_int_distribution<int64_t> anywhere(-middle, middle);
    for (size_t s = 0; s < sums.size(); ++s) {
        double most = 0;
        for (int i = 0; i < 1000; ++i) {
            const int64_t x = anywhere(random);
            // Places in corners and on diagonals belong to two sides.
            const int64_t y = i % 10 == 0 ? x : i % 10 == 1 ? -x : anywhere(random);
            const double value = sums[s](middle + x, middle + y);
            if (static_cast<double>(std::max(std::abs(x), std::abs(y))) <= inner)
                EXPECT_EQ(value, 0);
            else
                most = std::max(most, std::abs(value - of.sum(s, static_cast<double>(x),
                                                              static_cast<double>(y))));
        }
        EXPECT_LE(most, eps * of.weight(s)) << eps << ' ' << s;
    }
}

TEST(PolarSums, MeetTheSumOfTheirColours) {
    expect_met(Case(1), 1e-2); // one term, which has no other beside it
    expect_met(Case(3), 1e-5); // in single precision
    expect_met(Case(4), 3e-7); // in double precision
    expect_met(Case(9), 1e-4); // more than a vector holds
    expect_met(Case(17), 1e-4);
}

TEST(PolarSums, WhatIsTooBrightIsLeftAlone) {
    const Case of(2);
    const ScalingTerms terms = of.terms();
    const PolarSums polar(terms, band, 1e-10, 0);
    std::vector<Plane<double>> sums(2, Plane<double>(241, 241));
    EXPECT_EQ(polar.set(of.colours, inner, outer, sums, {}), outer);
    EXPECT_EQ(sums[0](5, 7), 0);
}

} // namespace
} // namespace wfpsf
