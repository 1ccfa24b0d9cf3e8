// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_rim_fringes.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"
#include "numerics/quadrature.hpp"
#include "numerics/sinc.hpp"

#include <algorithm>
#include <complex>
#include <numbers>

namespace wfpsf {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

// Lagrange's polynomials of the nodes at x.
std::array<double, far_colours> lagrange(const std::array<double, far_colours> &nodes, double x) {
    std::array<double, far_colours> out{};
    for (size_t m = 0; m < far_colours; ++m) {
        out[m] = 1;
        for (size_t n = 0; n < far_colours; ++n)
            if (n != m)
                out[m] *= (x - nodes[n]) / (nodes[m] - nodes[n]);
    }
    return out;
}

// table[j] += weight * share[m] * exp(2 pi i (j - 1) turn)
WFPSF_VECTORISED void add_colour(const std::array<double, far_colours> &share, double turn,
                                 std::vector<ColourWaves> &table) {
    for (size_t j = 0; j < table.size(); ++j) {
        double cosine, sine;
        phasor((static_cast<double>(j) - 1) * turn, cosine, sine);
        for (size_t m = 0; m < far_colours; ++m) {
            table[j].re[m] += share[m] * cosine;
            table[j].im[m] += share[m] * sine;
        }
    }
}

} // namespace

Visibility::Visibility(const FarSource &source, double longest) {
    const Spectrum spectrum = source.light(longest);
    const auto [blue, red] = std::ranges::minmax(spectrum.wavelength);
    middle_ = (1 / blue + 1 / red) / 2;
    const double half = (1 / blue - 1 / red) / 2;
    constexpr double per_fringe = 6;
    per_path_ = per_fringe * 2 * half;
    for (size_t m = 0; m < far_colours; ++m) // Chebyshev's nodes
        wavenumber_[m] = middle_ - half * std::cos(pi * (static_cast<double>(m) + 0.5) /
                                                   static_cast<double>(far_colours));
    table_.resize(static_cast<size_t>(longest * per_path_) + 4);
    for (size_t q = 0; q < spectrum.size(); ++q) {
        const double wavelength = spectrum.wavelength[q];
        auto share = lagrange(wavenumber_, 1 / wavelength);
        for (double &value : share)
            value *= spectrum.weight[q] * std::sqrt(wavelength / source.mean_wavelength());
        add_colour(share, (1 / wavelength - middle_) / per_path_, table_);
    }
    most_.resize(table_.size());
    for (size_t j = table_.size(); j-- > 0;) {
        for (size_t m = 0; m < far_colours; ++m)
            most_[j] += std::hypot(table_[j].re[m], table_[j].im[m]);
        if (j + 1 < table_.size())
            most_[j] = std::max(most_[j], most_[j + 1]);
    }
}

double Visibility::most(double path) const {
    const double at = std::max(path, 0.0) * per_path_;
    return most_[std::min(static_cast<size_t>(at), most_.size() - 1)];
}

// ---------------------------------------------------------------------------------- making of them

RimFringes::RimFringes(const FarSource &source, const PupilEdges &edges, RimPoints rims)
    : rims_(std::move(rims)),
      visibility_(source, 1.1 * source.optics.aperture->diameter() * farthest * source.pixel()),
      pixel_(source.pixel()), scale_(1 / (2 * pi * pi * source.area())) {
    double longest = 0;
    for (const StraightEdge &edge : edges.straight) {
        const double dx = edge.to_x - edge.from_x, dy = edge.to_y - edge.from_y;
        const double length = std::hypot(dx, dy);
        edges_.push_back({{dy / length, -dx / length},
                          (edge.from_x + edge.to_x) / 2,
                          (edge.from_y + edge.to_y) / 2,
                          length});
        longest = std::max(longest, length);
    }
    // As far as the colours are enough for what differs between the band's ends.
    const auto &wavenumber = visibility_.wavenumbers();
    constexpr double most_turns = 4.0 / 3;
    per_across_ = 2 * std::max(1.0, source.bandwidth());
    const double reach = most_turns / (longest * pixel_ * (wavenumber.back() - wavenumber.front()));
    reach_ = std::floor(std::min(12.0, reach) * per_across_) / per_across_;
    for (Edge &edge : edges_) {
        add_pairs(source, edge);
        add_rings(edge);
    }
}

