// SPDX-License-Identifier: GPL-3.0-or-later
// Fields all over a region as a polynomial of the place in Newton's form: a term is what an exact
// field at a further place has that those before it do not tell.
#pragma once

#include "numerics/leja.hpp"
#include "optics/field.hpp"
#include "optics/light_modes.hpp"

#include <functional>
#include <vector>

namespace wfpsf {

class FieldTerms {
  public:
    // Optics by place (u, v) of a region that reaches from -1 to 1 along both axes; `middle` is the
    // field of (0, 0), which outlives these terms.
    using OpticsWithin = std::function<Optics(double u, double v)>;
    FieldTerms(const Field &middle, OpticsWithin optics, const PsfSettings &settings);

    size_t count() const { return light_.size(); }
    double error() const { return error_; } // of any exact field

    // With so many more out to a radius, and the modes that they become, at most: bytes.
    int64_t memory(size_t more, double radius) const;

    // The next ones of a degree, out to `radius` native pixels, by as many threads. Raises by_ring,
    // which has an entry for each native pixel's distance, to what was off there or farther, of the
    // brightest pixel.
    void add(size_t more, double radius, std::vector<double> &by_ring);

    // By Chebyshev's polynomials, each as large as the first term of its degree and zeros around
    // it. Those take the planes of terms that are as large, since fresh memory costs more than the
    // sums; no terms are left.
    std::vector<LightMode> take_modes();

  private:
    // Samples: a stamp's that take any of a term lie within it.
    int64_t border() const;
    void take(Field exact, std::vector<double> &by_ring);
    void add_row_of_modes(int64_t y, std::vector<LightMode> &modes, Plane<double> &rows);

    const Field &middle_;
    OpticsWithin optics_;
    const PsfSettings &settings_;
    LejaPolynomials polynomials_;
    std::vector<Plane<double>> light_; // as far as each matters
    double error_;
};

} // namespace wfpsf
