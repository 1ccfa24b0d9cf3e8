// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/middle_light.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wfpsf {

namespace {

constexpr int64_t wide = LightBlocks::wide, high = LightBlocks::high;

// Splines may be off by that share of the brightest pixel as far from the star. Those of twice as
// many samples are better by `better`, or more.
constexpr double coarse = 1e-4, better = 8;

constexpr int64_t beside = 4; // native pixels beyond a block that its coefficients follow from

// Those that pixels x.., y.. from the star's may fall on, wherever in its pixel the star stands.
SampleRange samples_of(int64_t x, int64_t y, int64_t nx, int64_t ny, int64_t per_pixel) {
    const int64_t half = per_pixel / 2;
    return {x * per_pixel - half, y * per_pixel - half, (nx - 1) * per_pixel + 2 * half + 1,
            (ny - 1) * per_pixel + 2 * half + 1};
}

} // namespace

SampleRange MiddleLight::Block::samples(int64_t n, int64_t count) const {
    return samples_of(x, y, count * wide, high, n);
}

bool MiddleLight::Block::reaches_within(double r) const {
    const auto along = [r](int64_t first, int64_t size) {
        return static_cast<double>(first) - 0.5 <= r &&
               static_cast<double>(first + size) - 0.5 >= -r;
    };
    return along(x, wide) && along(y, high);
}

int64_t MiddleLight::Block::half_width() const {
    return std::max({-x, x + wide, -y, y + high}) + beside;
}

int64_t half_width(double radius) {
    return static_cast<int64_t>(std::ceil(radius)) + std::max(wide, high) + beside;
}

MiddleLight::MiddleLight(const FarLight &light, const Psf *exact, double to, double least,
                         int threads)
    : inner(light.nearest() + 1), radius(to), floor(least) {
    const auto first = [this](int64_t size) {
        return -static_cast<int64_t>(std::ceil(radius / static_cast<double>(size))) * size;
    };
    const auto reaches = [this](int64_t at) { return static_cast<double>(at) - 0.5 <= radius; };
    const auto is_near = [this](int64_t at, int64_t size) {
        return static_cast<double>(-at) + 0.5 <= inner &&
               static_cast<double>(at + size) - 0.5 <= inner;
    };
    for (int64_t y = first(high); reaches(y); y += high)
        for (int64_t x = first(wide); reaches(x); x += wide)
            if (!is_near(x, wide) || !is_near(y, high))
                blocks.push_back({x, y});
    using Which = SampledLight::Which;
    const auto fill = [&](SampledLight &sampled, const SampleRange &range, Which which) {
        if (exact)
            sampled.add(*exact, range);
        sampled.add(light, exact ? exact->settings().radius : light.nearest(), floor, range, which,
                    threads);
    };
    SampledLight two(2, wfpsf::half_width(radius));
    fill(two, two.all(), Which::all);
    find_tolerances(two);
    const LightSpline &of_one = splines.emplace_back(two.coarser());
    SampledLight off_two = of_one.finer(two.half);
    off_two.subtract(two);
    for (Block &of : blocks) {
        of.off = off_two.largest(of.samples(2), inner);
        if (of.off > of.tolerance)
            of.per_pixel = 2;
    }
    const LightSpline &of_two = splines.emplace_back(two);
    const auto may_need_four = [](const Block &of) { return of.off > better * of.tolerance; };
    SampledLight four = of_two.finer(half_width(may_need_four));
    SampledLight off_four = four;
    on_runs(4, may_need_four, [&](const SampleRange &range) {
        four.clear(range);
        fill(four, range, Which::between);
        four.take(two, range);
    });
    off_four.subtract(four);
    for (Block &of : blocks)
        if (may_need_four(of) && off_four.largest(of.samples(4), inner) > of.tolerance)
            of.per_pixel = 4;
    splines.emplace_back(std::move(four));
}

void MiddleLight::find_tolerances(const SampledLight &light) {
    std::vector<std::pair<double, Block *>> by_distance;
    for (Block &of : blocks) {
        for (int64_t y = of.y; y < of.y + high; y += Cell::size)
            for (int64_t x = of.x; x < of.x + wide; x += Cell::size) {
                double sum = 0, count = 0;
                light.on(samples_of(x, y, Cell::size, Cell::size, light.per_pixel), inner,
                         [&](float here) {
                             sum += static_cast<double>(here);
                             ++count;
                         });
                of.cells.push_back({x, y, sum / std::max(count, 1.0)});
            }
        of.brightest = light.largest(of.samples(light.per_pixel), inner);
        by_distance.emplace_back(std::hypot(of.x + wide / 2, of.y + high / 2), &of);
    }
    std::ranges::stable_sort(by_distance, std::ranges::greater(),
                             &std::pair<double, Block *>::first);
    double brightest = 0;
    for (const auto &[distance, of] : by_distance) {
        brightest = std::max(brightest, of->brightest);
        of->tolerance = std::max(coarse * brightest, floor);
    }
}

} // namespace wfpsf
