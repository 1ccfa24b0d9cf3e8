// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/light_modes.hpp"

#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

void LightMode::find_brightest(int64_t per_pixel) {
    const int64_t middle = light.nx() / 2;
    brightest.assign(static_cast<size_t>(middle / per_pixel) + 1, 0);
    for (int64_t y = 0; y < light.ny(); ++y)
        for (int64_t x = 0; x < light.nx(); ++x) {
            const int64_t off = std::max(std::abs(x - middle), std::abs(y - middle));
            double &most = brightest[static_cast<size_t>(off / per_pixel)];
            most = std::max(most, std::abs(light(x, y)));
        }
    for (size_t r = brightest.size() - 1; r-- > 0;)
        brightest[r] = std::max(brightest[r], brightest[r + 1]);
}

LeftOut::LeftOut(std::span<const LightMode> modes, std::span<const double> weights) {
    const size_t rings = modes.empty() ? 1 : modes[0].brightest.size();
    beyond_.assign(rings, std::vector<double>(modes.size() + 1, 0));
    for (size_t r = 0; r < rings; ++r)
        for (size_t k = modes.size(); k-- > 0;)
            beyond_[r][k] = beyond_[r][k + 1] + std::abs(weights[k]) * modes[k].brightest[r];
}

LeftOut::LeftOut(std::span<const std::vector<double>> brightest, std::span<const double> weights) {
    beyond_.assign(brightest.empty() ? 1 : brightest[0].size(),
                   std::vector<double>(brightest.size() + 1, 0));
    for (size_t r = 0; r < beyond_.size(); ++r)
        for (size_t k = brightest.size(); k-- > 0;)
            beyond_[r][k] = beyond_[r][k + 1] + std::abs(weights[k]) * brightest[k][r];
}

std::vector<double> LeftOut::all() const {
    std::vector<double> all;
    for (const std::vector<double> &ring : beyond_)
        all.push_back(ring[0]);
    return all;
}

std::vector<double> LeftOut::radii(double radius, double most) const {
    std::vector<double> radii;
    size_t r = beyond_.size(); // beyond r - 1 all modes after the first k are left out
    const size_t modes = beyond_[0].size() - 1;
    for (size_t k = 0; k < modes; ++k) {
        while (r > 0 && beyond_[r - 1][k] <= most)
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
