// SPDX-License-Identifier: GPL-3.0-or-later
// Far light that many stars share: tabulated around the star once, then drawn on those blocks of
// pixels alone that are bright enough.
#pragma once

#include "image/view.hpp"
#include "optics/far_light.hpp"
#include "optics/varying_psf.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace wfpsf {

class FarTable {
  public:
    // Out to `radius` native pixels; nothing where the far light does not reach inwards, and what
    // is below `floor`, a share of the light, may be missing.
    FarTable(const FarLight &light, double radius, double floor);

    // The sum of tables of one size, each `weights` times, 0 or more.
    static FarTable mixed(std::span<const FarTable> tables, std::span<const double> weights);

    // Adds a star's far light to rows first_row..last_row of an image of native pixels, but for the
    // pixels within `inner` of it along both axes; `floor` is a share of the light.
    template <class T>
    void add(const Star &star, double inner, double floor, View<T> image, int64_t first_row,
             int64_t last_row) const;

  private:
    static constexpr int64_t per_pixel = 3, block = 8; // samples a native pixel; native pixels

    int64_t half_; // blocks from the star to the table's end
    Plane<float> light_;
    std::vector<float> brightest_; // by block
};

// Far light all over an image: tables of its four corners, mixed by nearness; or one, where it is the
// same everywhere.
class FarTables {
  public:
    FarTables(std::vector<FarTable> of_corners, const Region &image)
        : tables_(std::move(of_corners)), image_(image),
          across_(tables_.size() == 1 ? 1 : cells_across) {}

    // The image is cut into cells that share a table.
    size_t cells() const { return across_ * across_; }
    size_t cell_of(double x, double y) const {
        return part(y, image_.y0, image_.y1) * across_ + part(x, image_.x0, image_.x1);
    }
    FarTable of_cell(size_t cell) const;

    // (x0, y0), (x1, y0), (x0, y1), (x1, y1).
    static std::array<std::pair<double, double>, 4> corners(const Region &image);

  private:
    static constexpr size_t cells_across = 8;

    size_t part(double at, double low, double high) const {
        const auto last = static_cast<double>(across_ - 1);
        return static_cast<size_t>(std::clamp((at - low) / (high - low) * (last + 1), 0.0, last));
    }

    std::vector<FarTable> tables_;
    Region image_;
    size_t across_;
};

} // namespace wfpsf
