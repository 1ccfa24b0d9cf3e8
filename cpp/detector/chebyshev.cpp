// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace wfpsf {

namespace {

// Reciprocals of the roots of Chebyshev's polynomial over the spectrum, in Leja's order, which
// keeps the partial products small: the next root is the one farthest from those before it, as a
// product.
std::vector<double> weights_of_cycle(SpectralInterval spectrum, int64_t count) {
    const double middle = (spectrum.highest + spectrum.lowest) / 2;
    const double half = (spectrum.highest - spectrum.lowest) / 2;
    std::vector<double> roots, product(static_cast<size_t>(count), 1), weights;
    for (int64_t i = 0; i < count; ++i)
        roots.push_back(std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) /
                                 static_cast<double>(count)));
    while (weights.size() < roots.size()) {
        const auto next = static_cast<size_t>(std::ranges::max_element(product) - product.begin());
        weights.push_back(1 / (middle + half * roots[next]));
        for (size_t i = 0; i < roots.size(); ++i)
            product[i] *= 2 * std::fabs(roots[i] - roots[next]); // 2: keeps it near 1
    }
    return weights;
}

} // namespace

int64_t chebyshev_passes(SpectralInterval spectrum, double factor) {
    const double middle = (spectrum.highest + spectrum.lowest) / 2;
    const double half = (spectrum.highest - spectrum.lowest) / 2;
    if (half <= 1e-15 * middle)
        return 1;
    return static_cast<int64_t>(std::ceil(std::acosh(2 / factor) / std::acosh(middle / half)));
}

Iteration solve_by_chebyshev(const std::function<void(double weight)> &step,
                             const std::function<double()> &residual, SpectralInterval spectrum,
                             double tolerance, int64_t most_passes) {
    constexpr int64_t longest_cycle = 64;
    constexpr double rounding = 1e-12; // below it a residual that shrinks no more is at its floor
    const int64_t wanted = chebyshev_passes(spectrum, tolerance);
    const std::vector<double> weights =
        weights_of_cycle(spectrum, std::clamp<int64_t>(wanted, 1, longest_cycle));
    Iteration result;
    for (double before = HUGE_VAL;; before = result.residual) {
        for (const double weight : weights)
            step(weight);
        result.passes += static_cast<int64_t>(weights.size());
        result.residual = residual();
        const bool shrinks = result.residual < before / 2;
        result.converged = result.residual <= tolerance || (!shrinks && before < rounding);
        const bool diverges = !(result.residual < 2 * before);
        if (result.converged || diverges || result.passes >= most_passes)
            return result;
    }
}

} // namespace wfpsf
