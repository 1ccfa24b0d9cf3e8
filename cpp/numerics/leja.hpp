// SPDX-License-Identifier: GPL-3.0-or-later
// Polynomials of two variables in [-1, 1] through values at ever more places, each place as useful
// as it can be to those before: discrete Leja points (Bos, De Marchi, Sommariva & Vianello 2010,
// SIAM J. Numer. Anal. 48, 1984).
#pragma once

#include "numerics/chebyshev.hpp"

#include <cstddef>
#include <vector>

namespace wfpsf {

// Newton's form: the first polynomial is one everywhere, each further one is one at a place of its
// own and zero at the places of all before it. Where values are known to a polynomial of some
// degree, those of the next one tell its error: their places stand where it errs most.
class LejaPolynomials {
  public:
    LejaPolynomials();

    // Adds those of the next degree, up to largest_chebyshev_degree.
    void raise();
    int degree() const { return degree_; }
    // All up to a degree.
    static constexpr size_t count(int degree) {
        return static_cast<size_t>((degree + 1) * (degree + 2) / 2);
    }

    double u(size_t k) const { return node(place_[k] % across); } // the place of polynomial k
    double v(size_t k) const { return node(place_[k] / across); }
    // Polynomial k at the place of another one.
    double at_place_of(size_t k, size_t other) const { return polynomial_[k].value[place_[other]]; }
    // What polynomial k has of T_i(u) T_j(v): by i + j, and then by j.
    double coefficient(size_t k, size_t ij) const {
        const std::vector<double> &own = polynomial_[k].coefficient;
        return ij < own.size() ? own[ij] : 0;
    }

  private:
    // Chebyshev's extreme points of all degrees that are powers of two are among the candidates.
    static constexpr int finest = 2 * largest_chebyshev_degree;
    static constexpr size_t across = finest + 1;
    static double node(size_t i) { return chebyshev_node(static_cast<int>(i), finest); }

    struct Polynomial {
        std::vector<double> value;       // by candidate
        std::vector<double> coefficient; // by i + j, and then by j
        void scale(double factor);
        void subtract(double times, const Polynomial &other);
    };

    int degree_ = 0;
    std::vector<Polynomial> polynomial_;
    std::vector<size_t> place_; // among the candidates
};

} // namespace wfpsf
