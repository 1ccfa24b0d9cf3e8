// SPDX-License-Identifier: GPL-3.0-or-later
// One Fourier transform of galaxies behind one PSF: the transfer function on its wave numbers, kept
// for all of them.
#pragma once

#include "image/view.hpp"
#include "numerics/fft.hpp"
#include "scene/sersic.hpp"

#include <complex>
#include <cstdint>
#include <functional>
#include <vector>

namespace wfpsf {

// What the light of a point becomes, as the transform of the effective PSF: exp(-2 pi i k . x), k
// in cycles per native pixel; zero where |k| reaches the cutoff along both axes.
struct Transfer {
    std::function<std::complex<double>(double kx, double ky)> value;
    double cutoff;
};

// A profile's transform at a wave number k of the image (cycles per native pixel) is its table's
// value at q = xx kx^2 + 2 xy kx ky + yy ky^2, as far as that is `largest`.
struct WaveForm {
    double xx, xy, yy, largest;
};

// Where samples go; grows to the largest transform.
struct GalaxyBuffers {
    std::vector<std::complex<double>> spectrum, phase_x, phase_y;
    std::vector<double> profile;
    std::vector<double> samples;
};

class GalaxyGrid {
  public:
    // `size` samples (even) of `step` native pixels along both axes, of the image whose transform
    // is share(|k|) of the transfer function. Samples see all wave numbers, folded as by sampling.
    GalaxyGrid(const Transfer &transfer, int64_t size, int64_t step,
               const std::function<double(double)> &share);

    // Samples of the image of a galaxy at (x, y), native pixels from sample (size/2, size/2). They
    // repeat after `size` samples.
    View<double> draw(const SersicTable &profile, const WaveForm &form, double x, double y,
                      double flux, GalaxyBuffers &buffers) const;

    int64_t size() const { return size_; }
    int64_t step() const { return step_; }
    // Integral of |k|^2 |OTF| over the plane of k.
    double curvature() const { return curvature_; }

  private:
    // Neighbours along x, whose sums go to neighbours.
    struct Run {
        int64_t kx, ky, count, target;
        size_t first;
    };

    int64_t size_, step_, reach_; // |kx|, |ky| <= reach
    RealBackwardFft2d fft_;
    std::vector<Run> runs_;
    std::vector<double> re_, im_; // of the transfer function
    double curvature_ = 0;
};

} // namespace wfpsf
