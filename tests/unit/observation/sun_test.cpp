// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "observation/sun.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace wfpsf {
namespace {

TEST(Sun, DatesAreJulian) {
    EXPECT_EQ(julian_date(2000, 1, 1, 12, 0, 0), 2451545);
    EXPECT_NEAR(julian_date(2026, 9, 1, 6, 30, 15), 2461284.5 + 6.5 / 24 + 15 / 86400.0, 1e-9);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(julian_date(2026, 13, 1, 0, 0, 0), Error);
    EXPECT_THROW(julian_date(2026, 2, 30, 0, 0, 0), Error);
    EXPECT_THROW(julian_date(2026, 1, 1, 0, 0, nan), Error);
    EXPECT_THROW(julian_date(1700, 1, 1, 0, 0, 0), Error);
    EXPECT_THROW(sun_position(nan, SunRule::precise), Error);
    EXPECT_THROW(sun_position(0, SunRule::galsim), Error);
}

// The equinox of March 2026 is at 14:46 UTC, in the equinox of date: precession since J2000, 6.4
// arcsec of nutation and 20.5 of aberration are in between.
TEST(Sun, EquinoxOf2026) {
    const SkyPosition sun = sun_position(julian_date(2026, 3, 20, 14, 46, 0), SunRule::precise);
    const double longitude = -50.29 / 3600 * 26.22 + (20.5 - 6.4) / 3600;
    EXPECT_NEAR(std::remainder(sun.ra_deg, 360), longitude * std::cos(0.409093), 1e-3);
    EXPECT_NEAR(sun.dec_deg, longitude * std::sin(0.409093), 1e-3);
}

// +Y = Z x X from vectors, with Z sunward in the plane of the sky.
TEST(Sun, RollFollowsFromVectors) {
    const Instrument &roman = Instrument::get("roman-c9");
    const double date = julian_date(2027, 6, 1, 0, 0, 0);
    const Vector sun = direction(sun_position(date, SunRule::precise));
    int tried = 0;
    for (double ra = 0; ra < 360; ra += 17)
        for (double dec = -90; dec <= 90; dec += 15) {
            const SkyPosition at{ra, dec};
            if (!check_pointing(roman, at, date, SunRule::precise).allowed) {
                EXPECT_THROW(best_position_angle(roman, at, date, SunRule::precise), Error);
                continue;
            }
            ++tried;
            const SkyFrame frame(at);
            Vector z{};
            for (size_t i = 0; i < 3; ++i)
                z[i] = sun[i] - dot(sun, frame.centre) * frame.centre[i];
            const double angle = frame.position_angle_deg(cross(z, frame.centre));
            EXPECT_NEAR(
                std::remainder(best_position_angle(roman, at, date, SunRule::precise) - angle, 360),
                0, 1e-10);
        }
    EXPECT_GT(tried, 100);
}

} // namespace
} // namespace wfpsf
