// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_point_fringes.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"

#include <algorithm>
#include <numbers>
#include <span>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// By distance, native pixels.
constexpr double rings_per_octave = 4;
double ring(double nearest, size_t j) {
    return nearest * std::exp2(static_cast<double>(j) / rings_per_octave);
}

// What is in front is behind on the star's other side.
size_t seen_from(size_t point, size_t side, const RimPoint &) {
    return point ^ side;
}
size_t seen_from(size_t point, size_t, const Corner &) {
    return point;
}

} // namespace

// ---------------------------------------------------------------------------------- making of them

template <class Point>
PointFringes<Point>::PointFringes(const FarSource &source, const EdgeColours &colours,
                                  std::shared_ptr<const Visibility> visibility,
                                  std::vector<Point> points, const Known &known, const Halo &halo)
    : points_(std::move(points)), visibility_(std::move(visibility)), nearest_(source.nearest),
      wavelength_(source.mean_wavelength()), pixel_(source.pixel()),
      scale_(1 / (2 * pi * pi * source.area())), per_across_(colours.per_across()) {
    for (size_t j = 0; ring(nearest_, j) < fringes_end; ++j)
        rings_.push_back(ring(nearest_, j));
    rings_.push_back(fringes_end);
    for (size_t i = 0; i < colours.edges().size(); ++i)
        edges_.push_back(edge(colours, i, known, halo));
}

template <class Point>
typename PointFringes<Point>::Edge PointFringes<Point>::edge(const EdgeColours &colours, size_t i,
                                                             const Known &known,
                                                             const Halo &halo) const {
    constexpr double faint = 4e-3; // as a share of the edge's own light
    Edge out{colours.edges()[i]};
    const auto &[nx, ny] = out.edge.axes;
    for (size_t p = 0; p < points_.size(); ++p) {
        if (known(out.edge.straight, points_[p]))
            continue;
        const auto [x, y] = points_[p].position(nx, ny);
        std::vector<ColourWaves> waves = colours.waves(i, x, y);
        const double brightest = wfpsf::most(waves);
        bool is_seen = false;
        for (const size_t side : {0, 1}) {
            Pair pair{seen_from(p, side, points_[p]), out.waves.size(), {}};
            for (const double r : std::span(rings_).first(rings_.size() - 1)) {
                const double here = brightest * most(out.edge, pair.point, side, r);
                const double own = scale_ / 2 * std::pow(out.edge.length / r, 2);
                pair.most.push_back(here < faint * own + lost_in_halo * halo.brightest(r) ? 0
                                                                                          : here);
            }
            pair.most.push_back(0);
            for (size_t j = pair.most.size() - 1; j-- > 0;)
                pair.most[j] = std::max(pair.most[j], pair.most[j + 1]);
            if (pair.most[0] > 0) {
                out.pairs[side].push_back(std::move(pair));
                is_seen = true;
            }
        }
        if (is_seen)
            out.waves.push_back(std::move(waves));
    }
    return out;
}

template <class Point>
double PointFringes<Point>::most(const EdgeColours::Edge &edge, size_t p, size_t side,
                                 double r) const {
    const double way = side == 0 ? 1 : -1, ux = way * edge.axes.nx, uy = way * edge.axes.ny;
    const Point &point = points_[p];
    const double path = std::abs(way * edge.axes.along(edge.x, edge.y) - point.place(ux, uy)) * r -
                        edge.length * edge.reach; // to the spike's sides
    return scale_ * point.most(ux, uy, r, edge.reach) * visibility_->most(path * pixel_) /
           (r * r * std::sqrt(r * pixel_ / wavelength_));
}

// ----------------------------------------------------------------------------------------- drawing

