// SPDX-License-Identifier: GPL-3.0-or-later
// Encircled energy of a band-limited image: the integral over a circle of the function that the
// samples stand for, not a sum of samples.
#pragma once

#include "image/view.hpp"

namespace wfpsf {

struct EncircledOptions {
    // The image has no content at spatial frequencies above this, in any direction; cycles per
    // sample, above 0 and below 1/2. 1/4 is sampling at twice the Nyquist rate.
    double bandwidth = 0.25;
    // Error asked for, per sample, in units of the largest sample.
    double eps = 1e-12;
};

// What a circle around (x, y) holds. Errors are the differences from a second evaluation (other
// nodes, a finer filter), which also show content above the bandwidth, plus what samples as bright
// as the border's could add if they went on beyond it. (Samples beyond the border count as zero.)
struct DiscLight {
    double energy = 0;  // inside, in the units of the samples' sum
    double density = 0; // its derivative by the radius: the integral along the circle
    double slope = 0;   // the second one
    double energy_error = 0, density_error = 0, slope_error = 0;
};

// Throws Error: SIZE_NOT_REACHED if the circle leaves the image (passes its outermost samples),
// NOT_FINITE if a sample in or near the circle is not finite, RANGE on bad options.
template <class T>
DiscLight disc_light(View<const T> image, double x, double y, double radius,
                     const EncircledOptions &options = {});

// A length, pixels, or a mean.
struct Estimated {
    double value = 0, error_estimate = 0;
};

// The radius of the circle around (x, y) that holds `fraction` of `total` (EE50: one half), to
// 1e-12 of itself if the image allows. For an image with negative parts this is one such radius.
template <class T>
Estimated encircled_radius(View<const T> image, double x, double y, double fraction, double total,
                           const EncircledOptions &options = {});

// Derivatives of the radius R along a change A of the image, and the mixed one along A and B, by
// implicit differentiation of energy(R) = held, which is linear in the image: each with what is on
// its disc of radius R, and with the light that the circle is to hold.
struct HeldChange {
    DiscLight disc;
    double held = 0; // fraction times the change of the total
};
Estimated radius_slope(const Estimated &radius, const DiscLight &image, const HeldChange &a);
Estimated radius_curvature(const Estimated &radius, const DiscLight &image, const HeldChange &a,
                           const HeldChange &b, const EncircledOptions &options = {});

// The mean of the image on the circle: its radial profile. Throws as disc_light().
template <class T>
Estimated ring_mean(View<const T> image, double x, double y, double radius,
                    const EncircledOptions &options = {});

// Twice the smallest radius at which that profile falls to half of its centre. Throws as
// encircled_radius(), MOMENTS_FLUX if the centre is not positive.
template <class T>
Estimated profile_fwhm(View<const T> image, double x, double y,
                       const EncircledOptions &options = {});

} // namespace wfpsf
