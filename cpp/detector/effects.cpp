// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/effects.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/elementary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Value {
    double value, slope;
};

Value polynomial(std::span<const double> coefficients, double x) {
    double value = 0, slope = 0; // of the coefficients' sum over x, by Horner's rule
    for (size_t k = coefficients.size(); k-- > 0;) {
        slope = slope * x + value;
        value = value * x + coefficients[k];
    }
    // x + x^2 value
    return {x + x * x * value, 1 + x * (2 * value + x * slope)};
}

// Newton's iteration from 0 on: on a branch that rises it cannot leave it but by overshooting the
// turning point, where the slope shows it and the step is halved.
double invert(std::span<const double> coefficients, double wanted) {
    if (!std::isfinite(wanted))
        return wanted;
    double x = 0;
    Value at = {0, 1};
    for (int pass = 0; pass < 200; ++pass) {
        double step = (wanted - at.value) / at.slope;
        Value next = polynomial(coefficients, x + step);
        for (int halving = 0; halving < 60 && !(next.slope > 0); ++halving) {
            step /= 2;
            next = polynomial(coefficients, x + step);
        }
        if (!(next.slope > 0))
            break;
        x += step;
        at = next;
        if (std::fabs(step) <= 4e-16 * std::fabs(x))
            return std::fabs(at.value - wanted) <= 1e-12 * std::fabs(wanted) ? x : nan;
    }
    return std::fabs(at.value - wanted) <= 1e-12 * std::fabs(wanted) ? x : nan;
}

// Pixels go through vector instructions in groups of one size, the last one filled up, so that the
// bits of a pixel do not depend on its place in a row.
constexpr size_t lanes = 16;
using Group = std::array<double, lanes>;

[[gnu::always_inline]] inline Group load(std::span<const double> row, size_t begin) {
    Group group;
    if (row.size() - begin >= lanes) {
        std::copy_n(row.data() + begin, lanes, group.begin());
    } else {
        group.fill(1);
        std::copy(row.begin() + static_cast<std::ptrdiff_t>(begin), row.end(), group.begin());
    }
    return group;
}

[[gnu::always_inline]] inline void store(const Group &group, size_t begin, std::span<double> row) {
    if (row.size() - begin >= lanes)
        std::copy_n(group.begin(), lanes, row.data() + begin);
    else
        std::copy_n(group.begin(), row.size() - begin, row.data() + begin);
}

constexpr size_t chunk = 16 * lanes; // pixels at a time: what is made of them stays in the cache

// (x / base)^exponent for x > 0 while that is within e and 1 / e, else 0; whether all were.
WFPSF_VECTORISED bool powers_of_ratios(double exponent, double base, const double *x, size_t groups,
                                       double *__restrict power) {
    constexpr double tiny = std::numeric_limits<double>::min(),
                     huge = std::numeric_limits<double>::max();
    uint64_t left = 0;
    for (size_t i = 0; i < groups * lanes; ++i) {
        const double ratio = x[i] / base, log_power = exponent * branchless_log(ratio);
        const bool good = (ratio >= tiny) & (ratio <= huge) & (std::fabs(log_power) <= 1);
        power[i] = good ? branchless_exp(log_power) : 0;
        left |= good ? 0 : 1;
    }
    return left == 0;
}

// What `invert` finds, or NaN where its steps would have to be halved, or are too many.
WFPSF_VECTORISED void invert_group(std::span<const double> coefficients, const Group &wanted,
                                   Group &x) {
    constexpr int most_passes = 20;
    Group value{}, slope, moving;
    x.fill(0);
    slope.fill(1);
    moving.fill(1);
    uint64_t any_moving = 1;
    for (int pass = 0; pass < most_passes && any_moving != 0; ++pass) {
        Group next, sum{}, sum_slope{}; // by Horner's rule, as in polynomial()
        for (size_t i = 0; i < lanes; ++i)
            next[i] = x[i] + moving[i] * ((wanted[i] - value[i]) / slope[i]);
        for (size_t k = coefficients.size(); k-- > 0;)
            for (size_t i = 0; i < lanes; ++i) {
                sum_slope[i] = sum_slope[i] * next[i] + sum[i];
                sum[i] = sum[i] * next[i] + coefficients[k];
            }
        any_moving = 0;
        for (size_t i = 0; i < lanes; ++i) {
            const bool still = std::fabs(next[i] - x[i]) > 4e-16 * std::fabs(next[i]);
            value[i] = next[i] + next[i] * next[i] * sum[i];
            slope[i] = 1 + next[i] * (2 * sum[i] + next[i] * sum_slope[i]);
            x[i] = next[i];
            const bool goes_on = (moving[i] != 0) & still;
            moving[i] = goes_on & (slope[i] > 0) ? 1 : 0;
            any_moving |= moving[i] != 0 ? 1 : 0;
        }
    }
    for (size_t i = 0; i < lanes; ++i) {
        const bool good = (moving[i] == 0) & (slope[i] > 0) &
                          (std::fabs(value[i] - wanted[i]) <= 1e-12 * std::fabs(wanted[i]));
        x[i] = good ? x[i] : nan;
    }
}

