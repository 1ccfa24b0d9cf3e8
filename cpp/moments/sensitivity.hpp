// SPDX-License-Identifier: GPL-3.0-or-later
// How the moments of an image answer to its pixels, by implicit differentiation: the moments p are
// where a gradient vanishes, g(p, I) = 0, so dp = -(dg/dp)^-1 dg/dI dI.
#pragma once

#include "moments/adaptive.hpp"
#include "moments/moment_set.hpp"

#include <array>
#include <memory>

namespace wfpsf {

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

    // The sums of a change of the image, which has its shape. Missing pixels count as zero.
    template <class T> WeightedSums sums_of(View<const T> change) const;

    // Every quantity with its derivatives as I + a A + b B departs from I: along A, along B, and
    // the mixed second one (0 unless second derivatives were asked for).
    MomentSet<HyperDual> along(const WeightedSums &a, const WeightedSums &b) const;

    // The influence function of a quantity q is dq/dI(x, y) = w (k0 + k1 t + k2 v + k3 t^2/2 +
    // k4 t v/sqrt(2) + k5 v^2/2) in whitened coordinates: this is q with its derivative k_i along
    // the sum of I w times the i-th of these six functions.
    MomentSet<HyperDual> by_sum(int i) const;

    // The covariance of the six sums, if pixels have independent noise of these variances;
    // `variance` may repeat one number, with strides of zero. Throws Error if one is negative or
    // not finite.
    template <class T> std::array<std::array<double, 6>, 6> noise(View<const T> variance) const;

  private:
    struct Solution;
    std::unique_ptr<const Solution> solution_;
    View<const float> missing_;
};

// Where `missing` is not zero an influence function is zero.
void influence_image(const Gaussian &weight, const std::array<double, 6> &coefficients,
                     View<const float> missing, View<double> out);

} // namespace wfpsf
