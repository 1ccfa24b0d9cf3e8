// SPDX-License-Identifier: GPL-3.0-or-later
// Cubic B-splines through equally spaced samples (Unser, Aldroubi & Eden 1993, IEEE Trans. Signal
// Process. 41, 821): four taps along an axis; a wave of f cycles a sample is off by at most 5 f^4.
#pragma once

#include "image/view.hpp"

#include <array>

namespace wfpsf {

// Samples, 16 or more along each axis, become the coefficients of the spline through them; beyond
// the borders they are mirrored.
void to_spline_coefficients(Plane<float> &samples);

// The samples again.
void to_spline_samples(Plane<float> &coefficients);

// Coefficients of the same spline as one of twice as many samples.
Plane<float> refined_spline(const Plane<float> &coefficients);

// Of coefficients -1, 0, 1, 2 at t of 0..1.
inline std::array<double, 4> spline_weights(double t) {
    const double s = 1 - t;
    return {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6,
            t * t * t / 6};
}

} // namespace wfpsf
