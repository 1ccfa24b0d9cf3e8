// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/varying_light.hpp"

#include "error/error.hpp"
#include "image/sampling.hpp"
#include "numerics/chebyshev.hpp"
#include "numerics/leja.hpp"
#include "optics/add_stars.hpp"
#include "optics/cell_psf.hpp"
#include "optics/field_terms.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace wfpsf {

namespace {

// Native pixels beyond the radius that fields reach: a stamp's pixels are polynomials of the star's
// place all over the pixel that holds it.
constexpr double margin = 1;

// How eps is shared out: to the exact PSFs, to the fields that are left out, to the interpolation,
// and to what is left out of single stars.
constexpr double share_of_exact = 0.55, share_of_modes = 0.05, share_of_places = 0.3,
                 share_of_stars = 0.1;
// How that is shared out in turn: to the coefficients for all places, to a cell's polynomials, to its
// coefficients, and to stars.
constexpr double share_of_all = 0.1, share_of_cells = 0.25, share_of_building = 0.25,
                 share_of_drawing = 0.4;

// Of all work, that of the first exact field.
constexpr double first_part = 0.1;

// A degree's first places tell whether the polynomials below it will do. Before all of them are
// known, errors must be smaller by a factor for each that is not.
constexpr size_t tests_per_degree = 3;
constexpr double before_all = 4;

PsfSettings exact_settings(PsfSettings settings, bool varies) {
    if (varies)
        settings.eps *= share_of_exact;
    return settings;
}

} // namespace

VaryingLight::VaryingLight(const OpticsAt &optics, bool varies, const Light &light,
                           const PsfSettings &settings, const Region &region,
                           const Manners &manners)
    : settings_(settings), region_(region),
      plain_(std::move(
          make_fields(optics((region.x0 + region.x1) / 2, (region.y0 + region.y1) / 2), {&light, 1},
                      exact_settings(settings, varies), settings.radius + margin,
                      {manners.progress.between(0, first_part), manners.memory_limit})[0])) {
    const KeptMemory kept;
    exact_psfs_ = 1;
    error_ = plain_.error;
    mode_.push_back({0, 0, plain_.value, {}});
    mode_[0].find_brightest(plain_.per_pixel);
    if (varies)
        expand(optics, manners);
}

// Farther from the core PSFs vary by less, and a low degree will do.
void VaryingLight::expand(const OpticsAt &optics, const Manners &manners) {
    for (const double brightest : mode_[0].brightest)
        falls_.push_back(std::max(error_far_off, std::sqrt(brightest / mode_[0].largest())));
    FieldTerms terms(
        plain_,
        [this, &optics](double u, double v) {
            return optics(std::lerp(region_.x0, region_.x1, (1 + u) / 2),
                          std::lerp(region_.y0, region_.y1, (1 + v) / 2));
        },
        settings_);
    double done = first_part; // at each degree half of what was left
    double radius = settings_.radius + margin;
    while (radius > 0 && degree_ < largest_chebyshev_degree) {
        ++degree_;
        const size_t first = terms.count(), all = LejaPolynomials::count(degree_);
        const size_t tests = std::min(all, first + tests_per_degree);
        manners.require_memory(terms.memory(all - first, radius), "a PSF that varies so much");
        const Progress progress = manners.progress.between(done, (1 + done) / 2);
        done = (1 + done) / 2;
        std::vector<double> by_ring(falls_.size());
        for (size_t k = first; k < all && radius > 0; k = terms.count()) {
            progress.report(static_cast<double>(k - first) / static_cast<double>(all - first));
            if (k < tests) { // each tells how far the next one has to reach
                terms.add(1, radius, by_ring);
                radius = std::min(radius, measure(by_ring, std::pow(before_all, tests - 1 - k)));
            } else {
                terms.add(std::min(static_cast<size_t>(manners.threads), all - k), radius, by_ring);
            }
        }
    }
    exact_psfs_ = static_cast<int64_t>(terms.count());
    mode_ = terms.take_modes();
    std::ranges::stable_sort(mode_, std::ranges::greater(), &LightMode::largest);
    const LeftOut left_out(mode_, std::vector<double>(mode_.size(), 1));
    const double little = share_of_modes * settings_.eps * plain_.faintest_peak;
    while (mode_.size() > 1 && left_out.but_for(mode_.size() - 1) < little)
        mode_.pop_back();
    error_ = terms.error() + interpolation_error_ + share_of_stars * settings_.eps;
}

double VaryingLight::measure(const std::vector<double> &by_ring, double safety) {
    size_t wrong = by_ring.size(); // rings within
    while (wrong > 0 &&
           safety * by_ring[wrong - 1] <= share_of_places * settings_.eps * falls_[wrong - 1])
        --wrong;
    interpolation_error_ = std::max(error_beyond_, safety * by_ring[0]);
    if (wrong < by_ring.size())
        error_beyond_ = std::max(error_beyond_, safety * by_ring[wrong]);
    return static_cast<double>(wrong);
}