void RimFringes::add_pairs(const FarSource &source, Edge &edge) const {
    const auto &[nx, ny] = edge.axes;
    const auto &wavenumber = visibility_.wavenumbers();
    const Wavefront &w = source.optics.wavefront;
    const Covariance &blur = source.settings.blur;
    const double mirror = source.settings.mirrored ? -1 : 1;
    const auto response = [&](double x, double y) { // cycles a native pixel
        const double fade = std::exp(
            -2 * pi * pi * (blur.xx * x * x + 2 * blur.xy * mirror * x * y + blur.yy * y * y));
        return source.settings.pixel_response ? fade * sinc(x) * sinc(y) : fade;
    };
    const auto half = static_cast<std::ptrdiff_t>(std::lround(reach_ * per_across_)) + 2;
    const GaussLegendre rule(
        8 + gauss_legendre_points(pi * wavenumber.back() * pixel_ * reach_ * edge.length, 1e-4));
    std::vector<double> waves(rule.x.size());
    for (size_t i = 0; i < rule.x.size(); ++i) {
        const double s = rule.x[i] * edge.length / 2;
        waves[i] = source.optics.wavelength * w(edge.x - ny * s, edge.y + nx * s);
    }
    const auto lit = [&](size_t point, double side) {
        const RimPoint &p = rims_.points[point];
        const double turn = 4.0 / RimTable::directions;
        const double middle = diamond(side * nx, side * ny) / turn;
        const int width = static_cast<int>(std::min(1.0, reach_ / rims_.nearest) / turn);
        for (int i = -width; i <= width; ++i) {
            const int row =
                (static_cast<int>(middle) + i + RimTable::directions) % RimTable::directions;
            for (int j = 1; j <= RimTable::distances; ++j)
                if (std::hypot(p.re[RimTable::entry(row, j)], p.im[RimTable::entry(row, j)]) >
                    1e-3 * p.most)
                    return true;
        }
        return false;
    };
    for (size_t front = 0; front < rims_.points.size(); ++front) {
        const size_t behind = front ^ 1U;
        Pair pair{{front, behind}, {lit(front, 1), lit(behind, -1)}, {}};
        if (!pair.lit[0] && !pair.lit[1])
            continue;
        const RimPoint &point = rims_.points[front];
        const Oval &o = point.oval;
        const double a = nx * o.half_width + ny * o.shear, b = ny * o.half_height;
        const double norm = point.side / std::hypot(a, b);
        const double px = o.x + o.half_width * a * norm;
        const double py = o.y + (o.shear * a + o.half_height * b) * norm;
        pair.waves.resize(static_cast<size_t>(2 * half + 1));
        for (size_t m = 0; m < far_colours; ++m) {
            const double per_metre = pixel_ * wavenumber[m];
            for (size_t i = 0; i < rule.x.size(); ++i) {
                const double s = rule.x[i] * edge.length / 2;
                const double weight = rule.w[i] * edge.length / 2 *
                                      response((edge.x - ny * s - px) * per_metre,
                                               (edge.y + nx * s - py) * per_metre);
                for (std::ptrdiff_t j = -half; j <= half; ++j) {
                    double cosine, sine;
                    phasor(waves[i] * wavenumber[m] +
                               per_metre * s * static_cast<double>(j) / per_across_,
                           cosine, sine);
                    ColourWaves &to = pair.waves[static_cast<size_t>(j + half)];
                    to.re[m] += weight * cosine;
                    to.im[m] += weight * sine;
                }
            }
        }
        edge.pairs.push_back(std::move(pair));
    }
}

void RimFringes::add_rings(Edge &edge) const {
    const auto &[nx, ny] = edge.axes;
    for (size_t j = 0; ring(j) < farthest; ++j) {
        const double r = ring(j);
        double most = 0;
        for (const size_t side : {0, 1}) {
            double sum = 0;
            for (const Pair &pair : edge.pairs) {
                if (!pair.lit[side])
                    continue;
                double brightest = 0;
                for (const ColourWaves &waves : pair.waves)
                    for (size_t m = 0; m < far_colours; ++m)
                        brightest = std::max(brightest, std::hypot(waves.re[m], waves.im[m]));
                const RimPoint &point = rims_.points[pair.point[side]];
                const double way = side == 0 ? 1 : -1;
                const double path = std::abs(way * edge.axes.along(edge.x, edge.y) -
                                             point.place(way * nx, way * ny));
                const double across = edge.length * reach_ * pixel_;
                sum += brightest * point.most * visibility_.most(path * r * pixel_ - across);
            }
            most = std::max(most, sum);
        }
        edge.most.push_back(most * scale_ / (r * r * std::sqrt(r * pixel_ / rims_.wavelength)));
    }
    edge.most.push_back(0);
    for (size_t j = edge.most.size() - 1; j-- > 0;)
        edge.most[j] = std::max(edge.most[j], edge.most[j + 1]);
}

// ---------------------------------------------------------------------------------------- drawing

