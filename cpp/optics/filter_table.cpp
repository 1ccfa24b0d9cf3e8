// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/filter_table.hpp"

namespace wfpsf {

// Between places the kernel bends by no more than sinc does, and errs by pi^2 / 24 of a place's
// square: by less than the kernel itself.
FilterTable::FilterTable(const BandlimitedInterpolator &of)
    : half_width_(of.half_width()), padded_((of.taps() + lanes - 1) / lanes * lanes),
      places_(std::ceil(std::sqrt(2 / of.error()))) {
    const auto rows = static_cast<int64_t>(places_) + 2;
    table_.resize(static_cast<size_t>(rows * padded_));
    for (int64_t row = 0; row < rows; ++row)
        for (int64_t k = 0; k < taps(); ++k)
            table_[static_cast<size_t>(row * padded_ + k)] = static_cast<float>(of.kernel(
                static_cast<double>(row) / places_ + static_cast<double>(half_width_ - 1 - k)));
}

} // namespace wfpsf
