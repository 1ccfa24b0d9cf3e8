// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/encircled.hpp"

#include "error/error.hpp"
#include "numerics/bandlimited.hpp"
#include "numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// The samples in double, with a margin of zeros all around.
struct Samples {
    Plane<double> plane;
    int64_t margin = 0;
    double border = 0; // largest absolute sample of the outermost ones
    double largest = 0;
};

template <class T> Samples padded_samples(View<const T> image, int64_t margin) {
    Samples out{Plane<double>(image.nx + 2 * margin, image.ny + 2 * margin), margin, 0, 0};
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x) {
            const double value = static_cast<double>(image(x, y));
            if (!std::isfinite(value))
                fail(WFPSF_ERROR_NOT_FINITE, "sample (%lld, %lld) = %g: must be finite",
                     static_cast<long long>(x), static_cast<long long>(y), value);
            out.plane(x + margin, y + margin) = value;
            out.largest = std::max(out.largest, std::abs(value));
            if (x == 0 || y == 0 || x == image.nx - 1 || y == image.ny - 1)
                out.border = std::max(out.border, std::abs(value));
        }
    return out;
}

// Polar quadrature of the interpolated image. Both rules converge exponentially: Gauss-Legendre in
// r, the trapezoid in the angle.
class PolarIntegral {
  public:
    // A second integral with spare = true has a finer filter and other nodes.
    PolarIntegral(const Samples &samples, double x, double y, const EncircledOptions &options,
                  bool spare)
        : samples_(samples), x_(x), y_(y), wavenumber_(2 * pi * options.bandwidth),
          eps_(spare ? spare_eps(options) : options.eps), spare_(spare),
          filter_(filter_bandwidth(options, spare), eps_), wx_(static_cast<size_t>(filter_.taps())),
          wy_(wx_), column_(wx_) {}

    static double spare_eps(const EncircledOptions &options) {
        return std::max(1e-14, options.eps / 100);
    }
    static double filter_bandwidth(const EncircledOptions &options, bool spare) {
        return spare ? options.bandwidth + (0.5 - options.bandwidth) / 4 : options.bandwidth;
    }

    // The integral of I over the annulus, negative if outer < inner.
    double annulus(double inner, double outer) {
        const double half = (outer - inner) / 2;
        // The factor r and the ring's own band add a few to the points that the wave needs.
        const GaussLegendre rule(gauss_legendre_points(wavenumber_ * std::abs(half), eps_) +
                                 (spare_ ? 5 : 2));
        double sum = 0;
        for (int i = 0; i < rule.size(); ++i) {
            const auto k = static_cast<size_t>(i);
            sum += rule.w[k] * ring(inner + half * (1 + rule.x[k]));
        }
        return sum * half;
    }

    // The integral of I along the circle.
    double ring(double radius) {
        const double K = wavenumber_ * radius;
        // The trapezoid's error is about J_n(K), which is eps at n = K + z (K/2)^(1/3), where
        // Ai(z) = eps; at small K it falls like (K/2)^n/n!.
        const double z = std::pow(1.5 * std::log(1 / eps_), 2.0 / 3);
        const int n = static_cast<int>(std::ceil(K + z * std::cbrt(K / 2))) + (spare_ ? 11 : 8);
        double sum = 0;
        for (int i = 0; i < n; ++i) {
            const double angle = 2 * pi * (i + (spare_ ? 0.5 : 0.0)) / n;
            sum += value(x_ + radius * std::cos(angle), y_ + radius * std::sin(angle));
        }
        return sum * 2 * pi * radius / n;
    }

    // The largest share of a node's filter that lay beyond the border.
    double missing() const { return missing_; }

  private:
    const Samples &samples_;
    double x_, y_, wavenumber_, eps_;
    bool spare_;
    BandlimitedInterpolator filter_;
    std::vector<double> wx_, wy_, column_;
    double missing_ = 0;

    double value(double x, double y) {
        const int64_t margin = samples_.margin;
        const int64_t first_x = filter_.weights(x, wx_.data());
        const int64_t first_y = filter_.weights(y, wy_.data());
        const int64_t nx = samples_.plane.nx() - 2 * margin, ny = samples_.plane.ny() - 2 * margin;
        missing_ = std::max({missing_, beyond(wx_, first_x, nx), beyond(wy_, first_y, ny)});
        const size_t taps = wx_.size();
        std::fill(column_.begin(), column_.end(), 0.0);
        for (size_t j = 0; j < taps; ++j) {
            const double *row =
                &samples_.plane(first_x + margin, first_y + margin + static_cast<int64_t>(j));
            const double w = wy_[j];
            for (size_t i = 0; i < taps; ++i)
                column_[i] += w * row[i];
        }
        double sum = 0;
        for (size_t i = 0; i < taps; ++i)
            sum += wx_[i] * column_[i];
        return sum;
    }

    static double beyond(const std::vector<double> &w, int64_t first, int64_t n) {
        const auto taps = static_cast<int64_t>(w.size());
        double lost_below = 0, lost_above = 0;
        for (int64_t i = 0; i < std::min(taps, -first); ++i)
            lost_below += w[static_cast<size_t>(i)];
        for (int64_t i = std::max<int64_t>(0, n - first); i < taps; ++i)
            lost_above += w[static_cast<size_t>(i)];
        return std::abs(lost_below) + std::abs(lost_above);
    }
};

