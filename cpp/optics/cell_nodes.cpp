// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature over cells: along x in a variable in which their curves are smooth, and along y.
#include "numerics/quadrature.hpp"
#include "optics/lit_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Point {
    double x, y;
};

// The substitution that makes a cell's curves smooth. Where an oval turns back they have the root
// of a distance, which x = middle - half cos t takes away if middle +- half are the turning points
// nearest to the cell; without ovals, x is t.
class Abscissa {
  public:
    explicit Abscissa(const Cell &cell) {
        double left = -infinity, right = infinity;
        for (const Cell::Curve &curve : {cell.lower, cell.upper})
            if (const Oval *o = std::get_if<Oval>(&curve.bound)) {
                left = std::max(left, o->x - o->half_width);
                right = std::min(right, o->x + o->half_width);
            }
        linear_ = left == -infinity;
        if (!linear_) {
            middle_ = (left + right) / 2;
            half_ = (right - left) / 2;
        }
        begin_ = t_of(cell.x0);
        end_ = t_of(cell.x1);
        for (const Cell::Curve &curve : {cell.lower, cell.upper})
            if (const Oval *o = std::get_if<Oval>(&curve.bound)) {
                see_branch_point(0, (middle_ - o->x + o->half_width) / half_);
                see_branch_point(pi, (o->x + o->half_width - middle_) / half_);
            }
    }
    double begin() const { return begin_; }
    double end() const { return end_; }
    double at(double t) const { return linear_ ? t : middle_ - half_ * std::cos(t); }
    double slope(double t) const { return linear_ ? 1 : half_ * std::sin(t); }
    // Turns of the curves' own, by t: an oval's height and the slope are waves of number 1 in t.
    double own_wavenumber() const { return linear_ ? 0 : 2; }

    // A Gauss rule of n points errs by exp(-2 n decay) because of the turning points that are left.
    double decay() const { return decay_; }

  private:
    // The turning point at `distance` halves from the middle stands in complex t, unless it is
    // gone.
    void see_branch_point(double side, double distance) {
        if (distance < 1 + 1e-12)
            return;
        const std::complex<double> t(side - (begin_ + end_) / 2, std::acosh(distance));
        // The sum of the half axes of the ellipse about -1 and 1 that it stands on (Bernstein).
        decay_ = std::min(decay_, std::abs(std::acosh(t / ((end_ - begin_) / 2)).real()));
    }
    double t_of(double x) const {
        return linear_ ? x : std::acos(std::clamp((middle_ - x) / half_, -1.0, 1.0));
    }
    bool linear_;
    double middle_ = 0, half_ = 0, begin_, end_, decay_ = infinity;
};

// Length of the longest step of a cell's curve, of `steps` equal ones in t, and the cell's area.
constexpr int steps = 8;
struct Extent {
    double longest_step = 0, area = 0;
};
Extent extent(const Cell &cell, const Abscissa &abscissa) {
    Extent extent;
    std::array<Point, 2> before{};
    for (int i = 0; i <= steps; ++i) {
        const double x = abscissa.at(
            std::lerp(abscissa.begin(), abscissa.end(), static_cast<double>(i) / steps));
        const std::array<Point, 2> now{Point{x, cell.lower.at(x)}, Point{x, cell.upper.at(x)}};
        if (i > 0) {
            for (size_t k = 0; k < 2; ++k)
                extent.longest_step =
                    std::max(extent.longest_step,
                             std::hypot(now[k].x - before[k].x, now[k].y - before[k].y));
            extent.area +=
                (now[0].x - before[0].x) / 2 * (now[1].y - now[0].y + before[1].y - before[0].y);
        }
        before = now;
    }
    return extent;
}

} // namespace

void pupil_nodes(const std::vector<Cell> &cells, double wavenumber, double eps,
                 const NodeSink &sink) {
    std::vector<Abscissa> abscissae;
    std::vector<Extent> extents;
    abscissae.reserve(cells.size());
    extents.reserve(cells.size());
    double area = 0;
    for (const Cell &cell : cells) {
        abscissae.emplace_back(cell);
        extents.push_back(extent(cell, abscissae.back()));
        area += extents.back().area;
    }
    GaussLegendreRules rules;
    NodeBatches nodes(sink);
    for (size_t c = 0; c < cells.size(); ++c) {
        const Cell &cell = cells[c];
        const Abscissa &abscissa = abscissae[c];
        // A small cell may be worse.
        const double share = std::max(extents[c].area / area, 1e-12);
        const double tolerance = std::min(0.1, eps / share);
        const double middle = (abscissa.begin() + abscissa.end()) / 2;
        const double half = (abscissa.end() - abscissa.begin()) / 2;
        const double turns =
            wavenumber * extents[c].longest_step * steps / 2 + abscissa.own_wavenumber() * half;
        // One point more than a wave needs: cells end in a point or on an oval's turn, where their
        // own width varies most and they hold least.
        const int for_wave = gauss_legendre_points(turns, tolerance) + 1;
        const double for_branches = turns / 2 - std::log(tolerance) / (2 * abscissa.decay()) + 1;
        const GaussLegendre &along =
            rules.of(std::max(for_wave, static_cast<int>(std::ceil(for_branches))));
        for (size_t i = 0; i < along.x.size(); ++i) {
            const double t = middle + half * along.x[i];
            const double x = abscissa.at(t);
            const double low = cell.lower.at(x), high = cell.upper.at(x);
            const double mid_y = (low + high) / 2, half_y = (high - low) / 2;
            const GaussLegendre &across =
                rules.of(gauss_legendre_points(wavenumber * half_y, tolerance));
            const double weight = along.w[i] * half * abscissa.slope(t) * half_y;
            for (size_t k = 0; k < across.x.size(); ++k)
                nodes.add(x, mid_y + half_y * across.x[k], weight * across.w[k]);
        }
    }
    nodes.flush();
}

Box bounds(const std::vector<Cell> &cells) {
    Box box{infinity, -infinity, infinity, -infinity};
    for (const Cell &cell : cells) {
        box.x0 = std::min(box.x0, cell.x0);
        box.x1 = std::max(box.x1, cell.x1);
        for (const Cell::Curve &curve : {cell.lower, cell.upper}) {
            double low = std::min(curve.at(cell.x0), curve.at(cell.x1));
            double high = std::max(curve.at(cell.x0), curve.at(cell.x1));
            if (const Oval *o = std::get_if<Oval>(&curve.bound)) {
                const double reach = std::hypot(o->shear, o->half_height);
                low = o->y - reach;
                high = o->y + reach;
            }
            box.y0 = std::min(box.y0, low);
            box.y1 = std::max(box.y1, high);
        }
    }
    return box;
}

} // namespace wfpsf
