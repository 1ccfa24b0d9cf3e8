// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of the light about a star, and the splines through them.
#pragma once

#include "image/view.hpp"
#include "optics/far_light.hpp"
#include "optics/psf.hpp"

#include <cstdint>

namespace wfpsf {

// Samples of a rectangle, counted from the star's.
struct SampleRange {
    int64_t x, y, nx, ny;
};

// Light about a star that stands in the middle, as a fraction of all of it in a native pixel at each
// sample.
struct SampledLight {
    int64_t per_pixel;   // samples a native pixel
    int64_t half;        // native pixels from the star to the borders
    Plane<float> sample; // the star's is at half * per_pixel along both axes

    SampledLight(int64_t samples, int64_t half_width);
    int64_t middle() const { return half * per_pixel; }
    SampleRange all() const { return {-middle(), -middle(), 2 * middle() + 1, 2 * middle() + 1}; }

    void clear(const SampleRange &range);
    // Far light beyond `inner`; what is below `floor` may be missing.
    void add(const FarLight &light, double inner, double floor, const SampleRange &range);
    // A PSF out to its radius.
    void add(const Psf &psf, const SampleRange &range);

    // Every second sample.
    SampledLight coarser() const;
};

// The spline through samples.
struct LightSpline {
    int64_t per_pixel, half;
    Plane<float> coefficients;

    explicit LightSpline(SampledLight light);
    // The samples of the same spline, twice as many.
    SampledLight finer() const;
};

} // namespace wfpsf
