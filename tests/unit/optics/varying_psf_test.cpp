// SPDX-License-Identifier: GPL-3.0-or-later
// The PSF over a detector against exact PSFs at places that the model did not see.
#include "error/error.hpp"
#include "instrument/instrument.hpp"
#include "optics/varying_psf.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace wfpsf {
namespace {

constexpr double pixel_scale = 0.11 * std::numbers::pi / 180 / 3600;
constexpr Region detector{-512, -512, 4599, 4599};

OpticsAt roman_optics(int sca, const char *band) {
    const Instrument &roman = Instrument::get("roman-c9");
    const std::shared_ptr<const Aperture> aperture =
        make_aperture(std::get<RomanPupil>(roman.pupil(sca, band)));
    return [&roman, aperture, sca](double x, double y) {
        std::vector<double> zernikes = roman.zernikes(sca, x, y);
        std::fill_n(zernikes.begin(), 3, 0.0);
        return Optics{aperture, Wavefront(zernikes, roman.diameter_m() / 2), 1293e-9};
    };
}

PsfSettings settings(double eps, double radius = 8) {
    return {.wavelength = 1293e-9, .pixel_scale = pixel_scale, .eps = eps, .radius = radius};
}

// The largest error of any pixel of stamps at some places, of the stamp's brightest pixel.
double worst_error(const VaryingPsf &model, const OpticsAt &optics, const Light &light,
                   int places) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> inside(-512, 4599), offset(-0.5, 0.5);
    const double radius = model.settings().radius;
    const auto half = static_cast<int64_t>(radius) - 1, size = 2 * half + 1;
    double worst = 0;
    for (int i = 0; i < places; ++i) {
        const double x = i == 0 ? 4599 : inside(random), y = i == 0 ? -512 : inside(random);
        const Psf truth =
            std::move(make_psfs(optics(x, y), {&light, 1}, settings(1e-10, radius))[0]);
        const auto middle = static_cast<double>(half);
        const Star star{middle + offset(random), middle + offset(random), 1};
        Plane<double> a(size, size), b(size, size);
        model.at(x, y).draw(star, 1, a.view());
        truth.draw(star, 1, b.view());
        double peak = 0, error = 0;
        for (int64_t v = 0; v < size; ++v)
            for (int64_t u = 0; u < size; ++u) {
                peak = std::max(peak, b(u, v));
                error = std::max(error, std::abs(a(u, v) - b(u, v)));
            }
        worst = std::max(worst, error / peak);
    }
    return worst;
}

TEST(VaryingPsf, EveryToleranceIsMetAtPlacesNotSeen) {
    for (const auto &[sca, band, wavelength] :
         {std::tuple(7, "J129", 1292e-9), std::tuple(18, "F184", 1842e-9),
          std::tuple(9, "Z087", 872e-9)}) {
        const OpticsAt optics = roman_optics(sca, band);
        const Light light = monochromatic(wavelength);
        for (const double eps : {1e-2, 1e-4, 1e-6, 1e-8}) {
            const VaryingPsf model(optics, true, light, settings(eps), detector);
            const double worst = worst_error(model, optics, light, 12);
            EXPECT_LE(model.error_estimate(), eps) << sca << band;
            EXPECT_LE(worst, model.error_estimate()) << sca << band << ' ' << eps;
            EXPECT_LE(worst, (eps > 5e-4 ? 0.2 : 0.1) * eps) << "which plans of scenes count on";
            const auto degree = static_cast<size_t>(model.degree());
            EXPECT_LE(model.rank(), (degree + 1) * (degree + 2) / 2);
        }
    }
}

// Far from the core fields reach that are good to a low degree alone.
TEST(VaryingPsf, EveryToleranceIsMetFarFromTheCore) {
    for (const auto &[sca, band, wavelength] :
         {std::tuple(18, "F184", 1842e-9), std::tuple(6, "J129", 1292e-9)}) {
        const OpticsAt optics = roman_optics(sca, band);
        const Light light = monochromatic(wavelength);
        for (const double eps : {1e-3, 3e-4, 1e-4, 1e-6}) {
            const VaryingPsf model(optics, true, light, settings(eps, 34), detector);
            EXPECT_LE(worst_error(model, optics, light, 12), 0.1 * eps) << sca << band << eps;
        }
    }
}

TEST(VaryingPsf, ColoursVaryToo) {
    const OpticsAt optics = roman_optics(4, "J129");
    const Light light = detected_light(Instrument::get("roman-c9").band("J129"),
                                       power_law_sed(SedUnit::photons, 0));
    const VaryingPsf model(optics, true, light, settings(1e-4), detector);
    EXPECT_LE(model.error_estimate(), 1e-4);
    EXPECT_LE(worst_error(model, optics, light, 4), model.error_estimate());
}

