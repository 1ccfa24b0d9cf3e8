// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_rim_fringes.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"

#include <algorithm>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// By distance, native pixels.
constexpr double rings_per_octave = 4;
double ring(double nearest, size_t j) {
    return nearest * std::exp2(static_cast<double>(j) / rings_per_octave);
}

} // namespace

// ---------------------------------------------------------------------------------- making of them

RimFringes::RimFringes(const FarSource &source, const PupilEdges &edges, const EdgeColours &colours,
                       std::shared_ptr<const Visibility> visibility,
                       const std::vector<Fringes> &tables, RimPoints rims)
    : rims_(std::move(rims)), visibility_(std::move(visibility)), pixel_(source.pixel()),
      scale_(1 / (2 * pi * pi * source.area())), reach_(colours.reach()),
      per_across_(colours.per_across()) {
    std::vector<std::vector<End>> joined(edges.straight.size());
    for (const Junction &junction : junctions(edges)) {
        if (!(junction.kink < widest_kink))
            continue;
        const auto &[from_x, from_y, to_x, to_y] = edges.straight[junction.straight];
        const End end{edges.curved[junction.curved].oval, junction.at_to ? to_x : from_x,
                      junction.at_to ? to_y : from_y};
        for (const Fringes &table : tables)
            if (std::ranges::count(table.members(), junction.straight) > 0)
                for (const size_t member : table.members())
                    joined[member].push_back(end);
    }
    for (size_t i = 0; i < colours.edges().size(); ++i) {
        const EdgeColours::Edge &of = colours.edges()[i];
        Edge edge{of, pairs(colours, of, joined[i]), {}};
        for (size_t j = 0; ring(rims_.nearest, j) < fringes_end; ++j)
            edge.most.push_back(most(edge, ring(rims_.nearest, j)));
        edge.most.push_back(0);
        for (size_t j = edge.most.size() - 1; j-- > 0;)
            edge.most[j] = std::max(edge.most[j], edge.most[j + 1]);
        edges_.push_back(std::move(edge));
    }
}

// Whether a point sends light in about that direction.
bool RimFringes::lit(const RimPoint &point, double nx, double ny) const {
    constexpr double per_radian = RimTable::directions / (2 * pi), faint = 1e-3;
    const auto middle = static_cast<int>(diamond(nx, ny) * RimTable::directions / 4);
    const auto half = static_cast<int>(1.5 * per_radian * std::min(1.0, reach_ / rims_.nearest));
    for (int i = -half; i <= half; ++i) {
        const int row = (middle + i + RimTable::directions) % RimTable::directions;
        for (int j = 1; j <= RimTable::distances; ++j) {
            const size_t entry = RimTable::entry(row, j);
            if (std::abs(point.re[entry]) + std::abs(point.im[entry]) > faint * point.most)
                return true;
        }
    }
    return false;
}

std::vector<RimFringes::Pair> RimFringes::pairs(const EdgeColours &colours,
                                                const EdgeColours::Edge &edge,
                                                const std::vector<End> &joined) const {
    std::vector<Pair> out;
    const auto &[nx, ny] = edge.axes;
    for (size_t front = 0; front < rims_.points.size(); ++front) {
        const size_t behind = front ^ 1U;
        const RimPoint &point = rims_.points[front];
        const std::array<bool, 2> seen{lit(point, nx, ny), lit(rims_.points[behind], -nx, -ny)};
        if (!seen[0] && !seen[1])
            continue;
        const auto [x, y] = point.position(nx, ny);
        const Oval &oval = point.oval;
        if (std::ranges::any_of(joined, [&](const End &end) { // on the point's half of the oval
                return end.oval == oval &&
                       (x - oval.x) * (end.x - oval.x) + (y - oval.y) * (end.y - oval.y) > 0;
            }))
            continue;
        out.push_back({{front, behind}, seen, colours.waves(edge, x, y)});
    }
    return out;
}

double RimFringes::most(const Edge &edge, double r) const {
    const auto &[axes, x, y, length] = edge.edge;
    const double differs = length * reach_ * pixel_; // path, between the spike's line and its sides
    double most = 0;
    for (const size_t side : {0, 1}) {
        const double way = side == 0 ? 1 : -1;
        double sum = 0;
        for (const Pair &pair : edge.pairs) {
            if (!pair.lit[side])
                continue;
            const RimPoint &point = rims_.points[pair.point[side]];
            const double apart = way * axes.along(x, y) - point.place(way * axes.nx, way * axes.ny);
            sum += wfpsf::most(pair.waves) * point.most *
                   visibility_->most(std::abs(apart) * r * pixel_ - differs);
        }
        most = std::max(most, sum);
    }
    return most * scale_ / (r * r * std::sqrt(r * pixel_ / rims_.wavelength));
}

