// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/hankel.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

// The rule of step h takes in F(k E^m) E^(c m) for all integers m, E = exp(2 pi / h): 1e-14 here.
constexpr double c = 0.5, step = 0.1;

// Re z > 0; the logarithm's branch is any.
Complex log_gamma(Complex z) {
    Complex shift = 0;
    for (; z.real() < 12; z += 1)
        shift -= std::log(z);
    // Stirling's series; what is left out is 1e-18.
    constexpr std::array<double, 7> series{1.0 / 12,   -1.0 / 360,      1.0 / 1260, -1.0 / 1680,
                                           1.0 / 1188, -691.0 / 360360, 1.0 / 156};
    const Complex inverse = 1.0 / z, square = inverse * inverse;
    Complex sum = 0;
    for (size_t i = series.size(); i-- > 0;)
        sum = sum * square + series[i];
    return shift + (z - 0.5) * std::log(z) - z + 0.5 * std::log(2 * pi) + sum * inverse;
}

} // namespace

SersicHankel::SersicHankel(double n, double b) {
    double largest = 0;
    for (int j = 0;; ++j) {
        const Complex s(c, step * j);
        const Complex weight =
            std::exp((s - 1.0) * std::numbers::ln2 + log_gamma(s / 2.0) - log_gamma(1.0 - s / 2.0) +
                     n * s * std::log(b) + log_gamma(n * (2.0 - s)) - std::lgamma(2 * n)) *
            (step / pi * (j == 0 ? 0.5 : 1));
        weights_.push_back(weight);
        largest = std::max(largest, std::abs(weight));
        if (std::abs(weight) < 1e-17 * largest)
            return;
    }
}

double SersicHankel::at(double log_k) const {
    const double turn = -step * log_k, x = std::cos(turn), y = std::sin(turn);
    double re = 0, im = 0;
    for (size_t j = weights_.size(); j-- > 0;) {
        const double r = re * x - im * y + weights_[j].real();
        im = re * y + im * x + weights_[j].imag();
        re = r;
    }
    return std::exp(-c * log_k) * re;
}

} // namespace wfpsf
