// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes against brute force: every error within the budget, at any budget and number of threads.
#include "scene/render.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace wfpsf {
namespace {

double worst(const Plane<double> &a, const Plane<double> &b) {
    double most = 0;
    for (int64_t y = 0; y < a.ny(); ++y)
        for (int64_t x = 0; x < a.nx(); ++x)
            most = std::max(most, std::abs(a(x, y) - b(x, y)));
    return most;
}

TEST(Render, ErrorsStayWithinTheBudget) {
    const SceneOptics optics = scenes::roman("J129", {monochromatic(1293e-9)});
    const SceneImage image{.x0 = 1000, .y0 = 2000, .nx = 128, .ny = 96};
    const std::vector<PlacedSource> sources = scenes::stars({60, 18, 26, 0.3, 5e12}, image, 20);
    const Plane<double> truth = scenes::brute_force(optics, sources, image, 1e-10);
    for (const double noise : {0.5, 0.05, 0.005}) {
        const ScenePlan plan(optics, sources, {}, {.noise = noise, .variance = 100}, image);
        Plane<double> drawn(image.nx, image.ny);
        const RenderReport report = render(optics, plan, drawn.view(), 1);
        const double error = worst(drawn, truth);
        std::printf("noise %g: allowed %g, expected %g, true %g; time planned %g, taken %g\n%s",
                    noise, plan.budget().error(), report.error, error, plan.time_s(),
                    report.time_s(), plan.text().c_str());
        EXPECT_TRUE(plan.meets_budget());
        EXPECT_LE(error, plan.budget().error());
        EXPECT_LE(error, report.error);
    }
}

} // namespace
} // namespace wfpsf
