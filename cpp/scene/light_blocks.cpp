// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/light_blocks.hpp"

#include "numerics/cubic_spline.hpp"
#include "numerics/dispatch.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace wfpsf {

namespace {

constexpr int64_t wide = LightBlocks::wide, high = LightBlocks::high;
constexpr size_t taps = 4;       // along an axis
constexpr int64_t together = 32; // coefficients, whole vectors of them

// Of a block's coefficients those of one phase of a row lie side by side: coefficient
// (x * per_pixel + u, r) at (r * per_pixel + u) * run() + x.
struct Layout {
    int64_t per_pixel;

    constexpr int64_t margin() const { return per_pixel == 1 ? 2 : 1; } // native pixels
    constexpr int64_t run() const { return wide + 2 * margin(); }
    constexpr int64_t row() const { return per_pixel * run(); }
    constexpr int64_t rows() const { return (high + 2 * margin()) * per_pixel; }
    constexpr int64_t size() const { return (rows() * row() + together - 1) / together * together; }
};
constexpr int64_t most_coefficients = Layout{4}.size();

// Coefficients, and the weight of their unit.
struct Weighted {
    const int16_t *first;
    float weight;
};

// The sum of so many parts, or that is added.
template <bool adds, size_t... part>
[[gnu::always_inline]] inline void sum_parts(const Weighted *parts, int64_t size,
                                             float *__restrict sums,
                                             std::index_sequence<part...> /*all*/) {
    for (int64_t i = 0; i < size; ++i) {
        const float sum = (... + (parts[part].weight * static_cast<float>(parts[part].first[i])));
        sums[i] = adds ? sums[i] + sum : sum;
    }
}

WFPSF_VECTORISED void combine(const Weighted *parts, size_t count, int64_t size, float *sums) {
    constexpr size_t many = 3;
    sum_parts<false>(parts, size, sums, std::make_index_sequence<1>());
    for (++parts, --count; count >= many; count -= many, parts += many)
        sum_parts<true>(parts, size, sums, std::make_index_sequence<many>());
    for (; count > 0; --count, ++parts)
        sum_parts<true>(parts, size, sums, std::make_index_sequence<1>());
}

// The first pixel is the sum of these coefficients; those of the next ones are beside them, those
// of the next rows `step` after them.
struct Taps {
    std::array<int64_t, taps * taps> first;
    std::array<float, taps * taps> weight;
    int64_t step;
};

template <size_t... tap>
[[gnu::always_inline]] inline void sum_row(const Taps &of, const float *coefficients,
                                           float *__restrict pixels,
                                           std::index_sequence<tap...> /*all*/) {
    const std::array from{coefficients + of.first[tap]...};
    const std::array weight = of.weight;
    for (int64_t i = 0; i < wide; ++i)
        pixels[i] = (... + (weight[tap] * from[tap][i]));
}

WFPSF_VECTORISED void sum(const Taps &of, const float *coefficients, float *pixels) {
    for (int64_t y = 0; y < high; ++y)
        sum_row(of, coefficients + y * of.step, pixels + y * wide,
                std::make_index_sequence<taps * taps>());
}

// Of so many pixels: where the compiler knows that they are few, it makes no vectors.
template <class T>
[[gnu::always_inline]] inline void add_rows_of(const float *pixels, int64_t count, T *image,
                                               int64_t stride, int64_t rows) {
    for (int64_t y = 0; y < rows; ++y)
        for (int64_t x = 0; x < count; ++x)
            image[y * stride + x] += static_cast<T>(pixels[y * wide + x]);
}
WFPSF_VECTORISED void add_rows(const float *__restrict pixels, int64_t count,
                               float *__restrict image, int64_t stride, int64_t rows) {
    add_rows_of(pixels, count, image, stride, rows);
}
WFPSF_VECTORISED void add_rows(const float *__restrict pixels, int64_t count,
                               double *__restrict image, int64_t stride, int64_t rows) {
    add_rows_of(pixels, count, image, stride, rows);
}

// Taps along an axis for a star that stands so far from the centre of its pixel.
struct Axis {
    std::array<int64_t, taps> sample; // from the pixel's centre
    std::array<double, taps> weight;

