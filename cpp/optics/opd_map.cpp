// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/opd_map.hpp"

#include "error/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace wfpsf {

namespace {

// From n samples f to the n + 2 coefficients c of the cubic B-splines, those beyond the ends first
// and last: (c[i] + 4 c[i+1] + c[i+2]) / 6 = f[i], and no jump of the third derivative at the
// second sample, nor at the last but one. With the equations around it, that condition is c = (8
// f[1] - f[0] - f[2]) / 6 for the second sample's B-spline.
void solve(const std::vector<double> &f, std::vector<double> &c, std::vector<double> &pivot) {
    const size_t n = f.size();
    c[2] = (8 * f[1] - f[0] - f[2]) / 6;
    c[n - 1] = (8 * f[n - 2] - f[n - 1] - f[n - 3]) / 6;
    // Between these two: Thomas's elimination, and back.
    double ratio = 0;
    for (size_t k = 3; k + 1 < n; ++k) {
        pivot[k] = 1 / (4 - ratio);
        c[k] = (6 * f[k - 1] - c[k - 1]) * pivot[k];
        ratio = pivot[k];
    }
    for (size_t k = n - 2; k > 2; --k)
        c[k] -= pivot[k] * c[k + 1];
    c[1] = 6 * f[1] - 4 * c[2] - c[3];
    c[0] = 6 * f[0] - 4 * c[1] - c[2];
    c[n] = 6 * f[n - 2] - 4 * c[n - 1] - c[n - 2];
    c[n + 1] = 6 * f[n - 1] - 4 * c[n] - c[n - 1];
}

// The four B-splines that reach a position, 0 at the first sample, and the first one's coefficient.
struct Support {
    int64_t first;
    std::array<double, 4> value;
};
Support support(double position, int64_t samples) {
    const auto last = static_cast<double>(samples - 1);
    const double at = std::clamp(position, 0.0, last);
    const double cell = std::min(std::floor(at), last - 1);
    const double t = at - cell, s = 1 - t;
    return {static_cast<int64_t>(cell),
            {s * s * s / 6, (4 - 3 * t * t * (2 - t)) / 6, (4 - 3 * s * s * (2 - s)) / 6,
             t * t * t / 6}};
}

// Along x, then along y.
Plane<double> coefficients(View<const double> map) {
    Plane<double> done(map.nx + 2, map.ny + 2);
    std::vector<double> f, c, pivot;
    const auto resize = [&](int64_t n) {
        f.resize(static_cast<size_t>(n));
        c.resize(f.size() + 2);
        pivot.resize(f.size());
    };
    resize(map.nx);
    for (int64_t y = 0; y < map.ny; ++y) {
        for (int64_t x = 0; x < map.nx; ++x)
            f[static_cast<size_t>(x)] = map(x, y);
        solve(f, c, pivot);
        for (int64_t x = 0; x < done.nx(); ++x)
            done(x, y) = c[static_cast<size_t>(x)];
    }
    resize(map.ny);
    for (int64_t x = 0; x < done.nx(); ++x) {
        for (int64_t y = 0; y < map.ny; ++y)
            f[static_cast<size_t>(y)] = done(x, y);
        solve(f, c, pivot);
        for (int64_t y = 0; y < done.ny(); ++y)
            done(x, y) = c[static_cast<size_t>(y)];
    }
    return done;
}

} // namespace

OpdMap::OpdMap(View<const double> map, double scale, double axis_x, double axis_y)
    : scale_(scale), axis_x_(axis_x), axis_y_(axis_y) {
    for (const int64_t side : {map.nx, map.ny})
        if (side < smallest_side || side > largest_side)
            fail(WFPSF_ERROR_SIZE, "map: has %lld x %lld samples, each side must be %lld..%lld",
                 static_cast<long long>(map.nx), static_cast<long long>(map.ny),
                 static_cast<long long>(smallest_side), static_cast<long long>(largest_side));
    for (int64_t y = 0; y < map.ny; ++y)
        for (int64_t x = 0; x < map.nx; ++x) {
            const double value = map(x, y);
            if (!std::isfinite(value))
                fail(WFPSF_ERROR_NOT_FINITE, "map sample (%lld, %lld) = %g: must be finite",
                     static_cast<long long>(x), static_cast<long long>(y), value);
            if (!(std::abs(value) <= largest_value))
                fail(WFPSF_ERROR_RANGE, "map sample (%lld, %lld) = %g: must be -%g..%g metres",
                     static_cast<long long>(x), static_cast<long long>(y), value, largest_value,
                     largest_value);
        }
    coefficient_ = coefficients(map);
}

double OpdMap::operator()(double x, double y) const {
    const auto along_x = support(x / scale_ + axis_x_, coefficient_.nx() - 2);
    const auto along_y = support(y / scale_ + axis_y_, coefficient_.ny() - 2);
    double sum = 0;
    for (int64_t j = 0; j < 4; ++j) {
        double row = 0;
        for (int64_t i = 0; i < 4; ++i)
            row += along_x.value[static_cast<size_t>(i)] *
                   coefficient_(along_x.first + i, along_y.first + j);
        sum += along_y.value[static_cast<size_t>(j)] * row;
    }
    return sum;
}

// A spline's slope along an axis is a mean of the differences between neighbouring coefficients.
double OpdMap::slope_bound(double radius) const {
    const int64_t nx = coefficient_.nx(), ny = coefficient_.ny();
    const double reach = radius / scale_;
    const int64_t x0 = support(axis_x_ - reach, nx - 2).first;
    const int64_t x1 = support(axis_x_ + reach, nx - 2).first + 3;
    const int64_t y0 = support(axis_y_ - reach, ny - 2).first;
    const int64_t y1 = support(axis_y_ + reach, ny - 2).first + 3;
    double along_x = 0, along_y = 0;
    for (int64_t y = y0; y <= y1; ++y)
        for (int64_t x = x0; x <= x1; ++x) {
            const double here = coefficient_(x, y);
            if (x < x1)
                along_x = std::max(along_x, std::abs(coefficient_(x + 1, y) - here));
            if (y < y1)
                along_y = std::max(along_y, std::abs(coefficient_(x, y + 1) - here));
        }
    return std::hypot(along_x, along_y) / scale_;
}

} // namespace wfpsf
