// SPDX-License-Identifier: GPL-3.0-or-later
// A x = b by Chebyshev's iteration, for a linear operator whose spectrum lies close to an
// interval of positive numbers.
#pragma once

#include <cstdint>
#include <functional>

namespace wfpsf {

struct SpectralInterval {
    double lowest, highest; // 0 < lowest <= highest
};

// Passes that shrink the error by `factor`, by theory.
int64_t chebyshev_passes(SpectralInterval spectrum, double factor);

struct Iteration {
    double residual = 0; // as the caller measures it
    int64_t passes = 0;
    bool converged = true; // the residual is at the tolerance, or at its floor of rounding
};

// step(weight) moves x by weight (b - A x). residual() is a norm of b - A x over one of b.
Iteration solve_by_chebyshev(const std::function<void(double weight)> &step,
                             const std::function<double()> &residual, SpectralInterval spectrum,
                             double tolerance, int64_t most_passes);

} // namespace wfpsf
