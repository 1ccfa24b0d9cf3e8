// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/far_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace wfpsf {

namespace {

// Cubic Lagrange interpolation between samples -1, 0, 1, 2, at t of 0..1.
std::array<double, 4> weights(double t) {
    return {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
            (t + 1) * t * (t - 1) / 6};
}

} // namespace

FarTable::FarTable(const FarLight &light, double radius, double floor)
    : half_(static_cast<int64_t>(std::ceil(radius / block))) {
    // Samples of every sub-pixel phase are an image of native pixels of their own.
    const int64_t native = 2 * half_ * block + 4, size = native * per_pixel;
    light_ = Plane<float>(size, size);
    Plane<double> phase(native, native);
    const double centre = static_cast<double>(native) / 2;
    for (int64_t v = 0; v < per_pixel; ++v)
        for (int64_t u = 0; u < per_pixel; ++u) {
            phase = Plane<double>(native, native);
            light.add({centre - static_cast<double>(u) / per_pixel,
                       centre - static_cast<double>(v) / per_pixel, 1},
                      light.nearest(), floor, phase.view());
            for (int64_t y = 0; y < native; ++y)
                for (int64_t x = 0; x < native; ++x)
                    light_(x * per_pixel + u, y * per_pixel + v) = static_cast<float>(phase(x, y));
        }
    const int64_t blocks = 2 * half_;
    for (int64_t b = 0; b < blocks; ++b)
        for (int64_t a = 0; a < blocks; ++a) {
            float most = 0;
            for (int64_t y = 0; y < block * per_pixel; ++y)
                for (int64_t x = 0; x < block * per_pixel; ++x)
                    most = std::max(most, light_((2 + a * block) * per_pixel + x,
                                                 (2 + b * block) * per_pixel + y));
            brightest_.push_back(most);
        }
}

FarTable FarTable::mixed(std::span<const FarTable> tables, std::span<const double> weights) {
    FarTable sum = tables[0];
    const auto scale_and_add = [&](float *to, auto from, size_t count) {
        for (size_t i = 0; i < count; ++i) {
            float value = 0;
            for (size_t t = 0; t < tables.size(); ++t)
                value += static_cast<float>(weights[t]) * from(tables[t])[i];
            to[i] = value;
        }
    };
    scale_and_add(
        sum.light_.view().data, [](const FarTable &t) { return t.light_.view().data; },
        static_cast<size_t>(sum.light_.nx() * sum.light_.ny()));
    scale_and_add(
        sum.brightest_.data(), [](const FarTable &t) { return t.brightest_.data(); },
        sum.brightest_.size());
    return sum;
}

template <class T>
void FarTable::add(const Star &star, double inner, double floor, View<T> image, int64_t first_row,
                   int64_t last_row) const {
    // Pixel p of the image is at p - star of the table, whose first sample is at -origin.
    const double origin = static_cast<double>(half_ * block + 2);
    const double fraction_x = star.x - std::floor(star.x), fraction_y = star.y - std::floor(star.y);
    const auto base_x = static_cast<int64_t>(std::floor(star.x));
    const auto base_y = static_cast<int64_t>(std::floor(star.y));
    // The same fraction of a sample for all pixels.
    const auto split = [origin](double fraction) {
        const double at = (origin - fraction) * per_pixel;
        return std::pair(static_cast<int64_t>(std::floor(at)), at - std::floor(at));
    };
    const auto [sample_x, tx] = split(fraction_x);
    const auto [sample_y, ty] = split(fraction_y);
    const std::array<double, 4> wx = weights(tx), wy = weights(ty);
    for (int64_t b = -half_; b < half_; ++b) {
        const int64_t y0 = std::max(base_y + b * block, first_row);
        const int64_t y1 = std::min(base_y + (b + 1) * block - 1, last_row);
        if (y0 > y1)
            continue;
        for (int64_t a = -half_; a < half_; ++a) {
            const auto i = static_cast<size_t>((b + half_) * 2 * half_ + a + half_);
            if (static_cast<double>(brightest_[i]) <= floor)
                continue;
            const int64_t x0 = std::max<int64_t>(base_x + a * block, 0);
            const int64_t x1 = std::min(base_x + (a + 1) * block - 1, image.nx - 1);
            for (int64_t y = y0; y <= y1; ++y) {
                const bool row_inside = std::abs(static_cast<double>(y) - star.y) <= inner;
                const int64_t row = sample_y + (y - base_y) * per_pixel - 1;
                for (int64_t x = x0; x <= x1; ++x) {
                    if (row_inside && std::abs(static_cast<double>(x) - star.x) <= inner)
                        continue;
                    const int64_t column = sample_x + (x - base_x) * per_pixel - 1;
                    double sum = 0;
                    for (int64_t v = 0; v < 4; ++v) {
                        const float *const from = &light_(column, row + v);
                        sum += wy[static_cast<size_t>(v)] * (wx[0] * static_cast<double>(from[0]) +
                                                             wx[1] * static_cast<double>(from[1]) +
                                                             wx[2] * static_cast<double>(from[2]) +
                                                             wx[3] * static_cast<double>(from[3]));
                    }
                    image(x, y) += static_cast<T>(star.flux * sum);
                }
            }
        }
    }
}

std::array<std::pair<double, double>, 4> FarTables::corners(const Region &image) {
    return {std::pair(image.x0, image.y0), std::pair(image.x1, image.y0),
            std::pair(image.x0, image.y1), std::pair(image.x1, image.y1)};
}

FarTable FarTables::of_cell(size_t cell) const {
    if (tables_.size() == 1)
        return tables_[0];
    const auto middle = [this](size_t part) {
        return (static_cast<double>(part) + 0.5) / static_cast<double>(across_);
    };
    const double u = middle(cell % across_), v = middle(cell / across_);
    return FarTable::mixed(tables_, std::array{(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v});
}

template void FarTable::add(const Star &, double, double, View<float>, int64_t, int64_t) const;
template void FarTable::add(const Star &, double, double, View<double>, int64_t, int64_t) const;

} // namespace wfpsf
