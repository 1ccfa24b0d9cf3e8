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

struct Convolution {
    Edge edge = Edge::zero;
    double fill = 0;      // of Edge::fill alone; may be NaN
    int64_t tap_step = 1; // samples between taps
    int threads = 1;      // they share the rows; the bits are the same for any number
};

// `taps` is a table of odd sizes, its middle K(0, 0); it need not sum to 1.
//
// Taps stand tap_step samples apart: 1 on a native image, N on one that samples the native pixel N
// times along each axis. If both its sizes are multiples of N, the result equals the interleave
// (Eq. 28 of the paper) of its N^2 native images with IPC, for every Edge.
//
// Any strides; out may be in itself, else they must not share memory. Sums are double. Taps of zero
// are skipped, so that a NaN or an infinity spreads only to pixels that it couples to.
void convolve(View<const double> taps, View<const float> in, const Convolution &how,
              View<float> out);
void convolve(View<const double> taps, View<const double> in, const Convolution &how,
              View<double> out);

// out += weight * addend, in the same pass over memory. addend has out's size and does not share
// memory with it; edges zero, replicate and wrap.
struct Addend {
    View<const double> image;
    double weight;
};
void convolve_and_add(View<const double> taps, View<const double> in, const Convolution &how,
                      const Addend &addend, View<double> out);

inline void convolve(const IpcKernel &kernel, View<const float> in, const Convolution &how,
                     View<float> out) {
    convolve(kernel.table(), in, how, out);
}
inline void convolve(const IpcKernel &kernel, View<const double> in, const Convolution &how,
                     View<double> out) {
    convolve(kernel.table(), in, how, out);
}

} // namespace wfpsf
