// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of I w dx^j dy^k under a weight that does not move, and the moments they make. The sums are
// linear in the image, so its moments' derivatives are closed forms.
#pragma once

#include "image/view.hpp"
#include "moments/gaussian.hpp"
#include "moments/moment_set.hpp"

#include <array>
#include <optional>

namespace wfpsf {

// (j, k) = (0,0), (1,0), (0,1), (2,0), (1,1), (0,2), (3,0), ..., (0,4).
using PixelSums = std::array<double, 15>;

// About (weight.x, weight.y), with the weight exp(-rho^2/2), or about (x, y) without a weight. Sums
// without a weight are compensated. Sums are not finite if a pixel that counts is not.
template <class T> PixelSums pixel_sums(View<const T> image, const Gaussian &weight);
template <class T> PixelSums pixel_sums(View<const T> image, double x, double y);

// What second moments are about, and what stands for the centroid.
enum class Centre {
    point,   // the point of the sums, for both
    mean,    // the mean, for both
    weighted // second moments about the point, which is the weight's centre; the centroid is the
             // mean
};

// Moments from the first six sums about (x, y).
MomentSet<HyperDual> moments_of_sums(const std::array<HyperDual, 6> &sums, double x, double y,
                                     Centre centre);

// dq/dI at every pixel, if k_i is the derivative of q by the i-th of the first six sums.
void influence_image(const std::optional<Gaussian> &weight, double x, double y,
                     const std::array<double, 6> &k, View<double> out);

} // namespace wfpsf
