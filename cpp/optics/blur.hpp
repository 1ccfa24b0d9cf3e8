// SPDX-License-Identifier: GPL-3.0-or-later
// What averages a diffraction image before it is seen: the native pixel, the telescope's jitter and
// the diffusion of charge, all as one filter of the sampled image.
#pragma once

#include <cstddef>
#include <vector>

namespace wfpsf {

struct Covariance {
    double xx = 0, xy = 0, yy = 0;
    bool none() const { return xx == 0 && yy == 0; }
};

// A filter as a sum of products of taps along x and taps along y, 2m + 1 each, centre [m]; the same
// when turned by 180 degrees.
struct SeparableFilter {
    struct Term {
        std::vector<double> x, y;
    };
    std::vector<Term> terms;
    double error; // at most so many times the integral of the image's absolute spectrum
    size_t half_width() const { return terms[0].x.size() / 2; }
};

// The average over a square of `width` samples (0: none) and a Gaussian of the given covariance
// (samples^2, not negative definite, not zero), for images with no frequency above `bandwidth`
// cycles per sample. The error is about eps.
SeparableFilter blurring_filter(double bandwidth, double width, const Covariance &blur, double eps);

} // namespace wfpsf
