// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/far_table.hpp"

#include "scene/sampled_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

namespace wfpsf {

namespace {

constexpr int64_t wide = LightBlocks::wide, high = LightBlocks::high;

// Splines may be off by that share of the brightest pixel as far from the star. Those of twice as
// many samples are better by `better`, or more.
constexpr double coarse = 1e-4, better = 8;

// The samples that a block's pixels may fall on.
SampleRange range_of(int64_t x, int64_t y, int64_t blocks, int64_t per_pixel) {
    const int64_t half = per_pixel / 2;
    return {x * per_pixel - half, y * per_pixel - half,
            (blocks * wide - 1) * per_pixel + 2 * half + 1, (high - 1) * per_pixel + 2 * half + 1};
}

// work(x, y) on the samples of a range that are not near the star along both axes.
template <class Work>
void on_samples(const SampledLight &light, const SampleRange &range, double never,
                const Work &work) {
    const auto near = static_cast<int64_t>(never * static_cast<double>(light.per_pixel));
    for (int64_t y = range.y; y < range.y + range.ny; ++y)
        for (int64_t x = range.x; x < range.x + range.nx; ++x)
            if (std::abs(x) > near || std::abs(y) > near)
                work(light.middle() + x, light.middle() + y);
}

// No pixel more than that from the star is beyond the borders of blocks.
int64_t half_width(double radius) {
    return static_cast<int64_t>(std::ceil(radius)) + wide + 4;
}

} // namespace

// The light of one place, in blocks, those of a row in turn.
struct MiddleLight {
    struct Block {
        int64_t x, y;
        double brightest = 0, light = 0; // in a pixel; on the average
        double tolerance = 0;            // what splines may be off
        double off = 0;                  // what those of one sample a pixel are
        int64_t per_pixel = 1;           // what it takes
    };
    using Fill = std::function<void(SampledLight &, const SampleRange &)>;

    MiddleLight(const FarLight &light, const Psf *exact, const FarTables::Extent &extent);

    double radius, never, floor;
    std::vector<Block> blocks;
    std::array<Plane<float>, 3> coefficients; // of 1, 2, 4 samples a pixel

    // Runs of blocks that are wanted.
    template <class Wanted, class Work>
    void on_runs(int64_t per_pixel, const Wanted &wanted, const Work &work) const {
        for (size_t i = 0; i < blocks.size();) {
            size_t end = i;
            while (end < blocks.size() && wanted(blocks[end]) && blocks[end].y == blocks[i].y &&
                   blocks[end].x == blocks[i].x + static_cast<int64_t>(end - i) * wide)
                ++end;
            if (end > i)
                work(range_of(blocks[i].x, blocks[i].y, static_cast<int64_t>(end - i), per_pixel));
            i = std::max(end, i + 1);
        }
    }

    // How far one is off the other.
    double off(const Block &tile, const SampledLight &is, const SampledLight &guess) const;

