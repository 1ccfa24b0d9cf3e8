// SPDX-License-Identifier: GPL-3.0-or-later
// exp(2 pi i t) for an angle in turns: a few multiplications and no branch, so that a loop over it
// becomes vector instructions in a function marked WFPSF_VECTORISED.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace wfpsf {

namespace phasor_detail {

// Taylor's coefficients of cos 2 pi t (first = 0) or sin 2 pi t / t (first = 1) in t^2: the first
// one left out is 3e-17 at a quarter of a turn.
template <size_t n> constexpr std::array<double, n> series(int first) {
    std::array<double, n> coefficients{};
    long double term = first == 0 ? 1 : 2 * std::numbers::pi_v<long double>;
    for (size_t k = 0; k < n; ++k) {
        coefficients[k] = static_cast<double>(term);
        const auto order = static_cast<long double>(2 * k) + first;
        const long double turn = 2 * std::numbers::pi_v<long double>;
        term *= -turn * turn / ((order + 1) * (order + 2));
    }
    return coefficients;
}
inline constexpr auto cosine = series<11>(0), sine = series<11>(1);

template <size_t n>
[[gnu::always_inline]] constexpr double horner(const std::array<double, n> &coefficients,
                                               double t) {
    double sum = coefficients[n - 1];
    for (size_t k = n - 1; k-- > 0;)
        sum = sum * t + coefficients[k];
    return sum;
}

// To the nearest integer, |t| < 2^51; std::rint is a call where the processor has no such
// instruction.
[[gnu::always_inline]] inline double nearest(double t) {
    constexpr double shift = 0x1.8p52;
    return (t + shift) - shift;
}

} // namespace phasor_detail

// Good to 4e-16 beside the rounding of t itself, |t| < 2^50.
[[gnu::always_inline]] inline void phasor(double t, double &cosine, double &sine) {
    using namespace phasor_detail;
    const double half_turns = nearest(2 * t);
    const double rest = t - half_turns / 2; // within a quarter of a turn
    // A half turn is a change of sign: odd is 0 or +-1/2.
    const double odd = half_turns / 2 - nearest(half_turns / 2);
    const double sign = 1 - 8 * odd * odd;
    const double square = rest * rest;
    cosine = sign * horner(phasor_detail::cosine, square);
    sine = sign * rest * horner(phasor_detail::sine, square);
}

} // namespace wfpsf
