// SPDX-License-Identifier: GPL-3.0-or-later
// What averages a diffraction image before it is seen: the native pixel, the telescope's jitter and
// the diffusion of charge, all as one filter of the sampled image.
#pragma once

#include "numerics/bandlimited.hpp"

#include <cstddef>
#include <vector>

namespace wfpsf {

struct Covariance {
    double xx = 0, xy = 0, yy = 0;
    bool none() const { return xx == 0 && yy == 0; }
};

// A filter as a sum of products of two symmetric sets of taps, 2m + 1 each, centre [m].
struct SeparableFilter {
    struct Term {
        std::vector<double> x, y;
    };
    std::vector<Term> terms;
    size_t half_width() const { return terms[0].x.size() / 2; }
};

// The average over a square of `width` samples and a Gaussian of the given covariance (samples^2,
// not negative definite), good to the interpolator's own error on band-limited images.
SeparableFilter averaging_filter(const BandlimitedInterpolator &interpolator, double width,
                                 const Covariance &blur);

} // namespace wfpsf
