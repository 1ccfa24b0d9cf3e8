// SPDX-License-Identifier: GPL-3.0-or-later
// The light far from a star that all stars of a colour share: tabulated once, then drawn on those
// blocks of pixels alone that are bright enough.
#pragma once

#include "optics/far_light.hpp"
#include "optics/psf.hpp"
#include "optics/varying_light.hpp"
#include "scene/light_blocks.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace wfpsf {

struct MiddleLight;

class FarTable {
  public:
    FarTable() = default;
    explicit FarTable(const MiddleLight &light);
    double radius() const { return radius_; }
    int64_t memory() const { return blocks_.memory(); } // bytes held

    // The share of the light that add() gives to pixels at most `within` from the star along both
    // axes, about.
    double light(double within, double inner, double floor) const;

    // Adds a star's light to rows first_row..last_row of an image of native pixels, between `inner`
    // and the table's radius along either axis, where there is more than `floor` of it. That is a
    // share of the star's light; `inner` is a pixel or more beyond where far light begins.
    template <class T>
    void add(const Star &star, double inner, double floor, View<T> image, int64_t first_row,
             int64_t last_row) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.radius_, self.shares_, self.blocks_);
    }

  private:
    double radius_ = 0;
    struct Share {
        double brightest, light; // in a pixel of its block; on the average of its own
        int64_t x, y;            // of the first pixel, from the star's
    };
    std::vector<Share> shares_; // the brightest blocks' first
    LightBlocks blocks_;
};

// All over an image: the light of its middle, and how that of other places differs, as a polynomial
// through 3 x 3 places.
class FarTables {
  public:
    // Places of far light that tables are made from: the middle of the image first; that alone,
    // where light is the same everywhere.
    static std::vector<std::pair<double, double>> places(const Region &image, bool varies);

    struct Extent {
        double radius; // where the tables end, native pixels
        double floor;  // share of the light: what gets less may be missing
        double differences_radius, differences_floor; // of what stars get by their places
    };
    // `exact`, if there is one, is the PSF of the first place, and stands for its far light as far
    // as it reaches: from the pupil's edges then come the differences alone.
    FarTables(std::span<const FarLight> at_places, const Psf *exact, const Region &image,
              const Extent &extent, int threads = 1);

    double radius() const { return middle_.radius(); }

    // As FarTable::add(), for a star that stands at (x, y) of the detector.
    template <class T>
    void add(const Star &star, double x, double y, double inner, double floor, View<T> image,
             int64_t first_row, int64_t last_row) const;
    const FarTable &middle() const { return middle_; } // of the first place
    int64_t memory() const { return middle_.memory() + differences_.memory(); } // bytes held

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.image_, self.differences_radius_, self.middle_, self.differences_);
    }

  private:
    friend class ArchiveReader;
    FarTables() = default; // what an archive holds goes in
    FarTables(std::span<const FarLight> at_places, const Region &image, const Extent &extent,
              const MiddleLight &middle, int threads);

    Region image_{};
    double differences_radius_ = 0;
    FarTable middle_;
    LightBlocks differences_; // coefficients of x, x^2, y, y^2, x y, ...
};

} // namespace wfpsf
