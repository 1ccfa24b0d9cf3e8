// SPDX-License-Identifier: GPL-3.0-or-later
// The halo of broadband light: what the curved edges of a pupil send far from the core.
#pragma once

#include "optics/far_rims.hpp"

#include <vector>

namespace wfpsf {

// Fringes are left out that are no more than that share of its brightest.
inline constexpr double lost_in_halo = 2e-3;

class Halo {
  public:
    Halo() = default; // none
    Halo(const FarSource &source, const PupilEdges &edges, const RimPoints &points);

    // Adds fractions of the light, where they may be above the floor.
    void add(const PixelRow &row, double floor) const;

    double brightest(double r) const { return (most_ + corners_ / r) / (r * r * r); }
    // The distance from which on all light is below the floor.
    double radius(double floor) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.nearest_, self.most_, self.corners_, self.table_);
    }

  private:
    double nearest_ = 0, most_ = 0;
    double corners_ = 0;       // light of the edges' ends between the spikes, times r^4
    std::vector<float> table_; // light times the cube of the distance
};

} // namespace wfpsf
