// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/wavefront_pairs.hpp"

#include "numerics/gamma.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

WavefrontPairs::WavefrontPairs(std::span<const double> wavefront, std::span<const double> area) {
    constexpr size_t bins = 256;
    const auto [low, high] = std::ranges::minmax(wavefront);
    step_ = (high - low) / bins;
    std::vector<double> lit(bins);
    double total = 0;
    for (size_t i = 0; i < wavefront.size(); ++i) {
        const double at = step_ > 0 ? (wavefront[i] - low) / step_ : 0;
        // Some nodes take from the area what others count too much of.
        lit[std::min(static_cast<size_t>(at), bins - 1)] += std::abs(area[i]);
        total += std::abs(area[i]);
    }
    share_.resize(bins + 1);
    for (size_t i = 0; i < bins; ++i)
        for (size_t j = i; j < bins; ++j)
            share_[j - i + 1] += (i == j ? 1 : 2) * lit[i] * lit[j] / (total * total);
}

double WavefrontPairs::power(double factor, int n) const {
    double sum = 0;
    for (size_t i = 1; i < share_.size(); ++i)
        if (const double difference = std::abs(factor) * step_ * static_cast<double>(i);
            difference > 0)
            sum += share_[i] * std::exp(n * std::log(difference) - log_of_gamma(n + 1));
    return sum;
}

} // namespace wfpsf
