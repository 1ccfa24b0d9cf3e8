// SPDX-License-Identifier: GPL-3.0-or-later
// PSFs of many colours against brute-force sums over wavelength and pupil.
#include "error/error.hpp"
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "oracles/psf_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace wfpsf {
namespace {

using namespace oracle;

constexpr double pixel_scale = 0.11 * pi / 180 / 3600;
constexpr double star_x = 16.3, star_y = 15.6; // on a 33 x 33 native stamp

const Instrument &c5() {
    return Instrument::get("wfirst-afta-c5");
}

const SegmentedPupil &c5_pupil() {
    return std::get<SegmentedPupil>(c5().pupil(7, "J129"));
}

Optics c5_optics() {
    const auto zernikes = c5().zernikes(7);
    std::vector<double> waves(zernikes.begin(), zernikes.end());
    std::fill_n(waves.begin(), 3, 0.0);
    return {make_aperture(c5_pupil()), Wavefront(waves, 1.18), 1293e-9};
}

PsfSettings settings(double eps) {
    return {.wavelength = 1293e-9, .pixel_scale = pixel_scale, .eps = eps, .radius = 17.5};
}

// The light at some pixels, wavelength by wavelength on the spectrum's own points.
std::vector<double> truth(const Optics &optics, const Spectrum &light,
                          const std::vector<std::pair<int, int>> &pixels) {
    const PupilNodes nodes = pupil_nodes(c5_pupil(), 150, 1e-10);
    std::vector<double> sums(pixels.size());
    for (size_t i = 0; i < light.size(); ++i)
        for (size_t p = 0; p < pixels.size(); ++p)
            sums[p] += light.weight[i] *
                       brute_force_in_pixel(
                           nodes, optics.wavefront.scaled(optics.wavelength / light.wavelength[i]),
                           light.wavelength[i], (pixels[p].first - star_x) * pixel_scale,
                           (pixels[p].second - star_y) * pixel_scale, pixel_scale, 8);
    return sums;
}

double worst_error(const Psf &psf, const std::vector<std::pair<int, int>> &pixels,
                   const std::vector<double> &expected) {
    Plane<double> stamp(33, 33);
    psf.draw({star_x, star_y, 1}, 1, stamp.view());
    double peak = 0, worst = 0;
    for (int64_t y = 0; y < 33; ++y)
        for (int64_t x = 0; x < 33; ++x)
            peak = std::max(peak, stamp(x, y));
    for (size_t p = 0; p < pixels.size(); ++p)
        worst = std::max(worst, std::abs(stamp(pixels[p].first, pixels[p].second) - expected[p]));
    return worst / peak;
}

// A coarse spectrum keeps the brute-force sum short: the engine knows nothing of where its points
// come from.
Spectrum every(const Light &light, size_t stride) {
    const Spectrum all = light(0);
    Spectrum some;
    double total = 0;
    for (size_t i = stride / 2; i < all.size(); i += stride) {
        some.wavelength.push_back(all.wavelength[i]);
        some.weight.push_back(all.weight[i]);
        total += all.weight[i];
    }
    for (double &weight : some.weight)
        weight /= total;
    return some;
}

Light given(const Spectrum &spectrum) {
    return [spectrum](double) { return spectrum; };
}

TEST(Chromatic, BruteForceIsMetAtEveryTolerance) {
    const std::vector<std::pair<int, int>> pixels = {{16, 16}, {17, 14}, {32, 31}};
    const Optics optics = c5_optics();
    const Spectrum j129 = every(detected_light(c5().band("J129"), black_body_sed(4500)), 4);
    const Spectrum w149 =
        every(detected_light(c5().band("W149"), power_law_sed(SedUnit::photons, 0)), 9);
    for (const Spectrum &light : {j129, w149}) {
        const std::vector<double> expected = truth(optics, light, pixels);
        size_t before = 0;
        for (const double eps : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8}) {
            const Psf psf =
                std::move(make_psfs(optics, std::vector{given(light)}, settings(eps))[0]);
            const double worst = worst_error(psf, pixels, expected);
            EXPECT_LE(worst, eps);
            EXPECT_LE(worst, psf.error_estimate()) << eps;
            EXPECT_LE(psf.error_estimate(), eps);
            EXPECT_GE(psf.components().size(), before) << eps;
            before = psf.components().size();
        }
    }
}

