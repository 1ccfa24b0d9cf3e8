// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/light_modes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wfpsf {

std::vector<double> brightest_by_pixel(const Plane<double> &light, int64_t per_pixel) {
    const int64_t middle = light.nx() / 2;
    const std::vector<double> by_sample =
        brightest_beyond<double>(middle, [&](int64_t y) { return light.view().row(middle + y); });
    std::vector<double> brightest;
    for (size_t r = 0; r < by_sample.size(); r += static_cast<size_t>(per_pixel))
        brightest.push_back(by_sample[r]);
    return brightest;
}

LeftOut::LeftOut(std::span<const LightMode> modes, std::span<const double> weights)
    : rings_(modes.empty() ? 1 : modes[0].brightest.size()),
      beyond_((modes.size() + 1) * rings_, 0.0) {
    for (size_t k = modes.size(); k-- > 0;)
        add_up(k, modes[k].brightest, weights[k]);
}

LeftOut::LeftOut(std::span<const std::vector<double>> brightest, std::span<const double> weights)
    : rings_(brightest.empty() ? 1 : brightest[0].size()),
      beyond_((brightest.size() + 1) * rings_, 0.0) {
    for (size_t k = brightest.size(); k-- > 0;)
        add_up(k, brightest[k], weights[k]);
}

void LeftOut::add_up(size_t mode, const std::vector<double> &brightest, double weight) {
    double *const with = &beyond_[mode * rings_];
    for (size_t r = 0; r < rings_; ++r)
        with[r] = with[r + rings_] + std::abs(weight) * brightest[r];
}

std::vector<double> LeftOut::radii(double radius, double most) const {
    std::vector<double> radii;
    size_t r = rings_; // beyond r - 1 all modes after the first k are left out
    for (size_t k = 0; (k + 1) * rings_ < beyond_.size(); ++k) {
        while (r > 0 && beyond_[k * rings_ + r - 1] <= most)
            --r;
        if (r == 0)
            break;
        radii.push_back(std::min(radius, static_cast<double>(r)));
    }
    return radii;
}

void add_within(double weight, const Plane<double> &light, int64_t half, Plane<double> &sum) {
    const int64_t from = light.nx() / 2, to = sum.nx() / 2;
    half = std::min({half, from, to});
    for (int64_t y = -half; y <= half; ++y)
        add_scaled(weight, light.view().row(from + y) + from - half, 2 * half + 1,
                   sum.view().row(to + y) + to - half);
}

} // namespace wfpsf
