// SPDX-License-Identifier: GPL-3.0-or-later
// What is true of a source on a detector: adaptive moments of what is seen of it, without noise and
// neighbours, before and after IPC.
#pragma once

#include "detector/ipc_kernel.hpp"
#include "scene/plan.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include <wfpsf/status.h>

namespace wfpsf {

struct TrueShape {
    double x, y, sigma, e1, e2; // pixels of the detector; native pixels
};

struct SourceTruth {
    double flux_in_stamp = 0; // e-
    wfpsf_status status = WFPSF_OK;
    TrueShape bare{}, with_ipc{}; // NaN where there is none
};

struct TruthOptions {
    double eps = 1e-6;                 // of the PSFs
    double moments_tolerance = 1e-8;   // whitened
    const IpcKernel *kernel = nullptr; // of native pixels
    int threads = 1;
};

// By the sources of a plan.
std::vector<SourceTruth> truth_of(const SceneOptics &optics, const ScenePlan &plan,
                                  std::span<const PlacedSource> sources,
                                  const TruthOptions &options);

} // namespace wfpsf
