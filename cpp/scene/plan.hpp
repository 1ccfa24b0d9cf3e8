// SPDX-License-Identifier: GPL-3.0-or-later
// From an error budget to how each source is drawn: every group of sources has several ways to be
// drawn, each with a cost and an error, and those are taken that cost least in all while the errors
// of all groups add up to no more than the budget.
#pragma once

#include "optics/varying_light.hpp"
#include "scene/scene_store.hpp"
#include "scene/ways.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace wfpsf {

// What PSFs of a detector are made from.
struct SceneOptics {
    OpticsAt at;
    bool varies;
    Region region;        // of places that have optics; farther off, the nearest one's count
    PsfSettings settings; // eps and radius do not matter
    double pixel_scale_arcsec;
    std::vector<Light> lights; // by colour

    Optics nearest(double x, double y) const;
    Optics middle() const;
};

// What PSFs and far light are made with that tell plans what to expect.
PsfSettings probe_settings(PsfSettings settings);

// How a group is drawn, and what is expected of it.
struct PlannedGroup {
    SourceGroup group;
    Way way;
    double time_s = 0;
    PixelError error = {};
};

// Of groups together: 1.2 times the root of the sum of the local errors' squares, for those pixels
// where several meet, and the sum of the means.
double together(std::span<const PixelError> errors);

class ScenePlan {
  public:
    ScenePlan(const SceneOptics &optics, std::vector<PlacedSource> sources,
              std::span<const GalaxyShape> shapes, const SceneBudget &budget,
              const SceneImage &image, const SceneReuse &reuse = {}, int threads = 1);

    const std::vector<PlacedSource> &sources() const { return sources_; } // as they are drawn
    const std::vector<GalaxyShape> &shapes() const { return shapes_; }
    const std::vector<PlannedGroup> &groups() const { return planned_; }
    size_t group_index(const PlacedSource &source) const { return groups_->of(source); }
    const PlannedGroup &group_of(const PlacedSource &source) const {
        return planned_[group_index(source)];
    }
    // By colour.
    const std::vector<SharedModel> &models() const { return models_; }
    const std::vector<SharedFarLight> &far() const { return far_; }
    const ColourFacts &colour(int32_t colour) const {
        return *colours_[static_cast<size_t>(colour)].kept.facts;
    }
    // What is there already.
    KeptPsfs kept(int32_t colour) const { return colours_[static_cast<size_t>(colour)].kept; }
    uint64_t key(int32_t colour) const { return colours_[static_cast<size_t>(colour)].key; }
    const SceneReuse &reuse() const { return reuse_; }
    Region region() const; // of the image
    // It is cut into as many parts along each axis whose galaxies share a PSF.
    int galaxy_cells() const { return galaxy_cells_; }
    const SceneBudget &budget() const { return budget_; }
    const SceneImage &image() const { return image_; }

    double time_s() const { return time_s_; } // expected, one thread
    double error() const { return error_; }   // expected, e- of any pixel
    int64_t memory() const;                   // of the rendering, bytes, about
    bool meets_budget() const { return error_ <= budget_.error(); }
    std::string text() const;

  private:
    struct Colour {
        uint64_t key = 0; // of what is kept of it
        KeptPsfs kept;
    };
    void learn_colours(const SceneOptics &optics, int threads);
    std::shared_ptr<const ColourFacts> facts_of(const SceneOptics &optics, const Light &light,
                                                double brightest,
                                                std::shared_ptr<const ColourFacts> known,
                                                int threads) const;
    void choose_galaxy_cells(const SceneOptics &optics);
    void collect_offers();
    std::vector<SharedFarLight> far_lights(int32_t colour) const;
    double time_of(const SharedModel &model, int32_t colour) const;
    double finest_model(int32_t colour) const;
    void settle(double price);
    void settle_colour(int32_t colour, double price);
    void choose();

    SceneBudget budget_;
    SceneImage image_;
    SceneReuse reuse_;
    std::vector<PlacedSource> sources_;
    std::vector<GalaxyShape> shapes_;
    std::unique_ptr<SourceGroups> groups_;
    std::vector<Colour> colours_;
    std::vector<PlannedGroup> planned_;
    std::vector<double> cell_error_; // of groups of galaxies, by their PSF's place
    // What a colour's groups may share. Offers are by group.
    using Offers = std::vector<std::vector<Offer>>;
    struct WithModel {
        SharedModel model;
        Offers offers; // that models of the same eps before it do not make
    };
    struct WithFar { // light from those tables, or none
        SharedFarLight far;
        Offers own;                    // without a model
        std::vector<WithModel> models; // those of one eps after each other, by radius
    };
    std::vector<std::vector<WithFar>> shared_; // by colour; the first is without far light
    std::vector<SharedModel> models_;
    std::vector<SharedFarLight> far_; // by colour
    int galaxy_cells_ = 1;
    double time_s_ = 0, error_ = 0;
};

} // namespace wfpsf
