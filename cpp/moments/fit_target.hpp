// SPDX-License-Identifier: GPL-3.0-or-later
// What a Gaussian is fitted to: pixels, some of which may be missing, and the sum of w^2 that goes
// with them.
#pragma once

#include "image/view.hpp"
#include "moments/compensated_sum.hpp"
#include "moments/merit.hpp"

#include <utility>

namespace wfpsf {

enum class MomentsMethod {
    // The field's definition: the sum of w^2 over the pixels is taken as its integral pi sqrt(det
    // M).
    adaptive,
    // The sum itself: least squares at the pixels' centres. Has solutions where stars are smaller
    // than their pixels.
    least_squares,
    // As adaptive, with a weight that is kept circular.
    round,
    // As least_squares, of A w + b: a constant background is fitted as well.
    with_background
};

// Of the pixels themselves, not of the plane that they sample.
inline bool is_least_squares(MomentsMethod method) {
    return method == MomentsMethod::least_squares || method == MomentsMethod::with_background;
}

inline constexpr float one_pixel = 1; // seen everywhere with strides of zero

// Least squares of A w + b over n pixels, with b eliminated, are those of A (w - mean w) to
// I - mean I: the sums of I w become sums of (I - mean I) w, and the sum of w^2 loses (sum w)^2/n.
template <class T> struct FitTarget {
    View<const T> image;     // 0 where a pixel is missing
    View<const float> count; // of missing pixels; for least squares of those seen. May be empty
    MomentsMethod method = MomentsMethod::adaptive;
    double mean = 0; // taken off the pixels; with a background to fit, of all that are seen
    double seen = 0; // pixels, if there is a background to fit

    // Q, the sum of w^2 over the pixels that are seen. Of missing pixels in the continuum of the
    // adaptive method this makes pixels that the fit itself fills: they pull nowhere.
    Merit norm(const Gaussian &weight, double reach2, int64_t stride = 1) const {
        if (is_least_squares(method)) {
            const Merit squares = power_sum(squared_weight_sums(count, weight, reach2, stride), 2);
            if (method == MomentsMethod::least_squares)
                return squares;
            const Merit sum = power_sum(weighted_sums(count, weight, reach2, stride), 1);
            return squares - square(sum) * (1 / seen);
        }
        const Merit plane = plane_norm(weight);
        return count.empty()
                   ? plane
                   : plane - power_sum(squared_weight_sums(count, weight, reach2, stride), 2);
    }

    // The share of the integral of w^2 that lies on missing pixels.
    double missing_fraction(const Gaussian &weight, double reach2) const {
        const bool fit = is_least_squares(method);
        if (count.empty() || (fit && count.stride_x == 0))
            return 0;
        const auto sum = [&](View<const float> counted) {
            return squared_weight_sums(counted, weight, reach2, 1, 2).sum[0][0];
        };
        const double counted = sum(count);
        const double lost = fit ? sum({&one_pixel, image.nx, image.ny, 0, 0}) - counted : counted;
        return lost / plane_norm(weight).value;
    }

    // b, once A is known.
    double background(const Gaussian &weight, double amplitude, double reach2) const {
        if (method != MomentsMethod::with_background)
            return mean;
        return mean - amplitude * weighted_sums(count, weight, reach2, 1, 2).sum[0][0] / seen;
    }
};

// Calls body(FitTarget): on the pixels themselves if nothing is missing and nothing is to be taken
// off, or else on a copy. `missing` is empty, or not zero where a pixel is missing; some pixel must
// be seen.
template <class T, class Body>
auto with_target(View<const T> image, View<const float> missing, double background,
                 MomentsMethod method, Body &&body) {
    const bool fit = is_least_squares(method);
    const bool free_background = method == MomentsMethod::with_background;
    View<const float> count = missing;
    if (fit)
        count = {&one_pixel, image.nx, image.ny, 0, 0};
    if (missing.empty() && background == 0 && !free_background)
        return body(FitTarget<T>{image, count, method});

    const auto is_lost = [&](int64_t x, int64_t y) {
        return !missing.empty() && missing(x, y) != 0;
    };
    double mean = background, seen = 0;
    if (free_background) {
        CompensatedSum sum;
        for (int64_t y = 0; y < image.ny; ++y)
            for (int64_t x = 0; x < image.nx; ++x)
                if (!is_lost(x, y)) {
                    sum.add(static_cast<double>(image(x, y)));
                    ++seen;
                }
        mean = sum.value() / seen;
    }
    Plane<double> pixels(image.nx, image.ny);
    Plane<float> counted(image.nx, image.ny);
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x) {
            const bool lost = is_lost(x, y);
            pixels(x, y) = lost ? 0 : static_cast<double>(image(x, y)) - mean;
            counted(x, y) = lost != fit ? 1 : 0;
        }
    if (!missing.empty())
        count = std::as_const(counted).view();
    return body(FitTarget<double>{std::as_const(pixels).view(), count, method, mean, seen});
}

} // namespace wfpsf
