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
    // An edge with one point of an oval, which is in front on one side of the star.
    struct Pair {
        std::array<size_t, 2> point;    // before the star and behind
        std::array<bool, 2> lit;        // likewise
        std::vector<ColourWaves> waves; // of the edge
    };
    struct Edge {
        EdgeColours::Edge edge;
        std::vector<Pair> pairs;
        std::vector<double> most; // from each ring on
    };

    bool lit(const RimPoint &point, double nx, double ny) const;
    // `joined`: curved edges' ends that belong to the edge's spike.
    struct End {
        Oval oval;
        double x, y;
    };
    std::vector<Pair> pairs(const EdgeColours &colours, const EdgeColours::Edge &edge,
                            const std::vector<End> &joined) const;
    double most(const Edge &edge, double r) const;

    RimPoints rims_;
    std::shared_ptr<const Visibility> visibility_;
    double pixel_, scale_, reach_, per_across_;
    std::vector<Edge> edges_;
};

} // namespace wfpsf
