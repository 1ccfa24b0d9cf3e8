// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers of a pixel: Random123's Philox4x32-10 with the pixel's place on the detector as
// its counter (Salmon et al. 2011). What a pixel draws depends on seed, stream, draw and place
// alone, not on threads, on tiles or on what other pixels draw.
#pragma once

#include <cstdint>

namespace wfpsf {

struct RandomSource {
    uint64_t seed = 0;
    uint32_t stream = 0;    // such as the number of an exposure
    uint32_t draw = 0;      // which of the draws of one pixel, < 256
    int64_t x0 = 0, y0 = 0; // the place of an image's first pixel on the detector
};

// Standard normal numbers for `count` pixels of row y from column x on, both within the image.
// Neighbours share the two numbers that one transform of Box and Muller makes.
void fill_normal(const RandomSource &source, int64_t x, int64_t y, int64_t count, double *normal);

// Replaces means by Poisson numbers: inversion of the cumulative law below 24, the transformed
// rejection PTRS of Hoermann 1993 above. Means that are not positive, or not finite, stay.
void draw_poisson(const RandomSource &source, int64_t x, int64_t y, int64_t count, double *means);

} // namespace wfpsf
