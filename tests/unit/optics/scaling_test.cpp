// SPDX-License-Identifier: GPL-3.0-or-later
// PSFs of many colours against the sum of monochromatic ones, each diffracted by itself: for all
// kinds of pupils, wavefronts and frames.
#include "instrument/instrument.hpp"
#include "large_case.hpp"
#include "optics/psf.hpp"
#include "optics/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace wfpsf {
namespace {

constexpr double pixel_scale = 0.11 * std::numbers::pi / 180 / 3600;
constexpr int64_t side = 15;
constexpr Star star{6.7, 7.4, 1};

// Somewhat more than Roman's for a factor of 1.
Wavefront aberrated(double factor) {
    return Wavefront(std::vector<double>{0, 0, 0, 0.03 * factor, -0.02 * factor, 0.04 * factor,
                                         0.01 * factor, -0.03 * factor, 0.02 * factor, 0, -0.02},
                     1.18);
}

std::shared_ptr<const Aperture> segments() {
    return make_aperture(
        std::get<SegmentedPupil>(Instrument::get("wfirst-afta-c5").pupil(7, "J129")));
}

std::shared_ptr<const Aperture> mask() {
    const int64_t n = 96;
    Plane<double> lit(n, n);
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x) {
            const double r = std::hypot(static_cast<double>(x) - 47.5, static_cast<double>(y) - 49);
            lit(x, y) = r < 46 && r > 14 && std::abs(x - 40) > 2 ? 1 : 0;
        }
    return make_aperture(std::as_const(lit).view(), 2.36 / 92, 47.5, 49);
}

Wavefront with_map(Wavefront wavefront) {
    const int64_t n = 24;
    Plane<double> map(n, n);
    std::mt19937 random(3);
    std::normal_distribution<double> metres(0, 4e-8);
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            map(x, y) = metres(random);
    wavefront.add(std::make_shared<const OpdMap>(std::as_const(map).view(), 2.6 / 23, 11.5, 11.5),
                  1293e-9);
    return wavefront;
}

PsfSettings settings(double eps) {
    return {.wavelength = 1293e-9, .pixel_scale = pixel_scale, .eps = eps, .radius = 8};
}

Light light_of(const char *band) {
    return detected_light(Instrument::get("roman-c9").band(band), black_body_sed(5000));
}

Plane<double> drawn(const Psf &psf) {
    Plane<double> stamp(side, side);
    psf.draw(star, 1, stamp.view());
    return stamp;
}

// The largest difference of any pixel, of the peak pixel.
double difference(const Plane<double> &a, const Plane<double> &b) {
    double most = 0, peak = 0;
    for (int64_t y = 0; y < a.ny(); ++y)
        for (int64_t x = 0; x < a.nx(); ++x) {
            most = std::max(most, std::abs(a(x, y) - b(x, y)));
            peak = std::max(peak, std::abs(b(x, y)));
        }
    return most / peak;
}

// A few points of a spectrum and of the same range, to keep the sum over them short.
Spectrum some_of(const Spectrum &all, size_t count = 40) {
    Spectrum some;
    const size_t stride = all.size() / count;
    double total = 0;
    for (size_t i = stride / 2; i < all.size(); i += stride)
        total += all.weight[i];
    for (size_t i = stride / 2; i < all.size(); i += stride) {
        some.wavelength.push_back(all.wavelength[i]);
        some.weight.push_back(all.weight[i] / total);
    }
    return some;
}

Plane<double> sum_of_colours(const Optics &optics, const PsfSettings &of, const Spectrum &light) {
    Plane<double> sum(side, side);
    for (size_t i = 0; i < light.size(); ++i) {
        PsfSettings own = of;
        own.wavelength = light.wavelength[i];
        own.eps = 1e-9;
        const Plane<double> stamp = drawn(
            Psf(optics.aperture, optics.wavefront.scaled(optics.wavelength / own.wavelength), own));
        for (int64_t y = 0; y < side; ++y)
            for (int64_t x = 0; x < side; ++x)
                sum(x, y) += light.weight[i] * stamp(x, y);
    }
    return sum;
}

