// SPDX-License-Identifier: GPL-3.0-or-later
// Sources that are alike: of one colour and kind, with fluxes (and, of galaxies, sizes) within a
// factor of two.
#pragma once

#include "scene/catalogue.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace wfpsf {

// Where an image is: (x0, y0) of the detector is the centre of its first native pixel.
struct SceneImage {
    double x0 = 0, y0 = 0;
    int64_t nx = 0, ny = 0; // samples
    int64_t oversampling = 1;

    double native_x() const { return static_cast<double>(nx) / static_cast<double>(oversampling); }
    double native_y() const { return static_cast<double>(ny) / static_cast<double>(oversampling); }
};

struct SourceGroup {
    int32_t colour = 0;
    bool is_galaxy = false;
    int octave = 0; // log2 of the flux, e-, rounded down
    int64_t count = 0;
    double flux = 0; // of all, e-
    double brightest = 0;
    double crowded = 0;    // the largest flux in any square cell of `cell` native pixels
    double wide_crowd = 0; // and of `wide_cell` ones
    // The largest flux whose spikes fall on each other: in any small cell; where several sources
    // share one, as in clusters, as much as `crowded`.
    double densest = 0;
    double reach = 0; // from any of them to the farthest pixel along an axis, native pixels
    // Of galaxies: the largest mean square radius and half-light radius, native pixels, and the
    // highest Sersic index.
    double mean_square = 0, half_light = 0, index = 0;

    static constexpr int64_t cell = 16, wide_cell = 256;
};

class SourceGroups {
  public:
    // Puts the sources into the order they are drawn in: tile by tile.
    SourceGroups(std::vector<PlacedSource> &sources, std::span<const GalaxyShape> shapes,
                 double pixel_scale_arcsec, const SceneImage &image);

    const std::vector<SourceGroup> &all() const { return groups_; }
    size_t of(const PlacedSource &source) const;

  private:
    size_t key(const PlacedSource &source) const;

    std::span<const GalaxyShape> shapes_;
    double pixel_scale_arcsec_;
    std::vector<SourceGroup> groups_;
    std::vector<int32_t> at_; // by key
};

} // namespace wfpsf
