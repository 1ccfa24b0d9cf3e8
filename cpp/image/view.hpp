// SPDX-License-Identifier: GPL-3.0-or-later
// A strided window on pixels that somebody else owns. Pixel (x, y) stands at
// data[y * stride_y + x * stride_x]; its centre is at the integers (x, y); strides may be negative.
#pragma once

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

// Pixels with an owner, contiguous, x fastest.
template <class T> class Plane {
  public:
    Plane() = default;
    Plane(int64_t nx, int64_t ny)
        : nx_(nx), ny_(ny), pixels_(static_cast<size_t>(nx) * static_cast<size_t>(ny)) {}
    int64_t nx() const { return nx_; }
    int64_t ny() const { return ny_; }
    T &operator()(int64_t x, int64_t y) { return pixels_[static_cast<size_t>(y * nx_ + x)]; }
    const T &operator()(int64_t x, int64_t y) const {
        return pixels_[static_cast<size_t>(y * nx_ + x)];
    }
    View<T> view() { return {pixels_.data(), nx_, ny_, 1, nx_}; }
    View<const T> view() const { return {pixels_.data(), nx_, ny_, 1, nx_}; }

  private:
    int64_t nx_ = 0, ny_ = 0;
    std::vector<T> pixels_;
};

} // namespace wfpsf
