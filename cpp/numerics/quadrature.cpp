// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/quadrature.hpp"

#include "numerics/dispatch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace wfpsf {

namespace {

constexpr size_t lanes = 8; // roots sought together
using Lanes = std::array<double, lanes>;

// Newton's iteration on P_n, until the roots stand still: the weights need the slopes at the roots
// themselves.
WFPSF_VECTORISED void find_roots(int n, Lanes &roots, Lanes &slopes) {
    double largest_step = 1;
    for (int iteration = 0; iteration < 6 && largest_step > 1e-15; ++iteration) {
        Lanes p, below{};
        p.fill(1);
        for (int j = 1; j <= n; ++j) {
            const double a = (2.0 * j - 1) / j, b = (j - 1.0) / j;
            for (size_t i = 0; i < lanes; ++i) {
                const double above = a * roots[i] * p[i] - b * below[i];
                below[i] = p[i];
                p[i] = above;
            }
        }
        largest_step = 0;
        for (size_t i = 0; i < lanes; ++i) {
            slopes[i] = n * (below[i] - roots[i] * p[i]) / (1 - roots[i] * roots[i]);
            const double step = p[i] / slopes[i];
            roots[i] -= step;
            largest_step = std::max(largest_step, std::abs(step));
        }
    }
}

} // namespace

GaussLegendre::GaussLegendre(int n) : x(static_cast<size_t>(n)), w(static_cast<size_t>(n)) {
    const auto count = static_cast<size_t>((n + 1) / 2); // the others mirror them
    for (size_t first = 0; first < count; first += lanes) {
        Lanes roots, slopes;
        for (size_t i = 0; i < lanes; ++i) // Tricomi's first guess; twice the last one where over
            roots[i] =
                std::cos(std::numbers::pi *
                         (static_cast<double>(std::min(first + i, count - 1)) + 0.75) / (n + 0.5));
        find_roots(n, roots, slopes);
        for (size_t i = 0; i < std::min(lanes, count - first); ++i) {
            const size_t low = first + i, high = x.size() - 1 - low;
            x[low] = -roots[i];
            x[high] = roots[i];
            w[low] = w[high] = 2 / ((1 - roots[i] * roots[i]) * slopes[i] * slopes[i]);
        }
    }
    // The slopes' rounding, of one sign at all roots, is what the weights' sum is off by.
    const double whole = std::accumulate(w.begin(), w.end(), 0.0) / 2;
    for (double &weight : w)
        weight /= whole;
}

const GaussLegendre &GaussLegendreRules::of(int n) {
    return rules_.try_emplace(n, n).first->second;
}

int gauss_legendre_points(double K, double eps) {
    if (K == 0)
        return 1;
    const double needed = std::log(8 / eps);
    const auto enough = [&](int n) {
        const double nu = 2 * n + 0.5, ratio = K / nu;
        if (ratio >= 1)
            return false;
        const double root = std::sqrt((1 - ratio) * (1 + ratio));
        return nu * (std::log((1 + root) / ratio) - root) > needed;
    };
    int too_few = static_cast<int>(K / 2), n = too_few + 8;
    for (; !enough(n); n += n - too_few)
        ;
    while (n - too_few > 1) {
        const int middle = std::midpoint(too_few, n);
        (enough(middle) ? n : too_few) = middle;
    }
    return n;
}

} // namespace wfpsf
