// SPDX-License-Identifier: GPL-3.0-or-later
// From an error budget to how each source is drawn: sources that are alike form groups, every group
// has several ways to be drawn, each with a cost and an error, and the ways are taken that cost
// least in all while the errors of all groups add up to no more than the budget.
#pragma once

#include "optics/varying_psf.hpp"
#include "scene/catalogue.hpp"
#include "scene/light_profile.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace wfpsf {

// What PSFs of a detector are made from.
struct SceneOptics {
    OpticsAt at;
    bool varies;
    Region region;             // of places that have optics; farther off, the nearest one's count
    PsfSettings settings;      // eps and radius do not matter
    std::vector<Light> lights; // by colour
};

struct SceneBudget {
    double noise = 0.01;   // largest error of a pixel, in units of its noise
    double variance = 100; // of a pixel's noise beside the sources' own, e-^2
    // Largest share of a source's light that its stamp may leave out.
    double flux = std::numeric_limits<double>::infinity();

    double error() const; // e- that a pixel may be off
};

// Where the image is: (x0, y0) of the detector is the centre of its first native pixel.
struct SceneImage {
    double x0 = 0, y0 = 0;
    int64_t nx = 0, ny = 0; // samples
    int64_t oversampling = 1;
};

// How a group's stars get their PSF.
enum class StarPsf {
    shared, // that of the place, from a model of the whole detector
    own,    // made for each star
};

struct StarWay {
    StarPsf psf = StarPsf::shared;
    double radius = 0;   // of the stamp, native pixels
    double eps = 0;      // of the PSF
    double left_out = 0; // by modes of the shared model: largest share of the light in a pixel

    // Own PSFs are made out to here; what is farther is drawn straight from the diffraction image.
    static constexpr double largest_field = 128;
};

// Sources of one colour whose fluxes are within a factor of two.
struct SourceGroup {
    int32_t colour = 0;
    int octave = 0; // log2 of the flux, rounded down
    int64_t count = 0;
    double flux = 0;    // of all, e-
    double densest = 0; // the largest flux in any square cell of `cell` pixels
    double reach = 0;   // from any of them to the farthest pixel along an axis, native pixels
    StarWay way = {};
    double time_s = 0, error = 0; // expected; the error in e-, of any pixel

    static constexpr int64_t cell = 16;
};

// A PSF of the whole detector that groups of one colour share.
struct SharedModel {
    bool needed = false;
    double eps = 0, radius = 0; // native pixels
    double time_s = 0;
};

class ScenePlan {
  public:
    // The sources are put into the order they are drawn in.
    ScenePlan(const SceneOptics &optics, std::vector<PlacedSource> sources,
              const SceneBudget &budget, const SceneImage &image);

    const std::vector<PlacedSource> &sources() const { return sources_; }
    const SourceGroup &group_of(const PlacedSource &source) const {
        return groups_[group_index(source)];
    }
    size_t group_index(const PlacedSource &source) const;
    const std::vector<SourceGroup> &groups() const { return groups_; }
    const std::vector<SharedModel> &models() const { return models_; } // by colour
    const LightProfile &profile(int32_t colour) const {
        return profiles_[static_cast<size_t>(colour)];
    }
    const SceneBudget &budget() const { return budget_; }
    const SceneImage &image() const { return image_; }

    double time_s() const { return time_s_; } // expected, one thread
    double error() const { return error_; }   // expected, e- of any pixel
    bool meets_budget() const { return error_ <= budget_.error(); }
    std::string text() const;

  private:
    void sort_sources();
    void make_groups();
    void choose(const SceneOptics &optics);

    SceneBudget budget_;
    SceneImage image_;
    std::vector<PlacedSource> sources_;
    std::vector<LightProfile> profiles_;
    std::vector<SourceGroup> groups_;
    std::vector<int32_t> group_at_; // by colour and octave
    std::vector<SharedModel> models_;
    double time_s_ = 0, error_ = 0;
};

} // namespace wfpsf
