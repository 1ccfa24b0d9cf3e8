// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/pupil_nodes.hpp"

#include "error/error.hpp"
#include "numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

struct Point {
    double x, y;
    Point operator+(Point b) const { return {x + b.x, y + b.y}; }
    Point operator-(Point b) const { return {x - b.x, y - b.y}; }
    friend Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
};

double dot(Point a, Point b) {
    return a.x * b.x + a.y * b.y;
}
double cross(Point a, Point b) {
    return a.x * b.y - a.y * b.x;
}
Point centre(const Circle &c) {
    return {c.x, c.y};
}
double azimuth(Point a) {
    return std::atan2(a.y, a.x);
}

// The point of a circle at azimuth start + s * sweep, and its derivative by s.
struct Arc {
    Point centre;
    double radius, start, sweep;
    Point at(double s) const {
        const double a = start + s * sweep;
        return centre + radius * Point{std::cos(a), std::sin(a)};
    }
    Point slope(double s) const {
        const double a = start + s * sweep;
        return radius * sweep * Point{-std::sin(a), std::cos(a)};
    }
};

// The arc of a circle from p to q the short way round.
Arc short_arc(Point centre, double radius, Point p, Point q) {
    const double sweep = std::remainder(azimuth(q - centre) - azimuth(p - centre), 2 * pi);
    return {centre, radius, azimuth(p - centre), sweep};
}

// A segment's edge: lit where normal . x >= offset; `outward` runs along it, away from the axis.
struct Edge {
    Point normal, outward;
    double offset;
};

// Where an edge, moved by `inset` into the lit side, leaves a circle outwards.
Point crossing(const Edge &edge, double inset, Point c, double radius) {
    const double distance = edge.offset + inset - dot(edge.normal, c);
    const double square = radius * radius - distance * distance;
    if (!(square > 0))
        fail(WFPSF_ERROR_ARGUMENT, "pupil: a strut's edge misses a circle of radius %g m", radius);
    return c + distance * edge.normal + std::sqrt(square) * edge.outward;
}

// The quadrilateral between two arcs, ruled by straight lines: x(s, t) = (1-t) inner + t outer.
void add_ruled(NodeBatches &nodes, const Arc &inner, const Arc &outer, const GaussLegendre &along,
               const GaussLegendre &across) {
    for (size_t i = 0; i < along.x.size(); ++i) {
        const double s = (1 + along.x[i]) / 2;
        const Point a = inner.at(s), b = outer.at(s);
        const Point a_s = inner.slope(s), b_s = outer.slope(s);
        for (size_t k = 0; k < across.x.size(); ++k) {
            const double t = (1 + across.x[k]) / 2;
            const Point p = (1 - t) * a + t * b;
            const double jacobian = std::abs(cross((1 - t) * a_s + t * b_s, b - a));
            nodes.add(p.x, p.y, along.w[i] * across.w[k] / 4 * jacobian);
        }
    }
}

// The dark sliver between a sharp corner and the fillet that rounds it, subtracted. A Coons patch
// whose fourth side has shrunk to the corner: fillet(s) at t = 0, the straight edge at s = 0, the
// circle's arc at s = 1, the corner at t = 1. The patch may fold by a hair at the tangent points:
// the Jacobian keeps its sign there, and the folds cancel.
void subtract_sliver(NodeBatches &nodes, const Arc &fillet, const Arc &side, Point corner,
                     const GaussLegendre &rule) {
    const Point end = side.at(0);
    const double orientation = std::copysign(1, cross(end - fillet.at(0), corner - fillet.at(0)));
    for (size_t k = 0; k < rule.x.size(); ++k) {
        const double t = (1 + rule.x[k]) / 2;
        const Point bulge = side.at(t) - (1 - t) * end - t * corner;
        const Point bulge_t = side.slope(t) + end - corner;
        for (size_t i = 0; i < rule.x.size(); ++i) {
            const double s = (1 + rule.x[i]) / 2;
            const Point on_fillet = fillet.at(s);
            const Point p = (1 - t) * on_fillet + t * corner + s * bulge;
            const Point p_s = (1 - t) * fillet.slope(s) + bulge;
            const Point p_t = corner - on_fillet + s * bulge_t;
            nodes.add(p.x, p.y, -orientation * rule.w[i] * rule.w[k] / 4 * cross(p_s, p_t));
        }
    }
}

struct Rim {
    Circle circle;
    double side; // +1: the lit side is outside the circle, -1: inside
};

