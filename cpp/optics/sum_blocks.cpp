// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/sum_blocks.hpp"

#include "numerics/dispatch.hpp"

namespace wfpsf {

WFPSF_VECTORISED void sum_blocks(const double *weights, int64_t taps, const double *const *starts,
                                 int64_t step, int64_t stride, int64_t count, double *sums) {
    for (int64_t begin = 0; begin < count; begin += block) {
        double registers[block];
        for (int64_t i = 0; i < block; ++i)
            registers[i] = 0;
        for (int64_t remainder = 0; remainder < step; ++remainder) {
            const double *__restrict inputs = starts[remainder] + begin;
            for (int64_t tap = remainder; tap < taps; tap += step, inputs += stride)
                for (int64_t i = 0; i < block; ++i)
                    registers[i] += weights[tap] * inputs[i];
        }
        for (int64_t i = 0; i < block; ++i)
            sums[begin + i] = registers[i];
    }
}

WFPSF_VECTORISED void add_scaled(double weight, const double *__restrict values, int64_t count,
                                 double *__restrict sums) {
    for (int64_t i = 0; i < count; ++i)
        sums[i] += weight * values[i];
}

} // namespace wfpsf