// The whole stamp, against one of the same engine with far more wavelengths: the brute force above
// sees a few pixels only.
TEST(Chromatic, WavelengthsSufficeForEveryPixel) {
    const Optics optics = c5_optics();
    for (const char *band : {"J129", "W149"}) {
        const Light light = detected_light(c5().band(band), black_body_sed(4500));
        const auto stamp_of = [&](double eps) {
            const Psf psf = std::move(make_psfs(optics, std::vector{light}, settings(eps))[0]);
            std::pair<Plane<double>, double> stamp(Plane<double>(33, 33), psf.error_estimate());
            psf.draw({star_x, star_y, 1}, 1, stamp.first.view());
            return stamp;
        };
        const auto [best, certain] = stamp_of(1e-9);
        EXPECT_LE(certain, 1e-9);
        for (const double eps : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
            const auto [stamp, estimate] = stamp_of(eps);
            double worst = 0;
            for (int64_t y = 0; y < 33; ++y)
                for (int64_t x = 0; x < 33; ++x)
                    worst = std::max(worst, std::abs(stamp(x, y) - best(x, y)) / best(16, 16));
            EXPECT_LE(worst, eps) << band;
            EXPECT_LE(worst, estimate) << band << ' ' << eps;
        }
    }
}

// Sources that share their wavelengths, one of them rough, are as good as each by itself.
TEST(Chromatic, SourcesShareTheirMonochromaticImages) {
    const std::vector<std::pair<int, int>> pixels = {{16, 16}, {15, 17}, {24, 9}};
    const Optics optics = c5_optics();
    std::vector<double> nm, values;
    for (double at = 1000; at <= 1600; at += 2) {
        nm.push_back(at);
        values.push_back(1 + 30 * std::exp(-std::pow((at - 1190) / 6, 2)));
    }
    const Band &band = c5().band("J129");
    std::vector<std::vector<double>> expected;
    std::vector<Light> lights;
    for (const auto &[sed, stride] :
         {std::pair(tabulated_sed(SedUnit::energy, nm, values), 20),
          std::pair(black_body_sed(3000), 8), std::pair(power_law_sed(SedUnit::energy, 0), 8)}) {
        const Spectrum spectrum = every(detected_light(band, sed), static_cast<size_t>(stride));
        expected.push_back(truth(optics, spectrum, pixels));
        lights.push_back(given(spectrum));
    }
    for (const double eps : {1e-3, 1e-5}) {
        const std::vector<Psf> psfs = make_psfs(optics, lights, settings(eps));
        for (size_t s = 0; s < lights.size(); ++s) {
            const double worst = worst_error(psfs[s], pixels, expected[s]);
            EXPECT_LE(worst, eps) << s;
            EXPECT_LE(worst, psfs[s].error_estimate()) << s;
            EXPECT_EQ(psfs[s].components().size(), psfs[0].components().size());
        }
    }
}

TEST(Chromatic, OneColourIsTheMonochromaticPsf) {
    const Optics optics = c5_optics();
    const Light one = monochromatic(1293e-9);
    const Psf chromatic = std::move(make_psfs(optics, std::vector{one}, settings(1e-8))[0]);
    const Psf plain(optics.aperture, optics.wavefront, settings(1e-8));
    Plane<double> a(20, 20), b(20, 20);
    chromatic.draw({9.2, 9.9, 3}, 1, a.view());
    plain.draw({9.2, 9.9, 3}, 1, b.view());
    for (int64_t y = 0; y < 20; ++y)
        for (int64_t x = 0; x < 20; ++x)
            EXPECT_EQ(a(x, y), b(x, y));
}

TEST(Chromatic, LargeStampsGetTheirOwnWavelengths) {
    const Optics optics = c5_optics();
    const Light light = detected_light(c5().band("J129"), power_law_sed(SedUnit::photons, 0));
    PsfSettings near = settings(1e-6), far = settings(1e-6);
    near.radius = 4;
    far.radius = 24;
    const Psf small = std::move(make_psfs(optics, std::vector{light}, near)[0]);
    const Psf large = std::move(make_psfs(optics, std::vector{light}, far)[0]);
    EXPECT_LT(small.components().size(), large.components().size());
    Plane<double> a(47, 47), b(47, 47);
    small.draw({23.2, 22.9, 1}, 1, a.view());
    large.draw({23.2, 22.9, 1}, 1, b.view());
    for (int64_t y = 0; y < 47; ++y)
        for (int64_t x = 0; x < 47; ++x)
            EXPECT_NEAR(a(x, y), b(x, y), 1e-6);
}

TEST(Chromatic, TheCallerMayStopTheWork) {
    const Optics optics = c5_optics();
    const Light light = detected_light(c5().band("J129"), power_law_sed(SedUnit::photons, 0));
    double last = -1;
    int calls = 0;
    const Progress progress{[&](double part) {
        EXPECT_GT(part, last);
        last = part;
        return ++calls < 3;
    }};
    try {
        make_psfs(optics, std::vector{light}, settings(1e-4), {.progress = progress});
        ADD_FAILURE() << "not stopped";
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), WFPSF_ERROR_CANCELLED);
    }
    EXPECT_EQ(calls, 3);
}

} // namespace
} // namespace wfpsf
