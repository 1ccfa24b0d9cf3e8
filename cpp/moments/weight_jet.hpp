// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives, up to the third, of the sum of f w^n along steps of the weight.
#pragma once

#include "moments/gaussian.hpp"
#include "moments/weighted_sums.hpp"

namespace wfpsf {

class WeightJet {
  public:
    // Sums of f w^n up to the fourth order give first and second derivatives, the sixth the third.
    WeightJet(const WeightedSums &sums, int n) : sums_(sums), n_(n) {}

    const WeightedSums &sums() const { return sums_; }
    double value() const { return sums_.sum[0][0]; }
    double along(const WhitenedStep &a) const;
    double along(const WhitenedStep &a, const WhitenedStep &b) const;
    double along(const WhitenedStep &a, const WhitenedStep &b, const WhitenedStep &c) const;

  private:
    WeightedSums sums_;
    int n_;
};

} // namespace wfpsf
