// SPDX-License-Identifier: GPL-3.0-or-later
// Analytic derivatives against finite differences of whole measurements, covariances against noise.
#include "error/error.hpp"
#include "gaussian_image.hpp"
#include "moments/covariance.hpp"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <ostream>
#include <random>
#include <vector>

namespace wfpsf {
namespace {

constexpr int64_t nx = 60, ny = 56;

Plane<double> star() {
    Plane<double> image = gaussian_image(nx, ny, gaussian_of(29.3, 27.6, 3, 0.25, -0.2), 100);
    add_gaussian(image.view(), gaussian_of(31.1, 26.2, 5, -0.1, 0.3), 40);
    add_gaussian(image.view(), gaussian_of(26.5, 31.0, 2, 0, 0.1), -6);
    return image;
}

Plane<double> change(int kind) {
    Plane<double> image(nx, ny);
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x) {
            const double u = static_cast<double>(x) - 28, v = static_cast<double>(y) - 29;
            image(x, y) = kind == 0 ? 0.4 * std::exp(-(u * u + 0.3 * u * v + 2 * v * v) / 30) * u
                                    : 0.3 * std::exp(-(u * u + v * v) / 60) * (1 - 0.2 * v);
        }
    return image;
}

Quantities<double> numbers(const AdaptiveMoments &m) {
    const Gaussian &w = m.weight;
    MomentSet<double> p{w.x, w.y, w.Mxx, w.Mxy, w.Myy, m.flux, m.background};
    set_matrix(p, std::sqrt(w.det()), m.e1, m.e2);
    return quantities_of(p);
}

struct Setting {
    const char *name;
    MomentsMethod method;
    bool masked;
};

void PrintTo(const Setting &setting, std::ostream *out) {
    *out << setting.name;
}

Plane<float> mask_of(bool masked) {
    Plane<float> missing(masked ? nx : 0, masked ? ny : 0);
    if (masked)
        for (int64_t i = 0; i < 5; ++i)
            missing(29 + i, 24 + i) = missing(26, 26 + i) = 1;
    return missing;
}

class Derivatives : public testing::TestWithParam<Setting> {};

TEST_P(Derivatives, AgreeWithFiniteDifferences) {
    const Plane<double> image = star(), A = change(0), B = change(1);
    const Plane<float> missing = mask_of(GetParam().masked);
    const AdaptiveOptions options{
        .tolerance = 1e-12, .method = GetParam().method, .background = 0.01};
    const Gaussian guess{29, 27, 9, 0, 9};
    const auto measured = [&](double a, double b) {
        Plane<double> sum(nx, ny);
        for (int64_t y = 0; y < ny; ++y)
            for (int64_t x = 0; x < nx; ++x)
                sum(x, y) = image(x, y) + a * A(x, y) + b * B(x, y);
        const AdaptiveMoments m = adaptive_moments(view_of(sum), guess, options, missing.view());
        EXPECT_EQ(m.status, WFPSF_OK) << m.line;
        return m;
    };
    const AdaptiveMoments m = measured(0, 0);
    const Sensitivity sensitivity(view_of(image), m, options, missing.view(), true);
    const auto got = quantities_of(
        sensitivity.along(sensitivity.change_of(view_of(A)), sensitivity.change_of(view_of(B))));
    // Richardson: two steps extrapolated once for the second derivative, three steps for the first.
    const auto first = [&](double h, bool along_b, size_t i) {
        return (numbers(measured(along_b ? 0 : h, along_b ? h : 0))[i] -
                numbers(measured(along_b ? 0 : -h, along_b ? -h : 0))[i]) /
               (2 * h);
    };
    const auto extrapolated = [](double a, double b, double c) {
        const double ab = (4 * a - b) / 3, bc = (4 * b - c) / 3;
        return (16 * ab - bc) / 15;
    };
    const auto mixed = [&](double h, size_t i) {
        return (numbers(measured(h, h))[i] - numbers(measured(h, -h))[i] -
                numbers(measured(-h, h))[i] + numbers(measured(-h, -h))[i]) /
               (4 * h * h);
    };
    const auto values = numbers(m);
    for (size_t i = 0; i < got.size(); ++i) {
        const double scale = 1 + std::abs(values[i]), h = 0.02;
        EXPECT_NEAR(got[i].value, values[i], 1e-9 * scale) << i;
        EXPECT_NEAR(
            got[i].da,
            extrapolated(first(h / 4, false, i), first(h / 2, false, i), first(h, false, i)),
            1e-8 * scale)
            << i;
        EXPECT_NEAR(got[i].db,
                    extrapolated(first(h / 4, true, i), first(h / 2, true, i), first(h, true, i)),
                    1e-8 * scale)
            << i;
        EXPECT_NEAR(got[i].dab, extrapolated(mixed(h / 2, i), mixed(h, i), mixed(2 * h, i)),
                    1e-7 * scale)
            << i;
    }
}

TEST_P(Derivatives, AreSumsOverTheInfluenceFunction) {
    const Plane<double> image = star(), A = change(0);
    const Plane<float> missing = mask_of(GetParam().masked);
    const AdaptiveOptions options{.tolerance = 1e-12, .method = GetParam().method};
    const AdaptiveMoments m =
        adaptive_moments(view_of(image), Gaussian{29, 27, 9, 0, 9}, options, missing.view());
    const Sensitivity sensitivity(view_of(image), m, options, missing.view());
    const ImageChange along = sensitivity.change_of(view_of(A));
    const auto got = quantities_of(sensitivity.along(along, along));
    const Sensitivity::Slopes slopes = sensitivity.slopes();
    for (size_t i = 0; i < got.size(); ++i) {
        Plane<double> influence(nx, ny);
        sensitivity.add_influence(slopes[i], influence.view());
        double sum = 0;
        for (int64_t y = 0; y < ny; ++y)
            for (int64_t x = 0; x < nx; ++x)
                sum += influence(x, y) * A(x, y);
        EXPECT_NEAR(sum, got[i].da, 1e-11 * (1 + std::abs(got[i].da))) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Methods, Derivatives,
    testing::Values(Setting{"adaptive", MomentsMethod::adaptive, false},
                    Setting{"adaptive_masked", MomentsMethod::adaptive, true},
                    Setting{"least_squares", MomentsMethod::least_squares, false},
                    Setting{"least_squares_masked", MomentsMethod::least_squares, true},
                    Setting{"round", MomentsMethod::round, false},
                    Setting{"round_masked", MomentsMethod::round, true},
                    Setting{"with_background", MomentsMethod::with_background, false},
                    Setting{"with_background_masked", MomentsMethod::with_background, true}),
    [](const auto &setting) { return std::string(setting.param.name); });

// Standard deviations of noisy measurements over those that are predicted from the clean image.
struct NoiseRatios {
    Quantities<double> first{}, second{};
    int failures = 0;
};

double deviation_of(const std::vector<double> &v) {
    double sum = 0, squares = 0;
    for (const double value : v)
        sum += value - v[0];
    const double mean = v[0] + sum / static_cast<double>(v.size());
    for (const double value : v)
        squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(v.size()));
}

NoiseRatios noise_ratios(double signal_to_noise, MomentsMethod method, int trials) {
    const Gaussian star = gaussian_of(16.3, 15.8, 2.4, 0.2, 0.1);
    const double flux = signal_to_noise * 2 * std::sqrt(std::numbers::pi * std::sqrt(star.det()));
    const Plane<double> clean = gaussian_image(33, 33, star, flux);
    Plane<double> variance(33, 33);
    for (int64_t y = 0; y < 33; ++y)
        for (int64_t x = 0; x < 33; ++x)
            variance(x, y) = 0.6 + 0.025 * static_cast<double>(x);
    const AdaptiveOptions options{.tolerance = 1e-6, .method = method};
    const AdaptiveMoments m = adaptive_moments(view_of(clean), star, options);
    EXPECT_EQ(m.status, WFPSF_OK) << m.line;
    const auto predicted = [&](int order) {
        return covariance(view_of(clean), m, options, {}, view_of(variance), order);
    };
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::array<std::vector<double>, quantities> values;
    NoiseRatios ratios;
    for (int trial = 0; trial < trials; ++trial) {
        Plane<double> image(33, 33);
        for (int64_t y = 0; y < 33; ++y)
            for (int64_t x = 0; x < 33; ++x)
                image(x, y) = clean(x, y) + std::sqrt(variance(x, y)) * normal(random);
        const AdaptiveMoments n = adaptive_moments(view_of(image), star, options);
        if (n.status != WFPSF_OK) {
            ++ratios.failures;
            continue;
        }
        const auto found = numbers(n);
        for (size_t i = 0; i < quantities; ++i)
            values[i].push_back(found[i]);
    }
    const MomentsCovariance first = predicted(1), second = predicted(2);
    for (size_t i = 0; i < quantities; ++i) {
        const double deviation = deviation_of(values[i]);
        ratios.first[i] = deviation / std::sqrt(first[i][i]);
        ratios.second[i] = deviation / std::sqrt(second[i][i]);
        char name[64], ratio[64];
        std::snprintf(name, sizeof name, "sn_%.0f_method_%d_quantity_%zu", signal_to_noise,
                      static_cast<int>(method), i);
        std::snprintf(ratio, sizeof ratio, "%.3f %.3f", ratios.first[i], ratios.second[i]);
        testing::Test::RecordProperty(name, ratio);
    }
    return ratios;
}

constexpr size_t background_place = 12;

TEST(Covariance, FirstOrderAgreesWithNoise) {
    for (const double signal_to_noise : {200.0, 50.0}) {
        const NoiseRatios ratios = noise_ratios(signal_to_noise, MomentsMethod::adaptive, 3000);
        EXPECT_EQ(ratios.failures, 0);
        for (size_t i = 0; i < background_place; ++i)
            EXPECT_NEAR(ratios.first[i], 1, 0.05)
                << "S/N " << signal_to_noise << ", quantity " << i;
    }
}

TEST(Covariance, SecondOrderAgreesWithNoiseDownToTen) {
    for (const double signal_to_noise : {50.0, 10.0}) {
        const NoiseRatios ratios = noise_ratios(signal_to_noise, MomentsMethod::adaptive, 3000);
        EXPECT_LE(ratios.failures, 3);
        double worst_first = 0;
        for (size_t i = 0; i < background_place; ++i) {
            EXPECT_NEAR(ratios.second[i], 1, signal_to_noise >= 50 ? 0.05 : 0.2)
                << "S/N " << signal_to_noise << ", quantity " << i;
            worst_first = std::max(worst_first, std::abs(ratios.first[i] - 1));
        }
        // At S/N 10 the second order is needed.
        EXPECT_GT(worst_first, signal_to_noise >= 50 ? 0 : 0.2);
    }
    // Where it ends: second moments have heavy tails, and some fits fail.
    const NoiseRatios seven = noise_ratios(7, MomentsMethod::adaptive, 3000);
    EXPECT_GT(seven.failures, 3);
    EXPECT_GT(seven.second[2], 1.2);
}

// Predicted from noisy images, as it must be: in the median still good, though single predictions
// scatter with the moments themselves.
TEST(Covariance, SecondOrderFromNoisyImages) {
    const Gaussian star = gaussian_of(16.3, 15.8, 2.4, 0.2, 0.1);
    const double variance = 1;
    const double flux = 10 * 2 * std::sqrt(std::numbers::pi * std::sqrt(star.det()));
    const Plane<double> clean = gaussian_image(33, 33, star, flux);
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::array<std::vector<double>, background_place> values, predicted;
    for (int trial = 0; trial < 2000; ++trial) {
        Plane<double> image = clean;
        for (int64_t y = 0; y < 33; ++y)
            for (int64_t x = 0; x < 33; ++x)
                image(x, y) += normal(random);
        const AdaptiveMoments m = adaptive_moments(view_of(image), star);
        if (m.status != WFPSF_OK)
            continue;
        const auto found = numbers(m);
        for (size_t i = 0; i < background_place; ++i)
            values[i].push_back(found[i]);
        if (trial >= 100)
            continue;
        const MomentsCovariance c =
            covariance(view_of(image), m, {}, {}, View<const double>{&variance, 33, 33, 0, 0}, 2);
        for (size_t i = 0; i < background_place; ++i)
            if (std::isfinite(c[i][i]))
                predicted[i].push_back(std::sqrt(c[i][i]));
    }
    for (size_t i = 0; i < background_place; ++i) {
        EXPECT_GE(predicted[i].size(), 70u);
        std::ranges::nth_element(predicted[i], predicted[i].begin() + static_cast<std::ptrdiff_t>(
                                                                          predicted[i].size() / 2));
        EXPECT_NEAR(deviation_of(values[i]) / predicted[i][predicted[i].size() / 2], 1, 0.2) << i;
    }
}

TEST(Covariance, OfAFittedBackground) {
    const NoiseRatios ratios = noise_ratios(50, MomentsMethod::with_background, 3000);
    EXPECT_EQ(ratios.failures, 0);
    for (size_t i = 0; i < quantities; ++i) {
        EXPECT_NEAR(ratios.first[i], 1, 0.06) << "quantity " << i;
        EXPECT_NEAR(ratios.second[i], 1, 0.05) << "quantity " << i;
    }
}

TEST(Covariance, RefusesImpossibleVariances) {
    const Plane<double> image = star();
    const AdaptiveMoments m = adaptive_moments(view_of(image));
    const Sensitivity sensitivity(view_of(image), m, {});
    const auto status = [&](double value) {
        try {
            sensitivity.noise(View<const double>{&value, nx, ny, 0, 0});
        } catch (const Error &error) {
            return error.status();
        }
        return static_cast<wfpsf_status>(WFPSF_OK);
    };
    EXPECT_EQ(status(1), WFPSF_OK);
    EXPECT_EQ(status(-1), WFPSF_ERROR_RANGE);
    EXPECT_EQ(status(std::nan("")), WFPSF_ERROR_NOT_FINITE);
}

} // namespace
} // namespace wfpsf
