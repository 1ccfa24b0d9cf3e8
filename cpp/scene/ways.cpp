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

// What PSFs are off is no larger than that, of what they may be (tests/unit/optics): exact ones at
// the core and far from it, those of the whole detector anywhere; and what these lack where parts are
// left out. Then far light from the pupil's edges: of Roman's eight bands, at six detectors each, and
// four of WFIRST's.
constexpr double of_exact = 0.05, of_exact_far_off = 0.015, of_left_out = 0.3;
constexpr double of_exact_far_light = 0.004; // as far off as tables of far light begin
double of_model(double eps) {
    return eps > 5e-4 ? 0.2 : 0.1;
}
double of_far(double radius) {
    return std::clamp(50 / radius, 0.45, 0.75);
}

// Tables of far light are that share of the light off, and more, the more it differs from place to
// place. Such differences are off by as much of what far light is off itself.
constexpr double interpolated = 2e-4, mixed = 0.02, of_differences = 0.06;

// Far light that is drawn from edges leaves out fringes of many pairs that are fainter than the floor:
// together some floors, where the halo is about as faint, far from where far light is off most.
constexpr double floors_left_out = 3.5;

// Of what light differs from that of the middle at most, the nearest of 3 x 3 places is off.
constexpr double off_nearest = 0.6;

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

// Rings about a pixel that sources' light comes from, each that much farther out than the one before.
constexpr double next_ring = 1.1;

} // namespace

double SceneBudget::error() const {
    return noise * std::sqrt(variance);
}

double exact_far_eps(double densest, const ColourFacts &colour, const SceneBudget &budget) {
    constexpr double little = 0.02; // of the budget
    const double eps =
        little * budget.error() / (of_exact_far_light * colour.profile.peak() * densest);
    return std::clamp(eps, 1e-10, 1e-4);
}

double same_beyond(const ColourFacts &colour, double flux, const SceneBudget &budget) {
    constexpr double little = 0.1; // of the budget
    return colour.far->radius(little * budget.error() / (colour.far_varies * flux));
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
    const double tolerance = way.eps * peak;
    const double of_psf = way.drawing == Drawing::own
                              ? std::max(in_noise(of_exact * tolerance, in_core),
                                         group.densest * of_exact_far_off * tolerance)
                              : group.densest * of_model(way.eps) * tolerance;
    return of_psf +
           in_noise(of_left_out * way.left_out, std::min(in_core, way.left_out / differs)) +
           in_noise(point_like, in_core);
}

// What scatters in a pixel is what single sources leave out there, those that stand beyond a radius:
// no more of them anywhere than in the densest parts. The nearest count most.
Ways::Ways(const SourceGroup &group, const ColourFacts &colour, const SceneBudget &budget,
           const SceneImage &image)
    : group_(group), colour_(colour), budget_(budget), image_(image) {
    struct Ring {
        double radius, flux,
            squared; // to the outer border; at most; of the light of a source there
    };
    std::vector<Ring> rings;
    constexpr auto in_cell = static_cast<double>(SourceGroup::cell * SourceGroup::cell);
    double inner = 1;
    while (inner < FaintLight::reach) {
        const double outer = next_ring * inner, light = colour.profile.mean_at(inner);
        rings.push_back(
            {outer, group.crowded / in_cell * 4 * (outer * outer - inner * inner), light * light});
        inner = outer;
    }
    constexpr double deviations = 2; // of the densest place
    for (size_t first = 0; first < rings.size(); ++first) {
        double flux = 0, squares = 0;
        for (size_t i = first; i < rings.size(); ++i) {
            const Ring &ring = rings[i];
            const double here = std::clamp(flux_within(ring.radius) - flux, 0.0, ring.flux);
            flux += here;
            squares += here * ring.squared;
        }
        scatter_.push_back(deviations * std::sqrt(group.brightest * squares));
    }
}

