// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/light_profile.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

LightProfile::LightProfile(const Psf &psf) {
    constexpr int64_t n = 2; // samples a native pixel
    const auto radius = static_cast<int64_t>(psf.settings().radius) - 1;
    const int64_t size = 2 * radius * n + 1;
    Plane<double> image(size, size);
    const auto middle = static_cast<double>(radius * n);
    psf.draw({middle, middle, 1}, n, image.view());
    brightest_.assign(static_cast<size_t>(radius) + 1, 0);
    outside_.assign(brightest_.size(), 1);
    for (int64_t y = 0; y < size; ++y)
        for (int64_t x = 0; x < size; ++x) {
            const int64_t samples = std::max(std::abs(x - radius * n), std::abs(y - radius * n));
            const auto pixels = static_cast<size_t>((samples + n - 1) / n); // rounded up
            const double light = safety * std::abs(image(x, y)) * n * n;
            brightest_[pixels] = std::max(brightest_[pixels], light);
            outside_[pixels] -= image(x, y);
        }
    // outside_ holds one less the light of each ring alone.
    double within = 0;
    for (double &outside : outside_) {
        within += 1 - outside;
        outside = safety * std::max(1 - within, 1e-3);
    }
    for (size_t r = brightest_.size() - 1; r-- > 0;)
        brightest_[r] = std::max(brightest_[r], brightest_[r + 1]);
}

double LightProfile::at(const std::vector<double> &by_radius, double radius, int power) const {
    const auto last = static_cast<double>(by_radius.size() - 1);
    if (radius <= last)
        return by_radius[static_cast<size_t>(std::max(radius, 0.0))];
    // From the brightest of the outer quarter on.
    const double from = std::floor(0.75 * last);
    return by_radius[static_cast<size_t>(from)] * std::pow(from / radius, power);
}

double LightProfile::mean_at(double radius) const {
    const double light = expected_beyond(radius - 1) - expected_beyond(radius);
    return std::max(light, 0.0) / (8 * radius);
}

} // namespace wfpsf
