// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "oracles/psf_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace wfpsf {
namespace {

using namespace oracle;

constexpr double pixel_scale = 0.11 * pi / 180 / 3600;

const Instrument &c5() {
    return Instrument::get("wfirst-afta-c5");
}

const SegmentedPupil &c5_pupil() {
    return std::get<SegmentedPupil>(c5().pupil(7, "J129"));
}

Wavefront flat() {
    return Wavefront({}, 1.18);
}

Wavefront sca_wavefront(int sca, double wavelength, double extra_defocus = 0) {
    const auto zernikes = c5().zernikes(sca);
    std::vector<double> waves(zernikes.begin(), zernikes.end());
    std::fill_n(waves.begin(), 3, 0.0);
    waves[3] += extra_defocus;
    for (double &a : waves)
        a *= 1293e-9 / wavelength;
    return Wavefront(waves, 1.18);
}

struct Probe {
    int64_t x, y; // pixels of a 33 x 33 native stamp whose centre is (16, 16)
    double value;
};

// Draws a 33 x 33 native stamp and compares it with the truth at the probes.
void expect_within_eps(const Psf &psf, double star_x, double star_y,
                       const std::vector<Probe> &probes, const char *what) {
    Plane<double> stamp(33, 33);
    psf.draw({star_x, star_y, 1}, 1, stamp.view());
    double peak = 0, worst = 0;
    for (int64_t y = 0; y < 33; ++y)
        for (int64_t x = 0; x < 33; ++x)
            peak = std::max(peak, stamp(x, y));
    for (const Probe &probe : probes)
        worst = std::max(worst, std::abs(stamp(probe.x, probe.y) - probe.value) / peak);
    EXPECT_LE(worst, psf.settings().eps) << what << ' ' << psf.settings().eps;
    EXPECT_LE(worst, psf.error_estimate()) << what << ' ' << psf.settings().eps;
    EXPECT_LE(psf.error_estimate(), psf.settings().eps) << what;
}

std::vector<Probe> probes_of(const Intensity &truth, double star_x, double star_y,
                             std::vector<std::pair<int64_t, int64_t>> at) {
    std::vector<Probe> probes;
    for (const auto &[x, y] : at)
        probes.push_back({x, y,
                          in_pixel(truth, (static_cast<double>(x) - star_x) * pixel_scale,
                                   (static_cast<double>(y) - star_y) * pixel_scale, pixel_scale)});
    return probes;
}

TEST(Psf, ObscuredAiryPatternIsMetAtEveryTolerance) {
    const AnnularPupil pupil = c5().annular_pupil();
    for (const double wavelength : {873.39e-9, 1837.3e-9}) {
        const double star_x = 16.37, star_y = 15.81;
        const std::vector<Probe> probes =
            probes_of(airy(pupil, wavelength), star_x, star_y,
                      {{16, 16}, {17, 16}, {16, 15}, {13, 20}, {5, 9}, {0, 0}, {32, 0}, {31, 32}});
        for (double eps = 1e-2; eps > 3e-12; eps /= 10)
            expect_within_eps(
                Psf(make_aperture(pupil), flat(), {wavelength, pixel_scale, eps, 17.5}), star_x,
                star_y, probes, "annulus");
    }
}

TEST(Psf, AberratedSegmentsMeetABruteForceSumAtEveryTolerance) {
    struct Case {
        int sca;
        double wavelength, defocus;
        const char *name;
    };
    for (const Case &c : {Case{7, 1292.11e-9, 0, "J129 SCA 7"}, Case{1, 873.39e-9, 0, "Z087 SCA 1"},
                          Case{7, 1577.05e-9, 1.5, "H158 SCA 7, 1.5 waves of defocus"}}) {
        const Wavefront wavefront = sca_wavefront(c.sca, c.wavelength, c.defocus);
        const Intensity truth =
            brute_force(pupil_nodes(c5_pupil(), 180, 1e-14), wavefront, c.wavelength);
        const double star_x = 15.75, star_y = 16.2;
        const std::vector<Probe> probes =
            probes_of(truth, star_x, star_y, {{16, 16}, {15, 17}, {0, 32}, {32, 1}});
        for (const double eps : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10})
            expect_within_eps(
                Psf(make_aperture(c5_pupil()), wavefront, {c.wavelength, pixel_scale, eps, 17.5}),
                star_x, star_y, probes, c.name);
    }
}

