// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "instrument/design.hpp"
#include "observation/observation.hpp"
#include "oracles/wcs_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace wfpsf {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

const char *const names[] = {"roman-c9", "wfirst-afta-c5"};
constexpr SkyPosition pointings[] = {{53.1, -27.8}, {0, 0},     {359.95, 12}, {180, 90},
                                     {10, -90},     {77, 89.7}, {200, -60}};

Observation observe(const char *name, const SkyPosition &at, bool as_galsim = false,
                    double pa = 37) {
    return {Instrument::get(name), at, pa, {.as_galsim = as_galsim, .angle_is_of_fpa = false}};
}

struct Pixels {
    std::vector<double> x, y;
};

Pixels random_pixels(size_t count, double beyond) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-beyond, 4087 + beyond);
    Pixels pixels{std::vector<double>(count), std::vector<double>(count)};
    for (size_t i = 0; i < count; ++i) {
        pixels.x[i] = place(random);
        pixels.y[i] = place(random);
    }
    return pixels;
}

double apart_arcsec(double ra, double dec, double other_ra, double other_dec) {
    return angle_deg(direction({ra, dec}), direction({other_ra, other_dec})) * 3600;
}

TEST(Observation, WcslibReadsTheHeaderAndAgrees) {
    const Pixels pixels = random_pixels(50, 500);
    const auto n = std::ssize(pixels.x);
    for (const char *name : names)
        for (const SkyPosition &at : pointings)
            for (const bool as_galsim : {false, true}) {
                const Observation observation = observe(name, at, as_galsim);
                for (const int sca : {1, 9, 17}) {
                    WcsOracle oracle(fits_header(observation, sca));
                    std::vector<double> ra(pixels.x.size()), dec(ra), x(ra), y(ra), pairs, sky;
                    EXPECT_EQ(observation.wcs(sca).to_sky(n, pixels.x.data(), pixels.y.data(),
                                                          ra.data(), dec.data()),
                              0);
                    EXPECT_EQ(
                        observation.wcs(sca).to_pixel(n, ra.data(), dec.data(), x.data(), y.data()),
                        0);
                    for (size_t i = 0; i < ra.size(); ++i) {
                        pairs.insert(pairs.end(), {pixels.x[i] + 1, pixels.y[i] + 1});
                        sky.insert(sky.end(), {ra[i], dec[i]});
                        EXPECT_GE(ra[i], 0);
                        EXPECT_LT(ra[i], 360);
                    }
                    const std::vector<double> theirs = oracle.to_sky(pairs);
                    const std::vector<double> back = oracle.to_pixel(sky);
                    for (size_t i = 0; i < ra.size(); ++i) {
                        EXPECT_LT(apart_arcsec(ra[i], dec[i], theirs[2 * i], theirs[2 * i + 1]),
                                  2e-9);
                        EXPECT_NEAR(x[i], pixels.x[i], 1e-8);
                        EXPECT_NEAR(y[i], pixels.y[i], 1e-8);
                        EXPECT_NEAR(back[2 * i], x[i] + 1, 1e-6);
                        EXPECT_NEAR(back[2 * i + 1], y[i] + 1, 1e-6);
                    }
                }
            }
}

TEST(Observation, FarOffItsDetectorIsStillTheInverse) {
    const Pixels pixels = random_pixels(300, 8192);
    const auto n = std::ssize(pixels.x);
    for (const char *name : names)
        for (int sca = 1; sca <= 18; ++sca) {
            const Observation observation = observe(name, {10, 20});
            std::vector<double> x = pixels.x, y = pixels.y; // in place
            EXPECT_EQ(observation.wcs(sca).to_sky(n, x.data(), y.data(), x.data(), y.data()), 0);
            EXPECT_LE(observation.wcs(sca).to_pixel(n, x.data(), y.data(), x.data(), y.data()), 0);
            for (size_t i = 0; i < x.size(); ++i)
                EXPECT_LT(std::hypot(x[i] - pixels.x[i], y[i] - pixels.y[i]), 2e-8);
        }
}

