// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/render.hpp"

#include "numerics/bands.hpp"

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
        return {sample(source.x - image_.x0), sample(source.y - image_.y0), source.flux};
    }
    bool reaches(const Star &star, double radius) const {
        const double r = radius * n_;
        return star.x >= -r && star.x <= static_cast<double>(image_.nx - 1) + r && star.y >= -r &&
               star.y <= static_cast<double>(image_.ny - 1) + r;
    }

  private:
    double sample(double native) const { return native * n_ + (n_ - 1) / 2; }

    const SceneImage &image_;
    double n_;
};

template <class T> class Renderer {
  public:
    Renderer(const SceneOptics &optics, const ScenePlan &plan, View<T> image, int threads,
             const Manners &manners)
        : optics_(optics), plan_(plan), image_(image), frame_(plan.image()), threads_(threads),
          manners_(manners) {}

    RenderReport run() {
        make_models();
        find_ranks();
        draw_shared();
        draw_own();
        return report_;
    }

  private:
    void make_models() {
        const Clock clock;
        models_.resize(plan_.models().size());
        for (size_t colour = 0; colour < models_.size(); ++colour) {
            const SharedModel &model = plan_.models()[colour];
            if (!model.needed)
                continue;
            models_[colour] = std::make_unique<VaryingPsf>(
                optics_.at, optics_.varies, optics_.lights[colour],
                settings(model.eps, model.radius), optics_.region,
                Manners{manners_.progress.between(0, 0.2), manners_.memory_limit});
            report_.exact_psfs += models_[colour]->exact_psfs();
        }
        report_.models_s = clock.seconds();
    }

    // As few fields as leave out no more than was planned.
    void find_ranks() {
        for (const SourceGroup &group : plan_.groups()) {
            size_t rank = 0;
            double of_psf = group.way.eps * plan_.profile(group.colour).peak();
            if (group.way.psf == StarPsf::shared) {
                const VaryingPsf &model = *models_[static_cast<size_t>(group.colour)];
                rank = 1;
                while (rank < model.rank() && model.left_out(rank) > group.way.left_out)
                    ++rank;
                of_psf = model.error_estimate() * plan_.profile(group.colour).peak();
            }
            details_.push_back({group.way.radius, rank});
            report_.error += std::max(group.error, group.densest * of_psf);
        }
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
        report_.shared_s = clock.seconds();
    }

    void draw_shared(std::span<const PlacedSource> sources, int32_t colour) {
        std::vector<Star> stars;
        std::vector<StarDetail> details;
        double low = INFINITY, high = -INFINITY;
        for (const PlacedSource &source : sources) {
            if (source.colour != colour || source.flux == 0)
                continue;
            const size_t group = plan_.group_index(source);
            if (plan_.groups()[group].way.psf != StarPsf::shared)
                continue;
            const StarDetail &detail = details_[group];
            const Star star = frame_.star(source);
            if (!frame_.reaches(star, detail.radius))
                continue;
            stars.push_back(star);
            details.push_back(detail);
            const double radius = detail.radius * static_cast<double>(plan_.image().oversampling);
            low = std::min(low, star.y - radius);
            high = std::max(high, star.y + radius);
        }
        if (stars.empty())
            return;
        report_.drawn += static_cast<int64_t>(stars.size());
        const auto last = static_cast<double>(image_.ny - 1);
        const auto first_row = static_cast<int64_t>(std::floor(std::clamp(low, 0.0, last)));
        const auto rows =
            static_cast<int64_t>(std::ceil(std::clamp(high, 0.0, last))) - first_row + 1;
        const auto bands = std::clamp<int64_t>(threads_, 1, rows);
        for_each_band(bands, [&](int64_t band) {
            models_[static_cast<size_t>(colour)]->add_to_rows(
                std::span<const Star>(stars), details, plan_.image().x0, plan_.image().y0,
                plan_.image().oversampling, image_, first_row + rows * band / bands,
                first_row + rows * (band + 1) / bands - 1);
        });
    }

    // Stars with PSFs of their own: each thread makes one, then all threads draw.
    void draw_own() {
        const Clock clock;
        std::vector<const PlacedSource *> own;
        for (const PlacedSource &source : plan_.sources()) {
            const SourceGroup &group = plan_.group_of(source);
            if (group.way.psf == StarPsf::own && source.flux != 0 &&
                frame_.reaches(frame_.star(source), group.way.radius))
                own.push_back(&source);
        }
        report_.drawn += static_cast<int64_t>(own.size());
        report_.exact_psfs += static_cast<int64_t>(own.size());
        const auto batch = static_cast<size_t>(std::max(threads_, 1));
        for (size_t begin = 0; begin < own.size(); begin += batch) {
            manners_.progress.report(0.5 + 0.5 * static_cast<double>(begin) /
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
        const StarWay &way = plan_.group_of(source).way;
        const Region &region = optics_.region;
        const Optics optics = optics_.at(std::clamp(source.x, region.x0, region.x1),
                                         std::clamp(source.y, region.y0, region.y1));
        const Light &light = optics_.lights[static_cast<size_t>(source.colour)];
        return std::move(make_psfs(optics, {&light, 1},
                                   settings(way.eps, std::min(way.radius, largest_field)))[0]);
    }

    void draw(const Psf &psf, const PlacedSource &source) {
        const double radius = plan_.group_of(source).way.radius;
        const int64_t n = plan_.image().oversampling;
        const Star star = frame_.star(source);
        if (radius <= largest_field) {
            psf.add(std::span(&star, 1), n, image_, threads_);
            return;
        }
        const double reach = radius * static_cast<double>(n);
        const auto window = [reach](double at, int64_t size) {
            const auto last = static_cast<double>(size - 1);
            return std::pair{static_cast<int64_t>(std::ceil(std::clamp(at - reach, 0.0, last))),
                             static_cast<int64_t>(std::floor(std::clamp(at + reach, 0.0, last)))};
        };
        const auto [x0, x1] = window(star.x, image_.nx);
        const auto [y0, y1] = window(star.y, image_.ny);
        const View<T> part{&image_(x0, y0), x1 - x0 + 1, y1 - y0 + 1, image_.stride_x,
                           image_.stride_y};
        psf.draw({star.x - static_cast<double>(x0), star.y - static_cast<double>(y0), star.flux}, n,
                 part, Psf::Drawing::adds, manners_);
    }

    PsfSettings settings(double eps, double radius) const {
        PsfSettings settings = optics_.settings;
        settings.eps = eps;
        settings.radius = radius;
        return settings;
    }

    static constexpr double largest_field = StarWay::largest_field;

    const SceneOptics &optics_;
    const ScenePlan &plan_;
    View<T> image_;
    Frame frame_;
    int threads_;
    const Manners &manners_;
    std::vector<std::unique_ptr<VaryingPsf>> models_; // by colour
    std::vector<StarDetail> details_;                 // by group
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
