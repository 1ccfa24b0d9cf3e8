// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/sampled_light.hpp"

#include "numerics/cubic_spline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wfpsf {

SampledLight::SampledLight(int64_t samples, int64_t half_width)
    : per_pixel(samples), half(half_width),
      sample(2 * half * per_pixel + 1, 2 * half * per_pixel + 1) {}

void SampledLight::clear(const SampleRange &range) {
    for (int64_t y = 0; y < range.ny; ++y)
        std::fill_n(&sample(middle() + range.x, middle() + range.y + y), range.nx, 0.0F);
}

void SampledLight::copy(const SampledLight &from, const SampleRange &range) {
    for (int64_t y = range.y; y < range.y + range.ny; ++y)
        std::copy_n(&from.sample(from.middle() + range.x, from.middle() + y), range.nx,
                    &sample(middle() + range.x, middle() + y));
}

// Samples of every sub-pixel phase are an image of native pixels of their own.
void SampledLight::add(const FarLight &light, double inner, double floor, const SampleRange &range,
                       Which which, int threads) {
    const auto is_even = [](int64_t at) { return at % 2 == 0; };
    const auto star = [this](int64_t first) {
        return -static_cast<double>(first) / static_cast<double>(per_pixel);
    };
    for (int64_t v = 0; v < std::min(per_pixel, range.ny); ++v)
        for (int64_t u = 0; u < std::min(per_pixel, range.nx); ++u) {
            if (which == Which::between && is_even(range.x + u) && is_even(range.y + v))
                continue;
            const View<float> phase{&sample(middle() + range.x + u, middle() + range.y + v),
                                    (range.nx - u + per_pixel - 1) / per_pixel,
                                    (range.ny - v + per_pixel - 1) / per_pixel, per_pixel,
                                    per_pixel * sample.view().stride_y};
            light.add({star(range.x + u), star(range.y + v), 1}, inner, floor, phase, threads);
        }
}

void SampledLight::add(const Psf &psf, const SampleRange &range) {
    const auto reach = static_cast<int64_t>(std::floor(psf.settings().radius)) * per_pixel;
    const auto part = [reach](int64_t first, int64_t count) {
        const int64_t from = std::max(first, -reach);
        return std::pair(from, std::min(first + count, reach + 1) - from);
    };
    const auto [x, nx] = part(range.x, range.nx);
    const auto [y, ny] = part(range.y, range.ny);
    if (nx <= 0 || ny <= 0)
        return;
    const View<float> within{&sample(middle() + x, middle() + y), nx, ny, 1,
                             sample.view().stride_y};
    // Samples get their share of a native pixel.
    psf.draw({static_cast<double>(-x), static_cast<double>(-y),
              static_cast<double>(per_pixel * per_pixel)},
             per_pixel, within, Psf::Drawing::adds);
}

SampledLight SampledLight::coarser() const {
    SampledLight coarse(per_pixel / 2, half);
    for (int64_t y = 0; y < coarse.sample.ny(); ++y)
        for (int64_t x = 0; x < coarse.sample.nx(); ++x)
            coarse.sample(x, y) = sample(2 * x, 2 * y);
    return coarse;
}

void SampledLight::take(const SampledLight &coarse, const SampleRange &range) {
    for (int64_t y = range.y + (range.y & 1); y < range.y + range.ny; y += 2)
        for (int64_t x = range.x + (range.x & 1); x < range.x + range.nx; x += 2)
            sample(middle() + x, middle() + y) =
                coarse.sample(coarse.middle() + x / 2, coarse.middle() + y / 2);
}

double SampledLight::largest(const SampleRange &range, double inner) const {
    float most = 0;
    on(range, inner, [&most](float here) { most = std::max(most, std::abs(here)); });
    return static_cast<double>(most);
}

void SampledLight::subtract(const SampledLight &other) {
    for (int64_t y = 0; y < sample.ny(); ++y)
        for (int64_t x = 0; x < sample.nx(); ++x)
            sample(x, y) -= other.sample(x, y);
}

LightSpline::LightSpline(SampledLight light)
    : per_pixel(light.per_pixel), half(light.half), coefficients(std::move(light.sample)) {
    to_spline_coefficients(coefficients);
}

SampledLight LightSpline::finer(int64_t half_width) const {
    SampledLight part(per_pixel, half_width);
    const int64_t first = half * per_pixel - part.middle();
    for (int64_t y = 0; y < part.sample.ny(); ++y)
        std::copy_n(&coefficients(first, first + y), part.sample.nx(), &part.sample(0, y));
    SampledLight fine(2 * per_pixel, half_width);
    fine.sample = refined_spline(part.sample);
    to_spline_samples(fine.sample);
    return fine;
}

} // namespace wfpsf
