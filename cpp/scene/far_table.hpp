// SPDX-License-Identifier: GPL-3.0-or-later
// Far light that many stars share: tabulated around the star once, then drawn on those blocks of
// pixels alone that are bright enough.
#pragma once

#include "image/view.hpp"
#include "optics/far_light.hpp"

#include <cstdint>
#include <vector>

namespace wfpsf {

class FarTable {
  public:
    // Out to `radius` native pixels; nothing where the far light does not reach inwards.
    FarTable(const FarLight &light, double radius);

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

} // namespace wfpsf
