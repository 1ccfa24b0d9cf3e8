// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/cubic_spline.hpp"

#include <cmath>
#include <cstdint>

namespace wfpsf {

namespace {

constexpr int64_t settled = 16; // runs after which a start is forgotten, to rounding

// Runs of `width` samples, `stride` apart, each filtered along the runs.
void filter(float *first, int64_t count, int64_t stride, int64_t width) {
    const auto pole = static_cast<float>(std::sqrt(3.0) - 2);
    const auto run = [=](int64_t i) { return first + i * stride; };
    // to = scale * to + factor * from
    const auto add = [width](float scale, float *to, float factor, const float *from) {
        for (int64_t j = 0; j < width; ++j)
            to[j] = scale * to[j] + factor * from[j];
    };
    float power = 1;
    for (int64_t i = 1; i < settled; ++i)
        add(1, run(0), power *= pole, run(i));
    for (int64_t i = 1; i < count; ++i)
        add(1, run(i), pole, run(i - 1));
    const float end = 6 * pole / (pole * pole - 1);
    add(end, run(count - 1), end * pole, run(count - 2));
    for (int64_t i = count - 1; i-- > 0;)
        add(-6 * pole, run(i), pole, run(i + 1));
}

} // namespace

void to_spline_coefficients(Plane<float> &samples) {
    const View<float> all = samples.view();
    for (int64_t y = 0; y < all.ny; ++y)
        filter(all.row(y), all.nx, 1, 1);
    filter(all.data, all.ny, all.stride_y, all.nx);
}

} // namespace wfpsf
