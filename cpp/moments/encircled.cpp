// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/encircled.hpp"

#include "error/error.hpp"
#include "numerics/bandlimited.hpp"
#include "numerics/dispatch.hpp"
#include "numerics/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// out[i] = sum over j of w[j] I(i, j).
template <class T>
[[gnu::always_inline]] inline void weighted_rows(View<const T> rows, const double *w, double *out) {
    std::fill(out, out + rows.nx, 0.0);
    for (int64_t j = 0; j < rows.ny; ++j) {
        const T *row = rows.row(j);
        const double weight = w[j];
        if (rows.stride_x == 1)
            for (int64_t i = 0; i < rows.nx; ++i)
                out[i] += weight * static_cast<double>(row[i]);
        else
            for (int64_t i = 0; i < rows.nx; ++i)
                out[i] += weight * static_cast<double>(row[i * rows.stride_x]);
    }
}
WFPSF_VECTORISED void sum_rows(View<const float> rows, const double *w, double *out) {
    weighted_rows(rows, w, out);
}
WFPSF_VECTORISED void sum_rows(View<const double> rows, const double *w, double *out) {
    weighted_rows(rows, w, out);
}

WFPSF_VECTORISED double product(const double *w, const double *samples, size_t n) {
    double part[8] = {};
    size_t i = 0;
    for (; i + 8 <= n; i += 8)
        for (size_t k = 0; k < 8; ++k)
            part[k] += w[i + k] * samples[i + k];
    for (; i < n; ++i)
        part[0] += w[i] * samples[i];
    return ((part[0] + part[1]) + (part[2] + part[3])) +
           ((part[4] + part[5]) + (part[6] + part[7]));
}

WFPSF_VECTORISED double sum_of(const double *samples, int64_t n) {
    double part[8] = {};
    int64_t i = 0;
    for (; i + 8 <= n; i += 8)
        for (int64_t k = 0; k < 8; ++k)
            part[k] += samples[i + k];
    for (; i < n; ++i)
        part[0] += samples[i];
    return ((part[0] + part[1]) + (part[2] + part[3])) +
           ((part[4] + part[5]) + (part[6] + part[7]));
}

// Lagrange's polynomials on ten points at steps of one, between the fifth and the sixth, and their
// derivatives.
constexpr int points = 10;

// 1/((k - m) ...) over all other points m.
constexpr std::array<double, points> lagrange_scale = [] {
    std::array<double, points> scale{};
    for (int k = 0; k < points; ++k) {
        double f = 1;
        for (int m = 0; m < points; ++m)
            if (m != k)
                f *= k - m;
        scale[static_cast<size_t>(k)] = 1 / f;
    }
    return scale;
}();

struct Lagrange {
    double value[points], slope[points];

    Lagrange(double u, bool with_slope) { // 0..1 from the fifth point
        double after[points + 1] = {}, after_slope[points + 1] = {};
        after[points] = 1;
        for (int k = points - 1; k >= 0; --k) {
            after[k] = after[k + 1] * (u + 4 - k);
            if (with_slope)
                after_slope[k] = after_slope[k + 1] * (u + 4 - k) + after[k + 1];
        }
        double before = 1, before_slope = 0;
        for (int k = 0; k < points; ++k) {
            const double scale = lagrange_scale[static_cast<size_t>(k)];
            value[k] = scale * before * after[k + 1];
            slope[k] = scale * (before_slope * after[k + 1] + before * after_slope[k + 1]);
            before_slope = before_slope * (u + 4 - k) + before;
            before *= u + 4 - k;
        }
    }
};

// out = factor * sum of l[k] times the k-th of ten rows.
WFPSF_VECTORISED void combine(const double *rows, size_t taps, const double *l, double factor,
                              double *out) {
    for (size_t i = 0; i < taps; ++i)
        out[i] = 0;
    for (size_t k = 0; k < points; k += 5) { // five at a time, to load and store less
        const double *r = rows + k * taps;
        const double a = factor * l[k], b = factor * l[k + 1], c = factor * l[k + 2],
                     d = factor * l[k + 3], e = factor * l[k + 4];
        for (size_t i = 0; i < taps; ++i)
            out[i] += a * r[i] + b * r[taps + i] + c * r[2 * taps + i] + d * r[3 * taps + i] +
                      e * r[4 * taps + i];
    }
}

