// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/effects.hpp"

#include "numerics/dispatch.hpp"

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

void quantize(double unit, std::span<double> row) {
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
    for (double &pixel : row)
        if (pixel != 0)
            pixel = pixel < 0 ? nan : pixel * std::pow(pixel / base, exponent);
}

void nonlinearity(std::span<const double> coefficients, std::span<double> row) {
    for (double &pixel : row)
        pixel = polynomial(coefficients, pixel).value;
}

void nonlinearity_inverse(std::span<const double> coefficients, std::span<double> row) {
    for (double &pixel : row)
        pixel = invert(coefficients, pixel);
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

double FermiPersistence::rate(double level, double time) const {
    if (!(level > 0))
        return std::isnan(level) ? level : 0;
    const double filled = std::fmax(level, half_well);
    const double current = A * std::pow(filled / x0, a) * std::pow(time / 1000, -r) /
                           (std::exp(-(filled - x0) / dx) + 1);
    return level > half_well ? current : current * level / half_well;
}

} // namespace wfpsf
