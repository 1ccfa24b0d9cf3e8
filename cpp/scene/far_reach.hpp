// SPDX-License-Identifier: GPL-3.0-or-later
// How far a star's far light has to be drawn, by how much of it may be left out.
#pragma once

#include "optics/far_light.hpp"

#include <optional>
#include <vector>

namespace wfpsf {

// None of light of one colour, nor of a pupil that is a mask.
std::optional<FarLight> far_light_of(const Optics &optics, const Light &light,
                                     const PsfSettings &settings);

class FarReach {
  public:
    FarReach() = default; // none
    // `brightest`: how much of its bound the brightest pixel gets.
    FarReach(const FarLight &light, double brightest);

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
    double brightest_beyond(double radius) const;
    double nearest() const { return nearest_; }
    // From where on all pixels get less than a floor, one of the steps'.
    double radius(double floor) const;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.nearest_, self.steps_, self.rings_);
    }

  private:
    double nearest_ = 0;
    std::vector<Step> steps_;
    struct Ring {
        double brightest, error;
    };
    const Ring &ring(double radius) const;
    std::vector<Ring> rings_; // at nearest * 2^(i/16)
};

} // namespace wfpsf
