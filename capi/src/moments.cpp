// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"
#include "handles.hpp"
#include "moments/adaptive.hpp"
#include "moments/covariance.hpp"
#include "moments/moment_set.hpp"
#include "moments/pixel_moments.hpp"
#include "moments/sensitivity.hpp"
#include "moments/unweighted.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

using namespace wfpsf;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// What derivatives and covariances are of, in the order of Quantities.
constexpr int32_t quantity_keys[quantities] = {
    WFPSF_MOMENTS_CENTROID_X,  WFPSF_MOMENTS_CENTROID_Y, WFPSF_MOMENTS_MXX,
    WFPSF_MOMENTS_MXY,         WFPSF_MOMENTS_MYY,        WFPSF_MOMENTS_SIGMA,
    WFPSF_MOMENTS_SIGMA_TRACE, WFPSF_MOMENTS_E1,         WFPSF_MOMENTS_E2,
    WFPSF_MOMENTS_E,           WFPSF_MOMENTS_BETA,       WFPSF_MOMENTS_FLUX,
    WFPSF_MOMENTS_BACKGROUND};

size_t quantity_of(int32_t key) {
    for (size_t q = 0; q < quantities; ++q)
        if (quantity_keys[q] == key)
            return q;
    fail(WFPSF_ERROR_UNKNOWN_NAME,
         "key = %d: must be one of CENTROID_X to FLUX, %d..%d, or BACKGROUND, %d", key,
         WFPSF_MOMENTS_CENTROID_X, WFPSF_MOMENTS_FLUX, WFPSF_MOMENTS_BACKGROUND);
}