TEST(VaryingPsf, WhatDoesNotVaryCostsOnePsf) {
    const OpticsAt everywhere = roman_optics(7, "J129");
    const Optics centre = everywhere(2044, 2044);
    const VaryingPsf model([centre](double, double) { return centre; }, false,
                           monochromatic(1292e-9), settings(1e-8), detector);
    EXPECT_EQ(model.exact_psfs(), 1);
    EXPECT_EQ(model.rank(), 1u);
    EXPECT_EQ(model.interpolation_error(), 0);
    Plane<double> a(9, 9), b(9, 9);
    model.at(3, 4000).draw({4.2, 4, 1}, 1, a.view());
    Psf(centre.aperture, centre.wavefront.scaled(1293.0 / 1292),
        {.wavelength = 1292e-9, .pixel_scale = pixel_scale, .eps = 1e-8, .radius = 8})
        .draw({4.2, 4, 1}, 1, b.view());
    for (int64_t y = 0; y < 9; ++y)
        for (int64_t x = 0; x < 9; ++x)
            EXPECT_NEAR(a(x, y), b(x, y), 0.01 * 1e-8 * model.at(3, 4000).peak());
}

// Stars on a piece of a detector, each with its own PSF, at two samplings, on any number of
// threads.
TEST(VaryingPsf, StarsHaveThePsfOfTheirPlace) {
    const OpticsAt optics = roman_optics(18, "J129");
    const VaryingPsf model(optics, true, monochromatic(1292e-9), settings(1e-6, 5), detector);
    const double x0 = 3000, y0 = 100; // of the image on the detector
    for (const int64_t n : {1, 3}) {
        const auto scale = static_cast<double>(n);
        std::vector<Star> stars = {{10.3, 20.2, 5}, {0, 36, 2}, {-4, 8, 9}, {39.5, 3, 1}};
        for (Star &star : stars) {
            star.x = star.x * scale + (scale - 1) / 2;
            star.y = star.y * scale + (scale - 1) / 2;
        }
        stars.push_back({1e9, 0, 1}); // out of reach, and of the detector
        Plane<double> expected(40 * n, 37 * n), image(40 * n, 37 * n), threaded(40 * n, 37 * n);
        for (size_t i = 0; i + 1 < stars.size(); ++i) {
            const Star &star = stars[i];
            model
                .at(x0 + (star.x - (scale - 1) / 2) / scale,
                    y0 + (star.y - (scale - 1) / 2) / scale)
                .add({&star, 1}, n, expected.view(), 1);
        }
        model.add(stars, x0, y0, n, image.view(), 1);
        model.add(stars, x0, y0, n, threaded.view(), 3);
        for (int64_t y = 0; y < image.ny(); ++y)
            for (int64_t x = 0; x < image.nx(); ++x) {
                ASSERT_EQ(image(x, y), threaded(x, y));
                // A tenth of eps, of the peaks of all stars.
                EXPECT_NEAR(image(x, y), expected(x, y), 0.1 * 1e-6 * 0.4 * 17);
            }
        EXPECT_GT(image(10 * n, 20 * n), 0);
    }
    Plane<float> corner(10, 10);
    const Star outside{5, 5, 1};
    EXPECT_THROW(model.add({&outside, 1}, 4598, 0, 1, corner.view(), 1), Error);
    EXPECT_EQ(corner(5, 5), 0);
    EXPECT_THROW(model.at(-513, 0), Error);
    EXPECT_THROW(model.at(0, std::nan("")), Error);
}

// Stars that are so many that they share what is near them, in whatever detail.
TEST(VaryingPsf, ManyStarsTakeNoMoreThanTheyMayLack) {
    const OpticsAt optics = roman_optics(18, "F184");
    const VaryingPsf model(optics, true, monochromatic(1842e-9), settings(1e-6, 12), detector);
    constexpr int64_t size = 1200, across = 20; // pixels, stars
    std::mt19937 random(4);
    std::uniform_real_distribution<double> offset(-0.5, 0.5);
    std::vector<Star> stars;
    for (int64_t i = 0; i < across * across; ++i)
        stars.push_back({static_cast<double>(30 + 60 * (i % across)) + offset(random),
                         static_cast<double>(30 + 60 * (i / across)) + offset(random), 1});
    for (const double left_out : {1e-2, 1e-4, 1e-6}) {
        Plane<double> image(size, size), threaded(size, size);
        const std::vector<StarDetail> details(stars.size(), {10, left_out});
        model.add(stars, details, 2800, -300, 1, image.view(), 1);
        model.add(stars, details, 2800, -300, 1, threaded.view(), 3);
        double worst = 0;
        for (size_t i = 0; i < stars.size(); i += 7) {
            const auto x0 = static_cast<int64_t>(stars[i].x) - 8;
            const auto y0 = static_cast<int64_t>(stars[i].y) - 8;
            const Star star{stars[i].x - static_cast<double>(x0),
                            stars[i].y - static_cast<double>(y0), 1};
            Plane<double> expected(17, 17);
            model.at(2800 + stars[i].x, -300 + stars[i].y).draw(star, 1, expected.view());
            for (int64_t y = 0; y < 17; ++y)
                for (int64_t x = 0; x < 17; ++x) {
                    ASSERT_EQ(image(x0 + x, y0 + y), threaded(x0 + x, y0 + y));
                    worst = std::max(worst, std::abs(image(x0 + x, y0 + y) - expected(x, y)));
                }
        }
        EXPECT_LE(worst, left_out);
        EXPECT_GT(worst, 1e-4 * left_out); // it was used
    }
}

