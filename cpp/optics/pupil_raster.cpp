// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of constant x are cut into lit spans by interval algebra. Where the same curves bound the
// spans at both ends and in the middle of a step in x, each curve's area above the rows of pixels
// is known in closed form; elsewhere the step is halved.
#include "optics/pupil_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace wfpsf {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// ------------------------------------------------------------------------------- curves, in pixels

double root(double square) {
    return std::sqrt(std::max(0.0, square));
}

// A bound's edge as y(x): a line, or one half of an oval (side +1: the upper one).
struct Curve {
    const Bound *bound = nullptr;
    double side = 0;
    bool operator==(const Curve &) const = default;

    double y(double x) const {
        if (const auto *line = std::get_if<HalfPlane>(bound))
            return (line->d - line->nx * x) / line->ny;
        const Oval &o = std::get<Oval>(*bound);
        const double u = (x - o.x) / o.half_width;
        return o.y + o.shear * u + side * o.half_height * root((1 - u) * (1 + u));
    }

    // Integral of y over x, up to a constant.
    double antiderivative(double x) const {
        if (const auto *line = std::get_if<HalfPlane>(bound))
            return (line->d - line->nx * x / 2) * x / line->ny;
        const Oval &o = std::get<Oval>(*bound);
        const double u = std::clamp((x - o.x) / o.half_width, -1.0, 1.0);
        return o.half_width *
               (u * (o.y + o.shear * u / 2) +
                side * o.half_height / 2 * (u * root((1 - u) * (1 + u)) + std::asin(u)));
    }

    // The two x at which the whole line or oval has this y.
    std::array<double, 2> x_at(double level) const {
        if (const auto *line = std::get_if<HalfPlane>(bound)) {
            const double x = (line->d - line->ny * level) / line->nx;
            return {x, x};
        }
        // (v - shear u)^2 = half_height^2 (1 - u^2)
        const Oval &o = std::get<Oval>(*bound);
        const double v = level - o.y, norm = std::hypot(o.shear, o.half_height);
        const double middle = o.shear * v / (norm * norm);
        const double half = o.half_height / norm * root((1 - v / norm) * (1 + v / norm));
        return {o.x + o.half_width * (middle - half), o.x + o.half_width * (middle + half)};
    }

    // Lowest and highest y over a step.
    std::pair<double, double> range(double x0, double x1) const {
        auto [low, high] = std::minmax({y(x0), y(x1)});
        if (const Oval *o = std::get_if<Oval>(bound)) {
            const double norm = std::hypot(o->shear, o->half_height);
            const double turn = o->x + o->half_width * side * o->shear / norm;
            if (turn > x0 && turn < x1)
                (side > 0 ? high : low) = o->y + side * norm;
        }
        return {low, high};
    }
};

// ------------------------------------------------------------------------------------------- spans

struct End {
    double y;
    Curve curve;
};
struct Span {
    End low, high;
    bool empty() const { return !(high.y > low.y); }
};
using Spans = std::vector<Span>;
constexpr Span everything{{-infinity, {}}, {infinity, {}}};
constexpr Span nothing{{infinity, {}}, {-infinity, {}}};

// What a bound leaves of the line of constant x.
Span cut(const Bound &bound, double x) {
    if (const auto *line = std::get_if<HalfPlane>(&bound)) {
        if (std::abs(line->ny) < 1e-12)
            return line->nx * x >= line->d ? everything : nothing;
        const Curve curve{&bound, 0};
        const End end{curve.y(x), curve};
        return line->ny > 0 ? Span{end, everything.high} : Span{everything.low, end};
    }
    const Oval &o = std::get<Oval>(bound);
    if (std::abs(x - o.x) >= o.half_width)
        return nothing;
    const Curve lower{&bound, -1}, upper{&bound, 1};
    return {{lower.y(x), lower}, {upper.y(x), upper}};
}

Span common(const std::vector<Bound> &bounds, double x) {
    Span all = everything;
    for (const Bound &bound : bounds) {
        const Span one = cut(bound, x);
        if (one.low.y > all.low.y)
            all.low = one.low;
        if (one.high.y < all.high.y)
            all.high = one.high;
        if (all.empty())
            break;
    }
    return all;
}

