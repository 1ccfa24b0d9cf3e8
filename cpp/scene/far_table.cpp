// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/far_table.hpp"

#include "numerics/cubic_spline.hpp"
#include "numerics/dispatch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace wfpsf {

namespace {

constexpr int64_t taps = 4;            // along an axis
constexpr int64_t wide = 16, high = 8; // a block, native pixels

// The first pixel of a block is the sum of these coefficients; the next ones are beside them, the
// next rows' `stride` after them.
struct Taps {
    std::array<const float *, taps * taps> first;
    std::array<float, taps * taps> weight;
    int64_t stride;
};

WFPSF_VECTORISED void sum(const Taps &of, float *pixels) {
    for (int64_t y = 0; y < high; ++y) {
        float sums[wide] = {};
        for (size_t k = 0; k < of.first.size(); ++k)
            for (int64_t i = 0; i < wide; ++i)
                sums[i] += of.weight[k] * of.first[k][y * of.stride + i];
        std::copy_n(sums, wide, pixels + y * wide);
    }
}

// Coarse samples do for what is small.
constexpr int64_t per_pixel_of_light = 4, per_pixel_of_differences = 2;

SampledLight sampled_middle(const FarLight &light, const Psf *exact, double radius, double floor) {
    SampledLight sampled(per_pixel_of_light, radius);
    double inner = light.nearest();
    if (exact) {
        sampled.add(*exact);
        inner = exact->settings().radius;
    }
    sampled.add(light, inner, floor);
    return sampled;
}

// The places along x and y in the order of FarTables::places().
constexpr std::array<std::pair<int, int>, 9> order{
    {{1, 1}, {0, 1}, {2, 1}, {1, 0}, {1, 2}, {0, 0}, {2, 0}, {0, 2}, {2, 2}}};

// From the values of a quadratic at -1, 0 and 1 to its coefficients.
void to_coefficients(SampledLight &from, const SampledLight &middle, SampledLight &to) {
    for (int64_t y = 0; y < middle.sample.ny(); ++y)
        for (int64_t x = 0; x < middle.sample.nx(); ++x) {
            float &first = from.sample(x, y), &last = to.sample(x, y);
            const float slope = (last - first) / 2, mean = (last + first) / 2;
            first = slope;
            last = mean - middle.sample(x, y);
        }
}

} // namespace

// Blocks of a table reach a little farther than its light.
SampledLight::SampledLight(int64_t samples, double radius)
    : per_pixel(samples), half(static_cast<int64_t>(std::ceil(radius)) + 3 * wide),
      sample(2 * half * per_pixel + 1, 2 * half * per_pixel + 1) {}

// Samples of every sub-pixel phase are an image of native pixels of their own.
void SampledLight::add(const FarLight &light, double inner, double floor) {
    for (int64_t v = 0; v < per_pixel; ++v)
        for (int64_t u = 0; u < per_pixel; ++u) {
            const View<float> all = sample.view();
            const View<float> phase{all.row(v) + u, (all.nx - u + per_pixel - 1) / per_pixel,
                                    (all.ny - v + per_pixel - 1) / per_pixel, per_pixel,
                                    per_pixel * all.stride_y};
            const auto star = [this](int64_t first) {
                return static_cast<double>(half) -
                       static_cast<double>(first) / static_cast<double>(per_pixel);
            };
            light.add({star(u), star(v), 1}, inner, floor, phase);
        }
}

void SampledLight::add(const Psf &psf) {
    const auto reach = static_cast<int64_t>(
        std::min(std::floor(psf.settings().radius), static_cast<double>(half)) *
        static_cast<double>(per_pixel));
    const int64_t first = half * per_pixel - reach;
    const View<float> all = sample.view();
    const View<float> within{all.row(first) + first, 2 * reach + 1, 2 * reach + 1, 1, all.stride_y};
    // Samples get their share of a native pixel.
    const auto middle = static_cast<double>(reach);
    psf.draw({middle, middle, static_cast<double>(per_pixel * per_pixel)}, per_pixel, within,
             Psf::Drawing::adds);
}