void expect_met(const Optics &optics, const PsfSettings &of, const char *band, double best = 1e-8) {
    const Spectrum spectrum = some_of(light_of(band)(0));
    const Light light = [spectrum](double) { return spectrum; };
    const Plane<double> truth = sum_of_colours(optics, of, spectrum);
    for (double eps = 1e-2; eps > best / 2; eps /= 100) {
        PsfSettings own = of;
        own.eps = eps;
        const Psf psf = std::move(make_psfs(optics, {&light, 1}, own)[0]);
        const double error = difference(drawn(psf), truth);
        EXPECT_LE(error, eps) << band;
        EXPECT_LE(error, psf.error_estimate() + 2e-9) << band << ' ' << eps;
        EXPECT_LE(psf.error_estimate(), eps) << band;
    }
}

TEST(Scaling, PupilsOfAllKindsMeetTheSumOfTheirColours) {
    expect_met({segments(), aberrated(1), 1293e-9}, settings(0), "W146");
    expect_met({mask(), aberrated(1), 1293e-9}, settings(0), "J129");
    expect_met({mask(), with_map(aberrated(1)), 1293e-9}, settings(0), "W146");
    // Quadrature of so rough a map ends above 1e-8, whatever the number of colours.
    expect_met({segments(), with_map(aberrated(1)), 1293e-9}, settings(0), "J129", 1e-6);
}

TEST(Scaling, StrongAberrationsTakeMoreImages) {
    expect_met({segments(), aberrated(0), 1293e-9}, settings(0), "W146");
    expect_met({segments(), aberrated(10), 1293e-9}, settings(0), "W146");
    const auto nodes = [](double factor) {
        const Light light = light_of("J129");
        return make_psfs({segments(), aberrated(factor), 1293e-9}, {&light, 1}, settings(1e-5))[0]
            .nodes();
    };
    EXPECT_GT(nodes(1), nodes(0));
    EXPECT_GT(nodes(10), nodes(1));
}

TEST(Scaling, FramesFiltersAndSizesDoNotMatter) {
    const Optics optics{segments(), aberrated(1), 1293e-9};
    PsfSettings of = settings(0);
    of.mirrored = true;
    of.blur = {0.1, 0.03, 0.06};
    expect_met(optics, of, "J129");
    of = settings(0);
    of.pixel_response = false;
    expect_met(optics, of, "J129");
    of.pixel_scale = pixel_scale / 8; // the grid has fewer samples than a block
    of.radius = 8;
    expect_met(optics, of, "J129");
}

TEST(Scaling, DerivativesMeetDifferences) {
    const Light light = light_of("W146");
    const auto psf = [&](double defocus) {
        const Optics optics{
            segments(), Wavefront(std::vector<double>{0, 0, 0, defocus, -0.02, 0.03, 0.01}, 1.18),
            1293e-9};
        return std::move(make_psfs(optics, {&light, 1}, settings(1e-9))[0]);
    };
    const double step = 1e-3, at = 0.04;
    const Wavefront unit(std::vector{0.0, 0.0, 0.0, 1.0}, 1.18);
    const Field change = psf(at).changes({&unit, 1}, 8)[0];
    Plane<double> slope(side, side), differences(side, side);
    change.draw(star, 1, 0, 0, slope.view());
    const auto of = [&](double offset) { return drawn(psf(at + offset * step)); };
    const Plane<double> a = of(-2), b = of(-1), c = of(1), d = of(2);
    for (int64_t y = 0; y < side; ++y)
        for (int64_t x = 0; x < side; ++x)
            differences(x, y) = (8 * (c(x, y) - b(x, y)) - (d(x, y) - a(x, y))) / (12 * step);
    EXPECT_LE(difference(slope, differences), 2e-6);
}

