// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/default_chain.hpp"
#include "detector/effects.hpp"
#include "error/error.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numeric>

namespace wfpsf {
namespace {

Image make_image(PixelType type, int64_t nx, int64_t ny, double value) {
    Image image(type, nx, ny);
    std::visit(
        [&](auto pixels) {
            for (int64_t y = 0; y < ny; ++y)
                for (int64_t x = 0; x < nx; ++x)
                    pixels(x, y) = static_cast<std::remove_reference_t<decltype(pixels(0, 0))>>(
                        value * (1 + 0.01 * static_cast<double>(x + 3 * y)));
        },
        image.pixels());
    return image;
}

double pixel(const Image &image, int64_t x, int64_t y) {
    return std::visit([&](const auto &pixels) { return static_cast<double>(pixels(x, y)); },
                      image.pixels());
}

Chain chain_of(StepKind kind, std::initializer_list<double> parameters) {
    Chain chain;
    chain.add(kind, std::vector(parameters));
    return chain;
}

wfpsf_status status_of(const std::function<void()> &call) {
    try {
        call();
    } catch (const Error &error) {
        return error.status();
    }
    return WFPSF_OK;
}

TEST(Chain, BitsDependNeitherOnThreadsNorOnTiles) {
    const Instrument &roman = Instrument::get("roman-c9");
    for (const PixelType type : {PixelType::float32, PixelType::float64}) {
        Image one = make_image(type, 530, 41, 300), many = make_image(type, 530, 41, 300);
        const Chain chain = default_chain(roman, 139.8);
        chain.run({.random = {.seed = 9}}, one);
        chain.run({.random = {.seed = 9}, .threads = 7}, many);
        for (int64_t y = 0; y < 41; ++y)
            for (int64_t x = 0; x < 530; ++x)
                ASSERT_EQ(pixel(one, x, y), pixel(many, x, y));
        // A tile has the bits of the whole but where IPC meets its border.
        Image source = make_image(type, 530, 41, 300), tile(type, 20, 15);
        std::visit(
            [&](auto to) {
                for (int64_t y = 0; y < 15; ++y)
                    for (int64_t x = 0; x < 20; ++x)
                        to(x, y) = static_cast<std::remove_reference_t<decltype(to(0, 0))>>(
                            pixel(source, x + 505, y + 11));
            },
            tile.pixels());
        chain.run({.random = {.seed = 9, .x0 = 505, .y0 = 11}}, tile);
        for (int64_t y = 1; y < 14; ++y)
            for (int64_t x = 1; x < 19; ++x)
                ASSERT_EQ(pixel(tile, x, y), pixel(one, x + 505, y + 11));
    }
}

TEST(Chain, RecordsAndRefusesTwice) {
    Image image = make_image(PixelType::float64, 9, 9, 100);
    const Chain chain = default_chain(Instrument::get("wfirst-afta-c5"), 168.1);
    chain.run({}, image);
    for (const Effect effect :
         {Effect::poisson_noise, Effect::reciprocity_failure, Effect::dark_current,
          Effect::nonlinearity, Effect::ipc, Effect::read_noise, Effect::gain})
        EXPECT_TRUE(image.is_applied(effect)) << effect_name(effect);
    EXPECT_FALSE(image.is_applied(Effect::persistence));
    const double before = pixel(image, 4, 4);
    const Chain late = chain_of(StepKind::read_noise, {10});
    EXPECT_EQ(status_of([&] { chain.run({}, image); }), WFPSF_ERROR_ALREADY_APPLIED);
    EXPECT_EQ(status_of([&] { late.run({}, image); }), WFPSF_ERROR_ALREADY_APPLIED);
    EXPECT_EQ(pixel(image, 4, 4), before);
    EXPECT_EQ(status_of([&] { late.run({.force = true}, image); }), WFPSF_OK);
    EXPECT_NE(pixel(image, 4, 4), before);

    Chain twice = chain_of(StepKind::dark_current, {0.1, 100});
    const double time[] = {100};
    EXPECT_EQ(status_of([&] { twice.add_map(StepKind::dark_current_map, time, image); }),
              WFPSF_ERROR_ALREADY_APPLIED);
    EXPECT_EQ(twice.steps().size(), 1U);
}

TEST(Chain, RefusesBadSteps) {
    const auto add = [](StepKind kind, std::vector<double> parameters) {
        return status_of([&] { Chain().add(kind, parameters); });
    };
    EXPECT_EQ(add(StepKind{11}, {}), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(add(StepKind::ipc, {}), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(add(StepKind::pixel_mask, {0, 1}), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(add(StepKind::gain, {}), WFPSF_ERROR_SIZE);
    EXPECT_EQ(add(StepKind::nonlinearity, {}), WFPSF_ERROR_SIZE);
    EXPECT_EQ(add(StepKind::gain, {0}), WFPSF_ERROR_RANGE);
    EXPECT_EQ(add(StepKind::gain, {NAN}), WFPSF_ERROR_NOT_FINITE);
    EXPECT_EQ(add(StepKind::charge_diffusion, {21}), WFPSF_ERROR_RANGE);
    EXPECT_EQ(add(StepKind::background, {-5}), WFPSF_OK);

    Image oversampled = make_image(PixelType::float64, 8, 8, 1);
    oversampled.set_oversampling(4);
    EXPECT_EQ(status_of([&] { Chain().run({}, oversampled); }), WFPSF_ERROR_ARGUMENT);
    Image image = make_image(PixelType::float64, 8, 8, 1),
          other = make_image(PixelType::float32, 8, 7, 1);
    Chain chain;
    chain.add_map(StepKind::capacitance_map, {}, other);
    EXPECT_EQ(status_of([&] { chain.run({}, image); }), WFPSF_ERROR_SIZE);
    const PreviousImage previous[] = {std::as_const(other).pixels()};
    EXPECT_EQ(status_of([&] { Chain().run({.previous = previous}, image); }), WFPSF_ERROR_SIZE);
}

TEST(Chain, MapsMasksAndSaturation) {
    Image image = make_image(PixelType::float64, 3, 2, 100);
    Image capacitance(PixelType::float64, 3, 2), mask(PixelType::float32, 3, 2);
    std::get<View<double>>(capacitance.pixels())(0, 0) = 2;
    for (const int64_t i : {1, 2, 3, 4, 5})
        std::get<View<double>>(capacitance.pixels())(i % 3, i / 3) = 1;
    std::get<View<float>>(mask.pixels())(1, 0) = 1;
    std::get<View<float>>(mask.pixels())(2, 1) = 2;
    Chain chain;
    const double values[] = {-1, 777};
    chain.add_map(StepKind::capacitance_map, {}, capacitance);
    chain.add_map(StepKind::pixel_mask, values, mask);
    const double level[] = {103.5};
    chain.add(StepKind::saturation, level);
    const ChainCounts counts = chain.run({}, image);
    EXPECT_EQ(pixel(image, 0, 0), 50);
    EXPECT_EQ(pixel(image, 1, 0), -1);
    EXPECT_EQ(pixel(image, 2, 0), 102);
    EXPECT_EQ(pixel(image, 0, 1), 103);
    EXPECT_EQ(pixel(image, 1, 1), 103.5);
    EXPECT_EQ(pixel(image, 2, 1), 103.5);
    EXPECT_EQ(counts.saturated, 2);
}

TEST(Chain, ChargeDiffusionIsTheDiscreteGaussian) {
    for (const double sigma : {0.1, 0.5, 2.0, 20.0}) {
        const int64_t n = 401;
        Image image(PixelType::float64, n, n);
        const View<double> pixels = std::get<View<double>>(image.pixels());
        pixels(200, 200) = 1;
        chain_of(StepKind::charge_diffusion, {sigma}).run({}, image);
        double sum = 0, xx = 0, least = 1;
        for (int64_t y = 0; y < n; ++y)
            for (int64_t x = 0; x < n; ++x) {
                sum += pixels(x, y);
                xx += pixels(x, y) * static_cast<double>((x - 200) * (x - 200));
                least = std::min(least, pixels(x, y));
            }
        EXPECT_NEAR(sum, 1, 1e-13);
        EXPECT_NEAR(xx, sigma * sigma, 1e-12 * sigma * sigma);
        EXPECT_GE(least, 0);
    }
}

TEST(Chain, CountsWhatIsNotFiniteAndKeepsItLocal) {
    Image image = make_image(PixelType::float32, 11, 11, 1000);
    std::get<View<float>>(image.pixels())(5, 5) = NAN;
    const ChainCounts counts = default_chain(Instrument::get("roman-c9"), 139.8).run({}, image);
    EXPECT_EQ(counts.not_finite, 9); // IPC spreads it by one pixel
    EXPECT_TRUE(std::isnan(pixel(image, 6, 6)));
    EXPECT_TRUE(std::isfinite(pixel(image, 7, 6)));
    Image none(PixelType::float32, 0, 5);
    EXPECT_EQ(default_chain(Instrument::get("roman-c9"), 139.8).run({}, none).not_finite, 0);
}

// Photon transfer after the whole chain: the mean of C5's steps and the variance of theirs.
TEST(Chain, VarianceAfterPoissonIpcAndReadNoiseIsTheClosedForm) {
    constexpr int64_t n = 600;
    constexpr double mean = 5000, read_noise = 10;
    const IpcKernel kernel = IpcKernel::parametric(0.02, 0.002, 0.001);
    Image image(PixelType::float64, n, n);
    const View<double> pixels = std::get<View<double>>(image.pixels());
    for (int64_t y = 0; y < n; ++y)
        std::fill_n(pixels.row(y), n, mean);
    Chain chain;
    chain.add(StepKind::poisson_noise, {});
    chain.add_ipc(kernel, Edge::wrap);
    chain.add(StepKind::read_noise, std::array{read_noise});
    chain.add(StepKind::quantisation, std::array{1.0});
    chain.run({.random = {.seed = 17}}, image);
    double sum = 0, squares = 0;
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x) {
            sum += pixels(x, y) - mean;
            squares += (pixels(x, y) - mean) * (pixels(x, y) - mean);
        }
    const double count = n * n,
                 variance = mean * kernel.sum_of_squares() + read_noise * read_noise + 1.0 / 12;
    EXPECT_NEAR(sum / count, 0, 5 * std::sqrt(mean / count));
    EXPECT_NEAR(squares / count, variance, 5 * variance * std::sqrt(2.2 / count));
    // A gain from mean and variance that knows no IPC is off by as much as the kernel says.
    EXPECT_NEAR((squares / count - read_noise * read_noise) / mean, kernel.sum_of_squares(),
                5 * std::sqrt(2.2 / count));
}

// After an exposure of e0 electrons and one of e1 before it.
double left_behind(const Chain &chain, double e0, double e1) {
    Image image(PixelType::float64, 1, 1), latest(PixelType::float64, 1, 1),
        earlier(PixelType::float64, 1, 1);
    std::get<View<double>>(latest.pixels())(0, 0) = e0;
    std::get<View<double>>(earlier.pixels())(0, 0) = e1;
    const PreviousImage previous[] = {std::as_const(latest).pixels(),
                                      std::as_const(earlier).pixels()};
    chain.run({.previous = previous}, image);
    return pixel(image, 0, 0);
}

TEST(Chain, LinearPersistenceIsASharePerExposure) {
    const Chain chain = chain_of(StepKind::persistence_linear, {0.01, 0.003, 0.001});
    EXPECT_NEAR(left_behind(chain, 5e4, 2e4), 0.01 * 5e4 + 0.003 * 2e4, 1e-11);
    EXPECT_EQ(left_behind(chain, 0, 0), 0);
    EXPECT_TRUE(std::isnan(left_behind(chain, 1, NAN)));
}

TEST(Chain, FermiPersistenceIsItsClosedForm) {
    constexpr double A = 0.017, x0 = 60000, dx = 50000, a = 0.045, r = 1, half = 50000,
                     time = 139.8;
    const Chain chain = chain_of(StepKind::persistence_fermi, {A, x0, dx, a, r, half, time});
    const auto truth = [&](long double level, long double exposures) -> long double {
        const auto trapped = [&](long double x) {
            return A * std::exp(a * std::log(x / x0)) / (1 + std::exp((x0 - x) / dx)) * time *
                   std::pow(exposures * time / 1000, -r);
        };
        return level > half ? trapped(level) : trapped(half) / half * level;
    };
    for (const double e0 : {0.0, 1.0, 4e4, half, 5.1e4, 9e4, 1e6})
        for (const double e1 : {0.0, 3e4, 8e4}) {
            const auto wanted = static_cast<double>(truth(e0, 0.5L) + truth(e1, 1.5L));
            EXPECT_NEAR(left_behind(chain, e0, e1), wanted, 1e-14 * wanted) << e0 << ", " << e1;
        }
    EXPECT_EQ(left_behind(chain, -5, -1e5), 0);
    EXPECT_TRUE(std::isnan(left_behind(chain, NAN, 0)));
}

// Rounding errors are white and uniform; correction amplifies them as it does any white noise.
TEST(Chain, QuantisationNoiseGoesThroughTheCorrection) {
    constexpr int64_t n = 600;
    const IpcKernel correction = IpcKernel::parametric(0.02, 0.002, 0.001).neumann_correction(3);
    Image image(PixelType::float64, n, n);
    const View<double> pixels = std::get<View<double>>(image.pixels());
    chain_of(StepKind::read_noise, {100}).run({.random = {.seed = 23}}, image);
    Plane<double> error(n, n), corrected(n, n);
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            error(x, y) = -pixels(x, y);
    chain_of(StepKind::quantisation, {1}).run({}, image);
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            error(x, y) += pixels(x, y);
    convolve(correction, std::as_const(error).view(), {Edge::wrap}, corrected.view());
    double squares = 0;
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            squares += corrected(x, y) * corrected(x, y);
    const double variance = correction.sum_of_squares() / 12;
    EXPECT_NEAR(squares / (n * n), variance, 5 * variance * std::sqrt(2.2 / (n * n)));
}

TEST(Effects, NonlinearityOfAnyOrderIsUndone) {
    const std::vector<double> coefficients = {-6e-7, 2e-13, -3e-19};
    for (const double in : {-1e4, -3.0, 0.0, 1e-3, 7.0, 1e3, 5e4, 2e5, 4e5}) {
        double value[] = {in};
        nonlinearity(coefficients, value);
        EXPECT_NEAR(value[0],
                    in - 6e-7 * in * in + 2e-13 * std::pow(in, 3) - 3e-19 * std::pow(in, 4),
                    1e-15 * std::fabs(in));
        nonlinearity_inverse(coefficients, value);
        EXPECT_NEAR(value[0], in, 1e-14 * std::fabs(in));
    }
    // The quadratic turns over at 1 / (2 beta): nothing gives more than that.
    const double beta[] = {-6e-7};
    double values[] = {1 / (4 * 6e-7) * (1 - 1e-9), 1 / (4 * 6e-7) * 1.000001, INFINITY, NAN};
    nonlinearity_inverse(beta, values);
    EXPECT_NEAR(values[0], 1 / (2 * 6e-7), 1e-4 / (2 * 6e-7));
    EXPECT_TRUE(std::isnan(values[1]));
    EXPECT_EQ(values[2], INFINITY);
    EXPECT_TRUE(std::isnan(values[3]));
}

// Some of them need the slow way, beside others that do not.
TEST(Effects, APixelsBitsDoNotDependOnItsNeighbours) {
    std::vector<double> hard{NAN,  INFINITY, -INFINITY, 0,     -0.0, 1e-310,
                             -1e7, 4.1e5,    5e5,       1e300, -3};
    for (int i = 0; i < 700; ++i)
        hard.push_back(100.5 * i - 2e3);
    const auto expect_same = [&](const auto &effect) {
        std::vector<double> together = hard;
        effect(std::span(together));
        for (size_t i = 0; i < hard.size(); ++i) {
            double alone[] = {hard[i]};
            effect(std::span(alone));
            EXPECT_TRUE(alone[0] == together[i] ||
                        (std::isnan(alone[0]) && std::isnan(together[i])))
                << hard[i] << ": " << alone[0] << ", " << together[i];
        }
    };
    const std::vector<double> coefficients = {-6e-7, 2e-13, -3e-19}, quadratic = {-6e-7};
    expect_same([&](std::span<double> row) { nonlinearity_inverse(coefficients, row); });
    expect_same([&](std::span<double> row) { nonlinearity_inverse(quadratic, row); });
    expect_same([&](std::span<double> row) { reciprocity_failure(0.0065, 139.8, 1, row); });
}

// Whether means are all small, all large or mixed: a pixel draws what it draws alone.
TEST(Effects, PoissonNumbersDoNotDependOnNeighbours) {
    std::vector<double> means;
    for (int i = 0; i < 900; ++i)
        means.push_back(i < 300 ? 0.05 * i : i < 600 ? 10.0 * i : (i % 7) * 8.0);
    means[5] = means[400] = NAN;
    std::vector<double> together = means;
    draw_poisson({.seed = 3}, 10, 2, std::ssize(together), together.data());
    for (size_t i = 0; i < means.size(); ++i) {
        double alone = means[i];
        draw_poisson({.seed = 3}, 10 + static_cast<int64_t>(i), 2, 1, &alone);
        EXPECT_TRUE(alone == together[i] || std::isnan(means[i])) << i;
    }
}

TEST(Effects, ReciprocityFailureOfNoChargeIsNone) {
    double row[] = {0, -0.0, 139.8, -1};
    reciprocity_failure(0.0065, 139.8, 1, row);
    EXPECT_EQ(row[0], 0);
    EXPECT_EQ(row[1], 0);
    EXPECT_EQ(row[2], 139.8);
    EXPECT_TRUE(std::isnan(row[3]));
}

} // namespace
} // namespace wfpsf
