// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_edge_fringes.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double farthest = 8192; // native pixels

// Rings by distance, native pixels.
constexpr double rings_per_octave = 4;
double ring(size_t j) {
    return std::exp2(static_cast<double>(j) / rings_per_octave);
}
size_t ring_of(double r) {
    return static_cast<size_t>(rings_per_octave * std::log2(r));
}

} // namespace

EdgeFringes::EdgeFringes(const FarSource &source, const PupilEdges &edges,
                         const EdgeColours &colours, std::shared_ptr<const Visibility> visibility,
                         const std::vector<Fringes> &tables)
    : visibility_(std::move(visibility)), pixel_(source.pixel()),
      scale_(1 / (2 * std::numbers::pi * std::numbers::pi * source.area())),
      per_across_(colours.per_across()) {
    const double mean = 1 / source.mean_wavelength();
    const auto meet = [joined = junctions(edges)](size_t a, size_t b) {
        return std::ranges::any_of(joined, [&](const Junction &junction) {
            return goes_on(junction) && junction.end.edge == a && junction.other.edge == b;
        });
    };
    for (const Fringes &table : tables) {
        if (!(table.end() < farthest))
            continue;
        const auto [nx, ny] = table.axes();
        Group group{table.axes(), table.end(), table.end(), 0,
                    std::sqrt(colours.variance(-ny, nx))};
        for (size_t i = 0; i < colours.edges().size(); ++i) {
            const EdgeColours::Edge &edge = colours.edges()[i];
            if (std::ranges::count(table.members(), edge.straight) == 0)
                continue;
            // The visibility holds a root of the wavelength that two edges do not have.
            std::vector<ColourWaves> waves = colours.waves(i);
            for (ColourWaves &wave : waves)
                for (size_t m = 0; m < far_colours; ++m) {
                    const double scale = std::pow(visibility_->wavenumbers()[m] / mean, 0.25);
                    wave.re[m] *= scale;
                    wave.im[m] *= scale;
                }
            group.members.emplace_back(colours, i, std::move(waves));
            for (size_t other = 0; other + 1 < group.members.size(); ++other) {
                const EdgeColours::Edge &with = group.members[other].edge;
                if (with.straight == edge.straight)
                    continue;
                const bool wide = meet(edge.straight, with.straight);
                Pair pair{other, group.members.size() - 1, wide ? with.reach : with.usual,
                          wide ? edge.reach : edge.usual};
                pair.end = end_of(group, pair);
                group.end = std::max(group.end, pair.end);
                const auto widen = [&](const EdgeColours::Edge &of, double reach) {
                    const double turned = std::abs(group.axes.across(of.axes.nx, of.axes.ny));
                    group.reach = std::max(group.reach, reach + turned * pair.end);
                };
                widen(with, pair.first_reach);
                widen(edge, pair.second_reach);
                group.pairs.push_back(std::move(pair));
            }
        }
        for (Pair &pair : group.pairs) {
            for (size_t j = 0; ring(j) < pair.end; ++j)
                pair.most.push_back(most(group, pair, std::max(group.begin, ring(j))));
            pair.most.push_back(0);
            for (size_t j = pair.most.size() - 1; j-- > 0;)
                pair.most[j] = std::max(pair.most[j], pair.most[j + 1]);
        }
        groups_.push_back(std::move(group));
    }
}

EdgeFringes::Member::Member(const EdgeColours &colours, size_t i, std::vector<ColourWaves> all)
    : edge(colours.edges()[i]), waves(std::move(all)) {
    const auto half = static_cast<int64_t>(2 * edge.reach);
    for (int64_t k = -half; k <= half; ++k) {
        const double across = static_cast<double>(k) / 2;
        const auto at =
            static_cast<size_t>(std::lround((across + edge.reach) * colours.per_across())) + 2;
        amplitude_.push_back(within(across / edge.reach) * wfpsf::most({&waves[at], 1}));
    }
    outwards_.assign(static_cast<size_t>(half) + 1, 0);
    for (int64_t k = half; k >= 0; --k) {
        const double here = std::max(amplitude_[static_cast<size_t>(half - k)],
                                     amplitude_[static_cast<size_t>(half + k)]);
        outwards_[static_cast<size_t>(k)] =
            std::max(here, k < half ? outwards_[static_cast<size_t>(k) + 1] : 0);
    }
}

double EdgeFringes::Member::amplitude(double across) const {
    const int64_t at = std::lround(2 * across) + static_cast<int64_t>(outwards_.size()) - 1;
    return at >= 0 && at < std::ssize(amplitude_) ? amplitude_[static_cast<size_t>(at)] : 0;
}

double EdgeFringes::Member::reach(double share) const {
    const double least = share * outwards_[0];
    const auto faint =
        std::ranges::partition_point(outwards_, [&](double light) { return light > least; });
    return std::min(static_cast<double>(faint - outwards_.begin()) / 2, edge.reach);
}

double EdgeFringes::Pair::end_above(double floor) const {
    const auto faint =
        std::ranges::partition_point(most, [&](double light) { return light > floor; });
    return std::min(end, ring(static_cast<size_t>(faint - most.begin())));
}

// Where the fringes of two edges are faint, or their light is apart.
double EdgeFringes::end_of(const Group &group, const Pair &pair) const {
    const EdgeColours::Edge &a = group.members[pair.first].edge,
                            &b = group.members[pair.second].edge;
    constexpr double faint = 4e-3; // as a share of the edges' own light
    const double path = pixel_ * std::abs(group.axes.along(a.x - b.x, a.y - b.y));
    const double turned = std::abs(a.axes.across(b.axes.nx, b.axes.ny));
    const double last = std::min({farthest, visibility_->longest_path() / path,
                                  (pair.first_reach + pair.second_reach) / turned});
    double end = group.begin;
    while (end < last && visibility_->most(path * end) > faint)
        end *= 1.1;
    return std::min(end, last);
}

