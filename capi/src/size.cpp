// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"
#include "handles.hpp"
#include "moments/encircled.hpp"
#include "moments/radial.hpp"
#include "moments/unweighted.hpp"

#include <cmath>
#include <limits>
#include <variant>

using namespace wfpsf;

namespace {

template <class T> double total_flux(View<const T> pixels, const wfpsf_options *options) {
    const double stated = option(options, WFPSF_OPTION_SIZE_TOTAL_FLUX);
    const double total = std::isnan(stated) ? unweighted_moments(pixels).flux : stated;
    if (!(total > 0))
        fail(WFPSF_ERROR_MOMENTS_FLUX, "sum of the pixels = %g: must be positive", total);
    return total;
}

EncircledOptions encircled_options(const wfpsf_options *options) {
    return {.bandwidth = option(options, WFPSF_OPTION_SIZE_BANDWIDTH)};
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
                const EncircledEnergy e =
                    encircled_energy(pixels, x, y, radius, encircled_options(options));
                *fraction = e.energy / total;
                if (error)
                    *error = e.error_estimate / total;
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
        require_finite(fraction, "fraction");
        if (!(fraction > 0 && fraction < 1))
            fail(WFPSF_ERROR_RANGE, "fraction = %g: must lie between 0 and 1", fraction);
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
                    const EncircledRadius r =
                        encircled_radius(pixels, x, y, fraction, total, encircled_options(options));
                    *radius = r.radius;
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
