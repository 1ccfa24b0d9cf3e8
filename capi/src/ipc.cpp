// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_convolve.hpp"
#include "funnel.hpp"
#include "handles.hpp"

#include <cmath>
#include <variant>

using namespace wfpsf;

namespace {

KernelOptions kernel_options(const wfpsf_options *options) {
    return {.allow_negative = flag(options, WFPSF_OPTION_KERNEL_NEGATIVE),
            .normalise = flag(options, WFPSF_OPTION_KERNEL_NORMALISE)};
}

} // namespace

wfpsf_status wfpsf_ipc_kernel_create(double alpha, double alpha_prime, double alpha_plus,
                                     const wfpsf_options *options, wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        *out = new wfpsf_ipc_kernel{
            IpcKernel::parametric(alpha, alpha_prime, alpha_plus, kernel_options(options)),
            Effect::ipc};
    });
}

wfpsf_status wfpsf_ipc_kernel_create_taps(int64_t nx, int64_t ny, const double *taps,
                                          const wfpsf_options *options, wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(taps, "taps");
        *out = new wfpsf_ipc_kernel{
            IpcKernel::from_table({taps, nx, ny, 1, nx}, kernel_options(options)), Effect::ipc};
    });
}

wfpsf_status wfpsf_ipc_kernel_create_wfc3(wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        *out = new wfpsf_ipc_kernel{IpcKernel::wfc3(), Effect::ipc};
    });
}

wfpsf_status wfpsf_ipc_kernel_create_default(const wfpsf_instrument *instrument,
                                             wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        const std::optional<IpcTaps> &taps = instrument->instrument.ipc_kernel;
        if (!taps)
            fail(WFPSF_ERROR_ARGUMENT, "instrument: a design has no IPC kernel of its own");
        *out = new wfpsf_ipc_kernel{IpcKernel::from_table({taps->data(), 3, 3, 1, 3}), Effect::ipc};
    });
}

wfpsf_status wfpsf_ipc_kernel_create_correction(const wfpsf_ipc_kernel *kernel,
                                                wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(kernel, "kernel");
        *out =
            new wfpsf_ipc_kernel{kernel->kernel.first_order_correction(), Effect::ipc_correction};
    });
}

wfpsf_status wfpsf_ipc_kernel_create_flipped(const wfpsf_ipc_kernel *kernel,
                                             wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(kernel, "kernel");
        *out = new wfpsf_ipc_kernel{kernel->kernel.flipped(), kernel->effect};
    });
}

void wfpsf_ipc_kernel_destroy(wfpsf_ipc_kernel *kernel) {
    delete kernel;
}

wfpsf_status wfpsf_ipc_kernel_taps(const wfpsf_ipc_kernel *kernel, int64_t capacity, double *taps,
                                   int64_t *nx, int64_t *ny) {
    return guarded([&] {
        require_pointer(kernel, "kernel");
        const IpcKernel &k = kernel->kernel;
        if (capacity != 0 && capacity < k.nx() * k.ny())
            fail(WFPSF_ERROR_SIZE, "capacity = %lld: must be 0 or at least %lld",
                 static_cast<long long>(capacity), static_cast<long long>(k.nx() * k.ny()));
        if (capacity != 0)
            require_pointer(taps, "taps");
        if (nx)
            *nx = k.nx();
        if (ny)
            *ny = k.ny();
        if (capacity != 0)
            for (int64_t y = -k.reach_y(); y <= k.reach_y(); ++y)
                for (int64_t x = -k.reach_x(); x <= k.reach_x(); ++x)
                    *taps++ = k(x, y);
    });
}

wfpsf_status wfpsf_ipc_apply(const wfpsf_ipc_kernel *kernel, const wfpsf_image *in, int32_t edge,
                             const wfpsf_options *options, wfpsf_image *out) {
    return guarded([&] {
        require_pointer(kernel, "kernel");
        require_pointer(in, "in");
        require_pointer(out, "out");
        if (edge < WFPSF_EDGE_ZERO || edge > WFPSF_EDGE_VALID)
            fail(WFPSF_ERROR_ARGUMENT, "edge = %d: must be one of WFPSF_EDGE_*, %d..%d", edge,
                 WFPSF_EDGE_ZERO, WFPSF_EDGE_VALID);
        in->image.require_not_applied(kernel->effect, flag(options, WFPSF_OPTION_FORCE));
        std::visit(
            [&](auto from, auto to) {
                if constexpr (std::is_same_v<decltype(from), View<const float>> ==
                              std::is_same_v<decltype(to), View<float>>)
                    convolve(kernel->kernel, from, static_cast<Edge>(edge),
                             option(options, WFPSF_OPTION_IPC_FILL), in->image.oversampling(), to);
                else
                    fail(WFPSF_ERROR_TYPE, "out: must have the pixel type of in");
            },
            in->image.pixels(), out->image.pixels());
        out->image.set_oversampling(in->image.oversampling());
        out->image.set_pixel_scale_arcsec(in->image.pixel_scale_arcsec());
        out->image.set_applied(in->image.applied());
        out->image.record_applied(kernel->effect);
    });
}
