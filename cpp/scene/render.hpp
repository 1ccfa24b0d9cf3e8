// SPDX-License-Identifier: GPL-3.0-or-later
// All sources of a plan drawn into an image.
#pragma once

#include "error/progress.hpp"
#include "image/view.hpp"
#include "scene/plan.hpp"

namespace wfpsf {

// What happened, beside what was planned.
struct RenderReport {
    double models_s = 0, shared_s = 0, own_s = 0, galaxies_s = 0; // wall clock
    int64_t exact_psfs = 0;                                       // made for stars or models
    int64_t drawn = 0;                                            // sources that reach the image
    double error = 0; // e- of any pixel, by the estimates of the PSFs as they came out
    double time_s() const { return models_s + shared_s + own_s + galaxies_s; }
};

// Adds them. The bits do not depend on the number of threads. A caller that stops, and memory that
// runs out, leave a part of the light in the image.
template <class T>
RenderReport render(const SceneOptics &optics, const ScenePlan &plan, View<T> image, int threads,
                    const Manners &manners = {});

} // namespace wfpsf
