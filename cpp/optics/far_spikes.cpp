// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_spikes.hpp"

#include "numerics/dispatch.hpp"

#include <algorithm>

namespace wfpsf {

namespace {

// ----------------------------------------------------------------------------------- interpolation

// Lagrange's cubic through the samples -1, 0, 1, 2, at 0 <= s < 1.
[[gnu::always_inline]] inline double cubic(double s, double before, double here, double next,
                                           double after) {
    const double a = s + 1, b = s - 1, c = s - 2;
    return s * b * (a * after - c * before) / 6 + a * c * (b * here - s * next) / 2;
}
[[gnu::always_inline]] inline double cubic(double s, const double *here) {
    return cubic(s, here[-1], here[0], here[1], here[2]);
}

} // namespace

double FarSource::bandwidth() const {
    return optics.aperture->diameter() * pixel() / std::ranges::min(spectrum.wavelength);
}

double FarSource::mean_wavelength(int power) const {
    double sum = 0;
    for (size_t q = 0; q < spectrum.size(); ++q)
        sum += spectrum.weight[q] * std::pow(spectrum.wavelength[q], power);
    return sum;
}

// --------------------------------------------------------------------------------------- one spike

namespace {

struct SpikeTable {
    SpikeAxes axes;
    double scale, tail, per_pixel, reach, fringe_reach, rounding;
    const double *constant, *slope; // at the position -reach
    const double *rounded;
};

// What rounded ends leave of the light.
[[gnu::always_inline]] inline double left_of(const SpikeTable &spike, double along, double across) {
    const double x =
        std::min(across * std::sqrt(spike.rounding / along), Spike::rounded_size - 2.0);
    const auto cell = static_cast<int32_t>(x);
    const double *left = spike.rounded + cell;
    return left[0] + (x - cell) * (left[1] - left[0]);
}

// Positions inside the table.
template <bool rounded>
WFPSF_VECTORISED void add_profile(const SpikeTable &table, double x0, double y, size_t n,
                                  double *light) {
    const SpikeTable spike = table; // no store changes it
    const auto [nx, ny] = spike.axes;
    const double y2 = y * y;
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i);
        const double along = nx * x + ny * y, across = nx * y - ny * x;
        const double inverse = along / (x * x + y2);
        const double place = (across + spike.reach) * spike.per_pixel;
        const auto cell = static_cast<int32_t>(place);
        const double s = place - cell;
        const double value =
            cubic(s, spike.constant + cell) + inverse * cubic(s, spike.slope + cell);
        // Between the fringes' table and the rounding of the edge's ends.
        double share = 1;
        if constexpr (rounded) {
            const double inner = within(across / spike.fringe_reach);
            share = inner + (1 - inner) * left_of(spike, std::abs(along), std::abs(across));
        }
        light[i] += spike.scale * inverse * inverse * value * share;
    }
}

// Beyond it.
template <bool rounded>
WFPSF_VECTORISED void add_tail(const SpikeTable &table, double x0, double y, size_t n,
                               double *light) {
    const SpikeTable spike = table;
    const auto [nx, ny] = spike.axes;
    const double scale = spike.scale * spike.tail, y2 = y * y;
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i);
        const double along = nx * x + ny * y, across = nx * y - ny * x;
        const double slope = along / ((x * x + y2) * across);
        double share = 1;
        if constexpr (rounded)
            share = left_of(spike, std::abs(along), std::abs(across));
        light[i] += scale * slope * slope * share;
    }
}

} // namespace