// Far from the axis, where images are made of fewer terms and by shorter filters, in single
// precision, and near it, where they are a sum of fewer wavelengths.
TEST(Scaling, WideFieldsMeetTheSumOfTheirColours) {
    WFPSF_LARGE_CASE();
    const double radius = 64;
    const auto width = static_cast<int64_t>(2 * radius - 1);
    const Star middle{radius - 1.3, radius - 0.6, 1};
    const auto wide = [&](const Psf &psf) {
        Plane<double> stamp(width, width);
        psf.draw(middle, 1, stamp.view());
        return stamp;
    };
    const Optics optics{segments(), aberrated(1), 1293e-9};
    PsfSettings of = settings(1e-9);
    of.radius = radius;
    Spectrum spectrum = some_of(light_of("J129")(0), 120);
    Plane<double> truth(width, width);
    for (size_t i = 0; i < spectrum.size(); ++i) {
        PsfSettings own = of;
        own.wavelength = spectrum.wavelength[i];
        const Plane<double> stamp = wide(
            Psf(optics.aperture, optics.wavefront.scaled(optics.wavelength / own.wavelength), own));
        for (int64_t y = 0; y < width; ++y)
            for (int64_t x = 0; x < width; ++x)
                truth(x, y) += spectrum.weight[i] * stamp(x, y);
    }
    const Light light = [&spectrum](double) { return spectrum; };
    for (const double eps : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
        of.eps = eps;
        const Psf psf = std::move(make_psfs(optics, {&light, 1}, of)[0]);
        const double error = difference(wide(psf), truth);
        EXPECT_LE(error, eps);
        EXPECT_LE(error, psf.error_estimate() + 2e-9) << eps;
        EXPECT_LE(psf.error_estimate(), eps);
    }
}

// A field made like that of other optics, as large as it or smaller.
TEST(Scaling, FieldsLikeOthersAreAsGood) {
    const Light light = light_of("J129");
    const Optics one{segments(), aberrated(1), 1293e-9};
    const Optics other{one.aperture, aberrated(0.7), 1293e-9};
    const auto stamp_of = [](const Field &field) {
        Plane<double> stamp(side, side);
        field.draw(star, 1, 0, 0, stamp.view());
        return stamp;
    };
    PsfSettings of = settings(1e-9);
    const Plane<double> truth = stamp_of(make_fields(other, {&light, 1}, of, 8)[0]);
    for (const double eps : {1e-3, 1e-5, 1e-7}) {
        of.eps = eps;
        const Field wide = std::move(make_fields(one, {&light, 1}, of, 40)[0]);
        for (const double radius : {8.0, 20.0, 40.0}) {
            const Field field = make_field_like(wide, other, of, radius);
            const double error = difference(stamp_of(field), truth);
            EXPECT_LE(error, field.error + 1e-9) << eps << ' ' << radius;
            EXPECT_LE(field.error, eps);
            EXPECT_LE(field.colours.size(), wide.colours.size());
        }
        EXPECT_LT(make_field_like(wide, other, of, 8).colours.size(), wide.colours.size());
    }
}

// The bound of the pairs' differences, by all pairs.
TEST(Scaling, PairsAreBounded) {
    std::mt19937 random(5);
    std::normal_distribution<double> waves(0.3, 0.1);
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<double> wavefront, area;
    double total = 0;
    for (int i = 0; i < 500; ++i) {
        wavefront.push_back(waves(random));
        area.push_back(any(random));
        total += area.back();
    }
    const WavefrontPairs pairs(wavefront, area);
    double factorial = 1;
    for (int n = 1; n <= 8; ++n) {
        factorial *= n;
        double mean = 0;
        for (size_t i = 0; i < wavefront.size(); ++i)
            for (size_t j = 0; j < wavefront.size(); ++j)
                mean += area[i] * area[j] / (total * total) *
                        std::pow(std::abs(2 * (wavefront[i] - wavefront[j])), n) / factorial;
        EXPECT_GE(pairs.power(2, n), mean);
        EXPECT_LE(pairs.power(2, n), 1.3 * mean);
    }
    EXPECT_EQ(WavefrontPairs(std::vector{0.2, 0.2}, std::vector{1.0, 1.0}).power(3, 1), 0);
}

} // namespace
} // namespace wfpsf