// The interpolator's kernel, its derivative and its integral from a table over the fraction of a
// sample: an exponential and a root for every tap would take most of the time. Between the table's
// rows by polynomials on ten of them, whose derivative's error on a function of frequencies up to
// 1/2 is below (pi/rows)^9/1000.
class TabulatedFilter {
  public:
    TabulatedFilter(const BandlimitedInterpolator &filter, double eps)
        : taps_(static_cast<size_t>(filter.taps())), half_width_(filter.half_width()),
          rows_(static_cast<int>(std::ceil(pi / std::pow(1000 * eps, 1.0 / 9)))) {
        const size_t rows = static_cast<size_t>(rows_ + points - 1);
        kernel_.reserve(rows * taps_);
        for (int row = -4; row <= rows_ + 4; ++row)
            for (size_t i = 0; i < taps_; ++i) {
                const double t = distance(row, i);
                kernel_.push_back(std::abs(t) < half_width_ ? filter.kernel(t) : 0);
            }
        tabulate_integral();
    }

    // For the samples from the one that is returned on: what they add to the function at x, to its
    // derivative, and to its integral up to x. Samples before them add themselves to the last.
    int64_t weights(double x, double *value, double *slope, double *integral) const {
        const double whole = std::floor(x), place = (x - whole) * rows_;
        const int row = std::min(static_cast<int>(place), rows_ - 1);
        const Lagrange l(place - row, slope != nullptr);
        combine(row_of(kernel_, row), taps_, l.value, 1, value);
        if (slope)
            combine(row_of(kernel_, row), taps_, l.slope, rows_, slope);
        if (integral)
            combine(row_of(integral_, row), taps_, l.value, 1, integral);
        return static_cast<int64_t>(whole) - (half_width_ - 1);
    }
    size_t taps() const { return taps_; }

  private:
    size_t taps_;
    int half_width_, rows_;
    std::vector<double> kernel_, integral_; // tables of rows -4 .. rows + 4

    // From x to a sample, at a row's fraction.
    double distance(int row, size_t tap) const {
        return static_cast<double>(tap) - (half_width_ - 1) - static_cast<double>(row) / rows_;
    }

    const double *row_of(const std::vector<double> &table, int row) const {
        return table.data() + static_cast<size_t>(row) * taps_; // and the nine after it
    }

