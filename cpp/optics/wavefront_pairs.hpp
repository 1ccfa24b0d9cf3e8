// SPDX-License-Identifier: GPL-3.0-or-later
// How far the wavefronts of two points of a pupil are apart: by that much they interfere.
#pragma once

#include <span>
#include <vector>

namespace wfpsf {

class WavefrontPairs {
  public:
    // Of points that each stand for so much of the lit area.
    WavefrontPairs(std::span<const double> wavefront, std::span<const double> area);

    // Never below the mean over all pairs of |factor * difference|^n / n!.
    double power(double factor, int n) const;

  private:
    double step_;
    std::vector<double>
        share_; // of the pairs that differ by up to so many steps, one less at least
};

} // namespace wfpsf
