// SPDX-License-Identifier: GPL-3.0-or-later
// IPC applied to an image: out(p) = sum over d of K(d) in(p - tap_step d).
#pragma once

#include "detector/ipc_kernel.hpp"
#include "image/view.hpp"

namespace wfpsf {

// What stands for the charge outside the image, and what becomes of border pixels, those within
// reach * tap_step of an edge. Each has a result for images of any size, smaller than the kernel
// too.
enum class Edge : int32_t {
    zero = 0,      // no charge outside; what leaks out is lost
    replicate = 1, // the first and last tap_step samples are repeated without end
    wrap = 2,      // the image is periodic; charge is conserved
    crop = 3,      // border pixels keep their input value
    fill = 4,      // border pixels take the value `fill`
    valid = 5,     // there are no border pixels: out is smaller by the reach on each side, or empty
};

// Taps stand tap_step samples apart: 1 on a native image, N on one that samples the native pixel N
// times along each axis. If both its sizes are multiples of N, the result equals the interleave
// (Eq. 28 of the paper) of its N^2 native images with IPC, for every Edge.
//
// Any strides; in and out must not share memory. Sums are double. Taps of zero are skipped, so that
// a NaN or an infinity spreads only to pixels that it couples to. `fill` is used by Edge::fill
// alone, and may be NaN.
void convolve(const IpcKernel &kernel, View<const float> in, Edge edge, double fill,
              int64_t tap_step, View<float> out);
void convolve(const IpcKernel &kernel, View<const double> in, Edge edge, double fill,
              int64_t tap_step, View<double> out);

} // namespace wfpsf