void subtract(Spans &spans, const Span &dark) {
    if (dark.empty())
        return;
    for (size_t i = spans.size(); i-- > 0;) {
        const Span whole = spans[i];
        if (dark.high.y <= whole.low.y || dark.low.y >= whole.high.y)
            continue;
        const Span below{whole.low, dark.low}, above{dark.high, whole.high};
        const auto place = spans.begin() + static_cast<ptrdiff_t>(i);
        if (!below.empty() && !above.empty()) {
            *place = below;
            spans.insert(place + 1, above);
        } else if (!below.empty() || !above.empty()) {
            *place = below.empty() ? above : below;
        } else {
            spans.erase(place);
        }
    }
}

// Upwards.
Spans lit_spans(const LitPart &part, double x) {
    Spans lit;
    const Span whole = common(part.lit, x);
    if (whole.empty())
        return lit;
    lit.push_back(whole);
    for (const DarkShape &shape : part.dark) {
        const Span inside = common(shape.inside, x);
        if (inside.empty())
            continue;
        Spans dark{inside};
        for (const Bound &bound : shape.outside)
            subtract(dark, cut(bound, x));
        for (const Span &span : dark)
            subtract(lit, span);
    }
    return lit;
}

bool alike(const Spans &a, const Spans &b) {
    return std::ranges::equal(a, b, [](const Span &s, const Span &t) {
        return s.low.curve == t.low.curve && s.high.curve == t.high.curve;
    });
}

// ------------------------------------------------------------------------------------------ pixels

// A few neighbouring columns, so that what is summed on the way stays in the cache. Positions count
// from the corner of the image's first pixel: pixel i is i..i+1.
class Strip {
  public:
    static constexpr int64_t columns = 8;

    Strip(int64_t first, int64_t nx, int64_t ny)
        : first_(first), count_(std::min(columns, nx - first)), image_nx_(nx), sums_(columns, ny) {}

    void add(const LitPart &part) {
        // However many pixels there are, nothing wider than a step is overlooked.
        constexpr int64_t least_steps = 8192;
        const int64_t per_pixel = std::max<int64_t>(2, least_steps / image_nx_);
        const auto x_at = [&](int64_t step) {
            return static_cast<double>(step) / static_cast<double>(per_pixel);
        };
        const int64_t begin = first_ * per_pixel, end = (first_ + count_) * per_pixel;
        Spans before = lit_spans(part, x_at(begin));
        for (int64_t step = begin; step < end; ++step) {
            const double x0 = x_at(step), x1 = x_at(step + 1);
            Spans after = lit_spans(part, x1);
            add_step(part, step / per_pixel, x0, before, x1, after);
            before = std::move(after);
        }
    }

    void store(PupilRaster &out) const {
        std::array<double, columns> width{}, width_x{}; // of the curves above
        for (int64_t y = sums_.ny(); y-- > 0;)
            for (int64_t i = 0; i < count_; ++i) {
                const Sums &s = sums_(i, y);
                double &w = width[static_cast<size_t>(i)], &wx = width_x[static_cast<size_t>(i)];
                const double lit = std::clamp(s.area + w, 0.0, 1.0);
                out.lit(first_ + i, y) = lit;
                if (lit > 0) {
                    out.centroid_x(first_ + i, y) = std::clamp((s.x + wx) / lit - 0.5, -0.5, 0.5);
                    out.centroid_y(first_ + i, y) =
                        std::clamp((s.y + w / 2) / lit - 0.5, -0.5, 0.5);
                }
                w += s.width;
                wx += s.width_x;
            }
    }

  private:
    void add_step(const LitPart &part, int64_t column, double x0, const Spans &left, double x1,
                  const Spans &right) {
        constexpr double narrowest = 1e-9;
        if (left.empty() && right.empty())
            return;
        const double x = (x0 + x1) / 2;
        const Spans middle = lit_spans(part, x);
        if (x1 - x0 > narrowest && !(alike(left, middle) && alike(middle, right))) {
            add_step(part, column, x0, left, x, middle);
            add_step(part, column, x, middle, x1, right);
            return;
        }
        for (const Span &span : middle) {
            add_curve(span.high.curve, column, x0, x1, 1);
            add_curve(span.low.curve, column, x0, x1, -1);
        }
    }

