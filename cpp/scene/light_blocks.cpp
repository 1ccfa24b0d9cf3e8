// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/light_blocks.hpp"

#include "numerics/cubic_spline.hpp"
#include "numerics/dispatch.hpp"
#include "scene/sampled_light.hpp"

#include <algorithm>
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

// Pixels x0..x1, y0..y1.
struct Area {
    int64_t x0, x1, y0, y1;

    int64_t nx() const { return x1 - x0 + 1; }
    int64_t ny() const { return y1 - y0 + 1; }
    bool empty() const { return nx() <= 0 || ny() <= 0; }
};

// Stars are anywhere: their pixels are seldom in the cache.
template <class T> void fetch(View<T> image, const Area &area) {
    if (area.empty())
        return;
    for (int64_t y = area.y0; y <= area.y1; ++y) {
        __builtin_prefetch(&image(area.x0, y), 1);
        __builtin_prefetch(&image(area.x1, y), 1);
    }
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

// Coefficients in units of what is returned.
float store(const LightBlocks::Block &of, const LightSpline &spline, int16_t *to) {
    const int64_t n = spline.per_pixel;
    const Layout layout{n};
    // Coefficients as near count for no pixel, and would make the unit large.
    const double near = (of.inner - 2) * static_cast<double>(n);
    const auto is_near = [near](int64_t at) { return std::abs(static_cast<double>(at)) <= near; };
    std::vector<float> sorted(static_cast<size_t>(layout.size()));
    float most = std::numeric_limits<float>::min();
    for (int64_t r = 0; r < layout.rows(); ++r)
        for (int64_t i = 0; i < layout.row(); ++i) {
            const int64_t x = (of.x - layout.margin()) * n + i,
                          y = (of.y - layout.margin()) * n + r;
            if (is_near(x) && is_near(y))
                continue;
            const float here = spline.coefficients(spline.half * n + x, spline.half * n + y);
            sorted[static_cast<size_t>((r * n + i % n) * layout.run() + i / n)] = here;
            most = std::max(most, std::abs(here));
        }
    const float unit = most / std::numeric_limits<int16_t>::max();
    std::ranges::transform(sorted, to, [unit](float coefficient) {
        return static_cast<int16_t>(std::lround(coefficient / unit));
    });
    return unit;
}

} // namespace

LightBlocks::LightBlocks(std::vector<Block> blocks) {
    const auto brightest = [](const Block &of) {
        return std::ranges::max(of.parts, {}, &Part::brightest).brightest;
    };
    const auto layout_of = [](const Block &of) { return Layout{of.parts[0].spline->per_pixel}; };
    std::ranges::stable_sort(blocks, std::ranges::greater(), brightest);
    size_t size = 0;
    for (const Block &of : blocks)
        size += of.parts.size() * static_cast<size_t>(layout_of(of).size());
    coefficients_.resize(size);
    size_t first = 0;
    for (const Block &of : blocks) {
        blocks_.push_back(
            {brightest(of), of.x, of.y, layout_of(of).per_pixel, parts_.size(), of.parts.size()});
        for (const Part &part : of.parts) {
            const float unit = store(of, *part.spline, &coefficients_[first]);
            parts_.push_back({part.number, part.brightest, unit, first});
            first += static_cast<size_t>(layout_of(of).size());
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
    const auto taps_for = [&](int64_t per_pixel) {
        return taps_of(per_pixel, star.x - static_cast<double>(base_x),
                       star.y - static_cast<double>(base_y));
    };
    const std::array taps_by_half{taps_for(1), taps_for(2), taps_for(4)};
    const auto within = [&bounds](double at) {
        return std::pair(static_cast<int64_t>(std::ceil(at - bounds.radius)),
                         static_cast<int64_t>(std::floor(at + bounds.radius)));
    };
    const auto [left, right] = within(star.x);
    const auto [low, top] = within(star.y);
    const Area all{std::max(left, int64_t{0}), std::min(right, image.nx - 1),
                   std::max(low, first_row), std::min(top, last_row)};
    const auto pixels_of = [&](const StoredBlock &of) {
        const int64_t x = base_x + of.x, y = base_y + of.y;
        return Area{std::max(x, all.x0), std::min(x + wide - 1, all.x1), std::max(y, all.y0),
                    std::min(y + high - 1, all.y1)};
    };
    const auto is_inside = [&bounds](int64_t pixel, double centre) {
        return std::abs(static_cast<double>(pixel) - centre) <= bounds.inner;
    };
    alignas(cache_line) float coefficients[most_coefficients], pixels[high * wide];
    for (size_t i = 0; i < blocks_.size(); ++i) {
        const StoredBlock &of = blocks_[i];
        if (of.brightest * largest <= bounds.floor)
            break;
        if (i + 1 < blocks_.size())
            fetch(image, pixels_of(blocks_[i + 1]));
        const Area area = pixels_of(of);
        if (area.empty())
            continue;
        const bool left_inside = is_inside(area.x0, star.x);
        const bool right_inside = is_inside(area.x1, star.x);
        const bool low_inside = is_inside(area.y0, star.y);
        const bool top_inside = is_inside(area.y1, star.y);
        if (left_inside && right_inside && low_inside && top_inside)
            continue;
        // The inner part is wider than a block.
        const bool touches = (left_inside || right_inside) && (low_inside || top_inside);
        std::array<Weighted, most_parts> bright;
        size_t count = 0;
        for (const StoredPart &part : std::span(parts_).subspan(of.first_part, of.parts)) {
            const double weight = weights[part.number];
            if (part.brightest * std::abs(weight) > bounds.floor)
                bright[count++] = {&coefficients_[part.first],
                                   static_cast<float>(star.flux * weight) * part.unit};
        }
        if (count == 0)
            continue;
        combine(bright.data(), count, Layout{of.per_pixel}.size(), coefficients);
        sum(taps_by_half[static_cast<size_t>(of.per_pixel / 2)], coefficients, pixels);
        const float *const first =
            pixels + (area.y0 - base_y - of.y) * wide + area.x0 - base_x - of.x;
        if (!touches && image.stride_x == 1) {
            add_rows(first, area.nx(), &image(area.x0, area.y0), image.stride_y, area.ny());
            continue;
        }
        for (int64_t y = area.y0; y <= area.y1; ++y)
            for (int64_t x = area.x0; x <= area.x1; ++x)
                if (!touches || !is_inside(y, star.y) || !is_inside(x, star.x))
                    image(x, y) += static_cast<T>(first[(y - area.y0) * wide + x - area.x0]);
    }
}

template void LightBlocks::add(const Star &, std::span<const double>, const Bounds &, View<float>,
                               int64_t, int64_t) const;
template void LightBlocks::add(const Star &, std::span<const double>, const Bounds &, View<double>,
                               int64_t, int64_t) const;

} // namespace wfpsf
