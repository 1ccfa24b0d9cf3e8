// SPDX-License-Identifier: GPL-3.0-or-later
// Fresnel's integral by its auxiliary functions, good to 2e-3 (Abramowitz & Stegun 7.3.32, 7.3.33).
#pragma once

#include <cmath>
#include <complex>
#include <numbers>

namespace wfpsf {

// exp(-i pi x^2 / 2) times the integral of exp(i pi t^2 / 2) from x to infinity: smooth for x > 0.
inline std::complex<double> fresnel_tail(double x) {
    const double a = std::abs(x);
    const double f = (1 + 0.926 * a) / (2 + a * (1.792 + a * 3.104));
    const double g = 1 / (2 + a * (4.142 + a * (3.492 + a * 6.670)));
    if (x >= 0)
        return {g, f};
    const double turn = std::numbers::pi / 2 * a * a;
    return std::complex<double>(1, 1) * std::polar(1.0, -turn) - std::complex<double>(g, f);
}

// C(x) + i S(x), the integral from 0 to x.
inline std::complex<double> fresnel(double x) {
    const double a = std::abs(x);
    const auto value = std::complex<double>(0.5, 0.5) -
                       fresnel_tail(a) * std::polar(1.0, std::numbers::pi / 2 * a * a);
    return x < 0 ? -value : value;
}

} // namespace wfpsf
