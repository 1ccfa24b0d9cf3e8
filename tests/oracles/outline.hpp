// SPDX-License-Identifier: GPL-3.0-or-later
// A pupil's outline as arcs of ellipses and straight lines, and integrals over the lit area by
// Green's theorem as sums along it. Made from the pupil's definition, with nothing of the engine:
// its curves are cut at all their meetings, and a piece belongs to the outline if one side of it is
// lit and the other dark.
#pragma once

#include "instrument/pupil.hpp"
#include "numerics/quadrature.hpp"
#include "oracles/pixel_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace wfpsf::oracle {

struct Vec {
    double x, y;
    bool operator==(const Vec &) const = default;
    friend Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y}; }
    friend Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y}; }
    friend Vec operator*(double s, Vec a) { return {s * a.x, s * a.y}; }
};
inline double dot(Vec a, Vec b) {
    return a.x * b.x + a.y * b.y;
}
inline double cross(Vec a, Vec b) {
    return a.x * b.y - a.y * b.x;
}

// A point runs along it for t from begin to end, the lit side on its left.
struct Piece {
    // centre + cos t a + sin t b, or from + t along.
    bool round;
    Vec origin, a, b;
    double begin, end;

    Vec at(double t) const {
        return round ? origin + std::cos(t) * a + std::sin(t) * b : origin + t * a;
    }
    Vec slope(double t) const { return round ? std::cos(t) * b - std::sin(t) * a : a; }
    // Longest possible.
    double length() const {
        return std::abs(end - begin) *
               (round ? std::hypot(std::hypot(a.x, a.y), b.x, b.y) : std::hypot(a.x, a.y));
    }
};

using Outline = std::vector<Piece>;

// An ellipse's inside or outside, or one side of a line.
class Edge {
  public:
    static Edge ellipse(Vec centre, Vec a, Vec b) { return {true, centre, a, b}; }
    static Edge circle(const Circle &c) {
        return ellipse({c.x, c.y}, {c.radius, 0}, {0, c.radius});
    }
    // Inside where n.u >= d.
    static Edge line(Vec n, double d) {
        const double norm = dot(n, n);
        return {false, (d / norm) * n, {n.y, -n.x}, n};
    }

    // Above zero inside.
    double depth(Vec p) const {
        const Vec q = p - origin_;
        if (!round_)
            return dot(b_, q);
        const double u = cross(q, b_) / cross(a_, b_), v = cross(a_, q) / cross(a_, b_);
        return 1 - u * u - v * v;
    }

    Piece piece(double begin, double end) const { return {round_, origin_, a_, b_, begin, end}; }
    bool round() const { return round_; }
    bool operator==(const Edge &) const = default;

    // Parameters at which this curve passes through another.
    void cut(const Edge &other, std::vector<double> &at) const {
        const auto f = [&](double t) { return other.depth(piece(0, 0).at(t)); };
        // Between -reach and reach a sign changes in steps this small, or the meeting does not
        // matter.
        const double reach = round_ ? std::numbers::pi : 4;
        constexpr int steps = 4096;
        double t0 = -reach, f0 = f(t0);
        for (int i = 1; i <= steps; ++i) {
            const double t1 = reach * (2.0 * i / steps - 1), f1 = f(t1);
            if ((f0 > 0) != (f1 > 0)) {
                double low = t0, high = t1;
                for (int k = 0; k < 60; ++k) {
                    const double middle = (low + high) / 2;
                    ((f(middle) > 0) == (f0 > 0) ? low : high) = middle;
                }
                at.push_back((low + high) / 2);
            }
            t0 = t1;
            f0 = f1;
        }
    }

  private:
    Edge(bool round, Vec origin, Vec a, Vec b) : round_(round), origin_(origin), a_(a), b_(b) {}
    bool round_;
    Vec origin_, a_, b_; // of a line: along it, and its normal
};

// Inside all of `lit` and not inside all of any of `dark`; lengths of about one.
struct Region {
    std::vector<Edge> lit;
    std::vector<std::vector<Edge>> dark;

    bool holds(Vec p) const {
        const auto inside = [p](const Edge &e) { return e.depth(p) > 0; };
        return std::ranges::all_of(lit, inside) &&
               std::ranges::none_of(dark, [&](const std::vector<Edge> &shape) {
                   return std::ranges::all_of(shape, inside);
               });
    }

