// SPDX-License-Identifier: GPL-3.0-or-later
// A pass over an image with other taps at every pixel: those of varying IPC, or what is made of
// them.
#pragma once

#include "detector/varying_ipc.hpp"

#include <functional>
#include <vector>

namespace wfpsf {

struct Couplings {
    int64_t nx, ny, reach_x, reach_y;
    std::vector<VaryingIpc::Offset> offsets; // where any tap is not 0
    // Sets taps(x, k) of row y, k counting offsets. Every thread calls a copy of its own.
    std::function<void(int64_t y, View<double> taps)> taps;
};

void convolve(const Couplings &couplings, View<const float> in, const VaryingConvolution &how,
              View<float> out);
void convolve(const Couplings &couplings, View<const double> in, const VaryingConvolution &how,
              View<double> out);

} // namespace wfpsf
