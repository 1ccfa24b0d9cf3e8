// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of a band-limited image at other places than its own: two passes, one along each axis.
#pragma once

#include "image/view.hpp"
#include "numerics/bandlimited.hpp"
#include "optics/blur.hpp"

#include <vector>

namespace wfpsf {

// Equally spaced places in grid samples: start + i numerator / denominator, i =
// first..first+count-1. A part of a range gives the same bits as the whole.
struct Positions {
    double start;
    int64_t first, count, numerator, denominator;
};

// out(i, j) = scale * grid at the i-th place along x and the j-th along y. Every place must lie at
// least interpolator.half_width() samples inside the grid.
template <class T>
void resample(View<const double> grid, const BandlimitedInterpolator &interpolator,
              const Positions &x, const Positions &y, double scale, View<T> out);

// The grid filtered along both axes; smaller by the filter's half width on each side.
Plane<double> filtered(View<const double> grid, const SeparableFilter &filter);

} // namespace wfpsf
