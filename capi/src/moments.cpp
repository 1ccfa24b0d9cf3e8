// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"
#include "handles.hpp"
#include "moments/adaptive.hpp"
#include "moments/unweighted.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <variant>

using namespace wfpsf;

namespace {

// Centroid and matrix, and what follows from them.
void add_ellipse(wfpsf_moments &moments, double x, double y, double Mxx, double Mxy, double Myy) {
    const double trace = Mxx + Myy;
    const double e1 = (Mxx - Myy) / trace, e2 = 2 * Mxy / trace;
    moments.properties.insert(moments.properties.end(),
                              {{WFPSF_MOMENTS_CENTROID_X, x},
                               {WFPSF_MOMENTS_CENTROID_Y, y},
                               {WFPSF_MOMENTS_MXX, Mxx},
                               {WFPSF_MOMENTS_MXY, Mxy},
                               {WFPSF_MOMENTS_MYY, Myy},
                               {WFPSF_MOMENTS_SIGMA, std::pow(Mxx * Myy - Mxy * Mxy, 0.25)},
                               {WFPSF_MOMENTS_SIGMA_TRACE, std::sqrt(trace)},
                               {WFPSF_MOMENTS_E1, e1},
                               {WFPSF_MOMENTS_E2, e2},
                               {WFPSF_MOMENTS_E, std::hypot(e1, e2)},
                               {WFPSF_MOMENTS_BETA, std::atan2(e2, e1) / 2}});
}

// The first guess, if the caller gave a part of one: the rest is the image's centre and the size of
// a native pixel.
std::optional<Gaussian> guess(const Image &image, const wfpsf_options *options) {
    const double x = option(options, WFPSF_OPTION_MOMENTS_GUESS_X);
    const double y = option(options, WFPSF_OPTION_MOMENTS_GUESS_Y);
    const double sigma = option(options, WFPSF_OPTION_MOMENTS_GUESS_SIGMA);
    if (std::isnan(x) && std::isnan(y) && std::isnan(sigma))
        return {};
    const auto centre = [](int64_t n) { return static_cast<double>(n - 1) / 2; };
    const double size = std::isnan(sigma) ? image.oversampling() : sigma;
    return Gaussian{.x = std::isnan(x) ? centre(image.nx()) : x,
                    .y = std::isnan(y) ? centre(image.ny()) : y,
                    .Mxx = size * size,
                    .Mxy = 0,
                    .Myy = size * size};
}

} // namespace

wfpsf_status wfpsf_moments_measure(const wfpsf_image *image, const wfpsf_options *options,
                                   wfpsf_moments **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(image, "image");
        const AdaptiveOptions adaptive{
            .tolerance = option(options, WFPSF_OPTION_MOMENTS_TOLERANCE),
            .max_passes = static_cast<int>(option(options, WFPSF_OPTION_MOMENTS_MAX_PASSES))};
        const AdaptiveMoments m = std::visit(
            [&](auto pixels) {
                return adaptive_moments(pixels, guess(image->image, options), adaptive);
            },
            image->image.pixels());
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        auto result = std::make_unique<wfpsf_moments>();
        result->status = m.status;
        add_ellipse(*result, m.weight.x, m.weight.y, m.weight.Mxx, m.weight.Mxy, m.weight.Myy);
        result->properties.insert(
            result->properties.end(),
            {{WFPSF_MOMENTS_FLUX, m.flux},
             {WFPSF_MOMENTS_RHO4, m.rho4},
             {WFPSF_MOMENTS_PASSES, m.passes},
             {WFPSF_MOMENTS_ERROR_ESTIMATE, m.status < 0 ? nan : m.error_estimate},
             {WFPSF_MOMENTS_RESIDUAL, m.gradient},
             {WFPSF_MOMENTS_CURVATURE, m.curvature},
             {WFPSF_MOMENTS_EDGE_FRACTION, m.edge_fraction}});
        *out = result.release();
        return m.status == WFPSF_OK ? m.status : record_error(m.status, m.line.c_str());
    });
}

wfpsf_status wfpsf_moments_measure_unweighted(const wfpsf_image *image, double x, double y,
                                              wfpsf_moments **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(image, "image");
        if (image->image.nx() == 0 || image->image.ny() == 0)
            fail(WFPSF_ERROR_MOMENTS_NO_PIXELS, "image: is empty");
        const bool about_centroid = std::isnan(x) && std::isnan(y);
        if (!about_centroid && !(std::isfinite(x) && std::isfinite(y)))
            fail(WFPSF_ERROR_NOT_FINITE, "(x, y) = (%g, %g): must be finite, or both NaN", x, y);
        const UnweightedMoments m = std::visit(
            [&](auto pixels) {
                return about_centroid ? unweighted_moments(pixels)
                                      : unweighted_moments(pixels, x, y);
            },
            image->image.pixels());
        auto result = std::make_unique<wfpsf_moments>();
        result->status = WFPSF_OK;
        add_ellipse(*result, m.x, m.y, m.Mxx, m.Mxy, m.Myy);
        result->properties.emplace_back(WFPSF_MOMENTS_FLUX, m.flux);
        *out = result.release();
    });
}

void wfpsf_moments_destroy(wfpsf_moments *moments) {
    delete moments;
}

wfpsf_status wfpsf_moments_status(const wfpsf_moments *moments) {
    return moments ? moments->status : WFPSF_ERROR_NULL;
}

wfpsf_status wfpsf_moments_get(const wfpsf_moments *moments, int32_t key, double *value) {
    return guarded([&] {
        require_pointer(moments, "moments");
        require_pointer(value, "value");
        bool known = false;
#define WFPSF_IS_KEY(name, property, text) known = known || key == (property);
        WFPSF_MOMENTS_PROPERTY_LIST(WFPSF_IS_KEY)
#undef WFPSF_IS_KEY
        if (!known)
            fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: moments have no property of that key", key);
        *value = std::numeric_limits<double>::quiet_NaN();
        for (const auto &[property, number] : moments->properties)
            if (property == key)
                *value = number;
    });
}
