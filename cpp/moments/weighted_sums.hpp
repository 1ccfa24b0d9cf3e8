// SPDX-License-Identifier: GPL-3.0-or-later
// One pass over the pixels under a Gaussian weight: the sums that every moment is made of.
#pragma once

#include "image/view.hpp"
#include "moments/gaussian.hpp"

namespace wfpsf {

struct WeightedSums {
    // sum[j][k] = sum of I w t^j v^k over the pixels visited, j + k <= order, (t, v) whitened.
    double sum[9][9] = {};
    int64_t pixels = 0;
    double rim = 0; // mean |I| where the reach, not the image's border, ends a row

    double mean(int j, int k) const { return sum[j][k] / sum[0][0]; }
};

// Sums over the pixels with rho^2 <= reach2 of every stride-th column and row (from 0), times
// stride^2, up to the order 2, 4, 6 or 8. Sums are in double and not finite if a visited pixel is
// not. Centred coordinates throughout: nothing is lost at large x, y.
template <class T>
WeightedSums weighted_sums(View<const T> image, const Gaussian &weight, double reach2,
                           int64_t stride = 1, int order = 4);

// The same for sums of w^2: sum[j][k] = sum of w^2 t^j v^k over the pixels with a count of 1.
template <class T>
WeightedSums squared_weight_sums(View<const T> count, const Gaussian &weight, double reach2,
                                 int64_t stride = 1, int order = 4);

// The columns [first, last] of row y within reach; first > last if there are none.
struct Span {
    int64_t first = 0, last = -1;
};
Span columns_within(const Gaussian &weight, double reach2, int64_t nx, int64_t y);
Span rows_within(const Gaussian &weight, double reach2, int64_t ny);

} // namespace wfpsf