FarTable::FarTable(SampledLight light, double radius)
    : per_pixel_(light.per_pixel), half_(light.half), radius_(radius) {
    const auto blocks = [radius](int64_t size) {
        return static_cast<int64_t>(std::ceil(radius / static_cast<double>(size))) + 1;
    };
    for (int64_t b = -blocks(high) * high; b < blocks(high) * high; b += high)
        for (int64_t a = -blocks(wide) * wide; a < blocks(wide) * wide; a += wide) {
            float most = 0; // wherever in its pixel the star stands
            double all = 0;
            for (int64_t y = -per_pixel_; y < high * per_pixel_; ++y)
                for (int64_t x = -per_pixel_; x < wide * per_pixel_; ++x) {
                    const float here =
                        light.sample((half_ + a) * per_pixel_ + x, (half_ + b) * per_pixel_ + y);
                    most = std::max(most, std::abs(here));
                    if (x >= 0 && y >= 0)
                        all += static_cast<double>(here);
                }
            const auto samples = static_cast<double>(per_pixel_ * per_pixel_);
            blocks_.push_back({static_cast<double>(most), all / samples, a, b});
        }
    std::ranges::stable_sort(blocks_, std::ranges::greater(), &Block::brightest);
    to_spline_coefficients(light.sample);
    const int64_t native = 2 * half_;
    light_ = Plane<float>(native, native * per_pixel_ * per_pixel_);
    for (int64_t y = 0; y < native * per_pixel_; ++y)
        for (int64_t x = 0; x < native; ++x)
            for (int64_t u = 0; u < per_pixel_; ++u)
                light_(x, y * per_pixel_ + u) = light.sample(x * per_pixel_ + u, y);
}

double FarTable::light(double within, double inner, double floor) const {
    // How much of a block's area is at most so far from the star.
    const auto part = [](const Block &of, double radius) {
        const auto along = [radius](int64_t first, int64_t size) {
            const auto at = static_cast<double>(first), length = static_cast<double>(size);
            return std::clamp(std::min(at + length, radius) - std::max(at, -radius), 0.0, length) /
                   length;
        };
        return along(of.x, wide) * along(of.y, high);
    };
    double sum = 0;
    for (const Block &of : blocks_) {
        if (of.brightest <= floor)
            break;
        const double inside = part(of, std::min(within, radius_)) - part(of, inner);
        sum += of.light * std::max(inside, 0.0);
    }
    return sum;
}

template <class T>
void FarTable::add(const Star &star, double inner, double floor, View<T> image, int64_t first_row,
                   int64_t last_row) const {
    const auto base_x = static_cast<int64_t>(std::floor(star.x));
    const auto base_y = static_cast<int64_t>(std::floor(star.y));
    // Of the star's pixel, the same fraction of a sample for all: taps by native pixel and phase.
    struct Axis {
        std::array<int64_t, taps> pixel, phase;
        std::array<double, taps> weight;
    };
    const auto axis = [this](double fraction) {
        const double at = (static_cast<double>(half_) - fraction) * static_cast<double>(per_pixel_);
        Axis found{{}, {}, spline_weights(at - std::floor(at))};
        for (size_t k = 0; k < found.pixel.size(); ++k) {
            const int64_t sample =
                static_cast<int64_t>(std::floor(at)) - 1 + static_cast<int64_t>(k);
            found.pixel[k] = sample / per_pixel_;
            found.phase[k] = sample % per_pixel_;
        }
        return found;
    };
    const Axis x_axis = axis(star.x - static_cast<double>(base_x));
    const Axis y_axis = axis(star.y - static_cast<double>(base_y));
    const auto within = [](double at, double radius) {
        return std::pair(static_cast<int64_t>(std::ceil(at - radius)),
                         static_cast<int64_t>(std::floor(at + radius)));
    };
    const auto [left, right] = within(star.x, radius_);
    const auto [low, top] = within(star.y, radius_);
    Taps of{};
    of.stride = light_.nx() * per_pixel_ * per_pixel_;
    for (size_t v = 0; v < taps; ++v)
        for (size_t u = 0; u < taps; ++u)
            of.weight[v * taps + u] = static_cast<float>(y_axis.weight[v] * x_axis.weight[u]);
    float pixels[high * wide];
    for (const Block &part : blocks_) {
        if (part.brightest <= floor)
            break;
        const int64_t block_x = base_x + part.x, block_y = base_y + part.y;
        const int64_t x0 = std::max({block_x, left, int64_t{0}});
        const int64_t x1 = std::min({block_x + wide - 1, right, image.nx - 1});
        const int64_t y0 = std::max({block_y, low, first_row});
        const int64_t y1 = std::min({block_y + high - 1, top, last_row});
        if (x0 > x1 || y0 > y1)
            continue;
        const auto is_inside = [inner](int64_t pixel, double centre) {
            return std::abs(static_cast<double>(pixel) - centre) <= inner;
        };
        const bool left_inside = is_inside(x0, star.x), right_inside = is_inside(x1, star.x);
        const bool low_inside = is_inside(y0, star.y), top_inside = is_inside(y1, star.y);
        if (left_inside && right_inside && low_inside && top_inside)
            continue;
        // The inner part is wider than a block.
        const bool touches = (left_inside || right_inside) && (low_inside || top_inside);
        for (size_t v = 0; v < taps; ++v)
            for (size_t u = 0; u < taps; ++u)
                of.first[v * taps + u] = &light_(
                    part.x + x_axis.pixel[u],
                    ((part.y + y_axis.pixel[v]) * per_pixel_ + y_axis.phase[v]) * per_pixel_ +
                        x_axis.phase[u]);
        sum(of, pixels);
        for (int64_t y = y0; y <= y1; ++y) {
            const float *const row = pixels + (y - block_y) * wide - block_x;
            for (int64_t x = x0; x <= x1; ++x)
                if (!touches || !is_inside(y, star.y) || !is_inside(x, star.x))
                    image(x, y) += static_cast<T>(star.flux * static_cast<double>(row[x]));
        }
    }
}

