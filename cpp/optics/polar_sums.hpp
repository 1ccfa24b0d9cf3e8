// SPDX-License-Identifier: GPL-3.0-or-later
// The sums of Scaling far from the axis, where they are over many colours. To make an image smaller
// is to move it along rays from the axis; so by u, the logarithm of the distance, the sum over all
// colours is a convolution of each term,
//
//   sum_k w_k I_k(u) = sum_m sum_k w_k T_m(x_k) terms[m](u + ln ratio_k),
//
// and a product with sum_k w_k T_m(x_k) exp(2 pi i f ln ratio_k) in Fourier space, however many the
// colours are.
#pragma once

#include "error/progress.hpp"
#include "image/view.hpp"
#include "optics/polar_grid.hpp"
#include "optics/scaling_terms.hpp"

#include <span>
#include <vector>

namespace wfpsf {

class PolarSums {
  public:
    // The sums may miss eps, and terms that are negligible together.
    PolarSums(const ScalingTerms &terms, const PolarBand &band, double eps, double negligible);

    // How far from the axis terms must reach, in samples, for places up to `half` samples off; by
    // the ratio of the bluest to the reddest wavelength, and eps in units of the peak.
    static int64_t reach(const PolarBand &band, double half, double range, double eps);

    // Sets the sums for all places that are farther than some distance from the axis along either
    // axis, but no farther than `outer`. Returns the distance: `inner`, or more where the light is
    // too bright.
    double set(std::span<const ScaledColour> colours, double inner, double outer,
               std::span<Plane<double>> sums, const Progress &progress) const;

  private:
    template <class T> class Ring;
    // From how many samples of the terms on there is no more light than this.
    double dark_from(double light) const;

    const ScalingTerms &terms_;
    PolarBand band_;
    double eps_, negligible_;
    PolarFilters<float> single_;
    PolarFilters<double> double_;
};

} // namespace wfpsf
