// SPDX-License-Identifier: GPL-3.0-or-later
// log and exp without a branch or a table, so that a loop over them becomes vector instructions in
// a function marked WFPSF_VECTORISED. Both are good to 2 units in the last place.
#pragma once

#include "numerics/phasor.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace wfpsf {

namespace elementary_detail {

inline constexpr double ln2_high = 0x1.62e42fefa38p-1; // 42 bits: times an exponent it is exact
inline constexpr double ln2_low = 0x1.ef35793c7673p-45;

// 1 / (2 k + 1): the series of atanh(s) / s in s^2. What is left out is 1e-17 at s = 0.172.
inline constexpr auto atanh_series = [] {
    std::array<double, 11> c{};
    for (size_t k = 0; k < c.size(); ++k)
        c[k] = 1 / static_cast<double>(2 * k + 1);
    return c;
}();

// 1 / k!: what is left out is 4e-18 at log(2) / 2.
inline constexpr auto exp_series = [] {
    std::array<double, 14> c{};
    double factorial = 1;
    for (size_t k = 0; k < c.size(); ++k) {
        c[k] = 1 / factorial;
        factorial *= static_cast<double>(k + 1);
    }
    return c;
}();

} // namespace elementary_detail

// Of a normal positive number.
[[gnu::always_inline]] inline double branchless_log(double x) {
    using namespace elementary_detail;
    constexpr uint64_t root_half = 0x3fe6a09e667f3bcd, bias = 1024;
    const auto bits = std::bit_cast<uint64_t>(x);
    const uint64_t biased = (bits - root_half + (bias << 52)) >> 52;
    const double exponent = std::bit_cast<double>(biased | 0x4330000000000000) - (0x1p52 + bias);
    const auto mantissa = std::bit_cast<double>(bits - ((biased - bias) << 52));
    const double s = (mantissa - 1) / (mantissa + 1);
    const double tail = phasor_detail::horner(atanh_series, s * s);
    return exponent * ln2_high + (exponent * ln2_low + 2 * s * tail);
}

// |x| < 700.
[[gnu::always_inline]] inline double branchless_exp(double x) {
    using namespace elementary_detail;
    constexpr double shift = 0x1.8p52;
    const double shifted = x * std::numbers::log2e + shift;
    const double exponent = shifted - shift;
    const double rest = (x - exponent * ln2_high) - exponent * ln2_low;
    // The lowest bits of `shifted` are the exponent.
    const auto scale = std::bit_cast<double>((std::bit_cast<uint64_t>(shifted) + 1023) << 52);
    return scale * phasor_detail::horner(exp_series, rest);
}

} // namespace wfpsf
