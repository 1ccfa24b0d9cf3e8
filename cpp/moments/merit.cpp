// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/merit.hpp"

#include <cmath>
#include <numbers>

namespace wfpsf {

// With u = (t, v), the weight after a step (d, H) is exp(q), q = -(u - d)^T exp(-H) (u - d)/2.
// The gradient of ln(sum of I w) is <dq>, its Hessian <ddq + dq dq> - <dq><dq>.
Merit merit(const WeightedSums &sums, const Gaussian &weight) {
    const auto m = [&](int j, int k) { return sums.mean(j, k); };
    constexpr double root = std::numbers::sqrt2;
    const double m10 = m(1, 0), m01 = m(0, 1), m20 = m(2, 0), m11 = m(1, 1), m02 = m(0, 2);

    const double dq[5] = {m10, m01, m20 / 2, m11 / root, m02 / 2};
    const double upper[5][5] = {
        {m20 - 1, m11, m(3, 0) / 2 - m10, (m(2, 1) - m01) / root, m(1, 2) / 2},
        {0, m02 - 1, m(2, 1) / 2, (m(1, 2) - m10) / root, m(0, 3) / 2 - m01},
        {0, 0, m(4, 0) / 4 - m20 / 2, (m(3, 1) - m11) / (2 * root), m(2, 2) / 4},
        {0, 0, 0, m(2, 2) / 2 - (m20 + m02) / 4, (m(1, 3) - m11) / (2 * root)},
        {0, 0, 0, 0, m(0, 4) / 4 - m02 / 2}};

    Merit result;
    result.value = std::log(sums.sum[0][0]) - std::log(weight.det()) / 4;
    for (int i = 0; i < 5; ++i) {
        result.gradient[i] = dq[i];
        for (int k = i; k < 5; ++k)
            result.hessian[i][k] = result.hessian[k][i] = upper[i][k] - dq[i] * dq[k];
    }
    result.gradient[2] -= 0.25;
    result.gradient[4] -= 0.25;
    return result;
}

} // namespace wfpsf
