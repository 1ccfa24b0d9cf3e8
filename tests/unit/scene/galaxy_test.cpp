// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "instrument/instrument.hpp"
#include "large_case.hpp"
#include "optics/psf.hpp"
#include "oracles/galaxy_oracle.hpp"
#include "scene/galaxy.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace wfpsf {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double pixel_arcsec = 0.11;

Transfer gaussian_transfer(double sigma) {
    return {[=](double kx, double ky) {
                return std::complex<double>(
                    std::exp(-2 * pi * pi * sigma * sigma * (kx * kx + ky * ky)));
            },
            1.25 / sigma};
}

struct Behind {
    explicit Behind(double sigma) : drawer(gaussian_transfer(sigma), pixel_arcsec, profiles) {}
    SersicProfiles profiles;
    GalaxyDrawer drawer;
};

Galaxy galaxy_of(double x, double y, double flux, double index, double radius_pixels, double e1,
                 double e2) {
    return {x, y, flux, index, radius_pixels * pixel_arcsec, e1, e2};
}

oracle::SersicGalaxy oracle_of(const Galaxy &g) {
    return {g.sersic_index, Sersic(g.sersic_index).b(), g.half_light_radius / pixel_arcsec, g.e1,
            g.e2};
}

// Gaussians behind a Gaussian: covariance sigma^2 + s^2 S S, all pixels, everywhere between pixels.
TEST(Galaxy, GaussianBehindAGaussianHasItsClosedForm) {
    const double sigma = 0.9;
    Behind behind(sigma);
    for (const double radius : {0.001, 0.3, 1.0, 4.0, 30.0})
        for (const auto &[e1, e2] :
             {std::pair(0.0, 0.0), std::pair(0.4, 0.0), std::pair(0.0, 0.4), std::pair(-0.2, -0.5)})
            for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
                const Galaxy g = galaxy_of(31.37, 29.62, 1, 0.5, radius, e1, e2);
                Plane<double> image(64, 60);
                const auto drawn = behind.drawer.add(g, tolerance, image.view());
                const double s2 = radius * radius / (2 * std::numbers::ln2), e = e1 * e1 + e2 * e2;
                const double xx = sigma * sigma + s2 * ((1 + e1) * (1 + e1) + e2 * e2) / (1 - e);
                const double yy = sigma * sigma + s2 * ((1 - e1) * (1 - e1) + e2 * e2) / (1 - e);
                const double xy = s2 * 2 * e2 / (1 - e), det = xx * yy - xy * xy;
                double worst = 0, light = 0;
                for (int64_t j = 0; j < 60; ++j)
                    for (int64_t i = 0; i < 64; ++i) {
                        const double x = static_cast<double>(i) - g.x,
                                     y = static_cast<double>(j) - g.y;
                        const double wanted =
                            std::exp(-(yy * x * x - 2 * xy * x * y + xx * y * y) / (2 * det)) /
                            (2 * pi * std::sqrt(det));
                        worst = std::max(worst, std::abs(image(i, j) - wanted));
                        light += image(i, j);
                    }
                EXPECT_LE(worst, tolerance) << radius << ' ' << e1 << ' ' << e2;
                EXPECT_NEAR(drawn.light, light, 1e-12);
            }
}

// All profiles and sizes, near the centre and far out, and where one grid of pixels is not enough.
// The image is a few pixels at some distance from the galaxy.
TEST(Galaxy, MeetsSumsInRealSpace) {
    const double sigma = 0.8;
    Behind behind(sigma);
    constexpr double flux = 1e6;
    for (const double index : {0.3, 1.0, 4.0, 6.2})
        for (const double radius : {0.001, 0.1, 1.0, 10.0, 100.0, 1000.0}) {
            const Galaxy middle = galaxy_of(0, 0, flux, index, radius, 0.3, -0.25);
            const oracle::SersicGalaxy truth = oracle_of(middle);
            const double peak = flux * oracle::behind_gaussian(truth, sigma, 0, 0);
            for (const auto &[x, y] :
                 {std::pair(0.3, -0.2), std::pair(1.4, 2.3), std::pair(-9.2, 4.6),
                  std::pair(31.0, 40.5), std::pair(-170.5, 120.25), std::pair(700.1, -512.0)}) {
                const Galaxy g = galaxy_of(-x, -y, flux, index, radius, 0.3, -0.25);
                const double wanted = flux * oracle::behind_gaussian(truth, sigma, x + 2, y + 1);
                for (const double relative : {1e-2, 1e-5}) {
                    Plane<double> image(3, 2);
                    behind.drawer.add(g, relative * peak, image.view());
                    EXPECT_NEAR(image(2, 1), wanted, relative * peak)
                        << index << ' ' << radius << " at " << x << ' ' << y << " to " << relative;
                }
            }
        }
}

