// SPDX-License-Identifier: GPL-3.0-or-later
// Covariances, after IPC, of noise that is independent from pixel to pixel before it. If A(p, q) is
// the share of pixel q's charge that pixel p reads, cov(p, p') = sum over q of A(p, q) A(p', q)
// variance(q). Edges zero and wrap.
#pragma once

#include "detector/varying_ipc.hpp"

namespace wfpsf {

struct Lag {
    int64_t x, y; // native pixels
};

// out(p) = cov(p, p + lag); 0 where p + lag is not a pixel. out may be the variance itself.
void covariance(const IpcKernel &kernel, View<const float> variance, Lag lag,
                const Convolution &how, View<float> out);
void covariance(const IpcKernel &kernel, View<const double> variance, Lag lag,
                const Convolution &how, View<double> out);
void covariance(const VaryingIpc &ipc, View<const float> variance, Lag lag,
                const VaryingConvolution &how, View<float> out);
void covariance(const VaryingIpc &ipc, View<const double> variance, Lag lag,
                const VaryingConvolution &how, View<double> out);

// Of pixel (x, y) with all that it may covary with: cov(p, p + d) at (d.x + 2 reach_x, d.y + 2
// reach_y). No variance: 1 everywhere.
Plane<double> neighbour_covariances(const VaryingIpc &ipc, const Image *variance, int64_t x,
                                    int64_t y, const VaryingConvolution &how);

} // namespace wfpsf
