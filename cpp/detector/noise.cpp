// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/noise.hpp"

#include "detector/ipc_convolve.hpp"
#include "numerics/bands.hpp"
#include "numerics/working_plane.hpp"

#include <algorithm>

namespace wfpsf {

namespace {

template <class T>
void add_any(double rms, const IpcKernel *kernel, const RandomSource &random, int threads,
             View<T> image) {
    if (image.empty())
        return;
    const int64_t reach_x = kernel ? kernel->reach_x() : 0,
                  reach_y = kernel ? kernel->reach_y() : 0;
    WorkingPlane<double> white(image.nx + 2 * reach_x, image.ny + 2 * reach_y);
    const View<double> draws = white.view();
    RandomSource source = random;
    source.x0 -= reach_x;
    source.y0 -= reach_y;
    const int64_t bands = std::clamp<int64_t>(threads, 1, draws.ny);
    for_each_band(bands, [&](int64_t band) {
        for (int64_t y = draws.ny * band / bands; y < draws.ny * (band + 1) / bands; ++y)
            fill_normal(source, 0, y, draws.nx, draws.row(y));
    });
    WorkingPlane<double> correlated(kernel ? image.nx : 0, kernel ? image.ny : 0);
    if (kernel)
        convolve(*kernel, draws, {.edge = Edge::valid, .threads = threads}, correlated.view());
    const View<double> noise = kernel ? correlated.view() : draws;
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x)
            image(x, y) = static_cast<T>(static_cast<double>(image(x, y)) + rms * noise(x, y));
}

} // namespace

void add_noise(double rms, const IpcKernel *kernel, const RandomSource &random, int threads,
               View<float> image) {
    add_any(rms, kernel, random, threads, image);
}

void add_noise(double rms, const IpcKernel *kernel, const RandomSource &random, int threads,
               View<double> image) {
    add_any(rms, kernel, random, threads, image);
}

} // namespace wfpsf
