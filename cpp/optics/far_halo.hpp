// SPDX-License-Identifier: GPL-3.0-or-later
// The halo of broadband light: what the curved edges of a pupil send far from the core, by the
// method of stationary phase from where their normals point along the direction, and Fresnel's
// integrals where they end.
#pragma once

#include "optics/far_spikes.hpp"

#include <vector>

namespace wfpsf {

class Halo {
  public:
    Halo(const FarSource &source, const PupilEdges &edges);

    // Adds fractions of the light, where they may be above the floor.
    void add(const PixelRow &row, double floor) const;

    double brightest(double r) const { return (most_ + corners_ / r) / (r * r * r); }
    // The distance from which on all light is below the floor.
    double radius(double floor) const;

  private:
    // Light times the cube of the distance r, by direction and by sqrt(nearest / r).
    static constexpr int directions = 1440, distances = 12;
    double nearest_, most_;
    double corners_; // light of the edges' ends between the spikes, times r^4
    std::vector<double> table_;
};

} // namespace wfpsf
