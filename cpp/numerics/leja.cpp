// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/leja.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wfpsf {

namespace {

// What (u + v)^(i + j) has of T_i(u) T_j(v): functions that vary along all slants alike need the
// mixed ones most.
double usual_part(int i, int j) {
    return std::tgamma(i + j + 1) / (std::tgamma(i + 1) * std::tgamma(j + 1)) *
           std::exp2(-std::max(i - 1, 0) - std::max(j - 1, 0));
}

} // namespace

void LejaPolynomials::Polynomial::scale(double factor) {
    for (double &x : value)
        x *= factor;
    for (double &x : coefficient)
        x *= factor;
}

void LejaPolynomials::Polynomial::subtract(double times, const Polynomial &other) {
    for (size_t i = 0; i < value.size(); ++i)
        value[i] -= times * other.value[i];
    for (size_t i = 0; i < other.coefficient.size(); ++i)
        coefficient[i] -= times * other.coefficient[i];
}

LejaPolynomials::LejaPolynomials()
    : polynomial_{{std::vector<double>(across * across, 1.0), {1.0}}}, place_{across * across / 2} {
}

// Elimination with pivots: the largest value that any of what is left has anywhere.
void LejaPolynomials::raise() {
    ++degree_;
    std::vector<Polynomial> left;
    for (int j = 0; j <= degree_; ++j) {
        Polynomial &own = left.emplace_back();
        const double part = usual_part(degree_ - j, j);
        for (size_t p = 0; p < across * across; ++p)
            own.value.push_back(
                part * chebyshev(node(p % across), degree_)[static_cast<size_t>(degree_ - j)] *
                chebyshev(node(p / across), degree_)[static_cast<size_t>(j)]);
        own.coefficient.resize(count(degree_));
        own.coefficient[count(degree_ - 1) + static_cast<size_t>(j)] = part;
        for (size_t k = 0; k < polynomial_.size(); ++k)
            own.subtract(own.value[place_[k]], polynomial_[k]);
    }
    while (!left.empty()) {
        constexpr double hair = 1e-9; // so that roundings do not choose between equal places
        size_t which = 0, place = 0;
        double most = 0;
        for (size_t l = 0; l < left.size(); ++l)
            for (size_t p = 0; p < across * across; ++p)
                if (std::abs(left[l].value[p]) > (1 + hair) * most) {
                    most = std::abs(left[l].value[p]);
                    which = l;
                    place = p;
                }
        std::swap(left[which], left.back());
        Polynomial next = std::move(left.back());
        left.pop_back();
        next.scale(1 / next.value[place]);
        for (Polynomial &other : left)
            other.subtract(other.value[place], next);
        polynomial_.push_back(std::move(next));
        place_.push_back(place);
    }
}

} // namespace wfpsf
