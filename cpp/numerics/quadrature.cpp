// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/quadrature.hpp"

#include <cmath>
#include <numbers>

namespace wfpsf {

GaussLegendre::GaussLegendre(int n) : x(static_cast<size_t>(n)), w(static_cast<size_t>(n)) {
    for (int i = 0; 2 * i < n; ++i) {
        // Newton's iteration on P_n from Tricomi's first guess, until the root stands still: the
        // weight needs the slope at the root itself.
        double z = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        double slope = 0, step = 1;
        for (int k = 0; k < 6 && std::abs(step) > 1e-15; ++k) {
            double p = 1, p_below = 0;
            for (int j = 1; j <= n; ++j) {
                const double p_above = ((2 * j - 1) * z * p - (j - 1) * p_below) / j;
                p_below = p;
                p = p_above;
            }
            slope = n * (p_below - z * p) / (1 - z * z);
            step = p / slope;
            z -= step;
        }
        const auto low = static_cast<size_t>(i), high = static_cast<size_t>(n - 1 - i);
        x[low] = -z;
        x[high] = z;
        w[low] = w[high] = 2 / ((1 - z * z) * slope * slope);
    }
}

int gauss_legendre_points(double K, double eps) {
    for (int n = static_cast<int>(K / 2) + 1;; ++n) {
        const double nu = 2 * n + 0.5;
        const double ratio = K / nu;
        if (ratio == 0)
            return n;
        if (ratio >= 1)
            continue;
        const double exponent = nu * (std::acosh(1 / ratio) - std::sqrt(1 - ratio * ratio));
        if (8 * std::exp(-exponent) < eps)
            return n;
    }
}

} // namespace wfpsf
