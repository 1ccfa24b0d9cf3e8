// SPDX-License-Identifier: GPL-3.0-or-later
// Weighted sums of many neighbouring samples at once.
#pragma once

#include <cstdint>

namespace wfpsf {

// Outputs are summed in blocks of so many, always whole ones, so that the bits of one do not depend
// on where a range ends. The compiler keeps a block in vector registers; a shorter one it unrolls,
// and makes no vectors of.
inline constexpr int64_t block = 32;

inline int64_t blocks_for(int64_t count) {
    return (count + block - 1) / block * block;
}

// sums[i] = sum over the taps of weights[tap] * input(tap)[i], for whole blocks of i. The taps of
// one remainder modulo `step` read from starts[remainder] on, each `stride` after the one before.
void sum_blocks(const double *weights, int64_t taps, const double *const *starts, int64_t step,
                int64_t stride, int64_t count, double *sums);
void sum_blocks(const float *weights, int64_t taps, const float *const *starts, int64_t step,
                int64_t stride, int64_t count, float *sums);

// sums[i] += weight * values[i].
void add_scaled(double weight, const double *values, int64_t count, double *sums);
void add_scaled(float weight, const float *values, int64_t count, float *sums);

// The largest absolute value; or most[i] = the larger of it and that of values[i].
double largest(const double *values, int64_t count);
float largest(const float *values, int64_t count);
void keep_largest(const double *values, int64_t count, double *most);
void keep_largest(const float *values, int64_t count, float *most);

} // namespace wfpsf
