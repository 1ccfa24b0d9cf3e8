// SPDX-License-Identifier: GPL-3.0-or-later
// The world coordinates of one detector: TAN-SIP of the FITS standard. Pixels count from the first
// one's centre at (0, 0), the sky's angles are degrees.
//
//     (f, g)     = (dx, dy) + sums of (a, b) dx^p dy^q, p + q = 2 to 4, from the reference pixel on
//     (xi, eta)  = cd (f, g), to the east and to the north in the tangent plane at `reference`
//
// What has no answer is NaN: numbers that are not finite, |RA| > 1e6, |Dec| > 90, pixels outside
// `domain`, and places on the sky that are in none of its pixels.
#pragma once

#include "instrument/wcs.hpp"
#include "observation/sphere.hpp"

#include <array>
#include <cstdint>

namespace wfpsf {

// How directions on the sky change with pixels, arcsec per pixel.
struct PixelJacobian {
    double east_x, east_y, north_x, north_y;

    double area_arcsec2() const;
    double y_position_angle_deg() const; // of the y axis, east of north, -180..180
};

class TanSip {
  public:
    struct Domain {
        double x_first, x_last, y_first, y_last;
    };

    TanSip(const SkyPosition &reference, const std::array<double, 4> &cd, const SipTerms &a,
           const SipTerms &b, const Domain &domain);

    // Element by element; outputs may be the inputs. Return how many have no answer.
    int64_t to_pixel(int64_t count, const double *ra_deg, const double *dec_deg, double *x,
                     double *y) const;
    int64_t to_sky(int64_t count, const double *x, const double *y, double *ra_deg,
                   double *dec_deg) const;

    // On the sphere, not in the tangent plane. NaN like positions.
    PixelJacobian jacobian(double x, double y) const;

    const SkyPosition &reference() const { return reference_; }
    const SkyFrame &frame() const { return frame_; }
    const std::array<double, 4> &cd() const { return cd_; }
    const SipTerms &a() const { return a_; }
    const SipTerms &b() const { return b_; }

  private:
    SkyPosition reference_;
    SkyFrame frame_;
    std::array<double, 4> cd_, inverse_; // degrees per pixel and back, row by row
    SipTerms a_, b_;
    Domain domain_;
};

} // namespace wfpsf
