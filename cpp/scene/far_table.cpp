// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/far_table.hpp"

#include "scene/far_differences.hpp"
#include "scene/middle_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace wfpsf {

namespace {

LightBlocks blocks_of(const MiddleLight &light) {
    std::vector<LightBlocks::Block> blocks;
    for (const MiddleLight::Block &of : light.blocks)
        if (of.brightest > light.floor)
            blocks.push_back(
                {of.x, of.y, light.inner, {{0, of.brightest, &light.spline(of.per_pixel)}}});
    return LightBlocks(std::move(blocks));
}

} // namespace

FarTable::FarTable(const MiddleLight &light) : radius_(light.radius), blocks_(blocks_of(light)) {
    for (const MiddleLight::Block &of : light.blocks)
        if (of.brightest > light.floor)
            for (const MiddleLight::Cell &cell : of.cells)
                shares_.push_back({of.brightest, cell.light, cell.x, cell.y});
    std::ranges::stable_sort(shares_, std::ranges::greater(), &Share::brightest);
}

double FarTable::light(double within, double inner, double floor) const {
    // How much of an area is at most so far from the star.
    const auto part = [](const Share &of, double radius) {
        const auto along = [radius](int64_t first) {
            const double at = static_cast<double>(first) - 0.5, end = at + MiddleLight::Cell::size;
            return std::max(std::min(end, radius) - std::max(at, -radius), 0.0);
        };
        return along(of.x) * along(of.y);
    };
    double sum = 0;
    for (const Share &of : shares_) {
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
    constexpr std::array all{1.0};
    blocks_.add(star, all, {inner, radius_, floor}, image, first_row, last_row);
}

std::vector<std::pair<double, double>> FarTables::places(const Region &image, bool varies) {
    const auto at = [&image](int i, int j) {
        return std::pair(std::lerp(image.x0, image.x1, i / 2.0),
                         std::lerp(image.y0, image.y1, j / 2.0));
    };
    if (!varies)
        return {at(1, 1)};
    std::vector<std::pair<double, double>> places;
    places.reserve(order_of_places.size());
    for (const auto &[i, j] : order_of_places)
        places.push_back(at(i, j));
    return places;
}

FarTables::FarTables(std::span<const FarLight> at_places, const Psf *exact, const Region &image,
                     const Extent &extent, int threads)
    : FarTables(at_places, image, extent,
                MiddleLight(at_places[0], exact, extent.radius, extent.floor, threads), threads) {}

FarTables::FarTables(std::span<const FarLight> at_places, const Region &image, const Extent &extent,
                     const MiddleLight &middle, int threads)
    : image_(image), differences_radius_(extent.differences_radius), middle_(middle),
      differences_(far_differences(at_places, middle, extent.differences_radius,
                                   extent.differences_floor, threads)) {}

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
    std::array<double, order_of_places.size() - 1> weights{};
    for (size_t k = 0; k < weights.size(); ++k) {
        const auto &[i, j] = order_of_places[k + 1];
        weights[k] = along_x[static_cast<size_t>(i)] * along_y[static_cast<size_t>(j)];
    }
    differences_.add(star, weights, {inner, differences_radius_, little * floor}, image, first_row,
                     last_row);
}

template void FarTable::add(const Star &, double, double, View<float>, int64_t, int64_t) const;
template void FarTable::add(const Star &, double, double, View<double>, int64_t, int64_t) const;
template void FarTables::add(const Star &, double, double, double, double, View<float>, int64_t,
                             int64_t) const;
template void FarTables::add(const Star &, double, double, double, double, View<double>, int64_t,
                             int64_t) const;

} // namespace wfpsf