    Outline outline() const {
        std::vector<Edge> edges; // each once
        const auto collect = [&edges](const std::vector<Edge> &shape) {
            for (const Edge &edge : shape)
                if (std::ranges::find(edges, edge) == edges.end())
                    edges.push_back(edge);
        };
        collect(lit);
        for (const std::vector<Edge> &shape : dark)
            collect(shape);
        Outline outline;
        for (size_t i = 0; i < edges.size(); ++i) {
            const double reach = edges[i].round() ? std::numbers::pi : 4;
            std::vector<double> cuts{-reach, reach};
            for (int k = -3; edges[i].round() && k <= 3; ++k) // no piece too long
                cuts.push_back(k * reach / 4);
            for (size_t k = 0; k < edges.size(); ++k)
                if (k != i)
                    edges[i].cut(edges[k], cuts);
            std::ranges::sort(cuts);
            for (size_t k = 0; k + 1 < cuts.size(); ++k)
                add(outline, edges[i].piece(cuts[k], cuts[k + 1]));
        }
        return outline;
    }

  private:
    void add(Outline &outline, Piece piece) const {
        if (piece.end - piece.begin < 1e-13)
            return;
        const double middle = (piece.begin + piece.end) / 2;
        const Vec p = piece.at(middle), s = piece.slope(middle);
        const Vec left = (1e-9 / std::hypot(s.x, s.y)) * Vec{-s.y, s.x};
        const bool on_left = holds(p + left), on_right = holds(p - left);
        if (on_left == on_right)
            return;
        if (on_right)
            std::swap(piece.begin, piece.end);
        outline.push_back(piece);
    }
};

inline Outline outline(const AnnularPupil &pupil) {
    Region region{{Edge::circle({0, 0, pupil.outer_radius})}, {}};
    if (pupil.inner_radius > 0)
        region.dark.push_back({Edge::circle({0, 0, pupil.inner_radius})});
    return region.outline();
}

inline std::vector<Edge> bar(const Strut &s) {
    const Vec n{s.nx, s.ny};
    return {Edge::line(n, s.offset - s.width / 2), Edge::line(-1 * n, -s.offset - s.width / 2),
            Edge::line({-s.ny, s.nx}, 0)};
}

inline Outline outline(const SpiderPupil &pupil) {
    Region region{{Edge::circle({0, 0, pupil.outer_radius})}, {}};
    if (pupil.inner_radius > 0)
        region.dark.push_back({Edge::circle({0, 0, pupil.inner_radius})});
    for (const Strut &strut : pupil.struts)
        region.dark.push_back(bar(strut));
    return region.outline();
}

// Segment by segment counterclockwise: out along the clockwise edge, back along the other one, a
// fillet at each corner.
inline Outline outline(const SegmentedPupil &pupil) {
    constexpr double pi = std::numbers::pi;
    Outline outline;
    const double rho = pupil.corner_radius;
    const auto azimuth = [](Vec v) { return std::atan2(v.y, v.x); };
    const auto add_arc = [&](Vec centre, double radius, Vec from, Vec to) {
        const double begin = azimuth(from - centre);
        const double sweep = std::remainder(azimuth(to - centre) - begin, 2 * pi);
        outline.push_back({true, centre, {radius, 0}, {0, radius}, begin, begin + sweep});
    };
    for (const PupilSegment &segment : pupil.segments) {
        struct Corner {
            Vec fillet, on_edge, on_rim;
        };
        const Vec na{segment.clockwise_edge.nx, segment.clockwise_edge.ny};
        const Vec nb{segment.counterclockwise_edge.nx, segment.counterclockwise_edge.ny};
        const auto corner = [&](const HalfPlane &edge, const Circle &rim, double side) {
            const Vec n{edge.nx, edge.ny}, c{rim.x, rim.y};
            Vec out{-n.y, n.x};
            if (dot(out, na + nb) < 0)
                out = -1 * out;
            const double reach = rim.radius + side * rho, off = edge.d + rho - dot(n, c);
            const Vec fillet = c + off * n + std::sqrt(reach * reach - off * off) * out;
            return Corner{fillet, fillet - rho * n, c + (rim.radius / reach) * (fillet - c)};
        };
        const Circle &outer = pupil.outer, &inner = pupil.obscuration;
        const Corner a_in = corner(segment.clockwise_edge, inner, 1);
        const Corner a_out = corner(segment.clockwise_edge, outer, -1);
        const Corner b_in = corner(segment.counterclockwise_edge, inner, 1);
        const Corner b_out = corner(segment.counterclockwise_edge, outer, -1);
        const auto add_line = [&](Vec from, Vec to) {
            outline.push_back({false, from, to - from, {0, 0}, 0, 1});
        };
        const auto add_fillet = [&](const Corner &c, Vec from, Vec to) {
            if (rho > 0)
                add_arc(c.fillet, rho, from, to);
        };
        add_line(a_in.on_edge, a_out.on_edge);
        add_fillet(a_out, a_out.on_edge, a_out.on_rim);
        add_arc({outer.x, outer.y}, outer.radius, a_out.on_rim, b_out.on_rim);
        add_fillet(b_out, b_out.on_rim, b_out.on_edge);
        add_line(b_out.on_edge, b_in.on_edge);
        add_fillet(b_in, b_in.on_edge, b_in.on_rim);
        add_arc({inner.x, inner.y}, inner.radius, b_in.on_rim, a_in.on_rim);
        add_fillet(a_in, a_in.on_rim, a_in.on_edge);
    }
    return outline;
}

