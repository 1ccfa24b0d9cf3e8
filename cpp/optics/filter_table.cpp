// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/filter_table.hpp"

namespace wfpsf {

// Between places a kernel varies no faster than a sinc, whose fourth derivative is at most
// pi^4 / 5. A cubic errs by 3 / 128 of that times the step to the fourth: by less than half of what
// the kernel does itself.
template <class T>
FilterTable<T>::FilterTable(const BandlimitedInterpolator &of)
    : half_width_(of.half_width()), padded_((of.taps() + lanes - 1) / lanes * lanes),
      places_(std::ceil(std::pow(1 / of.error(), 0.25))) {
    const auto rows = static_cast<int64_t>(places_) + 4;
    table_.resize(static_cast<size_t>(rows * padded_));
    for (int64_t row = 0; row < rows; ++row)
        for (int64_t k = 0; k < taps(); ++k)
            table_[static_cast<size_t>(row * padded_ + k)] = static_cast<T>(of.kernel(
                static_cast<double>(row - 1) / places_ + static_cast<double>(half_width_ - 1 - k)));
}

template class FilterTable<float>;
template class FilterTable<double>;

} // namespace wfpsf
