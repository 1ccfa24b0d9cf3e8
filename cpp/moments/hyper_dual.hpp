// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that carry their derivatives along two directions, and the mixed second one:
// f(a, b) = value + da a + db b + dab a b. Arithmetic on them is exact differentiation.
#pragma once

#include <cmath>

namespace wfpsf {

struct HyperDual {
    double value = 0, da = 0, db = 0, dab = 0;
    HyperDual() = default;
    HyperDual(double v) : value(v) {}
    HyperDual(double v, double a, double b, double ab) : value(v), da(a), db(b), dab(ab) {}
};

// f(x), from the derivatives of f at x.value.
inline HyperDual chain(const HyperDual &x, double f, double first, double second) {
    return {f, first * x.da, first * x.db, first * x.dab + second * x.da * x.db};
}

inline HyperDual operator+(const HyperDual &x, const HyperDual &y) {
    return {x.value + y.value, x.da + y.da, x.db + y.db, x.dab + y.dab};
}
inline HyperDual operator-(const HyperDual &x, const HyperDual &y) {
    return {x.value - y.value, x.da - y.da, x.db - y.db, x.dab - y.dab};
}
inline HyperDual operator*(const HyperDual &x, const HyperDual &y) {
    return {x.value * y.value, x.da * y.value + x.value * y.da, x.db * y.value + x.value * y.db,
            x.dab * y.value + x.da * y.db + x.db * y.da + x.value * y.dab};
}
inline HyperDual operator/(const HyperDual &x, const HyperDual &y) {
    const double i = 1 / y.value;
    return x * chain(y, i, -i * i, 2 * i * i * i);
}
inline HyperDual sqrt(const HyperDual &x) {
    const double root = std::sqrt(x.value);
    return chain(x, root, 0.5 / root, -0.25 / (root * x.value));
}
inline HyperDual exp(const HyperDual &x) {
    const double e = std::exp(x.value);
    return chain(x, e, e, e);
}
inline HyperDual atan2(const HyperDual &y, const HyperDual &x) {
    const double r2 = x.value * x.value + y.value * y.value, r4 = r2 * r2;
    const double fy = x.value / r2, fx = -y.value / r2, fxx = 2 * x.value * y.value / r4;
    const double fxy = (y.value * y.value - x.value * x.value) / r4;
    return {std::atan2(y.value, x.value), fy * y.da + fx * x.da, fy * y.db + fx * x.db,
            fy * y.dab + fx * x.dab + fxx * (x.da * x.db - y.da * y.db) +
                fxy * (x.da * y.db + y.da * x.db)};
}

} // namespace wfpsf
