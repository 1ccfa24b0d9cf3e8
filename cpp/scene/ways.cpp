// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/ways.hpp"

#include "optics/varying_psf.hpp"
#include "scene/cost.hpp"
#include "scene/faint_light.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

namespace {

// Errors below that share of the budget need not become smaller.
constexpr double negligible = 0.01;

// What PSFs are off and lack is no larger than that, of what they may be: those of the whole
// detector, and exact ones (tests/unit/optics).
constexpr double of_bound = 0.3, of_exact = 0.05;

// PSFs of one place are some share of the light off those of others near by.
constexpr double differs = 0.1;

// from, from / factor, ... down to `to`.
std::vector<double> falling(double from, double to, double factor) {
    std::vector<double> all;
    double value = from;
    while (value >= to) {
        all.push_back(value);
        value /= factor;
    }
    return all;
}

// Stamps' radii that are tried, native pixels.
std::vector<double> radii(double largest) {
    std::vector<double> all;
    double r = 2;
    while (r < largest) {
        all.push_back(r);
        r = std::ceil(r * 1.2);
    }
    all.push_back(largest);
    return all;
}

} // namespace

double SceneBudget::error() const {
    return noise * std::sqrt(variance);
}

double psf_error(const SourceGroup &group, const ColourFacts &colour, const SceneBudget &budget,
                 const Way &way) {
    const double peak = colour.profile.peak();
    // In units of a dark pixel's noise, where the group's faintest gives that share of its light.
    const auto in_noise = [&](double error, double light) {
        return group.densest * error / std::sqrt(1 + light * group.brightest / 2 / budget.variance);
    };
    const double in_core = peak / 2; // in the least lucky place between pixels
    // A galaxy drawn as a star: half the curvature of the PSF times the mean square along an axis;
    // the curvature of Roman's PSFs at the peak is below 4 / pixel^2 of it.
    const double point_like = group.is_galaxy ? std::min(1.0, group.mean_square) * peak : 0;
    const double of_psf = (way.drawing == Drawing::own ? of_exact : of_bound) * way.eps * peak;
    return std::max(in_noise(of_psf, in_core), group.densest * VaryingPsf::error_far_off * of_psf) +
           in_noise(of_bound * way.left_out, std::min(in_core, way.left_out / differs)) +
           in_noise(point_like, in_core);
}

double Ways::pixels(double radius) const {
    const auto n = static_cast<double>(image_.oversampling);
    return std::min(2 * radius + 1, image_.native_x()) *
           std::min(2 * radius + 1, image_.native_y()) * n * n;
}

double Ways::width(double radius) const {
    return std::sqrt(pixels(radius));
}

double Ways::cut(double radius) const {
    return radius >= group_.reach ? 0 : colour_.profile.brightest_beyond(radius);
}

// What all sources of the group leave out of a pixel on the average, if each leaves out that share
// of its light, `cut` of any pixel at most.
double Ways::mean(double light, double cut) const {
    return group_.flux * std::min(light / (image_.native_x() * image_.native_y()), cut);
}

PixelError Ways::left_out(const Way &way) const {
    if (way.radius >= group_.reach)
        return {};
    // Spikes that fall on each other, and the mean of what others near by leave out.
    const double local = group_.densest * cut(way.radius) +
                         (group_.crowded - group_.densest) * colour_.profile.mean_at(way.radius);
    const double light = colour_.profile.beyond(way.radius);
    if (!way.is_smooth_beyond())
        return {local, mean(light, cut(way.radius))};
    // What scatters is what many sources that are not in that cell leave out here.
    double squares = 0;
    double r = way.radius + 1;
    while (r <= FaintLight::reach) {
        squares += std::pow(colour_.profile.mean_at(r), 2) * 8 * r * 0.1 * r;
        r *= 1.1;
    }
    constexpr double deviations = 2; // of the densest cell
    const double scatter =
        deviations * std::sqrt(group_.crowded * group_.brightest * squares) / SourceGroup::cell;
    return {std::hypot(local, scatter),
            LightProfile::mean_varies * mean(light, cut(way.radius)) +
                mean(colour_.profile.beyond(FaintLight::reach), cut(FaintLight::reach))};
}

