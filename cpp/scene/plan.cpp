// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/plan.hpp"

#include "numerics/bands.hpp"
#include "scene/cost.hpp"
#include "scene/far_table.hpp"
#include "scene/fingerprint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <tuple>

namespace wfpsf {

namespace {

double bandwidth_of(const Light &light) {
    const Spectrum spectrum = light(0);
    const auto [blue, red] = std::ranges::minmax(spectrum.wavelength);
    return (red - blue) / spectrum.mean_wavelength();
}

// The largest difference of the far light of other places from that of the first, as a share of the
// brightest there: about a circle.
double far_variation(std::span<const FarLight> at_places) {
    const double r = 2 * at_places[0].nearest();
    const auto half = static_cast<int64_t>(std::ceil(r));
    const auto middle = static_cast<double>(half);
    const double floor = 1e-3 * at_places[0].brightest_beyond(r);
    const auto image = [&](const FarLight &far) {
        Plane<double> light(2 * half + 1, 2 * half + 1);
        far.add({middle, middle, 1}, far.nearest(), floor, light.view());
        return light;
    };
    const Plane<double> first = image(at_places[0]);
    std::vector<std::pair<int64_t, int64_t>> circle;
    double most = 0, brightest = 0;
    for (int64_t y = 0; y < first.ny(); ++y)
        for (int64_t x = 0; x < first.nx(); ++x)
            if (std::abs(
                    std::hypot(static_cast<double>(x) - middle, static_cast<double>(y) - middle) -
                    r) < 0.5) {
                circle.emplace_back(x, y);
                brightest = std::max(brightest, first(x, y));
            }
    for (const FarLight &far : at_places.subspan(1)) {
        const Plane<double> other = image(far);
        for (const auto &[x, y] : circle)
            most = std::max(most, std::abs(first(x, y) - other(x, y)));
    }
    return most / brightest;
}

constexpr double safety_of_squares = 1.2;

// Models that are tried; radii in native pixels.
constexpr std::array model_eps{1e-2, 1e-3, 1e-4, 2.5e-5, 1e-5, 3e-6, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
constexpr std::array model_radii{8.0, 15.0, 22.0, 27.0, 33.0, 40.0, 48.0, 58.0, 70.0, 101.0, 128.0};

// Offers that another one beats in time and error are of no use at any price.
void add_useful(std::vector<Offer> &offers, const Offer &offer) {
    const auto beats = [](const Offer &a, const Offer &b) {
        return a.time_s <= b.time_s && a.error.local <= b.error.local &&
               a.error.mean <= b.error.mean;
    };
    if (std::ranges::any_of(offers, [&](const Offer &other) { return beats(other, offer); }))
        return;
    std::erase_if(offers, [&](const Offer &other) { return beats(offer, other); });
    offers.push_back(offer);
}

// The best of some offers when an electron of error costs `price` seconds, the local errors of all
// groups together being about `local`: what a square more adds to their root.
class Best {
  public:
    Best(double price, double local) : price_(price), local_(local) {}
    void consider(const Offer &offer) {
        if (total(offer) < total(offer_))
            offer_ = offer;
    }
    double total(const Offer &offer) const {
        const PixelError &e = offer.error;
        return offer.time_s +
               price_ * (safety_of_squares * e.local * e.local / (2 * local_) + e.mean);
    }
    const Offer &offer() const { return offer_; }

  private:
    double price_, local_;
    Offer offer_;
};

// The core of a PSF, in its middle.
Plane<double> core_of(const Optics &optics, const Light &light, const PsfSettings &settings) {
    Plane<double> image(17, 17);
    make_psfs(optics, {&light, 1}, settings)[0].draw({8, 8, 1}, 1, image.view());
    return image;
}

// The largest change of a PSF's pixels from the middle of a region to its corners, as a share of
// the light.
double change_over(const Region &region, const SceneOptics &optics, const Light &light) {
    const PsfSettings settings = probe_settings(optics.settings);
    const auto at = [&](double x, double y) {
        return core_of(optics.nearest(x, y), light, settings);
    };
    const Plane<double> middle = at((region.x0 + region.x1) / 2, (region.y0 + region.y1) / 2);
    double change = 0;
    for (const auto &[u, v] : {std::pair(region.x0, region.y0), std::pair(region.x1, region.y1)}) {
        const Plane<double> corner = at(u, v);
        for (int64_t y = 0; y < middle.ny(); ++y)
            for (int64_t x = 0; x < middle.nx(); ++x)
                change = std::max(change, std::abs(middle(x, y) - corner(x, y)));
    }
    return change;
}

// A change of the PSF adds no light: galaxies wider than it blur it away, but for the cusps of high
// indices. The smallest of the group is half as wide as the largest.
double after_blur(const SourceGroup &group) {
    const double radius = 0.6 * group.half_light;
    return group.index <= 1.5 ? 1 / (1 + std::pow(radius, 4)) : 1 / (1 + radius);
}

// Of what light makes there, whatever brought it about: to an eleventh digit, since machines differ in
// the last ones.
uint64_t key_of(const SceneOptics &optics, const Light &light, const SceneImage &image) {
    Fingerprint print;
    const Region &region = optics.region;
    for (const double value : {region.x0, region.y0, region.x1, region.y1, image.x0, image.y0,
                               image.native_x(), image.native_y()})
        print.add(value);
    PsfSettings settings = optics.settings;
    settings.eps = 1e-3;
    settings.radius = 8;
    for (const auto &[u, v] :
         {std::pair(0.5, 0.5), std::pair(0.1, 0.2), std::pair(0.9, 0.3), std::pair(0.3, 0.9)}) {
        const Optics here =
            optics.nearest(std::lerp(region.x0, region.x1, u), std::lerp(region.y0, region.y1, v));
        const Plane<double> core = core_of(here, light, settings);
        for (int64_t y = 0; y < core.ny(); ++y)
            for (int64_t x = 0; x < core.nx(); ++x)
                print.add(static_cast<int64_t>(std::llround(core(x, y) * 1e11)));
    }
    return print.value();
}

const char *name_of(Drawing drawing) {
    switch (drawing) {
    case Drawing::shared:
        return "shared";
    case Drawing::own:
        return "own";
    case Drawing::fourier:
        return "fourier";
    case Drawing::fourier_own:
        return "f. own";
    }
    return "";
}

} // namespace

PsfSettings probe_settings(PsfSettings settings) {
    settings.eps = 1e-4;
    settings.radius = 32;
    return settings;
}

double together(std::span<const PixelError> errors) {
    double squares = 0, mean = 0;
    for (const PixelError &error : errors) {
        squares += error.local * error.local;
        mean += error.mean;
    }
    return safety_of_squares * std::sqrt(squares) + mean;
}

Optics SceneOptics::nearest(double x, double y) const {
    return at(std::clamp(x, region.x0, region.x1), std::clamp(y, region.y0, region.y1));
}

Optics SceneOptics::middle() const {
    return at((region.x0 + region.x1) / 2, (region.y0 + region.y1) / 2);
}

ScenePlan::ScenePlan(const SceneOptics &optics, std::vector<PlacedSource> sources,
                     std::span<const GalaxyShape> shapes, const SceneBudget &budget,
                     const SceneImage &image, const SceneReuse &reuse, int threads)
    : budget_(budget), image_(image), reuse_(reuse), sources_(std::move(sources)),
      shapes_(shapes.begin(), shapes.end()) {
    groups_ = std::make_unique<SourceGroups>(sources_, shapes_, optics.pixel_scale_arcsec, image);
    for (const SourceGroup &group : groups_->all())
        planned_.push_back({group, {}});
    learn_colours(optics, threads);
    choose_galaxy_cells(optics);
    choose();
}

void ScenePlan::learn_colours(const SceneOptics &optics, int threads) {
    for (size_t c = 0; c < optics.lights.size(); ++c) {
        const Light &light = optics.lights[c];
        Colour &colour = colours_.emplace_back();
        if (reuse_.store) {
            colour.key = key_of(optics, light, image_);
            colour.kept = reuse_.store->find(colour.key);
        }
        double brightest = 0;
        for (const PlannedGroup &planned : planned_)
            if (planned.group.colour == static_cast<int32_t>(c))
                brightest = std::max(brightest, planned.group.brightest);
        const auto known = colour.kept.facts;
        colour.kept.facts = facts_of(optics, light, brightest, known, threads);
        if (reuse_.store && colour.kept.facts != known)
            reuse_.store->keep(colour.key, {.facts = colour.kept.facts});
    }
}

// Bright stars are seen farther; far light is known only if it matters.
std::shared_ptr<const ColourFacts> ScenePlan::facts_of(const SceneOptics &optics,
                                                       const Light &light, double brightest,
                                                       std::shared_ptr<const ColourFacts> known,
                                                       int threads) const {
    const auto matters_beyond = [&](const LightProfile &profile) {
        return brightest * profile.brightest_beyond(profile.seen()) > 0.5 * budget_.error();
    };
    if (known && (known->is_complete || !matters_beyond(known->profile)))
        return known;
    const Optics middle = optics.middle();
    PsfSettings settings = probe_settings(optics.settings);
    auto made = std::make_shared<ColourFacts>();
    ColourFacts &facts = *made;
    const auto look = [&] {
        facts.profile = LightProfile(make_psfs(middle, {&light, 1}, settings)[0]);
        return matters_beyond(facts.profile);
    };
    bool is_bright = look();
    if (is_bright) {
        settings.radius = 64;
        is_bright = look();
    }
    facts.bandwidth = bandwidth_of(light);
    facts.varies = optics.varies;
    if (!is_bright)
        return made;
    facts.is_complete = true;
    const auto places = FarTables::places(region(), optics.varies);
    std::vector<std::optional<FarLight>> at_places(places.size());
    share_out(std::ssize(places), threads, [&](int64_t i) {
        const auto k = static_cast<size_t>(i);
        const auto &[x, y] = places[k];
        at_places[k] = far_light_of(optics.nearest(x, y), light, settings);
    });
    for (std::optional<FarLight> &there : at_places)
        if (there)
            facts.far_lights.push_back(std::move(*there));
    if (facts.far_lights.empty())
        return made;
    const FarLight &far = facts.far_lights[0];
    const double from = 0.75 * facts.profile.seen();
    facts.far.emplace(
        far, std::min(1.0, facts.profile.brightest_beyond(from) / far.brightest_beyond(from)));
    facts.far_varies = far_variation(facts.far_lights);
    return made;
}

Region ScenePlan::region() const {
    return {image_.x0, image_.y0, image_.x0 + image_.native_x(), image_.y0 + image_.native_y()};
}

// As few as keep the error small that a galaxy's PSF is not that of its place.
void ScenePlan::choose_galaxy_cells(const SceneOptics &optics) {
    cell_error_.assign(planned_.size(), 0);
    if (!optics.varies)
        return;
    std::vector<double> change(colours_.size(), -1);
    double squares = 0;
    for (size_t g = 0; g < planned_.size(); ++g) {
        const SourceGroup &group = planned_[g].group;
        if (!group.is_galaxy)
            continue;
        const auto c = static_cast<size_t>(group.colour);
        if (change[c] < 0)
            change[c] = change_over(region(), optics, optics.lights[c]);
        cell_error_[g] = group.densest * change[c] * after_blur(group);
        squares += cell_error_[g] * cell_error_[g];
    }
    constexpr double share = 0.4; // of the budget
    constexpr int most = 8;
    galaxy_cells_ = static_cast<int>(
        std::clamp(std::ceil(safety_of_squares * std::sqrt(squares) / (share * budget_.error())),
                   1.0, static_cast<double>(most)));
    for (double &error : cell_error_)
        error /= galaxy_cells_;
}

// Tables that a colour may have.
std::vector<SharedFarLight> ScenePlan::far_lights(int32_t colour) const {
    const ColourFacts &facts = this->colour(colour);
    std::vector<SharedFarLight> all;
    if (!facts.far)
        return all;
    double brightest = 0;
    for (const PlannedGroup &planned : planned_)
        if (planned.group.colour == colour)
            brightest = std::max(brightest, planned.group.densest);
    const double eps = exact_far_eps(brightest, facts, budget_);
    const KeptPsfs there = kept(colour);
    const double scenes = there.tables ? 1 : reuse_.scenes; // as for models
    // As far out as exact light may be of use.
    for (const double exact :
         {0.0, 48.0, 64.0, 96.0, 128.0, 192.0, 256.0, 304.0, 362.0, 430.0, 512.0}) {
        SharedFarLight &far = all.emplace_back();
        far.needed = true;
        far.exact_radius = exact;
        far.exact_eps = eps;
        far.radius = std::max(exact, 256.0);
        const double time = exact > 0 ? cost::psf(exact, eps, facts.bandwidth) : 0;
        far.time_s = (cost::far_tables(far.radius, facts.varies) + time) / scenes;
        constexpr double little = 0.1; // of the budget
        if (brightest * facts.far->error(exact, brightest, budget_.variance) <
            little * budget_.error())
            break;
    }
    if (there.tables) {
        all.push_back(there.far);
        all.back().time_s = 0;
    }
    return all;
}

// What is made anew beside something that is there must save its time at once: else scenes in turn
// would make it for each other.
double ScenePlan::time_of(const SharedModel &model, int32_t colour) const {
    const KeptPsfs there = kept(colour);
    if (there.serves(model))
        return 0;
    const ColourFacts &facts = this->colour(colour);
    const double time = cost::shared_psf(model.radius, model.eps, facts.bandwidth, facts.varies);
    return there.psf ? time : time / reuse_.scenes;
}

// Finer ones are of no use, and are not there.
double ScenePlan::finest_model(int32_t colour) const {
    constexpr double negligible = 0.01; // of the budget
    const KeptPsfs there = kept(colour);
    for (const double eps : model_eps) {
        const auto error = [&](const SourceGroup &group, double of) {
            return psf_error(group, this->colour(colour), budget_,
                             {.drawing = Drawing::shared, .eps = of});
        };
        double most = 0;
        for (const PlannedGroup &planned : planned_)
            if (planned.group.colour == colour)
                most = std::max(most, error(planned.group, eps) - error(planned.group, 0));
        if (most < negligible * budget_.error() && !(there.psf && there.model.eps < eps))
            return eps;
    }
    return model_eps.back();
}

void ScenePlan::collect_offers() {
    std::vector<Ways> ways;
    ways.reserve(planned_.size());
    for (const PlannedGroup &planned : planned_)
        ways.emplace_back(planned.group, colour(planned.group.colour), budget_, image_);
    shared_.assign(colours_.size(), {});
    for (size_t c = 0; c < colours_.size(); ++c) {
        const auto colour = static_cast<int32_t>(c);
        // What ask(Ways, group, Take) takes for the groups of the colour.
        const auto offers = [&](const auto &ask) {
            Offers useful(planned_.size());
            for (size_t g = 0; g < planned_.size(); ++g)
                if (planned_[g].group.colour == colour)
                    ask(ways[g], g, [&](const Offer &offer) { add_useful(useful[g], offer); });
            return useful;
        };
        const double finest = finest_model(colour);
        std::vector<SharedFarLight> far_lights{{}}; // none
        std::ranges::copy(this->far_lights(colour), std::back_inserter(far_lights));
        for (const SharedFarLight &far : far_lights) {
            WithFar &with = shared_[c].emplace_back();
            with.far = far;
            with.own = offers([&](const Ways &of, size_t g, const Take &take) {
                of.of_own(far, take);
                if (!far.needed)
                    of.of_fourier(cell_error_[g], take);
            });
            for (const double eps : model_eps) {
                double before = 0;
                for (const double radius : model_radii) {
                    SharedModel model{true, eps, radius};
                    model.time_s = time_of(model, colour);
                    with.models.push_back(
                        {model, offers([&](const Ways &of, size_t, const Take &take) {
                             of.of_shared(eps, before, radius, far, take);
                         })});
                    before = radius;
                }
                if (eps == finest)
                    break;
            }
        }
    }
}

// What is best for a colour at a price of error, by the best shared model and tables for it.
void ScenePlan::settle_colour(int32_t colour, double price) {
    std::vector<size_t> of_colour;
    for (size_t g = 0; g < planned_.size(); ++g)
        if (planned_[g].group.colour == colour)
            of_colour.push_back(g);
    std::vector<Best> taken;
    SharedModel model;
    SharedFarLight far;
    double least = INFINITY;
    const auto consider = [&](const Offers &offers, std::vector<Best> &best) {
        for (size_t i = 0; i < of_colour.size(); ++i)
            for (const Offer &offer : offers[of_colour[i]])
                best[i].consider(offer);
    };
    const auto settle_for = [&](const std::vector<Best> &best, const SharedModel &of_model,
                                const SharedFarLight &of_far) {
        double total = of_model.time_s + of_far.time_s;
        for (const Best &of_group : best)
            total += of_group.total(of_group.offer());
        if (total < least) {
            least = total;
            taken = best;
            model = of_model;
            far = of_far;
        }
    };
    const std::vector<WithFar> &all = shared_[static_cast<size_t>(colour)];
    std::vector<Best> none(of_colour.size(),
                           Best(price, budget_.error() / (2 * safety_of_squares)));
    consider(all[0].own, none);
    for (const WithFar &with : all) {
        std::vector<Best> without = none; // a model
        consider(with.own, without);
        settle_for(without, {}, with.far);
        std::vector<Best> best;
        for (size_t m = 0; m < with.models.size(); ++m) {
            const WithModel &of = with.models[m];
            if (m == 0 || of.model.eps != with.models[m - 1].model.eps)
                best = without;
            // Stars need not have far light.
            consider(all[0].models[m].offers, best);
            consider(of.offers, best);
            settle_for(best, of.model, with.far);
        }
    }
    models_[static_cast<size_t>(colour)] = model;
    far_[static_cast<size_t>(colour)] = far;
    for (size_t i = 0; i < of_colour.size(); ++i) {
        const Offer &offer = taken[i].offer();
        PlannedGroup &planned = planned_[of_colour[i]];
        planned = {planned.group, offer.way, offer.time_s, offer.error};
    }
}

void ScenePlan::settle(double price) {
    models_.assign(colours_.size(), {});
    far_.assign(colours_.size(), {});
    time_s_ = 0;
    for (size_t colour = 0; colour < colours_.size(); ++colour) {
        settle_colour(static_cast<int32_t>(colour), price);
        time_s_ += models_[colour].time_s + far_[colour].time_s;
    }
    std::vector<PixelError> errors;
    for (const PlannedGroup &planned : planned_) {
        time_s_ += planned.time_s;
        errors.push_back(planned.error);
    }
    error_ = together(errors);
}

// The lowest price of error at which all of it fits the budget. Where nothing does, that at which
// it comes close to the least error there is: one group that is beyond help must not make all
// others dear.
void ScenePlan::choose() {
    constexpr double close = 1.2;
    collect_offers();
    double low = -12, high = 12; // log10, s per e-
    settle(std::pow(10.0, high));
    if (planned_.empty())
        return;
    const double target = meets_budget() ? budget_.error() : close * error_;
    while (high - low > 0.02) {
        const double middle = (low + high) / 2;
        settle(std::pow(10.0, middle));
        (error_ <= target ? high : low) = middle;
    }
    settle(std::pow(10.0, high));
}

// The sources and the stars made of them; models and tables; a PSF drawn by itself.
int64_t ScenePlan::memory() const {
    constexpr double of_star = sizeof(Star) + sizeof(StarDetail), batches = 3e7;
    double held = static_cast<double>(sources_.size()) * (sizeof(PlacedSource) + of_star) + batches;
    double alone = 0;
    const auto add_alone = [&](double radius, double eps, const ColourFacts &facts) {
        alone = std::max(alone, cost::psf_memory(radius, eps, facts.bandwidth));
    };
    for (size_t c = 0; c < colours_.size(); ++c) {
        const ColourFacts &facts = colour(static_cast<int32_t>(c));
        if (const SharedModel &model = models_[c]; model.needed)
            held += cost::shared_psf_memory(model.radius, model.eps, facts.bandwidth, facts.varies);
        if (const SharedFarLight &far = far_[c]; far.needed) {
            held += cost::far_tables_memory(far.radius, facts.varies);
            if (far.exact_radius > 0)
                add_alone(far.exact_radius, far.exact_eps, facts);
        }
    }
    for (const PlannedGroup &planned : planned_)
        if (planned.way.drawing == Drawing::own)
            add_alone(std::min(planned.way.radius, Way::largest_field), planned.way.eps,
                      colour(planned.group.colour));
    return static_cast<int64_t>(held + alone);
}

std::string ScenePlan::text() const {
    std::string text;
    const auto add = [&text](const char *format, auto... values) {
        char line[200];
        std::snprintf(line, sizeof line, format, values...);
        text += line;
    };
    add("%zu sources; error of a pixel: allowed %.3g e-, expected %.3g; time expected %.3g s\n",
        sources_.size(), budget_.error(), error_, time_s_);
    for (size_t c = 0; c < models_.size(); ++c)
        if (models_[c].needed)
            add("colour %zu: PSF of the detector, eps %.0e, radius %g pixels, %.3g s\n", c,
                models_[c].eps, models_[c].radius, models_[c].time_s);
    for (size_t c = 0; c < far_.size(); ++c)
        if (far_[c].needed)
            add("colour %zu: tables of far light, exact to %g pixels, %.3g s\n", c,
                far_[c].exact_radius, far_[c].time_s);
    if (galaxy_cells_ > 1)
        add("galaxies: PSFs of %d x %d parts of the detector\n", galaxy_cells_, galaxy_cells_);
    add("%6s %6s %10s %9s %8s %7s %7s %7s %9s %9s\n", "colour", "kind", "flux >=", "sources", "PSF",
        "radius", "eps", "far", "error e-", "time s");
    std::vector<PlannedGroup> sorted = planned_;
    std::ranges::sort(sorted, [](const PlannedGroup &a, const PlannedGroup &b) {
        return std::tuple(a.group.colour, a.group.is_galaxy, -a.group.octave) <
               std::tuple(b.group.colour, b.group.is_galaxy, -b.group.octave);
    });
    for (const PlannedGroup &g : sorted)
        add("%6d %6s %10.4g %9lld %8s %7g %7.0e %7.0e %9.2g %9.2g\n", g.group.colour,
            g.group.is_galaxy ? "galaxy" : "star", std::ldexp(1.0, g.group.octave),
            static_cast<long long>(g.group.count), name_of(g.way.drawing), g.way.radius, g.way.eps,
            g.way.far, g.error.local + g.error.mean, g.time_s);
    return text;
}

} // namespace wfpsf
