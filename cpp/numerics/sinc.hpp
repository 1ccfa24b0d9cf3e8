// SPDX-License-Identifier: GPL-3.0-or-later
// sin(pi t) / (pi t): the transform of a box of width one.
#pragma once

#include <cmath>
#include <numbers>

namespace wfpsf {

inline double sinc(double t) {
    const double x = std::numbers::pi * t;
    return std::abs(x) < 1e-8 ? 1 : std::sin(x) / x;
}

} // namespace wfpsf
