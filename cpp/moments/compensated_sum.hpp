// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace wfpsf {

// Neumaier's sum: what rounding takes off is kept aside and added at the end.
class CompensatedSum {
  public:
    void add(double value) {
        const double total = sum_ + value;
        lost_ +=
            std::abs(sum_) >= std::abs(value) ? (sum_ - total) + value : (value - total) + sum_;
        sum_ = total;
    }
    double value() const { return sum_ + lost_; }

  private:
    double sum_ = 0, lost_ = 0;
};

} // namespace wfpsf