    Axis(int64_t per_pixel, double fraction) {
        const double at = -fraction * static_cast<double>(per_pixel);
        const double below = std::floor(at);
        weight = spline_weights(at - below);
        for (size_t k = 0; k < taps; ++k)
            sample[k] = static_cast<int64_t>(below) - 1 + static_cast<int64_t>(k);
    }
};

Taps taps_of(int64_t per_pixel, double fraction_x, double fraction_y) {
    const Layout layout{per_pixel};
    const Axis x(per_pixel, fraction_x), y(per_pixel, fraction_y);
    Taps of{{}, {}, per_pixel * layout.row()};
    for (size_t v = 0; v < taps; ++v)
        for (size_t u = 0; u < taps; ++u) {
            const int64_t column = x.sample[u] + layout.margin() * per_pixel;
            const int64_t row = y.sample[v] + layout.margin() * per_pixel;
            of.first[v * taps + u] =
                row * layout.row() + column % per_pixel * layout.run() + column / per_pixel;
            of.weight[v * taps + u] = static_cast<float>(y.weight[v] * x.weight[u]);
        }
    return of;
}

} // namespace

LightBlocks::LightBlocks(std::vector<Block> blocks) {
    const auto brightest = [](const Block &block) {
        double most = 0;
        for (const Part &part : block.parts)
            most = std::max(most, part.brightest);
        return most;
    };
    std::ranges::stable_sort(blocks, std::ranges::greater(), brightest);
    size_t all = 0;
    for (const Block &block : blocks)
        all += block.parts.size() * static_cast<size_t>(Layout{block.per_pixel}.size());
    coefficients_.resize(all);
    size_t first = 0;
    std::vector<float> sorted(most_coefficients);
    for (const Block &block : blocks) {
        const Layout layout{block.per_pixel};
        blocks_.push_back({brightest(block), block.x, block.y, block.per_pixel, parts_.size(),
                           parts_.size() + block.parts.size(), first});
        for (const Part &part : block.parts) {
            float most = std::numeric_limits<float>::min();
            for (int64_t r = 0; r < layout.rows(); ++r)
                for (int64_t x = 0; x < layout.row(); ++x) {
                    const int64_t n = block.per_pixel;
                    const int64_t from_x = (block.x - layout.margin()) * n + x;
                    const int64_t from_y = (block.y - layout.margin()) * n + r;
                    const auto is_near = [&](int64_t at) {
                        return std::abs(static_cast<double>(at)) <=
                               (block.never - 2) * static_cast<double>(n);
                    };
                    const float here = is_near(from_x) && is_near(from_y)
                                           ? 0
                                           : (*part.coefficients)(block.half * n + from_x,
                                                                  block.half * n + from_y);
                    sorted[static_cast<size_t>((r * n + x % n) * layout.run() + x / n)] = here;
                    most = std::max(most, std::abs(here));
                }
            const float unit = most / std::numeric_limits<int16_t>::max();
            parts_.push_back({part.number, part.brightest, unit});
            for (int64_t i = 0; i < layout.rows() * layout.row(); ++i)
                coefficients_[first + static_cast<size_t>(i)] =
                    static_cast<int16_t>(std::lround(sorted[static_cast<size_t>(i)] / unit));
            first += static_cast<size_t>(layout.size());
        }
    }
}

