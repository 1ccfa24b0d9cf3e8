// SPDX-License-Identifier: GPL-3.0-or-later
// Fresnel's integral by its auxiliary functions, good to 2e-3 (Abramowitz & Stegun 7.3.32, 7.3.33),
// without a branch as phasor().
#pragma once

#include "numerics/phasor.hpp"

#include <cmath>

namespace wfpsf {

// exp(-i pi x^2 / 2) times the integral of exp(i pi t^2 / 2) from x > 0 to infinity: g + i f.
[[gnu::always_inline]] inline void fresnel_auxiliary(double x, double &g, double &f) {
    f = (1 + 0.926 * x) / (2 + x * (1.792 + x * 3.104));
    g = 1 / (2 + x * (4.142 + x * (3.492 + x * 6.670)));
}

// The same of any x.
[[gnu::always_inline]] inline void fresnel_tail(double x, double &re, double &im) {
    const double a = std::abs(x);
    double g, f, cosine, sine;
    fresnel_auxiliary(a, g, f);
    phasor(-a * a / 4, cosine, sine);
    re = x >= 0 ? g : cosine - sine - g;
    im = x >= 0 ? f : cosine + sine - f;
}

} // namespace wfpsf
