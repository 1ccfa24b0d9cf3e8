// SPDX-License-Identifier: GPL-3.0-or-later
// What the stamps of many faint sources leave out, as the smooth light that it adds up to.
#pragma once

#include "image/view.hpp"
#include "scene/groups.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace wfpsf {

class FaintLight {
  public:
    explicit FaintLight(const SceneImage &image);

    // Sources of which all but the same is drawn elsewhere: first each, then the light of all.
    void add(const PlacedSource &source);
    // `left_out`: the share of a source's light beyond so many native pixels from it along either
    // axis that is to be drawn here.
    void spread(const std::function<double(double radius)> &left_out);

    template <class T> void add_to(View<T> image, int64_t first_row, int64_t last_row) const;

    // Native pixels from a source to where its light ends.
    static constexpr double reach = 4096;

  private:
    static constexpr int64_t cell = SourceGroup::cell;
    static constexpr auto cells_reached = static_cast<int64_t>(reach) / cell;

    const SceneImage &image_;
    Plane<double>
        density_;        // by cell of the image and next to it, e- a native pixel, of all sources
    Plane<double> flux_; // by cell as far around the image as light reaches, of those at hand
};

} // namespace wfpsf
