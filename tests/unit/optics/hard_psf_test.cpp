// SPDX-License-Identifier: GPL-3.0-or-later
// The accuracy contract where it is hardest to keep: huge aberrations, odd pupils, extreme
// wavelengths, offsets, sizes and fluxes. Truth: sums along the pupil's outline.
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "oracles/outline.hpp"
#include "oracles/zernike_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

namespace wfpsf {
namespace {

using oracle::Vec;

constexpr double pi = std::numbers::pi;
constexpr double pixel_scale = 0.11 * pi / 180 / 3600, diameter = 2.36;
constexpr double j129 = 1292.11e-9;

const SegmentedPupil &c5_pupil() {
    return std::get<SegmentedPupil>(Instrument::get("wfirst-afta-c5").pupil(7, "J129"));
}

struct Setup {
    double wavelength;
    std::vector<double> zernikes = {};
    double star_x = 16.31, star_y = 15.83; // on a stamp of 33 x 33 pixels
};

// Draws stamps at several tolerances and compares them with the truth.
template <class Pupil>
void expect_contract(const Pupil &pupil, const Setup &setup, const std::string &what,
                     bool always_certified = true) {
    const std::vector<std::pair<int, int>> at{{16, 16}, {17, 15}, {15, 16}, {14, 20}, {9, 16},
                                              {3, 30},  {0, 0},   {32, 0},  {32, 32}};
    std::vector<Vec> angles;
    for (const auto &[x, y] : at)
        angles.push_back({(x - setup.star_x) * pixel_scale, (y - setup.star_y) * pixel_scale});
    const oracle::Outline outline = oracle::outline(pupil);
    const oracle::ZernikeWaves waves(setup.zernikes, diameter / 2);
    const std::vector<double> truth =
        setup.zernikes.empty()
            ? oracle::contour_pixels(outline, setup.wavelength, pixel_scale, angles)
            : oracle::green_pixels(outline, waves, waves.largest_slope(), setup.wavelength,
                                   pixel_scale, angles);
    for (const double eps : {1e-2, 1e-4, 1e-7, 1e-10}) {
        const Psf psf(make_aperture(pupil), Wavefront(setup.zernikes, diameter / 2),
                      {setup.wavelength, pixel_scale, eps, 17.5});
        Plane<double> stamp(33, 33);
        psf.draw(setup.star_x, setup.star_y, 1, 1, stamp.view());
        double peak = 0, error = 0;
        for (int64_t y = 0; y < 33; ++y)
            for (int64_t x = 0; x < 33; ++x)
                peak = std::max(peak, stamp(x, y));
        for (size_t p = 0; p < at.size(); ++p)
            error = std::max(error, std::abs(stamp(at[p].first, at[p].second) - truth[p]) / peak);
        EXPECT_LE(error, psf.error_estimate()) << what << ' ' << eps;
        if (always_certified || psf.error_estimate() <= eps) {
            EXPECT_LE(psf.error_estimate(), eps) << what;
            EXPECT_LE(error, eps) << what;
        }
    }
}

// The light is spread over hundreds of pixels, so that rounding may show at the smallest eps.
TEST(HardPsf, TwentyWavesOfDefocus) {
    for (const double waves : {20.0, -20.0})
        expect_contract(c5_pupil(), {j129, {0, 0, 0, waves}}, "defocus", false);
    expect_contract(AnnularPupil{1.18, 0.4}, {j129, {0, 0, 0, 20}}, "defocus of an annulus", false);
    expect_contract(c5_pupil(), {j129, {0, 0, 0, 2, -1.5, 1, 2, -0.5, 0, 0, 1.5}}, "many");
}

TEST(HardPsf, ObscurationFromNoneToNearlyAll) {
    for (const double obscuration : {0.0, 1e-3, 0.5, 0.95})
        for (const double wavelength : {870e-9, 2000e-9})
            expect_contract(AnnularPupil{1.18, 1.18 * obscuration}, {wavelength},
                            "obscuration " + std::to_string(obscuration));
    expect_contract(AnnularPupil{1.18, 1.121}, {j129, {0, 0, 0, 0.1, 0.2, 0, -0.1}}, "thin ring");
}

TEST(HardPsf, StrutsFromNothingToAFifthOfTheRadius) {
    for (const double obscuration : {0.0, 0.3, 0.95})
        for (const double width : {0.0, 1e-6, 0.01, 0.2}) {
            SpiderPupil pupil{1.18, 1.18 * obscuration, {}};
            for (const double azimuth : {0.3, 2.0, 3.9, 5.0})
                pupil.struts.push_back({std::sin(azimuth), -std::cos(azimuth), 0.02, 1.18 * width});
            const std::string what =
                std::to_string(obscuration) + ", struts " + std::to_string(width);
            expect_contract(pupil, {j129}, what);
            expect_contract(pupil, {j129, {0, 0, 0, 0.1, 0, 0.05, 0, -0.1}}, what);
        }
}

// At 300 nm the light of a star on a corner of four pixels is a quarter of what one pixel may get.
TEST(HardPsf, ExtremeWavelengthsAndOffsetsOfHalfAPixel) {
    for (const double wavelength : {300e-9, j129, 10e-6})
        for (const double dx : {-0.5, 0.0, 0.5})
            for (const double dy : {-0.5, 0.5})
                expect_contract(c5_pupil(), {wavelength, {}, 16 + dx, 16 + dy},
                                std::to_string(wavelength * 1e9) + " nm");
    expect_contract(c5_pupil(), {300e-9, {0, 0, 0, 0.3, 0.2, 0, -0.3}}, "300 nm, aberrated");
}

TEST(HardPsf, SymmetricStampsAreCentred) {
    const Psf psf(make_aperture(AnnularPupil{1.18, 0.4}), Wavefront({}, 1.18),
                  {j129, pixel_scale, 1e-12, 12});
    for (const int64_t oversampling : {1, 2, 3, 4, 5})
        for (const int64_t size : {7, 8, 20, 21}) {
            const double middle = static_cast<double>(size - 1) / 2;
            Plane<double> stamp(size, size);
            psf.draw(middle, middle, 1, oversampling, stamp.view());
            double sum = 0, x_sum = 0, y_sum = 0;
            for (int64_t y = 0; y < size; ++y)
                for (int64_t x = 0; x < size; ++x) {
                    sum += stamp(x, y);
                    x_sum += (static_cast<double>(x) - middle) * stamp(x, y);
                    y_sum += (static_cast<double>(y) - middle) * stamp(x, y);
                }
            EXPECT_NEAR(x_sum / sum, 0, 1e-10) << oversampling << ' ' << size;
            EXPECT_NEAR(y_sum / sum, 0, 1e-10) << oversampling << ' ' << size;
        }
}

// A square, and a point whose light falls evenly everywhere.
TEST(HardPsf, MasksOfOnePixel) {
    constexpr double side = 0.3;
    const double k = side * pixel_scale / j129;
    for (const int64_t size : {1, 9})
        for (const MaskPixels pixels : {MaskPixels::squares, MaskPixels::points}) {
            Plane<double> mask(size, size);
            mask(size / 2, 0) = 1;
            const Psf psf(make_aperture(std::as_const(mask).view(), side, 2, -5, pixels),
                          Wavefront({}, 1.18), {j129, pixel_scale, 1e-10, 10});
            Plane<double> stamp(15, 15);
            psf.draw(7.2, 6.9, 1, 1, stamp.view());
            const GaussLegendre rule(12);
            const auto along = [&](double x) { // the fraction of the light along an axis
                double sum = 0;
                for (size_t i = 0; i < rule.x.size(); ++i) {
                    const double t = pi * k * (x + rule.x[i] / 2);
                    sum += rule.w[i] / 2 * (t == 0 ? 1 : std::pow(std::sin(t) / t, 2));
                }
                return k * (pixels == MaskPixels::points ? 1 : sum);
            };
            double peak = 0, worst = 0;
            for (int64_t y = 0; y < 15; ++y)
                for (int64_t x = 0; x < 15; ++x) {
                    peak = std::max(peak, stamp(x, y));
                    worst = std::max(
                        worst, std::abs(stamp(x, y) - along(static_cast<double>(x) - 7.2) *
                                                          along(static_cast<double>(y) - 6.9)));
                }
            EXPECT_LE(worst, psf.error_estimate() * peak);
            EXPECT_LE(psf.error_estimate(), 1e-10);
        }
}

TEST(HardPsf, FluxesFromTheSmallestToTheLargest) {
    const Psf psf(make_aperture(c5_pupil()), Wavefront({}, 1.18), {j129, pixel_scale, 1e-6, 6});
    Plane<double> one(9, 9), scaled(9, 9);
    Plane<float> single(9, 9);
    psf.draw(4.1, 3.8, 1, 1, one.view());
    for (const double flux : {1e300, -1e300, 1e-300, 0.0, 1e30}) {
        psf.draw(4.1, 3.8, flux, 1, scaled.view());
        if (std::abs(flux) < 1e38)
            psf.draw(4.1, 3.8, flux, 1, single.view());
        for (int64_t y = 0; y < 9; ++y)
            for (int64_t x = 0; x < 9; ++x) {
                EXPECT_NEAR(scaled(x, y), flux * one(x, y), std::abs(flux) * 1e-15);
                if (std::abs(flux) < 1e38) {
                    EXPECT_NEAR(single(x, y), flux * one(x, y),
                                std::abs(flux * one(x, y)) * 1e-7 + 1e-45);
                }
            }
    }
}

} // namespace
} // namespace wfpsf
