// SPDX-License-Identifier: GPL-3.0-or-later
// The covariance of moments that comes of the pixels' noise.
#pragma once

#include "moments/sensitivity.hpp"

#include <array>

namespace wfpsf {

using MomentsCovariance = std::array<std::array<double, quantities>, quantities>;

// At a solution of adaptive_moments(), with the same image, options and missing pixels, if pixels
// have independent normal noise of these variances. At the first order, moments answer linearly to
// noise; the second has all terms of the next order, noise^4. Where the expansion fails, because
// the noise of a quantity is as large as the quantity, it is NaN. Throws Error as
// Sensitivity::noise().
template <class T, class V>
MomentsCovariance covariance(View<const T> image, const AdaptiveMoments &solution,
                             const AdaptiveOptions &options, View<const float> missing,
                             View<const V> variance, int order);

} // namespace wfpsf