// Of sources of the group, at most so far from a pixel along both axes.
double Ways::flux_within(double radius) const {
    const double cells = 2 * radius / static_cast<double>(SourceGroup::wide_cell) + 1;
    return std::min(group_.flux, group_.wide_crowd * cells * cells);
}

double Ways::scatter_beyond(double radius) const {
    const double ring = std::log(std::max(radius + 1, 1.0)) / std::log(next_ring);
    return scatter_[std::min(static_cast<size_t>(ring), scatter_.size() - 1)];
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

// What is off in a stamp and beyond it is so in different pixels of one source, and meets by chance in
// those of several.
double Ways::meeting(double in_stamp, double beyond) const {
    return group_.count == 1 ? std::max(in_stamp, beyond) : std::hypot(in_stamp, beyond);
}

// By stamps of which a source's light is off so much `local`ly, and that leave out about all light
// beyond `from`, `cut` of a source's in any pixel.
PixelError Ways::left_out(const Way &way, double local, double from, double cut) const {
    const double light = mean(colour_.profile.beyond(from), cut);
    if (!way.is_smooth_beyond())
        return {local, light};
    return {std::hypot(local, scatter_beyond(from)), LightProfile::mean_varies * light};
}

void Ways::leave_far(const Way &way, double time_s, const Take &take) const {
    const double of_psf = psf_error(group_, colour_, budget_, way);
    PixelError error{of_psf, 0};
    if (way.radius < group_.reach) {
        if (colour_.profile.beyond(way.radius) > budget_.flux)
            return;
        // Spikes that fall on each other, and the mean of what others near by leave out.
        const double own = group_.densest * cut(way.radius);
        const double others =
            (group_.crowded - group_.densest) * colour_.profile.mean_at(way.radius);
        error = left_out(way, meeting(of_psf, own) + others, way.radius, cut(way.radius));
    }
    take({way, time_s, error});
}

// What far light is off beyond the stamps, as a share of a star's light; in units of the noise,
// where its own adds to that.
double Ways::far_off(const SharedFarLight &far, const Way &way) const {
    const auto of_edges = [this](double r) {
        return of_far(r) * colour_.far->error(r, group_.brightest, budget_.variance);
    };
    const auto of_light = [this](double share, double r) {
        const double brightest = colour_.far->brightest_beyond(r);
        return share * brightest / std::sqrt(1 + group_.brightest * brightest / budget_.variance);
    };
    const bool differs_by_place = way.far_drawing != FarDrawing::own;
    const double of_tables =
        interpolated + (differs_by_place ? mixed * std::pow(colour_.far_varies, 1.5) : 0);
    const double beyond = way.far_drawing == FarDrawing::nearest
                              ? of_light(off_nearest * colour_.far_varies, far.radius)
                              : 0;
    const double from = std::max(far.exact_radius, way.radius);
    const double farther = std::max(of_edges(from), beyond) + of_light(of_tables, from);
    if (from == way.radius)
        return farther;
    const double differences = colour_.varies ? of_differences * of_edges(way.radius) : 0;
    const double exact = of_exact_far_light * far.exact_eps * colour_.profile.peak();
    return std::max(differences + of_light(of_tables, way.radius) + exact, farther);
}

void Ways::add_far(const Way &way, double time_s, const SharedFarLight &far,
                   const Take &take) const {
    const FarReach &reach = *colour_.far;
    if (way.radius < reach.nearest() + 1 || way.radius >= group_.reach)
        return;
    const double of_psf = psf_error(group_, colour_, budget_, way);
    const bool too_bright =
        colour_.varies && same_beyond(colour_, group_.brightest, budget_) > far.differences_radius;
    for (const FarDrawing drawing : {FarDrawing::tables, FarDrawing::nearest, FarDrawing::own}) {
        if (too_bright && drawing != FarDrawing::own)
            continue;
        Way with = way;
        with.far_drawing = drawing;
        const double off = far_off(far, with);
        const double least =
            drawing == FarDrawing::own ? far.floor : std::max(far.floor, far.differences_floor);
        for (const FarReach::Step &step : reach.steps()) {
            if (group_.densest * step.floor > budget_.error())
                continue;
            if (step.floor < least ||
                2 * group_.densest * step.floor < negligible * budget_.error())
                break;
            // A table ends somewhere.
            const double farthest = std::min(step.radius, group_.reach);
            const double tables_end = std::min(farthest, far.radius);
            const double end = drawing == FarDrawing::tables ? tables_end : farthest;
            if (drawing == FarDrawing::nearest && end <= tables_end)
                continue;
            const double left =
                std::max(step.floor, end < farthest ? reach.brightest_beyond(end) : 0);
            const double fringes = drawing == FarDrawing::tables ? 0 : floors_left_out * step.floor;
            const double from = std::min(std::max(step.halo, way.radius), end);
            if (end <= way.radius || colour_.profile.beyond(from) > budget_.flux)
                continue;
            const double in_tables = step.pixels * tables_end / step.radius;
            double time = cost::far_blocks(in_tables);
            if (drawing == FarDrawing::nearest)
                time += cost::far_light(step.pixels - in_tables, pixels(end));
            if (drawing == FarDrawing::own)
                time += cost::making_far_light + cost::far_light(step.pixels, pixels(end)) +
                        cost::far_light(in_tables, pixels(tables_end));
            const double local = meeting(of_psf, group_.densest * std::max(left + off, fringes));
            with.far = step.floor;
            take({with, time_s + count() * time, left_out(way, local, from, left)});
        }
    }
}

void Ways::go_beyond(const Way &way, double time_s, const SharedFarLight &far,
                     const Take &take) const {
    if (far.needed)
        add_far(way, time_s, far, take);
    else
        leave_far(way, time_s, take);
}

double Ways::shared_stamps(double radius, double left_out) const {
    const double stamps = count() * cost::shared_stamp(width(radius), left_out);
    const bool differ = colour_.varies && differs * colour_.profile.peak() > left_out;
    return differ ? stamps + cost::places(count(), width(radius), left_out) : stamps;
}

void Ways::of_shared(double eps, double from, double to, const SharedFarLight &far,
                     const Take &take) const {
    const double peak = colour_.profile.peak();
    const double finest = eps / 2;
    for (const double share : falling(colour_.varies ? 1e-2 : eps, finest, 4)) {
        Way way{Drawing::shared, 0, eps, peak * share};
        if (share > 4 * finest && psf_error(group_, colour_, budget_, way) > budget_.error())
            continue;
        if (4 * group_.densest * way.left_out < negligible * budget_.error())
            break;
        for (const double radius : radii(std::min(to, group_.reach))) {
            if (radius <= from)
                continue;
            way.radius = radius;
            const double time = shared_stamps(radius, way.left_out);
            go_beyond(way, time, far, take);
        }
    }
}

void Ways::of_own(const SharedFarLight &far, const Take &take) const {
    const double largest = far.needed ? std::min(far.radius, group_.reach) : group_.reach;
    for (const double radius : radii(largest))
        for (const double eps : falling(1e-4, 1e-11, 10)) {
            if (10 * group_.densest * colour_.profile.peak() * eps < negligible * budget_.error())
                break;
            const double made = std::min(radius, Way::largest_field);
            double time = cost::psf(made, eps, colour_.bandwidth);
            if (radius > Way::largest_field)
                time += cost::large_stamp(pixels(radius), radius, colour_.bandwidth);
            else
                time += cost::stamp(width(radius), radius, eps);
            const Way way{Drawing::own, radius, eps};
            go_beyond(way, count() * time, far, take);
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
        take({{Drawing::fourier, radius, share}, count() * drawing, {off + place_error, left}});
        take({{Drawing::fourier_own, radius, share},
              count() * (drawing + cost::otf(colour_.bandwidth)),
              {off, left}});
    }
}

} // namespace wfpsf