    // The area below a curve, over a step in one column.
    void add_curve(const Curve &curve, int64_t column, double x0, double x1, double sign) {
        const auto [low, high] = curve.range(x0, x1);
        borders_ = {x0, x1};
        const auto rows = static_cast<double>(sums_.ny());
        const auto lowest = static_cast<int64_t>(std::ceil(std::clamp(low, 0.0, rows)));
        const auto highest = static_cast<int64_t>(std::floor(std::clamp(high, 0.0, rows)));
        for (int64_t level = lowest; level <= highest; ++level)
            for (const double x : curve.x_at(static_cast<double>(level)))
                if (x > x0 && x < x1)
                    borders_.push_back(x);
        std::ranges::sort(borders_);
        for (size_t i = 0; i + 1 < borders_.size(); ++i) {
            const double begin = borders_[i], end = borders_[i + 1];
            const double middle = (begin + end) / 2, half = (end - begin) / 2;
            const auto row = static_cast<int64_t>(
                std::clamp(std::floor(curve.y(middle)), 0.0, static_cast<double>(sums_.ny() - 1)));
            const auto floor = static_cast<double>(row), left = static_cast<double>(column);
            Sums &sums = sums_(column - first_, row);
            sums.area +=
                sign * (curve.antiderivative(end) - curve.antiderivative(begin) - 2 * half * floor);
            sums.width += sign * 2 * half;
            sums.width_x += sign * 2 * half * (middle - left);
            for (const double t : {-std::numbers::inv_sqrt3, std::numbers::inv_sqrt3}) {
                const double x = middle + half * t, height = curve.y(x) - floor;
                sums.x += sign * half * height * (x - left);
                sums.y += sign * half * height * height / 2;
            }
        }
    }

    // Over the points below the curves that cross a pixel, from its corner: area and first moments,
    // these by two Gauss points. And of the curves' widths alone, for the pixels below.
    struct Sums {
        double area = 0, x = 0, y = 0, width = 0, width_x = 0;
    };
    int64_t first_, count_, image_nx_;
    Plane<Sums> sums_;
    std::vector<double> borders_;
};

// ------------------------------------------------------------------------------------------ shapes

struct Vector {
    double x, y;
    Vector operator+(Vector b) const { return {x + b.x, y + b.y}; }
    Vector operator-(Vector b) const { return {x - b.x, y - b.y}; }
    friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y}; }
    double length() const { return std::hypot(x, y); }
};
double dot(Vector a, Vector b) {
    return a.x * b.x + a.y * b.y;
}

Oval oval(Vector centre, double radius) {
    return {centre.x, centre.y, radius, 0, radius};
}
Oval oval(const Circle &c) {
    return oval({c.x, c.y}, c.radius);
}

HalfPlane beyond(Vector point, Vector normal) {
    const Vector n = 1 / normal.length() * normal;
    return {n.x, n.y, dot(n, point)};
}

// What the rounding takes from the corner of an edge and a rim, the lit side of which is outside
// (+1) or inside (-1): the corner beyond the chord between the fillet's tangent points, less the
// fillet's disc.
DarkShape corner(const HalfPlane &edge, Vector outward, const Circle &rim, double side,
                 double corner_radius) {
    const Vector normal{edge.nx, edge.ny}, centre{rim.x, rim.y};
    const auto crossing = [&](double inset, double radius) {
        const double distance = edge.d + inset - dot(normal, centre);
        return centre + distance * normal + root(radius * radius - distance * distance) * outward;
    };
    const double reach = rim.radius + side * corner_radius;
    const Vector tip = crossing(0, rim.radius), fillet = crossing(corner_radius, reach);
    const Vector on_edge = fillet - corner_radius * normal;
    const Vector on_rim = centre + rim.radius / reach * (fillet - centre);
    const Vector chord = on_rim - on_edge;
    Vector across{-chord.y, chord.x};
    if (dot(across, tip - on_edge) < 0)
        across = -1 * across;
    const double near = 1.2 * std::max((tip - on_edge).length(), (tip - on_rim).length());
    return {{oval(tip, near), beyond(on_edge, across)}, {oval(fillet, corner_radius)}};
}

// Lengths times `zoom`, then everything moved.
Bound moved(const Bound &bound, double zoom, Vector by) {
    if (const auto *h = std::get_if<HalfPlane>(&bound))
        return HalfPlane{h->nx, h->ny, zoom * h->d + h->nx * by.x + h->ny * by.y};
    const Oval &o = std::get<Oval>(bound);
    return Oval{zoom * o.x + by.x, zoom * o.y + by.y, zoom * o.half_width, zoom * o.shear,
                zoom * o.half_height};
}

