// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of the light about a star, and the splines through them.
#pragma once

#include "image/view.hpp"
#include "optics/far_light.hpp"
#include "optics/psf.hpp"

#include <cstdint>
#include <cstdlib>

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

    // Far light beyond `inner`; what is below `floor` may be missing. Of all samples, or of those
    // between every second one.
    enum class Which { all, between };
    void add(const FarLight &light, double inner, double floor, const SampleRange &range,
             Which which, int threads = 1);
    // A PSF out to its radius.
    void add(const Psf &psf, const SampleRange &range);

    void clear(const SampleRange &range);
    void copy(const SampledLight &from, const SampleRange &range); // as many a pixel
    // Every second sample; and those of a range back in their places.
    SampledLight coarser() const;
    void take(const SampledLight &coarse, const SampleRange &range);

    // work(sample) on a range, without what is as near to the star as `inner` along both axes.
    template <class Work> void on(const SampleRange &range, double inner, const Work &work) const {
        const auto near = static_cast<int64_t>(inner * static_cast<double>(per_pixel));
        for (int64_t y = range.y; y < range.y + range.ny; ++y)
            for (int64_t x = range.x; x < range.x + range.nx; ++x)
                if (std::abs(x) > near || std::abs(y) > near)
                    work(sample(middle() + x, middle() + y));
    }
    // The largest of a range, likewise.
    double largest(const SampleRange &range, double inner) const;
    void subtract(const SampledLight &other);
};

// The spline through samples.
struct LightSpline {
    int64_t per_pixel, half;
    Plane<float> coefficients;

    explicit LightSpline(SampledLight light);
    // Twice as many samples of the same spline, out to the borders or nearer ones.
    SampledLight finer(int64_t half_width) const;
};

} // namespace wfpsf
