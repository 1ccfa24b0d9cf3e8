// SPDX-License-Identifier: GPL-3.0-or-later
// Every curve of the description is cut where it meets others; a piece is an edge if one side of it
// is lit and the other dark.
#include "optics/pupil_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double shortest = 1e-6; // piece that matters: metres along a line, radians of an oval
constexpr double aside = 1e-9;    // m, from an edge to what is tested for light

struct Point {
    double x, y;
};

// Above zero inside.
double depth(const HalfPlane &h, Point p) {
    return h.nx * p.x + h.ny * p.y - h.d;
}
double depth(const Oval &o, Point p) {
    const double u = (p.x - o.x) / o.half_width;
    const double v = (p.y - o.y - o.shear * u) / o.half_height;
    return 1 - u * u - v * v;
}
bool inside(const Bound &bound, Point p) {
    return std::visit([p](const auto &b) { return depth(b, p) > 0; }, bound);
}

bool lit(const LitPart &part, Point p) {
    const auto in = [p](const Bound &b) { return inside(b, p); };
    return std::ranges::all_of(part.lit, in) &&
           std::ranges::none_of(part.dark, [&](const DarkShape &shape) {
               return std::ranges::all_of(shape.inside, in) &&
                      std::ranges::none_of(shape.outside, in);
           });
}

// A bound's own parameter: metres along a line, lit side on the left; the angle of an oval's point.
Point at(const HalfPlane &h, double t) {
    return {h.nx * h.d + h.ny * t, h.ny * h.d - h.nx * t};
}
Point at(const Oval &o, double t) {
    const double u = std::cos(t), v = std::sin(t);
    return {o.x + o.half_width * u, o.y + o.shear * u + o.half_height * v};
}
Point slope(const HalfPlane &h, double) {
    return {h.ny, -h.nx};
}
Point slope(const Oval &o, double t) {
    const double u = -std::sin(t), v = std::cos(t);
    return {o.half_width * u, o.shear * u + o.half_height * v};
}

// Parameters at which a curve meets another.
void cut(const HalfPlane &a, const HalfPlane &b, std::vector<double> &cuts) {
    const double along = b.nx * a.ny - b.ny * a.nx;
    if (std::abs(along) > 1e-12)
        cuts.push_back(-depth(b, at(a, 0)) / along);
}
void cut(const HalfPlane &a, const Oval &b, std::vector<double> &cuts) {
    const Point p = at(a, 0), s = slope(a, 0);
    const double u = (p.x - b.x) / b.half_width, du = s.x / b.half_width;
    const double v = (p.y - b.y - b.shear * u) / b.half_height;
    const double dv = (s.y - b.shear * du) / b.half_height;
    const double square = du * du + dv * dv, middle = -(u * du + v * dv) / square;
    const double discriminant = middle * middle - (u * u + v * v - 1) / square;
    if (discriminant > 0)
        for (const double side : {-1.0, 1.0})
            cuts.push_back(middle + side * std::sqrt(discriminant));
}
void cut(const Oval &a, const HalfPlane &b, std::vector<double> &cuts) {
    const double cosine = b.nx * a.half_width + b.ny * a.shear, sine = b.ny * a.half_height;
    const double level = -depth(b, {a.x, a.y}) / std::hypot(cosine, sine);
    if (std::abs(level) < 1)
        for (const double side : {-1.0, 1.0})
            cuts.push_back(
                std::remainder(std::atan2(sine, cosine) + side * std::acos(level), 2 * pi));
}
void cut(const Oval &a, const Oval &b, std::vector<double> &cuts) {
    constexpr int steps = 1024; // two meetings in one step part a piece that does not matter
    const auto f = [&](double t) { return depth(b, at(a, t)); };
    double t0 = -pi, f0 = f(t0);
    for (int i = 1; i <= steps; ++i) {
        const double t1 = pi * (2.0 * i / steps - 1), f1 = f(t1);
        if ((f0 > 0) != (f1 > 0)) {
            double low = t0, high = t1;
            for (int k = 0; k < 50; ++k) {
                const double middle = (low + high) / 2;
                ((f(middle) > 0) == (f0 > 0) ? low : high) = middle;
            }
            cuts.push_back((low + high) / 2);
        }
        t0 = t1;
        f0 = f1;
    }
}

