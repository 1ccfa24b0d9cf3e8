// SPDX-License-Identifier: GPL-3.0-or-later
// A strided window on pixels that somebody else owns. Pixel (x, y) stands at
// data[y * stride_y + x * stride_x]; its centre is at the integers (x, y); strides may be negative.
#pragma once

#include "image/memory.hpp"

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace wfpsf {

template <class T> struct View {
    T *data = nullptr;
    int64_t nx = 0, ny = 0;
    int64_t stride_x = 1, stride_y = 0;

    T &operator()(int64_t x, int64_t y) const { return data[y * stride_y + x * stride_x]; }
    T *row(int64_t y) const { return data + y * stride_y; }
    bool empty() const { return nx == 0 || ny == 0; }
    operator View<const T>() const requires(!std::is_const_v<T>) {
        return {data, nx, ny, stride_x, stride_y};
    }
};

// Pixels with an owner, x fastest; contiguous unless every row is asked to begin a cache line.
template <class T> class Plane {
  public:
    Plane() = default;
    Plane(int64_t nx, int64_t ny)
        : nx_(nx), ny_(ny), stride_(nx),
          pixels_(static_cast<size_t>(nx) * static_cast<size_t>(ny), T()) {}
    // The pixels of these two hold no value before they are given one.
    static Plane unset(int64_t nx, int64_t ny) { return Plane(nx, ny, nx); }
    static Plane with_aligned_rows(int64_t nx, int64_t ny) {
        constexpr auto line = static_cast<int64_t>(cache_line / sizeof(T));
        return Plane(nx, ny, (nx + line - 1) / line * line);
    }
    int64_t nx() const { return nx_; }
    int64_t ny() const { return ny_; }
    T &operator()(int64_t x, int64_t y) { return pixels_[static_cast<size_t>(y * stride_ + x)]; }
    const T &operator()(int64_t x, int64_t y) const {
        return pixels_[static_cast<size_t>(y * stride_ + x)];
    }
    View<T> view() { return {pixels_.data(), nx_, ny_, 1, stride_}; }
    View<const T> view() const { return {pixels_.data(), nx_, ny_, 1, stride_}; }

  private:
    Plane(int64_t nx, int64_t ny, int64_t stride)
        : nx_(nx), ny_(ny), stride_(stride),
          pixels_(static_cast<size_t>(stride) * static_cast<size_t>(ny)) {}

    int64_t nx_ = 0, ny_ = 0, stride_ = 0;
    std::vector<T, AlignedAllocator<T>> pixels_;
};

} // namespace wfpsf
