// SPDX-License-Identifier: GPL-3.0-or-later
// Nonuniform fast Fourier transform of type 1 in two dimensions: scattered sources to a uniform
// grid of modes (Barnett, Magland & af Klinteberg 2019, SIAM J. Sci. Comput. 41, C479; used for
// diffraction by Barnett 2021, J. Astron. Telesc. Instrum. Syst. 7, 021211).
#pragma once

#include <complex>
#include <cstdint>
#include <span>

namespace wfpsf {

inline constexpr double nufft_best_eps = 1e-14;

// out[(jy + K) (2K + 1) + jx + K] = sum_n c_n exp(i (a_n jx + b_n jy)), jx, jy = -K..K, with an
// error of about eps times sum |c_n|. |a_n|, |b_n| < pi; the narrower their range, the faster:
// transforms of what is known to be zero are left out.
void nufft_type1(std::span<const double> a, std::span<const double> b,
                 std::span<const std::complex<double>> c, int64_t K, double eps,
                 std::complex<double> *out);

} // namespace wfpsf
