// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_kernel.hpp"

#include "error/error.hpp"
#include "numerics/fft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

std::array<double, 9> wfc3_uncertainties() {
    std::array<double, 9> lowest_row_first{0.0006, 0.0010, 0.0006, 0.0014, 0.0045,
                                           0.0011, 0.0006, 0.0009, 0.0006};
    for (double &deviation : lowest_row_first)
        deviation /= 0.9985;
    return lowest_row_first;
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

IpcKernel IpcKernel::neumann_correction(int64_t order) const {
    if (order < 0)
        fail(WFPSF_ERROR_RANGE, "order = %lld: must be at least 0", static_cast<long long>(order));
    // Horner: 1 + (1 - K)(1 + (1 - K)(...)).
    IpcKernel result{Plane<double>(1, 1)};
    result.taps_(0, 0) = 1;
    for (int64_t k = 0; k < order; ++k) {
        IpcKernel longer = composed(result);
        for (int64_t y = 0; y < longer.ny(); ++y)
            for (int64_t x = 0; x < longer.nx(); ++x)
                longer.taps_(x, y) = 0 - longer.taps_(x, y);
        for_each_tap(result, [&](int64_t dx, int64_t dy, double tap) {
            longer.taps_(dx + longer.reach_x(), dy + longer.reach_y()) += tap;
        });
        longer.taps_(longer.reach_x(), longer.reach_y()) += 1;
        result = std::move(longer);
    }
    return result;
}

IpcKernel IpcKernel::composed(const IpcKernel &other) const {
    const int64_t size_x = nx() + other.nx() - 1, size_y = ny() + other.ny() - 1;
    if (std::max(size_x, size_y) > max_kernel_size)
        fail(WFPSF_ERROR_SIZE,
             "the kernel would have %lld x %lld taps: must be at most %lld along an axis",
             static_cast<long long>(size_x), static_cast<long long>(size_y),
             static_cast<long long>(max_kernel_size));
    IpcKernel result{Plane<double>(size_x, size_y)};
    for_each_tap(other, [&](int64_t dx, int64_t dy, double tap) {
        const int64_t x0 = dx + other.reach_x(), y0 = dy + other.reach_y();
        for (int64_t y = 0; y < ny(); ++y)
            for (int64_t x = 0; x < nx(); ++x)
                result.taps_(x0 + x, y0 + y) += tap * taps_(x, y);
    });
    return result;
}

IpcKernel IpcKernel::autocorrelation() const {
    return composed(flipped());
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

double IpcKernel::sum_of_squares() const {
    double sum = 0;
    for_each_tap(*this, [&](int64_t, int64_t, double tap) { sum += tap * tap; });
    return sum;
}

KernelAsymmetry IpcKernel::asymmetry() const {
    KernelAsymmetry a{};
    a.transposed = nx() == ny() ? 0 : HUGE_VAL;
    for_each_tap(*this, [&](int64_t dx, int64_t dy, double tap) {
        const auto compare = [&](double &largest, int64_t to_x, int64_t to_y) {
            largest = std::max(largest, std::fabs(tap - (*this)(to_x, to_y)));
        };
        compare(a.left_right, -dx, dy);
        compare(a.up_down, dx, -dy);
        compare(a.half_turn, -dx, -dy);
        if (nx() == ny())
            compare(a.transposed, dy, dx);
    });
    return a;
}

std::complex<double> IpcKernel::transform(double frequency_x, double frequency_y) const {
    const auto turns = [](int64_t n, double frequency) {
        const int64_t reach = n / 2;
        std::vector<std::complex<double>> phases(static_cast<size_t>(n));
        for (int64_t d = -reach; d <= reach; ++d) {
            const double cycles = std::remainder(frequency * static_cast<double>(d), 1.0);
            phases[static_cast<size_t>(d + reach)] =
                std::polar(1.0, -2 * std::numbers::pi * cycles);
        }
        return phases;
    };
    const auto along_x = turns(nx(), frequency_x), along_y = turns(ny(), frequency_y);
    std::complex<double> sum = 0;
    for (int64_t y = 0; y < ny(); ++y) {
        std::complex<double> row = 0;
        for (int64_t x = 0; x < nx(); ++x)
            row += taps_(x, y) * along_x[static_cast<size_t>(x)];
        sum += row * along_y[static_cast<size_t>(y)];
    }
    return sum;
}

namespace {

// Over the frequencies (j / n, k / n). |K^| is even in both together: half of the plane will do.
StabilityMargin smallest_on_grid(const IpcKernel &kernel, int64_t n) {
    const BackwardFft fft(n);
    const auto at = [n](int64_t d) { return static_cast<size_t>((d % n + n) % n); };
    // Rows first; the signs of the exponents do not matter to an absolute value.
    std::vector<std::vector<std::complex<double>>> rows(static_cast<size_t>(kernel.ny()));
    for (int64_t y = 0; y < kernel.ny(); ++y) {
        auto &row = rows[static_cast<size_t>(y)];
        row.resize(static_cast<size_t>(n));
        for (int64_t dx = -kernel.reach_x(); dx <= kernel.reach_x(); ++dx)
            row[at(dx)] = kernel(dx, y - kernel.reach_y());
        fft.run(row.data());
    }
    StabilityMargin smallest{HUGE_VAL, 0, 0};
    std::vector<std::complex<double>> column(static_cast<size_t>(n));
    for (int64_t j = 0; j <= n / 2; ++j) {
        std::ranges::fill(column, 0);
        for (int64_t y = 0; y < kernel.ny(); ++y)
            column[at(y - kernel.reach_y())] = rows[static_cast<size_t>(y)][static_cast<size_t>(j)];
        fft.run(column.data());
        for (int64_t k = 0; k < n; ++k) {
            const double value = std::abs(column[static_cast<size_t>(k)]);
            const auto fy = static_cast<double>(k) / static_cast<double>(n);
            if (value < smallest.value)
                smallest = {value, static_cast<double>(j) / static_cast<double>(n),
                            fy > 0.5 ? fy - 1 : fy};
        }
    }
    return smallest;
}

} // namespace

StabilityMargin IpcKernel::margin() const {
    const int64_t n = 2 * good_fft_length(std::max<int64_t>(16, 2 * std::max(nx(), ny())));
    StabilityMargin best = smallest_on_grid(*this, n);
    best.value = std::abs(transform(best.frequency_x, best.frequency_y));
    // Steps along the axes and diagonals, halved when none leads down.
    for (double step = 0.5 / static_cast<double>(n); step > 1e-9;) {
        const StabilityMargin start = best;
        for (const int sx : {-1, 0, 1})
            for (const int sy : {-1, 0, 1}) {
                const double fx = std::clamp(start.frequency_x + sx * step, -0.5, 0.5);
                const double fy = std::clamp(start.frequency_y + sy * step, -0.5, 0.5);
                const double value = std::abs(transform(fx, fy));
                if (value < best.value)
                    best = {value, fx, fy};
            }
        if (!(best.value < start.value))
            step /= 2;
    }
    return best;
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
