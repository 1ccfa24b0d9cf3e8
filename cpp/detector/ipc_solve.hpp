// SPDX-License-Identifier: GPL-3.0-or-later
// The exact inverse of IPC: the image that gives the one observed.
#pragma once

#include "detector/chebyshev.hpp"
#include "detector/ipc_convolve.hpp"

namespace wfpsf {

struct SolveLimits {
    double least_margin = 1e-3; // of the kernel: below it the inverse is refused
    double tolerance = 1e-15;   // the residual to stop at
    int64_t most_passes = 1000;
};

// Single precision ends long before: an error of 1e-9 is lost in its rounding.
template <class T> inline constexpr double least_tolerance = sizeof(T) == 4 ? 1e-9 : 1e-16;

struct Solution {
    double residual = 0;            // max |in - K out| / max |in|
    double noise_amplification = 1; // rms of white noise after the inverse, over the rms before
    double margin = 1;              // min |K^|: errors of in grow by 1 / margin at most
    int64_t passes = 0;             // over the image; 0: solved by a transform
    int64_t not_finite = 0;         // pixels NaN or infinite: they count as 0 and stay as they are
    bool converged = true;          // the residual is at the tolerance, or at its floor of rounding
};

// rms of white noise of rms 1 after division by K^. Infinite where K^ is zero.
double inverse_noise_amplification(const IpcKernel &kernel);

// The interval of the real parts of K^.
SpectralInterval real_spectrum(const IpcKernel &kernel);

// Zero, replicate or wrap, or WFPSF_ERROR_ARGUMENT.
void require_invertible_edge(Edge edge);

// Edges zero, replicate and wrap, as convolve() has them. Solved by Chebyshev's iteration, or by a
// transform where the iteration would be slow and a transform has it exact: a periodic image, or a
// kernel of 3 x 3 taps that is symmetric left-right and up-down. A kernel below the least margin:
// WFPSF_ERROR_KERNEL_SINGULAR.
Solution solve_ipc(const IpcKernel &kernel, View<const float> in, const Convolution &how,
                   const SolveLimits &limits, View<float> out);
Solution solve_ipc(const IpcKernel &kernel, View<const double> in, const Convolution &how,
                   const SolveLimits &limits, View<double> out);

// The largest absolute value of a pixel, which residuals are measured in.
double largest_magnitude(View<const double> image);

} // namespace wfpsf
