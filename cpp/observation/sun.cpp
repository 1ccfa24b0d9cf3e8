// SPDX-License-Identifier: GPL-3.0-or-later
#include "observation/sun.hpp"

#include "error/error.hpp"

#include <cmath>
#include <erfa.h>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double epoch_2000 = 2451545;

void check_date(double date) {
    constexpr double first = 2415020.5, last = 2488069.5; // 1900-01-01, 2100-01-01
    if (!std::isfinite(date))
        fail(WFPSF_ERROR_NOT_FINITE, "julian_date = %g: must be finite", date);
    if (!(date >= first && date <= last))
        fail(WFPSF_ERROR_RANGE, "julian_date = %.9g: must be %.9g..%.9g, the years 1900 to 2100",
             date, first, last);
}

// From the Earth, without the 20 arcsec of aberration.
Vector precise_sun(double date) {
    double tai[2], tt[2], heliocentric[2][3], barycentric[2][3];
    // The status says no more than that leap seconds of years to come are not known.
    eraUtctai(date, 0, &tai[0], &tai[1]);
    eraTaitt(tai[0], tai[1], &tt[0], &tt[1]);
    eraEpv00(tt[0], tt[1], heliocentric, barycentric);
    return {-heliocentric[0][0], -heliocentric[0][1], -heliocentric[0][2]};
}

// As the celestial coordinates of GalSim 2.8.4 have it: a low-precision longitude, and the
// obliquity at the beginning of the calendar year.
SkyPosition galsim_sun(double date) {
    const double days = date - epoch_2000;
    const double mean = (280.46 + 0.9856474 * days), anomaly = (357.528 + 0.9856003 * days);
    const double longitude =
        mean + 1.915 * std::sin(anomaly * degree) + 0.020 * std::sin(2 * anomaly * degree);
    int year = 0, month = 0, day = 0;
    double fraction = 0;
    eraJd2cal(date, 0, &year, &month, &day, &fraction);
    const double t = (year - 2000) / 100.0;
    const double obliquity =
        23 + 26 / 60.0 + (21.406 + t * (-46.836769 + t * (-0.0001831 + t * 0.0020034))) / 3600;
    const double cosine = std::cos(longitude * degree), sine = std::sin(longitude * degree);
    return position_of(
        {cosine, sine * std::cos(obliquity * degree), sine * std::sin(obliquity * degree)});
}

} // namespace

double julian_date(int year, int month, int day, int hour, int minute, double second) {
    double first = 0, second_part = 0;
    const int status =
        eraDtf2d("UTC", year, month, day, hour, minute, second, &first, &second_part);
    if (!std::isfinite(second) || status < 0)
        fail(WFPSF_ERROR_RANGE, "date = %d-%d-%d %d:%d:%g: there is no such date", year, month, day,
             hour, minute, second);
    const double date = first + second_part;
    check_date(date);
    return date;
}

SkyPosition sun_position(double date, SunRule rule) {
    check_date(date);
    return rule == SunRule::galsim ? galsim_sun(date) : position_of(precise_sun(date));
}

Pointing check_pointing(const Instrument &instrument, const SkyPosition &line_of_sight, double date,
                        SunRule rule) {
    const double tilt = instrument.constant("max_sun_angle").value;
    const double angle = angle_deg(direction(line_of_sight), direction(sun_position(date, rule)));
    return {angle, std::abs(angle - 90) <= tilt};
}

double best_position_angle(const Instrument &instrument, const SkyPosition &line_of_sight,
                           double date, SunRule rule) {
    const double tilt = instrument.constant("max_sun_angle").value;
    const Pointing pointing = check_pointing(instrument, line_of_sight, date, rule);
    if (!pointing.allowed)
        fail(WFPSF_ERROR_SUN_ANGLE,
             "ra_deg = %g, dec_deg = %g: is %g degrees from the Sun, must be %g..%g",
             line_of_sight.ra_deg, line_of_sight.dec_deg, pointing.sun_angle_deg, 90 - tilt,
             90 + tilt);
    // X is the line of sight, Z points to the Sun's side; Y = Z x X is a quarter turn past Z.
    const SkyFrame frame(line_of_sight);
    const double sun_angle = frame.position_angle_deg(direction(sun_position(date, rule)));
    const double precise = half_turn(sun_angle + 90);
    if (rule == SunRule::precise)
        return precise;
    return half_turn((pointing.sun_angle_deg < 90 ? 0 : 180) - precise);
}

} // namespace wfpsf
