// SPDX-License-Identifier: GPL-3.0-or-later
// Gauss-Legendre quadrature.
#pragma once

#include <map>
#include <vector>

namespace wfpsf {

// Nodes and weights on [-1, 1]; exact for polynomials up to degree 2n - 1. Our own, because GSL's
// table is good to 1e-10 only for most n.
struct GaussLegendre {
    explicit GaussLegendre(int n);
    int size() const { return static_cast<int>(x.size()); }
    std::vector<double> x, w;
};

// Rules that are used again and again.
class GaussLegendreRules {
  public:
    const GaussLegendre &of(int n);

  private:
    std::map<int, GaussLegendre> rules_;
};

// The smallest n with which an n-point rule integrates exp(iKx) over [-1, 1] to about eps.
// The rule is exact up to degree 2n - 1, so its error is about (4n+1)|j_2n(K)|, j the spherical
// Bessel function of the Legendre expansion of exp(iKx), here by Debye's asymptotic form.
int gauss_legendre_points(double K, double eps);

} // namespace wfpsf
