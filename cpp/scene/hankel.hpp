// SPDX-License-Identifier: GPL-3.0-or-later
// The Fourier transform of Sersic profiles of any index, as a Mellin-Barnes integral.
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace wfpsf {

// The transform of I(r) ~ exp(-b r^(1/n)) with unit flux at wave number k (radians per unit of r):
//
//     F(k) = 1/(2 pi i) integral of W(s) k^-s ds along Re s = c, 0 < c < 2,
//     W(s) = 2^(s-1) Gamma(s/2) / Gamma(1 - s/2) b^(n s) Gamma(n (2 - s)) / Gamma(2 n),
//
// the product of the Mellin transforms of the Bessel function J0 and of the profile. The
// trapezoidal rule converges exponentially in it: no term is left that oscillates faster with k.
class SersicHankel {
  public:
    SersicHankel(double n, double b);

    // At many wave numbers, by their logarithms; good to 1e-12 for k > 1e-7.
    void at(std::span<const double> log_k, double *transform) const;

  private:
    std::vector<std::complex<double>> weights_; // of equally spaced Im s >= 0
};

} // namespace wfpsf