void add_ellipse(wfpsf_moments &moments, const MomentSet<double> &m) {
    const Quantities<double> values = quantities_of(m);
    for (size_t q = 0; q < quantities; ++q)
        moments.properties.emplace_back(quantity_keys[q], values[q]);
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

AdaptiveOptions adaptive_options(const wfpsf_options *options) {
    return {.tolerance = option(options, WFPSF_OPTION_MOMENTS_TOLERANCE),
            .max_passes = static_cast<int>(option(options, WFPSF_OPTION_MOMENTS_MAX_PASSES)),
            .method = static_cast<MomentsMethod>(
                static_cast<int>(option(options, WFPSF_OPTION_MOMENTS_METHOD))),
            .background = option(options, WFPSF_OPTION_MOMENTS_BACKGROUND),
            .restart = flag(options, WFPSF_OPTION_MOMENTS_RESTART)};
}

void require_size(const wfpsf_image *image, int64_t nx, int64_t ny, const char *argument) {
    if (image->image.nx() != nx || image->image.ny() != ny)
        fail(WFPSF_ERROR_SIZE, "%s: has %lld x %lld pixels, must have %lld x %lld", argument,
             static_cast<long long>(image->image.nx()), static_cast<long long>(image->image.ny()),
             static_cast<long long>(nx), static_cast<long long>(ny));
}

// One where a pixel is missing; none if no pixel is.
std::shared_ptr<const Plane<float>> missing_pixels(const wfpsf_image &mask) {
    auto missing = std::make_shared<Plane<float>>(mask.image.nx(), mask.image.ny());
    bool any = false;
    std::visit(
        [&](auto pixels) {
            for (int64_t y = 0; y < pixels.ny; ++y)
                for (int64_t x = 0; x < pixels.nx; ++x) {
                    (*missing)(x, y) = pixels(x, y) != 0 ? 1 : 0;
                    any = any || pixels(x, y) != 0;
                }
        },
        mask.image.pixels());
    return any ? missing : nullptr;
}

View<const float> view_of(const std::shared_ptr<const Plane<float>> &missing) {
    return missing ? missing->view() : View<const float>{};
}

Sensitivity sensitivity_of(const wfpsf_moments::Fit &fit, const Image &image, bool second) {
    return std::visit(
        [&](auto pixels) {
            return Sensitivity(pixels, fit.solution, fit.options, view_of(fit.missing), second);
        },
        image.pixels());
}

// Needs a solution, and a variance from one of its two sources.
void add_covariance(wfpsf_moments &moments, const wfpsf_image *image, const wfpsf_image *variance,
                    const wfpsf_options *options) {
    const auto &fit = std::get<wfpsf_moments::Fit>(moments.origin);
    const double constant = option(options, WFPSF_OPTION_MOMENTS_VARIANCE);
    if (moments.status < 0 || moments.status == WFPSF_WARNING_NOT_CONVERGED ||
        (!variance && std::isnan(constant)))
        return;
    const auto order = static_cast<int>(option(options, WFPSF_OPTION_MOMENTS_COVARIANCE_ORDER));
    const auto of = [&](auto variances) {
        return std::visit(
            [&](auto pixels) {
                return covariance(pixels, fit.solution, fit.options, view_of(fit.missing),
                                  variances, order);
            },
            image->image.pixels());
    };
    moments.covariance = variance ? std::visit(of, variance->image.pixels())
                                  : of(View<const double>{&constant, moments.nx, moments.ny, 0, 0});
}

wfpsf_status measure(const wfpsf_image *image, const wfpsf_image *mask, const wfpsf_image *variance,
                     const wfpsf_options *options, wfpsf_moments **out) {
    require_pointer(out, "out");
    *out = nullptr;
    require_pointer(image, "image");
    const int64_t nx = image->image.nx(), ny = image->image.ny();
    if (mask)
        require_size(mask, nx, ny, "missing");
    if (variance)
        require_size(variance, nx, ny, "variance");

    wfpsf_moments::Fit fit;
    fit.options = adaptive_options(options);
    if (mask)
        fit.missing = missing_pixels(*mask);
    fit.solution = std::visit(
        [&](auto pixels) {
            return adaptive_moments(pixels, guess(image->image, options), fit.options,
                                    view_of(fit.missing));
        },
        image->image.pixels());
    const AdaptiveMoments &m = fit.solution;
    auto result = std::make_unique<wfpsf_moments>();
    result->status = m.status;
    result->nx = nx;
    result->ny = ny;
    MomentSet<double> ellipse{m.weight.x,   m.weight.y, m.weight.Mxx, m.weight.Mxy,
                              m.weight.Myy, m.flux,     m.background};
    if (fit.options.method == MomentsMethod::round)
        set_matrix(ellipse, std::sqrt(m.weight.det()), m.e1, m.e2);
    add_ellipse(*result, ellipse);
    result->properties.insert(
        result->properties.end(),
        {{WFPSF_MOMENTS_RHO4, m.rho4},
         {WFPSF_MOMENTS_PASSES, m.passes},
         {WFPSF_MOMENTS_ERROR_ESTIMATE, m.status < 0 ? nan : m.error_estimate},
         {WFPSF_MOMENTS_RESIDUAL, m.gradient},
         {WFPSF_MOMENTS_CURVATURE, m.curvature},
         {WFPSF_MOMENTS_EDGE_FRACTION, m.edge_fraction},
         {WFPSF_MOMENTS_MISSING_FRACTION, m.missing_fraction},
         {WFPSF_MOMENTS_AMPLITUDE, m.amplitude()},
         {WFPSF_MOMENTS_LAST_STEP, m.last_step},
         {WFPSF_MOMENTS_PIXELS, static_cast<double>(m.pixels)}});
    const std::string line = m.line;
    result->origin = std::move(fit);
    *out = result.release();
    add_covariance(**out, image, variance, options);
    const wfpsf_status status = (*out)->status;
    return status == WFPSF_OK ? status : record_error(status, line.c_str());
}

// Of six sums about the point, each with its derivatives.
MomentSet<HyperDual> moments_of(const wfpsf_moments::Sums &origin,
                                const std::array<HyperDual, 6> &sums) {
    return moments_of_sums(sums, origin.x, origin.y, origin.centre);
}

PixelSums sums_of(const Image &image, const wfpsf_moments::Sums &origin) {
    return std::visit(
        [&](auto pixels) {
            return origin.weight ? pixel_sums(pixels, *origin.weight)
                                 : pixel_sums(pixels, origin.x, origin.y);
        },
        image.pixels());
}

Gaussian checked_weight(double x, double y, double Mxx, double Mxy, double Myy) {
    if (!std::isfinite(x + y + Mxx + Mxy + Myy))
        fail(WFPSF_ERROR_NOT_FINITE, "weight = (%g, %g; %g, %g, %g): must be finite", x, y, Mxx,
             Mxy, Myy);
    const Gaussian weight{x, y, Mxx, Mxy, Myy};
    if (!(Mxx > 0 && Myy > 0 && weight.det() > 0))
        fail(WFPSF_ERROR_RANGE, "M of the weight = (%g, %g, %g): must be positive definite", Mxx,
             Mxy, Myy);
    return weight;
}

// The origin of a result that can be differentiated, on the image it was measured on.
void require_solution(const wfpsf_moments *moments, const wfpsf_image *image) {
    require_pointer(moments, "moments");
    require_pointer(image, "image");
    if (std::holds_alternative<std::monostate>(moments->origin))
        fail(WFPSF_ERROR_ARGUMENT, "moments: are derivatives themselves");
    if (moments->status < 0 || moments->status == WFPSF_WARNING_NOT_CONVERGED)
        fail(WFPSF_ERROR_ARGUMENT, "moments: ended with status %d, which is no solution",
             moments->status);
    require_size(image, moments->nx, moments->ny, "image");
}

MomentSet<HyperDual> derivatives(const wfpsf_moments &moments, const Image &image, const Image &a,
                                 const Image *b) {
    if (const auto *fit = std::get_if<wfpsf_moments::Fit>(&moments.origin)) {
        const Sensitivity sensitivity = sensitivity_of(*fit, image, b != nullptr);
        const auto change_of = [&](const Image &change) {
            return std::visit([&](auto pixels) { return sensitivity.change_of(pixels); },
                              change.pixels());
        };
        const ImageChange along_a = change_of(a);
        return sensitivity.along(along_a, b ? change_of(*b) : along_a);
    }
    const auto &origin = std::get<wfpsf_moments::Sums>(moments.origin);
    const PixelSums value = sums_of(image, origin), along_a = sums_of(a, origin);
    const PixelSums along_b = b ? sums_of(*b, origin) : along_a;
    std::array<HyperDual, 6> sums;
    for (size_t i = 0; i < 6; ++i)
        sums[i] = HyperDual(value[i], along_a[i], along_b[i], 0);
    return moments_of(origin, sums);
}

} // namespace

