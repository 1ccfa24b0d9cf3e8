// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/plan.hpp"

#include "scene/cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace wfpsf {

namespace {

constexpr int least_octave = -64, octaves = 128;
constexpr double probe_eps = 1e-4, probe_radius = 32;

int octave_of(double flux) {
    const double magnitude = std::abs(flux);
    if (!(magnitude > 0))
        return least_octave;
    return std::clamp(std::ilogb(magnitude), least_octave, least_octave + octaves - 1);
}

// Squares of the detector that sources are drawn in one after another. What lies beyond the image
// counts to the tiles along its border.
class Tiles {
  public:
    explicit Tiles(const SceneImage &image)
        : x0_(image.x0), y0_(image.y0), nx_(tiles(image.nx, image)), ny_(tiles(image.ny, image)) {}

    size_t count() const { return static_cast<size_t>(nx_ * ny_); }
    size_t number(const PlacedSource &s) const {
        return static_cast<size_t>(tile_of(s.y - y0_, ny_) * nx_ + tile_of(s.x - x0_, nx_));
    }

    // Cells of SourceGroup::cell pixels within a tile.
    static constexpr int64_t cells_a_side = 4, cells = cells_a_side * cells_a_side;
    size_t cell(const PlacedSource &s) const {
        const auto along = [](double at) {
            const auto k = static_cast<int64_t>(std::floor(at / SourceGroup::cell)) % cells_a_side;
            return k < 0 ? k + cells_a_side : k;
        };
        return static_cast<size_t>(along(s.y - y0_) * cells_a_side + along(s.x - x0_));
    }

  private:
    static constexpr double side = SourceGroup::cell * cells_a_side; // native pixels

    static int64_t tiles(int64_t samples, const SceneImage &image) {
        return static_cast<int64_t>(std::ceil(static_cast<double>(samples) /
                                              static_cast<double>(image.oversampling) / side)) +
               2;
    }
    static int64_t tile_of(double at, int64_t count) {
        return static_cast<int64_t>(
            std::clamp(std::floor(at / side) + 1, 0.0, static_cast<double>(count - 1)));
    }

    double x0_, y0_;
    int64_t nx_, ny_;
};

// The relative width of a spectrum.
double bandwidth_of(const Light &light) {
    const Spectrum spectrum = light(0);
    const auto [blue, red] = std::ranges::minmax(spectrum.wavelength);
    return (red - blue) / spectrum.mean_wavelength();
}

// Stamps' radii that are tried, native pixels.
std::vector<double> radii(double largest) {
    std::vector<double> all;
    for (double r = 2; r < largest; r *= 1.25)
        all.push_back(std::ceil(r));
    all.push_back(largest);
    return all;
}

// A way to draw a group, with what it does.
struct Offer {
    StarWay way;
    double time_s, error; // of the group
};

// The ways of one group under a given shared model, or with PSFs of their own.
class Offers {
  public:
    Offers(const SourceGroup &group, const LightProfile &profile, const SceneBudget &budget,
           const SceneImage &image, double bandwidth, bool varies)
        : group_(group), profile_(profile), budget_(budget), image_(image), bandwidth_(bandwidth),
          varies_(varies), native_x_(static_cast<double>(image.nx) / n()),
          native_y_(static_cast<double>(image.ny) / n()) {}

    template <class Take> void from_shared(const SharedModel &model, const Take &take) const {
        for (const double radius : radii(std::min(model.radius, group_.reach)))
            for (double left_out = varies_ ? 1e-2 : model.eps; left_out >= model.eps / 2;
                 left_out /= 10) {
                const double psf_error = profile_.peak() * (model.eps + left_out);
                const double time =
                    cost::stamp(width(radius), varies_ ? cost::rank(left_out) : 1, per_pixel);
                take(Offer{{StarPsf::shared, radius, model.eps, profile_.peak() * left_out},
                           count() * time,
                           error(radius, psf_error)});
            }
    }

    template <class Take> void of_their_own(const Take &take) const {
        for (const double radius : radii(group_.reach))
            for (double eps = 1e-4; eps > 1e-11; eps /= 10) {
                const double made = std::min(radius, largest_field);
                double time = cost::psf(made, eps, bandwidth_);
                if (radius > largest_field)
                    time += cost::large_stamp(pixels(radius), radius, bandwidth_);
                else
                    time += cost::stamp(width(radius), 0, per_pixel);
                take(Offer{{StarPsf::own, radius, eps, 0},
                           count() * time,
                           error(radius, profile_.peak() * eps)});
            }
    }

  private:
    static constexpr double largest_field = StarWay::largest_field;
    static constexpr double per_pixel = 4;