namespace {

template <class Point> struct PairTable {
    const EdgeColours::Edge &edge;
    const ColourWaves *waves; // one step before the position -reach
    const Point &point;
    const ColourWaves *visibility;
    double per_path, longest, middle;
    double wavelength, pixel, scale, per_across;
};

template <class Point>
WFPSF_VECTORISED void add_pair(const PairTable<Point> &pair, double x0, double y, size_t n,
                               double *light) {
    for (size_t first = 0; first < n; first += PixelBlock::most) {
        const size_t count = std::min(PixelBlock::most, n - first);
        PixelBlock at; // beyond the row its last pixel again
        at.size = (count + PixelBlock::lanes - 1) / PixelBlock::lanes * PixelBlock::lanes;
        for (size_t i = 0; i < at.size; ++i) {
            at.x[i] = x0 + static_cast<double>(first + std::min(i, count - 1));
            at.y[i] = y;
            at.r[i] = std::sqrt(at.x[i] * at.x[i] + y * y);
        }
        AmplitudeBlock sent;
        pair.point.amplitudes(at, sent);
        const auto [nx, ny] = pair.edge.axes;
        PixelBlock::Values entry, column, re, im, side; // side: the sign of the path
        for (size_t i = 0; i < at.size; ++i) {
            const double x = at.x[i], r = at.r[i];
            const double along = nx * x + ny * y, across = nx * y - ny * x;
            const double path =
                pair.pixel * (pair.edge.x * x + pair.edge.y * y - pair.point.place(x, y)) -
                sent.waves[i] * pair.wavelength;
            entry[i] = std::min(std::abs(path) * pair.per_path, pair.longest);
            column[i] = (across + pair.edge.reach) * pair.per_across;
            side[i] = std::copysign(1.0, path);
            double cosine, sine;
            phasor(path * pair.middle, cosine, sine);
            const double factor =
                pair.scale * along / (r * r * r * std::sqrt(r)) * within(across / pair.edge.reach);
            re[i] = factor * (sent.re[i] * cosine + sent.im[i] * sine);
            im[i] = factor * (sent.im[i] * cosine - sent.re[i] * sine);
        }
        for (size_t i = 0; i < count; ++i) {
            const auto cell = static_cast<int32_t>(entry[i]),
                       left = static_cast<int32_t>(column[i]);
            const CubicWeights of_path(entry[i] - cell), of_edge(column[i] - left);
            std::array<double, far_colours> sum;
            for (size_t m = 0; m < far_colours; ++m) {
                double v_re, v_im, e_re, e_im;
                of_path.read(pair.visibility + cell, m, v_re, v_im);
                of_edge.read(pair.waves + left, m, e_re, e_im);
                sum[m] = v_re * (e_re * re[i] + e_im * im[i]) +
                         side[i] * v_im * (e_re * im[i] - e_im * re[i]);
            }
            light[first + i] += total(sum);
        }
    }
}

} // namespace

template <class Point>
double PointFringes<Point>::brightest(double r, const SpikeAxes &spike) const {
    const auto at = static_cast<size_t>(std::max(0.0, rings_per_octave * std::log2(r / nearest_)));
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

template <class Point> void PointFringes<Point>::add(const PixelRow &row, double floor) const {
    for (const Edge &edge : edges_) {
        const SpikeAxes &axes = edge.edge.axes;
        // Aside of the spike what is nearer along its line may be far enough from the star.
        constexpr double nearer = 0.75;
        for (const Run &run :
             runs_along(axes, row, edge.edge.reach, nearer * nearest_, fringes_end)) {
            const double here = axes.along(row.x, row.y);
            const double first = here + axes.nx * static_cast<double>(run.first);
            const double last = here + axes.nx * static_cast<double>(run.last);
            const auto [low, high] = std::minmax({std::abs(first), std::abs(last)});
            for (const Pair &pair : edge.pairs[first + last < 0 ? 1 : 0]) {
                const auto faint =
                    std::ranges::find_if(pair.most, [&](double m) { return m <= floor; });
                const double end = rings_[static_cast<size_t>(faint - pair.most.begin())];
                if (low > end)
                    continue;
                const Run lit = high > end ? between(run, here, axes.nx, -end, end) : run;
                if (lit.first > lit.last)
                    continue;
                const PixelRow::Part part = row.part(lit);
                add_pair<Point>({edge.edge, edge.waves[pair.waves].data() + 1, points_[pair.point],
                                 visibility_->table(), visibility_->per_path(),
                                 visibility_->longest(), visibility_->middle(), wavelength_, pixel_,
                                 scale_ / std::sqrt(pixel_ / wavelength_), per_across_},
                                part.x, part.y, part.light.size(), part.light.data());
            }
        }
    }
}

template class PointFringes<RimPoint>;
template class PointFringes<Corner>;

} // namespace wfpsf
