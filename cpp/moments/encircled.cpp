// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/encircled.hpp"

#include "error/error.hpp"
#include "numerics/bandlimited.hpp"
#include "numerics/dispatch.hpp"
#include "numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// Sum of wy[j] wx[i] I(i, j) over taps inside the image; `column` is a workspace of nx numbers.
template <class T>
[[gnu::always_inline]] inline double weighted_taps(View<const T> taps, const double *wx,
                                                   const double *wy, double *column) {
    std::fill(column, column + taps.nx, 0.0);
    for (int64_t j = 0; j < taps.ny; ++j) {
        const T *row = taps.row(j);
        const double w = wy[j];
        if (taps.stride_x == 1)
            for (int64_t i = 0; i < taps.nx; ++i)
                column[i] += w * static_cast<double>(row[i]);
        else
            for (int64_t i = 0; i < taps.nx; ++i)
                column[i] += w * static_cast<double>(row[i * taps.stride_x]);
    }
    double sum = 0;
    for (int64_t i = 0; i < taps.nx; ++i)
        sum += wx[i] * column[i];
    return sum;
}
WFPSF_VECTORISED double tap_sum(View<const float> taps, const double *wx, const double *wy,
                                double *column) {
    return weighted_taps(taps, wx, wy, column);
}
WFPSF_VECTORISED double tap_sum(View<const double> taps, const double *wx, const double *wy,
                                double *column) {
    return weighted_taps(taps, wx, wy, column);
}

// The interpolator's weights from a table over the fraction of a sample, to the interpolator's
// accuracy: an exponential and a root for every tap of every node would take most of the time.
// Between the table's rows by Lagrange's polynomial on six of them, whose error on a function of
// frequencies up to 1/2 is (pi/rows)^6/200.
class TabulatedFilter {
  public:
    TabulatedFilter(const BandlimitedInterpolator &filter, double eps)
        : taps_(static_cast<size_t>(filter.taps())), half_width_(filter.half_width()),
          rows_(static_cast<int>(std::ceil(pi / std::pow(2 * eps, 1.0 / 6)))) {
        table_.reserve(static_cast<size_t>(rows_ + 5) * taps_);
        for (int row = -2; row <= rows_ + 2; ++row)
            for (size_t i = 0; i < taps_; ++i) {
                const double t =
                    static_cast<double>(i) - (half_width_ - 1) - static_cast<double>(row) / rows_;
                table_.push_back(std::abs(t) < half_width_ ? filter.kernel(t) : 0);
            }
    }

    // w[0 .. taps): returns the first sample's index.
    int64_t weights(double x, double *w) const {
        const double whole = std::floor(x), place = (x - whole) * rows_;
        const int row = std::min(static_cast<int>(place), rows_ - 1);
        const double u = place - row; // 0..1, between the third and the fourth of six rows
        const double a = u + 2, b = u + 1, c = u, d = u - 1, e = u - 2, f = u - 3;
        const double l[6] = {-b * c * d * e * f / 120, a * c * d * e * f / 24,
                             -a * b * d * e * f / 12,  a * b * c * e * f / 12,
                             -a * b * c * d * f / 24,  a * b * c * d * e / 120};
        const double *first = table_.data() + static_cast<size_t>(row) * taps_;
        for (size_t i = 0; i < taps_; ++i) {
            double sum = 0;
            for (size_t k = 0; k < 6; ++k)
                sum += l[k] * first[k * taps_ + i];
            w[i] = sum;
        }
        return static_cast<int64_t>(whole) - (half_width_ - 1);
    }
    size_t taps() const { return taps_; }

  private:
    size_t taps_;
    int half_width_, rows_;
    std::vector<double> table_;
};

