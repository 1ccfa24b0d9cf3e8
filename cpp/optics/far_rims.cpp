// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_rims.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"
#include "optics/fresnel.hpp"

#include <numbers>
#include <span>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// Part of an oval.
struct Arc {
    double begin, end, outwards; // +1: the dark is outside
    bool closed;
    bool smooth_begin = false, smooth_end = false; // a straight edge goes on, with that end's light
    std::vector<EdgeEnd> at_begin = {}, at_end = {}; // of straight edges that turn off there
};

struct Rim {
    Oval oval;
    std::vector<Arc> arcs;
};

std::vector<Rim> rims(const PupilEdges &edges, const std::vector<size_t> &without = {}) {
    std::vector<Rim> out;
    const std::vector<Junction> joined = junctions(edges);
    for (size_t c = 0; c < edges.curved.size(); ++c) {
        if (std::ranges::count(without, c) > 0)
            continue;
        const CurvedEdge &edge = edges.curved[c];
        Arc arc{edge.begin, edge.end, edge.lit_inside ? 1.0 : -1.0, edge.closed()};
        for (const auto &[end, other, kink] : joined) {
            if (!end.is_curved || end.edge != c || other.is_curved)
                continue;
            if (kink < smooth_kink)
                (end.at_begin ? arc.smooth_begin : arc.smooth_end) = true;
            else
                (end.at_begin ? arc.at_begin : arc.at_end).push_back(other);
        }
        auto rim = std::ranges::find_if(out, [&](const Rim &r) { return r.oval == edge.oval; });
        if (rim == out.end())
            rim = out.insert(out.end(), {edge.oval, {}});
        rim->arcs.push_back(arc);
    }
    return out;
}

// An oval's point and what it sends along its normal: all per unit of k, and corrections by the
// wavefront.
struct Stationary {
    double angle;
    double speed;     // metres a radian
    double bend;      // second derivative of k.u by the oval's angle, over k
    double waves = 0; // wavefront
    double slope = 0, w_slope = 0, w_bend = 0; // W along the direction, dW/da, d2W/da2
};

Stationary stationary(const Oval &o, const Wavefront &w, double ux, double uy, double side) {
    const double a = ux * o.half_width + uy * o.shear, b = uy * o.half_height;
    const double angle = std::atan2(side * b, side * a), u = std::cos(angle), v = std::sin(angle);
    const double x = o.x + o.half_width * u, y = o.y + o.shear * u + o.half_height * v;
    const double dx = -o.half_width * v, dy = o.half_height * u - o.shear * v;
    constexpr double h = 5e-3, turn = 1e-2;
    const double here = w(x, y);
    const double before = w(x - turn * dx, y - turn * dy), after = w(x + turn * dx, y + turn * dy);
    return {.angle = angle,
            .speed = std::hypot(dx, dy),
            .bend = -side * std::hypot(a, b),
            .waves = here,
            .slope = (w(x + h * ux, y + h * uy) - here) / h,
            .w_slope = (after - before) / (2 * turn),
            .w_bend = (after - 2 * here + before) / (turn * turn)};
}

// Fresnel's integral from 0 to an arc's end, without the waves that come from there itself when it
// is far off: those are a corner's light. `own` is 0 where they are that of the edge that goes on.
[[gnu::always_inline]] inline void fresnel_nearby(double x, double own, double &re, double &im) {
    const double a = std::abs(x), share = own * (1 - corner_share(a)), sign = x < 0 ? -1 : 1;
    double g, f, cosine, sine;
    fresnel_auxiliary(a, g, f);
    phasor(a * a / 4, cosine, sine);
    re = sign * (0.5 - share * (g * cosine - f * sine));
    im = sign * (0.5 - share * (g * sine + f * cosine));
}

// Adds the part of the point's light that an arc has, by Fresnel's integral.
WFPSF_VECTORISED void add_seen(const Distances &begin, double begin_own, const Distances &end,
                               double end_own, const Distances &weight, Distances &re,
                               Distances &im) {
    for (size_t j = 0; j < re.size(); ++j) {
        double begin_re, begin_im, end_re, end_im;
        fresnel_nearby(begin[j], begin_own, begin_re, begin_im);
        fresnel_nearby(end[j], end_own, end_re, end_im);
        re[j] += weight[j] * (end_re - begin_re);
        im[j] += weight[j] * (end_im - begin_im);
    }
}