// A difference from itself is 0, but of what is not finite NaN.
template <class T> [[gnu::always_inline]] inline int64_t count_any(View<const T> image) {
    int64_t count = 0;
    for (int64_t y = 0; y < image.ny; ++y) {
        const T *row = image.row(y);
        if (image.stride_x == 1)
            for (int64_t x = 0; x < image.nx; ++x)
                count += row[x] - row[x] == 0 ? 0 : 1;
        else
            for (int64_t x = 0; x < image.nx; ++x)
                count += std::isfinite(row[x * image.stride_x]) ? 0 : 1;
    }
    return count;
}

} // namespace

WFPSF_VECTORISED int64_t count_not_finite(View<const float> image) {
    return count_any(image);
}

WFPSF_VECTORISED int64_t count_not_finite(View<const double> image) {
    return count_any(image);
}

WFPSF_VECTORISED void quantize(double unit, std::span<double> row) {
    if (unit == 1) {
        for (double &pixel : row)
            pixel = std::nearbyint(pixel);
    } else {
        for (double &pixel : row)
            pixel = std::nearbyint(pixel / unit) * unit;
    }
}

void reciprocity_failure(double alpha, double exposure_time, double base_flux,
                         std::span<double> row) {
    const double exponent = alpha / std::numbers::ln10, base = exposure_time * base_flux;
    std::array<double, chunk> pixels, power;
    for (; !row.empty(); row = row.subspan(std::min(chunk, row.size()))) {
        const size_t n = std::min(chunk, row.size()), groups = (n + lanes - 1) / lanes;
        std::copy_n(row.data(), n, pixels.data());
        std::fill(pixels.data() + n, pixels.data() + groups * lanes, base);
        if (!powers_of_ratios(exponent, base, pixels.data(), groups, power.data()))
            for (size_t i = 0; i < n; ++i)
                if (power[i] == 0)
                    power[i] = pixels[i] == 0  ? 1
                               : pixels[i] < 0 ? nan
                                               : std::pow(pixels[i] / base, exponent);
        for (size_t i = 0; i < n; ++i)
            row[i] *= power[i];
    }
}

WFPSF_VECTORISED void nonlinearity(std::span<const double> coefficients, std::span<double> row) {
    for (size_t begin = 0; begin < row.size(); begin += lanes) {
        const Group x = load(row, begin);
        Group sum{}; // of the coefficients' powers over x, by Horner's rule
        for (size_t k = coefficients.size(); k-- > 0;)
            for (size_t i = 0; i < lanes; ++i)
                sum[i] = sum[i] * x[i] + coefficients[k];
        for (size_t i = 0; i < lanes; ++i)
            sum[i] = x[i] + x[i] * x[i] * sum[i];
        store(sum, begin, row);
    }
}

void nonlinearity_inverse(std::span<const double> coefficients, std::span<double> row) {
    for (size_t begin = 0; begin < row.size(); begin += lanes) {
        const Group wanted = load(row, begin);
        Group found;
        invert_group(coefficients, wanted, found);
        for (size_t i = 0; i < lanes; ++i)
            if (std::isnan(found[i]))
                found[i] = invert(coefficients, wanted[i]);
        store(found, begin, row);
    }
}

int64_t saturate(double level, std::span<double> row) {
    int64_t count = 0;
    for (double &pixel : row)
        if (pixel >= level) {
            pixel = level;
            ++count;
        }
    return count;
}

FermiPersistence::FermiPersistence(const Figures &figures, double time)
    : figures_(figures), scale_(figures.A * std::pow(time / 1000, -figures.r)),
      at_half_well_(above(figures.half_well)) {}

double FermiPersistence::above(double level) const {
    return scale_ * std::pow(level / figures_.x0, figures_.a) /
           (std::exp(-(level - figures_.x0) / figures_.dx) + 1);
}

double FermiPersistence::rate(double level) const {
    if (!(level > 0))
        return std::isnan(level) ? level : 0;
    return level > figures_.half_well ? above(level) : at_half_well_ * level / figures_.half_well;
}

} // namespace wfpsf