wfpsf_status wfpsf_moments_measure(const wfpsf_image *image, const wfpsf_options *options,
                                   wfpsf_moments **out) {
    return guarded([&] { return measure(image, nullptr, nullptr, options, out); });
}

wfpsf_status wfpsf_moments_measure_masked(const wfpsf_image *image, const wfpsf_image *missing,
                                          const wfpsf_image *variance, const wfpsf_options *options,
                                          wfpsf_moments **out) {
    return guarded([&] { return measure(image, missing, variance, options, out); });
}

wfpsf_status wfpsf_moments_measure_weighted(const wfpsf_image *image, double x, double y,
                                            double Mxx, double Mxy, double Myy,
                                            wfpsf_moments **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(image, "image");
        const wfpsf_moments::Sums origin{x, y, checked_weight(x, y, Mxx, Mxy, Myy),
                                         Centre::weighted};
        if (image->image.nx() == 0 || image->image.ny() == 0)
            fail(WFPSF_ERROR_MOMENTS_NO_PIXELS, "image: is empty");
        const PixelSums values = sums_of(image->image, origin);
        if (!std::isfinite(values[14] + values[10] + values[0]))
            fail(WFPSF_ERROR_NOT_FINITE, "sum of I w = %g: pixels under the weight must be finite",
                 values[0]);
        if (values[0] == 0)
            fail(WFPSF_ERROR_MOMENTS_FLUX, "sum of I w = 0: must not be zero");
        std::array<HyperDual, 6> sums;
        std::copy_n(values.begin(), 6, sums.begin());
        const MomentSet<HyperDual> m = moments_of(origin, sums);
        auto result = std::make_unique<wfpsf_moments>();
        result->status = WFPSF_OK;
        add_ellipse(*result,
                    {m.x.value, m.y.value, m.Mxx.value, m.Mxy.value, m.Myy.value, m.flux.value});
        result->origin = origin;
        result->nx = image->image.nx();
        result->ny = image->image.ny();
        *out = result.release();
    });
}

