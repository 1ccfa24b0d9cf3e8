// SPDX-License-Identifier: GPL-3.0-or-later
// The inverse of a symmetric 3 x 3 kernel in two passes over an image: a Fourier transform along
// each row leaves, for every frequency, a tridiagonal system across the rows.
#pragma once

#include "detector/ipc_kernel.hpp"
#include "numerics/plane_filter.hpp"

namespace wfpsf {

// In place. The kernel is symmetric left-right and up-down, at most 3 x 3, its transform positive.
//
// Rows are continued as far as the inverse reaches, exp(-reach x decay) being lost in rounding, so
// that any length that FFTW likes will do. An image shorter than that reach: false, and nothing is
// done.
bool divide_by_sweeps(const IpcKernel &kernel, Continuation continuation, View<double> image);

} // namespace wfpsf