void Ways::with_and_without_far(const Way &way, double time_s, const Take &take) const {
    const double of_psf = psf_error(group_, colour_, budget_, way);
    const double beyond = way.radius >= group_.reach ? 0 : colour_.profile.beyond(way.radius);
    if (beyond <= budget_.flux) {
        const PixelError error = left_out(way);
        take({way, time_s, {error.local + of_psf, error.mean}});
    }
    // Tables are interpolated, and need some light within the stamp.
    if (!colour_.far || image_.oversampling != 1 || way.radius < colour_.far->nearest() + 1 ||
        way.radius >= group_.reach)
        return;
    const FarReach &far = *colour_.far;
    const bool own = way.drawing == Drawing::own;
    const double varies =
        own ? 0 : colour_.far_varies * colour_.profile.brightest_beyond(way.radius);
    const double off = far.error(way.radius, group_.brightest, budget_.variance) + varies;
    for (const FarReach::Step &step : far.steps()) {
        if (2 * group_.densest * step.floor < negligible * budget_.error())
            break;
        // A table ends somewhere; drawn by itself, far light goes on.
        const double end =
            own ? std::min(step.radius, group_.reach) : std::min(step.radius, Way::largest_table);
        if (end <= way.radius)
            continue;
        const double left = std::max(step.floor, end < step.radius ? far.brightest_beyond(end) : 0);
        const double light = colour_.profile.beyond(std::min(std::max(step.halo, way.radius), end));
        if (light > budget_.flux)
            continue;
        Way with = way;
        with.far = step.floor;
        const double time = own ? cost::making_far_light + cost::far_light(pixels(end))
                                : cost::far_blocks(step.pixels);
        take({with,
              time_s + count() * time,
              {group_.densest * (left + off) + of_psf, mean(light, left)}});
    }
}

double Ways::shared_stamps(double radius, double left_out) const {
    const double stamps = count() * cost::shared_stamp(width(radius), left_out);
    const bool differ = colour_.varies && differs * colour_.profile.peak() > left_out;
    return differ ? stamps + cost::places(count(), width(radius), left_out) : stamps;
}

void Ways::of_shared(const SharedModel &model, const Take &take) const {
    const double peak = colour_.profile.peak();
    for (const double left_out : falling(colour_.varies ? 1e-2 : model.eps, model.eps / 2, 4))
        for (const double radius : radii(std::min(model.radius, group_.reach)))
            with_and_without_far({Drawing::shared, radius, model.eps, peak * left_out, 0},
                                 shared_stamps(radius, peak * left_out), take);
}

void Ways::of_own(const Take &take) const {
    for (const double radius : radii(group_.reach))
        for (const double eps : falling(1e-4, 1e-11, 10)) {
            if (10 * group_.densest * colour_.profile.peak() * eps < negligible * budget_.error())
                break;
            const double made = std::min(radius, Way::largest_field);
            double time = cost::psf(made, eps, colour_.bandwidth);
            if (radius > Way::largest_field)
                time += cost::large_stamp(pixels(radius), radius, colour_.bandwidth);
            else
                time += cost::stamp(width(radius), radius, eps);
            with_and_without_far({Drawing::own, radius, eps, 0, 0}, count() * time, take);
        }
}

void Ways::of_fourier(double place_error, const Take &take) const {
    if (!group_.is_galaxy || image_.oversampling != 1)
        return;
    for (const double share : falling(1e-2, 1e-10, 2)) {
        if (2 * group_.densest * share < negligible * budget_.error())
            break;
        const double radius = group_.half_light * (2 + group_.index * -std::log10(share));
        // Light below the tolerance is left out: no more in all than on as large an area as is
        // drawn.
        const double light = std::min(0.5, 4 * radius * radius * share);
        if (light > budget_.flux)
            continue;
        const double drawing = cost::galaxy(radius + 8, share), left = mean(light, share);
        const double off = group_.densest * share;
        take({{Drawing::fourier, radius, share, 0, 0},
              count() * drawing,
              {off + place_error, left}});
        take({{Drawing::fourier_own, radius, share, 0, 0},
              count() * (drawing + cost::otf(colour_.bandwidth)),
              {off, left}});
    }
}

} // namespace wfpsf
