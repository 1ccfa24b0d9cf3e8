// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/render.hpp"

#include "image/sampling.hpp"
#include "numerics/bands.hpp"
#include "optics/add_stars.hpp"
#include "scene/faint_light.hpp"
#include "scene/far_table.hpp"
#include "scene/galaxy.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

namespace wfpsf {

namespace {

class Clock {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// From pixels of the detector to samples of the image.
class Frame {
  public:
    explicit Frame(const SceneImage &image)
        : image_(image), n_(static_cast<double>(image.oversampling)) {}
    Star star(const PlacedSource &source) const {
        return {sample_of(source.x - image_.x0, n_), sample_of(source.y - image_.y0, n_),
                source.flux};
    }
    bool reaches(const Star &star, double radius) const {
        const double r = radius * n_;
        return star.x >= -r && star.x <= static_cast<double>(image_.nx - 1) + r && star.y >= -r &&
               star.y <= static_cast<double>(image_.ny - 1) + r;
    }

  private:
    const SceneImage &image_;
    double n_;
};

// The pixels of an image within a radius of a star along both axes, and the star there.
template <class T> struct Window {
    View<T> part;
    Star star;

    Window(const Star &of, double radius, View<T> image) : star(of) {
        const auto range = [radius](double at, int64_t size) {
            const auto last = static_cast<double>(size);
            return std::pair{
                static_cast<int64_t>(std::ceil(std::clamp(at - radius, 0.0, last))),
                static_cast<int64_t>(std::floor(std::clamp(at + radius, -1.0, last - 1)))};
        };
        const auto [x0, x1] = range(of.x, image.nx);
        const auto [y0, y1] = range(of.y, image.ny);
        if (x0 > x1 || y0 > y1)
            return;
        part = {&image(x0, y0), x1 - x0 + 1, y1 - y0 + 1, image.stride_x, image.stride_y};
        star.x -= static_cast<double>(x0);
        star.y -= static_cast<double>(y0);
    }
};

template <class T> class Renderer {
  public:
    Renderer(const SceneOptics &optics, const ScenePlan &plan, View<T> image, int threads,
             const Manners &manners)
        : optics_(optics), plan_(plan), image_(image), frame_(plan.image()), threads_(threads),
          manners_(manners), models_(plan.models().size()), tables_(models_.size()) {}

    RenderReport run() {
        make_models();
        find_error();
        draw_shared();
        draw_galaxies();
        draw_own();
        return report_;
    }

  private:
    void make_models() {
        const Clock clock;
        for (size_t c = 0; c < models_.size(); ++c) {
            const auto colour = static_cast<int32_t>(c);
            if (plan_.models()[c].needed)
                models_[c] = model_of(colour);
            tables_[c] = tables_of(colour);
        }
        report_.models_s = clock.seconds();
    }

    // What was kept before the plan was made, or since.
    std::vector<KeptPsfs> kept(int32_t colour) const {
        std::vector<KeptPsfs> all{plan_.kept(colour)};
        if (plan_.reuse().store)
            all.push_back(plan_.reuse().store->find(plan_.key(colour)));
        return all;
    }

    void keep(int32_t colour, const KeptPsfs &made) const {
        if (plan_.reuse().store)
            plan_.reuse().store->keep(plan_.key(colour), made);
    }

    std::shared_ptr<const VaryingLight> model_of(int32_t colour) {
        const SharedModel &model = plan_.models()[static_cast<size_t>(colour)];
        for (const KeptPsfs &there : kept(colour))
            if (there.serves(model))
                return there.psf;
        auto made = std::make_shared<VaryingLight>(
            optics_.at, optics_.varies, optics_.lights[static_cast<size_t>(colour)],
            settings(model.eps, model.radius), optics_.region,
            Manners{manners_.progress.between(0, 0.2), manners_.memory_limit, threads_});
        report_.exact_psfs += made->exact_psfs();
        keep(colour, {.model = model, .psf = made});
        return made;
    }

    // What stars ask of tables, if all were that much brighter.
    SharedFarLight asked_of_tables(int32_t colour, double brighter) const {
        SharedFarLight far = plan_.far()[static_cast<size_t>(colour)];
        double floor = INFINITY, differences_floor = INFINITY, brightest = 0;
        for (const PlannedGroup &g : plan_.groups())
            if (g.group.colour == colour && g.way.far > 0) {
                floor = std::min(floor, g.way.far);
                if (g.way.far_drawing != FarDrawing::own) {
                    differences_floor = std::min(differences_floor, g.way.far);
                    brightest = std::max(brightest, g.group.brightest);
                }
            }
        far.needed = far.needed && std::isfinite(floor);
        far.floor = floor / brighter;
        far.differences_floor = differences_floor / brighter;
        far.differences_radius =
            brightest > 0 ? std::min(far.radius, same_beyond(plan_.colour(colour),
                                                             brighter * brightest, plan_.budget()))
                          : 0;
        return far;
    }

    std::shared_ptr<const FarTables> tables_of(int32_t colour) {
        const SharedFarLight asked = asked_of_tables(colour, 1);
        if (!asked.needed)
            return {};
        for (const KeptPsfs &there : kept(colour))
            if (there.serves(asked))
                return there.tables;
        // Of the next scenes stars may be brighter.
        const SharedFarLight far = asked_of_tables(colour, plan_.reuse().store ? 4 : 1);
        std::optional<Psf> exact;
        if (far.exact_radius > 0) {
            const auto [x, y] = FarTables::places(plan_.region(), false)[0];
            exact.emplace(std::move(make_psfs(
                optics_.nearest(x, y), {&optics_.lights[static_cast<size_t>(colour)], 1},
                settings(far.exact_eps, far.exact_radius), {{}, manners_.memory_limit})[0]));
            ++report_.exact_psfs;
        }
        constexpr double below = 0.1; // light that sums of it must not count
        auto made = std::make_shared<FarTables>(
            plan_.colour(colour).far_lights, exact ? &*exact : nullptr, plan_.region(),
            FarTables::Extent{far.radius, below * far.floor, far.differences_radius,
                              below * far.differences_floor},
            threads_);
        keep(colour, {.far = far, .tables = made});
        return made;
    }

    // What came of the plan's tolerances.
    void find_error() {
        std::vector<PixelError> errors;
        for (const PlannedGroup &planned : plan_.groups()) {
            PixelError &error = errors.emplace_back(planned.error);
            if (planned.way.drawing != Drawing::shared)
                continue;
            const int32_t colour = planned.group.colour;
            Way made = planned.way;
            made.eps = models_[static_cast<size_t>(colour)]->error_estimate();
            error.local = std::max(
                error.local, psf_error(planned.group, plan_.colour(colour), plan_.budget(), made));
        }
        report_.error = together(errors);
    }

    // work(first_row, last_row) on bands of rows.
    template <class Work> void on_rows(const Work &work) const {
        on_bands_of_rows(image_.ny, threads_, work);
    }

    // A part of the sources at a time, so that memory does not grow with their number.
    void draw_shared() {
        constexpr size_t batch = size_t{1} << 18;
        const Clock clock;
        const std::vector<PlacedSource> &sources = plan_.sources();
        for (size_t begin = 0; begin < sources.size(); begin += batch) {
            manners_.progress.report(0.2 + 0.3 * static_cast<double>(begin) /
                                               static_cast<double>(sources.size()));
            const std::span part =
                std::span(sources).subspan(begin, std::min(batch, sources.size() - begin));
            for (size_t colour = 0; colour < models_.size(); ++colour)
                if (models_[colour])
                    draw_shared(part, static_cast<int32_t>(colour));
        }
        draw_faint_light();
        draw_far();
        report_.shared_s = clock.seconds();
    }

    // Of a source's light, the share that is not drawn in pixels more than `radius` native ones off.
    double left_out(const PlannedGroup &planned, double radius) const {
        const Way &way = planned.way;
        const LightProfile &profile = plan_.colour(planned.group.colour).profile;
        const double from = std::max(radius, way.radius);
        if (way.far == 0)
            return profile.expected_beyond(from);
        // Far light is known much better than what is expected: what tables have below the floor.
        const FarTables &tables = *tables_[static_cast<size_t>(planned.group.colour)];
        const FarTable &table = tables.middle();
        const double faint = table.light(INFINITY, from, 0) - table.light(INFINITY, from, way.far);
        const bool ends = way.far_drawing == FarDrawing::tables;
        return faint + (ends ? profile.expected_beyond(std::max(from, tables.radius())) : 0);
    }

    void draw_faint_light() {
        std::vector<std::vector<const PlacedSource *>> of_group(plan_.groups().size());
        for (const PlacedSource &source : plan_.sources()) {
            const size_t g = plan_.group_index(source);
            const PlannedGroup &planned = plan_.groups()[g];
            if (planned.way.is_smooth_beyond() && planned.way.radius < planned.group.reach)
                of_group[g].push_back(&source);
        }
        FaintLight light(plan_.image());
        for (size_t g = 0; g < of_group.size(); ++g) {
            for (const PlacedSource *source : of_group[g])
                light.add(*source);
            if (of_group[g].empty())
                continue;
            light.spread([&](double radius) { return left_out(plan_.groups()[g], radius); });
        }
        on_rows([&](int64_t first_row, int64_t last_row) {
            light.add_to(image_, first_row, last_row);
        });
    }

    void draw_shared(std::span<const PlacedSource> sources, int32_t colour) {
        std::vector<Star> stars;
        std::vector<StarDetail> details;
        for (const PlacedSource &source : sources) {
            if (source.colour != colour || source.flux == 0)
                continue;
            const Way &way = plan_.group_of(source).way;
            const Star star = frame_.star(source);
            if (way.drawing != Drawing::shared || !frame_.reaches(star, way.radius))
                continue;
            stars.push_back(star);
            details.push_back({way.radius, way.left_out});
        }
        report_.drawn += static_cast<int64_t>(stars.size());
        models_[static_cast<size_t>(colour)]->add(std::span<const Star>(stars), details,
                                                  plan_.image().x0, plan_.image().y0,
                                                  plan_.image().oversampling, image_, threads_);
    }

    // Beyond the stamps.
    void draw_far() {
        struct FarStar {
            Star star;
            const PlacedSource *source;
            const Way *way;
            const FarTables *tables;
        };
        std::vector<FarStar> stars;
        for (const PlacedSource &source : plan_.sources()) {
            const Way &way = plan_.group_of(source).way;
            if (way.far > 0 && source.flux != 0)
                stars.push_back({frame_.star(source), &source, &way,
                                 &*tables_[static_cast<size_t>(source.colour)]});
        }
        on_rows([&](int64_t first_row, int64_t last_row) {
            for (const auto &[star, source, way, tables] : stars)
                if (way->far_drawing == FarDrawing::own)
                    tables->middle().add(star, way->radius, way->far, image_, first_row, last_row);
                else
                    tables->add(star, source->x, source->y, way->radius, way->far, image_,
                                first_row, last_row);
        });
        for (const auto &[star, source, way, tables] : stars) {
            const double floor = way->far * std::abs(star.flux);
            const ColourFacts &facts = plan_.colour(source->colour);
            if (way->far_drawing == FarDrawing::nearest)
                facts.far_lights[nearest_place(*source, facts.varies)].add(
                    star, std::max(way->radius, tables->radius()), floor, image_, threads_);
            if (way->far_drawing == FarDrawing::own)
                draw_own_far(star, *source, way->radius, floor, *tables);
        }
    }

    // How the far light of a star's place differs from that of the tables, and what is beyond them.
    void draw_own_far(const Star &star, const PlacedSource &source, double radius, double floor,
                      const FarTables &tables) {
        const Light &light = optics_.lights[static_cast<size_t>(source.colour)];
        FarLight(optics_.nearest(source.x, source.y), light, probe_settings(optics_.settings))
            .add(star, radius, floor, image_, threads_);
        const Window<T> within(star, tables.radius(), image_);
        if (!within.part.empty())
            plan_.colour(source.colour)
                .far_lights[0]
                .add({within.star.x, within.star.y, -star.flux}, radius, floor, within.part,
                     threads_);
    }

    size_t nearest_place(const PlacedSource &source, bool varies) const {
        const auto places = FarTables::places(plan_.region(), varies);
        const auto distance = [&source](const std::pair<double, double> &place) {
            return std::hypot(place.first - source.x, place.second - source.y);
        };
        return static_cast<size_t>(std::ranges::min_element(places, {}, distance) - places.begin());
    }

    // Galaxies of one part of the detector after another; each part's share a PSF.
    void draw_galaxies() {
        const Clock clock;
        const int cells = plan_.galaxy_cells();
        std::vector<std::vector<const PlacedSource *>> parts(models_.size() *
                                                             static_cast<size_t>(cells * cells));
        const auto cell_of = [cells](double at, double low, double high) {
            const double part = (at - low) / (high - low) * cells;
            return static_cast<size_t>(std::clamp(part, 0.0, static_cast<double>(cells - 1)));
        };
        const Region region = plan_.region();
        std::vector<const PlacedSource *> own;
        for (const PlacedSource &source : plan_.sources()) {
            const Drawing drawing = plan_.group_of(source).way.drawing;
            if (source.flux != 0 && drawing == Drawing::fourier_own)
                own.push_back(&source);
            if (source.flux != 0 && drawing == Drawing::fourier) {
                const size_t x = cell_of(source.x, region.x0, region.x1);
                const size_t y = cell_of(source.y, region.y0, region.y1);
                parts[(static_cast<size_t>(source.colour) * static_cast<size_t>(cells) + y) *
                          static_cast<size_t>(cells) +
                      x]
                    .push_back(&source);
            }
        }
        for (size_t part = 0; part < parts.size(); ++part) {
            manners_.progress.report(0.5 + 0.2 * static_cast<double>(part) /
                                               static_cast<double>(parts.size()));
            if (!parts[part].empty())
                draw_galaxies(parts[part]);
        }
        for (const PlacedSource *galaxy : own)
            draw_galaxies(std::span(&galaxy, 1));
        report_.galaxies_s = clock.seconds();
    }

    void draw_galaxies(std::span<const PlacedSource *const> galaxies) {
        double x = 0, y = 0, brightest = 0;
        for (const PlacedSource *galaxy : galaxies) {
            x += galaxy->x / static_cast<double>(galaxies.size());
            y += galaxy->y / static_cast<double>(galaxies.size());
            brightest = std::max(brightest, std::abs(galaxy->flux));
        }
        const Light &light = optics_.lights[static_cast<size_t>(galaxies[0]->colour)];
        // An OTF of 1e-3 is off by less than 1e-6 of a galaxy's light in any pixel.
        constexpr double of_light = 1e-3;
        const double eps =
            std::clamp(0.05 * plan_.budget().error() / (of_light * brightest), 1e-5, 1e-3);
        const PsfSettings s = settings(eps / 10, 8);
        const Psf psf = std::move(make_psfs(optics_.nearest(x, y), {&light, 1}, s)[0]);
        ++report_.exact_psfs;
        const Otf otf = psf.otf(eps);
        report_.drawn += static_cast<int64_t>(galaxies.size());
        on_rows([&](int64_t first_row, int64_t last_row) {
            SersicProfiles profiles;
            GalaxyDrawer drawer(transfer_of(otf, s.pixel_scale), optics_.pixel_scale_arcsec,
                                profiles);
            const View<T> rows{image_.row(first_row), image_.nx, last_row - first_row + 1,
                               image_.stride_x, image_.stride_y};
            for (const PlacedSource *source : galaxies) {
                const GalaxyShape &shape = plan_.shapes()[static_cast<size_t>(source->shape)];
                const Star centre = frame_.star(*source);
                const double tolerance = plan_.group_of(*source).way.eps * std::abs(source->flux);
                drawer.add(
                    galaxy_at({centre.x, centre.y - static_cast<double>(first_row), source->flux},
                              shape),
                    tolerance, rows);
            }
        });
    }

    // Stars with PSFs of their own: each thread makes one, then all threads draw.
    void draw_own() {
        const Clock clock;
        std::vector<const PlacedSource *> own;
        for (const PlacedSource &source : plan_.sources()) {
            const Way &way = plan_.group_of(source).way;
            if (way.drawing == Drawing::own && source.flux != 0 &&
                frame_.reaches(frame_.star(source), way.radius))
                own.push_back(&source);
        }
        report_.drawn += static_cast<int64_t>(own.size());
        report_.exact_psfs += static_cast<int64_t>(own.size());
        const auto batch = static_cast<size_t>(std::max(threads_, 1));
        for (size_t begin = 0; begin < own.size(); begin += batch) {
            manners_.progress.report(0.7 + 0.3 * static_cast<double>(begin) /
                                               static_cast<double>(own.size()));
            const size_t count = std::min(batch, own.size() - begin);
            std::vector<std::optional<Psf>> psfs(count);
            for_each_band(static_cast<int64_t>(count), [&](int64_t i) {
                const auto k = static_cast<size_t>(i);
                psfs[k].emplace(psf_of(*own[begin + k]));
            });
            for (size_t k = 0; k < count; ++k)
                draw(*psfs[k], *own[begin + k]);
        }
        report_.own_s = clock.seconds();
    }

    Psf psf_of(const PlacedSource &source) const {
        const Way &way = plan_.group_of(source).way;
        const Light &light = optics_.lights[static_cast<size_t>(source.colour)];
        return std::move(make_psfs(optics_.nearest(source.x, source.y), {&light, 1},
                                   settings(way.eps, std::min(way.radius, Way::largest_field)))[0]);
    }

    void draw(const Psf &psf, const PlacedSource &source) {
        const Way &way = plan_.group_of(source).way;
        const int64_t n = plan_.image().oversampling;
        const Star star = frame_.star(source);
        if (way.radius <= Way::largest_field) {
            psf.add(std::span(&star, 1), n, image_, threads_);
            return;
        }
        const Window<T> within(star, way.radius * static_cast<double>(n), image_);
        psf.draw(within.star, n, within.part, Psf::Drawing::adds, manners_);
    }

    PsfSettings settings(double eps, double radius) const {
        PsfSettings settings = optics_.settings;
        settings.eps = eps;
        settings.radius = radius;
        return settings;
    }

    const SceneOptics &optics_;
    const ScenePlan &plan_;
    View<T> image_;
    Frame frame_;
    int threads_;
    const Manners &manners_;
    // By colour.
    std::vector<std::shared_ptr<const VaryingLight>> models_;
    std::vector<std::shared_ptr<const FarTables>> tables_;
    RenderReport report_;
};

} // namespace

template <class T>
RenderReport render(const SceneOptics &optics, const ScenePlan &plan, View<T> image, int threads,
                    const Manners &manners) {
    if (image.empty() || plan.sources().empty())
        return {};
    return Renderer<T>(optics, plan, image, threads, manners).run();
}

template RenderReport render(const SceneOptics &, const ScenePlan &, View<float>, int,
                             const Manners &);
template RenderReport render(const SceneOptics &, const ScenePlan &, View<double>, int,
                             const Manners &);

} // namespace wfpsf
