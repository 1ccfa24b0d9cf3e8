// SPDX-License-Identifier: GPL-3.0-or-later
// Effects that act on each pixel by itself, on rows of double; electrons unless stated.
#pragma once

#include "image/view.hpp"

#include <cstdint>
#include <span>

namespace wfpsf {

// To the nearest multiple of a unit; halves go to the even one.
void quantize(double unit, std::span<double> row);

// The relative sensitivity grows by alpha per decade of flux about the base flux (e-/s): in becomes
// in (in / (base_flux time))^(alpha / ln 10). 0 stays 0; what is negative becomes NaN.
void reciprocity_failure(double alpha, double exposure_time, double base_flux,
                         std::span<double> row);

// in + c2 in^2 + c3 in^3 + ...; `coefficients` starts with c2.
void nonlinearity(std::span<const double> coefficients, std::span<double> row);

// The inverse on the branch through 0. Beyond that branch's turning point there is none: NaN.
void nonlinearity_inverse(std::span<const double> coefficients, std::span<double> row);

// Pixels at or above the level are set to it and counted.
int64_t saturate(double level, std::span<double> row);

// Pixels that are NaN or infinite.
int64_t count_not_finite(View<const float> image);
int64_t count_not_finite(View<const double> image);

// A trap model of past exposures: the current (e-/s) a time after a pixel held `level` electrons.
// Above half_well A (level / x0)^a (time / 1000 s)^-r / (exp(-(level - x0) / dx) + 1); below,
// linear in the level, to 0 at 0.
class FermiPersistence {
  public:
    struct Figures {
        double A, x0, dx, a, r, half_well;
    };

    FermiPersistence(const Figures &figures, double time);
    double rate(double level) const;

  private:
    double above(double level) const;

    Figures figures_;
    double scale_, at_half_well_;
};

} // namespace wfpsf