// ----------------------------------------------------------------------------------------- drawing

namespace {

struct PairTable {
    const EdgeColours::Edge &edge;
    const ColourWaves *waves; // one step before the position -reach
    const RimPoint &point;
    const ColourWaves *visibility;
    double per_path, longest, middle;
    double wavelength, pixel, scale, nearest, reach, per_across;
};

WFPSF_VECTORISED void add_pair(const PairTable &pair, double x0, double y, size_t n,
                               double *light) {
    const auto [nx, ny] = pair.edge.axes;
    const double *re = pair.point.re.data(), *im = pair.point.im.data();
    const double *waves = pair.point.waves.data();
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i);
        const double along = nx * x + ny * y, across = nx * y - ny * x;
        const double r2 = x * x + y * y, r = std::sqrt(r2);
        const auto place = RimTable::place(x, y, pair.nearest / r);
        const double wave = waves[place.row] + place.s * (waves[place.row + 1] - waves[place.row]);
        const double path =
            pair.pixel * (pair.edge.x * x + pair.edge.y * y - pair.point.place(x, y)) -
            wave * pair.wavelength;
        const double entry = std::min(std::abs(path) * pair.per_path, pair.longest);
        const double column = (across + pair.reach) * pair.per_across;
        const auto cell = static_cast<int32_t>(entry), left = static_cast<int32_t>(column);
        const CubicWeights of_path(entry - cell), of_edge(column - left);
        const double sign = path < 0 ? -1 : 1;
        double sum_re = 0, sum_im = 0;
        for (size_t m = 0; m < far_colours; ++m) {
            double v_re, v_im, e_re, e_im;
            of_path.read(pair.visibility + cell, m, v_re, v_im);
            of_edge.read(pair.waves + left, m, e_re, e_im);
            v_im *= sign;
            sum_re += v_re * e_re - v_im * e_im;
            sum_im += v_re * e_im + v_im * e_re;
        }
        double cosine, sine;
        phasor(path * pair.middle, cosine, sine);
        light[i] += pair.scale * along / (r2 * r * std::sqrt(r)) * within(across / pair.reach) *
                    ((sum_re * cosine - sum_im * sine) * place.of(re) +
                     (sum_re * sine + sum_im * cosine) * place.of(im));
    }
}

} // namespace

double RimFringes::brightest(double r, const SpikeAxes &spike) const {
    const auto at =
        static_cast<size_t>(std::max(0.0, rings_per_octave * std::log2(r / rims_.nearest)));
    double sum = 0;
    for (const Edge &edge : edges_)
        if (std::abs(edge.edge.axes.across(spike.nx, spike.ny)) < same_direction)
            sum += edge.most[std::min(at, edge.most.size() - 1)];
    return sum;
}

void RimFringes::add(const PixelRow &row, double floor) const {
    for (const Edge &edge : edges_) {
        const SpikeAxes &axes = edge.edge.axes;
        const auto below = std::ranges::find_if(edge.most, [&](double m) { return m <= floor; });
        const double end = std::min(
            fringes_end, ring(rims_.nearest, static_cast<size_t>(below - edge.most.begin())));
        for (const Run &run : runs_along(axes, row, reach_, rims_.nearest, end)) {
            const PixelRow part = row.part(run.first, run.last);
            const double middle = part.x + static_cast<double>(part.light.size() - 1) / 2;
            const size_t side = axes.along(middle, part.y) < 0 ? 1 : 0;
            for (const Pair &pair : edge.pairs)
                if (pair.lit[side])
                    add_pair({edge.edge, pair.waves.data() + 1, rims_.points[pair.point[side]],
                              visibility_->table(), visibility_->per_path(), visibility_->longest(),
                              visibility_->middle(), rims_.wavelength, pixel_,
                              scale_ / std::sqrt(pixel_ / rims_.wavelength), rims_.nearest, reach_,
                              per_across_},
                             part.x, part.y, part.light.size(), part.light.data());
        }
    }
}

} // namespace wfpsf
