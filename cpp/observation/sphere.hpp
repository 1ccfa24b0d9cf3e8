// SPDX-License-Identifier: GPL-3.0-or-later
// Directions on the sky, and the frame of east and north at one of them.
#pragma once

#include <array>

namespace wfpsf {

using Vector = std::array<double, 3>; // axes: RA 0, RA 90, the north pole

inline double dot(const Vector &a, const Vector &b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector &a, const Vector &b);

// Degrees; RA 0..360. Compared by their fields.
struct SkyPosition {
    double ra_deg, dec_deg;
};

Vector direction(const SkyPosition &position);
SkyPosition position_of(const Vector &direction); // of any length
double angle_deg(const Vector &a, const Vector &b);

// At a pole, east and north are those of the meridian that the RA names.
struct SkyFrame {
    explicit SkyFrame(const SkyPosition &position);

    // Of a place in the tangent plane, degrees; its length is not 1.
    Vector tangent(double east_deg, double north_deg) const;
    // Position angle, east of north, of a direction as seen from the frame's.
    double position_angle_deg(const Vector &of) const;

    Vector centre, east, north;
};

// Into 0..360; and into -180..180.
double full_turn(double degrees);
double half_turn(double degrees);

} // namespace wfpsf
