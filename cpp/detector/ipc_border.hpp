// SPDX-License-Identifier: GPL-3.0-or-later
// What passes over an image with neighbours share: where its border is and what lies beyond.
#pragma once

#include "detector/ipc_convolve.hpp"
#include "error/error.hpp"

#include <algorithm>

namespace wfpsf {

// One axis of the pass. Output i stands at input sample first + i; taps are `step` samples apart
// and reach out to `reach` of them.
struct Axis {
    int64_t input_size, first, count, reach, step;
    int64_t margin() const { return reach * step; }
};

// Steps longer than the image act as one of its length does, which bounds the margins.
inline Axis make_axis(int64_t n, int64_t reach, int64_t tap_step, Edge edge) {
    const int64_t step = edge == Edge::wrap ? (tap_step - 1) % n + 1 : std::min(tap_step, n);
    Axis axis{n, 0, n, reach, step};
    if (edge == Edge::crop || edge == Edge::fill || edge == Edge::valid) {
        axis.first = axis.margin();
        axis.count = std::max<int64_t>(n - 2 * axis.margin(), 0);
    }
    return axis;
}

inline int64_t floor_mod(int64_t i, int64_t n) {
    return (i % n + n) % n;
}

// The input sample that stands at index i of an axis, -1 if there is none.
inline int64_t source_index(int64_t i, const Axis &axis, Edge edge) {
    const int64_t n = axis.input_size;
    if (i >= 0 && i < n)
        return i;
    if (edge == Edge::wrap)
        return floor_mod(i, n);
    if (edge == Edge::replicate)
        return floor_mod(i < 0 ? i : i - n, axis.step) + (i < 0 ? 0 : n - axis.step);
    return -1;
}

// Calls value(x, y) for the pixels of out that the axes leave out.
template <class T, class Value>
void set_border(const Axis &x_axis, const Axis &y_axis, Value value, View<T> out) {
    const int64_t right = x_axis.first + x_axis.count;
    for (int64_t y = 0; y < out.ny; ++y) {
        const bool inside_y = y >= y_axis.first && y < y_axis.first + y_axis.count;
        for (int64_t x = 0; x < out.nx; ++x) {
            if (inside_y && x == x_axis.first)
                x = right;
            if (x < out.nx)
                out(x, y) = value(x, y);
        }
    }
}

template <class T> bool are_same(View<const T> in, View<T> out) {
    return in.data == out.data && in.nx == out.nx && in.ny == out.ny &&
           in.stride_x == out.stride_x && in.stride_y == out.stride_y;
}

template <class T>
void require_out_size(View<const T> in, const Axis &x, const Axis &y, Edge edge, View<T> out) {
    int64_t nx = in.nx, ny = in.ny;
    if (edge == Edge::valid) {
        nx = nx == 0 ? 0 : x.count;
        ny = ny == 0 ? 0 : y.count;
    }
    if (out.nx != nx || out.ny != ny)
        fail(WFPSF_ERROR_SIZE, "out has %lld x %lld pixels: must have %lld x %lld",
             static_cast<long long>(out.nx), static_cast<long long>(out.ny),
             static_cast<long long>(nx), static_cast<long long>(ny));
}

} // namespace wfpsf