void check(double x, double y, const EncircledOptions &options) {
    if (!std::isfinite(x + y))
        fail(WFPSF_ERROR_NOT_FINITE, "centre = (%g, %g): must be finite", x, y);
    if (!(options.bandwidth > 0 && options.bandwidth < 0.5))
        fail(WFPSF_ERROR_RANGE, "bandwidth = %g: must lie between 0 and 1/2 cycles per sample",
             options.bandwidth);
    if (!(options.eps >= 1e-14 && options.eps <= 0.1))
        fail(WFPSF_ERROR_RANGE, "eps = %g: must be 1e-14..0.1", options.eps);
}

// From the centre to the nearest of the outermost samples' lines.
template <class T> double largest_radius(View<const T> image, double x, double y) {
    return std::min(
        {x, y, static_cast<double>(image.nx - 1) - x, static_cast<double>(image.ny - 1) - y});
}

int64_t margin_for(const EncircledOptions &options) {
    const BandlimitedInterpolator spare(PolarIntegral::filter_bandwidth(options, true),
                                        PolarIntegral::spare_eps(options));
    return spare.half_width() + 1;
}

// |difference| from the spare evaluation, plus the border's doubt.
double energy_error(const Samples &samples, double x, double y, double radius, double energy,
                    const EncircledOptions &options, double missing) {
    PolarIntegral spare(samples, x, y, options, true);
    const double rounding = 1e-13 * std::abs(energy);
    const double other = spare.annulus(0, radius);
    return std::abs(other - energy) + rounding +
           samples.border * 2 * pi * radius * std::max(missing, spare.missing());
}

} // namespace

template <class T>
EncircledEnergy encircled_energy(View<const T> image, double x, double y, double radius,
                                 const EncircledOptions &options) {
    check(x, y, options);
    const double limit = largest_radius(image, x, y);
    if (!(radius >= 0))
        fail(WFPSF_ERROR_RANGE, "radius = %g: must be 0 or more", radius);
    if (!(radius <= limit))
        fail(WFPSF_ERROR_SIZE_NOT_REACHED,
             "radius = %g: the circle around (%g, %g) stays inside the image up to %g", radius, x,
             y, limit);
    const Samples samples = padded_samples(image, margin_for(options));
    PolarIntegral integral(samples, x, y, options, false);
    EncircledEnergy result;
    result.energy = integral.annulus(0, radius);
    result.density = integral.ring(radius);
    result.error_estimate =
        energy_error(samples, x, y, radius, result.energy, options, integral.missing());
    return result;
}

template <class T>
EncircledRadius encircled_radius(View<const T> image, double x, double y, double fraction,
                                 double total, const EncircledOptions &options) {
    check(x, y, options);
    if (!(fraction > 0 && fraction <= 1))
        fail(WFPSF_ERROR_RANGE, "fraction = %g: must be above 0 and at most 1", fraction);
    if (!(total > 0 && std::isfinite(total)))
        fail(WFPSF_ERROR_RANGE, "total = %g: must be positive and finite", total);
    const double limit = largest_radius(image, x, y), target = fraction * total;
    if (!(limit > 0))
        fail(WFPSF_ERROR_SIZE_NOT_REACHED, "centre = (%g, %g): must lie inside the image", x, y);
    const Samples samples = padded_samples(image, margin_for(options));
    PolarIntegral integral(samples, x, y, options, false);

    // Newton's iteration on energy(R) = target, bracketed; each step integrates the annulus that it
    // crosses. A disc as bright as the brightest sample gives the lower bound to start at.
    EncircledRadius result;
    double low = 0, high = limit;
    double radius = std::min(limit, std::sqrt(target / (pi * samples.largest)));
    double energy = integral.annulus(0, radius);
    double density = integral.ring(radius);
    while (result.iterations < 100) {
        ++result.iterations;
        if (energy < target && radius >= limit)
            fail(WFPSF_ERROR_SIZE_NOT_REACHED,
                 "fraction = %g: the largest circle around (%g, %g), of radius %g, holds %.6g of "
                 "the total",
                 fraction, x, y, limit, energy / total);
        (energy < target ? low : high) = radius;
        const double newton = density > 0 ? (target - energy) / density : NAN;
        if (std::abs(newton) <= 1e-13 * radius || high - low <= 1e-13 * radius)
            break;
        double next = radius + newton;
        if (next >= limit && high == limit)
            next = limit;
        else if (!(next > low && next < high))
            next = (low + high) / 2;
        energy += integral.annulus(radius, next);
        radius = next;
        density = integral.ring(radius);
    }
    result.radius = radius;
    result.error_estimate =
        energy_error(samples, x, y, radius, energy, options, integral.missing()) /
            std::abs(density) +
        1e-13 * radius;
    return result;
}

template EncircledEnergy encircled_energy(View<const float>, double, double, double,
                                          const EncircledOptions &);
template EncircledEnergy encircled_energy(View<const double>, double, double, double,
                                          const EncircledOptions &);
template EncircledRadius encircled_radius(View<const float>, double, double, double, double,
                                          const EncircledOptions &);
template EncircledRadius encircled_radius(View<const double>, double, double, double, double,
                                          const EncircledOptions &);

} // namespace wfpsf
