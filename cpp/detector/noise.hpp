// SPDX-License-Identifier: GPL-3.0-or-later
// Realisations of correlated noise.
#pragma once

#include "detector/ipc_kernel.hpp"
#include "detector/random.hpp"

namespace wfpsf {

// Adds white normal noise that went through a kernel; nullptr: stays white. The white noise goes on
// beyond the border, so that tiles of one detector fit together.
void add_noise(double rms, const IpcKernel *kernel, const RandomSource &random, int threads,
               View<float> image);
void add_noise(double rms, const IpcKernel *kernel, const RandomSource &random, int threads,
               View<double> image);

} // namespace wfpsf