// A galaxy as many stars, behind Roman's PSF.
TEST(Galaxy, IsASumOfStars) {
    WFPSF_LARGE_CASE();
    const auto &roman = std::get<RomanPupil>(Instrument::get("roman-c9").pupil(3, "H158"));
    const Wavefront wavefront(std::vector<double>{0, 0, 0, 0.05, -0.03, 0.02, 0.02, -0.03}, 1.18);
    const double scale = pixel_arcsec * pi / 180 / 3600;
    const Covariance blur{0.04, 0.01, 0.05};
    const Psf psf(make_aperture(roman), wavefront, {1577e-9, scale, 1e-7, 64, true, blur, true});
    const Otf otf(psf.components(), scale, true, 1e-4, blur, true);
    SersicProfiles profiles;
    GalaxyDrawer drawer(transfer_of(otf, scale), pixel_arcsec, profiles);
    for (const double index : {1.0, 4.0}) {
        const Galaxy g = galaxy_of(20.3, 18.8, 1, index, 1.5, 0.2, 0.3);
        std::vector<Star> stars;
        oracle::for_each_node(oracle_of(g), 1.2, index == 1 ? 14 : 40,
                              [&](double x, double y, double light) {
                                  stars.push_back({g.x + x, g.y + y, light});
                              });
        Plane<double> wanted(40, 40);
        psf.add<double>(stars, 1, wanted.view(), 1);
        for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
            Plane<double> image(40, 40);
            const auto drawn = drawer.add(g, tolerance, image.view());
            double worst = 0;
            for (int64_t j = 0; j < 40; ++j)
                for (int64_t i = 0; i < 40; ++i)
                    worst = std::max(worst, std::abs(image(i, j) - wanted(i, j)));
            EXPECT_LE(worst, tolerance) << index;
            EXPECT_LE(worst, 1.5 * drawn.error) << index;
        }
    }
}

TEST(Galaxy, CentroidAndShapeAreTheGalaxys) {
    Behind behind(0.7);
    for (const auto &[x, y] : {std::pair(40.0, 40.0), std::pair(39.63, 40.21)}) {
        Plane<double> image(81, 81);
        behind.drawer.add(galaxy_of(x, y, 1000, 1, 2, 0.3, 0), 1e-6, image.view());
        double light = 0, mx = 0, my = 0, xx = 0, yy = 0;
        for (int64_t j = 0; j < 81; ++j)
            for (int64_t i = 0; i < 81; ++i) {
                const double u = static_cast<double>(i) - x, v = static_cast<double>(j) - y;
                light += image(i, j);
                mx += image(i, j) * u;
                my += image(i, j) * v;
                xx += image(i, j) * u * u;
                yy += image(i, j) * v * v;
            }
        EXPECT_NEAR(light, 1000, 1e-3);
        EXPECT_NEAR(mx / light, 0, 1e-5);
        EXPECT_NEAR(my / light, 0, 1e-5);
        // A positive e1 is elongated along x: (1 + e1)^2 to (1 - e1)^2.
        const double half = 4 * Sersic(1).mean_square_radius() / 2 / (1 - 0.09);
        EXPECT_NEAR(xx / light, 0.49 + half * 1.69, 1e-3);
        EXPECT_NEAR(yy / light, 0.49 + half * 0.49, 1e-3);
    }
}