template <class T>
void LightBlocks::add(const Star &star, std::span<const double> weights, const Bounds &bounds,
                      View<T> image, int64_t first_row, int64_t last_row) const {
    double largest = 0;
    for (const double weight : weights)
        largest = std::max(largest, std::abs(weight));
    const auto base_x = static_cast<int64_t>(std::floor(star.x + 0.5));
    const auto base_y = static_cast<int64_t>(std::floor(star.y + 0.5));
    const double fraction_x = star.x - static_cast<double>(base_x);
    const double fraction_y = star.y - static_cast<double>(base_y);
    const std::array by_samples{taps_of(1, fraction_x, fraction_y),
                                taps_of(2, fraction_x, fraction_y),
                                taps_of(4, fraction_x, fraction_y)};
    const auto within = [&bounds](double at) {
        return std::pair(static_cast<int64_t>(std::ceil(at - bounds.radius)),
                         static_cast<int64_t>(std::floor(at + bounds.radius)));
    };
    const auto [left, right] = within(star.x);
    const auto [low, top] = within(star.y);
    const auto is_inside = [&bounds](int64_t pixel, double centre) {
        return std::abs(static_cast<double>(pixel) - centre) <= bounds.inner;
    };
    alignas(cache_line) float coefficients[most_coefficients], pixels[high * wide];
    for (const Stored &block : blocks_) {
        if (block.brightest * largest <= bounds.floor)
            break;
        const int64_t block_x = base_x + block.x, block_y = base_y + block.y;
        const int64_t x0 = std::max({block_x, left, int64_t{0}});
        const int64_t x1 = std::min({block_x + wide - 1, right, image.nx - 1});
        const int64_t y0 = std::max({block_y, low, first_row});
        const int64_t y1 = std::min({block_y + high - 1, top, last_row});
        if (x0 > x1 || y0 > y1)
            continue;
        if (const Stored *next = &block + 1; next < blocks_.data() + blocks_.size()) {
            const int64_t nx = std::clamp<int64_t>(base_x + next->x, 0, image.nx - 1);
            const int64_t ny = base_y + next->y;
            for (int64_t y = std::max(ny, first_row); y < std::min(ny + high, last_row + 1); ++y) {
                __builtin_prefetch(&image(nx, y), 1);
                __builtin_prefetch(&image(std::min(nx + wide - 1, image.nx - 1), y), 1);
            }
        }
        const bool left_inside = is_inside(x0, star.x), right_inside = is_inside(x1, star.x);
        const bool low_inside = is_inside(y0, star.y), top_inside = is_inside(y1, star.y);
        if (left_inside && right_inside && low_inside && top_inside)
            continue;
        // The inner part is wider than a block.
        const bool touches = (left_inside || right_inside) && (low_inside || top_inside);
        std::array<Weighted, most_parts> bright;
        size_t count = 0;
        const int64_t size = Layout{block.per_pixel}.size();
        for (size_t k = block.first_part; k < block.end_part; ++k) {
            const StoredPart &part = parts_[k];
            const double weight = weights[part.number];
            if (part.brightest * std::abs(weight) > bounds.floor)
                bright[count++] = {&coefficients_[block.first + (k - block.first_part) *
                                                                    static_cast<size_t>(size)],
                                   static_cast<float>(star.flux * weight) * part.unit};
        }
        if (count == 0)
            continue;
        combine(bright.data(), count, size, coefficients);
        sum(by_samples[static_cast<size_t>(block.per_pixel / 2)], coefficients, pixels);
        if (!touches && image.stride_x == 1) {
            add_rows(pixels + (y0 - block_y) * wide + x0 - block_x, x1 - x0 + 1, &image(x0, y0),
                     image.stride_y, y1 - y0 + 1);
            continue;
        }
        for (int64_t y = y0; y <= y1; ++y) {
            const float *const row = pixels + (y - block_y) * wide - block_x;
            for (int64_t x = x0; x <= x1; ++x)
                if (!touches || !is_inside(y, star.y) || !is_inside(x, star.x))
                    image(x, y) += static_cast<T>(row[x]);
        }
    }
}

template void LightBlocks::add(const Star &, std::span<const double>, const Bounds &, View<float>,
                               int64_t, int64_t) const;
template void LightBlocks::add(const Star &, std::span<const double>, const Bounds &, View<double>,
                               int64_t, int64_t) const;

} // namespace wfpsf
