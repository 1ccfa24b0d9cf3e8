// SPDX-License-Identifier: GPL-3.0-or-later
// The merit function whose stationary points are the adaptive moments:
//   phi = ln(sum of I w) - ln(det M)/4.
// Maximising it over x0, M is minimising Eq. 17 of Kannawadi et al. 2016 with the amplitude
// eliminated, if the sum of w^2 over the pixels is replaced by its integral pi sqrt(det M).
#pragma once

#include "moments/weighted_sums.hpp"

namespace wfpsf {

// Value and derivatives by the five components (t, v, htt, hs, hvv) of a WhitenedStep, at zero
// step. On a Gaussian image the Hessian is -diag(1/2, 1/2, 1/8, 1/8, 1/8) at the solution.
struct Merit {
    double value;
    double gradient[5];
    double hessian[5][5];
};

// sums.sum[0][0] must be positive.
Merit merit(const WeightedSums &sums, const Gaussian &weight);

} // namespace wfpsf
