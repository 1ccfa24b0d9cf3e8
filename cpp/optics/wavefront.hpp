// SPDX-License-Identifier: GPL-3.0-or-later
// The aberrated wavefront as a sum of Noll's Zernike polynomials (Noll 1976, J. Opt. Soc. Am. 66,
// 207; section 4.1 of the paper): Z_j has unit rms over the full circle, cos m theta for even j.
#pragma once

#include "optics/opd_map.hpp"

#include <memory>
#include <span>
#include <vector>

namespace wfpsf {

// All polynomials of azimuthal order m: polynomials in r^2 that multiply r^m cos m theta and
// r^m sin m theta.
struct ZernikeOrder {
    std::vector<double> cosine, sine;
};

// W(x, y) = sum_j a_j Z_j(x / radius, y / radius), in the unit of the coefficients (waves), plus an
// optical path difference map.
class Wavefront {
  public:
    static constexpr int largest_j = 231; // radial order 20

    // coefficients[j - 1] belongs to Z_j; j up to largest_j.
    Wavefront(std::span<const double> coefficients, double radius);

    // Adds an optical path difference, as waves of that length; the map is shared.
    void add(std::shared_ptr<const OpdMap> map, double wavelength);
    bool has_map() const { return map_ != nullptr; }

    double operator()(double x, double y) const;
    // The same at many points.
    void evaluate(std::span<const double> x, std::span<const double> y, double *waves) const;

    // All of it `factor` times.
    Wavefront scaled(double factor) const;

    // Never below the steepest slope |grad W| on the circle of the given radius (waves per metre).
    double slope_bound() const { return slope_bound_; }

  private:
    std::vector<ZernikeOrder> orders_;
    double radius_, slope_bound_ = 0;
    std::shared_ptr<const OpdMap> map_;
    double waves_per_metre_ = 0; // of the map
};

} // namespace wfpsf
