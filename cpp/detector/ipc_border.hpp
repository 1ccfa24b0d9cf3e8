// SPDX-License-Identifier: GPL-3.0-or-later
// What passes over an image with neighbours share: where its border is and what lies beyond.
#pragma once

#include "detector/ipc_convolve.hpp"
#include "error/error.hpp"
#include "image/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

struct Reach {
    int64_t x, y;
};

// Checks the arguments, calls pass(x axis, y axis, whether it is in place, its part of out) unless
// that part is empty, and sets the pixels that the pass leaves out. `pass` must leave alone what it
// has yet to read, if it is in place.
template <class T, class Pass>
void run_framed(View<const T> in, Reach reach, const Convolution &how, View<T> out,
                const Pass &pass) {
    const Edge edge = how.edge;
    if (edge < Edge::zero || edge > Edge::valid)
        fail(WFPSF_ERROR_ARGUMENT, "edge = %d: must be 0..%d", static_cast<int>(edge),
             static_cast<int>(Edge::valid));
    if (how.tap_step < 1)
        fail(WFPSF_ERROR_RANGE, "tap_step = %lld: must be at least 1",
             static_cast<long long>(how.tap_step));
    if (edge == Edge::fill && std::isfinite(how.fill) &&
        std::fabs(how.fill) > static_cast<double>(std::numeric_limits<T>::max()))
        fail(WFPSF_ERROR_RANGE, "fill = %g: too large for the pixel type", how.fill);
    const Axis x = make_axis(std::max<int64_t>(in.nx, 1), reach.x, how.tap_step, edge);
    const Axis y = make_axis(std::max<int64_t>(in.ny, 1), reach.y, how.tap_step, edge);
    require_out_size(in, x, y, edge, out);
    if (out.empty())
        return;
    const bool in_place = are_same(in, out);
    if (!in_place && shares_memory(in, out))
        fail(WFPSF_ERROR_OVERLAP,
             "in and out share memory in part: give out its own, or the very pixels of in");

    if (x.count > 0 && y.count > 0) {
        const bool bordered = edge == Edge::crop || edge == Edge::fill;
        const View<T> target =
            bordered ? View<T>{&out(x.first, y.first), x.count, y.count, out.stride_x, out.stride_y}
                     : out;
        pass(x, y, in_place, target);
    }
    if (edge == Edge::crop && !in_place)
        set_border(
            x, y, [&](int64_t i, int64_t j) { return in(i, j); }, out);
    if (edge == Edge::fill)
        set_border(
            x, y, [&](int64_t, int64_t) { return static_cast<T>(how.fill); }, out);
}

} // namespace wfpsf
