// SPDX-License-Identifier: GPL-3.0-or-later
// Galaxies summed up in real space, from the definition of the Sersic profile and of the shear.
#pragma once

#include "numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace wfpsf::oracle {

struct SersicGalaxy {
    double index, b;
    double radius; // half-light, pixels
    double e1, e2;

    // Light per area of the round galaxy.
    double brightness(double r) const {
        return std::exp(-b * std::pow(r / radius, 1 / index) + 2 * index * std::log(b)) /
               (2 * std::numbers::pi * index * std::tgamma(2 * index) * radius * radius);
    }
    double minor() const { return std::sqrt((1 - e()) / (1 + e())); }
    double e() const { return std::hypot(e1, e2); }
};

// Calls node(x, y, light) for points that stand for the part of a galaxy, about its centre, that is
// within `last` of it before the shear. Their sum is good for functions that vary
// over `scale` pixels.
template <class Node>
void for_each_node(const SersicGalaxy &g, double scale, double last, Node node) {
    static const GaussLegendre rule(24);
    const double pi = std::numbers::pi, stretch = 1 / std::sqrt(1 - g.e() * g.e());
    const double fine = scale * g.minor();
    const auto ring = [&](double r, double light) {
        const auto count = static_cast<int>(60 + 10 * r / fine);
        for (int i = 0; i < count; ++i) {
            const double phi = 2 * pi * (i + 0.5) / count, x = r * std::cos(phi),
                         y = r * std::sin(phi);
            node(stretch * ((1 + g.e1) * x + g.e2 * y), stretch * (g.e2 * x + (1 - g.e1) * y),
                 light / count);
        }
    };
    // The cusp by powers of r = s^n, panel by panel that each halve the radius; then even steps.
    const double power = std::max(1.0, g.index);
    for (double begin = 0; begin < last;) {
        const bool cusp = begin == 0;
        const double end = cusp ? std::min(last, std::min(fine, g.radius) / 4)
                                : std::min({last, 2 * begin, begin + 2 * fine});
        for (int i = 0; i < rule.size(); ++i) {
            const double s = (1 + rule.x[static_cast<size_t>(i)]) / 2;
            const double weight = rule.w[static_cast<size_t>(i)] / 2;
            const double r = cusp ? end * std::pow(s, power) : begin + (end - begin) * s;
            const double slope = cusp ? end * power * std::pow(s, power - 1) : end - begin;
            ring(r, weight * slope * 2 * pi * r * g.brightness(r));
        }
        begin = end;
    }
}

// The density of light at (x, y) behind a round Gaussian: by the galaxy's nodes, or where the
// Gaussian does not see the centre by points of its own.
inline double behind_gaussian(const SersicGalaxy &g, double sigma, double x, double y) {
    const double far = std::hypot(x, y), sees = 7 * sigma;
    double sum = 0;
    if (far > 2 * sees) {
        const double shrink = 1 / std::sqrt(1 - g.e() * g.e());
        constexpr int points = 28;
        const double step = sees / points;
        for (int j = -points; j <= points; ++j)
            for (int i = -points; i <= points; ++i) {
                const double u = x + i * step, v = y + j * step;
                sum +=
                    step * step * std::exp(-(i * i + j * j) * step * step / (2 * sigma * sigma)) *
                    g.brightness(shrink *
                                 std::hypot((1 - g.e1) * u - g.e2 * v, (1 + g.e1) * v - g.e2 * u));
            }
    } else {
        for_each_node(g, sigma, (far + sees) / g.minor(), [&](double u, double v, double light) {
            const double square = (u - x) * (u - x) + (v - y) * (v - y);
            sum += light * std::exp(-square / (2 * sigma * sigma));
        });
    }
    return sum / (2 * std::numbers::pi * sigma * sigma);
}

} // namespace wfpsf::oracle
