// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/radial.hpp"

#include "error/error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace wfpsf {

namespace {

struct RadialPixel {
    double r2, value;
};

template <class T> std::vector<RadialPixel> sorted_pixels(View<const T> image, double x, double y) {
    if (!std::isfinite(x + y))
        fail(WFPSF_ERROR_NOT_FINITE, "centre = (%g, %g): must be finite", x, y);
    std::vector<RadialPixel> pixels;
    pixels.reserve(static_cast<size_t>(image.nx) * static_cast<size_t>(image.ny));
    for (int64_t j = 0; j < image.ny; ++j)
        for (int64_t i = 0; i < image.nx; ++i) {
            const double dx = static_cast<double>(i) - x, dy = static_cast<double>(j) - y;
            const double value = static_cast<double>(image(i, j));
            if (!std::isfinite(value))
                fail(WFPSF_ERROR_NOT_FINITE, "pixel (%lld, %lld) = %g: must be finite",
                     static_cast<long long>(i), static_cast<long long>(j), value);
            pixels.push_back({dx * dx + dy * dy, value});
        }
    std::stable_sort(pixels.begin(), pixels.end(),
                     [](const RadialPixel &a, const RadialPixel &b) { return a.r2 < b.r2; });
    return pixels;
}

double target_flux(const std::vector<RadialPixel> &pixels, double fraction,
                   std::optional<double> total) {
    if (!(fraction > 0 && fraction <= 1))
        fail(WFPSF_ERROR_RANGE, "fraction = %g: must be above 0 and at most 1", fraction);
    double flux = 0;
    for (const RadialPixel &pixel : pixels)
        flux += pixel.value;
    const double whole = total.value_or(flux);
    if (!(whole > 0 && std::isfinite(whole)))
        fail(WFPSF_ERROR_RANGE, "total = %g: must be positive and finite", whole);
    return fraction * whole;
}

[[noreturn]] void not_reached(double target) {
    fail(WFPSF_ERROR_SIZE_NOT_REACHED, "no circle of the image holds a flux of %g", target);
}

} // namespace

template <class T>
double enclosing_radius(View<const T> image, double x, double y, double fraction,
                        std::optional<double> total) {
    const std::vector<RadialPixel> pixels = sorted_pixels(image, x, y);
    const double target = target_flux(pixels, fraction, total);
    double flux = 0;
    for (const RadialPixel &pixel : pixels) {
        flux += pixel.value;
        if (flux >= target)
            return std::sqrt(pixel.r2);
    }
    not_reached(target);
}

template <class T>
double half_light_radius(View<const T> image, double x, double y, double fraction,
                         std::optional<double> total) {
    const std::vector<RadialPixel> pixels = sorted_pixels(image, x, y);
    const double target = target_flux(pixels, fraction, total);
    double flux = 0, last_r2 = 0;
    for (const RadialPixel &pixel : pixels) {
        const double before = flux;
        flux += pixel.value;
        if (flux > target) {
            const double share = (target - before) / (flux - before);
            if (&pixel == pixels.data())
                return std::sqrt(pixel.r2 * share);
            return std::sqrt(last_r2 + (pixel.r2 - last_r2) * share);
        }
        last_r2 = pixel.r2;
    }
    not_reached(target);
}

template <class T> double full_width_half_maximum(View<const T> image, double x, double y) {
    const std::vector<RadialPixel> pixels = sorted_pixels(image, x, y);
    double largest = 0;
    for (const RadialPixel &pixel : pixels)
        largest = std::max(largest, pixel.value);
    if (!(largest > 0))
        fail(WFPSF_ERROR_MOMENTS_FLUX, "largest pixel = %g: must be positive", largest);
    const double half = largest / 2;
    const auto below = std::find_if(pixels.begin(), pixels.end(),
                                    [&](const RadialPixel &p) { return p.value < half; });
    if (below == pixels.end())
        fail(WFPSF_ERROR_SIZE_NOT_REACHED, "no pixel lies below half of the largest, %g", largest);

    // The mean of the pixels at its distance from it on, and of those at the distance of the one
    // before up to it.
    const auto mean = [](auto first, auto last) {
        double sum = 0;
        for (auto p = first; p != last; ++p)
            sum += p->value;
        return sum / static_cast<double>(last - first);
    };
    const auto at_most = [](double r2, const RadialPixel &p) { return r2 < p.r2; };
    const auto less = [](const RadialPixel &p, double r2) { return p.r2 < r2; };
    const double outer = mean(below, std::upper_bound(below, pixels.end(), below->r2, at_most));
    if (below == pixels.begin()) {
        if (!(outer > 0))
            fail(WFPSF_ERROR_SIZE_NOT_REACHED,
                 "centre = (%g, %g): the pixels there hold %g, must be positive", x, y, outer);
        return 2 * std::sqrt(below->r2 * half / outer);
    }
    const double inner_r2 = (below - 1)->r2;
    const double inner = mean(std::lower_bound(pixels.begin(), below, inner_r2, less), below);
    const double r2 = inner_r2 + (below->r2 - inner_r2) * (inner - half) / (inner - outer);
    if (!(r2 >= 0))
        fail(WFPSF_ERROR_SIZE_NOT_REACHED,
             "centre = (%g, %g): the profile around it does not fall through half of %g", x, y,
             largest);
    return 2 * std::sqrt(r2);
}

template double enclosing_radius(View<const float>, double, double, double, std::optional<double>);
template double enclosing_radius(View<const double>, double, double, double, std::optional<double>);
template double half_light_radius(View<const float>, double, double, double, std::optional<double>);
template double half_light_radius(View<const double>, double, double, double,
                                  std::optional<double>);
template double full_width_half_maximum(View<const float>, double, double);
template double full_width_half_maximum(View<const double>, double, double);

} // namespace wfpsf
