// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/quadrature.hpp"

#include <cmath>
#include <numbers>

namespace wfpsf {

GaussLegendre::GaussLegendre(int n) : x(static_cast<size_t>(n)), w(static_cast<size_t>(n)) {
    for (int i = 0; i < n; ++i) {
        // Newton's iteration on P_n from Tricomi's first guess; quadratic, so four steps do.
        double z = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        double slope = 0;
        for (int step = 0; step < 5; ++step) {
            double p = 1, p_below = 0;
            for (int k = 1; k <= n; ++k) {
                const double p_above = ((2 * k - 1) * z * p - (k - 1) * p_below) / k;
                p_below = p;
                p = p_above;
            }
            slope = n * (p_below - z * p) / (1 - z * z);
            z -= p / slope;
        }
        const auto mirrored = static_cast<size_t>(n - 1 - i);
        x[mirrored] = z;
        w[mirrored] = 2 / ((1 - z * z) * slope * slope);
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
