// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/wavefront.hpp"

#include "error/error.hpp"

#include <cmath>
#include <complex>
#include <utility>

namespace wfpsf {

namespace {

struct Noll {
    int n, m; // radial and azimuthal order, m >= 0
};

Noll noll_orders(int j) {
    int n = 0, rest = j - 1;
    while (rest > n)
        rest -= ++n;
    return {n, n % 2 + 2 * ((rest + (n + 1) % 2) / 2)};
}

double factorial(int n) {
    return std::tgamma(n + 1.0);
}

double horner(const std::vector<double> &polynomial, double t) {
    double sum = 0;
    for (size_t k = polynomial.size(); k-- > 0;)
        sum = sum * t + polynomial[k];
    return sum;
}

} // namespace

Wavefront::Wavefront(std::span<const double> coefficients, double radius) : radius_(radius) {
    if (coefficients.size() > static_cast<size_t>(largest_j))
        fail(WFPSF_ERROR_RANGE, "zernike count = %zu: Noll index must be 1..%d",
             coefficients.size(), largest_j);
    for (size_t i = 0; i < coefficients.size(); ++i) {
        const double a = coefficients[i];
        const int j = static_cast<int>(i) + 1;
        if (!std::isfinite(a))
            fail(WFPSF_ERROR_NOT_FINITE, "zernike coefficient %d = %g: must be finite", j, a);
        if (a == 0)
            continue;
        const auto [n, m] = noll_orders(j);
        if (orders_.size() <= static_cast<size_t>(m))
            orders_.resize(static_cast<size_t>(m) + 1);
        Order &order = orders_[static_cast<size_t>(m)];
        std::vector<double> &polynomial = m > 0 && j % 2 ? order.sine : order.cosine;
        if (polynomial.size() <= static_cast<size_t>((n - m) / 2))
            polynomial.resize(static_cast<size_t>((n - m) / 2) + 1);
        const double norm = std::sqrt((n + 1.0) * (m > 0 ? 2 : 1));
        for (int s = 0; 2 * s <= n - m; ++s)
            polynomial[static_cast<size_t>((n - m) / 2 - s)] +=
                a * norm * (s % 2 ? -1 : 1) * factorial(n - s) /
                (factorial(s) * factorial((n + m) / 2 - s) * factorial((n - m) / 2 - s));
        // Markov: a polynomial of degree n, at most `norm` in size, is at most n^2 norm steep.
        slope_bound_ += std::abs(a) * norm * n * n / radius;
    }
}

void Wavefront::add(std::shared_ptr<const OpdMap> map, double wavelength) {
    map_ = std::move(map);
    waves_per_metre_ = 1 / wavelength;
    slope_bound_ += map_->slope_bound(radius_) * waves_per_metre_;
}

double Wavefront::operator()(double x, double y) const {
    const std::complex<double> z(x / radius_, y / radius_);
    const double t = std::norm(z);
    std::complex<double> power = 1;
    double sum = 0;
    for (const Order &order : orders_) {
        sum += horner(order.cosine, t) * power.real() + horner(order.sine, t) * power.imag();
        power *= z;
    }
    return map_ ? sum + waves_per_metre_ * (*map_)(x, y) : sum;
}

} // namespace wfpsf
