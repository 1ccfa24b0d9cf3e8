// SPDX-License-Identifier: GPL-3.0-or-later
// What a PSF is the weighted sum of.
#pragma once

#include "optics/aperture.hpp"
#include "optics/wavefront.hpp"

#include <memory>

namespace wfpsf {

struct Component {
    std::shared_ptr<const Aperture> aperture;
    Wavefront wavefront; // waves
    double wavelength;   // m
    double weight;       // its share of the light, times any number
};

} // namespace wfpsf
