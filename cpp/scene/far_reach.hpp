// SPDX-License-Identifier: GPL-3.0-or-later
// How far a star's far light has to be drawn, by how much of it may be left out.
#pragma once

#include "optics/far_light.hpp"

#include <vector>

namespace wfpsf {

class FarReach {
  public:
    explicit FarReach(const FarLight &light);

    struct Step {
        double floor;  // share of the light: pixels that get less may be left out
        double radius; // from where on all pixels do
        double halo;   // from where on all pixels between the spikes do
        double pixels; // that are drawn
    };
    const std::vector<Step> &steps() const { return steps_; } // floors falling

    // The largest error of a pixel beyond a radius, as a share of the star's light: what the far
    // light is off there, in units of the noise where pixels without the star have `variance`.
    double error(double radius, double flux, double variance) const;
    double nearest() const { return nearest_; }

  private:
    double nearest_;
    std::vector<Step> steps_;
    struct Ring {
        double brightest, error;
    };
    std::vector<Ring> rings_; // at nearest * 2^(i/4)
};

} // namespace wfpsf
