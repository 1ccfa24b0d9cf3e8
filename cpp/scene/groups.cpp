// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/groups.hpp"

#include "numerics/gamma.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace wfpsf {

namespace {

constexpr int least_octave = -64, octaves = 128;         // of fluxes
constexpr int least_size = -8, sizes = 16;               // of half-light radii, native pixels
constexpr size_t kinds = static_cast<size_t>(sizes) + 1; // stars are the first

int octave_of(double flux) {
    const double magnitude = std::abs(flux);
    if (!(magnitude > 0))
        return least_octave;
    return std::clamp(std::ilogb(magnitude), least_octave, least_octave + octaves - 1);
}

// Squares of the detector that sources are drawn in one after another, so that the image is written
// to in few places at a time. What lies beyond it counts to the tiles along its border.
class Tiles {
  public:
    explicit Tiles(const SceneImage &image)
        : x0_(image.x0), y0_(image.y0), nx_(tiles(image.native_x())), ny_(tiles(image.native_y())) {
    }

    size_t count() const { return static_cast<size_t>(nx_ * ny_); }
    size_t number(const PlacedSource &s) const {
        return static_cast<size_t>(tile_of(s.y - y0_, ny_) * nx_ + tile_of(s.x - x0_, nx_));
    }

    // Squares of 4 x 4 tiles.
    size_t wide_count() const { return static_cast<size_t>(wide(nx_) * wide(ny_)); }
    size_t wide_number(size_t tile) const {
        const auto number = static_cast<int64_t>(tile);
        return static_cast<size_t>(number / nx_ / tiles_a_side * wide(nx_) +
                                   number % nx_ / tiles_a_side);
    }

    // Cells of so many native pixels within a tile.
    template <int64_t width> static constexpr int64_t cells = (64 / width) * (64 / width);
    template <int64_t width> size_t cell(const PlacedSource &s) const {
        constexpr int64_t a_side = 64 / width;
        const auto along = [](double at) {
            const auto k = static_cast<int64_t>(std::floor(at / width)) % a_side;
            return k < 0 ? k + a_side : k;
        };
        return static_cast<size_t>(along(s.y - y0_) * a_side + along(s.x - x0_));
    }

  private:
    static constexpr double side = 64; // native pixels
    static constexpr int64_t tiles_a_side = SourceGroup::wide_cell / 64;

    static int64_t wide(int64_t tiles) { return (tiles + tiles_a_side - 1) / tiles_a_side; }

    static int64_t tiles(double pixels) {
        return static_cast<int64_t>(std::ceil(pixels / side)) + 2;
    }
    static int64_t tile_of(double at, int64_t count) {
        return static_cast<int64_t>(
            std::clamp(std::floor(at / side) + 1, 0.0, static_cast<double>(count - 1)));
    }