struct Amplitudes {
    Distances re, im;
};

// Adds what edges send that turn off from an arc's end, x from the point by Fresnel's integral, as
// far as it goes with the point's light; but none where tables of the edges' spikes have it, up to
// `tables_end` across in units of k.
WFPSF_VECTORISED void add_turned(std::span<const EdgeEnd> edges, const RimTable::Vector &u,
                                 const Distances &k, double tables_end, const Distances &x,
                                 Amplitudes &out) {
    size_t first = 0; // the nearer, the smaller is x
    while (first < x.size() && corner_share(std::abs(x[first])) == 1)
        ++first;
    for (const EdgeEnd &edge : edges) {
        const double along = edge.tx * u.x + edge.ty * u.y;
        const double sent = (edge.nx * u.x + edge.ny * u.y) / (2 * pi);
        constexpr double least = 0.01; // nearer to the line tables have it
        const double ratio = sent / std::copysign(std::max(std::abs(along), least), along);
        for (size_t j = first; j < x.size(); ++j) {
            const double share = ratio / std::sqrt(k[j]) * (1 - within(along * k[j] / tables_end)) *
                                 (1 - corner_share(std::abs(x[j])));
            double cosine, sine;
            phasor(x[j] * x[j] / 4, cosine, sine);
            out.re[j] -= share * sine;
            out.im[j] += share * cosine;
        }
    }
}

// Over exp(2 pi i (k place + waves)), times k^(3/2) 2 pi i; by distance from the farthest on.
// Of the point, and with what edges send that turn off from arcs' ends.
struct PointAmplitudes {
    Amplitudes own, with_edges;
};
PointAmplitudes amplitudes(const Rim &rim, const Stationary &at, const RimTable::Vector &u,
                           double side, const Distances &k, double tables_end) {
    constexpr double endless = 100; // of Fresnel's integral
    Distances shift, per_radian;
    Amplitudes own{}, turned{};
    auto &[re, im] = own;
    for (size_t j = 0; j < k.size(); ++j) {
        const double bend = k[j] * at.bend + at.w_bend;
        shift[j] = at.w_slope / bend;
        per_radian[j] = std::sqrt(2 * std::abs(bend));
    }
    for (const Arc &arc : rim.arcs) {
        const double middle = (arc.begin + arc.end) / 2, half = (arc.end - arc.begin) / 2;
        const double off = std::remainder(at.angle - middle, 2 * pi); // the nearest turn's
        Distances begin, end, weight;
        for (size_t j = 0; j < k.size(); ++j) {
            begin[j] = (shift[j] - off - half) * per_radian[j];
            end[j] = (shift[j] - off + half) * per_radian[j];
            const bool dark = (arc.smooth_begin && begin[j] > 0) || (arc.smooth_end && end[j] < 0);
            weight[j] = dark ? 0 : arc.outwards;
        }
        if (arc.closed) {
            begin.fill(-endless);
            end.fill(endless);
        }
        add_seen(begin, arc.smooth_begin ? 0 : 1, end, arc.smooth_end ? 0 : 1, weight, re, im);
        add_turned(arc.at_begin, u, k, tables_end, begin, turned);
        add_turned(arc.at_end, u, k, tables_end, end, turned);
    }
    for (size_t j = 0; j < k.size(); ++j) {
        const double scale =
            side * at.speed * std::sqrt(k[j]) / (per_radian[j] * (1 + at.slope / k[j]));
        const double sign = k[j] * at.bend + at.w_bend < 0 ? -1 : 1;
        re[j] *= scale;
        im[j] *= sign * scale;
        turned.re[j] = re[j] + sign * turned.re[j];
        turned.im[j] += im[j];
    }
    return {own, turned};
}

bool lit(const Rim &rim, double angle) {
    constexpr double beyond = 1.2; // radians
    return std::ranges::any_of(rim.arcs, [&](const Arc &arc) {
        const double off = std::remainder(angle - (arc.begin + arc.end) / 2, 2 * pi);
        return arc.closed || std::abs(off) < (arc.end - arc.begin) / 2 + beyond;
    });
}

} // namespace

