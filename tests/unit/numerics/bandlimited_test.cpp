// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "numerics/bandlimited.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
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

TEST(Bandlimited, LongFiltersLoseNothingByRounding) {
    for (const double bandwidth : {0.05, 0.2, 0.35}) {
        const BandlimitedInterpolator interpolator(bandwidth, 0);
        std::vector<double> w(static_cast<size_t>(interpolator.taps()));
        for (const double x : {0.125, 0.25, 0.375, 0.5}) {
            interpolator.weights(x, w.data());
            EXPECT_NEAR(double(std::accumulate(w.begin(), w.end(), 0.0L) - 1), 0, 6e-16)
                << bandwidth << ' ' << x;
        }
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

// A fully lit outline's spectrum, by plain sums over strips of it. Its integral is one.
std::vector<double> outline_spectrum(Outline outline, int frequencies) {
    const int strips = 2 * frequencies;
    std::vector<double> length, spectrum;
    for (int i = 0; i < strips; ++i) {
        const double x = (2 * i + 1.0) / strips - 1;
        length.push_back(outline == Outline::square ? 1 : std::sqrt(1 - x * x));
    }
    double total = 0;
    for (int q = 0; q < frequencies; ++q) { // at (q + 1/2) / frequencies, between two shifts
        double sum = 0;
        for (size_t shift : {2 * q, 2 * q + 1, 2 * q + 1, 2 * q + 2})
            for (size_t i = 0; i + shift < length.size(); ++i)
                sum += length[i] * length[i + shift];
        spectrum.push_back(sum);
        total += sum;
    }
    for (double &value : spectrum)
        value /= total;
    return spectrum;
}

// The errors of averaging and of interpolating along one axis, at the worst of many positions.
double error_over_spectrum(const AveragedSamples &samples, double bandwidth, double width,
                           const std::vector<double> &spectrum) {
    const BandlimitedInterpolator &interpolator = samples.interpolator();
    const std::vector<double> &filter = samples.averaging();
    std::vector<double> w(static_cast<size_t>(interpolator.taps()));
    const int m = static_cast<int>(filter.size()) / 2;
    double worst = 0;
    for (int p = 0; p <= 25; ++p) {
        const double x = p / 25.0;
        const int64_t first = interpolator.weights(x, w.data());
        double sum = 0;
        for (size_t q = 0; q < spectrum.size(); ++q) {
            const double s = (static_cast<double>(q) + 0.5) / static_cast<double>(spectrum.size());
            const double k = 2 * pi * bandwidth * s;
            double response = 0;
            for (int j = -m; j <= m; ++j)
                response += filter[static_cast<size_t>(m + j)] * std::cos(k * j);
            std::complex<double> wave = 0;
            for (size_t t = 0; t < w.size(); ++t)
                wave += std::polar(w[t], k * (static_cast<double>(first) + static_cast<double>(t)));
            const double average = std::sin(k * width / 2) / (k * width / 2);
            sum += spectrum[q] * std::abs(response * wave - average * std::polar(1.0, k * x));
        }
        worst = std::max(worst, sum);
    }
    return worst;
}

TEST(AveragedSamples, OfAnAperturesSpectrumErrByNoMoreThanStated) {
    for (const Outline outline : {Outline::square, Outline::round}) {
        const std::vector<double> spectrum = outline_spectrum(outline, 120);
        for (const double bandwidth : {0.05, 0.17, 0.2275, 0.2435, 0.25, 0.3, 0.4})
            for (const double width : {1.0, 2.0, 3.0, 4.0, 6.0, 11.0})
                for (double eps = 1e-1; eps > 1e-13; eps /= 10) {
                    const AveragedSamples samples(bandwidth, width, outline, eps);
                    const double worst =
                        2 * error_over_spectrum(samples, bandwidth, width, spectrum);
                    EXPECT_LE(worst, samples.error()) << bandwidth << ' ' << width << ' ' << eps;
                    EXPECT_LE(samples.error(), std::max(eps, 5e-14)) << bandwidth << ' ' << width;
                    EXPECT_LE(samples.interpolator().half_width(),
                              BandlimitedInterpolator(bandwidth, eps / 4).half_width())
                        << bandwidth << ' ' << width << ' ' << eps;
                }
    }
}

TEST(AveragedSamples, OutlineIsAsStrongAsItIsEmpty) {
    EXPECT_DOUBLE_EQ(outline_strength(Outline::square, 2, 4), 1);
    EXPECT_DOUBLE_EQ(outline_strength(Outline::round, 2, pi / 2), 4);
}

TEST(Bandlimited, BandwidthOutsideItsRangeIsRefused) {
    for (const double bandwidth : {0.0, -0.1, 0.5, 0.7, std::nan("")}) {
        EXPECT_THROW(BandlimitedInterpolator(bandwidth, 1e-6), Error);
        EXPECT_THROW(AveragedSamples(bandwidth, 4, Outline::round, 1e-6), Error);
    }
}

} // namespace
} // namespace wfpsf