// What is clipped is what a larger image holds, and other pixels stay as they were.
TEST(Galaxy, IsClippedAtTheBordersAndAdded) {
    Behind behind(0.8);
    for (const double radius : {2.0, 150.0}) {
        Plane<double> large(100, 90), small(40, 30);
        const Galaxy g = galaxy_of(33.2, 55.7, 1e5, 1, radius, 0.1, 0.2);
        behind.drawer.add(g, 0.01, large.view());
        for (int64_t i = 0; i < 40 * 30; ++i)
            small(i % 40, i / 40) = 7;
        Galaxy moved = g;
        moved.x -= 25;
        moved.y -= 50;
        const auto drawn = behind.drawer.add(moved, 0.01, small.view());
        double light = 0;
        for (int64_t j = 0; j < 30; ++j)
            for (int64_t i = 0; i < 40; ++i) {
                EXPECT_NEAR(small(i, j) - 7, large(i + 25, j + 50), 1e-9);
                light += small(i, j) - 7;
            }
        EXPECT_NEAR(drawn.light, light, 1e-7);
    }
    Plane<float> image(20, 20);
    for (const double away : {-1e3, 1e3, 1e15, -1e300}) {
        const auto drawn =
            behind.drawer.add(galaxy_of(away, 10, 1e3, 4, 1, 0, 0), 0.1, image.view());
        EXPECT_EQ(drawn.light, 0);
        EXPECT_EQ(image(0, 0), 0);
    }
    EXPECT_EQ(behind.drawer.add(galaxy_of(10, 10, 0, 4, 1, 0, 0), 0.1, image.view()).light, 0);
    behind.drawer.add(galaxy_of(10, 10, -1e3, 1, 1, 0, 0), 0.1, image.view());
    EXPECT_LT(image(10, 10), -10);
}

TEST(Galaxy, PixelsBeyondTheRadiusAreFaint) {
    const double sigma = 0.8;
    Behind behind(sigma);
    for (const double index : {0.3, 0.5, 1.0, 4.0, 6.2})
        for (const double radius : {0.01, 1.0, 10.0, 300.0})
            for (const double tolerance : {1.0, 0.01}) {
                const Galaxy g = galaxy_of(0, 0, 1e5, index, radius, 0.4, 0.2);
                const double far = behind.drawer.radius(g, tolerance);
                for (int i = 0; i < 8; ++i) {
                    const double along = far * std::tan(pi / 4 * i / 8);
                    EXPECT_LE(1e5 * oracle::behind_gaussian(oracle_of(g), sigma, far, along),
                              tolerance)
                        << index << ' ' << radius;
                }
            }
}

TEST(Galaxy, PointLikeOnesAreStars) {
    const double sigma = 0.8;
    Behind behind(sigma);
    for (const double index : {0.5, 1.0, 4.0})
        for (const double tolerance : {1.0, 0.01}) {
            double radius = 1;
            while (!behind.drawer.is_point_like(galaxy_of(0, 0, 1e5, index, radius, 0.3, 0),
                                                tolerance))
                radius *= 0.9;
            const Galaxy g = galaxy_of(0, 0, 1e5, index, radius, 0.3, 0);
            const double galaxy = 1e5 * oracle::behind_gaussian(oracle_of(g), sigma, 0, 0);
            const double star = 1e5 / (2 * pi * sigma * sigma);
            EXPECT_LE(std::abs(galaxy - star), tolerance);
            EXPECT_GT(std::abs(galaxy - star), 0.05 * tolerance); // not much too careful
        }
}

TEST(Galaxy, RefusesWhatIsNone) {
    Behind behind(0.8);
    Plane<double> image(8, 8);
    const Galaxy good = galaxy_of(3, 4, 100, 1, 1, 0.1, 0);
    const auto status_of = [&](auto change, double tolerance = 0.1) {
        Galaxy g = good;
        change(g);
        try {
            behind.drawer.add(g, tolerance, image.view());
        } catch (const Error &error) {
            return error.status();
        }
        return wfpsf_status{WFPSF_OK};
    };
    const auto as_it_is = [](Galaxy &) {};
    EXPECT_EQ(status_of([](Galaxy &g) { g.x = NAN; }), WFPSF_ERROR_NOT_FINITE);
    EXPECT_EQ(status_of([](Galaxy &g) { g.flux = INFINITY; }), WFPSF_ERROR_NOT_FINITE);
    for (const double radius : {0.0, -1.0, 1e9, static_cast<double>(NAN)})
        EXPECT_EQ(status_of([=](Galaxy &g) { g.half_light_radius = radius; }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(status_of([](Galaxy &g) { g.e1 = 0.99; }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(status_of([](Galaxy &g) { g.e2 = NAN; }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(status_of([](Galaxy &g) { g.sersic_index = 0.2; }), WFPSF_ERROR_RANGE);
    for (const double tolerance : {0.0, -1.0, static_cast<double>(NAN)})
        EXPECT_EQ(status_of(as_it_is, tolerance), WFPSF_ERROR_RANGE);
    for (int64_t i = 0; i < 64; ++i)
        EXPECT_EQ(image(i % 8, i / 8), 0);
    EXPECT_EQ(status_of(as_it_is), WFPSF_OK);
}

} // namespace
} // namespace wfpsf