// Without the pixel's response stamps hold the density of the light, native or oversampled.
TEST(Psf, LightThatIsNotAveragedMeetsTheAiryPattern) {
    const AnnularPupil pupil = c5().annular_pupil();
    const double wavelength = 1292.11e-9;
    const Intensity truth = airy(pupil, wavelength);
    for (const double eps : {1e-2, 1e-5, 1e-8, 1e-11}) {
        const Psf psf(make_aperture(pupil), flat(),
                      {.wavelength = wavelength,
                       .pixel_scale = pixel_scale,
                       .eps = eps,
                       .radius = 12,
                       .pixel_response = false});
        EXPECT_LE(psf.error_estimate(), eps);
        for (const int64_t oversampling : {1, 3}) {
            const int64_t size = 15 * oversampling;
            const auto n = static_cast<double>(oversampling);
            const double star_x = 7.3 * n, star_y = 6.9 * n, step = pixel_scale / n;
            Plane<double> stamp(size, size);
            psf.draw({star_x, star_y, 1}, oversampling, stamp.view());
            double worst = 0, peak = 0;
            for (int64_t y = 0; y < size; ++y)
                for (int64_t x = 0; x < size; ++x) {
                    const double wanted = step * step *
                                          truth((static_cast<double>(x) - star_x) * step,
                                                (static_cast<double>(y) - star_y) * step);
                    peak = std::max(peak, wanted);
                    worst = std::max(worst, std::abs(stamp(x, y) - wanted));
                }
            EXPECT_LE(worst / peak, psf.error_estimate()) << eps << ' ' << oversampling;
        }
    }
}

// A fully lit mask is a square aperture, whose pattern is the product of two sinc^2: the mask path
// against a closed form, with the axis off the centre (a phase, lost in the intensity).
TEST(Psf, SquareMaskMeetsItsSincs) {
    const int n = 40;
    const double scale = 0.05, side = n * scale, wavelength = 1300e-9;
    Plane<double> mask(n, n);
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            mask(x, y) = 1;
    const auto sinc2 = [](double t) { return t == 0 ? 1 : std::pow(std::sin(t) / t, 2); };
    const Intensity truth = [=](double x, double y) {
        return side * side / (wavelength * wavelength) * sinc2(pi * side * x / wavelength) *
               sinc2(pi * side * y / wavelength);
    };
    const std::vector<Probe> probes =
        probes_of(truth, 16.2, 16.4, {{16, 16}, {17, 16}, {16, 14}, {3, 16}, {0, 0}, {32, 32}});
    for (const double eps : {1e-3, 1e-6, 1e-9})
        expect_within_eps(Psf(make_aperture(std::as_const(mask).view(), scale, 17.3, 21.9), flat(),
                              {wavelength, pixel_scale, eps, 17.5}),
                          16.2, 16.4, probes, "square");
}

