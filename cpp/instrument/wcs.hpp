// SPDX-License-Identifier: GPL-3.0-or-later
// Where the detectors of an instrument are on the sky. At position angle 0 of the focal plane, u and
// "east" count towards the west and the east, v and "north" towards the north.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

namespace wfpsf {

// The powers (p, q) of dx^p dy^q in terms of order 2 to 4, as they stand in tables.
inline constexpr std::array<std::pair<int, int>, 12> sip_powers = {{{2, 0},
                                                                    {1, 1},
                                                                    {0, 2},
                                                                    {3, 0},
                                                                    {2, 1},
                                                                    {1, 2},
                                                                    {0, 3},
                                                                    {4, 0},
                                                                    {3, 1},
                                                                    {2, 2},
                                                                    {1, 3},
                                                                    {0, 4}}};
using SipTerms = std::array<double, sip_powers.size()>;

struct PixelBounds {
    int64_t x_first, x_last, y_first, y_last; // both ends belong to it
};

struct DetectorWcs {
    double u_deg, v_deg;          // of the reference pixel, from the centre of the focal plane, on
                                  // the sky's tangent plane there
    double east_mm, north_mm;     // the same on the focal plane itself
    std::array<double, 4> linear; // degrees per pixel: east by x, east by y, north by x, north by y
    SipTerms a, b;                // higher orders as the simulators use them, pixels
    PixelBounds with_gaps;        // the detector and its halves of the gaps around it
};

// A place on the sky of a place on the focal plane: degrees to the east and to the north are sums of
// east X^p Y^q and north X^p Y^q, with X and Y in units of 100 mm to the east and to the north.
struct DistortionTerm {
    int p, q;
    double east, north;
};

struct WcsTables {
    static constexpr double reference_pixel = 2043; // along both axes, the first pixel at 0
    static constexpr double pixel_mm = 0.01;

    double fpa_angle_deg; // position angle of the focal plane less that of the observatory
    std::span<const DetectorWcs> detectors; // by SCA
    std::span<const DistortionTerm> distortion;
    bool cuts_to_integers; // the simulator cuts positions to integers before it asks whether they
                           // are on a detector
};

} // namespace wfpsf
