// SPDX-License-Identifier: GPL-3.0-or-later
// Trapezoidal decomposition (de Berg et al., Computational Geometry, ch. 6) with curved sides:
// sweep along x; between two corners of the region, the same curves follow each other along y.
#include "optics/lit_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Point {
    double x, y;
};

// One curve of the region, by the number of its bound: an oval has two, a line one.
struct End {
    double y;
    int curve; // 2 * bound, + 1 for an oval's upper half
};
struct Interval {
    End low, high;
    bool empty() const { return !(high.y > low.y); }
};
constexpr int no_curve = -1;
constexpr Interval nothing{{infinity, no_curve}, {-infinity, no_curve}};

// sqrt(1 - u^2), the height of the unit circle.
double circle_height(double u) {
    return std::sqrt(std::max(0.0, (1 - u) * (1 + u)));
}

double height(const Oval &o, double x, bool upper_half) {
    const double u = (x - o.x) / o.half_width;
    return o.y + o.shear * u + (upper_half ? 1 : -1) * o.half_height * circle_height(u);
}
double height(const HalfPlane &h, double x, bool) {
    return (h.d - h.nx * x) / h.ny;
}

bool upright(const HalfPlane &h) {
    return std::abs(h.ny) < 1e-12;
}

// What a bound leaves of the line of constant x.
Interval cut(const Oval &o, double x, int bound) {
    if (std::abs(x - o.x) >= o.half_width)
        return nothing;
    return {{height(o, x, false), 2 * bound}, {height(o, x, true), 2 * bound + 1}};
}
Interval cut(const HalfPlane &h, double x, int bound) {
    constexpr Interval all{{-infinity, no_curve}, {infinity, no_curve}};
    if (upright(h))
        return h.nx * x >= h.d ? all : nothing;
    const End end{height(h, x, false), 2 * bound};
    return h.ny > 0 ? Interval{end, all.high} : Interval{all.low, end};
}

Interval meet(const Interval &a, const Interval &b) {
    return {a.low.y > b.low.y ? a.low : b.low, a.high.y < b.high.y ? a.high : b.high};
}

// How far inside a bound a point lies, in about the unit of length.
double depth(const Oval &o, Point p) {
    const double u = (p.x - o.x) / o.half_width;
    const double v = (p.y - o.y - o.shear * u) / o.half_height;
    return (1 - u * u - v * v) / 2 * std::min(o.half_width, o.half_height);
}
double depth(const HalfPlane &h, Point p) {
    return h.nx * p.x + h.ny * p.y - h.d;
}
double depth(const Bound &bound, Point p) {
    return std::visit([p](const auto &b) { return depth(b, p); }, bound);
}

// Points where two curves may meet. More than those that do is harmless: they part no cells.

void add_meetings(std::vector<Point> &points, const HalfPlane &a, const HalfPlane &b) {
    const double determinant = a.nx * b.ny - a.ny * b.nx;
    if (std::abs(determinant) > 1e-12)
        points.push_back(
            {(a.d * b.ny - a.ny * b.d) / determinant, (a.nx * b.d - a.d * b.nx) / determinant});
}

void add_meetings(std::vector<Point> &points, const Oval &o, const HalfPlane &h) {
    // The line in the coordinates (u, v) in which the oval is the unit circle.
    const double nu = h.nx * o.half_width + h.ny * o.shear, nv = h.ny * o.half_height;
    const double norm = std::hypot(nu, nv);
    const double d = (h.d - h.nx * o.x - h.ny * o.y) / norm;
    if (std::abs(d) > 1)
        return;
    for (const double along : {circle_height(d), -circle_height(d)}) {
        const double u = (nu * d - nv * along) / norm, v = (nv * d + nu * along) / norm;
        points.push_back({o.x + o.half_width * u, o.y + o.shear * u + o.half_height * v});
    }
}
void add_meetings(std::vector<Point> &points, const HalfPlane &h, const Oval &o) {
    add_meetings(points, o, h);
}

