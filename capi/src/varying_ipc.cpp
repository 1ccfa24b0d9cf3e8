// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_covariance.hpp"
#include "ipc_parts.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

using namespace wfpsf;

namespace {

VaryingIpc::Surface map_of(const wfpsf_image *map) {
    if (!map)
        return SurfacePolynomial();
    return std::visit(
        [](auto pixels) -> VaryingIpc::Surface {
            Plane<std::remove_const_t<std::remove_pointer_t<decltype(pixels.data)>>> copy(
                pixels.nx, pixels.ny);
            for (int64_t y = 0; y < pixels.ny; ++y)
                for (int64_t x = 0; x < pixels.nx; ++x)
                    copy(x, y) = pixels(x, y);
            return copy;
        },
        map->image.pixels());
}

VaryingIpc::Surface polynomial_of(int64_t degree, const double *coefficients) {
    if (!coefficients)
        return SurfacePolynomial();
    SurfacePolynomial::require_degree(degree);
    return SurfacePolynomial(
        degree, {coefficients, static_cast<size_t>(SurfacePolynomial::coefficients_of(degree))});
}

wfpsf_varying_ipc *made(VaryingIpc ipc) {
    return new wfpsf_varying_ipc{std::make_shared<const VaryingIpc>(std::move(ipc))};
}

void require_native(const wfpsf_image *image, const char *name) {
    if (image->image.oversampling() != 1)
        fail(WFPSF_ERROR_ARGUMENT,
             "%s: oversampling = %d: varying IPC acts on native pixels, oversampling 1", name,
             image->image.oversampling());
}

VaryingConvolution convolution(int32_t edge, const wfpsf_options *options) {
    return {flag(options, WFPSF_OPTION_IPC_FORM) ? IpcForm::gather : IpcForm::scatter,
            checked_edge(edge), option(options, WFPSF_OPTION_IPC_FILL),
            static_cast<int>(option(options, WFPSF_OPTION_THREADS))};
}

} // namespace

wfpsf_status wfpsf_varying_ipc_create_maps(const wfpsf_image *alpha, const wfpsf_image *alpha_prime,
                                           const wfpsf_image *alpha_plus,
                                           const wfpsf_options *options, wfpsf_varying_ipc **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(alpha, "alpha");
        *out = made(VaryingIpc::parametric(alpha->image.nx(), alpha->image.ny(),
                                           {map_of(alpha), map_of(alpha_prime), map_of(alpha_plus)},
                                           flag(options, WFPSF_OPTION_KERNEL_NEGATIVE)));
    });
}

wfpsf_status wfpsf_varying_ipc_create_polynomials(int64_t nx, int64_t ny, int64_t degree,
                                                  const double *alpha, const double *alpha_prime,
                                                  const double *alpha_plus,
                                                  const wfpsf_options *options,
                                                  wfpsf_varying_ipc **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(alpha, "alpha");
        *out = made(VaryingIpc::parametric(nx, ny,
                                           {polynomial_of(degree, alpha),
                                            polynomial_of(degree, alpha_prime),
                                            polynomial_of(degree, alpha_plus)},
                                           flag(options, WFPSF_OPTION_KERNEL_NEGATIVE)));
    });
}

wfpsf_status wfpsf_varying_ipc_create_regions(const wfpsf_image *regions, int64_t count,
                                              const wfpsf_ipc_kernel *const *kernels,
                                              wfpsf_varying_ipc **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(regions, "regions");
        std::vector<IpcKernel> copies;
        for (const wfpsf_ipc_kernel *kernel : array_of(count, kernels, "count", "kernels")) {
            require_pointer(kernel, "kernels[]");
            copies.push_back(kernel->kernel);
        }
        *out = made(VaryingIpc::of_regions(regions->image, copies));
    });
}

void wfpsf_varying_ipc_destroy(wfpsf_varying_ipc *varying) {
    delete varying;
}

wfpsf_status wfpsf_varying_ipc_kernel(const wfpsf_varying_ipc *varying, int64_t x, int64_t y,
                                      wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(varying, "varying");
        *out = new wfpsf_ipc_kernel{varying->ipc->kernel(x, y), Effect::ipc};
    });
}

