// SPDX-License-Identifier: GPL-3.0-or-later
// A star's derivatives against finite differences of whole measurements, extrapolated.
#include "c5_star.hpp"
#include "detector/ipc_convolve.hpp"
#include "study/ipc_star.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <utility>

namespace wfpsf {
namespace {

constexpr double wavelength = 1292.11e-9;
constexpr double bandwidth = 2.36 * pixel_arcsec * std::numbers::pi / 180 / 3600 / wavelength;

IpcStar star_of(const Psf &psf) {
    return IpcStar(psf, IpcStar::sufficient_oversampling(bandwidth),
                   IpcStar::sufficient_side(bandwidth));
}

Psf precise_psf(const Covariance &blur = {}, const Wavefront &wavefront = c5_wavefront(7)) {
    return c5_psf(wavelength, wavefront, c5_settings(1e-12, 16, blur));
}

// Central differences at three steps, Richardson's extrapolation to none.
StarShape<double> differences(const std::function<StarShape<double>(double)> &at, double h) {
    using S = StarShape<double>;
    const std::array<S, 3> up{at(h), at(2 * h), at(4 * h)};
    const std::array<S, 3> down{at(-h), at(-2 * h), at(-4 * h)};
    const auto each = [&](double S::*number) {
        const auto slope = [&](size_t i) {
            return (up[i].*number - down[i].*number) / (2 * h * static_cast<double>(1 << i));
        };
        return (16 * (4 * slope(0) - slope(1)) / 3 - (4 * slope(1) - slope(2)) / 3) / 15;
    };
    return {each(&S::x), each(&S::y), each(&S::sigma), each(&S::trace), each(&S::e1), each(&S::e2)};
}

void expect_slopes(const StarShape<HyperDual> &slopes, const StarShape<double> &expected,
                   double tolerance) {
    EXPECT_NEAR(slopes.x.da, expected.x, tolerance);
    EXPECT_NEAR(slopes.y.da, expected.y, tolerance);
    EXPECT_NEAR(slopes.sigma.da, expected.sigma, tolerance);
    EXPECT_NEAR(slopes.trace.da, expected.trace, tolerance);
    EXPECT_NEAR(slopes.e1.da, expected.e1, tolerance);
    EXPECT_NEAR(slopes.e2.da, expected.e2, tolerance);
}

TEST(IpcStar, ImageIsThatOfTheKernel) {
    const IpcStar star = star_of(precise_psf());
    const Ipc ipc{0.03, 0.004, -0.002};
    const Plane<double> image = star.image(ipc), bare = star.image({});
    Plane<double> expected(star.side(), star.side());
    convolve(IpcKernel::parametric(ipc.alpha, ipc.alpha_prime, ipc.alpha_plus), bare.view(),
             {.tap_step = star.oversampling()}, expected.view());
    double worst = 0;
    for (int64_t y = 0; y < star.side(); ++y)
        for (int64_t x = 0; x < star.side(); ++x)
            worst = std::max(worst, std::abs(image(x, y) - expected(x, y)));
    EXPECT_LE(worst, 1e-16);
}

TEST(IpcStar, SlopesByIpc) {
    const IpcStar star = star_of(precise_psf());
    const Plane<double> image = star.image(nominal_ipc);
    const AdaptiveMoments m = star.measure(image);
    const StarSlopes slopes(star, image, m);
    double Ipc::*const members[] = {&Ipc::alpha, &Ipc::alpha_prime, &Ipc::alpha_plus};
    for (size_t p = 0; p < ipc_parameters; ++p) {
        SCOPED_TRACE(p);
        const auto at = [&](double change) {
            Ipc ipc = nominal_ipc;
            ipc.*members[p] += change;
            return star.shape(star.measure(star.image(ipc), m.weight));
        };
        expect_slopes(slopes.along(star.change(p)), differences(at, 5e-4), 1e-8);
    }
}

// The base is blurred, so that differences may go both ways.
TEST(IpcStar, SlopesByBlur) {
    const Covariance base{0.05, 0.01, 0.04};
    const IpcStar star = star_of(precise_psf(base));
    const Plane<double> image = star.image(nominal_ipc);
    const StarSlopes slopes(star, image, star.measure(image));
    for (const Covariance &by : {Covariance{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}}) {
        SCOPED_TRACE(by.xx + 2 * by.xy + 4 * by.yy);
        const auto at = [&](double t) {
            const IpcStar moved = star_of(
                precise_psf({base.xx + t * by.xx, base.xy + t * by.xy, base.yy + t * by.yy}));
            return moved.shape(moved.measure(moved.image(nominal_ipc)));
        };
        expect_slopes(slopes.along_blur(by), differences(at, 2e-3), 1e-8);
    }
}

// Differences of whole PSFs.
TEST(IpcStar, SlopesByZernikes) {
    const Psf psf = precise_psf();
    const IpcStar star = star_of(psf);
    const Plane<double> image = star.image(nominal_ipc);
    const StarSlopes slopes(star, image, star.measure(image));
    const std::vector<StarChange> changes = zernike_changes(psf, star, 1.18, 4, 11);
    ASSERT_EQ(changes.size(), 8u);
    for (size_t j = 4; j <= 11; ++j) {
        SCOPED_TRACE(j);
        const auto at = [&](double t) {
            const IpcStar moved = star_of(precise_psf({}, c5_wavefront(7, j, t)));
            return moved.shape(moved.measure(moved.image(nominal_ipc)));
        };
        expect_slopes(slopes.along(changes[j - 4].star.image(nominal_ipc).view()),
                      differences(at, 1e-3), 1e-8);
    }
}

// Three times as many samples change nothing; neither do more pixels.
TEST(IpcStar, SamplesAndSideSuffice) {
    for (const double nm : {620.0, 873.39, 1292.11, 2125.0}) {
        SCOPED_TRACE(nm);
        const double width = 2.36 * pixel_arcsec * std::numbers::pi / 180 / 3600 / (nm * 1e-9);
        const Psf psf = c5_psf(nm * 1e-9, c5_wavefront(7), c5_settings(1e-11, 16));
        const int64_t N = IpcStar::sufficient_oversampling(width);
        const int64_t side = IpcStar::sufficient_side(width);
        const auto measured = [&](int64_t oversampling, int64_t native_side) {
            const IpcStar star(psf, oversampling, native_side);
            const Plane<double> image = star.image(nominal_ipc);
            const StarSlopes slopes(star, image, star.measure(image));
            return slopes.along(star.change(0));
        };
        const auto own = measured(N, side), finer = measured(3 * N, side),
                   wider = measured(N, side + 8);
        for (const auto &other : {finer, wider}) {
            EXPECT_NEAR(own.sigma.value, other.sigma.value, 2e-11);
            EXPECT_NEAR(own.e1.value, other.e1.value, 2e-11);
            EXPECT_NEAR(own.sigma.da, other.sigma.da, 1e-9);
            EXPECT_NEAR(own.e1.da, other.e1.da, 1e-9);
        }
    }
}

} // namespace
} // namespace wfpsf
