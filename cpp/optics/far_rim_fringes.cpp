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
    for (size_t i = 0; i < colours.edges().size(); ++i)
        edges_.push_back(edge(colours, colours.edges()[i], joined[i]));
}

RimFringes::Edge RimFringes::edge(const EdgeColours &colours, const EdgeColours::Edge &of,
                                  const std::vector<End> &joined) const {
    Edge out{of};
    const auto &[nx, ny] = of.axes;
    for (size_t front = 0; front < rims_.points.size(); ++front) {
        const Oval &oval = rims_.points[front].oval;
        const auto [x, y] = rims_.points[front].position(nx, ny);
        if (std::ranges::any_of(joined, [&](const End &end) { // on the point's half of the oval
                return end.oval == oval &&
                       (x - oval.x) * (end.x - oval.x) + (y - oval.y) * (end.y - oval.y) > 0;
            }))
            continue;
        out.waves.push_back(colours.waves(of, x, y));
        for (const size_t side : {0, 1}) {
            // What is in front is behind on the star's other side.
            Pair pair{front ^ side, out.waves.size() - 1, {}};
            for (size_t j = 0; ring(rims_.nearest, j) < fringes_end; ++j)
                pair.most.push_back(most(out, pair, side, ring(rims_.nearest, j)));
            pair.most.push_back(0);
            for (size_t j = pair.most.size() - 1; j-- > 0;)
                pair.most[j] = std::max(pair.most[j], pair.most[j + 1]);
            out.pairs[side].push_back(std::move(pair));
        }
    }
    for (std::vector<Pair> &pairs : out.pairs) {
        double all = 0;
        for (const Pair &pair : pairs)
            all += pair.most[0];
        constexpr double faint = 0.01;
        std::erase_if(pairs, [&](const Pair &pair) { return pair.most[0] < faint * all; });
    }
    return out;
}

double RimFringes::most(const Edge &edge, const Pair &pair, size_t side, double r) const {
    const auto &[axes, x, y, length] = edge.edge;
    const double way = side == 0 ? 1 : -1, ux = way * axes.nx, uy = way * axes.ny;
    const RimPoint &point = rims_.points[pair.point];
    const auto place = RimTable::place(ux, uy, rims_.nearest / r);
    const auto width = static_cast<int>(reach_ / r * RimTable::directions / 4) + 1;
    double amplitude = 0;
    for (int i = -width; i <= width + 1; ++i)
        for (const int j : {place.column, place.column + 1}) {
            const size_t entry =
                RimTable::entry((place.row + i + RimTable::directions) % RimTable::directions, j);
            amplitude = std::max(amplitude, std::hypot(point.re[entry], point.im[entry]));
        }
    const double path = std::abs(way * axes.along(x, y) - point.place(ux, uy)) * r -
                        length * reach_; // to the spike's sides
    return scale_ * wfpsf::most(edge.waves[pair.waves]) * amplitude *
           visibility_->most(path * pixel_) / (r * r * std::sqrt(r * pixel_ / rims_.wavelength));
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

// The part of a run that is no farther along than `end`, on its side of the star.
Run nearer(const SpikeAxes &axes, const PixelRow &row, Run run, double end) {
    const double x = (end - axes.ny * row.y) / axes.nx - row.x; // where along = end
    if (axes.nx * end > 0)
        run.last = std::min(run.last, static_cast<int64_t>(std::floor(std::min(x, 1e9))));
    else if (axes.nx * end < 0)
        run.first = std::max(run.first, static_cast<int64_t>(std::ceil(std::max(x, -1e9))));
    return run;
}

} // namespace

double RimFringes::brightest(double r, const SpikeAxes &spike) const {
    const auto at =
        static_cast<size_t>(std::max(0.0, rings_per_octave * std::log2(r / rims_.nearest)));
    double sum = 0;
    for (const Edge &edge : edges_) {
        if (std::abs(edge.edge.axes.across(spike.nx, spike.ny)) > same_direction)
            continue;
        double most = 0;
        for (const std::vector<Pair> &pairs : edge.pairs) {
            double all = 0;
            for (const Pair &pair : pairs)
                all += pair.most[std::min(at, pair.most.size() - 1)];
            most = std::max(most, all);
        }
        sum += most;
    }
    return sum;
}

void RimFringes::add(const PixelRow &row, double floor) const {
    const auto end = [&](const Pair &pair) {
        const auto faint = std::ranges::find_if(pair.most, [&](double m) { return m <= floor; });
        return std::min(fringes_end,
                        ring(rims_.nearest, static_cast<size_t>(faint - pair.most.begin())));
    };
    for (const Edge &edge : edges_) {
        const SpikeAxes &axes = edge.edge.axes;
        for (const Run &run : runs_along(axes, row, reach_, rims_.nearest, fringes_end)) {
            const auto middle = static_cast<double>(run.first + run.last) / 2;
            const bool behind = axes.along(row.x + middle, row.y) < 0;
            for (const Pair &pair : edge.pairs[behind ? 1 : 0]) {
                const Run lit = nearer(axes, row, run, behind ? -end(pair) : end(pair));
                if (lit.first > lit.last)
                    continue;
                const PixelRow part = row.part(lit.first, lit.last);
                add_pair({edge.edge, edge.waves[pair.waves].data() + 1, rims_.points[pair.point],
                          visibility_->table(), visibility_->per_path(), visibility_->longest(),
                          visibility_->middle(), rims_.wavelength, pixel_,
                          scale_ / std::sqrt(pixel_ / rims_.wavelength), rims_.nearest, reach_,
                          per_across_},
                         part.x, part.y, part.light.size(), part.light.data());
            }
        }
    }
}

} // namespace wfpsf
