// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/fft.hpp"
#include "numerics/nufft.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <random>
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

TEST(Nufft, MeetsTheDirectSumWithinTheToleranceAskedFor) {
    for (const int64_t K : {0, 1, 7, 40})
        for (const double reach : {0.01, 0.8, 3.14})
            for (const double eps : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13}) {
                const Sources sources(60, reach);
                const int64_t modes = 2 * K + 1;
                std::vector<Complex> out(static_cast<size_t>(modes * modes));
                nufft_type1(sources.a, sources.b, sources.c, K, eps, out.data());
                double worst = 0;
                for (int64_t jy = -K; jy <= K; jy += std::max<int64_t>(1, K / 5))
                    for (int64_t jx = -K; jx <= K; jx += std::max<int64_t>(1, K / 5))
                        worst = std::max(
                            worst, std::abs(out[static_cast<size_t>((jy + K) * modes + jx + K)] -
                                            sources.direct(jx, jy)));
                EXPECT_LE(worst / sources.strength, eps) << K << ' ' << reach << ' ' << eps;
            }
}

TEST(Nufft, NoSourcesGiveZeros) {
    std::vector<Complex> out(9, 1.0);
    nufft_type1({}, {}, {}, 1, 1e-6, out.data());
    for (const Complex value : out)
        EXPECT_EQ(value, 0.0);
}

TEST(Fft, GoodLengthsHaveSmallFactorsAndAreNoLongPowersOfTwo) {
    EXPECT_EQ(good_fft_length(1), 1);
    EXPECT_EQ(good_fft_length(11), 12);
    EXPECT_EQ(good_fft_length(64), 70);
    EXPECT_EQ(good_fft_length(337), 343);
    EXPECT_EQ(good_fft_length(512), 525);
}

} // namespace
} // namespace wfpsf
