// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/merit.hpp"

#include <cmath>
#include <numbers>

namespace wfpsf {

// With u = (t, v), the weight after a step (d, H) is exp(q), q = -(u - d)^T exp(-H) (u - d)/2. The
// derivatives of the sum of f w^n are the sums of f w^n times n dq, and n ddq + n^2 dq dq.
Merit power_sum(const WeightedSums &sums, int n) {
    const auto m = [&](int j, int k) { return sums.sum[j][k]; };
    constexpr double root = std::numbers::sqrt2;
    const double m00 = m(0, 0), m10 = m(1, 0), m01 = m(0, 1), m20 = m(2, 0), m11 = m(1, 1),
                 m02 = m(0, 2);

    const double dq[5] = {m10, m01, m20 / 2, m11 / root, m02 / 2};
    const double dqdq[5][5] = {{m20, m11, m(3, 0) / 2, m(2, 1) / root, m(1, 2) / 2},
                               {0, m02, m(2, 1) / 2, m(1, 2) / root, m(0, 3) / 2},
                               {0, 0, m(4, 0) / 4, m(3, 1) / (2 * root), m(2, 2) / 4},
                               {0, 0, 0, m(2, 2) / 2, m(1, 3) / (2 * root)},
                               {0, 0, 0, 0, m(0, 4) / 4}};
    const double ddq[5][5] = {{-m00, 0, -m10, -m01 / root, 0},
                              {0, -m00, 0, -m10 / root, -m01},
                              {0, 0, -m20 / 2, -m11 / (2 * root), 0},
                              {0, 0, 0, -(m20 + m02) / 4, -m11 / (2 * root)},
                              {0, 0, 0, 0, -m02 / 2}};
    Merit result;
    result.value = m00;
    for (int i = 0; i < 5; ++i) {
        result.gradient[i] = n * dq[i];
        for (int k = i; k < 5; ++k)
            result.hessian[i][k] = result.hessian[k][i] = n * ddq[i][k] + n * n * dqdq[i][k];
    }
    return result;
}

Merit plane_norm(const Gaussian &weight) {
    const double area = std::numbers::pi * std::sqrt(weight.det());
    Merit result;
    result.value = area;
    for (const int i : {2, 4}) {
        result.gradient[i] = area / 2;
        for (const int k : {2, 4})
            result.hessian[i][k] = area / 4;
    }
    return result;
}

Merit operator-(const Merit &a, const Merit &b) {
    Merit result;
    result.value = a.value - b.value;
    for (int i = 0; i < 5; ++i) {
        result.gradient[i] = a.gradient[i] - b.gradient[i];
        for (int k = 0; k < 5; ++k)
            result.hessian[i][k] = a.hessian[i][k] - b.hessian[i][k];
    }
    return result;
}

Merit operator*(const Merit &f, double factor) {
    Merit result = f;
    result.value *= factor;
    for (int i = 0; i < 5; ++i) {
        result.gradient[i] *= factor;
        for (double &h : result.hessian[i])
            h *= factor;
    }
    return result;
}

Merit square(const Merit &f) {
    Merit result;
    result.value = f.value * f.value;
    for (int i = 0; i < 5; ++i) {
        result.gradient[i] = 2 * f.value * f.gradient[i];
        for (int k = 0; k < 5; ++k)
            result.hessian[i][k] = 2 * (f.value * f.hessian[i][k] + f.gradient[i] * f.gradient[k]);
    }
    return result;
}

Merit log(const Merit &f) {
    Merit result;
    result.value = std::log(f.value);
    for (int i = 0; i < 5; ++i)
        result.gradient[i] = f.gradient[i] / f.value;
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k < 5; ++k)
            result.hessian[i][k] =
                f.hessian[i][k] / f.value - result.gradient[i] * result.gradient[k];
    return result;
}

Merit merit(const WeightedSums &sums, const Merit &norm) {
    return log(power_sum(sums, 1)) - log(norm) * 0.5;
}

} // namespace wfpsf
