// SPDX-License-Identifier: GPL-3.0-or-later
// Path difference maps: the spline against what was sampled, and PSFs through maps against the same
// aberrations as coefficients and against plain sums.
#include "error/error.hpp"
#include "optics/opd_map.hpp"
#include "optics/psf.hpp"
#include "oracles/psf_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <random>
#include <vector>

namespace wfpsf {
namespace {

using namespace oracle;

constexpr double pixel_scale = 0.11 * pi / 180 / 3600, wavelength = 1292e-9;
constexpr AnnularPupil annulus{1.18, 0.354};

// n x n samples of f (metres) from -half to half on both axes.
template <class F> std::shared_ptr<const OpdMap> sampled(const F &f, int64_t n, double half) {
    const double scale = 2 * half / static_cast<double>(n - 1);
    Plane<double> samples(n, n);
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            samples(x, y) =
                f(static_cast<double>(x) * scale - half, static_cast<double>(y) * scale - half);
    const double axis = static_cast<double>(n - 1) / 2;
    return std::make_shared<OpdMap>(std::as_const(samples).view(), scale, axis, axis);
}

Plane<double> noise(int64_t n, double rms, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, rms);
    Plane<double> samples(n, n);
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            samples(x, y) = normal(random);
    return samples;
}

// 60 nm rms or so, up to Z_22.
const Wavefront &zernikes() {
    static const Wavefront w(std::vector<double>{0,     0,      0,      0.03,  -0.02, 0.01,
                                                 0.02,  -0.015, 0.01,   0.005, 0.02,  -0.01,
                                                 0.01,  0.005,  -0.005, 0.01,  0.003, -0.004,
                                                 0.002, 0.004,  -0.003, 0.01},
                             1.18);
    return w;
}
double in_metres(double x, double y) {
    return zernikes()(x, y) * wavelength;
}

TEST(OpdMap, MeetsItsSamplesAndAllCubics) {
    const Plane<double> samples = noise(9, 1e-7, 3);
    const OpdMap map(samples.view(), 0.25, 2.5, 7);
    for (int64_t y = 0; y < 9; ++y)
        for (int64_t x = 0; x < 9; ++x)
            EXPECT_NEAR(
                map((static_cast<double>(x) - 2.5) * 0.25, (static_cast<double>(y) - 7) * 0.25),
                samples(x, y), 1e-21);
    const auto cubic = [](double x, double y) {
        return 1e-6 * (1 - x + 2 * x * x * x) * (y * y - 3 * y * y * y + 0.5);
    };
    for (const int64_t n : {4, 5, 6, 7, 20}) {
        const auto spline = sampled(cubic, n, 1.3);
        for (const auto &[x, y] : {std::pair(1.29, -1.28), {0.1, 0.7}, {-1.3, 1.3}, {-0.9, -1.2}})
            EXPECT_NEAR((*spline)(x, y), cubic(x, y), 1e-19) << n << ' ' << x << ' ' << y;
    }
}

TEST(OpdMap, GoesOnAsTheNearestPointOfItsBorder) {
    const Plane<double> samples = noise(6, 1e-7, 5);
    const OpdMap map(samples.view(), 1, 0, 0);
    for (const double far : {5.0, 5.1, 1e3, 1e300})
        EXPECT_NEAR(map(far, far), samples(5, 5), 1e-21) << far;
    EXPECT_DOUBLE_EQ(map(-1e300, 2.3), map(0, 2.3));
    EXPECT_DOUBLE_EQ(map(3.7, -4), map(3.7, 0));
}

TEST(OpdMap, SlopeBoundHolds) {
    const Plane<double> samples = noise(12, 1e-7, 7);
    for (const double axis : {5.5, -3.0, 30.0}) {
        const OpdMap map(samples.view(), 0.2, axis, 4);
        double steepest = 0;
        const double h = 1e-6;
        for (double y = -1; y <= 1; y += 0.03)
            for (double x = -1; x <= 1; x += 0.03)
                steepest = std::max(steepest, std::hypot(map(x + h, y) - map(x - h, y),
                                                         map(x, y + h) - map(x, y - h)) /
                                                  (2 * h));
        EXPECT_LE(steepest, map.slope_bound(1)) << axis;
    }
    const auto ramp = [](double x, double y) { return 3e-6 * x - 4e-6 * y; };
    EXPECT_NEAR(sampled(ramp, 50, 1)->slope_bound(1), 5e-6, 1e-17);
    // What lies outside of the disc does not count.
    const auto kink = [](double x, double) { return x > 0.9 ? 1e-4 : 0; };
    EXPECT_LT(sampled(kink, 201, 1)->slope_bound(0.5), 1e-10);
}

TEST(OpdMap, ErrorFallsAsTheFourthPower) {
    double before = 0;
    for (const int64_t n : {33, 65, 129, 257, 513}) {
        const auto map = sampled(in_metres, n, 1.18); // the circle touches the border
        double worst = 0;
        for (double r = 0; r < 1.18; r += 0.0131)
            for (double t = 0; t < 6.28; t += 0.1)
                worst = std::max(worst, std::abs((*map)(r * std::cos(t), r * std::sin(t)) -
                                                 in_metres(r * std::cos(t), r * std::sin(t))));
        if (n > 65) {
            EXPECT_LT(worst, before / 11) << n;
        }
        before = worst;
    }
    EXPECT_LT(before, 2e-15);
}

TEST(OpdMap, BadMapsAreRefused) {
    Plane<double> samples(5, 5);
    const auto make = [&] { OpdMap(std::as_const(samples).view(), 1, 0, 0); };
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 35.0, -2e-3}) {
        samples(3, 2) = bad;
        EXPECT_THROW(make(), Error) << bad;
    }
    for (const auto &[nx, ny] : {std::pair(0, 0), {1, 1}, {3, 9}, {9, 3}}) {
        samples = Plane<double>(nx, ny);
        EXPECT_THROW(make(), Error) << nx;
    }
}