std::vector<std::pair<double, double>> FarTables::places(const Region &image, bool varies) {
    const auto at = [&image](int i, int j) {
        return std::pair(std::lerp(image.x0, image.x1, i / 2.0),
                         std::lerp(image.y0, image.y1, j / 2.0));
    };
    if (!varies)
        return {at(1, 1)};
    std::vector<std::pair<double, double>> places;
    places.reserve(order.size());
    for (const auto &[i, j] : order)
        places.push_back(at(i, j));
    return places;
}

FarTables::FarTables(std::span<const FarLight> at_places, const Psf *exact, const Region &image,
                     const Extent &extent)
    : image_(image),
      middle_(sampled_middle(at_places[0], exact, extent.radius, extent.floor), extent.radius) {
    const double radius = extent.differences_radius;
    if (at_places.size() == 1 || radius <= at_places[0].nearest())
        return;
    // Of what is below a floor everywhere, differences are less.
    constexpr double less = 0.3;
    std::array<std::array<std::optional<SampledLight>, 3>, 3> at; // [j][i]
    for (size_t k = 0; k < order.size(); ++k) {
        auto &sampled =
            at[static_cast<size_t>(order[k].second)][static_cast<size_t>(order[k].first)];
        sampled.emplace(per_pixel_of_differences, radius);
        sampled->add(at_places[k], at_places[k].nearest(), extent.floor / less);
    }
    for (auto &row : at)
        to_coefficients(*row[0], *row[1], *row[2]);
    for (size_t i = 0; i < at.size(); ++i)
        to_coefficients(*at[0][i], *at[1][i], *at[2][i]);
    for (const auto &[i, j] : std::span(order).subspan(1))
        differences_.emplace_back(std::move(*at[static_cast<size_t>(j)][static_cast<size_t>(i)]),
                                  radius);
}

int64_t FarTables::memory() const {
    int64_t bytes = middle_.memory();
    for (const FarTable &difference : differences_)
        bytes += difference.memory();
    return bytes;
}

template <class T>
void FarTables::add(const Star &star, double x, double y, double inner, double floor, View<T> image,
                    int64_t first_row, int64_t last_row) const {
    middle_.add(star, inner, floor, image, first_row, last_row);
    constexpr double little = 0.1; // of the floor
    const auto powers = [](double at, double low, double high) {
        const double u = std::clamp(2 * (at - low) / (high - low) - 1, -1.0, 1.0);
        return std::array{u, 1.0, u * u};
    };
    const auto along_x = powers(x, image_.x0, image_.x1);
    const auto along_y = powers(y, image_.y0, image_.y1);
    for (size_t k = 0; k < differences_.size(); ++k) {
        const auto &[i, j] = order[k + 1];
        const double weight = along_x[static_cast<size_t>(i)] * along_y[static_cast<size_t>(j)];
        if (weight != 0)
            differences_[k].add({star.x, star.y, weight * star.flux}, inner,
                                little * floor / std::abs(weight), image, first_row, last_row);
    }
}

template void FarTable::add(const Star &, double, double, View<float>, int64_t, int64_t) const;
template void FarTable::add(const Star &, double, double, View<double>, int64_t, int64_t) const;
template void FarTables::add(const Star &, double, double, double, double, View<float>, int64_t,
                             int64_t) const;
template void FarTables::add(const Star &, double, double, double, double, View<double>, int64_t,
                             int64_t) const;

} // namespace wfpsf