// |q(a)|^2 - 1 for the point at angle a of one oval, in the coordinates in which another is the
// unit circle, with its first two derivatives.
class Encounter {
  public:
    Encounter(const Oval &on, const Oval &unit)
        : middle_(in_unit(unit, {on.x - unit.x, on.y - unit.y})),
          cosine_(in_unit(unit, {on.half_width, on.shear})),
          sine_(in_unit(unit, {0, on.half_height})) {
        // Waves of number 1 and 2.
        const double difference = dot(cosine_, cosine_) - dot(sine_, sine_);
        largest_second_ = 2 * std::hypot(dot(middle_, cosine_), dot(middle_, sine_)) +
                          4 * std::hypot(difference / 2, dot(cosine_, sine_));
    }

    // Alike and concentric, the ovals meet nowhere or everywhere.
    bool constant() const { return largest_second_ < 1e-12; }

    // Every angle in centre +- half at which the function is zero, or nearly touches zero.
    void add_zeros(std::vector<double> &angles, double centre, double half) const {
        const auto [f, first, second] = at(centre);
        if (std::abs(f) > std::abs(first) * half + largest_second_ / 2 * half * half)
            return;
        if (half > 0.01) {
            add_zeros(angles, centre - half / 2, half / 2);
            add_zeros(angles, centre + half / 2, half / 2);
            return;
        }
        // A parabola, almost: its zeros, or its vertex; then Newton's iteration.
        const double root = std::sqrt(std::max(0.0, first * first - 2 * f * second));
        const double sum = first + std::copysign(root, first);
        for (const double step : {-sum / second, -2 * f / sum}) {
            if (!(std::abs(step) <= 2 * half))
                continue;
            double angle = centre + step;
            for (int i = 0; i < 4; ++i) {
                const Value v = at(angle);
                if (std::abs(v.f) < std::abs(v.first) * half)
                    angle -= v.f / v.first;
            }
            angles.push_back(angle);
        }
    }

  private:
    struct Value {
        double f, first, second;
    };
    static double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
    static Point in_unit(const Oval &unit, Point difference) {
        const double u = difference.x / unit.half_width;
        return {u, (difference.y - unit.shear * u) / unit.half_height};
    }
    Value at(double angle) const {
        const double c = std::cos(angle), s = std::sin(angle);
        const Point turning{c * cosine_.x + s * sine_.x, c * cosine_.y + s * sine_.y};
        const Point q{middle_.x + turning.x, middle_.y + turning.y};
        const Point slope{c * sine_.x - s * cosine_.x, c * sine_.y - s * cosine_.y};
        return {dot(q, q) - 1, 2 * dot(q, slope), 2 * (dot(slope, slope) - dot(q, turning))};
    }

    Point middle_, cosine_, sine_;
    double largest_second_;
};

void add_meetings(std::vector<Point> &points, const Oval &a, const Oval &b) {
    const Encounter encounter(a, b);
    if (encounter.constant())
        return;
    std::vector<double> angles;
    encounter.add_zeros(angles, 0, pi);
    for (const double angle : angles) {
        const double u = std::cos(angle);
        points.push_back(
            {a.x + a.half_width * u, a.y + a.shear * u + a.half_height * std::sin(angle)});
    }
}

class Sweep {
  public:
    explicit Sweep(const LitRegion &region) : region_(region) {
        for (const Bound &bound : region.lit)
            bounds_.push_back(bound);
        for (const std::vector<Bound> &shape : region.dark)
            bounds_.insert(bounds_.end(), shape.begin(), shape.end());
    }

    std::vector<Cell> cells() const {
        std::vector<Cell> done;
        std::map<std::pair<int, int>, Cell> open; // by their curves
        const std::vector<double> x = corners();
        for (size_t i = 0; i + 1 < x.size(); ++i) {
            std::map<std::pair<int, int>, Cell> now;
            for (const Interval &span : spans((x[i] + x[i + 1]) / 2)) {
                const std::pair key(span.low.curve, span.high.curve);
                Cell cell{x[i], x[i + 1], curve(key.first), curve(key.second)};
                if (const auto before = open.extract(key))
                    cell.x0 = before.mapped().x0;
                now.emplace(key, cell);
            }
            for (const auto &[key, cell] : open)
                done.push_back(cell);
            open = std::move(now);
        }
        for (const auto &[key, cell] : open)
            done.push_back(cell);
        return done;
    }