bool same(const HalfPlane &a, const HalfPlane &b) {
    return a.nx == b.nx && a.ny == b.ny && a.d == b.d;
}
bool same(const Oval &a, const Oval &b) {
    return a == b;
}
bool same(const auto &, const auto &) {
    return false;
}

std::vector<Bound> distinct_bounds(const LitPart &part) {
    std::vector<Bound> bounds;
    const auto collect = [&bounds](const std::vector<Bound> &some) {
        for (const Bound &bound : some)
            if (std::ranges::none_of(bounds, [&](const Bound &other) {
                    return std::visit([](const auto &a, const auto &b) { return same(a, b); },
                                      bound, other);
                }))
                bounds.push_back(bound);
    };
    collect(part.lit);
    for (const DarkShape &shape : part.dark) {
        collect(shape.inside);
        collect(shape.outside);
    }
    return bounds;
}

void add(PupilEdges &edges, const HalfPlane &h, double begin, double end, bool lit_left) {
    const Point a = at(h, lit_left ? begin : end), b = at(h, lit_left ? end : begin);
    edges.straight.push_back({a.x, a.y, b.x, b.y});
}
void add(PupilEdges &edges, const Oval &o, double begin, double end, bool lit_left) {
    edges.curved.push_back({o, begin, end, lit_left});
}

// The parts between cuts that light meets dark at; those that go on with each other are one.
template <class Curve>
void add_pieces(PupilEdges &edges, const LitPart &part, const Curve &curve,
                const std::vector<double> &cuts) {
    struct Piece {
        double begin, end;
        int side; // +1: lit on the left, -1: on the right
    };
    std::vector<Piece> pieces;
    for (size_t i = 0; i + 1 < cuts.size(); ++i) {
        const double middle = (cuts[i] + cuts[i + 1]) / 2;
        const Point p = at(curve, middle), s = slope(curve, middle);
        const double speed = std::hypot(s.x, s.y);
        if (cuts[i + 1] - cuts[i] < shortest)
            continue;
        const Point left{-s.y * aside / speed, s.x * aside / speed};
        const int side = static_cast<int>(lit(part, {p.x + left.x, p.y + left.y})) -
                         static_cast<int>(lit(part, {p.x - left.x, p.y - left.y}));
        if (side == 0)
            continue;
        if (!pieces.empty() && pieces.back().side == side && cuts[i] - pieces.back().end < shortest)
            pieces.back().end = cuts[i + 1];
        else
            pieces.push_back({cuts[i], cuts[i + 1], side});
    }
    // Round an oval, the last may go on with the first.
    if (pieces.size() > 1 && pieces.front().side == pieces.back().side &&
        pieces.front().begin + 2 * pi - pieces.back().end < shortest) {
        pieces.front().begin = pieces.back().begin - 2 * pi;
        pieces.pop_back();
    }
    for (const Piece &piece : pieces)
        add(edges, curve, piece.begin, piece.end, piece.side > 0);
}

} // namespace

PupilEdges pupil_edges(const std::vector<LitPart> &parts) {
    PupilEdges edges;
    for (const LitPart &part : parts) {
        const std::vector<Bound> bounds = distinct_bounds(part);
        for (const Bound &bound : bounds) {
            std::vector<double> cuts;
            for (const Bound &other : bounds)
                if (&other != &bound)
                    std::visit([&](const auto &a, const auto &b) { cut(a, b, cuts); }, bound,
                               other);
            std::ranges::sort(cuts);
            if (std::holds_alternative<Oval>(bound))
                cuts.push_back(cuts.empty() ? pi : cuts.front() + 2 * pi);
            if (cuts.size() == 1)
                cuts.insert(cuts.begin(), -pi);
            std::visit([&](const auto &curve) { add_pieces(edges, part, curve, cuts); }, bound);
        }
    }
    return edges;
}

