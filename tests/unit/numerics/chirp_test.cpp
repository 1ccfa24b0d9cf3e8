// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/chirp.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace wfpsf {
namespace {

using Complex = std::complex<double>;
using Long = std::complex<long double>;

// Moduli against plain sums in long double; long inputs at coarse steps turn the chirp thousands of
// times.
TEST(ChirpTransform, ModuliMeetPlainSums) {
    struct Case {
        int64_t inputs, outputs;
        double turns;
    };
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const Case &c : {Case{1, 1, 0.3}, Case{1, 200, 0.01}, Case{2, 1, 0.1}, Case{37, 90, 0.004},
                          Case{512, 221, 5e-4}, Case{4096, 33, 0.2371}, Case{50, 3001, 1e-3}}) {
        const ChirpTransform transform(c.inputs, c.outputs, c.turns);
        std::vector<Complex> buffer = transform.buffer();
        std::ranges::fill(buffer, Complex(NAN, NAN)); // beyond the inputs nothing is read
        std::vector<Complex> in[2];
        for (int64_t n = 0; n < c.inputs; ++n)
            for (int64_t s = 0; s < ChirpTransform::batch; ++s) {
                const Complex value(any(random), any(random));
                buffer[static_cast<size_t>(n * ChirpTransform::batch + s)] = value;
                if (s % 15 == 0)
                    in[s / 15].push_back(value);
            }
        transform.run(buffer);
        const auto place = [](int64_t i, int64_t count) {
            return static_cast<long double>(i) - static_cast<long double>(count - 1) / 2;
        };
        for (int64_t j = 0; j < c.outputs; j += 1 + c.outputs / 30)
            for (const int which : {0, 1}) {
                Long sum = 0;
                for (int64_t n = 0; n < c.inputs; ++n)
                    sum += Long(in[which][static_cast<size_t>(n)]) *
                           std::polar(1.0L, 2 * std::numbers::pi_v<long double> *
                                                static_cast<long double>(c.turns) *
                                                place(n, c.inputs) * place(j, c.outputs));
                const Complex mine = buffer[static_cast<size_t>(
                    transform.place(j) * ChirpTransform::batch + 15 * which)];
                EXPECT_NEAR(std::abs(mine), static_cast<double>(std::abs(sum)),
                            1e-15 * std::sqrt(static_cast<double>(c.inputs)) *
                                std::sqrt(static_cast<double>(c.inputs + c.outputs)))
                    << c.inputs << ' ' << c.outputs << ' ' << j;
            }
    }
}

} // namespace
} // namespace wfpsf