// In normalised coordinates, then mapped: x = c + S X, S = radius Q^(-1/2).
inline Outline outline(const RomanPupil &pupil) {
    struct Root {
        double xx, xy, yy;
        Vec operator()(Vec v) const { return {xx * v.x + xy * v.y, xy * v.x + yy * v.y}; }
    };
    const auto root = [](const Ellipse &e) {
        const double bend = std::hypot(e.p, e.q), axis = std::atan2(e.q, e.p) / 2;
        const double along = e.radius / std::sqrt(1 - bend);
        const double across = e.radius / std::sqrt(1 + bend);
        const double c = std::cos(axis), s = std::sin(axis);
        return Root{along * c * c + across * s * s, (along - across) * c * s,
                    along * s * s + across * c * c};
    };
    const auto edge = [&](const Ellipse &e) {
        const Root r = root(e);
        return Edge::ellipse({e.x, e.y}, r({1, 0}), r({0, 1}));
    };
    const Root map = root(pupil.primary);
    const Vec centre{pupil.primary.x, pupil.primary.y};
    Region region{{Edge::circle({0, 0, 1}), edge(pupil.vignetting)}, {}};
    if (pupil.clip)
        for (const Vec n : {Vec{1, 0}, Vec{0, 1}}) {
            region.lit.push_back(Edge::line(map(n), pupil.clip->low - dot(n, centre)));
            region.lit.push_back(Edge::line(-1 * map(n), dot(n, centre) - pupil.clip->high));
        }
    for (size_t k = 0; k < 6; ++k) {
        region.dark.push_back(bar(pupil.telescope_struts[k]));
        region.dark.push_back(bar(pupil.mask_struts[k]));
    }
    if (const auto *mask = std::get_if<LongWaveMask>(&pupil.mask)) {
        region.lit.push_back(edge(mask->outer));
        region.dark.push_back({edge(mask->inner)});
    } else {
        const auto &discs = std::get<ShortWaveMask>(pupil.mask);
        const Vec c{discs.lower.x, discs.lower.y};
        region.dark.push_back({Edge::circle(discs.upper)});
        region.dark.push_back({Edge::circle(discs.lower)});
        // Enlarged between the points where the middles of two struts have radius 0.32.
        const auto towards = [&](size_t k) {
            const Strut &s = pupil.telescope_struts[k];
            const double along = std::sqrt(0.32 * 0.32 - s.offset * s.offset);
            return Vec{s.nx * s.offset - s.ny * along, s.ny * s.offset + s.nx * along} - c;
        };
        for (const auto &[from, to] : {std::pair(1, 2), std::pair(3, 4), std::pair(5, 0)}) {
            const Vec f = towards(static_cast<size_t>(from)), t = towards(static_cast<size_t>(to));
            const Vec ccw_of_from{-f.y, f.x}, cw_of_to{t.y, -t.x};
            region.dark.push_back({Edge::circle({c.x, c.y, discs.enlarged_radius}),
                                   Edge::line(ccw_of_from, dot(ccw_of_from, c)),
                                   Edge::line(cw_of_to, dot(cw_of_to, c))});
        }
    }
    Outline outline = region.outline();
    for (Piece &piece : outline) {
        piece.origin = centre + map(piece.origin);
        piece.a = map(piece.a);
        piece.b = map(piece.b);
    }
    return outline;
}

// Gauss nodes along an outline for waves of up to `wavenumber`; dx and dy hold the weights.
struct OutlineNodes {
    std::vector<double> x, y, dx, dy;
};