TEST(Observation, PositionsWithoutAnAnswer) {
    const Observation observation = observe("roman-c9", {10, 20});
    const TanSip &wcs = observation.wcs(1);
    const double ra[] = {nan, 10, infinity, 190, 10, 10, 2e6, 100, 10.05 + 3600};
    const double dec[] = {20, nan, 20, -20, 91, -infinity, 20, 20, 20};
    double x[9], y[9];
    EXPECT_EQ(wcs.to_pixel(9, ra, dec, x, y), 8);
    for (int i = 0; i < 8; ++i)
        EXPECT_TRUE(std::isnan(x[i]) && std::isnan(y[i])) << i;
    EXPECT_TRUE(std::isfinite(x[8]));
    int32_t sca[9];
    EXPECT_EQ(observation.find(true, 9, ra, dec, sca, x, y), 1);
    EXPECT_EQ(sca[0], 0);
    EXPECT_GT(sca[8], 0);

    const double far_x[] = {nan, 1e5, -infinity, 0}, far_y[] = {0, 0, 0, 1e300};
    EXPECT_EQ(wcs.to_sky(4, far_x, far_y, x, y), 4);
    EXPECT_TRUE(std::isnan(x[3]));
    EXPECT_TRUE(std::isnan(wcs.jacobian(nan, 0).area_arcsec2()));
    EXPECT_EQ(wcs.to_sky(0, nullptr, nullptr, nullptr, nullptr), 0);
}

TEST(Observation, EveryPixelIsFoundOnItsDetector) {
    for (const char *name : names)
        for (const SkyPosition &at : pointings) {
            const Observation observation = observe(name, at);
            for (int sca = 1; sca <= 18; ++sca) {
                const double x[] = {-0.4999, 4087.4999, 2000, -0.5001, 4087.5001};
                const double y[] = {-0.4999, 4087.4999, 10, 2000, 2000};
                double ra[5], dec[5], found_x[5], found_y[5];
                int32_t on[5];
                observation.wcs(sca).to_sky(5, x, y, ra, dec);
                EXPECT_EQ(observation.find(false, 5, ra, dec, on, found_x, found_y), 3);
                for (int i = 0; i < 5; ++i)
                    EXPECT_EQ(on[i], i < 3 ? sca : 0);
                EXPECT_NEAR(found_x[2], 2000, 1e-8);
                EXPECT_TRUE(std::isnan(found_y[4]));
                // Outer detectors have no gap on their outer side.
                EXPECT_GE(observation.find(true, 5, ra, dec, on, nullptr, nullptr), 4);
            }
        }
}

TEST(Observation, JacobiansAreSlopes) {
    constexpr double h = 0.5;
    for (const char *name : names)
        for (const SkyPosition &at : pointings) {
            const TanSip wcs = observe(name, at).wcs(8);
            const double x = 100, y = 3000;
            const double xs[] = {x + h, x - h, x, x, x}, ys[] = {y, y, y + h, y - h, y};
            double ra[5], dec[5];
            wcs.to_sky(5, xs, ys, ra, dec);
            const SkyFrame local({ra[4], dec[4]});
            const auto slope = [&](int plus, int minus, const Vector &along) {
                return (dot(direction({ra[plus], dec[plus]}), along) -
                        dot(direction({ra[minus], dec[minus]}), along)) /
                       (2 * h) / degree * 3600;
            };
            const PixelJacobian j = wcs.jacobian(x, y);
            EXPECT_NEAR(j.east_x, slope(0, 1, local.east), 1e-9);
            EXPECT_NEAR(j.north_x, slope(0, 1, local.north), 1e-9);
            EXPECT_NEAR(j.east_y, slope(2, 3, local.east), 1e-9);
            EXPECT_NEAR(j.north_y, slope(2, 3, local.north), 1e-9);
            EXPECT_NEAR(std::sqrt(j.area_arcsec2()), 0.11, 0.004);
        }
}

// The detectors' tabled linear terms tell the field's distortion independently of what is inside a
// detector: carried on to the next one's middle, a detector's WCS must meet that one's pixel area.
// Without the distortion inside, it is off by the whole step between them.
double worst_step(const char *name, bool as_galsim) {
    const Observation observation = observe(name, {10, 0}, as_galsim);
    double worst = 0;
    for (int sca = 1; sca <= 18; ++sca) {
        if (sca % 3 == 0)
            continue; // the next one is in another column
        const TanSip &own = observation.wcs(sca), &next = observation.wcs(sca + 1);
        double x = 0, y = 0;
        own.to_pixel(1, &next.reference().ra_deg, &next.reference().dec_deg, &x, &y);
        const double there = own.jacobian(x, y).area_arcsec2();
        const double truth = next.jacobian(2043, 2043).area_arcsec2();
        worst = std::max(worst, std::abs(there / truth - 1));
    }
    return worst;
}

