// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/far_reach.hpp"

#include "error/error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double farthest = 8192; // native pixels
constexpr double rings_per_octave = 16;

double radius_of(const FarLight &light, double bound) {
    double low = light.nearest(), high = farthest;
    if (light.brightest_beyond(low) <= bound)
        return low;
    while (high / low > 1.02) {
        const double middle = std::sqrt(low * high);
        (light.brightest_beyond(middle) > bound ? low : high) = middle;
    }
    return high;
}

} // namespace

std::optional<FarLight> far_light_of(const Optics &optics, const Light &light,
                                     const PsfSettings &settings) {
    try {
        return FarLight(optics, light, settings);
    } catch (const Error &error) {
        if (error.status() != WFPSF_ERROR_ARGUMENT)
            throw;
        return {}; // one colour, or a mask
    }
}

FarReach::FarReach(const FarLight &light, double brightest) : nearest_(light.nearest()) {
    double floor = brightest * light.brightest_beyond(nearest_);
    while (floor > 1e-14) {
        const double radius = radius_of(light, floor / brightest);
        const double halo = std::min(light.halo_radius(floor), radius);
        double width = 0;
        const double half_way = std::sqrt(nearest_ * radius);
        for (const FarLight::Direction &spike : light.spikes(half_way, floor))
            width += 2 * spike.half_width;
        steps_.push_back({floor, radius, halo,
                          std::numbers::pi * halo * halo + 2 * width * (radius - nearest_)});
        if (radius >= farthest)
            break;
        floor /= 2;
    }
    double r = nearest_;
    while (r < farthest) {
        const double bound = light.brightest_beyond(r);
        const FarLight::Error off = light.relative_error(r);
        rings_.push_back(
            {brightest * bound, std::max(off.spikes * bound, off.halo * light.halo_beyond(r))});
        r *= std::exp2(1 / rings_per_octave);
    }
}

const FarReach::Ring &FarReach::ring(double radius) const {
    const double at = rings_per_octave * std::log2(std::max(radius / nearest_, 1.0));
    return rings_[std::min(static_cast<size_t>(at), rings_.size() - 1)];
}

double FarReach::brightest_beyond(double radius) const {
    return ring(radius).brightest;
}

double FarReach::radius(double floor) const {
    for (const Step &step : steps_)
        if (step.floor <= floor)
            return step.radius;
    return farthest;
}

double FarReach::error(double radius, double flux, double variance) const {
    const Ring &at = ring(radius);
    return at.error / std::sqrt(1 + flux * at.brightest / variance);
}

} // namespace wfpsf
