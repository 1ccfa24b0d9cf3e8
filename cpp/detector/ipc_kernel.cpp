// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_kernel.hpp"

#include "error/error.hpp"

#include <cmath>

namespace wfpsf {

namespace {

// Calls visit(dx, dy, tap) from the lowest row up, from left to right.
template <class Visit> void for_each_tap(const IpcKernel &kernel, Visit visit) {
    for (int64_t dy = -kernel.reach_y(); dy <= kernel.reach_y(); ++dy)
        for (int64_t dx = -kernel.reach_x(); dx <= kernel.reach_x(); ++dx)
            visit(dx, dy, kernel(dx, dy));
}

void require_finite(const char *name, double value) {
    if (!std::isfinite(value))
        fail(WFPSF_ERROR_NOT_FINITE, "%s = %g: must be finite", name, value);
}

void require_taps_in_unit_range(const IpcKernel &kernel) {
    for_each_tap(kernel, [](int64_t dx, int64_t dy, double tap) {
        if (tap < 0 || tap > 1 + kernel_sum_tolerance)
            fail(WFPSF_ERROR_KERNEL,
                 "kernel tap (dx, dy) = (%lld, %lld) is %.17g: must be 0..1, "
                 "unless negative taps are allowed",
                 static_cast<long long>(dx), static_cast<long long>(dy), tap);
    });
}

void require_unit_sum(const IpcKernel &kernel) {
    if (!(std::fabs(kernel.sum() - 1) <= kernel_sum_tolerance))
        fail(WFPSF_ERROR_KERNEL, "sum of the kernel's taps = %.17g: must be 1 within %g",
             kernel.sum(), kernel_sum_tolerance);
}

} // namespace

IpcKernel IpcKernel::parametric(double alpha, double alpha_prime, double alpha_plus,
                                KernelOptions options) {
    require_finite("alpha", alpha);
    require_finite("alpha_prime", alpha_prime);
    require_finite("alpha_plus", alpha_plus);
    const double q = alpha_prime, along_x = alpha + alpha_plus, along_y = alpha - alpha_plus;
    const double centre = 1 - 4 * (alpha + alpha_prime);
    const double taps[9] = {q, along_y, q, along_x, centre, along_x, q, along_y, q};
    return from_table({taps, 3, 3, 1, 3}, options);
}

IpcKernel IpcKernel::wfc3() {
    const double lowest_row_first[9] = {0.0011, 0.0127, 0.0011, 0.0163, 0.936,
                                        0.0164, 0.0011, 0.0127, 0.0011};
    return from_table({lowest_row_first, 3, 3, 1, 3}, {.normalise = true});
}

IpcKernel IpcKernel::from_table(View<const double> table, KernelOptions options) {
    for (int64_t n : {table.nx, table.ny})
        if (n < 1 || n > max_kernel_size || n % 2 == 0)
            fail(WFPSF_ERROR_SIZE, "kernel of %lld x %lld taps: sizes must be odd, 1..%lld",
                 static_cast<long long>(table.nx), static_cast<long long>(table.ny),
                 static_cast<long long>(max_kernel_size));

    IpcKernel kernel{Plane<double>(table.nx, table.ny)};
    for (int64_t y = 0; y < table.ny; ++y)
        for (int64_t x = 0; x < table.nx; ++x)
            kernel.taps_(x, y) = table(x, y);

    for_each_tap(kernel, [](int64_t dx, int64_t dy, double tap) {
        if (!std::isfinite(tap))
            fail(WFPSF_ERROR_NOT_FINITE, "kernel tap (dx, dy) = (%lld, %lld) is %g: must be finite",
                 static_cast<long long>(dx), static_cast<long long>(dy), tap);
    });
    if (options.normalise) {
        const double sum = kernel.sum();
        if (!(sum > 0 && std::isfinite(sum)))
            fail(WFPSF_ERROR_KERNEL,
                 "sum of the kernel's taps = %g: must be positive and finite "
                 "to divide by",
                 sum);
        for (int64_t y = 0; y < kernel.ny(); ++y)
            for (int64_t x = 0; x < kernel.nx(); ++x)
                kernel.taps_(x, y) /= sum;
    }
    if (!options.allow_negative)
        require_taps_in_unit_range(kernel);
    require_unit_sum(kernel);
    return kernel;
}

IpcKernel IpcKernel::first_order_correction() const {
    IpcKernel result{Plane<double>(nx(), ny())};
    for (int64_t y = 0; y < ny(); ++y)
        for (int64_t x = 0; x < nx(); ++x)
            result.taps_(x, y) = 0 - taps_(x, y); // not -taps_: keeps a zero tap positive
    result.taps_(reach_x(), reach_y()) += 2;
    return result;
}

IpcKernel IpcKernel::flipped() const {
    IpcKernel result{Plane<double>(nx(), ny())};
    for (int64_t y = 0; y < ny(); ++y)
        for (int64_t x = 0; x < nx(); ++x)
            result.taps_(x, y) = taps_(nx() - 1 - x, ny() - 1 - y);
    return result;
}

double IpcKernel::sum() const {
    double sum = 0;
    for_each_tap(*this, [&](int64_t, int64_t, double tap) { sum += tap; });
    return sum;
}

KernelMoments IpcKernel::moments() const {
    const double total = sum();
    KernelMoments m{};
    for_each_tap(*this, [&](int64_t dx, int64_t dy, double tap) {
        m.x += tap / total * static_cast<double>(dx);
        m.y += tap / total * static_cast<double>(dy);
    });
    for_each_tap(*this, [&](int64_t dx, int64_t dy, double tap) {
        const double x = static_cast<double>(dx) - m.x, y = static_cast<double>(dy) - m.y;
        m.xx += tap / total * x * x;
        m.xy += tap / total * x * y;
        m.yy += tap / total * y * y;
    });
    return m;
}

} // namespace wfpsf