TEST(Observation, DistortionInsideDetectorsMeetsTheNextDetector) {
    EXPECT_LT(worst_step("wfirst-afta-c5", false), 1e-3);
    EXPECT_GT(worst_step("wfirst-afta-c5", true), 0.02);
    EXPECT_LT(worst_step("roman-c9", false), 4e-3);
    EXPECT_GT(worst_step("roman-c9", true), 0.03);
}

// C5's optics say where a point of the focal plane is on the sky.
struct Plane {
    double x, y;
};
Plane optics(double x_mm, double y_mm) {
    const double fx = std::atan(x_mm / 18500) / degree, fy = std::atan(y_mm / 18500) / degree;
    const double r = std::hypot(fx, fy);
    const double scale = 1 - 0.014976 + 0.0037053 * r + 0.030186 * r * r;
    return {fx / scale, fy / scale};
}

// How far a detector's corners are from there, seen from its reference pixel.
double worst_corner_pix(bool as_galsim) {
    const Instrument &c5 = Instrument::get("wfirst-afta-c5");
    const Observation observation(c5, {0, 0}, 0, {.as_galsim = as_galsim, .angle_is_of_fpa = true});
    double worst = 0;
    for (int sca = 1; sca <= 18; ++sca) {
        const DetectorWcs &detector = c5.wcs->detectors[static_cast<size_t>(sca - 1)];
        const double x0 = detector.east_mm, y0 = detector.north_mm + 199.25;
        const Plane middle = optics(x0, y0);
        for (const double x : {0.0, 4087.0})
            for (const double y : {0.0, 4087.0}) {
                const Plane corner = optics(x0 - (x - 2043) / 100, y0 + (y - 2043) / 100);
                const TanSip &wcs = observation.wcs(sca);
                double ra = 0, dec = 0;
                wcs.to_sky(1, &x, &y, &ra, &dec);
                const Vector at = direction({ra, dec}), from = direction(wcs.reference());
                // Gnomonic, about the pointing.
                const double east = (at[1] / at[0] - from[1] / from[0]) / degree;
                const double north = (at[2] / at[0] - from[2] / from[0]) / degree;
                worst = std::max(
                    worst, std::hypot(east - (corner.x - middle.x), north - (corner.y - middle.y)) *
                               3600 / 0.11);
            }
    }
    return worst;
}

TEST(Observation, CornersAreWhereC5sOpticsHaveThem) {
    EXPECT_LT(worst_corner_pix(false), 1.3); // the tabled linear terms and the optics differ
    EXPECT_GT(worst_corner_pix(true), 15);
}

TEST(Observation, IsAimedAtAPlace) {
    for (const char *name : names)
        for (const double dec : {-85.0, 0.0, 60.0, 88.0}) {
            const SkyPosition target{0.01, dec};
            const Observation observation =
                Observation::aimed(Instrument::get(name), 18, 4087, 0, target, 123, {});
            double ra = 0, there = 0;
            const double x = 4087, y = 0;
            observation.wcs(18).to_sky(1, &x, &y, &ra, &there);
            EXPECT_LT(apart_arcsec(ra, there, target.ra_deg, target.dec_deg), 1e-8);
            EXPECT_NEAR(observation.observatory_angle_deg(), 123, 1e-12);
        }
}

template <class Body> wfpsf_status status_of(Body &&body) {
    try {
        body();
    } catch (const Error &error) {
        return error.status();
    }
    return WFPSF_OK;
}

TEST(Observation, RefusesWhatItCannotDo) {
    const Instrument &roman = Instrument::get("roman-c9");
    EXPECT_EQ(status_of([&] { Observation(roman, {nan, 0}, 0, {}); }), WFPSF_ERROR_NOT_FINITE);
    EXPECT_EQ(status_of([&] { Observation(roman, {0, 90.0001}, 0, {}); }), WFPSF_ERROR_RANGE);
    EXPECT_EQ(status_of([&] { Observation(roman, {0, 0}, infinity, {}); }), WFPSF_ERROR_NOT_FINITE);
    EXPECT_EQ(status_of([&] {
                  Observation::aimed(roman, 1, 1e6, 0, {0, 0}, 0, {});
              }),
              WFPSF_ERROR_RANGE);
    EXPECT_EQ(status_of([&] { observe("roman-c9", {0, 0}).wcs(19); }), WFPSF_ERROR_RANGE);
    Design design;
    design.set_telescope(1, 0, 1000);
    design.set_detector(1, 0.1, {100, 100});
    EXPECT_EQ(status_of([&] {
                  Observation(*design.instrument(), {0, 0}, 0, {});
              }),
              WFPSF_ERROR_NO_WCS);
}

} // namespace
} // namespace wfpsf