VaryingLight::Place VaryingLight::scaled(double x, double y) const {
    const auto scaled = [](double at, double low, double high) {
        return std::clamp(2 * (at - low) / (high - low) - 1, -1.0, 1.0);
    };
    return {scaled(x, region_.x0, region_.x1), scaled(y, region_.y0, region_.y1)};
}

bool VaryingLight::is_inside(double x, double y) const {
    return x >= region_.x0 && x <= region_.x1 && y >= region_.y0 && y <= region_.y1;
}

Field VaryingLight::field(double x, double y) const {
    if (!is_inside(x, y))
        fail(WFPSF_ERROR_RANGE, "(x, y) = (%g, %g): must lie in %g..%g, %g..%g", x, y, region_.x0,
             region_.x1, region_.y0, region_.y1);
    const auto [u, v] = scaled(x, y);
    const auto along_u = chebyshev(u, degree_), along_v = chebyshev(v, degree_);
    Field field = plain_;
    field.value = Plane<double>(field.value.nx(), field.value.ny());
    for (const LightMode &mode : mode_)
        add_within(along_u[static_cast<size_t>(mode.i)] * along_v[static_cast<size_t>(mode.j)],
                   mode.light, mode.light.nx(), field.value);
    field.find_peaks();
    field.error = error_;
    return field;
}

template <class T>
void VaryingLight::add(std::span<const Star> stars, double x0, double y0, int64_t oversampling,
                       View<T> image, int threads) const {
    const auto n = static_cast<double>(oversampling);
    const double radius = settings_.radius * n;
    // Nothing is added unless all have a PSF.
    for (size_t i = 0; i < stars.size(); ++i) {
        const Star &star = stars[i];
        const double x = x0 + native_of(star.x, n), y = y0 + native_of(star.y, n);
        const bool seen = star.x >= -radius && star.x <= static_cast<double>(image.nx) + radius &&
                          star.y >= -radius && star.y <= static_cast<double>(image.ny) + radius;
        if (seen && !is_inside(x, y))
            fail(WFPSF_ERROR_RANGE,
                 "star %zu: stands at (%g, %g) of the detector, must lie in %g..%g, %g..%g", i, x,
                 y, region_.x0, region_.x1, region_.y0, region_.y1);
    }
    const StarDetail all{settings_.radius, share_of_stars * settings_.eps * plain_.faintest_peak};
    add(stars, std::vector(stars.size(), all), x0, y0, oversampling, image, threads);
}

// Stars whose PSFs are those of one cell.
struct VaryingLight::CellStars {
    DetectorCell cell;
    double radius = 0, left_out = INFINITY; // of any
    std::vector<size_t> stars;
};

std::vector<VaryingLight::CellStars>
VaryingLight::by_cell(std::span<const size_t> which, std::span<const Place> places,
                      std::span<const StarDetail> details) const {
    // Stars that may lack little need small cells, and have theirs apart from others. Many stars
    // are worth more cells than they need: nearer to the middle fewer corrections count.
    struct Class {
        size_t stars = 0;
        int64_t across = 0; // cells along each axis
    };
    std::map<double, Class> classes; // by left_out
    for (const size_t i : which)
        ++classes[details[i].left_out].stars;
    constexpr size_t enough = 400; // in a cell
    constexpr int64_t most = 64;
    for (auto &[left_out, own] : classes) {
        own.across = cells_across(mode_, share_of_cells * left_out, most);
        while (own.across > 0 && 2 * own.across <= most &&
               own.stars > enough * static_cast<size_t>(4 * own.across * own.across))
            own.across *= 2;
    }
    struct Key {
        int64_t across, b, a; // cells along each axis, and which
        auto operator<=>(const Key &) const = default;
    };
    std::map<Key, CellStars> cells;
    std::vector<CellStars> all;
    const auto alone = [&](size_t i) {
        all.push_back({{places[i].x, places[i].y, 0}, details[i].radius, details[i].left_out, {i}});
    };
    for (const size_t i : which) {
        const StarDetail &detail = details[i];
        const int64_t across = classes[detail.left_out].across;
        if (across == 0) {
            alone(i);
            continue;
        }
        const double half = 1 / static_cast<double>(across);
        const auto along = [across, half](double at) {
            return std::min(static_cast<int64_t>((at + 1) / (2 * half)), across - 1);
        };
        const Key key{across, along(places[i].y), along(places[i].x)};
        CellStars &cell = cells[key];
        cell.cell = {half * static_cast<double>(2 * key.a + 1 - across),
                     half * static_cast<double>(2 * key.b + 1 - across), half};
        cell.radius = std::max(cell.radius, detail.radius);
        cell.left_out = std::min(cell.left_out, detail.left_out);
        cell.stars.push_back(i);
    }
    constexpr size_t few = 30; // stars, that take no longer one by one
    for (auto &[key, cell] : cells) {
        if (cell.stars.size() > few)
            all.push_back(std::move(cell));
        else
            std::ranges::for_each(cell.stars, alone);
    }
    return all;
}

