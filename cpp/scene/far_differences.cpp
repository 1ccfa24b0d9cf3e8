// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/far_differences.hpp"

#include "numerics/bands.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace wfpsf {

namespace {

constexpr size_t places = order_of_places.size();

// Of what is below a floor everywhere, differences are less. They may be off by more than the
// light itself, as the polynomial is.
constexpr double less = 0.3, coarser = 4;

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

// From the light of all places to coefficients.
void to_coefficients(std::vector<SampledLight> &light) {
    const auto at = [&light](int i, int j) -> SampledLight & {
        const auto place = std::ranges::find(order_of_places, std::pair(i, j));
        return light[static_cast<size_t>(place - order_of_places.begin())];
    };
    for (const int j : {0, 1, 2})
        to_coefficients(at(0, j), at(1, j), at(2, j));
    for (const int i : {0, 1, 2})
        to_coefficients(at(i, 0), at(i, 1), at(i, 2));
}

} // namespace

LightBlocks far_differences(std::span<const FarLight> at_places, const MiddleLight &middle,
                            double radius, double floor, int threads) {
    if (at_places.size() == 1 || radius <= middle.inner)
        return LightBlocks();
    using Which = SampledLight::Which;
    const auto fill = [&](size_t place, SampledLight &to, const SampleRange &range, Which which) {
        to.add(at_places[place], at_places[place].nearest(), floor / less, range, which);
    };
    const auto at_each = [threads](const auto &work) {
        share_out(std::ssize(order_of_places), threads,
                  [&](int64_t k) { work(static_cast<size_t>(k)); });
    };
    std::vector<SampledLight> one(places, SampledLight(1, half_width(radius)));
    at_each([&](size_t k) { fill(k, one[k], one[k].all(), Which::all); });
    to_coefficients(one);
    std::vector<LightSpline> of_one(one.begin() + 1, one.end());
    // Splines of differences are off by about as much of them as those of light.
    const auto may_need_two = [&](const MiddleLight::Block &of) {
        if (!of.reaches_within(radius) || of.per_pixel == 1)
            return false;
        double most = 0;
        for (size_t k = 1; k < places; ++k)
            most = std::max(most, one[k].largest(of.samples(1), middle.inner));
        return 2 * of.off * most > coarser * of.tolerance * of.brightest;
    };
    const int64_t half = middle.half_width(may_need_two);
    std::vector<SampledLight> two(places, SampledLight(2, half));
    at_each([&](size_t k) {
        middle.on_runs(2, may_need_two, [&](const SampleRange &range) {
            two[k].clear(range); // runs may share their borders
            fill(k, two[k], range, Which::between);
        });
    });
    to_coefficients(two);
    std::vector<SampledLight> off;
    std::vector<LightSpline> of_two;
    for (size_t k = 1; k < places; ++k) {
        SampledLight &finer = off.emplace_back(of_one[k - 1].finer(half));
        SampledLight all = finer;
        middle.on_runs(2, may_need_two, [&](const SampleRange &range) {
            all.copy(two[k], range);
            all.take(one[k], range);
        });
        finer.subtract(all);
        of_two.emplace_back(std::move(all));
    }
    std::vector<LightBlocks::Block> blocks;
    for (const MiddleLight::Block &of : middle.blocks) {
        if (!of.reaches_within(radius))
            continue;
        const bool needs_two =
            may_need_two(of) && std::ranges::any_of(off, [&](const auto &by) {
                return by.largest(of.samples(2), middle.inner) > coarser * of.tolerance;
            });
        LightBlocks::Block block_of{of.x, of.y, middle.inner, {}};
        for (size_t k = 1; k < places; ++k) {
            const double most = one[k].largest(of.samples(1), middle.inner);
            if (most > floor)
                block_of.parts.push_back({k - 1, most, &(needs_two ? of_two : of_one)[k - 1]});
        }
        if (!block_of.parts.empty())
            blocks.push_back(std::move(block_of));
    }
    return LightBlocks(std::move(blocks));
}

} // namespace wfpsf
