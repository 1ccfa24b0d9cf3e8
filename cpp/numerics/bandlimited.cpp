// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/bandlimited.hpp"

#include "error/error.hpp"
#include "numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// Measured over all frequencies of the band and all positions (tests/unit/numerics): the worst
// error of the kernel lies below this many times exp(-beta), down to rounding.
constexpr double error_factor = 8;
constexpr double rounding = 4e-15;

} // namespace

BandlimitedInterpolator::BandlimitedInterpolator(double bandwidth, double eps)
    : bandwidth_(bandwidth) {
    if (!(bandwidth > 0 && bandwidth < 0.5))
        fail(WFPSF_ERROR_RANGE, "bandwidth = %g: must lie between 0 and 1/2 cycles per sample",
             bandwidth);
    const double beta_per_sample = 2 * pi * (0.5 - bandwidth);
    const double beta = std::log(error_factor / std::max(eps, rounding));
    half_width_ = std::max(2, static_cast<int>(std::ceil(beta / beta_per_sample)));
    beta_ = beta_per_sample * half_width_;
    error_ = error_factor * std::exp(-beta_) + rounding;
}

double BandlimitedInterpolator::kernel(double t) const {
    const double u = t / half_width_;
    if (std::abs(u) >= 1)
        return 0;
    const double window = std::exp(beta_ * (std::sqrt(1 - u * u) - 1));
    return t == 0 ? 1 : window * std::sin(pi * t) / (pi * t);
}

int64_t BandlimitedInterpolator::weights(double x, double *w) const {
    const double base = std::floor(x);
    const double offset = x - base;
    const int64_t first = static_cast<int64_t>(base) - half_width_ + 1;
    if (offset == 0) {
        std::fill(w, w + taps(), 0.0);
        w[half_width_ - 1] = 1;
        return first;
    }
    // sin(pi (offset - j)) differs from tap to tap by its sign alone. It must not cancel close to
    // the next sample, where it is divided by as small a distance.
    double numerator = std::sin(pi * std::min(offset, 1 - offset)) / pi;
    if (half_width_ % 2 == 0)
        numerator = -numerator;
    for (int k = 0; k < taps(); ++k) {
        const double t = offset + (half_width_ - 1 - k);
        const double u = t / half_width_;
        const double window = std::exp(beta_ * (std::sqrt(std::max(0.0, 1 - u * u)) - 1));
        w[k] = window * numerator / t;
        numerator = -numerator;
    }
    return first;
}

std::vector<double> BandlimitedInterpolator::averaging_filter(double width) const {
    const int m = static_cast<int>(std::ceil(half_width_ + width / 2));
    std::vector<double> filter(static_cast<size_t>(2 * m + 1));
    const GaussLegendre rule(24);
    for (int j = 0; j <= m; ++j) {
        // One panel a unit of t: the kernel is smooth inside each.
        const double a = std::max(j - width / 2, -double(half_width_));
        const double b = std::min(j + width / 2, double(half_width_));
        double sum = 0;
        const int panels = std::max(1, static_cast<int>(std::ceil(b - a)));
        const double length = (b - a) / panels;
        for (int p = 0; p < panels && b > a; ++p)
            for (int i = 0; i < rule.size(); ++i) {
                const auto k = static_cast<size_t>(i);
                sum += rule.w[k] * length / 2 * kernel(a + length * (p + (1 + rule.x[k]) / 2));
            }
        filter[static_cast<size_t>(m + j)] = filter[static_cast<size_t>(m - j)] = sum / width;
    }
    return filter;
}

} // namespace wfpsf