namespace {

// Lagrange's cubic through the samples -1, 0, 1, 2: their weights at 0 <= s < 1.
struct Cubic {
    double w[4];
    [[gnu::always_inline]] explicit Cubic(double s) {
        const double a = s + 1, b = s - 1, c = s - 2;
        w[0] = -s * b * c / 6;
        w[1] = a * b * c / 2;
        w[2] = -a * s * c / 2;
        w[3] = a * s * b / 6;
    }
};

struct PairTable {
    SpikeAxes axes;
    double x, y; // of the edge, m
    double pixel, scale, nearest;
    double reach, per_across;
    const ColourWaves *edge; // at -1 steps from the position -reach
    const RimPoint *point;
    double per_path, longest, middle, wavelength;
    const ColourWaves *visibility;
};

WFPSF_VECTORISED void add_pair(const PairTable &pair, double x0, double y, size_t n,
                               double *light) {
    const auto [nx, ny] = pair.axes;
    const double *re = pair.point->re.data(), *im = pair.point->im.data();
    const double *waves = pair.point->waves.data();
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i);
        const double along = nx * x + ny * y, across = nx * y - ny * x;
        const double r2 = x * x + y * y, r = std::sqrt(r2);
        const auto place = RimTable::place(x, y, pair.nearest / r);
        const double wave = waves[place.row] + place.s * (waves[place.row + 1] - waves[place.row]);
        const double path = pair.pixel * (pair.x * x + pair.y * y - pair.point->place(x, y)) -
                            wave * pair.wavelength;
        const double at = std::min(std::abs(path) * pair.per_path, pair.longest);
        const double column = (across + pair.reach) * pair.per_across;
        const auto cell = static_cast<int32_t>(at), left = static_cast<int32_t>(column);
        const Cubic of_path(at - cell), of_edge(column - left);
        const ColourWaves *v = pair.visibility + cell, *e = pair.edge + left;
        const double sign = path < 0 ? -1 : 1;
        double sum_re = 0, sum_im = 0;
        for (size_t m = 0; m < far_colours; ++m) {
            double v_re = 0, v_im = 0, e_re = 0, e_im = 0;
            for (int k = 0; k < 4; ++k) {
                v_re += of_path.w[k] * v[k].re[m];
                v_im += of_path.w[k] * v[k].im[m];
                e_re += of_edge.w[k] * e[k].re[m];
                e_im += of_edge.w[k] * e[k].im[m];
            }
            v_im *= sign;
            sum_re += v_re * e_re - v_im * e_im;
            sum_im += v_re * e_im + v_im * e_re;
        }
        double cosine, sine;
        phasor(path * pair.middle, cosine, sine);
        const double all_re = sum_re * cosine - sum_im * sine;
        const double all_im = sum_re * sine + sum_im * cosine;
        const double out = std::clamp(3 * (1 - std::abs(across) / pair.reach), 0.0, 1.0);
        light[i] += pair.scale * along / (r2 * r * std::sqrt(r)) * out * out * (3 - 2 * out) *
                    (all_re * place.of(re) + all_im * place.of(im));
    }
}

} // namespace

double RimFringes::brightest(double r, const SpikeAxes &spike) const {
    double sum = 0;
    const double at = std::max(0.0, rings_per_octave * std::log2(r / rims_.nearest));
    for (const Edge &edge : edges_)
        if (std::abs(edge.axes.across(spike.nx, spike.ny)) < same_direction)
            sum += edge.most[std::min(static_cast<size_t>(at), edge.most.size() - 1)];
    return sum;
}

void RimFringes::add(const PixelRow &row, double floor) const {
    for (const Edge &edge : edges_) {
        const auto below = std::ranges::find_if(edge.most, [&](double m) { return m <= floor; });
        if (below == edge.most.begin())
            continue;
        const double end = std::min(farthest, ring(static_cast<size_t>(below - edge.most.begin())));
        for (const Run &run : runs_along(edge.axes, row, reach_, rims_.nearest, end)) {
            const PixelRow part = row.part(run.first, run.last);
            const double middle = part.x + static_cast<double>(part.light.size() - 1) / 2;
            const size_t side = edge.axes.along(middle, part.y) < 0 ? 1 : 0;
            for (const Pair &pair : edge.pairs)
                if (pair.lit[side])
                    add_pair({edge.axes, edge.x, edge.y, pixel_,
                              scale_ / std::sqrt(pixel_ / rims_.wavelength), rims_.nearest, reach_,
                              per_across_, pair.waves.data() + 1, &rims_.points[pair.point[side]],
                              visibility_.per_path(),
                              static_cast<double>(visibility_.table().size()) - 4.001,
                              visibility_.middle(), rims_.wavelength, visibility_.table().data()},
                             part.x, part.y, part.light.size(), part.light.data());
        }
    }
}

} // namespace wfpsf
