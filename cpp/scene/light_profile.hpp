// SPDX-License-Identifier: GPL-3.0-or-later
// How a star's light falls off: what a stamp leaves out, by its size.
#pragma once

#include "optics/psf.hpp"

#include <vector>

namespace wfpsf {

class LightProfile {
  public:
    LightProfile() = default;
    // Seen out to psf.settings().radius; beyond, spikes fall as the square of the distance and the
    // light outside a square as its size.
    explicit LightProfile(const Psf &psf);

    double peak() const { return brightest_[0] / safety; }

    // Fractions of the light: the largest in any native pixel whose centre is not within `radius`
    // native pixels of the star along both axes, and all of it there.
    double brightest_beyond(double radius) const { return at(brightest_, radius + 1, 2); }
    double beyond(double radius) const { return at(outside_, radius, 1); }
    // What is expected there, where the former bounds it.
    double expected_beyond(double radius) const { return beyond(radius) / safety; }
    // Where `brightest_beyond` comes from what was seen.
    double seen() const { return static_cast<double>(brightest_.size()) - 2; }
    // What is expected in a native pixel, on the average of all directions.
    double mean_at(double radius) const;
    // How much the latter may be off, for all places of a detector.
    static constexpr double mean_varies = 0.05;

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.brightest_, self.outside_);
    }

  private:
    // The PSF of one place stands for those of a detector, whose wings differ a little.
    static constexpr double safety = 1.3;

    double at(const std::vector<double> &by_radius, double radius, int power) const;

    std::vector<double> brightest_, outside_; // at 0, 1, 2, ... native pixels
};

} // namespace wfpsf
