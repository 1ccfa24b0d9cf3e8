// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "numerics/bandlimited.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;

// The worst error over all pure waves of the band and positions between two samples.
double worst_wave_error(const BandlimitedInterpolator &interpolator, double bandwidth) {
    std::vector<double> w(static_cast<size_t>(interpolator.taps()));
    double worst = 0;
    for (int p = 0; p <= 40; ++p) {
        const double x = p / 40.0;
        const int64_t first = interpolator.weights(x, w.data());
        for (int q = -100; q <= 100; ++q) {
            const double frequency = bandwidth * q / 100;
            std::complex<double> sum = 0;
            for (size_t k = 0; k < w.size(); ++k)
                sum += std::polar(w[k], 2 * pi * frequency *
                                            static_cast<double>(first + static_cast<int64_t>(k)));
            worst = std::max(worst, std::abs(sum - std::polar(1.0, 2 * pi * frequency * x)));
        }
    }
    return worst;
}

TEST(Bandlimited, WavesOfTheBandAreMetWithinTheStatedError) {
    for (const double bandwidth : {0.05, 0.1, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45})
        for (double eps = 1e-2; eps > 1e-13; eps /= 10) {
            const BandlimitedInterpolator interpolator(bandwidth, eps);
            const double worst = worst_wave_error(interpolator, bandwidth);
            EXPECT_LE(worst, interpolator.error()) << bandwidth << ' ' << eps;
            EXPECT_LE(interpolator.error(), std::max(1.01 * eps, 2e-14));
        }
}

TEST(Bandlimited, SamplesThemselvesAreReturnedUnchanged) {
    const BandlimitedInterpolator interpolator(0.25, 1e-6);
    std::vector<double> w(static_cast<size_t>(interpolator.taps()));
    const int64_t first = interpolator.weights(-7.0, w.data());
    for (size_t k = 0; k < w.size(); ++k)
        EXPECT_EQ(w[k], first + static_cast<int64_t>(k) == -7 ? 1.0 : 0.0);
}

TEST(Bandlimited, PlacesNextToASampleAreAsGoodAsAnyOther) {
    for (const double eps : {1e-3, 1e-9}) {
        const BandlimitedInterpolator interpolator(0.25, eps);
        std::vector<double> w(static_cast<size_t>(interpolator.taps()));
        for (int sample = -3; sample <= 3; ++sample)
            for (const double gap : {0x1p-53, -0x1p-53, 0x1p-52, -0x1p-51, 1e-13, -1e-13, -1e-9}) {
                const double x = sample + gap;
                const int64_t first = interpolator.weights(x, w.data());
                for (size_t k = 0; k < w.size(); ++k)
                    EXPECT_NEAR(w[k], first + static_cast<int64_t>(k) == sample ? 1.0 : 0.0,
                                2 * std::abs(gap) + 1e-15);
            }
    }
}

TEST(Bandlimited, AveragingFilterMultipliesWavesByTheWindowsSinc) {
    const double bandwidth = 0.25;
    for (const double width : {0.3, 1.0, 3.7, 4.0, 32.0})
        for (const double eps : {1e-4, 1e-8, 1e-12}) {
            const BandlimitedInterpolator interpolator(bandwidth, eps);
            const std::vector<double> filter = interpolator.averaging_filter(width);
            const int m = static_cast<int>(filter.size()) / 2;
            for (int q = 0; q <= 50; ++q) {
                const double k = 2 * pi * bandwidth * q / 50;
                double response = 0;
                for (int j = -m; j <= m; ++j)
                    response += filter[static_cast<size_t>(m + j)] * std::cos(k * j);
                const double sinc = q == 0 ? 1 : std::sin(k * width / 2) / (k * width / 2);
                EXPECT_NEAR(response, sinc, interpolator.error() + 1e-13) << width << ' ' << eps;
            }
        }
}

TEST(Bandlimited, BandwidthOutsideItsRangeIsRefused) {
    for (const double bandwidth : {0.0, -0.1, 0.5, 0.7, std::nan("")})
        EXPECT_THROW(BandlimitedInterpolator(bandwidth, 1e-6), Error);
}

} // namespace
} // namespace wfpsf