// The largest absolute sample of the outermost ones.
template <class T> double brightest_border(View<const T> image) {
    double largest = 0;
    const auto look = [&](int64_t x, int64_t y) {
        largest = std::max(largest, std::abs(static_cast<double>(image(x, y))));
    };
    for (int64_t x = 0; x < image.nx; ++x) {
        look(x, 0);
        look(x, image.ny - 1);
    }
    for (int64_t y = 0; y < image.ny; ++y) {
        look(0, y);
        look(image.nx - 1, y);
    }
    return largest;
}

// Polar quadrature of the interpolated image. Both rules converge exponentially: Gauss-Legendre in
// r, the trapezoid in the angle.
template <class T> class PolarIntegral {
  public:
    // A second integral with spare = true has a finer filter and other nodes.
    PolarIntegral(View<const T> samples, double x, double y, const EncircledOptions &options,
                  bool spare)
        : samples_(samples), x_(x), y_(y), wavenumber_(2 * pi * options.bandwidth),
          eps_(spare ? spare_eps(options) : options.eps), spare_(spare),
          filter_({filter_bandwidth(options, spare), eps_}, std::max(1e-15, eps_ / 100)),
          wx_(filter_.taps()), wy_(wx_), column_(wx_) {}

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

    // The image between the samples; those beyond the border count as zero.
    double value(double x, double y) {
        const auto taps = static_cast<int64_t>(wx_.size());
        const int64_t x0 = filter_.weights(x, wx_.data()), y0 = filter_.weights(y, wy_.data());
        missing_ = std::max({missing_, beyond(wx_, x0, samples_.nx), beyond(wy_, y0, samples_.ny)});
        const int64_t left = std::clamp<int64_t>(-x0, 0, taps);
        const int64_t below = std::clamp<int64_t>(-y0, 0, taps);
        const View<const T> inside{samples_.data + (y0 + below) * samples_.stride_y +
                                       (x0 + left) * samples_.stride_x,
                                   std::clamp<int64_t>(samples_.nx - x0, left, taps) - left,
                                   std::clamp<int64_t>(samples_.ny - y0, below, taps) - below,
                                   samples_.stride_x, samples_.stride_y};
        return tap_sum(inside, wx_.data() + left, wy_.data() + below, column_.data());
    }

    // The largest share of a node's filter that lay beyond the border.
    double missing() const { return missing_; }

  private:
    View<const T> samples_;
    double x_, y_, wavenumber_, eps_;
    bool spare_;
    TabulatedFilter filter_;
    std::vector<double> wx_, wy_, column_;
    double missing_ = 0;

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

template <class T> void check_radius(View<const T> image, double x, double y, double radius) {
    const double limit = largest_radius(image, x, y);
    if (!(radius >= 0))
        fail(WFPSF_ERROR_RANGE, "radius = %g: must be 0 or more", radius);
    if (!(radius <= limit))
        fail(WFPSF_ERROR_SIZE_NOT_REACHED,
             "radius = %g: the circle around (%g, %g) stays inside the image up to %g", radius, x,
             y, limit);
}

double checked_energy(double energy) {
    if (!std::isfinite(energy))
        fail(WFPSF_ERROR_NOT_FINITE, "energy = %g: samples in and near the circle must be finite",
             energy);
    return energy;
}

// |difference| from the spare evaluation, plus the border's doubt.
template <class T>
double energy_error(View<const T> samples, double x, double y, double radius, double energy,
                    const EncircledOptions &options, double missing) {
    PolarIntegral<T> spare(samples, x, y, options, true);
    const double rounding = 1e-13 * std::abs(energy);
    const double other = spare.annulus(0, radius);
    // The spare evaluation is wrong itself by a hundredth of that.
    return 1.1 * std::abs(other - energy) + rounding +
           brightest_border(samples) * 2 * pi * radius * std::max(missing, spare.missing());
}

} // namespace

