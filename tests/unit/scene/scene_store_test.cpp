// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that share what they are drawn with: the second one makes none of it, and errors stay
// within the budget, whatever the store holds.
#include "large_case.hpp"
#include "scene/render.hpp"
#include "scenes.hpp"
#include "unit/image/status_of.hpp"
#include "unit/image/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace wfpsf {
namespace {

const SceneImage image{.x0 = 1000, .y0 = 2000, .nx = 128, .ny = 96};
const SceneBudget budget{.noise = 0.1, .variance = 100};

struct Rendered {
    Plane<double> image;
    RenderReport report;
    double allowed;
};

Rendered rendered(const SceneOptics &optics, const std::vector<PlacedSource> &sources,
                  const SceneReuse &reuse) {
    const ScenePlan plan(optics, sources, {}, budget, image, reuse);
    EXPECT_TRUE(plan.meets_budget());
    Plane<double> drawn(image.nx, image.ny);
    const RenderReport report = render(optics, plan, drawn.view(), 1);
    return {std::move(drawn), report, plan.budget().error()};
}

// Of a dark pixel's noise, in units of what is allowed.
double worst(const Rendered &drawn, const Plane<double> &truth) {
    double most = 0;
    for (int64_t y = 0; y < truth.ny(); ++y)
        for (int64_t x = 0; x < truth.nx(); ++x)
            most = std::max(most, std::abs(drawn.image(x, y) - truth(x, y)) /
                                      std::sqrt(1 + std::max(truth(x, y), 0.0) / budget.variance));
    return most / drawn.allowed;
}

std::vector<PlacedSource> stars(unsigned seed, double bright = 19) {
    return scenes::stars({150, bright, 26, 0.3, 5e12}, image, 20, 1, seed);
}

TEST(SceneStore, FurtherScenesMakeNoModelsAndMeetTheBudget) {
    WFPSF_LARGE_CASE();
    const SceneOptics optics = scenes::roman("J129", {monochromatic(1293e-9)});
    const SceneReuse reuse{std::make_shared<SceneStore>(), 20};
    EXPECT_EQ(reuse.store->memory(), 0);
    rendered(optics, stars(1), reuse);
    const int64_t held = reuse.store->memory();
    EXPECT_GT(held, 0);
    const Rendered second = rendered(optics, stars(2), reuse);
    EXPECT_LT(second.report.exact_psfs, 10); // of the brightest stars
    EXPECT_EQ(reuse.store->memory(), held);
    EXPECT_LE(worst(second, scenes::brute_force(optics, stars(2), image, 1e-8)), 1);
}

TEST(SceneStore, BrighterStarsThanBeforeMeetTheBudget) {
    WFPSF_LARGE_CASE();
    const SceneOptics optics = scenes::roman("J129", {monochromatic(1293e-9)});
    const SceneReuse reuse{std::make_shared<SceneStore>(), 1};
    rendered(optics, stars(1, 24), reuse);
    const Rendered brighter = rendered(optics, stars(3, 17), reuse);
    EXPECT_LE(worst(brighter, scenes::brute_force(optics, stars(3, 17), image, 1e-8)), 1);
}

// Tables of far light too.
TEST(SceneStore, BroadbandScenesAreWhatTheyAreAlone) {
    const SceneOptics optics = scenes::roman(
        "J129", {detected_light(Instrument::get("roman-c9").band("J129"), black_body_sed(5000))});
    const SceneReuse reuse{std::make_shared<SceneStore>(), 20};
    rendered(optics, stars(1), reuse);
    const ScenePlan plan(optics, stars(2), {}, budget, image, reuse);
    EXPECT_TRUE(plan.far()[0].needed);
    EXPECT_GT(plan.memory(), reuse.store->memory()); // something is made beside what is held
    EXPECT_LT(plan.memory(), 5 * reuse.store->memory());
    const Rendered second = rendered(optics, stars(2), reuse);
    EXPECT_EQ(second.report.exact_psfs, 0);
    const Rendered alone = rendered(optics, stars(2), {});
    EXPECT_GT(alone.report.exact_psfs, 0);
    EXPECT_LE(worst(second, alone.image), 2); // either may be off by what is allowed
}

TEST(SceneStore, FromAFileGivesTheSameBits) {
    const TemporaryFolder folder;
    const std::string path = folder.path("store");
    const Light light =
        detected_light(Instrument::get("roman-c9").band("J129"), black_body_sed(5000));
    const SceneOptics optics = scenes::roman("J129", {light});
    const SceneReuse reuse{std::make_shared<SceneStore>(), 20};
    rendered(optics, stars(1), reuse);
    reuse.store->write(path);
    const SceneReuse again{std::make_shared<SceneStore>(), 20};
    again.store->read(path);
    EXPECT_EQ(again.store->memory(), reuse.store->memory());
    const Rendered second = rendered(optics, stars(2), again);
    EXPECT_EQ(second.report.exact_psfs, 0);
    EXPECT_EQ(worst(second, rendered(optics, stars(2), reuse).image), 0);
    // Of other optics beside them, in one store.
    const SceneReuse others{std::make_shared<SceneStore>(), 20};
    rendered(scenes::roman("J129", {light}, 9), stars(1), others);
    const int64_t held = others.store->memory();
    others.store->read(path);
    EXPECT_EQ(others.store->memory(), held + again.store->memory());
    // What is damaged changes nothing.
    std::string damaged = read_text(path);
    damaged[damaged.size() / 2] ^= 1;
    write_text(path, damaged);
    EXPECT_EQ(status_of([&] { again.store->read(path); }), WFPSF_ERROR_FILE_FORMAT);
    EXPECT_EQ(again.store->memory(), reuse.store->memory());
}

// What scenes share is made by threads, and is the same for any number of them.
TEST(SceneStore, ThreadsMakeTheSameBits) {
    const TemporaryFolder folder;
    const SceneOptics optics = scenes::roman(
        "J129", {detected_light(Instrument::get("roman-c9").band("J129"), black_body_sed(5000))});
    const auto made_by = [&](int threads) {
        const SceneReuse reuse{std::make_shared<SceneStore>(), 20};
        const ScenePlan plan(optics, stars(1), {}, budget, image, reuse, threads);
        Plane<double> drawn(image.nx, image.ny);
        render(optics, plan, drawn.view(), threads);
        reuse.store->write(folder.path("store"));
        return read_text(folder.path("store"));
    };
    const std::string by_one = made_by(1);
    EXPECT_TRUE(by_one == made_by(3));
}

TEST(SceneStore, OtherOpticsShareNothing) {
    const SceneReuse reuse{std::make_shared<SceneStore>(), 20};
    const SceneOptics optics = scenes::roman("J129", {monochromatic(1293e-9)});
    rendered(optics, stars(1), reuse);
    const auto makes_its_own = [&reuse](const SceneOptics &other) {
        const int64_t before = reuse.store->memory();
        const int64_t made = rendered(other, stars(1), reuse).report.exact_psfs;
        return made > 0 && reuse.store->memory() > before;
    };
    EXPECT_TRUE(makes_its_own(scenes::roman("J129", {monochromatic(1293e-9)}, 9)));
    EXPECT_TRUE(makes_its_own(scenes::roman("J129", {monochromatic(1200e-9)})));
    SceneOptics blurred = optics;
    blurred.settings.blur = {.xx = 0.01, .xy = 0, .yy = 0.01};
    EXPECT_TRUE(makes_its_own(blurred));
    SceneOptics defocused = optics;
    defocused.at = [at = optics.at](double x, double y) {
        Optics here = at(x, y);
        here.wavefront = here.wavefront.scaled(1.001);
        return here;
    };
    EXPECT_TRUE(makes_its_own(defocused));
}

} // namespace
} // namespace wfpsf