// Every pixel of stamps of faint and bright stars together, at two samplings, in images of floats;
// some stand at the image's borders. Truth is a sum of fields, in double.
TEST(VaryingPsf, StarsOfAllKindsAreDrawnTogether) {
    const OpticsAt optics = roman_optics(7, "J129");
    const VaryingPsf model(optics, true, monochromatic(1292e-9), settings(1e-5, 12.5), detector);
    const double x0 = -200, y0 = 3400;
    for (const int64_t n : {1, 2}) {
        const auto scale = static_cast<double>(n);
        const int64_t size = 900 * n, across = 30;
        std::mt19937 random(11);
        std::uniform_real_distribution<double> offset(-0.5, 0.5);
        std::vector<Star> stars;
        std::vector<StarDetail> details;
        const StarDetail kinds[] = {
            {12.5, 3e-7}, {4.25, 1e-3}, {12, 2e-5}, {7.5, 1e-7}, {10, 1e-4}};
        for (int64_t i = 0; i < across * across; ++i) {
            // Whole and half pixels too.
            const double shift = i % 3 == 0 ? 0.5 : 0;
            const auto at = [&](int64_t place) {
                return scale * static_cast<double>(30 * place) +
                       (i % 4 == 0 ? shift : 3 * scale * offset(random));
            };
            stars.push_back({at(i % across), at(i / across), 1});
            details.push_back(kinds[i % 5]);
        }
        Plane<float> image(size, size), threaded(size, size);
        Plane<double> turned(size, size);
        View<double> backwards = turned.view();
        backwards = {&turned(size - 1, 0), size, size, -1, size};
        model.add(stars, details, x0, y0, n, image.view(), 1);
        model.add(stars, details, x0, y0, n, threaded.view(), 3);
        model.add(stars, details, x0, y0, n, backwards, 2);
        double worst = 0;
        for (size_t i = 0; i < stars.size(); i += 3) {
            const Star &star = stars[i];
            const double radius = scale * details[i].radius;
            const auto left = static_cast<int64_t>(std::floor(star.x - radius)) - 1;
            const auto low = static_cast<int64_t>(std::floor(star.y - radius)) - 1;
            const auto width = static_cast<int64_t>(2 * radius) + 4;
            Plane<double> expected(width, width);
            model
                .at(x0 + (star.x - (scale - 1) / 2) / scale,
                    y0 + (star.y - (scale - 1) / 2) / scale)
                .draw({star.x - static_cast<double>(left), star.y - static_cast<double>(low), 1}, n,
                      expected.view());
            for (int64_t y = std::max<int64_t>(low, 0); y < std::min(low + width, size); ++y)
                for (int64_t x = std::max<int64_t>(left, 0); x < std::min(left + width, size);
                     ++x) {
                    const bool within = std::abs(static_cast<double>(x) - star.x) <= radius &&
                                        std::abs(static_cast<double>(y) - star.y) <= radius;
                    const double truth = within ? expected(x - left, y - low) : 0;
                    const double most = details[i].left_out / (scale * scale);
                    ASSERT_EQ(image(x, y), threaded(x, y));
                    ASSERT_NEAR(backwards(x, y), truth, most);
                    ASSERT_NEAR(image(x, y), truth, most + 1e-7 * truth);
                    worst = std::max(worst, std::abs(image(x, y) - truth) / most);
                }
        }
        EXPECT_GT(worst, 0.01); // it was used
    }
}

TEST(VaryingPsf, EqualCallsGiveEqualBitsByAnyNumberOfThreads) {
    const auto pixel = [](int threads) {
        Plane<double> stamp(5, 5);
        VaryingPsf(roman_optics(2, "H158"), true, monochromatic(1577e-9), settings(1e-4, 4),
                   detector, {.threads = threads})
            .at(77, 3021)
            .draw({2.1, 2, 1}, 1, stamp.view());
        return stamp(2, 3);
    };
    EXPECT_EQ(pixel(1), pixel(1));
    EXPECT_EQ(pixel(1), pixel(3));
}

TEST(VaryingPsf, WorkIsBoundedAndStopped) {
    const OpticsAt optics = roman_optics(7, "J129");
    const auto status = [&](const Manners &manners) {
        try {
            VaryingPsf(optics, true, monochromatic(1292e-9), settings(1e-6), detector, manners);
        } catch (const Error &error) {
            return error.status();
        }
        return wfpsf_status(WFPSF_OK);
    };
    EXPECT_EQ(status({.memory_limit = 1 << 20}), WFPSF_ERROR_MEMORY_LIMIT);
    double last = -1;
    int calls = 0;
    EXPECT_EQ(status({.progress = {[&](double part) {
                          EXPECT_GE(part, last);
                          last = part;
                          return ++calls < 20;
                      }}}),
              WFPSF_ERROR_CANCELLED);
    EXPECT_EQ(calls, 20);
}

} // namespace
} // namespace wfpsf
