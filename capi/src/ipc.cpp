// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_covariance.hpp"
#include "ipc_parts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>

using namespace wfpsf;

namespace {

// The kernel as a convolution, in the form that is asked for.
IpcKernel in_form(const wfpsf_ipc_kernel *kernel, const wfpsf_options *options) {
    return flag(options, WFPSF_OPTION_IPC_FORM) ? kernel->kernel.flipped() : kernel->kernel;
}

Convolution convolution(const wfpsf_image *in, int32_t edge, const wfpsf_options *options) {
    return {checked_edge(edge), option(options, WFPSF_OPTION_IPC_FILL), in->image.oversampling(),
            static_cast<int>(option(options, WFPSF_OPTION_THREADS))};
}

double property(const IpcKernel &kernel, int32_t key) {
    switch (key) {
    case WFPSF_KERNEL_SUM:
        return kernel.sum();
    case WFPSF_KERNEL_CENTROID_X:
        return kernel.moments().x;
    case WFPSF_KERNEL_CENTROID_Y:
        return kernel.moments().y;
    case WFPSF_KERNEL_MXX:
        return kernel.moments().xx;
    case WFPSF_KERNEL_MXY:
        return kernel.moments().xy;
    case WFPSF_KERNEL_MYY:
        return kernel.moments().yy;
    case WFPSF_KERNEL_LEFT_RIGHT:
        return kernel.asymmetry().left_right;
    case WFPSF_KERNEL_UP_DOWN:
        return kernel.asymmetry().up_down;
    case WFPSF_KERNEL_HALF_TURN:
        return kernel.asymmetry().half_turn;
    case WFPSF_KERNEL_TRANSPOSED:
        return kernel.asymmetry().transposed;
    case WFPSF_KERNEL_MARGIN:
        return kernel.margin().value;
    case WFPSF_KERNEL_MARGIN_FREQUENCY_X:
        return kernel.margin().frequency_x;
    case WFPSF_KERNEL_MARGIN_FREQUENCY_Y:
        return kernel.margin().frequency_y;
    case WFPSF_KERNEL_VARIANCE_RATIO:
        return kernel.sum_of_squares();
    // The photon transfer takes var / mean for the gain: IPC leaves the mean and shrinks the
    // variance. Electrons are then counted too many by as much.
    case WFPSF_KERNEL_CONVERSION_GAIN_BIAS:
        return kernel.sum_of_squares() - 1;
    case WFPSF_KERNEL_QUANTUM_EFFICIENCY_BIAS:
        return 1 / kernel.sum_of_squares() - 1;
    case WFPSF_KERNEL_INVERSE_NOISE:
        return inverse_noise_amplification(kernel);
    default:
        fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: kernels have no property of that key", key);
    }
}

Effect both(Effect first, Effect second) {
    return static_cast<Effect>(static_cast<uint32_t>(first) | static_cast<uint32_t>(second));
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

wfpsf_status wfpsf_ipc_kernel_read_fits(const char *path, const char *hdu,
                                        const wfpsf_options *options, wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        wfpsf_image *image = nullptr;
        const wfpsf_status status = wfpsf_image_read_fits(path, hdu, WFPSF_FLOAT64, &image);
        const std::unique_ptr<wfpsf_image, decltype(&wfpsf_image_destroy)> owner(
            image, wfpsf_image_destroy);
        if (status != WFPSF_OK)
            return status; // its line is there already
        const auto taps = std::get<View<const double>>(std::as_const(image->image).pixels());
        *out =
            new wfpsf_ipc_kernel{IpcKernel::from_table(taps, kernel_options(options)), Effect::ipc};
        return status;
    });
}

wfpsf_status wfpsf_ipc_kernel_create_composed(const wfpsf_ipc_kernel *first,
                                              const wfpsf_ipc_kernel *second,
                                              wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(first, "first");
        require_pointer(second, "second");
        *out = new wfpsf_ipc_kernel{second->kernel.composed(first->kernel),
                                    both(first->effect, second->effect)};
    });
}

wfpsf_status wfpsf_ipc_kernel_create_neumann(const wfpsf_ipc_kernel *kernel, int64_t order,
                                             wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(kernel, "kernel");
        *out =
            new wfpsf_ipc_kernel{kernel->kernel.neumann_correction(order), Effect::ipc_correction};
    });
}

wfpsf_status wfpsf_ipc_kernel_create_autocorrelation(const wfpsf_ipc_kernel *kernel,
                                                     wfpsf_ipc_kernel **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(kernel, "kernel");
        *out = new wfpsf_ipc_kernel{kernel->kernel.autocorrelation(), kernel->effect};
    });
}

