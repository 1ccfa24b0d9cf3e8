// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/weight_jet.hpp"

#include <numbers>

#include <Eigen/Dense>

namespace wfpsf {

namespace {

using Vector = Eigen::Vector2d;
using Matrix = Eigen::Matrix2d;

// A polynomial in the whitened coordinates t, v: c[j][k] t^j v^k.
struct Polynomial {
    double c[7][7] = {};
    int degree = 0;

    Polynomial &operator+=(const Polynomial &other) {
        degree = std::max(degree, other.degree);
        for (int j = 0; j <= other.degree; ++j)
            for (int k = 0; j + k <= other.degree; ++k)
                c[j][k] += other.c[j][k];
        return *this;
    }
};

Polynomial operator*(const Polynomial &a, const Polynomial &b) {
    Polynomial product;
    product.degree = a.degree + b.degree;
    for (int j = 0; j <= a.degree; ++j)
        for (int k = 0; j + k <= a.degree; ++k)
            for (int l = 0; l <= b.degree; ++l)
                for (int m = 0; l + m <= b.degree; ++m)
                    product.c[j + l][k + m] += a.c[j][k] * b.c[l][m];
    return product;
}

Polynomial quadratic(double constant, const Vector &linear, const Matrix &square) {
    Polynomial p;
    p.degree = 2;
    p.c[0][0] = constant;
    p.c[1][0] = linear[0];
    p.c[0][1] = linear[1];
    p.c[2][0] = square(0, 0);
    p.c[1][1] = square(0, 1) + square(1, 0);
    p.c[0][2] = square(1, 1);
    return p;
}

Vector shift(const WhitenedStep &a) {
    return {a.t, a.v};
}
Matrix stretch(const WhitenedStep &a) {
    const double off = a.hs / std::numbers::sqrt2;
    return Matrix{{a.htt, off}, {off, a.hvv}};
}

// With u = (t, v) the exponent after a step (d, H) is q = -(u - d)^T exp(-H) (u - d)/2. Its parts
// of first, second and third order in the step are
//   u d + u H u/2,   -d d/2 - u H d - u H^2 u/4,   d H d/2 + u H^2 d/2 + u H^3 u/12;
// a derivative along given steps is the sum over all orders of them.
Polynomial first(const WhitenedStep &a) {
    return quadratic(0, shift(a), stretch(a) / 2);
}

Polynomial second(const WhitenedStep &a, const WhitenedStep &b) {
    const Vector d = shift(a), e = shift(b);
    const Matrix A = stretch(a), B = stretch(b);
    return quadratic(-d.dot(e), -(A * e + B * d), -(A * B + B * A) / 4);
}

Polynomial third(const WhitenedStep &a, const WhitenedStep &b, const WhitenedStep &c) {
    Polynomial sum;
    const WhitenedStep *orders[6][3] = {{&a, &b, &c}, {&a, &c, &b}, {&b, &a, &c},
                                        {&b, &c, &a}, {&c, &a, &b}, {&c, &b, &a}};
    for (const auto &[p, q, r] : orders) {
        const Matrix P = stretch(*p), Q = stretch(*q), R = stretch(*r);
        sum += quadratic(shift(*p).dot(Q * shift(*r)) / 2, P * Q * shift(*r) / 2, P * Q * R / 12);
    }
    return sum;
}

double mean(const WeightedSums &sums, const Polynomial &p) {
    double total = 0;
    for (int j = 0; j <= p.degree; ++j)
        for (int k = 0; j + k <= p.degree; ++k)
            total += p.c[j][k] * sums.sum[j][k];
    return total;
}

} // namespace

double WeightJet::along(const WhitenedStep &a) const {
    return n_ * mean(sums_, first(a));
}

double WeightJet::along(const WhitenedStep &a, const WhitenedStep &b) const {
    return n_ * mean(sums_, second(a, b)) + n_ * n_ * mean(sums_, first(a) * first(b));
}

double WeightJet::along(const WhitenedStep &a, const WhitenedStep &b, const WhitenedStep &c) const {
    Polynomial products = second(a, b) * first(c);
    products += second(a, c) * first(b);
    products += second(b, c) * first(a);
    return n_ * mean(sums_, third(a, b, c)) + n_ * n_ * mean(sums_, products) +
           n_ * n_ * n_ * mean(sums_, first(a) * first(b) * first(c));
}

} // namespace wfpsf