    double x0_, y0_;
    int64_t nx_, ny_;
};

void sort_by_tile(std::vector<PlacedSource> &sources, const Tiles &tiles) {
    std::vector<size_t> begin(tiles.count() + 1);
    for (const PlacedSource &source : sources)
        ++begin[tiles.number(source) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<PlacedSource> sorted(sources.size());
    for (const PlacedSource &source : sources)
        sorted[begin[tiles.number(source)]++] = source;
    sources = std::move(sorted);
}

double reach_of(const PlacedSource &s, const SceneImage &image) {
    return std::ceil(
        std::max({std::abs(s.x - image.x0), std::abs(s.x - image.x0 - image.native_x()),
                  std::abs(s.y - image.y0), std::abs(s.y - image.y0 - image.native_y())}));
}

// Of a round Sersic profile, in half-light radii: Gamma(4n) / Gamma(2n) / b^(2n) (Ciotti & Bertin
// 1999).
double mean_square_radius(double n) {
    const double b = 2 * n - 1.0 / 3 + 4 / (405 * n) + 46 / (25515 * n * n);
    return std::exp(log_of_gamma(4 * n) - log_of_gamma(2 * n) - 2 * n * std::log(b));
}

} // namespace

SourceGroups::SourceGroups(std::vector<PlacedSource> &sources, std::span<const GalaxyShape> shapes,
                           double pixel_scale_arcsec, const SceneImage &image)
    : shapes_(shapes), pixel_scale_arcsec_(pixel_scale_arcsec) {
    const Tiles tiles(image);
    sort_by_tile(sources, tiles);
    int32_t colours = 1;
    for (const PlacedSource &source : sources)
        colours = std::max(colours, source.colour + 1);
    at_.assign(static_cast<size_t>(colours) * octaves * kinds, -1);
    size_t tile = 0;
    constexpr int64_t small = 4; // native pixels
    std::vector<std::array<double, Tiles::cells<SourceGroup::cell>>> in_cells;
    std::vector<std::array<double, Tiles::cells<small>>> in_small; // of the present tile, by group
    std::vector<std::vector<double>> in_wide;                      // by group
    for (const PlacedSource &source : sources) {
        if (tiles.number(source) != tile) {
            tile = tiles.number(source);
            in_cells.assign(groups_.size(), {});
            in_small.assign(groups_.size(), {});
        }
        int32_t &at = at_[key(source)];
        if (at < 0) {
            at = static_cast<int32_t>(groups_.size());
            groups_.push_back({.colour = source.colour,
                               .is_galaxy = source.shape != PlacedSource::star,
                               .octave = octave_of(source.flux)});
            in_cells.emplace_back();
            in_small.emplace_back();
            in_wide.emplace_back(tiles.wide_count());
        }
        SourceGroup &group = groups_[static_cast<size_t>(at)];
        const double flux = std::abs(source.flux);
        ++group.count;
        group.flux += flux;
        group.brightest = std::max(group.brightest, flux);
        group.reach = std::max(group.reach, reach_of(source, image));
        double &cell = in_cells[static_cast<size_t>(at)][tiles.cell<SourceGroup::cell>(source)];
        cell += flux;
        group.crowded = std::max(group.crowded, cell);
        double &spot = in_small[static_cast<size_t>(at)][tiles.cell<small>(source)];
        spot += flux;
        group.densest = std::max(group.densest, spot);
        double &around = in_wide[static_cast<size_t>(at)][tiles.wide_number(tile)];
        around += flux;
        group.wide_crowd = std::max(group.wide_crowd, around);
        if (group.is_galaxy) {
            const GalaxyShape &shape = shapes_[static_cast<size_t>(source.shape)];
            const double radius = shape.half_light_radius_arcsec / pixel_scale_arcsec_;
            const double e2 = shape.e1 * shape.e1 + shape.e2 * shape.e2;
            group.half_light = std::max(group.half_light, radius);
            group.index = std::max(group.index, shape.sersic_index);
            group.mean_square = std::max(group.mean_square,
                                         radius * radius * mean_square_radius(shape.sersic_index) *
                                             (1 + e2) / (1 - e2));
        }
    }
    // Cells cut clusters up: then the large ones tell.
    for (SourceGroup &group : groups_)
        if (group.densest > 2 * group.brightest)
            group.densest = group.crowded;
}

size_t SourceGroups::key(const PlacedSource &source) const {
    size_t kind = 0;
    if (source.shape != PlacedSource::star) {
        const double radius = shapes_[static_cast<size_t>(source.shape)].half_light_radius_arcsec /
                              pixel_scale_arcsec_;
        kind = 1 + static_cast<size_t>(std::clamp(std::ilogb(radius) - least_size, 0, sizes - 1));
    }
    const auto flux = static_cast<size_t>(octave_of(source.flux) - least_octave);
    return (static_cast<size_t>(source.colour) * octaves + flux) * kinds + kind;
}

size_t SourceGroups::of(const PlacedSource &source) const {
    return static_cast<size_t>(at_[key(source)]);
}

} // namespace wfpsf