template <class T>
EncircledEnergy encircled_energy(View<const T> image, double x, double y, double radius,
                                 const EncircledOptions &options) {
    check(x, y, options);
    check_radius(image, x, y, radius);
    PolarIntegral<T> integral(image, x, y, options, false);
    EncircledEnergy result;
    result.energy = checked_energy(integral.annulus(0, radius));
    result.density = integral.ring(radius);
    result.error_estimate =
        energy_error(image, x, y, radius, result.energy, options, integral.missing());
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
    PolarIntegral<T> integral(image, x, y, options, false);

    // Newton's iteration on energy(R) = target, bracketed; each step integrates the annulus that it
    // crosses. The first radius is that of a disc as bright as the centre.
    EncircledRadius result;
    double low = 0, high = limit;
    const double centre = checked_energy(integral.value(x, y));
    double radius = centre > 0 ? std::min(limit, std::sqrt(target / (pi * centre))) : limit;
    double energy = checked_energy(integral.annulus(0, radius));
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
        energy = checked_energy(energy + integral.annulus(radius, next));
        radius = next;
        density = integral.ring(radius);
    }
    result.radius = radius;
    result.density = density;
    result.error_estimate =
        energy_error(image, x, y, radius, energy, options, integral.missing()) / std::abs(density) +
        1e-13 * radius;
    return result;
}

template <class T>
double ring_mean(View<const T> image, double x, double y, double radius,
                 const EncircledOptions &options) {
    check(x, y, options);
    check_radius(image, x, y, radius);
    PolarIntegral<T> integral(image, x, y, options, false);
    return checked_energy(radius == 0 ? integral.value(x, y)
                                      : integral.ring(radius) / (2 * pi * radius));
}

template <class T>
double profile_fwhm(View<const T> image, double x, double y, const EncircledOptions &options) {
    check(x, y, options);
    check_radius(image, x, y, 0);
    const double limit = largest_radius(image, x, y);
    PolarIntegral<T> integral(image, x, y, options, false);
    const double half = checked_energy(integral.value(x, y)) / 2;
    if (!(half > 0))
        fail(WFPSF_ERROR_MOMENTS_FLUX, "the image at (%g, %g) = %g: must be positive", x, y,
             2 * half);
    const auto excess = [&](double r) {
        return checked_energy(integral.ring(r) / (2 * pi * r)) - half;
    };
    // Steps too short to pass by a trough, then the secant between the ends that bracket the root,
    // an end that stays being halved (Illinois).
    const double step = 0.1 / options.bandwidth;
    double low = 0, high = 0, at_low = half, at_high = half;
    while (at_high > 0) {
        low = high;
        at_low = at_high;
        high = std::min(high + step, limit);
        if (!(high > low))
            fail(WFPSF_ERROR_SIZE_NOT_REACHED,
                 "the profile around (%g, %g) stays above half of its centre up to %g", x, y,
                 limit);
        at_high = excess(high);
    }
    for (int i = 0; i < 100 && high - low > 1e-13 * high; ++i) {
        const double next = high - at_high * (high - low) / (at_high - at_low);
        if (!(next > low && next < high))
            break;
        const double at_next = excess(next);
        if (at_next > 0) {
            low = next;
            at_low = at_next;
            at_high /= 2;
        } else {
            high = next;
            at_high = at_next;
            at_low /= 2;
        }
        if (at_next == 0)
            break;
    }
    return low + high;
}

template EncircledEnergy encircled_energy(View<const float>, double, double, double,
                                          const EncircledOptions &);
template EncircledEnergy encircled_energy(View<const double>, double, double, double,
                                          const EncircledOptions &);
template EncircledRadius encircled_radius(View<const float>, double, double, double, double,
                                          const EncircledOptions &);
template EncircledRadius encircled_radius(View<const double>, double, double, double, double,
                                          const EncircledOptions &);

template double ring_mean(View<const float>, double, double, double, const EncircledOptions &);
template double profile_fwhm(View<const float>, double, double, const EncircledOptions &);
template double ring_mean(View<const double>, double, double, double, const EncircledOptions &);
template double profile_fwhm(View<const double>, double, double, const EncircledOptions &);

} // namespace wfpsf
