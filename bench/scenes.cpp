// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes: stars on a whole detector, drawn to an error budget. Errors are the largest of some
// windows against brute force, in units of the error that was allowed.
#include "unit/scene/scenes.hpp"

#include "harness.hpp"
#include "scene/render.hpp"

#include <cstdio>

namespace wfpsf::bench {

namespace {

constexpr double zero_flux = 5.3e12; // e- in 140 s of J129 from AB 0

Case stars_case(int64_t count, double bright, double noise, double target_s) {
    char name[96];
    std::snprintf(name, sizeof name, "%.0e stars AB %g..28 on 4088^2, %g of the noise",
                  static_cast<double>(count), bright, noise);
    return {name, "largest error / error allowed", target_s, 1, [=] {
                const SceneOptics optics = scenes::roman("J129", {monochromatic(1293e-9)});
                const SceneImage image{.nx = 4088, .ny = 4088};
                const std::vector<PlacedSource> sources =
                    scenes::stars({count, bright, 28, 0.4, zero_flux}, image, 32);
                const SceneBudget budget{.noise = noise, .variance = 120};
                Plane<float> drawn(image.nx, image.ny);
                Measured m;
                m.timing = time(
                    [&] {
                        const ScenePlan plan(optics, sources, {}, budget, image);
                        const RenderReport r = render(optics, plan, drawn.view(), 1);
                        std::printf("%sexpected %g s; models %.3f, shared %.3f, own %.3f\n",
                                    plan.text().c_str(), plan.time_s(), r.models_s, r.shared_s,
                                    r.own_s);
                    },
                    1);
                return m;
            }};
}

} // namespace

std::vector<Case> scene_cases() {
    return {stars_case(100000, 20, 0.01, 0), stars_case(100000, 16, 0.01, 0),
            stars_case(100000, 12, 0.01, 5)};
}

} // namespace wfpsf::bench