// Without regard to phases.
double EdgeFringes::most(const Group &group, const Pair &pair, double r) const {
    const Member &a = group.members[pair.first], &b = group.members[pair.second];
    double most = 0;
    const auto half = static_cast<int>(2 * pair.first_reach);
    for (const double side : {-1.0, 1.0})
        for (int k = -half; k <= half; ++k) {
            const double aside = k / 2.0;
            const double x = side * a.edge.axes.nx * r - a.edge.axes.ny * aside;
            const double y = side * a.edge.axes.ny * r + a.edge.axes.nx * aside;
            const double across = b.edge.axes.across(x, y);
            const double path =
                std::abs((a.edge.x - b.edge.x) * x + (a.edge.y - b.edge.y) * y) -
                (a.edge.length * std::abs(aside) + b.edge.length * std::abs(across)) / 2;
            most = std::max(most, a.amplitude(aside) * b.amplitude(across) *
                                      visibility_->most(path * pixel_));
        }
    return scale_ * most / (r * r);
}

namespace {

struct PairTable {
    const EdgeColours::Edge &a, &b;
    double reach_a, reach_b;
    const ColourWaves *waves_a, *waves_b; // one step before the position -reach
    const ColourWaves *visibility;
    double per_path, longest, middle;
    double pixel, scale, per_across;
};

WFPSF_VECTORISED void add_pair(const PairTable &pair, double weight, double x0, double y, size_t n,
                               double *light) {
    const EdgeColours::Edge &a = pair.a, &b = pair.b;
    const double last_a = 2 * a.reach * pair.per_across, last_b = 2 * b.reach * pair.per_across;
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i), r2 = x * x + y * y;
        const double across_a = a.axes.across(x, y), across_b = b.axes.across(x, y);
        const double path = pair.pixel * ((a.x - b.x) * x + (a.y - b.y) * y);
        const double entry = std::min(std::abs(path) * pair.per_path, pair.longest);
        const double column_a = std::clamp((across_a + a.reach) * pair.per_across, 0.0, last_a);
        const double column_b = std::clamp((across_b + b.reach) * pair.per_across, 0.0, last_b);
        const auto cell = static_cast<int32_t>(entry);
        const auto left_a = static_cast<int32_t>(column_a), left_b = static_cast<int32_t>(column_b);
        const CubicWeights of_path(entry - cell), of_a(column_a - left_a), of_b(column_b - left_b);
        const double sign = path < 0 ? -1 : 1;
        double sum_re = 0, sum_im = 0;
        for (size_t m = 0; m < far_colours; ++m) {
            double v_re, v_im, a_re, a_im, b_re, b_im;
            of_path.read(pair.visibility + cell, m, v_re, v_im);
            of_a.read(pair.waves_a + left_a, m, a_re, a_im);
            of_b.read(pair.waves_b + left_b, m, b_re, b_im);
            v_im *= sign;
            const double re = a_re * b_re + a_im * b_im, im = a_im * b_re - a_re * b_im;
            sum_re += v_re * re - v_im * im;
            sum_im += v_re * im + v_im * re;
        }
        double cosine, sine;
        phasor(path * pair.middle, cosine, sine);
        light[i] += weight * pair.scale * a.axes.along(x, y) * b.axes.along(x, y) / (r2 * r2) *
                    within(across_a / pair.reach_a) * within(across_b / pair.reach_b) *
                    (sum_re * cosine - sum_im * sine);
    }
}

} // namespace

double EdgeFringes::brightest(double r, const SpikeAxes &spike) const {
    double sum = 0;
    for (const Group &group : groups_)
        if (std::abs(group.axes.across(spike.nx, spike.ny)) < same_direction)
            for (const Pair &pair : group.pairs)
                sum += pair.most[std::min(ring_of(r), pair.most.size() - 1)];
    return sum;
}

void EdgeFringes::add(const PixelRow &row, double floor) const {
    for (const Group &group : groups_)
        for (const Run &run : runs_along(group.axes, row, group.reach, group.begin, group.end)) {
            const auto at = [&](int64_t pixel) {
                return group.axes.along(row.x + static_cast<double>(pixel), row.y);
            };
            const double nearest = std::min(std::abs(at(run.first)), std::abs(at(run.last)));
            for (const Pair &pair : group.pairs) {
                const double end = pair.end_above(floor);
                if (nearest >= end)
                    continue;
                const Member &a = group.members[pair.first], &b = group.members[pair.second];
                const double share = floor / pair.most[ring_of(nearest)];
                const auto near = [&](Run of, const Member &member, double farthest_across) {
                    const SpikeAxes &axes = member.edge.axes;
                    const double reach = std::min(member.reach(share), farthest_across);
                    return between(of, axes.across(row.x, row.y), -axes.ny, -reach, reach);
                };
                const Run seen =
                    between(run, group.axes.along(row.x, row.y), group.axes.nx, -end, end);
                const Run both = near(near(seen, a, pair.first_reach), b, pair.second_reach);
                if (both.first > both.last)
                    continue;
                const PixelRow::Part part = row.part(both);
                for (const int sample : {-1, 1}) {
                    const double aside = sample * group.aside;
                    add_pair({a.edge, b.edge, pair.first_reach, pair.second_reach,
                              a.waves.data() + 1, b.waves.data() + 1, visibility_->table(),
                              visibility_->per_path(), visibility_->longest(),
                              visibility_->middle(), pixel_, scale_, per_across_},
                             0.5, part.x - aside * group.axes.ny, part.y + aside * group.axes.nx,
                             part.light.size(), part.light.data());
                }
            }
        }
}

} // namespace wfpsf
