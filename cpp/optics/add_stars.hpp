// SPDX-License-Identifier: GPL-3.0-or-later
// Stars added to some rows of an image, so that threads can share it.
#pragma once

#include "image/view.hpp"
#include "numerics/bands.hpp"
#include "optics/field.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

// Rows first..last of an image.
template <class T> class StarRows {
  public:
    StarRows(int64_t oversampling, View<T> image, int64_t first, int64_t last)
        : oversampling_(oversampling), image_(image), first_(first), last_(last) {}

    bool reached_by(const Star &star, double radius) const { return !window(star, radius).empty(); }

    // A star's light within `radius` native pixels of it along both axes, clipped at the borders.
    void add(const Field &field, const Star &star, double radius) {
        const Window w = window(star, radius);
        if (w.empty())
            return;
        if (stamp_.nx() != w.x1 - w.x0 + 1 || stamp_.ny() != w.y1 - w.y0 + 1)
            stamp_ = Plane<double>(w.x1 - w.x0 + 1, w.y1 - w.y0 + 1);
        field.draw(
            {star.x - static_cast<double>(w.left), star.y - static_cast<double>(w.low), star.flux},
            oversampling_, w.x0 - w.left, w.y0 - w.low, stamp_.view());
        for (int64_t y = w.y0; y <= w.y1; ++y)
            for (int64_t x = w.x0; x <= w.x1; ++x)
                image_(x, y) += static_cast<T>(stamp_(x - w.x0, y - w.y0));
    }

    // As lines of light: line(x, y) is where that of pixels (x, y), (x + 1, y), ... begins.
    template <class Line> void add_lines(const Star &star, double radius, const Line &line) {
        const Window w = window(star, radius);
        const int64_t count = w.x1 - w.x0 + 1;
        for (int64_t y = w.y0; count > 0 && y <= w.y1; ++y) {
            const auto *const __restrict light = line(w.x0, w.x1, y);
            T *const __restrict pixel = &image_(w.x0, y);
            if (image_.stride_x == 1) // vector instructions
                for (int64_t i = 0; i < count; ++i)
                    pixel[i] += static_cast<T>(light[i]);
            else
                for (int64_t i = 0; i < count; ++i)
                    pixel[i * image_.stride_x] += static_cast<T>(light[i]);
        }
    }

  private:
    struct Window {
        int64_t left = 0, low = 0;                // of the whole stamp
        int64_t x0 = 0, y0 = 0, x1 = -1, y1 = -1; // of what is drawn
        bool empty() const { return x0 > x1 || y0 > y1; }
    };
    Window window(const Star &star, double native_radius) const {
        const double radius = native_radius * static_cast<double>(oversampling_);
        // Far from the image nothing is done, and nothing overflows.
        if (star.x < -radius || star.x > static_cast<double>(image_.nx) + radius ||
            star.y < -radius || star.y > static_cast<double>(image_.ny) + radius)
            return {};
        const auto left = static_cast<int64_t>(std::ceil(star.x - radius));
        const auto low = static_cast<int64_t>(std::ceil(star.y - radius));
        return {left,
                low,
                std::max<int64_t>(left, 0),
                std::max(low, first_),
                std::min(static_cast<int64_t>(std::floor(star.x + radius)), image_.nx - 1),
                std::min(static_cast<int64_t>(std::floor(star.y + radius)), last_)};
    }

    int64_t oversampling_;
    View<T> image_;
    int64_t first_, last_;
    Plane<double> stamp_;
};

// work(first, last) for bands of an image's rows, one a thread.
template <class Work> void on_bands_of_rows(int64_t rows, int threads, const Work &work) {
    const auto bands = std::clamp<int64_t>(threads, 1, std::max<int64_t>(rows, 1));
    for_each_band(bands,
                  [&](int64_t band) { work(rows * band / bands, rows * (band + 1) / bands - 1); });
}

// Of those rows alone, of 1 or more, that stars reach from `low` to `high`.
template <class Work>
void on_bands_of_rows(double low, double high, int64_t rows, int threads, const Work &work) {
    const auto last = static_cast<double>(rows - 1);
    const auto first = static_cast<int64_t>(std::floor(std::clamp(low, 0.0, last)));
    const auto end = static_cast<int64_t>(std::ceil(std::clamp(high, 0.0, last))) + 1;
    on_bands_of_rows(end - first, threads, [&](int64_t first_row, int64_t last_row) {
        work(first + first_row, first + last_row);
    });
}

} // namespace wfpsf
