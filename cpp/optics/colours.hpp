// SPDX-License-Identifier: GPL-3.0-or-later
// How many wavelengths an image needs.
#pragma once

#include "optics/spectrum.hpp"

#include <functional>
#include <span>
#include <vector>

namespace wfpsf {

// How bright an image is at most where the optical path difference across the pupil is at least so
// long, in units of the peak.
using Brightness = std::function<double(double path)>;

// By what is known beforehand, about: spikes fall as the square of the radius, rings as the cube.
Brightness usual_brightness(double wavelength);

// As few wavelengths as the images of all spectra need out to where the path is so long: far out
// they change fastest with colour, near the core they are brightest. Errors in units of the peak of
// the bluest light.
struct ColourChoice {
    WavelengthRule rule;
    std::vector<std::vector<double>> weights; // by spectrum
    double error;
};
ColourChoice choose_wavelengths(std::span<const Spectrum> spectra, double longest_path,
                                const Brightness &brightness, double eps,
                                double largest_share = WavelengthRule::usual_share);

} // namespace wfpsf
