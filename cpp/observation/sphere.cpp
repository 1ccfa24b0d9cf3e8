// SPDX-License-Identifier: GPL-3.0-or-later
#include "observation/sphere.hpp"

#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double degree = std::numbers::pi / 180;

} // namespace

Vector cross(const Vector &a, const Vector &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector direction(const SkyPosition &position) {
    return SkyFrame(position).centre;
}

SkyPosition position_of(const Vector &v) {
    return {full_turn(std::atan2(v[1], v[0]) / degree),
            std::atan2(v[2], std::hypot(v[0], v[1])) / degree};
}

double angle_deg(const Vector &a, const Vector &b) {
    const Vector c = cross(a, b);
    return std::atan2(std::sqrt(dot(c, c)), dot(a, b)) / degree;
}

SkyFrame::SkyFrame(const SkyPosition &position) {
    const double ra = position.ra_deg * degree, dec = position.dec_deg * degree;
    const double cos_ra = std::cos(ra), sin_ra = std::sin(ra);
    const double cos_dec = std::cos(dec), sin_dec = std::sin(dec);
    centre = {cos_dec * cos_ra, cos_dec * sin_ra, sin_dec};
    east = {-sin_ra, cos_ra, 0};
    north = {-sin_dec * cos_ra, -sin_dec * sin_ra, cos_dec};
}

Vector SkyFrame::tangent(double east_deg, double north_deg) const {
    Vector v{};
    for (size_t i = 0; i < 3; ++i)
        v[i] = centre[i] + (east_deg * east[i] + north_deg * north[i]) * degree;
    return v;
}

double SkyFrame::position_angle_deg(const Vector &of) const {
    return std::atan2(dot(of, east), dot(of, north)) / degree;
}

double full_turn(double degrees) {
    const double turned = std::fmod(degrees, 360);
    const double positive = turned < 0 ? turned + 360 : turned;
    return positive == 360 ? 0 : positive; // a tiny negative angle rounds to 360
}

double half_turn(double degrees) {
    return std::remainder(degrees, 360);
}

} // namespace wfpsf