LitPart moved(LitPart part, double zoom, Vector by) {
    const auto move_all = [&](std::vector<Bound> &bounds) {
        for (Bound &bound : bounds)
            bound = moved(bound, zoom, by);
    };
    move_all(part.lit);
    for (DarkShape &shape : part.dark) {
        move_all(shape.inside);
        move_all(shape.outside);
    }
    return part;
}

// That holds the ovals of all parts.
struct Box {
    Vector low{infinity, infinity}, high{-infinity, -infinity};
};

Box bounding_box(const std::vector<LitPart> &parts) {
    Box all;
    for (const LitPart &part : parts) {
        Box one{{-infinity, -infinity}, {infinity, infinity}};
        for (const Bound &bound : part.lit)
            if (const Oval *o = std::get_if<Oval>(&bound)) {
                const double height = std::hypot(o->shear, o->half_height);
                one.low = {std::max(one.low.x, o->x - o->half_width),
                           std::max(one.low.y, o->y - height)};
                one.high = {std::min(one.high.x, o->x + o->half_width),
                            std::min(one.high.y, o->y + height)};
            }
        all.low = {std::min(all.low.x, one.low.x), std::min(all.low.y, one.low.y)};
        all.high = {std::max(all.high.x, one.high.x), std::max(all.high.y, one.high.y)};
    }
    return all;
}

} // namespace

std::vector<LitPart> lit_parts(const SegmentedPupil &pupil) {
    std::vector<LitPart> parts;
    for (const PupilSegment &segment : pupil.segments) {
        const HalfPlane &a = segment.clockwise_edge, &b = segment.counterclockwise_edge;
        const Vector middle{a.nx + b.nx, a.ny + b.ny};
        LitPart part{
            {oval(pupil.outer), a, b, beyond({pupil.obscuration.x, pupil.obscuration.y}, middle)},
            {{{oval(pupil.obscuration)}, {}}}};
        if (pupil.corner_radius > 0)
            for (const HalfPlane &edge : {a, b}) {
                const Vector along{-edge.ny, edge.nx};
                const Vector outward = dot(along, middle) > 0 ? along : -1 * along;
                part.dark.push_back(corner(edge, outward, pupil.outer, -1, pupil.corner_radius));
                part.dark.push_back(
                    corner(edge, outward, pupil.obscuration, 1, pupil.corner_radius));
            }
        parts.push_back(part);
    }
    return parts;
}

std::vector<LitPart> lit_parts(const AnnularPupil &pupil) {
    LitPart part{{oval({0, 0}, pupil.outer_radius)}, {}};
    if (pupil.inner_radius > 0)
        part.dark.push_back({{oval({0, 0}, pupil.inner_radius)}, {}});
    return {part};
}

std::vector<LitPart> lit_parts(const LitRegion &region) {
    LitPart part{region.lit, {}};
    for (const std::vector<Bound> &shape : region.dark)
        part.dark.push_back({shape, {}});
    return {part};
}

PupilRaster raster(const std::vector<LitPart> &parts, int64_t nx, int64_t ny) {
    const auto [low, high] = bounding_box(parts);
    const double side = std::max(high.x - low.x, high.y - low.y);
    const double zoom = static_cast<double>(std::min(nx, ny)) / side;
    const Vector middle{static_cast<double>(nx) / 2, static_cast<double>(ny) / 2};
    const Vector axis = middle - zoom / 2 * (low + high);
    std::vector<LitPart> in_pixels;
    in_pixels.reserve(parts.size());
    for (const LitPart &part : parts)
        in_pixels.push_back(moved(part, zoom, axis));
    PupilRaster out{Plane<double>(nx, ny), Plane<double>(nx, ny), Plane<double>(nx, ny)};
    for (int64_t first = 0; first < nx; first += Strip::columns) {
        Strip strip(first, nx, ny);
        for (const LitPart &part : in_pixels)
            strip.add(part);
        strip.store(out);
    }
    out.scale = 1 / zoom;
    out.axis_x = axis.x - 0.5;
    out.axis_y = axis.y - 0.5;
    return out;
}

} // namespace wfpsf
