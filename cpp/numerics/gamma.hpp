// SPDX-License-Identifier: GPL-3.0-or-later
// The logarithm of the gamma function for many threads: std::lgamma() sets a sign that all of a
// process share.
#pragma once

#include <math.h>

namespace wfpsf {

inline double log_of_gamma(double x) {
    int sign;
    return ::lgamma_r(x, &sign);
}

} // namespace wfpsf