  private:
    void find_tolerances(const SampledLight &light);
};

double MiddleLight::off(const Block &tile, const SampledLight &is,
                        const SampledLight &guess) const {
    float most = 0;
    on_samples(is, range_of(tile.x, tile.y, 1, is.per_pixel), never, [&](int64_t x, int64_t y) {
        most = std::max(most, std::abs(is.sample(x, y) - guess.sample(x, y)));
    });
    return static_cast<double>(most);
}

MiddleLight::MiddleLight(const FarLight &light, const Psf *exact, const FarTables::Extent &extent)
    : radius(extent.radius), never(light.nearest() + 1), floor(extent.floor) {
    const auto first = [this](int64_t size) {
        return -static_cast<int64_t>(std::ceil(radius / static_cast<double>(size))) * size;
    };
    const auto reaches = [this](int64_t at) { return static_cast<double>(at) - 0.5 <= radius; };
    const auto is_near = [this](int64_t at, int64_t size) {
        return static_cast<double>(-at) + 0.5 <= never &&
               static_cast<double>(at + size) - 0.5 <= never;
    };
    for (int64_t y = first(high); reaches(y); y += high)
        for (int64_t x = first(wide); reaches(x); x += wide)
            if (!is_near(x, wide) || !is_near(y, high))
                blocks.push_back({x, y});
    const auto fill = [&](SampledLight &sampled, const SampleRange &range) {
        if (exact)
            sampled.add(*exact, range);
        sampled.add(light, exact ? exact->settings().radius : light.nearest(), floor, range);
    };
    SampledLight two(2, half_width(radius));
    fill(two, two.all());
    find_tolerances(two);
    LightSpline of_one(two.coarser());
    const SampledLight guess_two = of_one.finer();
    for (Block &tile : blocks)
        tile.off = off(tile, two, guess_two);
    LightSpline of_two(std::move(two));
    const SampledLight guess_four = of_two.finer();
    SampledLight four = guess_four;
    const auto may_need_four = [](const Block &tile) {
        return tile.off > better * tile.tolerance;
    };
    on_runs(4, may_need_four, [&](const SampleRange &range) {
        four.clear(range);
        fill(four, range);
    });
    for (Block &tile : blocks) {
        if (tile.off > tile.tolerance)
            tile.per_pixel = 2;
        if (may_need_four(tile) && off(tile, four, guess_four) > tile.tolerance)
            tile.per_pixel = 4;
    }
    coefficients = {std::move(of_one.coefficients), std::move(of_two.coefficients),
                    std::move(LightSpline(std::move(four)).coefficients)};
}

void MiddleLight::find_tolerances(const SampledLight &light) {
    std::vector<std::pair<double, Block *>> by_distance;
    for (Block &tile : blocks) {
        double sum = 0, count = 0;
        on_samples(light, range_of(tile.x, tile.y, 1, light.per_pixel), never,
                   [&](int64_t x, int64_t y) {
                       const auto here = static_cast<double>(light.sample(x, y));
                       tile.brightest = std::max(tile.brightest, std::abs(here));
                       sum += here;
                       ++count;
                   });
        tile.light = sum / std::max(count, 1.0);
        by_distance.emplace_back(std::hypot(tile.x + wide / 2, tile.y + high / 2), &tile);
    }
    std::ranges::stable_sort(by_distance, std::ranges::greater(),
                             &std::pair<double, Block *>::first);
    double brightest = 0;
    for (const auto &[distance, tile] : by_distance) {
        brightest = std::max(brightest, tile->brightest);
        tile->tolerance = std::max(coarse * brightest, floor);
    }
}

namespace {

LightBlocks blocks_of(const MiddleLight &light) {
    std::vector<LightBlocks::Block> blocks;
    for (const MiddleLight::Block &tile : light.blocks)
        if (tile.brightest > light.floor)
            blocks.push_back({tile.x,
                              tile.y,
                              tile.per_pixel,
                              half_width(light.radius),
                              light.never,
                              {{0, tile.brightest,
                                &light.coefficients[static_cast<size_t>(tile.per_pixel / 2)]}}});
    return LightBlocks(std::move(blocks));
}

} // namespace

FarTable::FarTable(const MiddleLight &light) : radius_(light.radius), blocks_(blocks_of(light)) {
    for (const MiddleLight::Block &tile : light.blocks)
        if (tile.brightest > light.floor)
            shares_.push_back({tile.brightest, tile.light, tile.x, tile.y});
    std::ranges::stable_sort(shares_, std::ranges::greater(), &Share::brightest);
}

double FarTable::light(double within, double inner, double floor) const {
    // How much of a block's area is at most so far from the star.
    const auto part = [](const Share &of, double radius) {
        const auto along = [radius](int64_t first, int64_t size) {
            const double at = static_cast<double>(first) - 0.5,
                         end = at + static_cast<double>(size);
            return std::max(std::min(end, radius) - std::max(at, -radius), 0.0);
        };
        return along(of.x, wide) * along(of.y, high);
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

namespace {

// The places along x and y in the order of FarTables::places().
constexpr std::array<std::pair<int, int>, 9> order{
    {{1, 1}, {0, 1}, {2, 1}, {1, 0}, {1, 2}, {0, 0}, {2, 0}, {0, 2}, {2, 2}}};

// Light of the places by [j][i]; then the coefficients of polynomials.
using OfPlaces = std::array<std::array<std::optional<SampledLight>, 3>, 3>;

std::optional<SampledLight> &at_place(OfPlaces &all, size_t place) {
    const auto &[i, j] = order[place];
    return all[static_cast<size_t>(j)][static_cast<size_t>(i)];
}

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

void to_coefficients(OfPlaces &at) {
    for (auto &row : at)
        to_coefficients(*row[0], *row[1], *row[2]);
    for (size_t i = 0; i < at.size(); ++i)
        to_coefficients(*at[0][i], *at[1][i], *at[2][i]);
}

LightBlocks differences_of(std::span<const FarLight> at_places, const FarTables::Extent &extent,
                           const MiddleLight &middle) {
    const double radius = extent.differences_radius;
    std::vector<LightBlocks::Block> blocks;
    if (at_places.size() == 1 || radius <= at_places[0].nearest())
        return LightBlocks(std::move(blocks));
    // Of what is below a floor everywhere, differences are less.
    constexpr double less = 0.3;
    const auto fill = [&](size_t place, SampledLight &sampled, const SampleRange &range) {
        sampled.add(at_places[place], at_places[place].nearest(), extent.floor / less, range);
    };
    const auto reaches = [radius](const MiddleLight::Block &tile) {
        const auto along = [radius](int64_t at, int64_t size) {
            return static_cast<double>(at) - 0.5 <= radius &&
                   static_cast<double>(at + size) - 0.5 >= -radius;
        };
        return along(tile.x, wide) && along(tile.y, high);
    };
    OfPlaces one, two;
    for (size_t k = 0; k < order.size(); ++k) {
        auto &sampled = at_place(one, k);
        sampled.emplace(1, half_width(radius));
        fill(k, *sampled, sampled->all());
        at_place(two, k).emplace(LightSpline(*sampled).finer());
    }
    to_coefficients(one);
    OfPlaces guess = two;
    to_coefficients(guess);
    const auto brightest = [&](const SampledLight &light, const MiddleLight::Block &tile) {
        float most = 0;
        on_samples(
            light, range_of(tile.x, tile.y, 1, light.per_pixel), middle.never,
            [&](int64_t x, int64_t y) { most = std::max(most, std::abs(light.sample(x, y))); });
        return static_cast<double>(most);
    };
    // Splines of differences are off by about as much of them as those of light.
    const auto may_need_two = [&](const MiddleLight::Block &tile) {
        if (!reaches(tile) || tile.off <= tile.tolerance)
            return false;
        double most = 0;
        for (size_t k = 1; k < order.size(); ++k)
            most = std::max(most, brightest(*at_place(one, k), tile));
        return 2 * tile.off * most > tile.tolerance * tile.brightest;
    };
    middle.on_runs(2, may_need_two, [&](const SampleRange &range) {
        for (size_t k = 0; k < order.size(); ++k) {
            at_place(two, k)->clear(range);
            fill(k, *at_place(two, k), range);
        }
    });
    to_coefficients(two);
    std::vector<LightSpline> of_one, of_two;
    for (size_t k = 1; k < order.size(); ++k) {
        of_one.emplace_back(*at_place(one, k));
        of_two.emplace_back(*at_place(two, k));
    }
    for (const MiddleLight::Block &tile : middle.blocks) {
        if (!reaches(tile))
            continue;
        LightBlocks::Block of{tile.x, tile.y, 1, half_width(radius), middle.never, {}};
        double off = 0;
        for (size_t k = 1; k < order.size(); ++k)
            off = std::max(off, middle.off(tile, *at_place(two, k), *at_place(guess, k)));
        if (off > tile.tolerance)
            of.per_pixel = 2;
        for (size_t k = 1; k < order.size(); ++k) {
            const double most = brightest(*at_place(two, k), tile);
            if (most > extent.floor)
                of.parts.push_back(
                    {k - 1, most, &(of.per_pixel == 1 ? of_one : of_two)[k - 1].coefficients});
        }
        if (!of.parts.empty())
            blocks.push_back(std::move(of));
    }
    return LightBlocks(std::move(blocks));
}

} // namespace

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
    : FarTables(at_places, image, extent, MiddleLight(at_places[0], exact, extent)) {}

FarTables::FarTables(std::span<const FarLight> at_places, const Region &image, const Extent &extent,
                     const MiddleLight &middle)
    : image_(image), differences_radius_(extent.differences_radius), middle_(middle),
      differences_(differences_of(at_places, extent, middle)) {}

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
    std::array<double, order.size() - 1> weights{};
    for (size_t k = 0; k < weights.size(); ++k) {
        const auto &[i, j] = order[k + 1];
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