wfpsf_status wfpsf_moments_sums(const wfpsf_image *image, double x, double y, const double *weight,
                                int64_t count, double *sums) {
    return guarded([&] {
        require_pointer(image, "image");
        if (count < 0 || count > 15)
            fail(WFPSF_ERROR_RANGE, "count = %lld: must be 0..15", static_cast<long long>(count));
        if (count == 0)
            return;
        require_pointer(sums, "sums");
        require_finite(x, "x");
        require_finite(y, "y");
        wfpsf_moments::Sums origin{x, y, {}, Centre::point};
        if (weight)
            origin.weight = checked_weight(x, y, weight[0], weight[1], weight[2]);
        const PixelSums values = sums_of(image->image, origin);
        for (const double value : values)
            if (!std::isfinite(value))
                fail(WFPSF_ERROR_NOT_FINITE, "a sum = %g: every pixel that counts must be finite",
                     value);
        std::copy_n(values.begin(), count, sums);
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
        add_ellipse(*result, {m.x, m.y, m.Mxx, m.Mxy, m.Myy, m.flux});
        result->origin =
            wfpsf_moments::Sums{m.x, m.y, {}, about_centroid ? Centre::mean : Centre::point};
        result->nx = image->image.nx();
        result->ny = image->image.ny();
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

wfpsf_status wfpsf_moments_covariance(const wfpsf_moments *moments, int32_t key_a, int32_t key_b,
                                      double *value) {
    return guarded([&] {
        require_pointer(moments, "moments");
        require_pointer(value, "value");
        if (!moments->covariance)
            fail(WFPSF_ERROR_ARGUMENT,
                 "moments: have no covariance, for want of a variance or of a solution");
        *value = (*moments->covariance)[quantity_of(key_a)][quantity_of(key_b)];
    });
}

wfpsf_status wfpsf_moments_differentiate(const wfpsf_moments *moments, const wfpsf_image *image,
                                         const wfpsf_image *change, const wfpsf_image *second,
                                         wfpsf_moments **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_solution(moments, image);
        require_pointer(change, "change");
        require_size(change, moments->nx, moments->ny, "change");
        if (second)
            require_size(second, moments->nx, moments->ny, "second");
        const MomentSet<HyperDual> m =
            derivatives(*moments, image->image, change->image, second ? &second->image : nullptr);
        auto result = std::make_unique<wfpsf_moments>();
        result->status = WFPSF_OK;
        const Quantities<HyperDual> numbers = quantities_of(m);
        for (size_t q = 0; q < quantities; ++q)
            result->properties.emplace_back(quantity_keys[q],
                                            second ? numbers[q].dab : numbers[q].da);
        if (!std::isfinite(second ? m.Mxx.dab + m.flux.dab : m.Mxx.da + m.flux.da))
            fail(WFPSF_ERROR_NOT_FINITE,
                 "change: its pixels must be finite within reach of the weight");
        *out = result.release();
    });
}

wfpsf_status wfpsf_moments_influence(const wfpsf_moments *moments, const wfpsf_image *image,
                                     int32_t key, wfpsf_image *influence) {
    return guarded([&] {
        require_solution(moments, image);
        require_pointer(influence, "influence");
        require_size(influence, moments->nx, moments->ny, "influence");
        if (influence->image.type() != PixelType::float64)
            fail(WFPSF_ERROR_TYPE, "influence: must be float64");
        const size_t q = quantity_of(key);
        const View<double> out = std::get<View<double>>(influence->image.pixels());
        if (const auto *fit = std::get_if<wfpsf_moments::Fit>(&moments->origin)) {
            const Sensitivity sensitivity = sensitivity_of(*fit, image->image, false);
            for (int64_t y = 0; y < out.ny; ++y)
                for (int64_t x = 0; x < out.nx; ++x)
                    out(x, y) = 0;
            sensitivity.add_influence(sensitivity.slopes()[q], out);
            return;
        }
        const auto &origin = std::get<wfpsf_moments::Sums>(moments->origin);
        const PixelSums values = sums_of(image->image, origin);
        std::array<double, 6> slope{};
        for (size_t k = 0; k < 6; ++k) {
            std::array<HyperDual, 6> sums;
            for (size_t i = 0; i < 6; ++i)
                sums[i] = HyperDual(values[i], i == k ? 1 : 0, 0, 0);
            slope[k] = quantities_of(moments_of(origin, sums))[q].da;
        }
        influence_image(origin.weight, origin.x, origin.y, slope, out);
    });
}
