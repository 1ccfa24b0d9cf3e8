// SPDX-License-Identifier: GPL-3.0-or-later
// IPC over a whole detector, against a plain copy of the same pixels. Errors are against a long
// double sum over a sample of pixels, in units of the largest pixel.
#include "detector/ipc_convolve.hpp"
#include "harness.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace wfpsf::bench {

namespace {

constexpr int64_t n = 4088;

template <class T> Case ipc_case(const char *name, const IpcKernel &kernel, int64_t tap_step) {
    return {name, "largest pixel error / largest pixel", 0, sizeof(T) == 4 ? 1e-7 : 1e-15, [=] {
                Plane<T> in(n, n), out(n, n);
                std::mt19937 random(1);
                std::uniform_real_distribution<double> charge(0, 1e5);
                for (int64_t y = 0; y < n; ++y)
                    for (int64_t x = 0; x < n; ++x)
                        in(x, y) = static_cast<T>(charge(random));
                Measured m;
                m.baseline = "a plain copy";
                m.baseline_s = time([&] {
                                   std::memcpy(out.view().data, in.view().data,
                                               sizeof(T) * static_cast<size_t>(n * n));
                               }).median_s;
                m.timing = time([&] {
                    convolve(kernel, std::as_const(in).view(), {.tap_step = tap_step}, out.view());
                });
                for (int64_t y = 0; y < n; y += 97)
                    for (int64_t x = 0; x < n; x += 89) {
                        long double sum = 0;
                        for (int64_t dy = -1; dy <= 1; ++dy)
                            for (int64_t dx = -1; dx <= 1; ++dx) {
                                const int64_t i = x - tap_step * dx, j = y - tap_step * dy;
                                if (i >= 0 && i < n && j >= 0 && j < n)
                                    sum += static_cast<long double>(kernel(dx, dy)) * in(i, j);
                            }
                        const auto error = static_cast<double>(std::abs(sum - out(x, y))) / 1e5;
                        m.error = std::max(m.error, error);
                    }
                return m;
            }};
}

} // namespace

std::vector<Case> ipc_cases() {
    const IpcKernel kernel = IpcKernel::parametric(0.02, 0.002, 0);
    return {ipc_case<float>("IPC 3x3 on 4088^2, float32", kernel, 1),
            ipc_case<double>("IPC 3x3 on 4088^2, float64", kernel, 1),
            ipc_case<double>("IPC 3x3 on 4088^2, float64, taps 32 apart", kernel, 32)};
}

} // namespace wfpsf::bench
