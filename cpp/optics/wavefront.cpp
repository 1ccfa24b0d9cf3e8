// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/wavefront.hpp"

#include "error/error.hpp"
#include "numerics/dispatch.hpp"

#include <algorithm>
#include <array>
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

constexpr size_t block = 32; // points evaluated together
using Block = std::array<double, block>;

// sum += polynomial(t) factor
[[gnu::always_inline]] inline void add_order(const std::vector<double> &polynomial, const Block &t,
                                             const Block &factor, Block &sum) {
    if (polynomial.empty())
        return;
    Block value;
    value.fill(polynomial.back());
    for (size_t k = polynomial.size() - 1; k-- > 0;)
        for (size_t i = 0; i < block; ++i)
            value[i] = value[i] * t[i] + polynomial[k];
    for (size_t i = 0; i < block; ++i)
        sum[i] += value[i] * factor[i];
}

WFPSF_VECTORISED void add_orders(const std::vector<ZernikeOrder> &orders, const Block &x,
                                 const Block &y, Block &sum) {
    Block t, re, im;
    for (size_t i = 0; i < block; ++i) {
        t[i] = x[i] * x[i] + y[i] * y[i];
        re[i] = 1;
        im[i] = 0;
    }
    for (const ZernikeOrder &order : orders) {
        add_order(order.cosine, t, re, sum);
        add_order(order.sine, t, im, sum);
        for (size_t i = 0; i < block; ++i) {
            const double turned = re[i] * x[i] - im[i] * y[i];
            im[i] = re[i] * y[i] + im[i] * x[i];
            re[i] = turned;
        }
    }
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
        ZernikeOrder &order = orders_[static_cast<size_t>(m)];
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

Wavefront Wavefront::scaled(double factor) const {
    Wavefront copy = *this;
    for (ZernikeOrder &order : copy.orders_)
        for (std::vector<double> *polynomial : {&order.cosine, &order.sine})
            for (double &a : *polynomial)
                a *= factor;
    copy.slope_bound_ *= std::abs(factor);
    copy.waves_per_metre_ *= factor;
    return copy;
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
    for (const ZernikeOrder &order : orders_) {
        sum += horner(order.cosine, t) * power.real() + horner(order.sine, t) * power.imag();
        power *= z;
    }
    return map_ ? sum + waves_per_metre_ * (*map_)(x, y) : sum;
}

void Wavefront::evaluate(std::span<const double> x, std::span<const double> y,
                         double *waves) const {
    for (size_t first = 0; first < x.size(); first += block) {
        const size_t count = std::min(block, x.size() - first);
        Block u{}, v{}, sum{};
        for (size_t i = 0; i < count; ++i) {
            u[i] = x[first + i] / radius_;
            v[i] = y[first + i] / radius_;
        }
        add_orders(orders_, u, v, sum);
        if (map_)
            for (size_t i = 0; i < count; ++i)
                sum[i] += waves_per_metre_ * (*map_)(x[first + i], y[first + i]);
        std::copy_n(sum.begin(), count, waves + first);
    }
}

} // namespace wfpsf