void subtract_corner(NodeBatches &nodes, const Edge &edge, const Rim &rim, double corner_radius,
                     const GaussLegendre &rule) {
    const Point c = centre(rim.circle);
    const double radius = rim.circle.radius;
    const double reach = radius + rim.side * corner_radius;
    const Point corner = crossing(edge, 0, c, radius);
    const Point fillet_centre = crossing(edge, corner_radius, c, reach);
    const Point on_edge = fillet_centre - corner_radius * edge.normal;
    const Point on_rim = c + (radius / reach) * (fillet_centre - c);
    subtract_sliver(nodes, short_arc(fillet_centre, corner_radius, on_edge, on_rim),
                    short_arc(c, radius, on_rim, corner), corner, rule);
}

} // namespace

NodeBatches::NodeBatches(const NodeSink &sink) : sink_(sink) {
    for (std::vector<double> *values : {&nodes_.x, &nodes_.y, &nodes_.weight})
        values->reserve(largest);
}

void NodeBatches::flush() {
    if (nodes_.size() > 0)
        sink_(nodes_);
    for (std::vector<double> *values : {&nodes_.x, &nodes_.y, &nodes_.weight})
        values->clear();
}

void pupil_nodes(const SegmentedPupil &pupil, double wavenumber, double eps, const NodeSink &sink) {
    const Rim outer{pupil.outer, -1}, inner{pupil.obscuration, 1};
    const double width = (pupil.outer.radius - pupil.obscuration.radius) / 2;
    GaussLegendreRules rules;
    const GaussLegendre &across = rules.of(gauss_legendre_points(wavenumber * width, eps));
    // All slivers together are a thousandth of the lit area.
    const GaussLegendre &corner = rules.of(
        2 + gauss_legendre_points(wavenumber * pupil.corner_radius, std::min(0.1, 1000 * eps)));
    NodeBatches nodes(sink);
    for (const PupilSegment &segment : pupil.segments) {
        const HalfPlane &cw = segment.clockwise_edge, &ccw = segment.counterclockwise_edge;
        const Point na{cw.nx, cw.ny}, nb{ccw.nx, ccw.ny};
        // The bisector of the two inward normals points away from the axis.
        const auto outward = [middle = na + nb](Point n) {
            const Point tangent{-n.y, n.x};
            return (dot(tangent, middle) > 0 ? 1.0 : -1.0) * tangent;
        };
        const Edge a{na, outward(na), cw.d}, b{nb, outward(nb), ccw.d};
        const auto arc = [&](const Circle &circle) {
            return short_arc(centre(circle), circle.radius,
                             crossing(a, 0, centre(circle), circle.radius),
                             crossing(b, 0, centre(circle), circle.radius));
        };
        const Arc outer_arc = arc(pupil.outer);
        const double half_length = std::abs(outer_arc.sweep) * outer_arc.radius / 2;
        const GaussLegendre &along = rules.of(gauss_legendre_points(wavenumber * half_length, eps));
        add_ruled(nodes, arc(pupil.obscuration), outer_arc, along, across);
        if (pupil.corner_radius > 0)
            for (const Edge &edge : {a, b})
                for (const Rim &rim : {inner, outer})
                    subtract_corner(nodes, edge, rim, pupil.corner_radius, corner);
    }
    nodes.flush();
}

void pupil_nodes(const AnnularPupil &pupil, double wavenumber, double eps, const NodeSink &sink) {
    const double width = (pupil.outer_radius - pupil.inner_radius) / 2;
    const GaussLegendre radial(gauss_legendre_points(wavenumber * width, eps));
    // Equal steps in angle err by the Bessel function of their count's order, like a Gauss rule of
    // half as many points.
    const int spokes = 2 * gauss_legendre_points(wavenumber * pupil.outer_radius, eps);
    NodeBatches nodes(sink);
    for (size_t i = 0; i < radial.x.size(); ++i) {
        const double r = pupil.inner_radius + width * (1 + radial.x[i]);
        const double weight = radial.w[i] * width * r * 2 * pi / spokes;
        for (int k = 0; k < spokes; ++k) {
            const double a = 2 * pi * k / spokes;
            nodes.add(r * std::cos(a), r * std::sin(a), weight);
        }
    }
    nodes.flush();
}

Box bounds(const SegmentedPupil &pupil) {
    const auto &[x, y, radius] = pupil.outer;
    return {x - radius, x + radius, y - radius, y + radius};
}

Box bounds(const AnnularPupil &pupil) {
    const double r = pupil.outer_radius;
    return {-r, r, -r, r};
}

} // namespace wfpsf
