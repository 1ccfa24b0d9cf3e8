// SPDX-License-Identifier: GPL-3.0-or-later
// How many wavelengths an image needs.
#pragma once

#include "optics/spectrum.hpp"

#include <cstddef>
#include <vector>

namespace wfpsf {

// How wavelengths and everything else share a tolerance; light of one colour needs none of it.
struct Shares {
    double for_colour, for_the_rest;
};
Shares shares_of(double eps, const Spectrum &spectrum);

// How bright an image is, at most and about, where the optical path difference across the pupil is
// so large, in units of the peak: spikes fall as the square of the radius, rings as the cube.
double brightness(double path, double wavelength);

// What a rule's sum over a spectrum misses of a wave in 1 / wavelength, by optical path difference:
// of any wave up to that path, since light at a distance from the axis mixes them all.
class FringeErrors {
  public:
    // `weights`: the rule's for the spectrum.
    FringeErrors(const WavelengthRule &rule, const std::vector<double> &weights,
                 const Spectrum &spectrum, double longest_path);

    double up_to(double path) const;
    // The largest one times the brightness there.
    double of_image(double wavelength) const;

  private:
    double step_; // of the path
    std::vector<double> worst_;
};

// As few wavelengths as an image needs out to where the path is so long, by what is known of it
// beforehand: far out it changes fastest with colour, near the core it is brightest. Errors in
// units of the peak.
struct ColourChoice {
    WavelengthRule rule;
    double error;
};
ColourChoice choose_wavelengths(const Spectrum &spectrum, double longest_path, double eps);

} // namespace wfpsf