void Spike::add(const PixelRow &row, double floor) const {
    const auto &[nx, ny] = axes_;
    const double product = std::sqrt(2 * scale_ * tail_ / floor); // of along and across
    const double farthest = std::sqrt(2 * scale_ * most_ / floor);
    Roots roots;
    for (const double side : {-1.0, 1.0}) {
        roots.add(-nx * ny, (nx * nx - ny * ny) * row.y, nx * ny * row.y * row.y - side * product);
        roots.add((side * farthest - ny * row.y) / nx);         // along = side * farthest
        roots.add(row.y * (nx - side * ny) / (ny + side * nx)); // across = side * along
    }
    const Runs runs = roots.runs(row, [&](double x) {
        const double along = std::abs(axes_.along(x, row.y));
        const double across = std::abs(axes_.across(x, row.y));
        return along * across <= product && along <= farthest && across <= along;
    });
    const SpikeTable table{axes_,
                           scale_,
                           tail_,
                           per_pixel_,
                           reach_,
                           fringe_reach_,
                           rounding_,
                           constant_.data() + 1,
                           slope_.data() + 1,
                           rounded_.data()};
    const auto draw = [&](auto &add, int64_t first, int64_t last) {
        if (first > last)
            return;
        const PixelRow::Part part = row.part({first, last});
        add(table, part.x, part.y, part.light.size(), part.light.data());
    };
    const auto profile = rounding_ > 0 ? add_profile<true> : add_profile<false>;
    const auto tail = rounding_ > 0 ? add_tail<true> : add_tail<false>;
    const double inside = reach_ * (1 - 1e-9); // at its end a cubic has no next entry
    for (const Run &run : runs) {
        const Run in_table = between(run, axes_.across(row.x, row.y), -ny, -inside, inside);
        draw(tail, run.first, in_table.first - 1);
        draw(profile, in_table.first, in_table.last);
        draw(tail, in_table.last + 1, run.last);
    }
}

double Spike::brightest_off(double r, const SpikeAxes &other) const {
    const double sine = std::abs(axes_.across(other.nx, other.ny));
    const double cosine = std::abs(axes_.along(other.nx, other.ny));
    if (sine < same_direction)
        return brightest(r);
    // Its own tail, and the other spike's ends at either side of its line.
    const double nearest = (sine - same_direction / 2) * r;
    return cosine < same_direction ? 0 : 2 * scale_ * tail_ / std::pow(nearest * r * cosine, 2);
}

double Spike::half_width(double r, double floor) const {
    return brightest(r) < floor ? 0 : std::sqrt(scale_ * tail_ / floor) / r;
}

// ----------------------------------------------------------------------------------------- fringes

namespace {

struct FringeTable {
    SpikeAxes axes;
    double nearest, per_along, per_across;
    int64_t rows, columns;
    const double *table;
};

// On one side of the star: `side` is -1 or 1.
WFPSF_VECTORISED void add_fringes(const FringeTable &fringes, double side, double x0, double y,
                                  size_t n, double *light) {
    const auto [nx, ny] = fringes.axes;
    const int64_t half = fringes.columns / 2;
    const auto middle = static_cast<double>(half);
    const double last = static_cast<double>(fringes.rows) - 2.001;
    const double last_column = static_cast<double>(fringes.columns) - 2.001;
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i);
        const double along = side * (nx * x + ny * y), across = nx * y - ny * x;
        const double column = std::clamp(across * fringes.per_across + middle, 1.0, last_column);
        const double row = std::clamp((along - fringes.nearest) * fringes.per_along + 1, 1.0, last);
        const auto j = static_cast<int32_t>(row), c = static_cast<int32_t>(column);
        const double s = column - c, t = row - j;
        const double *entry = fringes.table + j * fringes.columns + c;
        const double value =
            cubic(t, cubic(s, entry - fringes.columns), cubic(s, entry),
                  cubic(s, entry + fringes.columns), cubic(s, entry + 2 * fringes.columns));
        light[i] += value / (x * x + y * y);
    }
}

} // namespace

double Fringes::brightest(double r) const {
    if (r > end_)
        return 0;
    const double row = (r - nearest_) * per_along_;
    const auto last = static_cast<double>(rows_ - 1);
    return most_[static_cast<size_t>(std::clamp(row, 0.0, last))] / (r * r);
}

void Fringes::add(const PixelRow &row, double floor) const {
    const int64_t half = columns_ / 2;
    const double reach = static_cast<double>(half - 2) / per_across_;
    const double farthest = std::min(end_, std::sqrt(most_.front() / floor));
    for (const Run &run : runs_along(axes_, row, reach, nearest_, farthest)) {
        const PixelRow::Part part = row.part(run);
        const double middle = part.x + static_cast<double>(part.light.size() - 1) / 2;
        const bool behind = axes_.along(middle, part.y) < 0;
        add_fringes(
            {axes_, nearest_, per_along_, per_across_, rows_, columns_, table_[behind].data()},
            behind ? -1 : 1, part.x, part.y, part.light.size(), part.light.data());
    }
}

} // namespace wfpsf
