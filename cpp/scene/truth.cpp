// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/truth.hpp"

#include "detector/ipc_convolve.hpp"
#include "image/sampling.hpp"
#include "moments/adaptive.hpp"
#include "numerics/bands.hpp"
#include "optics/otf.hpp"
#include "optics/varying_psf.hpp"
#include "scene/galaxy.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

namespace wfpsf {

namespace {

constexpr int64_t oversampling = 4;
// Of a stamp, native pixels: the weight reaches about 6 sigma.
constexpr int64_t star_side = 33, largest_side = 257;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr TrueShape none{nan, nan, nan, nan, nan};

TrueShape shape_of(const AdaptiveMoments &m, double x0, double y0) {
    const auto native = [](double sample) { return native_of(sample, oversampling); };
    return {x0 + native(m.weight.x), y0 + native(m.weight.y), m.sigma() / oversampling, m.e1, m.e2};
}

class Measuring {
  public:
    Measuring(const ScenePlan &plan, const TruthOptions &options)
        : plan_(plan), options_(options) {}

    // From the source's image at `oversampling`, whose first native pixel's centre is at (x0, y0).
    SourceTruth of(const PlacedSource &source, const Plane<double> &image, double x0,
                   double y0) const {
        SourceTruth truth{.bare = none, .with_ipc = none};
        const double radius = plan_.group_of(source).way.radius;
        truth.flux_in_stamp =
            source.flux * (1 - plan_.colour(source.colour).profile.expected_beyond(radius));
        truth.bare = measured(image, x0, y0, truth.status);
        if (options_.kernel && truth.status == WFPSF_OK) {
            Plane<double> coupled(image.nx(), image.ny());
            convolve(*options_.kernel, image.view(), {.tap_step = oversampling}, coupled.view());
            truth.with_ipc = measured(coupled, x0, y0, truth.status);
        }
        return truth;
    }

  private:
    TrueShape measured(const Plane<double> &image, double x0, double y0,
                       wfpsf_status &status) const {
        const AdaptiveMoments m =
            adaptive_moments(image.view(), {}, {.tolerance = options_.moments_tolerance});
        status = m.status;
        return m.status >= 0 ? shape_of(m, x0, y0) : none;
    }

    const ScenePlan &plan_;
    const TruthOptions &options_;
};

// As many native pixels, an odd number, as the moments of a source need.
int64_t side_of(const PlacedSource &source, const ScenePlan &plan, double pixel_scale_arcsec) {
    if (source.shape == PlacedSource::star)
        return star_side;
    const GalaxyShape &shape = plan.shapes()[static_cast<size_t>(source.shape)];
    const double radius = shape.half_light_radius_arcsec / pixel_scale_arcsec;
    const auto more = static_cast<int64_t>(std::min(8 * radius, 1e3));
    return std::min(star_side + 2 * more, largest_side);
}

// The source alone, seen through the PSF of its place, in electrons a sample.
Plane<double> image_of(const PlacedSource &source, const Psf &psf, const SceneOptics &optics,
                       const ScenePlan &plan, int64_t side, double x0, double y0) {
    const auto sample = [](double native) { return sample_of(native, oversampling); };
    Plane<double> image(side * oversampling, side * oversampling);
    const Star centre{sample(source.x - x0), sample(source.y - y0), source.flux};
    if (source.shape == PlacedSource::star) {
        psf.draw(centre, oversampling, image.view());
        return image;
    }
    constexpr double otf_eps = 1e-4, tolerance = 1e-8; // of the flux
    const Otf otf = psf.otf(otf_eps);
    SersicProfiles profiles;
    GalaxyDrawer drawer(transfer_of(otf, psf.settings().pixel_scale / oversampling),
                        optics.pixel_scale_arcsec / oversampling, profiles);
    const GalaxyShape &shape = plan.shapes()[static_cast<size_t>(source.shape)];
    drawer.add(galaxy_at(centre, shape), tolerance * std::abs(source.flux), image.view());
    return image;
}

} // namespace

std::vector<SourceTruth> truth_of(const SceneOptics &optics, const ScenePlan &plan,
                                  std::span<const PlacedSource> sources,
                                  const TruthOptions &options) {
    PsfSettings settings = optics.settings;
    settings.eps = options.eps;
    settings.radius = static_cast<double>(star_side) / 2 + 1;
    std::vector<std::unique_ptr<VaryingPsf>> models(optics.lights.size()); // by colour
    for (const PlacedSource &source : sources) {
        const auto colour = static_cast<size_t>(source.colour);
        if (!models[colour])
            models[colour] = std::make_unique<VaryingPsf>(
                optics.at, optics.varies, optics.lights[colour], settings, optics.region);
    }
    const Measuring measuring(plan, options);
    std::vector<SourceTruth> truths(sources.size());
    share_out(std::ssize(sources), options.threads, [&](int64_t i) {
        const PlacedSource &source = sources[static_cast<size_t>(i)];
        const Region &region = optics.region;
        const Psf psf = models[static_cast<size_t>(source.colour)]->at(
            std::clamp(source.x, region.x0, region.x1), std::clamp(source.y, region.y0, region.y1));
        // The source in the middle native pixel, where it stands in its own.
        const int64_t side = side_of(source, plan, optics.pixel_scale_arcsec);
        const int64_t middle = side / 2;
        const auto half = static_cast<double>(middle);
        const double x0 = std::round(source.x) - half, y0 = std::round(source.y) - half;
        const Plane<double> image = image_of(source, psf, optics, plan, side, x0, y0);
        truths[static_cast<size_t>(i)] = measuring.of(source, image, x0, y0);
    });
    return truths;
}

} // namespace wfpsf
