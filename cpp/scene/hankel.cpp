// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/hankel.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/gamma.hpp"

#include <algorithm>
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
                     n * s * std::log(b) + log_gamma(n * (2.0 - s)) - log_of_gamma(2 * n)) *
            (step / pi * (j == 0 ? 0.5 : 1));
        weights_.push_back(weight);
        largest = std::max(largest, std::abs(weight));
        if (std::abs(weight) < 1e-17 * largest)
            return;
    }
}

// Horner's scheme in exp(-i step log k), side by side.
WFPSF_VECTORISED
static void sum_up(std::span<const Complex> weights, const double *x, const double *y, double *re,
                   double *im, size_t count) {
    for (size_t j = weights.size(); j-- > 0;) {
        const double u = weights[j].real(), v = weights[j].imag();
        for (size_t i = 0; i < count; ++i) {
            const double r = re[i] * x[i] - im[i] * y[i] + u;
            im[i] = re[i] * y[i] + im[i] * x[i] + v;
            re[i] = r;
        }
    }
}

void SersicHankel::at(std::span<const double> log_k, double *transform) const {
    const size_t n = log_k.size();
    std::vector<double> x(n), y(n), re(n), im(n);
    for (size_t i = 0; i < n; ++i) {
        x[i] = std::cos(step * log_k[i]);
        y[i] = -std::sin(step * log_k[i]);
    }
    sum_up(weights_, x.data(), y.data(), re.data(), im.data(), n);
    for (size_t i = 0; i < n; ++i)
        transform[i] = std::exp(-c * log_k[i]) * re[i];
}

} // namespace wfpsf