    double n() const { return static_cast<double>(image_.oversampling); }
    double count() const { return static_cast<double>(group_.count); }
    double width(double radius) const { return std::sqrt(pixels(radius)); }
    double pixels(double radius) const {
        return std::min(2 * radius + 1, native_x_) * std::min(2 * radius + 1, native_y_) * n() *
               n();
    }
    // Of any pixel: what the densest cell leaves out at once, the mean of what all others do, and
    // the PSF's own error.
    double error(double radius, double psf_error) const {
        const bool complete = radius >= group_.reach;
        if (profile_.beyond(radius) > budget_.flux)
            return INFINITY;
        const double cut = complete ? 0 : profile_.brightest_beyond(radius);
        const double mean = complete ? 0
                                     : group_.flux * profile_.beyond(radius) /
                                           ((native_x_ + radius) * (native_y_ + radius));
        return group_.densest * (cut + psf_error) + mean;
    }

    const SourceGroup &group_;
    const LightProfile &profile_;
    const SceneBudget &budget_;
    const SceneImage &image_;
    double bandwidth_;
    bool varies_;
    double native_x_, native_y_;
};

// The best of some offers when an electron of error costs `price` seconds.
class Best {
  public:
    explicit Best(double price) : price_(price) {}
    void operator()(const Offer &offer) {
        const double total = offer.time_s + price_ * offer.error;
        if (total < total_) {
            total_ = total;
            offer_ = offer;
        }
    }
    double total() const { return total_; }
    const Offer &offer() const { return offer_; }

  private:
    double price_, total_ = INFINITY;
    Offer offer_{{}, INFINITY, INFINITY};
};

} // namespace

double SceneBudget::error() const {
    return noise * std::sqrt(variance);
}

ScenePlan::ScenePlan(const SceneOptics &optics, std::vector<PlacedSource> sources,
                     const SceneBudget &budget, const SceneImage &image)
    : budget_(budget), image_(image), sources_(std::move(sources)) {
    sort_sources();
    make_groups();
    PsfSettings probe = optics.settings;
    probe.eps = probe_eps;
    probe.radius = probe_radius;
    const Optics middle = optics.at(std::clamp(image.x0 + static_cast<double>(image.nx) / 2,
                                               optics.region.x0, optics.region.x1),
                                    std::clamp(image.y0 + static_cast<double>(image.ny) / 2,
                                               optics.region.y0, optics.region.y1));
    for (const Light &light : optics.lights)
        profiles_.emplace_back(make_psfs(middle, {&light, 1}, probe)[0]);
    choose(optics);
}