namespace {

// How far coefficients for stars anywhere pay: they take as long to make as some stars of that radius
// take to draw by themselves. 0: not at all.
double worthwhile_reach(std::span<const size_t> which, std::span<const StarDetail> details) {
    constexpr double some = 100;
    std::vector<double> radii;
    for (const size_t i : which)
        radii.push_back(details[i].radius);
    std::ranges::sort(radii, std::greater());
    double reach = 0, least = INFINITY, alone = 0; // the latter those that are wider
    for (const double radius : radii) {
        const double time = some * radius * radius + alone;
        if (time < least) {
            least = time;
            reach = radius;
        }
        alone += radius * radius;
    }
    return alone < least ? 0 : reach;
}

} // namespace

template <class T>
void VaryingLight::add(std::span<const Star> stars, std::span<const StarDetail> details, double x0,
                       double y0, int64_t oversampling, View<T> image, int threads) const {
    const auto n = static_cast<double>(oversampling);
    std::vector<Place> places;
    double low = INFINITY, high = -INFINITY; // rows
    for (size_t i = 0; i < stars.size(); ++i) {
        const Star &star = stars[i];
        places.push_back(scaled(x0 + native_of(star.x, n), y0 + native_of(star.y, n)));
        low = std::min(low, star.y - n * details[i].radius);
        high = std::max(high, star.y + n * details[i].radius);
    }
    if (image.empty() || stars.empty())
        return;
    const auto on_rows = [&](const auto &work) {
        on_bands_of_rows(low, high, image.ny, threads, [&](int64_t first_row, int64_t last_row) {
            const KeptMemory kept;
            StarRows<T> rows(oversampling, image, first_row, last_row);
            work(rows);
        });
    };
    // From coefficients of type S, unless they are so few that making those takes longer; returns
    // the others, and those that coefficients will not do for.
    const auto by_cells = [&]<class S>(S, const std::vector<size_t> &which) {
        StarDetail most{worthwhile_reach(which, details), INFINITY};
        const auto is_near = [&](size_t i) { return details[i].radius <= most.radius; };
        for (const size_t i : which)
            if (is_near(i))
                most.left_out = std::min(most.left_out, details[i].left_out);
        if (most.radius == 0)
            return which;
        const CellPsf<S> all(mode_, plain_, most.radius, oversampling, share_of_all * most.left_out,
                             threads);
        std::vector<size_t> served, others;
        for (const size_t i : which)
            (is_near(i) && all.serves(share_of_all * details[i].left_out) ? served : others)
                .push_back(i);
        const std::vector<CellStars> cells = by_cell(served, places, details);
        on_rows([&](StarRows<T> &rows) {
            CellPsf<S> anywhere(all);
            for (const CellStars &cell : cells) {
                const bool alone = cell.cell.half == 0;
                std::optional<CellPsf<S>> own;
                for (const size_t i : cell.stars) {
                    if (!rows.reached_by(stars[i], details[i].radius))
                        continue;
                    if (!alone && !own)
                        own.emplace(all, cell.cell, share_of_building * cell.left_out);
                    (alone ? anywhere : *own)
                        .add(stars[i], places[i].x, places[i].y, details[i].radius,
                             share_of_drawing * details[i].left_out, rows);
                }
            }
        });
        return others;
    };
    std::vector<size_t> loose, tight;
    constexpr double rounding = 1e-6; // of a few sums
    for (size_t i = 0; i < stars.size(); ++i)
        (details[i].left_out > rounding * mode_[0].largest() ? loose : tight).push_back(i);
    std::vector<size_t> alone = by_cells(float(), loose);
    std::ranges::copy(by_cells(double(), tight), std::back_inserter(alone));
    on_rows([&](StarRows<T> &rows) {
        for (const size_t i : alone) {
            const auto &[radius, left_out] = details[i];
            if (!rows.reached_by(stars[i], radius))
                continue;
            if (mode_.size() == 1)
                rows.add(plain_, stars[i], radius);
            else
                rows.add(field_at(mode_, places[i].x, places[i].y, plain_, radius, left_out),
                         stars[i], radius);
        }
    });
}

int64_t VaryingLight::memory() const {
    int64_t samples = plain_.value.nx() * plain_.value.ny();
    for (const LightMode &mode : mode_)
        samples += mode.light.nx() * mode.light.ny();
    return samples * static_cast<int64_t>(sizeof(double));
}

template void VaryingLight::add(std::span<const Star>, std::span<const StarDetail>, double, double,
                                int64_t, View<float>, int) const;
template void VaryingLight::add(std::span<const Star>, std::span<const StarDetail>, double, double,
                                int64_t, View<double>, int) const;
template void VaryingLight::add(std::span<const Star>, double, double, int64_t, View<float>,
                                int) const;
template void VaryingLight::add(std::span<const Star>, double, double, int64_t, View<double>,
                                int) const;

} // namespace wfpsf
