// SPDX-License-Identifier: GPL-3.0-or-later
// Fringes between a spike and the halo: light of a straight edge and of the points of rims that
// send light its way.
#pragma once

#include "optics/far_rims.hpp"
#include "optics/far_visibility.hpp"

#include <array>
#include <memory>
#include <vector>

namespace wfpsf {

class RimFringes {
  public:
    // Those that are in the tables already are left out.
    RimFringes(const FarSource &source, const PupilEdges &edges, const EdgeColours &colours,
               std::shared_ptr<const Visibility> visibility, const std::vector<Fringes> &tables,
               RimPoints rims);

    // Adds fractions of the light, where they may be above the floor.
    void add(const PixelRow &row, double floor) const;

    // The most at a distance of r or more, on edges' spikes that are close to the one given.
    double brightest(double r, const SpikeAxes &spike) const;

  private:
    // With the light of a point.
    struct Pair {
        size_t point;
        size_t waves;             // of the edge: which
        std::vector<double> most; // from each ring on
    };
    struct Edge {
        EdgeColours::Edge edge;
        std::vector<std::vector<ColourWaves>> waves = {};
        std::array<std::vector<Pair>, 2> pairs = {}; // on either side of the star
    };
    // `joined`: curved edges' ends that belong to the edge's spike.
    struct End {
        Oval oval;
        double x, y;
    };
    Edge edge(const EdgeColours &colours, const EdgeColours::Edge &of,
              const std::vector<End> &joined) const;
    double most(const Edge &edge, const Pair &pair, size_t side, double r) const;

    RimPoints rims_;
    std::shared_ptr<const Visibility> visibility_;
    double pixel_, scale_, reach_, per_across_;
    std::vector<Edge> edges_;
};

} // namespace wfpsf