// By tiles, rows of tiles first, so that the image is written to in few places at a time.
void ScenePlan::sort_sources() {
    const Tiles tiles(image_);
    std::vector<size_t> begin(tiles.count() + 1);
    for (const PlacedSource &source : sources_)
        ++begin[tiles.number(source) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<PlacedSource> sorted(sources_.size());
    for (const PlacedSource &source : sources_)
        sorted[begin[tiles.number(source)]++] = source;
    sources_ = std::move(sorted);
}

size_t ScenePlan::group_index(const PlacedSource &source) const {
    return static_cast<size_t>(group_at_[static_cast<size_t>(
        source.colour * octaves + octave_of(source.flux) - least_octave)]);
}

void ScenePlan::make_groups() {
    int32_t colours = 1;
    for (const PlacedSource &source : sources_)
        colours = std::max(colours, source.colour + 1);
    group_at_.assign(static_cast<size_t>(colours * octaves), -1);
    const Tiles tiles(image_);
    const auto n = static_cast<double>(image_.oversampling);
    const auto reach = [&](const PlacedSource &s) {
        const double x1 = image_.x0 + static_cast<double>(image_.nx) / n;
        const double y1 = image_.y0 + static_cast<double>(image_.ny) / n;
        return std::ceil(std::max({std::abs(s.x - image_.x0), std::abs(s.x - x1),
                                   std::abs(s.y - image_.y0), std::abs(s.y - y1)}));
    };
    size_t tile = 0;
    std::vector<std::array<double, Tiles::cells>> in_cells; // of the present tile, by group
    for (const PlacedSource &source : sources_) {
        if (tiles.number(source) != tile) {
            tile = tiles.number(source);
            in_cells.assign(groups_.size(), {});
        }
        const int octave = octave_of(source.flux);
        int32_t &at =
            group_at_[static_cast<size_t>(source.colour * octaves + octave - least_octave)];
        if (at < 0) {
            at = static_cast<int32_t>(groups_.size());
            groups_.push_back({.colour = source.colour, .octave = octave});
            in_cells.emplace_back();
        }
        SourceGroup &group = groups_[static_cast<size_t>(at)];
        ++group.count;
        group.flux += std::abs(source.flux);
        group.reach = std::max(group.reach, reach(source));
        double &cell = in_cells[static_cast<size_t>(at)][tiles.cell(source)];
        cell += std::abs(source.flux);
        group.densest = std::max(group.densest, cell);
    }
}

void ScenePlan::choose(const SceneOptics &optics) {
    const size_t colours = optics.lights.size();
    std::vector<double> bandwidths;
    for (const Light &light : optics.lights)
        bandwidths.push_back(bandwidth_of(light));
    const auto offers_of = [&](const SourceGroup &group) {
        const auto colour = static_cast<size_t>(group.colour);
        return Offers(group, profiles_[colour], budget_, image_, bandwidths[colour], optics.varies);
    };
    // All that is needed for one colour at a price of error, by the best shared model for it.
    const auto settle_colour = [&](size_t colour, double price) {
        std::vector<Offer> own(groups_.size(), Offer{{}, INFINITY, INFINITY});
        double best_total = INFINITY;
        for (size_t g = 0; g < groups_.size(); ++g)
            if (groups_[g].colour == static_cast<int32_t>(colour)) {
                Best best(price);
                offers_of(groups_[g]).of_their_own(std::ref(best));
                own[g] = best.offer();
            }
        std::vector<Offer> taken = own;
        SharedModel chosen;
        const auto total_of = [price](const Offer &offer) {
            return offer.time_s + price * offer.error;
        };
        const auto consider = [&](const SharedModel &model) {
            double total = model.time_s;
            std::vector<Offer> now = own;
            for (size_t g = 0; g < groups_.size(); ++g) {
                if (groups_[g].colour != static_cast<int32_t>(colour))
                    continue;
                if (model.needed) {
                    Best best(price);
                    best(own[g]);
                    offers_of(groups_[g]).from_shared(model, std::ref(best));
                    now[g] = best.offer();
                }
                total += total_of(now[g]);
            }
            if (total < best_total) {
                best_total = total;
                taken = std::move(now);
                chosen = model;
            }
        };
        consider({});
        for (double eps = 1e-2; eps > 1e-10; eps /= 10)
            for (double radius = 8; radius <= 64; radius *= 2)
                consider({true, eps, radius,
                          cost::shared_psf(radius, eps, bandwidths[colour], optics.varies)});
        models_[colour] = chosen;
        for (size_t g = 0; g < groups_.size(); ++g)
            if (groups_[g].colour == static_cast<int32_t>(colour)) {
                groups_[g].way = taken[g].way;
                groups_[g].time_s = taken[g].time_s;
                groups_[g].error = taken[g].error;
            }
    };
    const auto settle = [&](double price) {
        models_.assign(colours, {});
        for (size_t colour = 0; colour < colours; ++colour)
            settle_colour(colour, price);
        time_s_ = error_ = 0;
        for (const SharedModel &model : models_)
            time_s_ += model.time_s;
        for (const SourceGroup &group : groups_) {
            time_s_ += group.time_s;
            error_ += group.error;
        }
    };
    // The lowest price of error at which all of it fits the budget.
    double low = -20, high = 20; // log10, s per e-
    settle(std::pow(10.0, high));
    if (groups_.empty() || !meets_budget())
        return;
    for (int step = 0; step < 24; ++step) {
        const double middle = (low + high) / 2;
        settle(std::pow(10.0, middle));
        (meets_budget() ? high : low) = middle;
    }
    settle(std::pow(10.0, high));
}

std::string ScenePlan::text() const {
    std::string text;
    const auto add = [&text](const char *format, auto... values) {
        char line[160];
        std::snprintf(line, sizeof line, format, values...);
        text += line;
    };
    add("%zu sources; error allowed %.3g e- a pixel, expected %.3g; time expected %.3g s\n",
        sources_.size(), budget_.error(), error_, time_s_);
    for (size_t c = 0; c < models_.size(); ++c)
        if (models_[c].needed)
            add("colour %zu: a PSF of the detector, eps %.0e, radius %g pixels: %.3g s\n", c,
                models_[c].eps, models_[c].radius, models_[c].time_s);
    add("%6s %12s %10s %8s %8s %9s %10s %10s\n", "colour", "flux from", "sources", "PSF", "radius",
        "eps", "error e-", "time s");
    std::vector<SourceGroup> sorted = groups_;
    std::ranges::sort(sorted, [](const SourceGroup &a, const SourceGroup &b) {
        return std::pair(a.colour, -a.octave) < std::pair(b.colour, -b.octave);
    });
    for (const SourceGroup &g : sorted)
        add("%6d %12.4g %10lld %8s %8g %9.0e %10.3g %10.3g\n", g.colour, std::ldexp(1.0, g.octave),
            static_cast<long long>(g.count), g.way.psf == StarPsf::own ? "own" : "shared",
            g.way.radius, g.way.eps, g.error, g.time_s);
    return text;
}

} // namespace wfpsf
