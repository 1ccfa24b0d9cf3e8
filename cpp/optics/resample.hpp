// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of a band-limited image at other places than its own: two passes, one along each axis.
#pragma once

#include "image/view.hpp"
#include "numerics/bandlimited.hpp"
#include "optics/blur.hpp"

#include <memory>
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

// The samples of images that lie about the middle of a grid, as polynomials of where they lie: sample
// (i, j) is that of the grid (i - dx, j - dy) numerator / denominator from its middle,
// |dx|, |dy| <= 1/2.
class ShiftedImage {
  public:
    static constexpr int largest_degree = 15;

    // For |i|, |j| <= half, so that all places lie interpolator.half_width() samples inside the grid.
    ShiftedImage(View<const double> grid, const BandlimitedInterpolator &interpolator,
                 int64_t numerator, int64_t denominator, int64_t half);
    ~ShiftedImage();

    // What Chebyshev's T_a(2 dx) T_b(2 dy) count in the samples within `half` of the middle. Those
    // of one b after another, the widest first, take the least time.
    Plane<double> coefficients(int a, int b, int64_t half);

  private:
    struct Tables;
    std::unique_ptr<Tables> tables_;
};

// The grid filtered along both axes; smaller by the filter's half width on each side.
Plane<double> filtered(View<const double> grid, const SeparableFilter &filter);

} // namespace wfpsf
