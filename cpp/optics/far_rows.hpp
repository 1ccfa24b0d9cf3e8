// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of pixels that far light is drawn on, and what of them is near a spike. Positions are native
// pixels from the star, in the pupil's frame.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace wfpsf {

// Along and across a spike.
struct SpikeAxes {
    double nx, ny;
    double along(double x, double y) const { return nx * x + ny * y; }
    double across(double x, double y) const { return nx * y - ny * x; }
};

// The pixels first..last of a row.
struct Run {
    int64_t first, last;
};

// A row of pixels, the first one at (x, y). Most of a row gets nothing: its blocks are cleared when
// they first get light.
class PixelRow {
  public:
    static constexpr int64_t block = 64;

    // A flag for each block, none of them set.
    PixelRow(double first_x, double row_y, std::span<double> pixels, std::span<uint8_t> flags)
        : x(first_x), y(row_y), light_(pixels), lit_(flags) {}

    int64_t size() const { return std::ssize(light_); }

    struct Part {
        double x, y; // of the first pixel
        std::span<double> light;
    };
    Part part(const Run &run) const {
        for (int64_t b = run.first / block; b <= run.last / block; ++b)
            if (uint8_t &lit = lit_[static_cast<size_t>(b)]; !lit) {
                std::ranges::fill(pixels_of(b), 0.0);
                lit = 1;
            }
        return {x + static_cast<double>(run.first), y,
                light_.subspan(static_cast<size_t>(run.first),
                               static_cast<size_t>(run.last - run.first + 1))};
    }

    // Calls lit(first, pixels) for every block that got light.
    template <class Lit> void for_lit(const Lit &lit) const {
        for (size_t b = 0; b < lit_.size(); ++b)
            if (lit_[b])
                lit(static_cast<int64_t>(b) * block, pixels_of(static_cast<int64_t>(b)));
    }

    const double x, y;

  private:
    std::span<double> pixels_of(int64_t b) const {
        const int64_t first = b * block;
        return light_.subspan(static_cast<size_t>(first),
                              static_cast<size_t>(std::min(block, size() - first)));
    }

    std::span<double> light_;
    std::span<uint8_t> lit_;
};

// A few values without memory of their own: rows are many.
template <class T, size_t most> class Few {
  public:
    void push_back(const T &value) { values_[size_++] = value; }
    size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T *begin() { return values_.data(); }
    T *end() { return values_.data() + size_; }
    const T *begin() const { return values_.data(); }
    const T *end() const { return values_.data() + size_; }
    const T &operator[](size_t i) const { return values_[i]; }
    const T &back() const { return values_[size_ - 1]; }

  private:
    std::array<T, most> values_;
    size_t size_ = 0;
};

inline constexpr size_t most_runs = 16;
using Runs = Few<Run, most_runs>;

// Positions along a row where some condition may change.
class Roots {
  public:
    void add(double x) { all_.push_back(x); }
    void add(double a, double b, double c); // where a x^2 + b x + c = 0

    // The parts of a row between them where the middle is accepted.
    template <class Accept> Runs runs(const PixelRow &row, const Accept &accept) const {
        const Few<double, most_runs> inside = sorted_inside(row);
        Runs runs;
        for (size_t i = 0; i + 1 < inside.size(); ++i)
            if (accept((inside[i] + inside[i + 1]) / 2)) {
                // A pixel on a root belongs to what is left of it.
                const int64_t free = runs.empty() ? 0 : runs.back().last + 1;
                const auto first = static_cast<int64_t>(std::ceil(inside[i] - row.x));
                const auto last = static_cast<int64_t>(std::floor(inside[i + 1] - row.x));
                if (std::max(first, free) <= last)
                    runs.push_back({std::max(first, free), last});
            }
        return runs;
    }

  private:
    Few<double, most_runs> sorted_inside(const PixelRow &row) const;

    Few<double, most_runs - 2> all_;
};

// The part of a run where start + step * pixel is between two bounds.
Run between(Run run, double start, double step, double low, double high);

// Those up to `reach` across from a spike's line and between two distances along it, on either side
// of the star; no run is on both.
Runs runs_along(const SpikeAxes &axes, const PixelRow &row, double reach, double nearest,
                double farthest);

} // namespace wfpsf
