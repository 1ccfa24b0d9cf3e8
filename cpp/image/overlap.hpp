// SPDX-License-Identifier: GPL-3.0-or-later
// Do two views share memory?
#pragma once

#include "image/view.hpp"

#include <algorithm>
#include <cstdlib>

namespace wfpsf {

namespace overlap_detail {

// The bytes of a view as equally long spans in rising order, one for each step along its longer
// stride. Gaps between the pixels of a span count as part of it.
struct Spans {
    uintptr_t first, length, step;
    int64_t count;
    uintptr_t begin(int64_t i) const { return first + static_cast<uintptr_t>(i) * step; }
    uintptr_t end(int64_t i) const { return begin(i) + length; }
};

template <class T> Spans spans(View<T> v) {
    const auto lowest = [](int64_t n, int64_t stride) { return stride < 0 ? (n - 1) * stride : 0; };
    const auto bytes = [](int64_t elements) {
        return static_cast<uintptr_t>(elements) * sizeof(T);
    };
    int64_t n = v.nx, stride = std::abs(v.stride_x), count = v.ny, step = std::abs(v.stride_y);
    if (stride > step) {
        std::swap(n, count);
        std::swap(stride, step);
    }
    const int64_t corner = lowest(v.nx, v.stride_x) + lowest(v.ny, v.stride_y);
    return {reinterpret_cast<uintptr_t>(v.data + corner), bytes((n - 1) * stride + 1), bytes(step),
            count};
}

} // namespace overlap_detail

// Exact for rows (of the longer stride) as a whole: two halves of one image do not overlap, but
// interleaved columns of the same rows are said to.
template <class A, class B> bool shares_memory(View<A> a, View<B> b) {
    if (a.empty() || b.empty())
        return false;
    const auto s = overlap_detail::spans(a), t = overlap_detail::spans(b);
    if (s.end(s.count - 1) <= t.begin(0) || t.end(t.count - 1) <= s.begin(0))
        return false;
    for (int64_t i = 0, j = 0; i < s.count && j < t.count;) {
        if (s.end(i) <= t.begin(j))
            ++i;
        else if (t.end(j) <= s.begin(i))
            ++j;
        else
            return true;
    }
    return false;
}

} // namespace wfpsf