std::vector<EdgeEnd> edge_ends(const PupilEdges &edges) {
    std::vector<EdgeEnd> ends;
    const auto add = [&](bool is_curved, size_t edge, bool at_begin, Point p, Point forward,
                         double lit, double radius) {
        const double speed = std::hypot(forward.x, forward.y), onto = at_begin ? 1 : -1;
        const double tx = forward.x / speed, ty = forward.y / speed;
        ends.push_back({is_curved, edge, at_begin, p.x, p.y, lit * ty, -lit * tx, onto * tx,
                        onto * ty, lit * radius});
    };
    for (size_t i = 0; i < edges.straight.size(); ++i) {
        const auto &[x0, y0, x1, y1] = edges.straight[i];
        const Point forward{x1 - x0, y1 - y0};
        add(false, i, true, {x0, y0}, forward, 1, INFINITY);
        add(false, i, false, {x1, y1}, forward, 1, INFINITY);
    }
    for (size_t i = 0; i < edges.curved.size(); ++i) {
        const CurvedEdge &edge = edges.curved[i];
        if (edge.closed())
            continue;
        const Oval &o = edge.oval;
        for (const bool at_begin : {true, false}) {
            const double angle = at_begin ? edge.begin : edge.end;
            const Point forward = slope(o, angle);
            const double speed = std::hypot(forward.x, forward.y);
            add(true, i, at_begin, at(o, angle), forward, edge.lit_inside ? 1 : -1,
                std::pow(speed, 3) / (o.half_width * o.half_height));
        }
    }
    return ends;
}

std::vector<Junction> junctions(const PupilEdges &edges) {
    constexpr double together = 1e-5; // m
    const std::vector<EdgeEnd> ends = edge_ends(edges);
    std::vector<Junction> out;
    for (const EdgeEnd &end : ends)
        for (const EdgeEnd &other : ends) {
            if (&end == &other || std::hypot(end.x - other.x, end.y - other.y) >= together)
                continue;
            const double along = end.tx * other.tx + end.ty * other.ty;
            const double across = end.tx * other.ty - end.ty * other.tx;
            out.push_back({end, other, std::abs(std::atan2(across, -along))});
        }
    return out;
}

std::vector<ArcOnwards> arcs_onwards(const PupilEdges &edges, double widest) {
    const std::vector<Junction> joined = junctions(edges);
    const auto is_short = [&edges](const EdgeEnd &of) {
        return edges.curved[of.edge].end - edges.curved[of.edge].begin < pi;
    };
    std::vector<ArcOnwards> arcs;
    for (const auto &[straight, first, kink] : joined) {
        if (straight.is_curved || !first.is_curved || kink >= widest)
            continue;
        arcs.push_back({straight.edge, first, false, kink});
        for (const EdgeEnd *arc = &first; arc != nullptr;) {
            const auto farther = std::ranges::find_if(joined, [&](const Junction &junction) {
                const EdgeEnd &end = junction.end;
                return end.is_curved && end.edge == arc->edge && end.at_begin != arc->at_begin;
            });
            arc = nullptr;
            if (farther == joined.end() || !is_short(farther->end))
                break;
            const auto &[end, other, turn] = *farther;
            if (end.nx * straight.nx + end.ny * straight.ny < std::cos(widest))
                break;
            arcs.push_back({straight.edge, end, true, INFINITY});
            if (!other.is_curved || turn >= widest)
                break;
            arc = &other;
            arcs.push_back({straight.edge, other, false, INFINITY});
        }
    }
    return arcs;
}

} // namespace wfpsf
