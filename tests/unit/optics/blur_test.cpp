// SPDX-License-Identifier: GPL-3.0-or-later
// Jitter and charge diffusion against a plain sum: a finely sampled PSF convolved with the Gaussian
// step by step.
#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "oracles/psf_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace wfpsf {
namespace {

using oracle::pi;

constexpr double pixel_scale = 0.11 * pi / 180 / 3600;

Psf make_psf(double eps, const Covariance &blur, double radius) {
    const Instrument &c5 = Instrument::get("wfirst-afta-c5");
    return Psf(make_aperture(std::get<SegmentedPupil>(c5.pupil(7, "J129"))),
               Wavefront({{0, 0, 0, 0.02, 0.03, -0.01, 0.02}}, 1.18),
               {.wavelength = 1292.11e-9,
                .pixel_scale = pixel_scale,
                .eps = eps,
                .radius = radius,
                .blur = blur});
}

// A band-limited image times a Gaussian holds so little above the sampling rate that equal steps
// are exact, if the Gaussian is not much narrower than they are.
double plain_sum(const Plane<double> &fine, int64_t N, int64_t x, int64_t y, const Covariance &c) {
    const double determinant = c.xx * c.yy - c.xy * c.xy;
    double sum = 0;
    for (int64_t j = 0; j < fine.ny(); ++j)
        for (int64_t i = 0; i < fine.nx(); ++i) {
            const double u = static_cast<double>(i - x) / static_cast<double>(N);
            const double v = static_cast<double>(j - y) / static_cast<double>(N);
            sum += fine(i, j) *
                   std::exp(-(c.yy * u * u - 2 * c.xy * u * v + c.xx * v * v) / (2 * determinant));
        }
    return sum / (2 * pi * std::sqrt(determinant));
}

TEST(Blur, GaussiansOfAnyShapeMeetAPlainSum) {
    const int64_t N = 16, centre = 12 * N;
    const Psf sharp = make_psf(1e-11, {}, 13);
    Plane<double> fine(2 * centre + 1, 2 * centre + 1);
    sharp.draw({static_cast<double>(centre), static_cast<double>(centre), 1}, N, fine.view());
    for (const Covariance &c :
         {Covariance{0.04, 0, 0.04}, Covariance{0.3, 0, 0.02}, Covariance{0.09, 0.05, 0.06},
          Covariance{0.5, -0.3, 0.2}, Covariance{0.02, 0.0099, 0.02}}) {
        for (const double eps : {1e-3, 1e-6, 1e-9}) {
            const Psf psf = make_psf(eps, c, 6);
            Plane<double> stamp(9, 9);
            psf.draw({4, 4, 1}, 1, stamp.view());
            double worst = 0;
            for (int64_t y = 0; y < 9; ++y)
                for (int64_t x = 0; x < 9; ++x)
                    worst = std::max(worst,
                                     std::abs(stamp(x, y) - plain_sum(fine, N, centre + (x - 4) * N,
                                                                      centre + (y - 4) * N, c)));
            worst /= stamp(4, 4);
            EXPECT_LE(worst, eps) << c.xx << ' ' << c.xy << ' ' << c.yy;
            EXPECT_LE(worst, psf.error_estimate()) << c.xx << ' ' << c.xy << ' ' << c.yy;
            EXPECT_LE(psf.error_estimate(), eps);
        }
    }
}

// Movement along a line only, and hardly any at all: the limits of the sums above.
TEST(Blur, LinesAndSmallGaussiansAreTheirLimits) {
    const auto stamp_of = [](const Covariance &c) {
        Plane<double> stamp(9, 9);
        make_psf(1e-9, c, 6).draw({4.2, 3.9, 1}, 1, stamp.view());
        return stamp;
    };
    const auto difference = [](const Plane<double> &a, const Plane<double> &b) {
        double worst = 0;
        for (int64_t y = 0; y < 9; ++y)
            for (int64_t x = 0; x < 9; ++x)
                worst = std::max(worst, std::abs(a(x, y) - b(x, y)));
        return worst;
    };
    const Plane<double> sharp = stamp_of({});
    EXPECT_LE(difference(stamp_of({1e-12, 0, 1e-12}), sharp), 1e-9);
    EXPECT_LE(difference(stamp_of({1e-12, 1e-12, 1e-12}), sharp), 1e-9);
    EXPECT_GE(difference(stamp_of({1e-3, 0, 0}), sharp), 1e-4);
    EXPECT_LE(difference(stamp_of({0.1, 0.1, 0.1}), stamp_of({0.1 + 1e-9, 0.1, 0.1 + 1e-9})), 1e-8);
    EXPECT_LE(difference(stamp_of({0.2, 0, 0}), stamp_of({0.2, 1e-12, 1e-9})), 1e-8);
    // Axes exchanged by a rotation of 45 degrees.
    EXPECT_LE(difference(stamp_of({0.2, 0, 0.2}), stamp_of({0.2, 1e-10, 0.2})), 1e-9);
}

} // namespace
} // namespace wfpsf