    // The share of the kernel around a sample that lies before x: the table's polynomials
    // integrated from row to row, tap after tap.
    void tabulate_integral() {
        static const GaussLegendre rule(points / 2);
        double step[points] = {};
        for (int i = 0; i < rule.size(); ++i) {
            const auto k = static_cast<size_t>(i);
            const Lagrange l((1 + rule.x[k]) / 2, false);
            for (int m = 0; m < points; ++m)
                step[m] += rule.w[k] / 2 * l.value[m];
        }
        // along[n]: at the distance n/rows - half_width.
        const int count = 2 * half_width_ * rows_;
        const auto kernel = [&](int n) { // at that distance, from the table; 0 outside
            if (n <= 0 || n >= count)
                return 0.0;
            const int tap = n / rows_, row = rows_ - n % rows_;
            return kernel_[static_cast<size_t>(4 + row) * taps_ + static_cast<size_t>(tap)];
        };
        std::vector<double> along(static_cast<size_t>(count) + 1);
        for (int n = 0; n < count; ++n) {
            double sum = 0;
            for (int m = 0; m < points; ++m)
                sum += step[m] * kernel(n + m - 4);
            along[static_cast<size_t>(n) + 1] = along[static_cast<size_t>(n)] + sum / rows_;
        }
        const double whole = along.back();
        integral_.reserve(kernel_.size());
        for (int row = -4; row <= rows_ + 4; ++row)
            for (size_t i = 0; i < taps_; ++i) {
                const int n = (static_cast<int>(i) + 1) * rows_ - row;
                integral_.push_back(1 -
                                    along[static_cast<size_t>(std::clamp(n, 0, count))] / whole);
            }
    }
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

// Integrals of the interpolated image over a disc, chord by chord. At the angle t a chord runs
// through (0, R sin t), 2 R cos t long, and
//   energy = integral of R cos t (integral of I along the chord) dt, -pi/2 < t < pi/2,
// which is half of that over the whole circle, of a smooth periodic function: equal steps converge
// exponentially. Rows of samples are filtered along y to a chord, and summed along it; near its
// ends the sum's weights are the integral of the interpolator's kernel. The image at the chords'
// ends gives the integral along the circle.
template <class T> class DiscIntegral {
  public:
    // A second integral with spare = true has a finer filter and other nodes.
    DiscIntegral(View<const T> samples, double x, double y, const EncircledOptions &options,
                 bool spare)
        : samples_(samples), x_(x), y_(y), wavenumber_(2 * pi * options.bandwidth),
          eps_(spare ? spare_eps(options) : options.eps), spare_(spare),
          filter_({filter_bandwidth(options, spare), eps_}, std::max(1e-15, eps_ / 100)),
          wy_(filter_.taps()), slope_y_(wy_), wx_(wy_), slope_x_(wy_), step_(wy_) {}

    static double spare_eps(const EncircledOptions &options) {
        return std::max(1e-14, options.eps / 100);
    }
    static double filter_bandwidth(const EncircledOptions &options, bool spare) {
        return spare ? options.bandwidth + (0.5 - options.bandwidth) / 4 : options.bandwidth;
    }

    struct Sums {
        double energy = 0, density = 0, slope = 0;
    };
    // `slope` is left out, unless it is asked for.
    Sums within(double radius, bool with_slope = false) {
        const double K = wavenumber_ * radius;
        // The error of n steps around the circle is about J_n(K), which is eps at
        // n = K + z (K/2)^(1/3), where Ai(z) = eps; at small K it falls like (K/2)^n/n!.
        const double z = std::pow(1.5 * std::log(1 / eps_), 2.0 / 3);
        const int chords =
            static_cast<int>(std::ceil((K + z * std::cbrt(K / 2)) / 2)) + (spare_ ? 8 : 6);
        Sums sums;
        lost_ = lost_at_ends_ = 0;
        for (int i = 0; i < chords; ++i) {
            const double angle = pi * ((i + 0.5) / chords - 0.5);
            const double half = radius * std::cos(angle), up = std::sin(angle);
            const Chord chord = along(y_ + radius * up, x_ - half, x_ + half, with_slope);
            sums.energy += half * chord.integral;
            sums.density += chord.left + chord.right;
            sums.slope += up * chord.slope_y + std::cos(angle) * chord.slope_x;
            lost_ += half * chord.lost;
            lost_at_ends_ = std::max(lost_at_ends_, chord.lost_at_ends);
        }
        const double width = pi / chords;
        sums.energy *= width;
        sums.slope = width * (sums.density + radius * sums.slope);
        sums.density *= width * radius;
        lost_ *= width;
        return sums;
    }

    // The image between the samples; those beyond the border count as zero.
    double value(double x, double y) { return along(y, x, x, false).left; }

    // By how much the last disc's energy and a value on its circle could be wrong, if samples
    // beyond the border were one.
    double lost() const { return lost_; }
    double lost_at_ends() const { return lost_at_ends_; }

  private:
    View<const T> samples_;
    double x_, y_, wavenumber_, eps_;
    bool spare_;
    TabulatedFilter filter_;
    std::vector<double> wy_, slope_y_, wx_, slope_x_, step_; // weights
    std::vector<double> row_, slope_row_;
    double lost_ = 0, lost_at_ends_ = 0;

    struct Chord {
        double integral = 0, left = 0, right = 0; // the image at the ends
        double slope_x = 0, slope_y = 0;          // right less left; both together
        double lost = 0, lost_at_ends = 0;
    };

    Chord along(double y, double left, double right, bool with_slope) {
        const auto taps = static_cast<int64_t>(filter_.taps());
        const int64_t y0 =
            filter_.weights(y, wy_.data(), with_slope ? slope_y_.data() : nullptr, nullptr);
        const int64_t begin = static_cast<int64_t>(std::floor(left)) - (taps / 2 - 1);
        const int64_t end = static_cast<int64_t>(std::floor(right)) - (taps / 2 - 1) + taps;
        fill_row(begin, end, y0, wy_, row_);
        if (with_slope)
            fill_row(begin, end, y0, slope_y_, slope_row_);
        Chord chord;
        const auto at_end = [&](double x, double sign) {
            const int64_t x0 = filter_.weights(
                x, wx_.data(), with_slope ? slope_x_.data() : nullptr, step_.data());
            const double *samples = row_.data() + (x0 - begin);
            (sign > 0 ? chord.right : chord.left) = product(wx_.data(), samples, wx_.size());
            chord.integral += sign * product(step_.data(), samples, wx_.size());
            if (with_slope) {
                chord.slope_x += sign * product(slope_x_.data(), samples, wx_.size());
                chord.slope_y += product(wx_.data(), slope_row_.data() + (x0 - begin), wx_.size());
            }
            chord.lost += beyond(step_, x0, samples_.nx);
            chord.lost_at_ends = std::max(chord.lost_at_ends, beyond(wx_, x0, samples_.nx));
        };
        at_end(left, -1);
        at_end(right, 1);
        chord.integral += sum_of(row_.data(), end - taps - begin);
        const double lost_y = beyond(wy_, y0, samples_.ny);
        chord.lost += lost_y * (right - left);
        chord.lost_at_ends += lost_y;
        return chord;
    }

    // The samples begin..end-1 of a row between rows.
    void fill_row(int64_t begin, int64_t end, int64_t y0, const std::vector<double> &w,
                  std::vector<double> &row) const {
        const auto taps = static_cast<int64_t>(w.size());
        row.assign(static_cast<size_t>(end - begin), 0.0);
        const int64_t left = std::clamp<int64_t>(begin, 0, samples_.nx);
        const int64_t right = std::clamp<int64_t>(end, left, samples_.nx);
        const int64_t below = std::clamp<int64_t>(y0, 0, samples_.ny);
        const int64_t above = std::clamp<int64_t>(y0 + taps, below, samples_.ny);
        if (left == right || below == above)
            return;
        sum_rows(View<const T>{samples_.row(below) + left * samples_.stride_x, right - left,
                               above - below, samples_.stride_x, samples_.stride_y},
                 w.data() + (below - y0), row.data() + (left - begin));
    }

    // What weights beyond the border add up to.
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

constexpr double rounding = 1e-13;

// Twice: a spare evaluation is asked to be a hundred times better, but where the first is good by
// chance the difference is in part its own error.
double difference(double one, double other) {
    return 2 * std::abs(one - other) + rounding * std::abs(one);
}

template <class T>
DiscLight light_within(DiscIntegral<T> &integral, View<const T> image, double x, double y,
                       double radius, const EncircledOptions &options, bool with_slope) {
    DiscIntegral<T> spare(image, x, y, options, true);
    const auto sums = integral.within(radius, with_slope);
    const auto other = spare.within(radius, with_slope);
    const double border = brightest_border(image);
    const double at_ends =
        border * 2 * pi * std::max(integral.lost_at_ends(), spare.lost_at_ends());
    DiscLight result;
    result.energy = checked_energy(sums.energy);
    result.density = sums.density;
    result.energy_error =
        difference(sums.energy, other.energy) + border * std::max(integral.lost(), spare.lost());
    result.density_error = difference(sums.density, other.density) + radius * at_ends;
    if (with_slope) {
        result.slope = sums.slope;
        // A value's slope is at most its size times the wavenumber.
        result.slope_error = difference(sums.slope, other.slope) +
                             (1 + 2 * pi * options.bandwidth * radius) * at_ends;
    }
    return result;
}

} // namespace

template <class T>
DiscLight disc_light(View<const T> image, double x, double y, double radius,
                     const EncircledOptions &options) {
    check(x, y, options);
    check_radius(image, x, y, radius);
    DiscIntegral<T> integral(image, x, y, options, false);
    return light_within(integral, image, x, y, radius, options, true);
}

template <class T>
Estimated encircled_radius(View<const T> image, double x, double y, double fraction, double total,
                           const EncircledOptions &options) {
    check(x, y, options);
    if (!(fraction > 0 && fraction <= 1))
        fail(WFPSF_ERROR_RANGE, "fraction = %g: must be above 0 and at most 1", fraction);
    if (!(total > 0 && std::isfinite(total)))
        fail(WFPSF_ERROR_RANGE, "total = %g: must be positive and finite", total);
    const double limit = largest_radius(image, x, y), target = fraction * total;
    if (!(limit > 0))
        fail(WFPSF_ERROR_SIZE_NOT_REACHED, "centre = (%g, %g): must lie inside the image", x, y);
    DiscIntegral<T> integral(image, x, y, options, false);
    DiscIntegral<T> rough(image, x, y, {options.bandwidth, std::max(1e-3, options.eps)}, false);

    // Newton's iteration on energy(R) = target, bracketed. The first radius is that of a disc as
    // bright as the centre; the first steps need no precision.
    double low = 0, high = limit;
    const double centre = checked_energy(integral.value(x, y));
    double radius = centre > 0 ? std::min(limit, std::sqrt(target / (pi * centre))) : limit;
    bool near = false;
    for (int i = 0; i < 100; ++i) {
        const auto sums = (near ? integral : rough).within(radius);
        checked_energy(sums.energy);
        const double newton = sums.density > 0 ? (target - sums.energy) / sums.density : NAN;
        if (!near &&
            (std::abs(newton) <= 1e-2 * radius || high - low <= 1e-2 * radius || radius >= limit)) {
            near = true;
            low = 0;
            high = limit;
            if (std::abs(newton) <= 1e-2 * radius)
                radius = std::min(limit, radius + newton);
            continue;
        }
        if (sums.energy < target && radius >= limit)
            fail(WFPSF_ERROR_SIZE_NOT_REACHED,
                 "fraction = %g: the largest circle around (%g, %g), of radius %g, holds %.6g of "
                 "the total",
                 fraction, x, y, limit, sums.energy / total);
        (sums.energy < target ? low : high) = radius;
        if (std::abs(newton) <= 1e-13 * radius || high - low <= 1e-13 * radius)
            break;
        double next = radius + newton;
        if (next >= limit && high == limit)
            next = limit;
        else if (!(next > low && next < high))
            next = (low + high) / 2;
        radius = next;
        // Newton's steps shrink quadratically.
        if (std::abs(newton) <= 1e-8 * radius)
            break;
    }
    const DiscLight there = light_within(integral, image, x, y, radius, options, false);
    return {radius,
            (there.energy_error + std::abs(there.energy - target)) / std::abs(there.density) +
                rounding * radius};
}

Estimated radius_slope(const Estimated &radius, const DiscLight &image, const HeldChange &a) {
    const double d = image.density, slope = (a.held - a.disc.energy) / d;
    const double by_radius = (a.disc.density + slope * image.slope) / d;
    return {slope, (a.disc.energy_error + rounding * std::abs(a.held) +
                    std::abs(slope) * image.density_error) /
                           std::abs(d) +
                       std::abs(by_radius) * radius.error_estimate};
}

// (E + s E_A + t E_B)(R) = held + s held_A + t held_B, differentiated by s, and by s and t:
//   E' R_s + E_A = held_A,   E' R_st + E'' R_s R_t + E_A' R_t + E_B' R_s = 0.
Estimated radius_curvature(const Estimated &radius, const DiscLight &image, const HeldChange &a,
                           const HeldChange &b, const EncircledOptions &options) {
    const Estimated by_a = radius_slope(radius, image, a), by_b = radius_slope(radius, image, b);
    const double ra = by_a.value, rb = by_b.value, d = image.density;
    const double sum = image.slope * ra * rb + a.disc.density * rb + b.disc.density * ra;
    // By what the sum is made of: the two slopes, and the radius. The energy's third derivative is
    // at most about the wavenumber squared times the first.
    const double by_ra = image.slope * rb + b.disc.density;
    const double by_rb = image.slope * ra + a.disc.density;
    const double k = 2 * pi * options.bandwidth;
    const double by_radius = k * k * std::abs(d * ra * rb) + std::abs(a.disc.slope * rb) +
                             std::abs(b.disc.slope * ra) + std::abs(sum * image.slope / d);
    const double error =
        image.slope_error * std::abs(ra * rb) + a.disc.density_error * std::abs(rb) +
        b.disc.density_error * std::abs(ra) + std::abs(by_ra) * by_a.error_estimate +
        std::abs(by_rb) * by_b.error_estimate + std::abs(sum / d) * image.density_error +
        by_radius * radius.error_estimate;
    return {-sum / d, error / std::abs(d) + rounding * std::abs(sum / d)};
}

template <class T>
Estimated ring_mean(View<const T> image, double x, double y, double radius,
                    const EncircledOptions &options) {
    check(x, y, options);
    check_radius(image, x, y, radius);
    DiscIntegral<T> integral(image, x, y, options, false);
    if (radius > 0) {
        const DiscLight light = light_within(integral, image, x, y, radius, options, false);
        return {light.density / (2 * pi * radius), light.density_error / (2 * pi * radius)};
    }
    DiscIntegral<T> spare(image, x, y, options, true);
    const double value = checked_energy(integral.value(x, y));
    return {value, difference(value, spare.value(x, y))};
}

template <class T>
Estimated profile_fwhm(View<const T> image, double x, double y, const EncircledOptions &options) {
    const Estimated centre = ring_mean(image, x, y, 0, options);
    const double limit = largest_radius(image, x, y), half = centre.value / 2;
    if (!(half > 0))
        fail(WFPSF_ERROR_MOMENTS_FLUX, "the image at (%g, %g) = %g: must be positive", x, y,
             centre.value);
    DiscIntegral<T> integral(image, x, y, options, false);
    const auto excess = [&](double r) {
        return checked_energy(integral.within(r).density / (2 * pi * r)) - half;
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
    // The profile's slope, (E'' - E'/r)/(2 pi r), turns its error into one of the radius.
    const double radius = (low + high) / 2;
    const DiscLight light = light_within(integral, image, x, y, radius, options, true);
    const double slope = (light.slope - light.density / radius) / (2 * pi * radius);
    const double error = light.density_error / (2 * pi * radius) + centre.error_estimate / 2;
    return {low + high, 2 * error / std::abs(slope) + (high - low) + rounding * high};
}

template DiscLight disc_light(View<const float>, double, double, double, const EncircledOptions &);
template Estimated encircled_radius(View<const float>, double, double, double, double,
                                    const EncircledOptions &);
template Estimated ring_mean(View<const float>, double, double, double, const EncircledOptions &);
template Estimated profile_fwhm(View<const float>, double, double, const EncircledOptions &);
template DiscLight disc_light(View<const double>, double, double, double, const EncircledOptions &);
template Estimated encircled_radius(View<const double>, double, double, double, double,
                                    const EncircledOptions &);
template Estimated ring_mean(View<const double>, double, double, double, const EncircledOptions &);
template Estimated profile_fwhm(View<const double>, double, double, const EncircledOptions &);

} // namespace wfpsf
