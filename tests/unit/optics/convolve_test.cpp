// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "instrument/instrument.hpp"
#include "optics/convolve.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace wfpsf {
namespace {

const Psf &psf() {
    static const Psf made(make_aperture(Instrument::get("wfirst-afta-c5").annular_pupil()),
                          Wavefront(std::vector<double>{0, 0, 0, 0.1, 0.05, 0, 0.1, -0.03}, 1.18),
                          {1300e-9, 0.11 * std::numbers::pi / 180 / 3600, 1e-8, 24});
    return made;
}

template <class S> Plane<S> galaxy(int64_t nx, int64_t ny) {
    Plane<S> samples(nx, ny);
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x)
            samples(x, y) =
                static_cast<S>(std::sin(static_cast<double>(3 * x * x + 7 * y + 1)) + 0.3);
    return samples;
}

// Stars of every sample, added up.
template <class S> Plane<double> stars(const Source<S> &source, int64_t m, int64_t nx, int64_t ny) {
    Plane<double> sum(nx, ny), star(nx, ny);
    const View<const S> &g = source.samples;
    const double step = static_cast<double>(m) / static_cast<double>(source.oversampling);
    for (int64_t b = 0; b < g.ny; ++b)
        for (int64_t a = 0; a < g.nx; ++a) {
            psf().draw(
                {source.x + step * (static_cast<double>(a) - static_cast<double>(g.nx - 1) / 2),
                 source.y + step * (static_cast<double>(b) - static_cast<double>(g.ny - 1) / 2),
                 source.flux * static_cast<double>(g(a, b))},
                m, star.view());
            for (int64_t i = 0; i < nx * ny; ++i)
                sum(i % nx, i / nx) += star(i % nx, i / nx);
        }
    return sum;
}

template <class S, class T>
void expect_sum_of_stars(int64_t gx, int64_t gy, int64_t n, int64_t m, int64_t nx, int64_t ny,
                         double tolerance) {
    const Plane<S> samples = galaxy<S>(gx, gy);
    const Source<S> source{samples.view(), n, 0.4 * static_cast<double>(nx),
                           0.55 * static_cast<double>(ny) + 0.17, 2.5};
    Plane<T> out(nx, ny);
    out(0, 0) = std::numeric_limits<T>::quiet_NaN(); // overwritten
    convolve(psf(), source, m, out.view());
    const Plane<double> truth = stars(source, m, nx, ny);
    double peak = 0, worst = 0;
    for (int64_t y = 0; y < ny; ++y)
        for (int64_t x = 0; x < nx; ++x) {
            peak = std::max(peak, std::abs(truth(x, y)));
            worst = std::max(worst, std::abs(static_cast<double>(out(x, y)) - truth(x, y)));
        }
    EXPECT_LE(worst, tolerance * peak) << gx << ' ' << gy << ' ' << n << ' ' << m;
}

TEST(Convolve, IsTheSumOfItsStars) {
    for (const auto &[n, m] : {std::pair(1, 1), std::pair(3, 1), std::pair(4, 1), std::pair(4, 2)})
        for (const auto &[gx, gy] : {std::pair(1, 1), std::pair(5, 8), std::pair(24, 17)})
            for (const auto &[nx, ny] : {std::pair(9, 12), std::pair(2, 1)})
                expect_sum_of_stars<double, double>(gx, gy, n, m, nx, ny, 2e-8);
    expect_sum_of_stars<double, double>(40, 31, 4, 1, 32, 25, 2e-8); // by FFT
    expect_sum_of_stars<float, float>(40, 31, 4, 1, 32, 25, 1e-6);
    expect_sum_of_stars<float, double>(33, 40, 3, 1, 24, 33, 2e-8);
    expect_sum_of_stars<double, float>(60, 60, 2, 1, 16, 16, 1e-6); // larger than the image
}

TEST(Convolve, OneSampleIsAStar) {
    Plane<double> one(7, 7), out(31, 33), star(31, 33);
    one(3, 3) = 3;
    convolve(psf(), Source<double>{one.view(), 4, 14.3, 17.9, 1}, 1, out.view());
    psf().draw({14.3, 17.9, 3}, 1, star.view());
    for (int64_t y = 0; y < 33; ++y)
        for (int64_t x = 0; x < 31; ++x)
            EXPECT_NEAR(out(x, y), star(x, y), 1e-8 * 3 * psf().peak());
}

TEST(Convolve, TakesAnyStrides) {
    Plane<double> samples = galaxy<double>(40, 30), turned(30, 40), out(20, 24), wanted(20, 24);
    for (int64_t y = 0; y < 30; ++y)
        for (int64_t x = 0; x < 40; ++x)
            turned(29 - y, 39 - x) = samples(x, y);
    convolve(psf(), Source<double>{samples.view(), 4, 9, 11, 1}, 1, wanted.view());
    const View<const double> backwards{&turned(29, 39), 40, 30, -30, -1};
    const View<double> upside_down{&out(0, 23), 20, 24, 1, -20};
    convolve(psf(), Source<double>{backwards, 4, 9, 11, 1}, 1, upside_down);
    for (int64_t y = 0; y < 24; ++y)
        for (int64_t x = 0; x < 20; ++x)
            EXPECT_EQ(out(x, 23 - y), wanted(x, y));
}

TEST(Convolve, HugeAndTinyFluxesKeepTheirPrecision) {
    Plane<double> samples = galaxy<double>(40, 30), out(20, 24), wanted(20, 24);
    convolve(psf(), Source<double>{samples.view(), 4, 9, 11, 1}, 1, wanted.view());
    for (const double factor : {0x1p-900, 0x1p900}) {
        Plane<double> other(40, 30);
        for (int64_t y = 0; y < 30; ++y)
            for (int64_t x = 0; x < 40; ++x)
                other(x, y) = factor * samples(x, y);
        convolve(psf(), Source<double>{other.view(), 4, 9, 11, 1}, 1, out.view());
        for (int64_t y = 0; y < 24; ++y)
            for (int64_t x = 0; x < 20; ++x)
                EXPECT_EQ(out(x, y) / factor, wanted(x, y));
    }
}

TEST(Convolve, EmptyAndDarkGalaxiesGiveZeros) {
    Plane<double> dark(4, 4), out(5, 5);
    for (const View<const double> samples : {View<const double>{}, std::as_const(dark).view()}) {
        out(2, 2) = 7;
        convolve(psf(), Source<double>{samples, 4, 2, 2, 1}, 1, out.view());
        for (int64_t i = 0; i < 25; ++i)
            EXPECT_EQ(out(i % 5, i / 5), 0);
    }
    convolve(psf(), Source<double>{dark.view(), 4, 2, 2, 1}, 1, View<double>{});
}

TEST(Convolve, Refuses) {
    Plane<double> samples(4, 4), out(5, 5);
    const auto status = [&](int64_t n, int64_t m) {
        try {
            convolve(psf(), Source<double>{samples.view(), n, 2, 2, 1}, m, out.view());
        } catch (const Error &error) {
            return error.status();
        }
        return wfpsf_status{WFPSF_OK};
    };
    samples(0, 0) = 1;
    EXPECT_EQ(status(4, 2), WFPSF_OK);
    EXPECT_EQ(status(3, 2), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(status(1, 2), WFPSF_ERROR_ARGUMENT);
    EXPECT_EQ(status(int64_t{1} << 40, 1), WFPSF_ERROR_SIZE);
    samples(3, 1) = std::nan("");
    EXPECT_EQ(status(4, 1), WFPSF_ERROR_NOT_FINITE);
}

} // namespace
} // namespace wfpsf
