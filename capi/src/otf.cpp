// SPDX-License-Identifier: GPL-3.0-or-later
#include "psf_parts.hpp"

#include <complex>
#include <numbers>
#include <variant>

using namespace wfpsf;

namespace {

constexpr double per_radian = 180 * 3600 / std::numbers::pi; // of a cycle per arcsec

void require_response(int32_t response) {
    if (response != WFPSF_RESPONSE_DIFFRACTION && response != WFPSF_RESPONSE_EFFECTIVE)
        fail(WFPSF_ERROR_ARGUMENT, "response = %d: must be one of WFPSF_RESPONSE_*, %d..%d",
             response, WFPSF_RESPONSE_DIFFRACTION, WFPSF_RESPONSE_EFFECTIVE);
}

// k in cycles per arcsec.
std::complex<double> value_at(const Otf &otf, int32_t response, double kx, double ky) {
    return response == WFPSF_RESPONSE_DIFFRACTION
               ? otf.diffraction(kx * per_radian, ky * per_radian)
               : otf.effective(kx * per_radian, ky * per_radian);
}

// Frequency of a grid's pixel, in steps.
double frequency(int64_t pixel, int64_t size, int32_t order) {
    const int64_t half = size / 2;
    if (order == WFPSF_ORDER_CENTRED)
        return static_cast<double>(pixel - half);
    const bool negative = order == WFPSF_ORDER_WRAPPED && pixel >= size - half;
    return static_cast<double>(negative ? pixel - size : pixel);
}

} // namespace

wfpsf_status wfpsf_otf_create(const wfpsf_psf *psf, const wfpsf_options *options, wfpsf_otf **out) {
    return guarded([&]() -> wfpsf_status {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(psf, "psf");
        const double eps = option(options, WFPSF_OPTION_EPS);
        *out = new wfpsf_otf{psf->psf.otf(eps)};
        return certify((*out)->otf.error_estimate(), eps);
    });
}

void wfpsf_otf_destroy(wfpsf_otf *otf) {
    delete otf;
}

wfpsf_status wfpsf_otf_values(const wfpsf_otf *otf, int32_t response, int64_t count,
                              const double *kx, const double *ky, double *re, double *im) {
    return guarded([&] {
        require_pointer(otf, "otf");
        require_response(response);
        array_of(count, kx, "count", "kx");
        array_of(count, ky, "count", "ky");
        array_of(count, re, "count", "re");
        array_of(count, im, "count", "im");
        for (int64_t i = 0; i < count; ++i)
            for (const auto &[name, value] : {std::pair("kx", kx[i]), std::pair("ky", ky[i])})
                if (!std::isfinite(value))
                    fail(WFPSF_ERROR_NOT_FINITE, "%s[%lld] = %g: must be finite", name,
                         static_cast<long long>(i), value);
        for (int64_t i = 0; i < count; ++i) {
            const std::complex<double> value = value_at(otf->otf, response, kx[i], ky[i]);
            re[i] = value.real();
            im[i] = value.imag();
        }
    });
}

wfpsf_status wfpsf_otf_grid(const wfpsf_otf *otf, int32_t response, int32_t order, double step,
                            wfpsf_image *re, wfpsf_image *im) {
    return guarded([&] {
        require_pointer(otf, "otf");
        require_pointer(re, "re");
        require_pointer(im, "im");
        require_response(response);
        if (order < WFPSF_ORDER_CENTRED || order > WFPSF_ORDER_HALF)
            fail(WFPSF_ERROR_ARGUMENT, "order = %d: must be one of WFPSF_ORDER_*, %d..%d", order,
                 WFPSF_ORDER_CENTRED, WFPSF_ORDER_HALF);
        require_finite(step, "step");
        if (!(step > 0))
            fail(WFPSF_ERROR_RANGE, "step = %g: must be above 0", step);
        if (re == im)
            fail(WFPSF_ERROR_ARGUMENT, "re and im: must be two images");
        if (re->image.nx() != im->image.nx() || re->image.ny() != im->image.ny())
            fail(WFPSF_ERROR_SIZE, "im: is %lld x %lld pixels, re %lld x %lld: must be alike",
                 static_cast<long long>(im->image.nx()), static_cast<long long>(im->image.ny()),
                 static_cast<long long>(re->image.nx()), static_cast<long long>(re->image.ny()));
        const int32_t order_y = order == WFPSF_ORDER_HALF ? WFPSF_ORDER_WRAPPED : order;
        std::visit(
            [&](auto real, auto imaginary) {
                for (int64_t y = 0; y < real.ny; ++y)
                    for (int64_t x = 0; x < real.nx; ++x) {
                        const std::complex<double> value =
                            value_at(otf->otf, response, step * frequency(x, real.nx, order),
                                     step * frequency(y, real.ny, order_y));
                        real(x, y) = static_cast<std::decay_t<decltype(*real.data)>>(value.real());
                        imaginary(x, y) =
                            static_cast<std::decay_t<decltype(*imaginary.data)>>(value.imag());
                    }
            },
            re->image.pixels(), im->image.pixels());
    });
}

wfpsf_status wfpsf_otf_get(const wfpsf_otf *otf, int32_t key, double *value) {
    return guarded([&] {
        require_pointer(otf, "otf");
        require_pointer(value, "value");
        switch (key) {
        case WFPSF_OTF_ERROR_ESTIMATE:
            *value = otf->otf.error_estimate();
            return;
        case WFPSF_OTF_VALUE_ERROR:
            *value = otf->otf.value_error();
            return;
        case WFPSF_OTF_CUTOFF:
            *value = otf->otf.cutoff() / per_radian;
            return;
        case WFPSF_OTF_PIXELS:
            *value = static_cast<double>(otf->otf.pixels());
            return;
        default:
            fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: an OTF has no property of that key", key);
        }
    });
}
