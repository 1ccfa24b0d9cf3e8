// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes against brute force: every error within the budget, at any budget and number of threads.
#include "large_case.hpp"
#include "scene/render.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace wfpsf {
namespace {

// Where stars add noise of their own, as many electrons as are that share of the noise without.
double worst(const Plane<double> &drawn, const Plane<double> &truth, double variance) {
    double most = 0;
    for (int64_t y = 0; y < truth.ny(); ++y)
        for (int64_t x = 0; x < truth.nx(); ++x)
            most = std::max(most, std::abs(drawn(x, y) - truth(x, y)) /
                                      std::sqrt(1 + std::max(truth(x, y), 0.0) / variance));
    return most;
}

void expect_within_budgets(const SceneOptics &optics, const std::vector<PlacedSource> &sources,
                           const SceneImage &image, std::initializer_list<double> noises) {
    const Plane<double> truth = scenes::brute_force(optics, sources, image, 1e-8);
    for (const double noise : noises) {
        const ScenePlan plan(optics, sources, {}, {.noise = noise, .variance = 100}, image);
        Plane<double> drawn(image.nx, image.ny);
        const RenderReport report = render(optics, plan, drawn.view(), 1);
        const double error = worst(drawn, truth, plan.budget().variance);
        EXPECT_TRUE(plan.meets_budget());
        EXPECT_LE(error, plan.budget().error()) << plan.text();
        EXPECT_LE(error, report.error) << plan.text();
    }
}

const SceneImage image{.x0 = 1000, .y0 = 2000, .nx = 128, .ny = 96};

TEST(Render, ErrorsStayWithinTheBudget) {
    WFPSF_LARGE_CASE();
    const SceneOptics optics = scenes::roman("J129", {monochromatic(1293e-9)});
    for (const unsigned seed : {1u, 2u})
        expect_within_budgets(optics, scenes::stars({60, 18, 26, 0.3, 5e12}, image, 20, 1, seed),
                              image, {0.5, 0.05});
}

TEST(Render, ErrorsOfBroadbandLightStayWithinTheBudget) {
    const SceneOptics optics = scenes::roman(
        "J129", {detected_light(Instrument::get("roman-c9").band("J129"), black_body_sed(5000))});
    const SceneImage small{.x0 = 3000, .y0 = 500, .nx = 64, .ny = 48};
    expect_within_budgets(optics, scenes::stars({30, 20, 26, 0.3, 5e12}, small, 10), small,
                          {0.5, 0.05});
}

// The smooth light that stands for what is left out is no more than that: beyond the stamp of a bright
// star that shares its PSF, all of an image's pixels are right on the average too.
TEST(Render, SmoothLightOfBrightStarsIsWhatIsLeftOut) {
    WFPSF_LARGE_CASE();
    SceneOptics optics = scenes::roman(
        "J129", {detected_light(Instrument::get("roman-c9").band("J129"), black_body_sed(5000))});
    optics.at = [middle = optics.middle()](double, double) { return middle; };
    optics.varies = false;
    const SceneImage wide{.x0 = 1300, .y0 = 1300, .nx = 1401, .ny = 1401};
    const SceneImage about{.x0 = 1800, .y0 = 1800, .nx = 401, .ny = 401};
    const std::vector<PlacedSource> star{{2000.3, 1999.8, 8e7, 0, PlacedSource::star, 0}};
    const ScenePlan plan(optics, star, {}, {.noise = 0.01, .variance = 100}, wide,
                         {std::make_shared<SceneStore>(), 50});
    const Way &way = plan.groups()[0].way;
    ASSERT_EQ(way.drawing, Drawing::shared) << plan.text();
    ASSERT_GT(way.far, 0) << plan.text();
    ASSERT_LT(way.radius, 150) << plan.text();
    Plane<double> drawn(wide.nx, wide.ny), window(about.nx, about.ny);
    render(optics, plan, drawn.view(), 1);
    const Plane<double> truth = scenes::brute_force(optics, star, about, 1e-9);
    double sum = 0, count = 0;
    for (int64_t y = 0; y < about.ny; ++y)
        for (int64_t x = 0; x < about.nx; ++x) {
            window(x, y) = drawn(500 + x, 500 + y);
            if (std::max(std::abs(x - 200), std::abs(y - 200)) > 150) {
                sum += window(x, y) - truth(x, y);
                ++count;
            }
        }
    EXPECT_LE(std::abs(sum / count), 0.05 * plan.budget().error());
    EXPECT_LE(worst(window, truth, plan.budget().variance), plan.budget().error());
}

// Many faint stars in one place, whose wings add up.
TEST(Render, ErrorsOfClustersStayWithinTheBudget) {
    const SceneOptics optics = scenes::roman("J129", {monochromatic(1293e-9)});
    const std::vector<PlacedSource> sources =
        scenes::stars({200, 22, 26, 0.3, 5e12}, {.x0 = 1050, .y0 = 2040, .nx = 24, .ny = 24}, 0);
    expect_within_budgets(optics, sources, image, {0.5, 0.05});
}

// So many stars everywhere that what is left out of each adds up to more than the budget. One PSF
// serves all.
TEST(Render, ErrorsOfCrowdsStayWithinTheBudget) {
    SceneOptics optics = scenes::roman(
        "J129", {detected_light(Instrument::get("roman-c9").band("J129"), black_body_sed(5000))});
    optics.at = [middle = optics.middle()](double, double) { return middle; };
    optics.varies = false;
    const SceneImage crowd{.nx = 160, .ny = 140};
    std::vector<PlacedSource> sources = scenes::stars({3000, 20, 25, 0.1, 5e12}, crowd, 0);
    PsfSettings settings = optics.settings;
    settings.eps = 1e-7;
    settings.radius = 160;
    const Psf psf = std::move(make_psfs(optics.middle(), {&optics.lights[0], 1}, settings)[0]);
    Plane<double> truth(crowd.nx, crowd.ny), drawn(crowd.nx, crowd.ny);
    for (const PlacedSource &source : sources) {
        const Star star{source.x, source.y, source.flux};
        psf.add({&star, 1}, 1, truth.view(), 1);
    }
    const ScenePlan plan(optics, sources, {}, {.noise = 0.3, .variance = 100}, crowd);
    render(optics, plan, drawn.view(), 1);
    EXPECT_TRUE(plan.meets_budget());
    EXPECT_LT(plan.time_s(), 30) << plan.text();
    EXPECT_LE(worst(drawn, truth, plan.budget().variance), plan.budget().error()) << plan.text();
    const auto smooth = std::ranges::count_if(plan.groups(), [](const PlannedGroup &planned) {
        return planned.way.is_smooth_beyond() && planned.way.radius < planned.group.reach / 2;
    });
    EXPECT_GT(smooth, 0);
}

} // namespace
} // namespace wfpsf