  private:
    // Abscissae between which no curve begins, ends or meets another along the lit region's edge.
    std::vector<double> corners() const {
        std::vector<Point> points;
        for (size_t i = 0; i < bounds_.size(); ++i) {
            if (const Oval *o = std::get_if<Oval>(&bounds_[i]))
                for (const double side : {-1.0, 1.0})
                    points.push_back({o->x + side * o->half_width, o->y + side * o->shear});
            for (size_t k = 0; k < i; ++k)
                std::visit([&](const auto &a, const auto &b) { add_meetings(points, a, b); },
                           bounds_[i], bounds_[k]);
        }
        std::erase_if(points, [this](Point p) { return !on_edge(p); });
        std::vector<double> x;
        x.reserve(points.size());
        for (const Point &p : points)
            x.push_back(p.x);
        std::ranges::sort(x);
        // One corner may have been found from several pairs of curves.
        const auto again = [](double a, double b) { return b - a < 1e-13; };
        x.erase(std::unique(x.begin(), x.end(), again), x.end());
        return x;
    }

    // Neither in the dark nor outside. Points that lie so by rounding only are kept.
    bool on_edge(Point p) const {
        constexpr double rounding = 1e-10;
        for (const Bound &bound : region_.lit)
            if (depth(bound, p) < -rounding)
                return false;
        for (const std::vector<Bound> &shape : region_.dark)
            if (std::ranges::all_of(shape, [p](const Bound &b) { return depth(b, p) > rounding; }))
                return false;
        return true;
    }

    // The lit parts of the line of constant x, upwards.
    std::vector<Interval> spans(double x) const {
        int bound = 0;
        const auto common = [&](const std::vector<Bound> &shape, Interval within) {
            for (const Bound &b : shape) {
                const Interval part =
                    std::visit([&](const auto &c) { return cut(c, x, bound); }, b);
                within = meet(within, part);
                ++bound;
            }
            return within;
        };
        constexpr Interval all{{-infinity, no_curve}, {infinity, no_curve}};
        const Interval lit = common(region_.lit, all);
        std::vector<Interval> dark;
        for (const std::vector<Bound> &shape : region_.dark)
            if (const Interval part = common(shape, all); !part.empty())
                dark.push_back(part);
        std::ranges::sort(dark, {}, [](const Interval &i) { return i.low.y; });
        std::vector<Interval> spans;
        End begin = lit.low;
        for (const Interval &part : dark) {
            const Interval gap = meet(lit, {begin, part.low});
            if (!gap.empty())
                spans.push_back({begin, gap.high});
            if (part.high.y > begin.y)
                begin = part.high;
        }
        if (lit.high.y > begin.y)
            spans.push_back({begin, lit.high});
        return spans;
    }

    Cell::Curve curve(int number) const {
        return {bounds_[static_cast<size_t>(number / 2)], number % 2 == 1};
    }

    const LitRegion &region_;
    std::vector<Bound> bounds_; // all of the region's, in the order of their numbers
};

} // namespace

double Cell::Curve::at(double x) const {
    return std::visit([&](const auto &b) { return height(b, x, upper_half); }, bound);
}

std::array<HalfPlane, 3> sides(const Strut &s) {
    return {HalfPlane{s.nx, s.ny, s.offset - s.width / 2},
            HalfPlane{-s.nx, -s.ny, -s.offset - s.width / 2}, HalfPlane{-s.ny, s.nx, 0}};
}

std::vector<Cell> lit_cells(const LitRegion &region) {
    return Sweep(region).cells();
}

} // namespace wfpsf