wfpsf_status wfpsf_ipc_wfc3_deviations(int64_t capacity, double *deviations) {
    return guarded([&] {
        require_pointer(deviations, "deviations");
        if (capacity < 9)
            fail(WFPSF_ERROR_SIZE, "capacity = %lld: must be at least 9",
                 static_cast<long long>(capacity));
        std::ranges::copy(wfc3_uncertainties(), deviations);
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

wfpsf_status wfpsf_ipc_kernel_get(const wfpsf_ipc_kernel *kernel, int32_t key, double *value) {
    return guarded([&] {
        require_pointer(kernel, "kernel");
        require_pointer(value, "value");
        *value = property(kernel->kernel, key);
    });
}

wfpsf_status wfpsf_ipc_kernel_transform(const wfpsf_ipc_kernel *kernel, double frequency_x,
                                        double frequency_y, double *real_part,
                                        double *imaginary_part) {
    return guarded([&] {
        require_pointer(kernel, "kernel");
        require_pointer(real_part, "real_part");
        require_pointer(imaginary_part, "imaginary_part");
        require_finite(frequency_x, "frequency_x");
        require_finite(frequency_y, "frequency_y");
        const std::complex<double> value = kernel->kernel.transform(frequency_x, frequency_y);
        *real_part = value.real();
        *imaginary_part = value.imag();
    });
}

wfpsf_status wfpsf_ipc_apply(const wfpsf_ipc_kernel *kernel, const wfpsf_image *in, int32_t edge,
                             const wfpsf_options *options, wfpsf_image *out, int64_t *not_finite) {
    return guarded([&] {
        require_pointer(kernel, "kernel");
        require_pointer(in, "in");
        require_pointer(out, "out");
        const Convolution how = convolution(in, edge, options);
        in->image.require_not_applied(kernel->effect, flag(options, WFPSF_OPTION_FORCE));
        const IpcKernel applied = in_form(kernel, options);
        with_pixels(in, out, [&](auto from, auto to) { convolve(applied, from, how, to); });
        copy_record(in, out);
        out->image.record_applied(kernel->effect);
        if (not_finite)
            *not_finite = not_finite_in(out);
    });
}

wfpsf_status wfpsf_ipc_kernel_self_test(const wfpsf_ipc_kernel *kernel,
                                        const wfpsf_options *options, int64_t capacity,
                                        double *response) {
    return guarded([&] {
        require_pointer(kernel, "kernel");
        require_pointer(response, "response");
        const int64_t nx = kernel->kernel.nx(), ny = kernel->kernel.ny();
        if (capacity < nx * ny)
            fail(WFPSF_ERROR_SIZE, "capacity = %lld: must be at least %lld",
                 static_cast<long long>(capacity), static_cast<long long>(nx * ny));
        Plane<double> charge(nx, ny);
        charge(nx / 2, ny / 2) = 1;
        convolve(in_form(kernel, options), charge.view(), {}, {response, nx, ny, 1, nx});
    });
}

wfpsf_status wfpsf_ipc_correct(const wfpsf_ipc_kernel *kernel, const wfpsf_image *in, int32_t edge,
                               const wfpsf_options *options, wfpsf_image *out, double *residual,
                               double *noise_amplification, int64_t *passes, int64_t *not_finite) {
    return guarded([&] {
        require_pointer(kernel, "kernel");
        require_pointer(in, "in");
        require_pointer(out, "out");
        const Convolution how = convolution(in, edge, options);
        in->image.require_not_applied(Effect::ipc_correction, flag(options, WFPSF_OPTION_FORCE));
        const SolveLimits limits = solve_limits(options);
        const IpcKernel applied = in_form(kernel, options);
        Solution solution;
        with_pixels(in, out, [&](auto from, auto to) {
            solution = solve_ipc(applied, from, how, limits, to);
        });
        copy_record(in, out);
        out->image.record_applied(Effect::ipc_correction);
        return report(solution, limits, residual, noise_amplification, passes, not_finite);
    });
}

wfpsf_status wfpsf_ipc_covariance(const wfpsf_ipc_kernel *kernel, const wfpsf_image *variance,
                                  int64_t lag_x, int64_t lag_y, int32_t edge,
                                  const wfpsf_options *options, wfpsf_image *out) {
    return guarded([&] {
        require_pointer(kernel, "kernel");
        require_pointer(variance, "variance");
        require_pointer(out, "out");
        const Convolution how = convolution(variance, edge, options);
        const IpcKernel applied = in_form(kernel, options);
        with_pixels(variance, out, [&](auto from, auto to) {
            covariance(applied, from, {lag_x, lag_y}, how, to);
        });
        copy_record(variance, out);
    });
}
