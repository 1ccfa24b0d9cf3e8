// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/fft.hpp"
#include "numerics/nufft.hpp"
#include "numerics/phasor.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace wfpsf {
namespace {

using Complex = std::complex<double>;

struct Sources {
    std::vector<double> a, b;
    std::vector<Complex> c;
    double strength = 0; // sum of |c|

    Sources(size_t count, double reach) : a(count), b(count), c(count) {
        std::mt19937 random(42);
        std::uniform_real_distribution<double> uniform(-1, 1);
        for (size_t i = 0; i < count; ++i) {
            a[i] = reach * uniform(random);
            b[i] = reach * uniform(random);
            c[i] = {uniform(random), uniform(random)};
            strength += std::abs(c[i]);
        }
    }

    Complex direct(int64_t jx, int64_t jy) const {
        std::complex<long double> sum = 0;
        for (size_t i = 0; i < c.size(); ++i)
            sum += std::complex<long double>(c[i]) *
                   std::polar(1.0L, static_cast<long double>(a[i]) * jx +
                                        static_cast<long double>(b[i]) * jy);
        return static_cast<Complex>(sum);
    }
};

// All modes, the sources added in two batches and the rows asked for in strips.
std::vector<Complex> transform(const Sources &sources, Type1Transform::Band band, int64_t K,
                               double eps, int64_t strip) {
    Type1Transform nufft(band, band, K, eps);
    const std::span<const double> a(sources.a), b(sources.b);
    const std::span<const Complex> c(sources.c);
    const size_t half = c.size() / 2;
    nufft.add(a.first(half), b.first(half), c.first(half));
    nufft.add(a.subspan(half), b.subspan(half), c.subspan(half));
    std::vector<Complex> out;
    for (int64_t first = -K; first <= K; first += strip) {
        int64_t expected = first;
        nufft.rows(first, std::min(first + strip - 1, K),
                   [&](int64_t jy, std::span<const Complex> modes) {
                       EXPECT_EQ(jy, expected++);
                       EXPECT_EQ(modes.size(), static_cast<size_t>(2 * K + 1));
                       out.insert(out.end(), modes.begin(), modes.end());
                   });
    }
    return out;
}

TEST(Nufft, MeetsTheDirectSumWithinTheToleranceAskedFor) {
    for (const int64_t K : {0, 1, 7, 40})
        for (const double reach : {0.01, 0.8, 3.14})
            for (const double eps : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13}) {
                const Sources sources(60, reach);
                const int64_t modes = 2 * K + 1;
                const std::vector<Complex> out = transform(sources, {-reach, reach}, K, eps, modes);
                double worst = 0;
                for (int64_t jy = -K; jy <= K; jy += std::max<int64_t>(1, K / 5))
                    for (int64_t jx = -K; jx <= K; jx += std::max<int64_t>(1, K / 5))
                        worst = std::max(
                            worst, std::abs(out[static_cast<size_t>((jy + K) * modes + jx + K)] -
                                            sources.direct(jx, jy)));
                EXPECT_LE(worst / sources.strength, eps) << K << ' ' << reach << ' ' << eps;
            }
}

TEST(Nufft, StripsGiveTheBitsOfTheWhole) {
    const Sources sources(60, 0.8);
    const std::vector<Complex> whole = transform(sources, {-0.9, 0.8}, 20, 1e-8, 41);
    for (const int64_t strip : {1, 7, 40})
        EXPECT_EQ(transform(sources, {-0.9, 0.8}, 20, 1e-8, strip), whole) << strip;
}

// Sources one above the other share their weights along x, and several transforms their places.
TEST(Nufft, ColumnsOfSourcesAndSeveralTransformsMeetTheDirectSum) {
    const int64_t K = 12, modes = 2 * K + 1;
    Sources one(60, 0.8), other = one;
    for (size_t i = 0; i < one.a.size(); ++i) {
        one.a[i] = other.a[i] = one.a[i / 20 * 20];
        other.c[i] = std::conj(one.c[i]) * 1.5;
    }
    std::vector<Complex> both = one.c;
    both.insert(both.end(), other.c.begin(), other.c.end());
    for (const double eps : {1e-3, 1e-7, 1e-12}) {
        Type1Transform nufft({-0.8, 0.8}, {-0.8, 0.8}, K, eps, 2);
        nufft.add(one.a, one.b, both);
        for (size_t which = 0; which < 2; ++which)
            nufft.rows(
                -K, K,
                [&](int64_t jy, std::span<const Complex> row) {
                    ASSERT_EQ(row.size(), static_cast<size_t>(modes));
                    for (int64_t jx = -K; jx <= K; jx += 3)
                        EXPECT_LE(std::abs(row[static_cast<size_t>(jx + K)] -
                                           (which == 0 ? one : other).direct(jx, jy)),
                                  eps * 1.5 * one.strength);
                },
                which);
    }
}

// Sources at the very ends of a band that lies off the origin.
TEST(Nufft, BandMayEndAtItsSources) {
    Sources sources(2, 1);
    sources.a = sources.b = {0.25, 1.75};
    for (const double eps : {1e-2, 1e-6, 1e-12}) {
        const std::vector<Complex> out = transform(sources, {0.25, 1.75}, 5, eps, 11);
        EXPECT_LE(std::abs(out[0] - sources.direct(-5, -5)), eps * sources.strength);
        EXPECT_LE(std::abs(out[120] - sources.direct(5, 5)), eps * sources.strength);
    }
}

TEST(Nufft, NoSourcesGiveZeros) {
    Type1Transform({-1, 1}, {-1, 1}, 1, 1e-6)
        .rows(-1, 1, [](int64_t, std::span<const Complex> modes) {
            for (const Complex value : modes)
                EXPECT_EQ(value, 0.0);
        });
}

TEST(Phasor, IsGoodToRounding) {
    for (int i = -4000; i <= 4000; ++i)
        for (const double scale : {0.000131, 0.0625, 0.125, 7.77, 1e5}) {
            const double t = i * scale;
            double cosine, sine;
            phasor(t, cosine, sine);
            const long double rest = static_cast<long double>(t) - std::round(t);
            const long double angle = 2 * std::numbers::pi_v<long double> * rest;
            EXPECT_NEAR(cosine, static_cast<double>(std::cos(angle)), 5e-16) << t;
            EXPECT_NEAR(sine, static_cast<double>(std::sin(angle)), 5e-16) << t;
        }
}

TEST(Fft, GoodLengthsHaveSmallFactorsAndAreNoLongPowersOfTwo) {
    EXPECT_EQ(good_fft_length(1), 1);
    EXPECT_EQ(good_fft_length(11), 12);
    EXPECT_EQ(good_fft_length(64), 72);
    EXPECT_EQ(good_fft_length(337), 360);
    EXPECT_EQ(good_fft_length(512), 540);
}

} // namespace
} // namespace wfpsf