wfpsf_status wfpsf_varying_ipc_margin(const wfpsf_varying_ipc *varying, double *margin, int64_t *x,
                                      int64_t *y) {
    return guarded([&] {
        require_pointer(varying, "varying");
        require_pointer(margin, "margin");
        const VaryingIpc::Weakest &weakest = varying->ipc->weakest();
        *margin = weakest.margin;
        if (x)
            *x = weakest.x;
        if (y)
            *y = weakest.y;
    });
}

wfpsf_status wfpsf_varying_ipc_apply(const wfpsf_varying_ipc *varying, const wfpsf_image *in,
                                     int32_t edge, const wfpsf_options *options, wfpsf_image *out,
                                     int64_t *not_finite) {
    return guarded([&] {
        require_pointer(varying, "varying");
        require_pointer(in, "in");
        require_pointer(out, "out");
        require_native(in, "in");
        const VaryingConvolution how = convolution(edge, options);
        in->image.require_not_applied(Effect::ipc, flag(options, WFPSF_OPTION_FORCE));
        with_pixels(in, out, [&](auto from, auto to) { convolve(*varying->ipc, from, how, to); });
        copy_record(in, out);
        out->image.record_applied(Effect::ipc);
        if (not_finite)
            *not_finite = not_finite_in(out);
    });
}

wfpsf_status wfpsf_varying_ipc_correct(const wfpsf_varying_ipc *varying, const wfpsf_image *in,
                                       int32_t edge, const wfpsf_options *options, wfpsf_image *out,
                                       double *residual, double *noise_amplification,
                                       int64_t *passes, int64_t *not_finite) {
    return guarded([&] {
        require_pointer(varying, "varying");
        require_pointer(in, "in");
        require_pointer(out, "out");
        require_native(in, "in");
        const VaryingConvolution how = convolution(edge, options);
        in->image.require_not_applied(Effect::ipc_correction, flag(options, WFPSF_OPTION_FORCE));
        const SolveLimits limits = solve_limits(options);
        Solution solution;
        with_pixels(in, out, [&](auto from, auto to) {
            solution =
                solve_ipc(*varying->ipc, from, how, limits, noise_amplification != nullptr, to);
        });
        copy_record(in, out);
        out->image.record_applied(Effect::ipc_correction);
        return report(solution, limits, residual, noise_amplification, passes, not_finite);
    });
}

wfpsf_status wfpsf_varying_ipc_covariance(const wfpsf_varying_ipc *varying,
                                          const wfpsf_image *variance, int64_t lag_x, int64_t lag_y,
                                          int32_t edge, const wfpsf_options *options,
                                          wfpsf_image *out) {
    return guarded([&] {
        require_pointer(varying, "varying");
        require_pointer(variance, "variance");
        require_pointer(out, "out");
        require_native(variance, "variance");
        const VaryingConvolution how = convolution(edge, options);
        with_pixels(variance, out, [&](auto from, auto to) {
            covariance(*varying->ipc, from, {lag_x, lag_y}, how, to);
        });
        copy_record(variance, out);
    });
}

wfpsf_status wfpsf_varying_ipc_autocorrelation(const wfpsf_varying_ipc *varying,
                                               const wfpsf_image *variance, int64_t x, int64_t y,
                                               int32_t edge, const wfpsf_options *options,
                                               int64_t capacity, double *covariances, int64_t *nx,
                                               int64_t *ny) {
    return guarded([&] {
        require_pointer(varying, "varying");
        const VaryingIpc &ipc = *varying->ipc;
        const int64_t columns = 4 * ipc.reach_x() + 1, rows = 4 * ipc.reach_y() + 1;
        if (capacity != 0 && capacity < columns * rows)
            fail(WFPSF_ERROR_SIZE, "capacity = %lld: must be 0 or at least %lld",
                 static_cast<long long>(capacity), static_cast<long long>(columns * rows));
        if (capacity != 0) {
            require_pointer(covariances, "covariances");
            if (variance)
                require_native(variance, "variance");
            const Plane<double> found = neighbour_covariances(
                ipc, variance ? &variance->image : nullptr, x, y, convolution(edge, options));
            std::copy_n(found.view().data, columns * rows, covariances);
        }
        if (nx)
            *nx = columns;
        if (ny)
            *ny = rows;
    });
}
