// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "instrument/instrument.hpp"
#include "optics/spectrum.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace wfpsf {
namespace {

const Band &band(const char *instrument, const char *name) {
    return Instrument::get(instrument).band(name);
}

// Integral of throughput * sed(nm) * f(nm) by Simpson's rule on very many steps, between all
// samples of the band.
template <class Sed, class Function>
double plain_integral(const Band &b, const Sed &sed, const Function &f) {
    const int steps = 200;
    double sum = 0;
    for (size_t i = 0; i + 1 < b.throughput.size(); ++i)
        for (int k = 0; k < steps; ++k)
            for (const auto &[part, weight] :
                 {std::pair(0.0, 1.0), std::pair(0.5, 4.0), std::pair(1.0, 1.0)}) {
                const double t = (k + part) / steps;
                const double nm = b.wavelength_nm(i) + t * b.step_nm;
                sum += weight / 6 / steps * b.step_nm * sed(nm) * f(nm) *
                       std::lerp(b.throughput[i], b.throughput[i + 1], t);
            }
    return sum;
}

double rule_sum(const WavelengthRule &rule, const std::vector<double> &weights, auto f) {
    double sum = 0;
    for (size_t k = 0; k < rule.size(); ++k)
        sum += weights[k] * f(rule.wavelengths()[k] * 1e9);
    return sum;
}

TEST(Spectrum, SedsFollowTheirFormulas) {
    const auto ratio = [](const Sed &sed, double a, double b) {
        return sed.photons(a) / sed.photons(b);
    };
    EXPECT_DOUBLE_EQ(ratio(power_law_sed(SedUnit::photons, 0), 900, 2000), 1);
    EXPECT_DOUBLE_EQ(ratio(power_law_sed(SedUnit::energy, 0), 900, 2000), 0.45);
    EXPECT_DOUBLE_EQ(ratio(power_law_sed(SedUnit::energy, -2), 1000, 2000), 2); // flat in F_nu
    // Planck: energy peaks at 2897.77 um K / T (Wien).
    const Sed sun = black_body_sed(5772);
    const auto energy = [&sun](double nm) { return sun.photons(nm) / nm; };
    const double peak = 2.897771955e6 / 5772;
    EXPECT_GT(energy(peak), energy(peak * 1.001));
    EXPECT_GT(energy(peak), energy(peak / 1.001));
    EXPECT_NEAR(energy(peak * 1.001) / energy(peak / 1.001), 1, 1e-7);
    // Rayleigh and Jeans: energy falls as the fourth power.
    EXPECT_NEAR(ratio(black_body_sed(1e9), 1000, 2000), 8, 1e-4);
    EXPECT_TRUE(std::isfinite(black_body_sed(50).photons(2000)));
    EXPECT_DOUBLE_EQ(redshifted_sed(sun, 1).photons(1600), sun.photons(800));
    const std::array nm = {500.0, 1000.0, 1500.0}, values = {1.0, 3.0, 2.0};
    const Sed table = tabulated_sed(SedUnit::photons, nm, values);
    EXPECT_DOUBLE_EQ(table.photons(500), 1);
    EXPECT_DOUBLE_EQ(table.photons(750), 2);
    EXPECT_DOUBLE_EQ(table.photons(1250), 2.5);
    EXPECT_DOUBLE_EQ(table.photons(1500), 2);
    EXPECT_DOUBLE_EQ(tabulated_sed(SedUnit::energy, nm, values).photons(750), 1500);
    EXPECT_EQ(redshifted_sed(table, 0.5).kinks_nm, (std::vector{750.0, 1500.0, 2250.0}));
}

TEST(Spectrum, MeanWavelengthOfAFlatSourceIsTheBands) {
    for (const char *name : {"Z087", "J129", "W149"}) {
        const Band &b = band("wfirst-afta-c5", name);
        const double mean =
            detected_light(b, power_law_sed(SedUnit::photons, 0))(0).mean_wavelength() * 1e9;
        EXPECT_NEAR(mean / tabulated_wavelengths(b).effective_nm, 1, 1e-13) << name;
    }
}

// A rule of n points integrates what varies smoothly with wavelength, with the rough throughput in
// the weights: here polynomials, to the promised degree, and a wave.
TEST(Spectrum, GaussRulesAreExactForPolynomials) {
    const Band &b = band("roman-c9", "W146");
    const Sed sed = black_body_sed(4000);
    const Spectrum light = detected_light(b, sed)(0);
    const double all = plain_integral(b, sed.photons, [](double) { return 1; });
    for (const size_t n : {1, 2, 5, 12, 40}) {
        const WavelengthRule rule(light, n);
        ASSERT_EQ(rule.size(), n);
        const std::vector<double> weights = rule.weights(light);
        for (const size_t degree : {size_t{0}, n - 1, n, 2 * n - 1}) {
            const auto power = [degree](double nm) {
                return std::pow((1000 / nm - 0.79) / 0.29, static_cast<double>(degree));
            };
            EXPECT_NEAR(rule_sum(rule, weights, power), plain_integral(b, sed.photons, power) / all,
                        2e-10)
                << n << ' ' << degree;
        }
    }
    const auto wave = [](double nm) { return std::cos(nm / 30); };
    const WavelengthRule rule(light, 40);
    EXPECT_NEAR(rule_sum(rule, rule.weights(light), wave),
                plain_integral(b, sed.photons, wave) / all, 1e-10);
}

// One rule for two sources: a smooth one and one with a narrow line.
TEST(Spectrum, SourcesShareWavelengths) {
    const Band &b = band("wfirst-afta-c5", "J129");
    const Sed smooth = black_body_sed(6000);
    std::vector<double> nm, values;
    for (double at = 1000; at <= 1600; at += 1) {
        nm.push_back(at);
        values.push_back(1 + 50 * std::exp(-std::pow((at - 1250) / 4, 2)));
    }
    const Sed line = tabulated_sed(SedUnit::photons, nm, values);
    const Spectrum a = detected_light(b, smooth)(0), c = detected_light(b, line)(0);
    const WavelengthRule rule(together(std::vector{a, c}), 16);
    const auto wave = [](double at) { return std::cos(4e4 / at); };
    const auto expect = [&](const Spectrum &light, const Sed &sed) {
        double sum = 0;
        for (size_t i = 0; i < light.size(); ++i)
            sum += light.weight[i] * wave(light.wavelength[i] * 1e9);
        EXPECT_NEAR(rule_sum(rule, rule.weights(light), wave), sum, 1e-8);
        EXPECT_GT(sed.photons(1250), 0);
    };
    expect(a, smooth);
    expect(c, line);
}

// A line so narrow that it has but a few points, and a source of one wavelength.
TEST(Spectrum, NarrowSourcesAreTheirOwnRule) {
    const Spectrum point = monochromatic(1e-6)(0);
    const WavelengthRule one(point, 8);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_TRUE(one.exact());
    EXPECT_EQ(one.wavelengths()[0], 1e-6);
    EXPECT_EQ(one.weights(point)[0], 1);
    const std::array nm = {500.0, 1249.9, 1250.0, 1250.1, 2500.0};
    const std::array values = {0.0, 0.0, 1.0, 0.0, 0.0};
    const Spectrum light = detected_light(band("wfirst-afta-c5", "J129"),
                                          tabulated_sed(SedUnit::photons, nm, values))(0);
    EXPECT_LE(light.size(), 20u);
    EXPECT_NEAR(light.mean_wavelength(), 1250e-9, 1e-13);
    const WavelengthRule rule(light, 100);
    EXPECT_TRUE(rule.exact());
    EXPECT_EQ(rule.weights(light), light.weight);
}

// The finer the fringes, the more points: their sum stays exact.
TEST(Spectrum, LongOpticalPathsAreResolved) {
    const Band &b = band("wfirst-afta-c5", "H158");
    const auto flat = [](double) { return 1; };
    const double all = plain_integral(b, flat, flat);
    const Light light = detected_light(b, power_law_sed(SedUnit::photons, 0));
    for (const double path : {0.0, 3e-5, 3e-3}) {
        const auto fringes = [path](double nm) {
            return std::cos(2 * std::numbers::pi * path / (nm * 1e-9));
        };
        const Spectrum spectrum = light(path);
        double sum = 0;
        for (size_t i = 0; i < spectrum.size(); ++i)
            sum += spectrum.weight[i] * fringes(spectrum.wavelength[i] * 1e9);
        EXPECT_NEAR(sum, plain_integral(b, flat, fringes) / all, 2e-7) << path;
    }
}

TEST(Spectrum, BadSourcesAreRefused) {
    const auto refused = [](auto make, wfpsf_status status) {
        try {
            make();
            ADD_FAILURE() << "not refused";
        } catch (const Error &error) {
            EXPECT_EQ(error.status(), status) << error.what();
        }
    };
    const Band &b = band("wfirst-afta-c5", "J129");
    const std::array nm = {1000.0, 1200.0, 1100.0}, values = {1.0, 1.0, 1.0};
    const std::array rising = {1000.0, 1100.0, 1200.0}, negative = {1.0, -1.0, 1.0};
    const std::array wide = {900.0, 1100.0, 2500.0}, dark = {0.0, 0.0, 0.0};
    refused([&] { tabulated_sed(SedUnit::photons, nm, values); }, WFPSF_ERROR_RANGE);
    refused([&] { tabulated_sed(SedUnit::photons, rising, negative); }, WFPSF_ERROR_RANGE);
    refused([&] { tabulated_sed(SedUnit::photons, {}, {}); }, WFPSF_ERROR_SIZE);
    refused([&] { detected_light(b, tabulated_sed(SedUnit::photons, rising, values)); },
            WFPSF_ERROR_RANGE);
    refused([&] { detected_light(b, tabulated_sed(SedUnit::photons, wide, dark)); },
            WFPSF_ERROR_ARGUMENT);
    refused([] { black_body_sed(0); }, WFPSF_ERROR_RANGE);
    refused([] { black_body_sed(std::nan("")); }, WFPSF_ERROR_RANGE);
    refused([] { power_law_sed(SedUnit::energy, 1e3); }, WFPSF_ERROR_RANGE);
    refused([] { redshifted_sed(power_law_sed(SedUnit::energy, 0), -1); }, WFPSF_ERROR_RANGE);
}

} // namespace
} // namespace wfpsf
