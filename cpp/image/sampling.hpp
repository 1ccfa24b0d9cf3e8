// SPDX-License-Identifier: GPL-3.0-or-later
// Positions in native pixels and in samples of an image that has n of them along each: both count
// from the first one's centre at 0.
#pragma once

namespace wfpsf {

inline double sample_of(double native, double n) {
    return native * n + (n - 1) / 2;
}

inline double native_of(double sample, double n) {
    return (sample - (n - 1) / 2) / n;
}

} // namespace wfpsf
