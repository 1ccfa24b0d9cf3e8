// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"
#include "handles.hpp"
#include "moments/encircled.hpp"
#include "moments/radial.hpp"
#include "moments/unweighted.hpp"

#include <cmath>
#include <limits>
#include <variant>
#include <vector>

using namespace wfpsf;

namespace {

template <class T> double total_flux(View<const T> pixels, const wfpsf_options *options) {
    const double stated = option(options, WFPSF_OPTION_SIZE_TOTAL_FLUX);
    const double total = std::isnan(stated) ? pixel_sum(pixels) : stated;
    if (!std::isfinite(total))
        fail(WFPSF_ERROR_NOT_FINITE, "sum of the pixels = %g: every pixel must be finite", total);
    if (!(total > 0))
        fail(WFPSF_ERROR_MOMENTS_FLUX, "sum of the pixels = %g: must be positive", total);
    return total;
}

EncircledOptions encircled_options(const wfpsf_options *options) {
    return {.bandwidth = option(options, WFPSF_OPTION_SIZE_BANDWIDTH),
            .eps = option(options, WFPSF_OPTION_SIZE_EPS)};
}

void give(const Estimated &result, double *value, double *error) {
    *value = result.value;
    if (error)
        *error = result.error_estimate;
}

void require_size_of(const wfpsf_image *image, const wfpsf_image *change, const char *name) {
    if (change->image.nx() != image->image.nx() || change->image.ny() != image->image.ny())
        fail(WFPSF_ERROR_SIZE, "%s: has %lld x %lld pixels, the image %lld x %lld", name,
             static_cast<long long>(change->image.nx()), static_cast<long long>(change->image.ny()),
             static_cast<long long>(image->image.nx()), static_cast<long long>(image->image.ny()));
}

void require_fraction(double fraction) {
    require_finite(fraction, "fraction");
    if (!(fraction > 0 && fraction < 1))
        fail(WFPSF_ERROR_RANGE, "fraction = %g: must lie between 0 and 1", fraction);
}

} // namespace

wfpsf_status wfpsf_size_encircled_energy(const wfpsf_image *image, double x, double y,
                                         double radius, const wfpsf_options *options,
                                         double *fraction, double *error) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(fraction, "fraction");
        require_finite(x, "x");
        require_finite(y, "y");
        require_finite(radius, "radius");
        std::visit(
            [&](auto pixels) {
                const double total = total_flux(pixels, options);
                const DiscLight light =
                    disc_light(pixels, x, y, radius, encircled_options(options));
                *fraction = light.energy / total;
                if (error)
                    *error = light.energy_error / total;
            },
            std::as_const(image->image).pixels());
    });
}

wfpsf_status wfpsf_size_ee_radius(const wfpsf_image *image, double x, double y, double fraction,
                                  int32_t method, const wfpsf_options *options, double *radius,
                                  double *error) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(radius, "radius");
        require_finite(x, "x");
        require_finite(y, "y");
        require_fraction(fraction);
        if (method < WFPSF_SIZE_BANDLIMITED || method > WFPSF_SIZE_PIXEL_INTERPOLATED)
            fail(WFPSF_ERROR_ARGUMENT, "method = %d: must be one of WFPSF_SIZE_*, %d..%d", method,
                 WFPSF_SIZE_BANDLIMITED, WFPSF_SIZE_PIXEL_INTERPOLATED);
        std::visit(
            [&](auto pixels) {
                const double total = total_flux(pixels, options);
                double estimate = std::numeric_limits<double>::quiet_NaN();
                if (method == WFPSF_SIZE_PIXEL_SUM) {
                    *radius = enclosing_radius(pixels, x, y, fraction, total);
                } else if (method == WFPSF_SIZE_PIXEL_INTERPOLATED) {
                    *radius = half_light_radius(pixels, x, y, fraction, total);
                } else {
                    const Estimated r =
                        encircled_radius(pixels, x, y, fraction, total, encircled_options(options));
                    *radius = r.value;
                    estimate = r.error_estimate;
                }
                if (error)
                    *error = estimate;
            },
            std::as_const(image->image).pixels());
    });
}

wfpsf_status wfpsf_size_fwhm(const wfpsf_image *image, double x, double y, double *fwhm) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(fwhm, "fwhm");
        require_finite(x, "x");
        require_finite(y, "y");
        *fwhm = std::visit([&](auto pixels) { return full_width_half_maximum(pixels, x, y); },
                           std::as_const(image->image).pixels());
    });
}

wfpsf_status wfpsf_size_ee_radius_derivative(const wfpsf_image *image, const wfpsf_image *change,
                                             const wfpsf_image *second, double x, double y,
                                             double fraction, const wfpsf_options *options,
                                             double *derivative, double *error) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(change, "change");
        require_pointer(derivative, "derivative");
        require_finite(x, "x");
        require_finite(y, "y");
        require_fraction(fraction);
        require_size_of(image, change, "change");
        if (second)
            require_size_of(image, second, "second");
        const EncircledOptions encircled = encircled_options(options);
        const bool stated = !std::isnan(option(options, WFPSF_OPTION_SIZE_TOTAL_FLUX));
        Estimated radius;
        const auto light = std::visit(
            [&](auto pixels) {
                radius = encircled_radius(pixels, x, y, fraction, total_flux(pixels, options),
                                          encircled);
                return disc_light(pixels, x, y, radius.value, encircled);
            },
            std::as_const(image->image).pixels());
        const auto held = [&](const wfpsf_image *by, const char *name) {
            return std::visit(
                [&](auto pixels) {
                    const HeldChange result{disc_light(pixels, x, y, radius.value, encircled),
                                            stated ? 0 : fraction * pixel_sum(pixels)};
                    require_finite(result.held, name);
                    return result;
                },
                std::as_const(by->image).pixels());
        };
        const HeldChange a = held(change, "sum of the change");
        give(second ? radius_curvature(radius, light, a, held(second, "sum of the second change"),
                                       encircled)
                    : radius_slope(radius, light, a),
             derivative, error);
    });
}

wfpsf_status wfpsf_size_profile(const wfpsf_image *image, double x, double y, int64_t count,
                                const double *radii, const wfpsf_options *options, double *profile,
                                double *errors) {
    return guarded([&] {
        require_pointer(image, "image");
        require_finite(x, "x");
        require_finite(y, "y");
        if (count < 0)
            fail(WFPSF_ERROR_SIZE, "count = %lld: must be 0 or more",
                 static_cast<long long>(count));
        if (count == 0)
            return;
        require_pointer(radii, "radii");
        require_pointer(profile, "profile");
        std::vector<Estimated> means(static_cast<size_t>(count));
        std::visit(
            [&](auto pixels) {
                for (size_t i = 0; i < means.size(); ++i) {
                    require_finite(radii[i], "radius");
                    means[i] = ring_mean(pixels, x, y, radii[i], encircled_options(options));
                }
            },
            std::as_const(image->image).pixels());
        for (size_t i = 0; i < means.size(); ++i)
            give(means[i], profile + i, errors ? errors + i : nullptr);
    });
}

wfpsf_status wfpsf_size_profile_fwhm(const wfpsf_image *image, double x, double y,
                                     const wfpsf_options *options, double *fwhm, double *error) {
    return guarded([&] {
        require_pointer(image, "image");
        require_pointer(fwhm, "fwhm");
        require_finite(x, "x");
        require_finite(y, "y");
        give(
            std::visit(
                [&](auto pixels) { return profile_fwhm(pixels, x, y, encircled_options(options)); },
                std::as_const(image->image).pixels()),
            fwhm, error);
    });
}
