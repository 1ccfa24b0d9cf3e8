// SPDX-License-Identifier: GPL-3.0-or-later
// Fringes between a spike and other light: of a straight edge with points that send light its way,
// which are rims' or corners.
#pragma once

#include "optics/far_corners.hpp"
#include "optics/far_halo.hpp"
#include "optics/far_rims.hpp"
#include "optics/far_visibility.hpp"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace wfpsf {

// A RimPoint or Corner.
template <class Point> class PointFringes {
  public:
    // `known`: pairs of an edge and a point that are in other tables.
    using Known = std::function<bool(size_t edge, const Point &point)>;
    PointFringes() = default; // none
    PointFringes(const FarSource &source, const EdgeColours &colours,
                 std::shared_ptr<const Visibility> visibility, std::vector<Point> points,
                 const Known &known, const Halo &halo);

    // Adds fractions of the light, where they may be above the floor.
    void add(const PixelRow &row, double floor) const;

    // The most at a distance of r or more, on edges' spikes that are close to the one given.
    double brightest(double r, const SpikeAxes &spike) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.points_, self.visibility_, self.rings_, self.nearest_, self.wavelength_,
                self.pixel_, self.scale_, self.per_across_, self.edges_);
    }

  private:
    // With the light of a point.
    struct Pair {
        size_t point;
        size_t waves;             // of the edge: which
        std::vector<double> most; // from each ring on

        template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
            archive(self.point, self.waves, self.most);
        }
    };
    struct Edge {
        EdgeColours::Edge edge;
        std::vector<std::vector<ColourWaves>> waves = {};
        std::array<std::vector<Pair>, 2> pairs = {}; // on either side of the star

        template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
            archive(self.edge, self.waves, self.pairs[0], self.pairs[1]);
        }
    };
    Edge edge(const EdgeColours &colours, size_t i, const Known &known, const Halo &halo) const;
    // Of the light with a point, per amplitude of the edge.
    double most(const EdgeColours::Edge &edge, size_t point, size_t side, double r) const;

    std::vector<Point> points_;
    std::shared_ptr<const Visibility> visibility_;
    std::vector<double> rings_; // distances, native pixels
    double nearest_ = 0, wavelength_ = 0, pixel_ = 0, scale_ = 0, per_across_ = 0;
    std::vector<Edge> edges_;
};

} // namespace wfpsf
