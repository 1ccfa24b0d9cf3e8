// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/roman_region.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wfpsf {

namespace {

struct Vector {
    double x, y;
};

// (1 - p) x^2 - 2 q x y + (1 + p) y^2 and the like.
struct Quadratic {
    double xx, xy, yy;
};

// Where (v - centre)' Q (v - centre) <= 1.
Oval oval(Vector centre, const Quadratic &q) {
    const double determinant = q.xx * q.yy - q.xy * q.xy;
    const double half_width = std::sqrt(q.yy / determinant);
    return {centre.x, centre.y, half_width, -q.xy / q.yy * half_width, 1 / std::sqrt(q.yy)};
}

// x = c + S X, by the inverse of S: the root of the primary's matrix, over its radius.
class Map {
  public:
    explicit Map(const Ellipse &primary) : centre_{primary.x, primary.y} {
        const double p = primary.p, q = primary.q;
        const double root = std::sqrt(1 - p * p - q * q); // of Q's determinant
        const double scale = primary.radius * std::sqrt(2 + 2 * root);
        inverse_ = {(1 - p + root) / scale, -q / scale, (1 + p + root) / scale};
    }

    Oval image(const Ellipse &e) const {
        const double r2 = e.radius * e.radius;
        const Quadratic q{(1 - e.p) / r2, -e.q / r2, (1 + e.p) / r2};
        const Vector a = through_inverse({q.xx, q.xy}), b = through_inverse({q.xy, q.yy});
        const auto &[xx, xy, yy] = inverse_;
        return oval(image(Vector{e.x, e.y}),
                    {xx * a.x + xy * b.x, xx * a.y + xy * b.y, xy * a.y + yy * b.y});
    }
    Oval image(const Circle &c) const { return image(Ellipse{c.x, c.y, c.radius, 0, 0}); }

    HalfPlane image(const HalfPlane &h) const {
        const Vector n = through_inverse({h.nx, h.ny});
        const double norm = std::hypot(n.x, n.y);
        return {n.x / norm, n.y / norm, (h.d + n.x * centre_.x + n.y * centre_.y) / norm};
    }

  private:
    Vector through_inverse(Vector v) const {
        return {inverse_.xx * v.x + inverse_.xy * v.y, inverse_.xy * v.x + inverse_.yy * v.y};
    }
    Vector image(Vector v) const {
        const auto &[xx, xy, yy] = inverse_;
        const double determinant = xx * yy - xy * xy;
        return {centre_.x + (yy * v.x - xy * v.y) / determinant,
                centre_.y + (xx * v.y - xy * v.x) / determinant};
    }
    Vector centre_;
    Quadratic inverse_;
};

std::vector<Bound> bar(const Map &map, const Strut &s) {
    const auto &[left, right, begin] = sides(s);
    return {map.image(left), map.image(right), map.image(begin)};
}

// The line from the disc's centre to where a strut's middle passes the radius at which the
// published masks cut the enlarged disc; `side` +1 keeps what lies counterclockwise of it. The
// struts hide it.
HalfPlane wedge_side(const Strut &strut, const Circle &disc, double side) {
    constexpr double cut_radius = 0.32;
    const double along = std::sqrt(cut_radius * cut_radius - strut.offset * strut.offset);
    const double x = strut.nx * strut.offset - strut.ny * along - disc.x;
    const double y = strut.ny * strut.offset + strut.nx * along - disc.y;
    const double nx = -side * y / std::hypot(x, y), ny = side * x / std::hypot(x, y);
    return {nx, ny, nx * disc.x + ny * disc.y};
}

void add_mask(LitRegion &region, const Map &map, const LongWaveMask &mask, const auto &) {
    region.lit.emplace_back(map.image(mask.outer));
    region.dark.push_back({map.image(mask.inner)});
}

void add_mask(LitRegion &region, const Map &map, const ShortWaveMask &mask, const auto &struts) {
    const Circle &disc = mask.lower;
    const Circle enlarged{disc.x, disc.y, mask.enlarged_radius};
    region.dark.push_back({map.image(mask.upper)});
    region.dark.push_back({map.image(disc)});
    for (const auto &[from, to] : {std::pair(1, 2), std::pair(3, 4), std::pair(5, 0)})
        region.dark.push_back({map.image(enlarged), map.image(wedge_side(struts[from], disc, 1)),
                               map.image(wedge_side(struts[to], disc, -1))});
}

} // namespace

LitRegion lit_region(const RomanPupil &pupil) {
    const Map map(pupil.primary);
    LitRegion region;
    region.lit = {map.image(Circle{0, 0, 1}), map.image(pupil.vignetting)};
    if (const auto &clip = pupil.clip)
        for (const auto &[nx, ny] : {std::pair(1.0, 0.0), std::pair(0.0, 1.0)}) {
            region.lit.emplace_back(HalfPlane{nx, ny, clip->low});
            region.lit.emplace_back(HalfPlane{-nx, -ny, -clip->high});
        }
    std::visit([&](const auto &mask) { add_mask(region, map, mask, pupil.telescope_struts); },
               pupil.mask);
    for (const auto &struts : {pupil.telescope_struts, pupil.mask_struts})
        for (const Strut &strut : struts)
            region.dark.push_back(bar(map, strut));
    return region;
}

double extent(const RomanPupil &pupil) {
    const Oval primary = Map(pupil.primary).image(Circle{0, 0, 1});
    return 2 * std::max(primary.half_width, std::hypot(primary.shear, primary.half_height));
}

} // namespace wfpsf
