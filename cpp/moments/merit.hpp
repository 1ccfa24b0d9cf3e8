// SPDX-License-Identifier: GPL-3.0-or-later
// The merit function whose maxima are the adaptive moments:
//   phi = ln(sum of I w) - ln(Q)/2,
// where Q is the sum of w^2. Maximising it over x0, M is minimising Eq. 17 of Kannawadi et al.
// 2016, the squared difference of image and A w, with the amplitude A eliminated.
#pragma once

#include "moments/weighted_sums.hpp"

namespace wfpsf {

// A function of the weight, and its derivatives by the five components (t, v, htt, hs, hvv) of a
// WhitenedStep, at zero step.
struct Merit {
    double value = 0;
    double gradient[5] = {};
    double hessian[5][5] = {};
};

// The sum of f w^n and its derivatives, from that sum's moments up to the fourth.
Merit power_sum(const WeightedSums &sums, int n);

// pi sqrt(det M), the integral of w^2 over the plane.
Merit plane_norm(const Gaussian &weight);

Merit operator-(const Merit &a, const Merit &b);
Merit operator*(const Merit &f, double factor);
Merit square(const Merit &f);
Merit log(const Merit &f);

// phi for a given Q. sum of I w and Q must be positive.
Merit merit(const WeightedSums &sums, const Merit &norm);

// phi with the integral for Q. On a Gaussian image the Hessian is -diag(1/2, 1/2, 1/8, 1/8, 1/8) at
// the solution.
inline Merit merit(const WeightedSums &sums, const Gaussian &weight) {
    return merit(sums, plane_norm(weight));
}

} // namespace wfpsf