struct Stamp {
    Plane<double> value;
    double estimate, peak;
};
Stamp draw(const Wavefront &wavefront, double eps) {
    const Psf psf(make_aperture(annulus), wavefront, {wavelength, pixel_scale, eps, 10});
    Stamp stamp{Plane<double>(17, 17), psf.error_estimate(), 0};
    psf.draw({8.2, 7.7, 1}, 1, stamp.value.view());
    for (int64_t y = 0; y < 17; ++y)
        for (int64_t x = 0; x < 17; ++x)
            stamp.peak = std::max(stamp.peak, stamp.value(x, y));
    return stamp;
}
double difference(const Stamp &a, const Stamp &b) {
    double worst = 0;
    for (int64_t y = 0; y < 17; ++y)
        for (int64_t x = 0; x < 17; ++x)
            worst = std::max(worst, std::abs(a.value(x, y) - b.value(x, y)) / b.peak);
    return worst;
}
Wavefront through(std::shared_ptr<const OpdMap> map) {
    Wavefront wavefront({}, 1.18);
    wavefront.add(std::move(map), wavelength);
    return wavefront;
}

TEST(OpdMap, OfZernikesGivesTheirPsf) {
    const Stamp truth = draw(zernikes(), 1e-11);
    double coarse = 0;
    for (const int64_t n : {32, 64, 256, 1024}) {
        const Wavefront wavefront = through(sampled(in_metres, n, 1.25));
        const Stamp stamp = draw(wavefront, 1e-8);
        const double worst = difference(stamp, truth);
        EXPECT_LE(stamp.estimate, 1e-8) << n;
        if (n == 32)
            coarse = worst;
        if (n == 64) {
            EXPECT_LT(worst, coarse / 10);
        }
        if (n > 64) {
            EXPECT_LT(worst, 1e-8) << n;
        }
    }
}

// The intensity through random maps against a plain sum over far more nodes.
TEST(OpdMap, RoughMapsHaveHonestEstimates) {
    const auto aperture = make_aperture(annulus);
    const PupilNodes fine = pupil_nodes(annulus, 1500, 1e-14);
    const FocalGrid grid{65, 0.25 * pixel_scale};
    for (const auto &[n, rms] :
         {std::pair(int64_t{32}, 1e-9), {32, 1e-7}, {128, 1e-9}, {128, 1e-8}}) {
        const Plane<double> samples = noise(n, rms, 11);
        const double half = static_cast<double>(n - 1) / 2;
        const Wavefront wavefront =
            through(std::make_shared<OpdMap>(samples.view(), 1.2 / half, half, half));
        const Intensity truth = brute_force(fine, wavefront, wavelength);
        const double scale = aperture->area() * wavelength * wavelength;
        std::vector<std::pair<int64_t, int64_t>> at{{32, 32}, {33, 30}, {0, 0}, {64, 20}};
        std::vector<double> exact;
        for (const auto &[x, y] : at)
            exact.push_back(truth(grid.angle(x), grid.angle(y)) * scale);
        for (const double eps : {1e-3, 1e-5, 1e-7}) {
            const Diffraction d = aperture->diffract(wavefront, wavelength, grid, eps);
            double worst = 0;
            for (size_t i = 0; i < at.size(); ++i)
                worst =
                    std::max(worst, std::abs(d.intensity(at[i].first, at[i].second) - exact[i]));
            worst /= aperture->area() * aperture->area();
            EXPECT_LE(worst, d.error) << n << ' ' << rms << ' ' << eps;
            if (eps == 1e-3) {
                EXPECT_LE(d.error, eps) << n << ' ' << rms;
            }
        }
    }
}

// A mask sampled like the map: each pixel's phase is that of its sample.
TEST(OpdMap, IsMetAtAMasksPixels) {
    const int64_t n = 24;
    const double scale = 0.1;
    const Plane<double> samples = noise(n, 1e-7, 13);
    Plane<double> mask(n, n);
    for (int64_t y = 2; y < n - 2; ++y)
        for (int64_t x = 3; x < n - 1; ++x)
            mask(x, y) = 0.5 + 0.5 * static_cast<double>((x * y) % 2);
    const auto aperture = make_aperture(std::as_const(mask).view(), scale, 11, 12);
    const FocalGrid grid{9, 0.5 * pixel_scale};
    const Diffraction d = aperture->diffract(
        through(std::make_shared<OpdMap>(samples.view(), scale, 11, 12)), wavelength, grid, 1e-9);
    const double k = 2 * pi / wavelength;
    for (const auto &[i, j] : {std::pair(4, 4), {0, 8}, {7, 3}}) {
        std::complex<double> sum = 0;
        const auto sinc = [&](double angle) {
            const double half = k * angle * scale / 2;
            return half == 0 ? scale : scale * std::sin(half) / half;
        };
        for (int64_t y = 0; y < n; ++y)
            for (int64_t x = 0; x < n; ++x)
                sum += std::polar(mask(x, y),
                                  k * (samples(x, y) +
                                       static_cast<double>(x - 11) * scale * grid.angle(i) +
                                       static_cast<double>(y - 12) * scale * grid.angle(j)));
        sum *= sinc(grid.angle(i)) * sinc(grid.angle(j));
        EXPECT_LT(std::abs(d.intensity(i, j) - std::norm(sum)),
                  1e-12 * aperture->area() * aperture->area());
    }
}

} // namespace
} // namespace wfpsf
