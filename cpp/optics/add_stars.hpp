// SPDX-License-Identifier: GPL-3.0-or-later
// Many stars in one image, on any number of threads.
#pragma once

#include "image/view.hpp"
#include "numerics/bands.hpp"
#include "optics/field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace wfpsf {

// Adds the stars to rows first_row..last_row of an image, each with the light that falls within
// radius_of(i) samples of it along both axes, clipped at the borders; stars out of reach add
// nothing. field_of(i) is the field of star i; it is asked for only if the star reaches these rows.
template <class T, class RadiusOf, class FieldOf>
void add_stars_to_rows(std::span<const Star> stars, RadiusOf radius_of, int64_t oversampling,
                       View<T> image, int64_t first_row, int64_t last_row, FieldOf field_of) {
    Plane<double> stamp;
    for (size_t i = 0; i < stars.size(); ++i) {
        const Star &star = stars[i];
        const double radius = radius_of(i);
        // Far from the image nothing is done, and nothing overflows.
        if (star.x < -radius || star.x > static_cast<double>(image.nx) + radius ||
            star.y < -radius || star.y > static_cast<double>(image.ny) + radius)
            continue;
        const auto window_x = static_cast<int64_t>(std::ceil(star.x - radius));
        const auto window_y = static_cast<int64_t>(std::ceil(star.y - radius));
        const int64_t x0 = std::max<int64_t>(window_x, 0), y0 = std::max(window_y, first_row);
        const int64_t x1 =
            std::min(static_cast<int64_t>(std::floor(star.x + radius)), image.nx - 1);
        const int64_t y1 = std::min(static_cast<int64_t>(std::floor(star.y + radius)), last_row);
        if (x0 > x1 || y0 > y1)
            continue;
        if (stamp.nx() != x1 - x0 + 1 || stamp.ny() != y1 - y0 + 1)
            stamp = Plane<double>(x1 - x0 + 1, y1 - y0 + 1);
        const Field &field = field_of(i);
        field.draw({star.x - static_cast<double>(window_x), star.y - static_cast<double>(window_y),
                    star.flux},
                   oversampling, x0 - window_x, y0 - window_y, stamp.view());
        for (int64_t y = y0; y <= y1; ++y)
            for (int64_t x = x0; x <= x1; ++x)
                image(x, y) += static_cast<T>(stamp(x - x0, y - y0));
    }
}

// work(first, last) for bands of an image's rows, one a thread.
template <class Work> void on_bands_of_rows(int64_t rows, int threads, const Work &work) {
    const auto bands = std::clamp<int64_t>(threads, 1, std::max<int64_t>(rows, 1));
    for_each_band(bands,
                  [&](int64_t band) { work(rows * band / bands, rows * (band + 1) / bands - 1); });
}

} // namespace wfpsf
