// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/cubic_spline.hpp"

#include "numerics/dispatch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace wfpsf {

namespace {

constexpr int64_t settled = 16;  // runs after which a start is forgotten, to rounding
constexpr int64_t together = 64; // rows or columns that stay in the cache

// Runs of `width` samples, `stride` apart, each filtered along the runs.
WFPSF_VECTORISED void filter(float *first, int64_t count, int64_t stride, int64_t width) {
    const auto pole = static_cast<float>(std::sqrt(3.0) - 2);
    const auto run = [=](int64_t i) { return first + i * stride; };
    // to = scale * to + factor * from
    const auto add = [width](float scale, float *__restrict to, float factor,
                             const float *__restrict from) {
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

// Each run becomes a sixth of its neighbours' and two thirds of itself.
WFPSF_VECTORISED void smooth(float *first, int64_t count, int64_t stride, int64_t width) {
    float before[together], here[together];
    std::copy_n(first + stride, width, before);
    for (int64_t i = 0; i < count; ++i) {
        float *const run = first + i * stride;
        const float *const after = i + 1 < count ? run + stride : before;
        std::copy_n(run, width, here);
        for (int64_t j = 0; j < width; ++j)
            run[j] = (before[j] + after[j]) / 6 + here[j] * 2 / 3;
        std::copy_n(here, width, before);
    }
}

// Runs 0, 2, 4, ... become those of all, as coefficients of the same spline.
WFPSF_VECTORISED void refine(float *first, int64_t count, int64_t stride, int64_t width) {
    const auto run = [=](int64_t i) { return first + i * stride; };
    for (int64_t i = 1; i < count; i += 2)
        for (int64_t j = 0; j < width; ++j)
            run(i)[j] = (run(i - 1)[j] + run(i + 1)[j]) / 2;
    for (int64_t i = 0; i < count; i += 2) {
        const float *const before = run(i == 0 ? 1 : i - 1);
        const float *const after = run(i + 1 == count ? count - 2 : i + 1);
        for (int64_t j = 0; j < width; ++j)
            run(i)[j] = run(i)[j] / 2 + (before[j] + after[j]) / 4;
    }
}

// A filter of runs on columns, some at a time.
template <class Filter> void on_columns(View<float> all, const Filter &filter) {
    for (int64_t x = 0; x < all.nx; x += together)
        filter(all.data + x, all.ny, all.stride_y, std::min(together, all.nx - x));
}

// And on rows, for which they are turned to columns.
template <class Filter> void on_rows(View<float> all, const Filter &filter) {
    std::vector<float> turned(static_cast<size_t>(all.nx * together));
    for (int64_t y0 = 0; y0 < all.ny; y0 += together) {
        const int64_t rows = std::min(together, all.ny - y0);
        const auto on_all = [&](const auto &work) {
            for (int64_t x0 = 0; x0 < all.nx; x0 += together)
                for (int64_t y = 0; y < rows; ++y)
                    for (int64_t x = x0; x < std::min(x0 + together, all.nx); ++x)
                        work(all(x, y0 + y), turned[static_cast<size_t>(x * rows + y)]);
        };
        on_all([](float pixel, float &kept) { kept = pixel; });
        filter(turned.data(), all.nx, rows, rows);
        on_all([](float &pixel, float kept) { pixel = kept; });
    }
}

} // namespace

void to_spline_coefficients(Plane<float> &samples) {
    on_rows(samples.view(), filter);
    on_columns(samples.view(), filter);
}

void to_spline_samples(Plane<float> &coefficients) {
    on_rows(coefficients.view(), smooth);
    on_columns(coefficients.view(), smooth);
}

Plane<float> refined_spline(const Plane<float> &coefficients) {
    Plane<float> fine(2 * coefficients.nx() - 1, 2 * coefficients.ny() - 1);
    for (int64_t y = 0; y < coefficients.ny(); ++y)
        for (int64_t x = 0; x < coefficients.nx(); ++x)
            fine(2 * x, 2 * y) = coefficients(x, y);
    on_rows(fine.view(), refine);
    on_columns(fine.view(), refine);
    return fine;
}

} // namespace wfpsf
