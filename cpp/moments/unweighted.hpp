// SPDX-License-Identifier: GPL-3.0-or-later
// Unweighted moments of all pixels, with compensated sums.
#pragma once

#include "image/view.hpp"

namespace wfpsf {

struct UnweightedMoments {
    double flux = 0;
    double x = 0, y = 0;              // the point that the second moments are about
    double Mxx = 0, Mxy = 0, Myy = 0; // pixels^2

    // Radii, NaN if the moments have none (negative pixels can do that).
    double radius_det() const;   // det(M)^(1/4)
    double radius_trace() const; // sqrt((Mxx + Myy)/2); the paper's size is sqrt(2) times that
};

// About the centroid, or about the point (x, y). Throws Error if a pixel is not finite, or if the
// flux is zero.
template <class T> UnweightedMoments unweighted_moments(View<const T> image);
template <class T> UnweightedMoments unweighted_moments(View<const T> image, double x, double y);

// The sum of all pixels: of every row in eight parts, of the rows compensated.
template <class T> double pixel_sum(View<const T> image);

} // namespace wfpsf