TEST(Psf, SamplingOffsetsAndTypesAgree) {
    const Psf psf(make_aperture(c5_pupil()), sca_wavefront(7, 1292.11e-9),
                  {1292.11e-9, pixel_scale, 1e-9, 8});
    // Native pixels are every N-th sample of an oversampled stamp, times N^2.
    const int64_t N = 5;
    Plane<double> native(7, 6), fine(7 * N, 6 * N);
    psf.draw({3.3, 2.6, 2.5}, 1, native.view());
    psf.draw({3.3 * N, 2.6 * N, 2.5}, N, fine.view());
    for (int64_t y = 0; y < 6; ++y)
        for (int64_t x = 0; x < 7; ++x)
            EXPECT_NEAR(fine(N * x, N * y) * N * N, native(x, y), 1e-9);
    // A stamp beyond the radius, in float, with both strides negative.
    const int64_t n = 25;
    std::vector<float> pixels(static_cast<size_t>(n * n));
    psf.draw({15.3, 14.6, 2.5}, 1, View<float>{pixels.data() + n * n - 1, n, n, -1, -n});
    for (int64_t y = 0; y < 6; ++y)
        for (int64_t x = 0; x < 7; ++x)
            EXPECT_NEAR(pixels[static_cast<size_t>(n * n - 1 - (y + 12) * n - (x + 12))],
                        native(x, y), 1e-7);
    Plane<double> none(0, 0);
    psf.draw({0, 0, 1}, 1, none.view());
    EXPECT_THROW(psf.draw({1e5, 0, 1}, 1, native.view()), Error);
}

// Stars in a heap, on and beyond the borders, against a stamp of each drawn by itself.
TEST(Psf, StarsAreAddedWithClippingAndAnyNumberOfThreads) {
    const Psf psf(make_aperture(c5_pupil()), sca_wavefront(7, 1292.11e-9),
                  {1292.11e-9, pixel_scale, 1e-8, 6});
    const std::vector<Star> stars = {{10.3, 12.9, 100}, {10.3, 12.9, 50}, {-0.5, 20, 70},
                                     {39, -5.6, 30},    {-7, 3, 1e6},     {1e300, 0, 1},
                                     {20, 33.5, -20},   {46.2, 36, 10}};
    for (const int64_t N : {1, 3}) {
        Plane<double> expected(41, 37);
        for (const Star &star : stars) {
            if (!(std::abs(star.x) < 100))
                continue;
            Plane<double> stamp(41, 37);
            psf.draw({star.x, star.y, star.flux}, N, stamp.view());
            for (int64_t y = 0; y < 37; ++y)
                for (int64_t x = 0; x < 41; ++x)
                    if (std::abs(static_cast<double>(x) - star.x) <= 6.0 * static_cast<double>(N) &&
                        std::abs(static_cast<double>(y) - star.y) <= 6.0 * static_cast<double>(N))
                        expected(x, y) += stamp(x, y);
        }
        Plane<double> one(41, 37);
        psf.add(stars, N, one.view(), 1);
        for (int64_t y = 0; y < 37; ++y)
            for (int64_t x = 0; x < 41; ++x)
                EXPECT_NEAR(one(x, y), expected(x, y), 2e-6) << x << ' ' << y;
        for (const int threads : {2, 3, 7, 100}) {
            Plane<double> many(41, 37);
            psf.add(stars, N, many.view(), threads);
            for (int64_t y = 0; y < 37; ++y)
                for (int64_t x = 0; x < 41; ++x)
                    ASSERT_EQ(many(x, y), one(x, y)) << threads << ' ' << x << ' ' << y;
        }
    }
    Plane<float> none(0, 0);
    psf.add(stars, 1, none.view(), 4);
}

TEST(Psf, EqualCallsGiveEqualBits) {
    const auto draw = [] {
        const Psf psf(make_aperture(c5_pupil()), sca_wavefront(3, 1577.05e-9),
                      {1577.05e-9, pixel_scale, 1e-6, 8});
        Plane<double> stamp(16, 16);
        psf.draw({7.1, 7.9, 1}, 1, stamp.view());
        return std::vector<double>(stamp.view().data, stamp.view().data + 256);
    };
    EXPECT_EQ(draw(), draw());
}

TEST(Psf, DarkAndFalseMasksAreRefused) {
    Plane<double> mask(4, 4);
    EXPECT_THROW(make_aperture(std::as_const(mask).view(), 0.1, 0, 0), Error);
    for (const double bad : {-0.1, 1.5, std::nan("")}) {
        mask(1, 2) = bad;
        EXPECT_THROW(make_aperture(std::as_const(mask).view(), 0.1, 0, 0), Error);
    }
}

} // namespace
} // namespace wfpsf
