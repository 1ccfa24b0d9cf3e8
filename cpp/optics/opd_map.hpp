// SPDX-License-Identifier: GPL-3.0-or-later
// A map of optical path differences as a smooth function: the bicubic spline that meets all samples
// and has no knot next to the border (de Boor, A Practical Guide to Splines, ch. IV), so that its
// error falls as the fourth power of the sampling right up to the border.
#pragma once

#include "image/view.hpp"

namespace wfpsf {

class OpdMap {
  public:
    static constexpr int64_t smallest_side = 4, largest_side = 8192;

    static constexpr double largest_value = 1e-3; // metres: nanometres by mistake are found out

    // Samples in metres, `scale` metres apart; sample position (axis_x, axis_y) is the optical
    // axis. NaN and infinity: WFPSF_ERROR_NOT_FINITE. A side too short or long: WFPSF_ERROR_SIZE.
    // Values too large: WFPSF_ERROR_RANGE.
    OpdMap(View<const double> map, double scale, double axis_x, double axis_y);

    // Metres, at a position in metres from the optical axis. Beyond the outermost samples' centres:
    // the value at the nearest point of the border.
    double operator()(double x, double y) const;

    // Never below the steepest slope on the disc of that radius about the axis.
    double slope_bound(double radius) const;

  private:
    // coefficient(i + 1, j + 1) multiplies the B-spline centred on sample (i, j).
    Plane<double> coefficient_;
    double scale_, axis_x_, axis_y_;
};

} // namespace wfpsf
