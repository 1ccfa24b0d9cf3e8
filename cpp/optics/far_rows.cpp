// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_rows.hpp"

namespace wfpsf {

void Roots::add(double a, double b, double c) {
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0)
        return;
    const double sum = b + std::copysign(std::sqrt(discriminant), b);
    add(-2 * c / sum);
    add(-sum / (2 * a));
}

Few<double, most_runs> Roots::sorted_inside(const PixelRow &row) const {
    const double last = row.x + static_cast<double>(row.size() - 1);
    Few<double, most_runs> inside;
    inside.push_back(row.x);
    for (const double root : all_)
        if (root > row.x && root < last)
            inside.push_back(root);
    inside.push_back(last);
    std::ranges::sort(inside);
    return inside;
}

Run between(Run run, double start, double step, double low, double high) {
    const double a = (low - start) / step, b = (high - start) / step;
    if (!std::isnan(a) && !std::isnan(b)) {
        const auto first = static_cast<double>(run.first), last = static_cast<double>(run.last);
        run.first = static_cast<int64_t>(std::ceil(std::clamp(std::min(a, b), first, last + 1)));
        run.last = static_cast<int64_t>(std::floor(std::clamp(std::max(a, b), first - 1, last)));
    }
    return run;
}

Runs runs_along(const SpikeAxes &axes, const PixelRow &row, double reach, double nearest,
                double farthest) {
    const auto &[nx, ny] = axes;
    if (std::abs(row.y) > farthest + reach)
        return {};
    Roots roots;
    roots.add(-ny * row.y / nx); // along = 0
    for (const double side : {-1.0, 1.0}) {
        roots.add((nx * row.y - side * reach) / ny);
        for (const double end : {nearest, farthest})
            roots.add((side * end - ny * row.y) / nx);
    }
    return roots.runs(row, [&](double x) {
        const double along = std::abs(axes.along(x, row.y));
        return std::abs(axes.across(x, row.y)) <= reach && along <= farthest && along >= nearest;
    });
}

} // namespace wfpsf
