// SPDX-License-Identifier: GPL-3.0-or-later
// What the stamps of many faint sources leave out, as the smooth light that it adds up to.
#pragma once

#include "image/view.hpp"
#include "scene/groups.hpp"
#include "scene/light_profile.hpp"

#include <cstdint>
#include <vector>

namespace wfpsf {

class FaintLight {
  public:
    explicit FaintLight(const SceneImage &image);

    // Sources whose stamps all end at `radius` native pixels: first each, then the light of all.
    void add(const PlacedSource &source);
    void spread(const LightProfile &profile, double radius);

    template <class T> void add_to(View<T> image, int64_t first_row, int64_t last_row) const;

    // Native pixels from a source to where its light ends.
    static constexpr double reach = 256;

  private:
    static constexpr int64_t cell = SourceGroup::cell;
    static constexpr auto cells_reached = static_cast<int64_t>(reach) / cell;

    const SceneImage &image_;
    Plane<double> flux_;    // by cell, of the sources at hand
    Plane<double> density_; // by cell, e- a native pixel, of all sources
};

} // namespace wfpsf
