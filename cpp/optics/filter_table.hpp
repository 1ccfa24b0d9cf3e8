// SPDX-License-Identifier: GPL-3.0-or-later
// The weights of an interpolator at any place, from a table.
#pragma once

#include "numerics/bandlimited.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace wfpsf {

template <class T> class FilterTable {
  public:
    static constexpr int64_t most_taps = 64, lanes = 8;

    explicit FilterTable(const BandlimitedInterpolator &of);

    int64_t half_width() const { return half_width_; }
    int64_t taps() const { return 2 * half_width_; }
    int64_t padded() const { return padded_; } // taps in whole vectors, the rest weigh nothing

    // Those around position x, cubic in between the table's places; returns the first sample's
    // index.
    [[gnu::always_inline]] int64_t weights(double x, T *w) const {
        const double base = std::floor(x);
        const double place = (x - base) * places_;
        const auto row = static_cast<int64_t>(place);
        const double u = place - static_cast<double>(row);
        const auto a = static_cast<T>(-u * (u - 1) * (u - 2) / 6),
                   b = static_cast<T>((u + 1) * (u - 1) * (u - 2) / 2),
                   c = static_cast<T>(-(u + 1) * u * (u - 2) / 2),
                   d = static_cast<T>((u + 1) * u * (u - 1) / 6);
        const T *const here = &table_[static_cast<size_t>(row * padded_)];
        for (int64_t k = 0; k < padded_; k += lanes) // whole vectors
            for (int64_t i = k; i < k + lanes; ++i)
                w[i] = a * here[i] + b * here[padded_ + i] + c * here[2 * padded_ + i] +
                       d * here[3 * padded_ + i];
        return static_cast<int64_t>(base) - half_width_ + 1;
    }

  private:
    int64_t half_width_, padded_;
    double places_;        // a sample
    std::vector<T> table_; // [(1 + place) * padded_ + tap]
};

} // namespace wfpsf
