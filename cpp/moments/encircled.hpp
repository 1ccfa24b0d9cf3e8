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

// error_estimate: the difference from a second evaluation (other nodes, a finer filter), which also
// shows content above the bandwidth, plus what samples as bright as the border's could add if they
// went on beyond it. (Samples beyond the border count as zero.)
struct EncircledEnergy {
    double energy = 0;  // inside the radius, in the units of the samples' sum
    double density = 0; // its derivative by the radius
    double error_estimate = 0;
};

struct EncircledRadius {
    double radius = 0;  // pixels
    double density = 0; // derivative of the energy by the radius, there
    double error_estimate = 0;
    int iterations = 0;
};

// Throws Error: SIZE_NOT_REACHED if the circle leaves the image (passes its outermost samples),
// NOT_FINITE if a sample in or near the circle is not finite, RANGE on bad options.
template <class T>
EncircledEnergy encircled_energy(View<const T> image, double x, double y, double radius,
                                 const EncircledOptions &options = {});

// The radius of the circle around (x, y) that holds `fraction` of `total` (EE50: one half), to
// 1e-12 of itself if the image allows. For an image with negative parts this is one such radius.
template <class T>
EncircledRadius encircled_radius(View<const T> image, double x, double y, double fraction,
                                 double total, const EncircledOptions &options = {});

// The mean of the image on the circle: its radial profile. Throws as encircled_energy().
template <class T>
double ring_mean(View<const T> image, double x, double y, double radius,
                 const EncircledOptions &options = {});

// Twice the smallest radius at which that profile falls to half of its centre. Throws as
// encircled_radius(), MOMENTS_FLUX if the centre is not positive.
template <class T>
double profile_fwhm(View<const T> image, double x, double y, const EncircledOptions &options = {});

} // namespace wfpsf