RimTable::Vector RimTable::direction(int i) {
    const double angle = 4.0 * i / directions, quarter = std::floor(angle), p = angle - quarter;
    const double norm = std::hypot(1 - p, p), x = (1 - p) / norm, y = p / norm;
    switch (static_cast<int>(quarter) & 3) {
    case 0:
        return {x, y};
    case 1:
        return {-y, x};
    case 2:
        return {-x, -y};
    default:
        return {y, -x};
    }
}

void RimTable::close(std::vector<float> &table) {
    for (int i = 0; i < directions; ++i)
        table[entry(i, 0)] = table[entry(i, 1)];
    std::copy_n(table.begin(), columns, table.end() - columns);
}

RimTable::Vector RimPoint::position(double ux, double uy) const {
    const double a = ux * oval.half_width + uy * oval.shear, b = uy * oval.half_height;
    const double norm = side / std::hypot(a, b);
    return {oval.x + oval.half_width * a * norm,
            oval.y + (oval.shear * a + oval.half_height * b) * norm};
}

double RimPoint::most(double ux, double uy, double r, double reach) const {
    const auto at = RimTable::place(RimTable::row_of(ux, uy), RimTable::column_of(nearest / r));
    const auto width = static_cast<int>(reach / r * RimTable::directions / 4) + 1;
    const int step = 1 + width / 16; // it does not change so fast
    double square = 0;
    for (int i = -width; i <= width + step; i += step)
        for (const int j : {at.column, at.column + 1}) {
            const int row = (at.row + i + RimTable::directions) % RimTable::directions;
            const size_t entry = RimTable::entry(row, j);
            square = std::max<double>(square, re[entry] * re[entry] + im[entry] * im[entry]);
        }
    return std::sqrt(square);
}

namespace {

// What it sends in a direction.
void set(RimPoint &point, int direction, double waves, const Amplitudes &sent) {
    const auto first = static_cast<std::ptrdiff_t>(RimTable::entry(direction, 1));
    const auto stored = [](double value) { return static_cast<float>(value); };
    std::ranges::transform(sent.re, point.re.begin() + first, stored);
    std::ranges::transform(sent.im, point.im.begin() + first, stored);
    point.waves[static_cast<size_t>(direction)] = waves;
}

RimPoints points_of(const std::vector<Rim> &rims, const FarSource &source) {
    RimPoints points;
    const double wavelength = source.mean_wavelength();
    const double tables_end = source.fringe_reach() * source.pixel() / wavelength;
    const Wavefront w = source.wavefront(wavelength);
    Distances k;
    for (size_t j = 0; j < k.size(); ++j)
        k[j] = RimTable::distance(static_cast<int>(j + 1), source.nearest) * source.pixel() /
               wavelength;
    for (const Rim &rim : rims)
        for (const double side : {1.0, -1.0}) {
            RimPoint own(rim.oval, side, source.nearest);
            RimPoint with_edges(rim.oval, side, source.nearest);
            for (int i = 0; i < RimTable::directions; ++i) {
                const RimTable::Vector u = RimTable::direction(i);
                const Oval &o = rim.oval;
                const double a = u.x * o.half_width + u.y * o.shear, b = u.y * o.half_height;
                if (!lit(rim, std::atan2(side * b, side * a)))
                    continue;
                const Stationary at = stationary(rim.oval, w, u.x, u.y, side);
                const PointAmplitudes sent = amplitudes(rim, at, u, side, k, tables_end);
                set(own, i, at.waves, sent.own);
                set(with_edges, i, at.waves, sent.with_edges);
            }
            for (RimPoint *point : {&own, &with_edges}) {
                RimTable::close(point->re);
                RimTable::close(point->im);
                point->waves.back() = point->waves.front();
            }
            points.own.push_back(std::move(own));
            points.with_edges.push_back(std::move(with_edges));
        }
    return points;
}

} // namespace

RimPoints rim_points(const FarSource &source, const PupilEdges &edges) {
    return points_of(rims(edges), source);
}

std::vector<RimPoint> rim_points_without(const std::vector<size_t> &curved, size_t straight,
                                         const FarSource &source, const PupilEdges &edges) {
    std::vector<Rim> left = rims(edges, curved);
    std::erase_if(left, [&](const Rim &rim) {
        return std::ranges::none_of(curved,
                                    [&](size_t c) { return edges.curved[c].oval == rim.oval; });
    });
    std::vector<RimPoint> points = points_of(left, source).own;
    for (RimPoint &point : points)
        point.edge = straight;
    return points;
}

} // namespace wfpsf
