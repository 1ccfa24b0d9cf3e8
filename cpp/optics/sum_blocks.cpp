// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/sum_blocks.hpp"

#include "numerics/dispatch.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

namespace {

template <class S>
[[gnu::always_inline]] inline void sum_blocks_of(const S *weights, int64_t taps,
                                                 const S *const *starts, int64_t step,
                                                 int64_t stride, int64_t count, S *sums) {
    for (int64_t begin = 0; begin < count; begin += block) {
        S registers[block];
        for (int64_t i = 0; i < block; ++i)
            registers[i] = 0;
        for (int64_t remainder = 0; remainder < step; ++remainder) {
            const S *__restrict inputs = starts[remainder] + begin;
            for (int64_t tap = remainder; tap < taps; tap += step, inputs += stride)
                for (int64_t i = 0; i < block; ++i)
                    registers[i] += weights[tap] * inputs[i];
        }
        for (int64_t i = 0; i < block; ++i)
            sums[begin + i] = registers[i];
    }
}

template <class S> [[gnu::always_inline]] inline S largest_of(const S *values, int64_t count) {
    S most[block] = {};
    int64_t i = 0;
    for (; i + block <= count; i += block)
        for (int64_t k = 0; k < block; ++k)
            most[k] = std::max(most[k], std::abs(values[i + k]));
    for (; i < count; ++i)
        most[0] = std::max(most[0], std::abs(values[i]));
    return *std::max_element(most, most + block);
}

} // namespace

WFPSF_VECTORISED void sum_blocks(const double *weights, int64_t taps, const double *const *starts,
                                 int64_t step, int64_t stride, int64_t count, double *sums) {
    sum_blocks_of(weights, taps, starts, step, stride, count, sums);
}

WFPSF_VECTORISED void sum_blocks(const float *weights, int64_t taps, const float *const *starts,
                                 int64_t step, int64_t stride, int64_t count, float *sums) {
    sum_blocks_of(weights, taps, starts, step, stride, count, sums);
}

WFPSF_VECTORISED void add_scaled(double weight, const double *__restrict values, int64_t count,
                                 double *__restrict sums) {
    for (int64_t i = 0; i < count; ++i)
        sums[i] += weight * values[i];
}

WFPSF_VECTORISED void add_scaled(float weight, const float *__restrict values, int64_t count,
                                 float *__restrict sums) {
    for (int64_t i = 0; i < count; ++i)
        sums[i] += weight * values[i];
}

WFPSF_VECTORISED double largest(const double *values, int64_t count) {
    return largest_of(values, count);
}

WFPSF_VECTORISED float largest(const float *values, int64_t count) {
    return largest_of(values, count);
}

WFPSF_VECTORISED void keep_largest(const double *__restrict values, int64_t count,
                                   double *__restrict most) {
    for (int64_t i = 0; i < count; ++i)
        most[i] = std::max(most[i], std::abs(values[i]));
}

WFPSF_VECTORISED void keep_largest(const float *__restrict values, int64_t count,
                                   float *__restrict most) {
    for (int64_t i = 0; i < count; ++i)
        most[i] = std::max(most[i], std::abs(values[i]));
}

} // namespace wfpsf
