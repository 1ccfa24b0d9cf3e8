// SPDX-License-Identifier: GPL-3.0-or-later
// Stamps of any size: a bright star's light is drawn straight from its diffraction image, which is
// made a strip of rows at a time. Nothing is folded back, and the cost goes with the area.
#pragma once

#include "error/progress.hpp"
#include "image/view.hpp"
#include "optics/field.hpp"

#include <cstdint>

namespace wfpsf {

// Bytes that the stamp takes at least, and what lets it be drawn in one go.
struct StampMemory {
    int64_t least, most;
};

struct StampSize {
    double reach;         // of the farthest pixel's centre along an axis, native pixels
    int64_t oversampling; // samples a native pixel
    int64_t nx, ny;       // samples
};

StampMemory stamp_memory(const Optics &optics, const Light &light, const PsfSettings &settings,
                         double faintest_peak, const StampSize &size);

// Adds a star to an image of that size, every pixel of it; returns an estimate of the error in
// units of the peak pixel, which holds the fraction `faintest_peak` of the light at least. Less
// memory than the least: WFPSF_ERROR_MEMORY_LIMIT. A caller that stops leaves a part of the light
// in the image.
template <class T>
double add_large_stamp(const Optics &optics, const Light &light, const PsfSettings &settings,
                       double faintest_peak, const Star &star, const StampSize &size, View<T> image,
                       const Manners &manners);

} // namespace wfpsf
