// SPDX-License-Identifier: GPL-3.0-or-later
// Fresnel's integral by its auxiliary functions, good to 2e-3 (Abramowitz & Stegun 7.3.32, 7.3.33).
#pragma once

#include "numerics/phasor.hpp"

#include <cmath>
#include <complex>

namespace wfpsf {

// exp(-i pi x^2 / 2) times the integral of exp(i pi t^2 / 2) from x to infinity: smooth for x > 0.
// Without a branch, as phasor() is.
[[gnu::always_inline]] inline void fresnel_tail(double x, double &re, double &im) {
    const double a = std::abs(x);
    const double f = (1 + 0.926 * a) / (2 + a * (1.792 + a * 3.104));
    const double g = 1 / (2 + a * (4.142 + a * (3.492 + a * 6.670)));
    double cosine, sine;
    phasor(-a * a / 4, cosine, sine);
    re = x >= 0 ? g : cosine - sine - g;
    im = x >= 0 ? f : cosine + sine - f;
}

// C(x) + i S(x), the integral from 0 to x.
inline std::complex<double> fresnel(double x) {
    const double a = std::abs(x);
    double re, im, cosine, sine;
    fresnel_tail(a, re, im);
    phasor(a * a / 4, cosine, sine);
    const std::complex<double> value{0.5 - (re * cosine - im * sine),
                                     0.5 - (re * sine + im * cosine)};
    return x < 0 ? -value : value;
}

} // namespace wfpsf