// Waves that turn by so much from the middle of a range to its end, along a bent piece.
inline int points_for(double phase) {
    return 4 + gauss_legendre_points(0.5 + 1.1 * phase, 1e-15);
}

inline OutlineNodes outline_nodes(const Outline &outline, double wavenumber) {
    OutlineNodes nodes;
    GaussLegendreRules rules;
    for (const Piece &piece : outline) {
        const GaussLegendre &rule = rules.of(points_for(wavenumber * piece.length() / 2));
        const double half = (piece.end - piece.begin) / 2;
        for (size_t i = 0; i < rule.x.size(); ++i) {
            const double t = piece.begin + half * (1 + rule.x[i]);
            const Vec p = piece.at(t), s = piece.slope(t);
            nodes.x.push_back(p.x);
            nodes.y.push_back(p.y);
            nodes.dx.push_back(rule.w[i] * half * s.x);
            nodes.dy.push_back(rule.w[i] * half * s.y);
        }
    }
    return nodes;
}

inline double area(const Outline &outline) {
    const OutlineNodes nodes = outline_nodes(outline, 1);
    double sum = 0;
    for (size_t i = 0; i < nodes.x.size(); ++i)
        sum += (nodes.x[i] * nodes.dy[i] - nodes.y[i] * nodes.dx[i]) / 2;
    return sum;
}

// Fractions of the light in pixels, of an unaberrated pupil: the amplitude is the contour integral
// of exp(i k.u) (k_x dy - k_y dx) / (i k^2).
inline std::vector<double> contour_pixels(const Outline &outline, double wavelength,
                                          double pixel_scale, const std::vector<Vec> &angles) {
    const PixelSums sums(pixel_scale, wavelength, angles);
    const OutlineNodes nodes = outline_nodes(outline, sums.largest_wavenumber());
    const std::vector<double> none(nodes.x.size());
    const auto by_dy = sums.amplitudes(nodes.x, nodes.y, nodes.dy, none);
    const auto by_dx = sums.amplitudes(nodes.x, nodes.y, nodes.dx, none);
    std::vector<PixelSums::Amplitudes> amplitudes(angles.size());
    for (size_t p = 0; p < angles.size(); ++p)
        for (size_t j = 0; j < by_dy[p].size(); ++j) {
            const auto [kx, ky] = sums.wave(p, j);
            amplitudes[p].push_back((kx * by_dy[p][j] - ky * by_dx[p][j]) /
                                    std::complex<double>(0, kx * kx + ky * ky));
        }
    return sums.pixels(amplitudes, area(outline));
}

// The same with aberrations, waves(x, y): Green's theorem makes the integral of f over the area
// that of dy times the integral of f along x up to the outline, from the axis on. `slope` is the
// largest gradient of the waves where the pupil is, and between it and the axis.
template <class Waves>
std::vector<double> green_pixels(const Outline &outline, const Waves &waves, double slope,
                                 double wavelength, double pixel_scale,
                                 const std::vector<Vec> &angles) {
    const PixelSums sums(pixel_scale, wavelength, angles);
    const double wavenumber = sums.largest_wavenumber() + 2 * std::numbers::pi * slope;
    const OutlineNodes nodes = outline_nodes(outline, wavenumber);
    GaussLegendreRules rules;
    std::vector<PixelSums::Amplitudes> amplitudes;
    std::vector<double> x, y, re, im;
    const auto flush = [&] {
        const auto some = sums.amplitudes(x, y, re, im);
        if (amplitudes.empty())
            amplitudes = some;
        else
            for (size_t p = 0; p < some.size(); ++p)
                for (size_t j = 0; j < some[p].size(); ++j)
                    amplitudes[p][j] += some[p][j];
        for (std::vector<double> *v : {&x, &y, &re, &im})
            v->clear();
    };
    for (size_t i = 0; i < nodes.x.size(); ++i) {
        const double half = nodes.x[i] / 2;
        const GaussLegendre &rule = rules.of(points_for(wavenumber * std::abs(half)));
        for (size_t k = 0; k < rule.x.size(); ++k) {
            const double at = half * (1 + rule.x[k]);
            const double weight = rule.w[k] * half * nodes.dy[i];
            const double phase = 2 * std::numbers::pi * waves(at, nodes.y[i]);
            x.push_back(at);
            y.push_back(nodes.y[i]);
            re.push_back(weight * std::cos(phase));
            im.push_back(weight * std::sin(phase));
        }
        if (x.size() > 100000)
            flush();
    }
    flush();
    return sums.pixels(amplitudes, area(outline));
}

} // namespace wfpsf::oracle
