// SPDX-License-Identifier: GPL-3.0-or-later
// How the moments of an image answer to its pixels, by implicit differentiation: the moments p are
// where a gradient vanishes, g(p, I) = 0, so dp = -(dg/dp)^-1 dg/dI dI.
#pragma once

#include "moments/adaptive.hpp"
#include "moments/moment_set.hpp"

#include <array>
#include <iterator>
#include <memory>

namespace wfpsf {

// A small change of an image, by what it adds to the sums that moments are made of: to those of
// I w t^j v^k in whitened coordinates, in the order of sum_orders, and to the mean of the pixels
// that are seen, if a background is fitted: the sums then are those of the pixels less their mean.
inline constexpr size_t mean_sum = 15, change_sums = 16;
struct SumOrder {
    int j, k;
};
inline constexpr SumOrder sum_orders[mean_sum] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1},
                                                  {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3},
                                                  {4, 0}, {3, 1}, {2, 2}, {1, 3}, {0, 4}};
// First derivatives answer to these; second ones to all.
inline constexpr size_t first_sums[] = {0, 1, 2, 3, 4, 5, mean_sum};

struct ImageChange {
    WeightedSums sums;
    double mean = 0;
};

class Sensitivity {
  public:
    // At a solution of adaptive_moments(), with the same image, options and missing pixels. Second
    // derivatives take longer sums.
    template <class T>
    Sensitivity(View<const T> image, const AdaptiveMoments &solution,
                const AdaptiveOptions &options, View<const float> missing = {},
                bool second = false);
    ~Sensitivity();
    Sensitivity(Sensitivity &&) noexcept;
    Sensitivity &operator=(Sensitivity &&) noexcept;

    // Of a change that has the image's shape. Missing pixels count as zero.
    template <class T> ImageChange change_of(View<const T> change) const;
    // That which adds one to one sum.
    static ImageChange unit_change(size_t sum);

    // Every quantity with its derivatives as I + a A + b B departs from I: along A, along B, and
    // the mixed second one (0 unless second derivatives were asked for).
    MomentSet<HyperDual> along(const ImageChange &a, const ImageChange &b) const;

    // The derivatives of all quantities by first_sums.
    using Slopes = std::array<std::array<double, std::size(first_sums)>, quantities>;
    Slopes slopes() const;

    // The covariance of the sums, if pixels have independent noise of these variances, of those
    // of first_sums or, for second derivatives, of all. `variance` may repeat one number, with
    // strides of zero. Throws Error if one is negative or not finite.
    using SumCovariance = std::array<std::array<double, change_sums>, change_sums>;
    template <class T> SumCovariance noise(View<const T> variance) const;

    // Adds coefficients[i] times the derivative of the sum first_sums[i] by every pixel.
    void add_influence(const std::array<double, std::size(first_sums)> &coefficients,
                       View<double> out) const;

  private:
    struct Solution;
    std::unique_ptr<const Solution> solution_;
    View<const float> missing_;
};

} // namespace wfpsf
