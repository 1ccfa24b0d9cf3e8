// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/view.hpp"
#include "numerics/fft.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>

namespace wfpsf {
namespace {

// There and back: the plain sum of real samples gives the input, the transform their multiple.
TEST(RealBackwardFft2d, IsThePlainSum) {
    for (const auto &[nx, ny] : {std::pair<int64_t, int64_t>(6, 10), {7, 4}, {1, 1}}) {
        Plane<double> wanted(nx, ny), got(nx, ny);
        Plane<std::complex<double>> spectrum(nx / 2 + 1, ny);
        for (int64_t i = 0; i < nx * ny; ++i)
            wanted(i % nx, i / nx) = std::sin(static_cast<double>(i * i) + 1);
        for (int64_t v = 0; v < ny; ++v)
            for (int64_t u = 0; u <= nx / 2; ++u)
                for (int64_t y = 0; y < ny; ++y)
                    for (int64_t x = 0; x < nx; ++x) {
                        const double turns = static_cast<double>(u * x) / static_cast<double>(nx) +
                                             static_cast<double>(v * y) / static_cast<double>(ny);
                        spectrum(u, v) +=
                            wanted(x, y) * std::polar(1.0, -2 * std::numbers::pi * turns);
                    }
        RealBackwardFft2d(nx, ny).run(spectrum.view().data, got.view().data);
        for (int64_t y = 0; y < ny; ++y)
            for (int64_t x = 0; x < nx; ++x)
                EXPECT_NEAR(got(x, y) / static_cast<double>(nx * ny), wanted(x, y), 1e-13);
    }
}

} // namespace
} // namespace wfpsf
