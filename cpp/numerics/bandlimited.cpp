// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/bandlimited.hpp"

#include "error/error.hpp"
#include "numerics/dispatch.hpp"
#include "numerics/elementary.hpp"
#include "numerics/quadrature.hpp"
#include "numerics/sinc.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// Measured over all frequencies of the band and all positions (tests/unit/numerics): the worst
// error of the kernel lies below this many times exp(-beta), down to rounding.
constexpr double error_factor = 8;
constexpr double rounding = AveragedSamples::rounding;

// exp(beta (sqrt(1 - u^2) - 1)), without what its difference would lose near the middle.
[[gnu::always_inline]] inline double window(double beta, double u) {
    const double squared = std::min(1.0, u * u);
    return branchless_exp(-beta * squared / (1 + std::sqrt(1 - squared)));
}

// The kernel `half_width` samples before a place and as many behind it: numerator is sin(pi t) / pi
// of the first sample's distance, and has the other sign at the next.
WFPSF_VECTORISED void windowed_sinc(double beta, int half_width, double offset, double numerator,
                                    double *w) {
    const double scale = 1.0 / half_width;
    for (int k = 0; k < 2 * half_width; ++k) {
        const double t = offset + (half_width - 1 - k);
        w[k] = window(beta, t * scale) * (numerator - 2 * (k % 2) * numerator) / t;
    }
}

} // namespace

BandlimitedInterpolator::BandlimitedInterpolator(double bandwidth, double eps) {
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
    return t == 0 ? 1 : window(beta_, u) * std::sin(pi * t) / (pi * t);
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
    windowed_sinc(beta_, half_width_, offset, numerator, w);
    return first;
}

std::vector<double> BandlimitedInterpolator::averaging_filter(double width) const {
    if (width == 0)
        return {1};
    const int m = static_cast<int>(std::ceil(half_width_ + width / 2));
    std::vector<double> filter(static_cast<size_t>(2 * m + 1));
    const GaussLegendre rule(14);
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

namespace {

// The spectrum of |A|^2 of a fully lit outline, integrated over the other axis, at a fraction of
// the bandwidth; its integral over -1..1 is one. That is the autocorrelation of the outline's
// width: of a constant, or of a semicircle (x = -s + (1 - s) cos t).
double outline_spectrum(Outline outline, double s) {
    if (outline == Outline::square)
        return 1 - s;
    constexpr int n = 32;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double c = std::cos(pi * (i + 0.5) / n);
        sum += (1 - c * c) * std::sqrt((1 + s) * (1 + s) - (1 - s) * (1 - s) * c * c);
    }
    return 8 / (pi * n) * (1 - s) * (1 - s) * sum;
}

// What a wave of each of these frequencies weighs in the error of AveragedSamples: quadrature over
// the spectrum.
struct Spectrum {
    std::vector<double> frequency, weight;
    // For the errors of filters of about the given half width, which are waves of such lengths.
    Spectrum(double bandwidth, Outline outline, int half_width) {
        const GaussLegendre rule(24 + static_cast<int>(2 * bandwidth * half_width));
        for (size_t i = 0; i < rule.x.size(); ++i) {
            const double s = (1 + rule.x[i]) / 2;
            frequency.push_back(bandwidth * s);
            weight.push_back(rule.w[i] * outline_spectrum(outline, s));
        }
    }
};

// The interpolation's error, integrated over the spectrum of averaged samples, at the worst of some
// positions between two samples.
double interpolation_error(const BandlimitedInterpolator &interpolator, double width,
                           const Spectrum &spectrum) {
    std::vector<double> w(static_cast<size_t>(interpolator.taps()));
    double worst = 0;
    for (const double x : {0.125, 0.25, 0.375, 0.5}) {
        const auto first = static_cast<double>(interpolator.weights(x, w.data()));
        double sum = 0;
        for (size_t i = 0; i < spectrum.weight.size(); ++i) {
            const double f = spectrum.frequency[i];
            const std::complex<double> turn = std::polar(1.0, 2 * pi * f);
            std::complex<double> wave = std::polar(1.0, 2 * pi * f * (first - x)), value = -1;
            for (const double weight : w) {
                value += weight * wave;
                wave *= turn;
            }
            sum += spectrum.weight[i] * std::abs(sinc(width * f)) * std::abs(value);
        }
        worst = std::max(worst, sum);
    }
    return worst;
}

double averaging_error(const std::vector<double> &filter, double width, const Spectrum &spectrum) {
    const size_t middle = filter.size() / 2;
    double sum = 0;
    for (size_t i = 0; i < spectrum.weight.size(); ++i) {
        // Chebyshev's recurrence for cos 2 pi f j.
        const double c = std::cos(2 * pi * spectrum.frequency[i]);
        double below = c, here = 1, response = -sinc(width * spectrum.frequency[i]);
        for (size_t j = 0; j <= middle; ++j) {
            response += (j == 0 ? 1 : 2) * filter[middle + j] * here;
            below = std::exchange(here, 2 * c * here - below);
        }
        sum += spectrum.weight[i] * std::abs(response);
    }
    return sum;
}

} // namespace

double outline_strength(Outline outline, double extent, double area) {
    const double filled = (outline == Outline::square ? 1 : pi / 4) * extent * extent / area;
    return filled * filled;
}

// The windows' cutoff lies inside the band by as much as was found to serve best at all bandwidths
// and lengths; the error is then not assumed but summed up.
AveragedSamples::AveragedSamples(double bandwidth, double width, Outline outline, double eps)
    : interpolator_(2, 0) {
    if (!(bandwidth > 0 && bandwidth < 0.5))
        fail(WFPSF_ERROR_RANGE, "bandwidth = %g: must lie between 0 and 1/2 cycles per sample",
             bandwidth);
    const double deeper = outline == Outline::square ? 1.2 : 1.6; // added to beta
    constexpr double safety = 1.25; // for places and frequencies between those summed over
    constexpr int widest = 64;
    const double beta_per_sample = 2 * pi * (0.5 - bandwidth);
    const auto with_half_width = [&](int h) {
        return BandlimitedInterpolator(h, beta_per_sample * h + deeper);
    };
    // Of one axis, for both filters; the average is the cheaper one to make better.
    const double share = (std::max(eps, 3 * rounding) - rounding) / (2 * safety);
    // No shorter filter was ever good enough.
    const int shortest = std::max(2, static_cast<int>(std::log(0.02 / share) / beta_per_sample));
    const Spectrum spectrum(bandwidth, outline, shortest);
    double interpolating = 0, averaging = 0;
    for (int h = shortest; h <= widest; ++h) {
        averaging_ = with_half_width(h).averaging_filter(width);
        averaging = averaging_error(averaging_, width, spectrum);
        if (averaging <= 0.2 * share)
            break;
    }
    for (int h = shortest; h <= widest; ++h) {
        interpolator_ = with_half_width(h);
        interpolating = interpolation_error(interpolator_, width, spectrum);
        if (interpolating + averaging <= share)
            break;
    }
    missed_ = 2 * safety * (interpolating + averaging);
    interpolator_.error_ = error();
}

} // namespace wfpsf
