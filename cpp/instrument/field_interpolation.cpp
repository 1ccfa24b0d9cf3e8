// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/field_interpolation.hpp"

#include "error/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace wfpsf {
namespace {

using Weights = std::array<double, 5>; // of the field points

// The rectangle that just holds the field points.
struct Rectangle {
    double x_low, x_high, y_low, y_high;
    double u(double x) const { return (x - x_low) / (x_high - x_low); } // 0..1 inside
    double v(double y) const { return (y - y_low) / (y_high - y_low); }
};

Rectangle bounds(std::span<const FieldPoint> points) {
    const auto by_x = [](const FieldPoint &p) { return p.x_pix; };
    const auto by_y = [](const FieldPoint &p) { return p.y_pix; };
    return {std::ranges::min(points, {}, by_x).x_pix, std::ranges::max(points, {}, by_x).x_pix,
            std::ranges::min(points, {}, by_y).y_pix, std::ranges::max(points, {}, by_y).y_pix};
}

// Bilinear in the rectangle, each corner point taken as standing in the corner next to it.
Weights corner_weights(std::span<const FieldPoint> points, double x, double y) {
    const Rectangle r = bounds(points);
    const double u = r.u(x), v = r.v(y);
    Weights weights{};
    for (size_t i = 1; i < weights.size(); ++i)
        weights[i] =
            (r.u(points[i].x_pix) > 0.5 ? u : 1 - u) * (r.v(points[i].y_pix) > 0.5 ? v : 1 - v);
    return weights;
}

// 1, x, y, xy, x^2 + y^2, in units of the rectangle's half sides from its middle.
Weights basis(const Rectangle &r, double x, double y) {
    const double u = 2 * r.u(x) - 1, v = 2 * r.v(y) - 1;
    return {1, u, v, u * v, u * u + v * v};
}

// The combination of those five functions that meets all five points: the weights w with
// sum_i w_i basis(point_i) = basis(x, y), by Gaussian elimination.
Weights five_point_weights(std::span<const FieldPoint> points, double x, double y) {
    constexpr size_t n = 5;
    const Rectangle r = bounds(points);
    std::array<std::array<double, n + 1>, n> rows{};
    for (size_t i = 0; i < n; ++i) {
        const Weights column = basis(r, points[i].x_pix, points[i].y_pix);
        for (size_t k = 0; k < n; ++k)
            rows[k][i] = column[k];
    }
    const Weights wanted = basis(r, x, y);
    for (size_t k = 0; k < n; ++k)
        rows[k][n] = wanted[k];
    for (size_t i = 0; i < n; ++i) {
        const auto size = [i](const auto &row) { return std::abs(row[i]); };
        std::swap(rows[i], *std::ranges::max_element(rows.begin() + static_cast<ptrdiff_t>(i),
                                                     rows.end(), {}, size));
        for (size_t k = 0; k < n; ++k)
            if (k != i) {
                const double factor = rows[k][i] / rows[i][i];
                for (size_t c = i; c <= n; ++c)
                    rows[k][c] -= factor * rows[i][c];
            }
    }
    Weights weights{};
    for (size_t i = 0; i < n; ++i)
        weights[i] = rows[i][n] / rows[i][i];
    return weights;
}

} // namespace

void check_field_points(std::span<const FieldPoint> points) {
    const Rectangle r = bounds(points);
    // No value at a field point may count for much more than itself within the rectangle.
    constexpr double largest_weight = 100;
    for (const double x : {r.x_low, r.x_high})
        for (const double y : {r.y_low, r.y_high}) {
            const bool corner_taken = std::ranges::any_of(points.subspan(1), [&](const auto &p) {
                return (r.u(p.x_pix) > 0.5) == (x > r.x_low) &&
                       (r.v(p.y_pix) > 0.5) == (y > r.y_low);
            });
            if (!corner_taken ||
                !std::ranges::all_of(five_point_weights(points, x, y),
                                     [](double w) { return std::abs(w) < largest_weight; }))
                fail(WFPSF_ERROR_ARGUMENT,
                     "field points: must be a centre and one point towards each corner around it");
        }
}

std::vector<double> interpolate_field(std::span<const FieldPoint> points, double x_pix,
                                      double y_pix, FieldRule rule) {
    const auto first = points.front().zernikes;
    if (points.size() == 1)
        return {first.begin(), first.end()};
    const Weights weights = rule == FieldRule::corners ? corner_weights(points, x_pix, y_pix)
                                                       : five_point_weights(points, x_pix, y_pix);
    std::vector<double> sum(first.size());
    for (size_t i = 0; i < weights.size(); ++i)
        for (size_t j = 0; j < sum.size(); ++j)
            sum[j] += weights[i] * points[i].zernikes[j];
    return sum;
}

} // namespace wfpsf
