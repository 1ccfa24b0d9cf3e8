// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/varying_ipc.hpp"

#include "error/error.hpp"
#include "numerics/dispatch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wfpsf {

namespace {

struct Parameter3 {
    double alpha, alpha_prime, alpha_plus;
};

// A tap of Eqs. 7-9, which is linear in the parameters.
struct LinearTap {
    double constant, by_alpha, by_alpha_prime, by_alpha_plus;
};

LinearTap linear_tap(VaryingIpc::Offset d) {
    if (d.dx == 0 && d.dy == 0)
        return {1, -4, -4, 0};
    if (d.dx != 0 && d.dy != 0)
        return {0, 0, 1, 0};
    return {0, 1, 0, d.dx != 0 ? 1.0 : -1.0};
}

double tap(Parameter3 p, VaryingIpc::Offset d) {
    const LinearTap t = linear_tap(d);
    return t.constant + t.by_alpha * p.alpha + t.by_alpha_prime * p.alpha_prime +
           t.by_alpha_plus * p.alpha_plus;
}

WFPSF_VECTORISED void fill_row(LinearTap t, const double *alpha, const double *alpha_prime,
                               const double *alpha_plus, int64_t count, double *__restrict taps) {
    for (int64_t i = 0; i < count; ++i)
        taps[i] = t.constant + t.by_alpha * alpha[i] + t.by_alpha_prime * alpha_prime[i] +
                  t.by_alpha_plus * alpha_plus[i];
}

// K^ is real and linear in the cosines of both frequencies: it is extreme at their corners.
SpectralInterval spectrum_of(Parameter3 p) {
    SpectralInterval extremes{1, 1};
    for (const double cx : {-1, 1})
        for (const double cy : {-1, 1}) {
            const double value = tap(p, {0, 0}) + 2 * tap(p, {1, 0}) * cx +
                                 2 * tap(p, {0, 1}) * cy + 4 * p.alpha_prime * cx * cy;
            extremes.lowest = std::min(extremes.lowest, value);
            extremes.highest = std::max(extremes.highest, value);
        }
    return extremes;
}

double coordinate(int64_t i, int64_t n) {
    return static_cast<double>(2 * i + 1 - n) / static_cast<double>(n);
}

} // namespace

void SurfacePolynomial::require_degree(int64_t degree) {
    if (degree < 0 || degree > most_degree)
        fail(WFPSF_ERROR_RANGE, "degree = %lld: must be 0..%lld", static_cast<long long>(degree),
             static_cast<long long>(most_degree));
}

SurfacePolynomial::SurfacePolynomial(int64_t degree, std::span<const double> coefficients)
    : degree_(static_cast<size_t>(degree)),
      coefficients_(coefficients.begin(), coefficients.end()) {
    require_degree(degree);
    if (std::ssize(coefficients) != coefficients_of(degree))
        fail(WFPSF_ERROR_SIZE, "a polynomial of degree %lld has %lld coefficients, not %zu",
             static_cast<long long>(degree), static_cast<long long>(coefficients_of(degree)),
             coefficients.size());
}

void SurfacePolynomial::row(int64_t nx, int64_t ny, int64_t y, double *values) const {
    const double Y = coordinate(y, ny);
    std::array<double, most_degree + 1> along{}; // coefficients of X^i
    for (size_t i = 0; i <= degree_; ++i)
        for (size_t j = degree_ - i + 1; j-- > 0;)
            along[i] = along[i] * Y + coefficients_[(i + j) * (i + j + 1) / 2 + j];
    std::fill_n(values, nx, along[degree_]);
    for (size_t i = degree_; i-- > 0;)
        for (int64_t x = 0; x < nx; ++x)
            values[x] = values[x] * coordinate(x, nx) + along[i];
}

void VaryingIpc::parameters(int64_t y, View<double> rows) const {
    const auto &surfaces = std::get<Parameters>(model_).surfaces;
    for (size_t k = 0; k < surfaces.size(); ++k) {
        double *row = rows.row(static_cast<int64_t>(k));
        std::visit(
            [&](const auto &surface) {
                if constexpr (std::is_same_v<std::decay_t<decltype(surface)>, SurfacePolynomial>)
                    surface.row(nx_, ny_, y, row);
                else
                    std::copy_n(surface.view().row(y), nx_, row);
            },
            surfaces[k]);
    }
}

void VaryingIpc::check_row(int64_t y, View<const double> rows, bool allow_negative) {
    constexpr const char *names[] = {"alpha", "alpha_prime", "alpha_plus"};
    for (int64_t x = 0; x < nx_; ++x) {
        const auto place = [&] {
            return std::pair(static_cast<long long>(x), static_cast<long long>(y));
        };
        for (int64_t k = 0; k < 3; ++k)
            if (!std::isfinite(rows(x, k)))
                fail(WFPSF_ERROR_NOT_FINITE, "%s(%lld, %lld) = %g: must be finite", names[k],
                     place().first, place().second, rows(x, k));
        const Parameter3 p{rows(x, 0), rows(x, 1), rows(x, 2)};
        for (const Offset d : {Offset{0, 0}, Offset{1, 0}, Offset{0, 1}, Offset{1, 1}}) {
            const double value = tap(p, d);
            if (!allow_negative && !(value >= 0 && value <= 1 + kernel_sum_tolerance))
                fail(WFPSF_ERROR_KERNEL,
                     "kernel tap (dx, dy) = (%d, %d) of pixel (%lld, %lld) is %.17g: must be 0..1, "
                     "unless negative taps are allowed",
                     static_cast<int>(d.dx), static_cast<int>(d.dy), place().first, place().second,
                     value);
        }
        const SpectralInterval own = spectrum_of(p);
        spectrum_.lowest = std::min(spectrum_.lowest, own.lowest);
        spectrum_.highest = std::max(spectrum_.highest, own.highest);
        const double margin = std::max(own.lowest, 0.0);
        if (margin < weakest_.margin)
            weakest_ = {margin, x, y};
    }
}

VaryingIpc VaryingIpc::parametric(int64_t nx, int64_t ny, std::array<Surface, 3> parameters,
                                  bool allow_negative) {
    VaryingIpc ipc(nx, ny);
    if (nx < 0 || ny < 0)
        fail(WFPSF_ERROR_SIZE, "a detector of %lld x %lld pixels: sizes must be >= 0",
             static_cast<long long>(nx), static_cast<long long>(ny));
    for (const Surface &surface : parameters)
        std::visit(
            [&](const auto &map) {
                if constexpr (!std::is_same_v<std::decay_t<decltype(map)>, SurfacePolynomial>)
                    if (map.nx() != nx || map.ny() != ny)
                        fail(WFPSF_ERROR_SIZE,
                             "a map has %lld x %lld pixels: the detector has %lld x %lld",
                             static_cast<long long>(map.nx()), static_cast<long long>(map.ny()),
                             static_cast<long long>(nx), static_cast<long long>(ny));
            },
            surface);
    ipc.model_ = Parameters{std::move(parameters)};
    ipc.reach_x_ = ipc.reach_y_ = 1;
    Plane<double> rows(nx, 3);
    bool has_corners = false;
    for (int64_t y = 0; y < ny; ++y) {
        ipc.parameters(y, rows.view());
        ipc.check_row(y, std::as_const(rows).view(), allow_negative);
        for (int64_t x = 0; x < nx; ++x)
            has_corners = has_corners || rows(x, 1) != 0;
    }
    for (int64_t dy = -1; dy <= 1; ++dy)
        for (int64_t dx = -1; dx <= 1; ++dx)
            if (has_corners || dx == 0 || dy == 0)
                ipc.offsets_.push_back({dx, dy});
    return ipc;
}

VaryingIpc VaryingIpc::of_regions(const Image &regions, std::span<const IpcKernel> kernels) {
    VaryingIpc ipc(regions.nx(), regions.ny());
    Regions model{{regions.nx(), regions.ny()}, {kernels.begin(), kernels.end()}};
    std::vector<bool> is_used(kernels.size());
    const auto use = [&](size_t k, int64_t x, int64_t y) {
        is_used[k] = true;
        const double margin = kernels[k].margin().value;
        const SpectralInterval own = real_spectrum(kernels[k]);
        ipc.spectrum_.lowest = std::min(ipc.spectrum_.lowest, own.lowest);
        ipc.spectrum_.highest = std::max(ipc.spectrum_.highest, own.highest);
        if (margin < ipc.weakest_.margin)
            ipc.weakest_ = {margin, x, y};
        ipc.reach_x_ = std::max(ipc.reach_x_, kernels[k].reach_x());
        ipc.reach_y_ = std::max(ipc.reach_y_, kernels[k].reach_y());
    };
    std::visit(
        [&](const auto &pixels) {
            for (int64_t y = 0; y < pixels.ny; ++y)
                for (int64_t x = 0; x < pixels.nx; ++x) {
                    const auto index = static_cast<double>(pixels(x, y));
                    if (!(index >= 0 && index < static_cast<double>(kernels.size()) &&
                          index == std::floor(index)))
                        fail(WFPSF_ERROR_RANGE,
                             "regions(%lld, %lld) = %g: must be the index of a kernel, 0..%lld",
                             static_cast<long long>(x), static_cast<long long>(y), index,
                             static_cast<long long>(kernels.size()) - 1);
                    const auto k = static_cast<size_t>(index);
                    model.index(x, y) = static_cast<int32_t>(k);
                    if (!is_used[k])
                        use(k, x, y);
                }
        },
        regions.pixels());
    for (int64_t dy = -ipc.reach_y_; dy <= ipc.reach_y_; ++dy)
        for (int64_t dx = -ipc.reach_x_; dx <= ipc.reach_x_; ++dx) {
            bool is_met = false;
            for (size_t k = 0; k < kernels.size(); ++k)
                is_met = is_met || (is_used[k] && kernels[k].tap_or_zero(dx, dy) != 0);
            if (is_met)
                ipc.offsets_.push_back({dx, dy});
        }
    ipc.model_ = std::move(model);
    return ipc;
}

void VaryingIpc::require_pixel(int64_t x, int64_t y) const {
    if (x < 0 || x >= nx_ || y < 0 || y >= ny_)
        fail(WFPSF_ERROR_RANGE, "pixel (%lld, %lld): must be within %lld x %lld pixels",
             static_cast<long long>(x), static_cast<long long>(y), static_cast<long long>(nx_),
             static_cast<long long>(ny_));
}

IpcKernel VaryingIpc::kernel(int64_t x, int64_t y) const {
    require_pixel(x, y);
    if (const auto *regions = std::get_if<Regions>(&model_))
        return regions->kernels[static_cast<size_t>(regions->index(x, y))];
    Plane<double> rows(nx_, 3);
    parameters(y, rows.view());
    return IpcKernel::parametric(rows(x, 0), rows(x, 1), rows(x, 2), {.allow_negative = true});
}

void VaryingIpc::taps(int64_t y, View<double> taps) const {
    const auto count = static_cast<int64_t>(offsets_.size());
    if (const auto *regions = std::get_if<Regions>(&model_)) {
        std::vector<double> by_kernel(regions->kernels.size());
        const int32_t *index = regions->index.view().row(y);
        for (int64_t k = 0; k < count; ++k) {
            const Offset d = offsets_[static_cast<size_t>(k)];
            for (size_t i = 0; i < by_kernel.size(); ++i)
                by_kernel[i] = regions->kernels[i].tap_or_zero(d.dx, d.dy);
            double *row = taps.row(k);
            for (int64_t x = 0; x < nx_; ++x)
                row[x] = by_kernel[static_cast<size_t>(index[x])];
        }
        return;
    }
    std::vector<double> memory(static_cast<size_t>(3 * nx_));
    parameters(y, {memory.data(), nx_, 3, 1, nx_});
    for (int64_t k = 0; k < count; ++k)
        fill_row(linear_tap(offsets_[static_cast<size_t>(k)]), memory.data(), memory.data() + nx_,
                 memory.data() + 2 * nx_, nx_, taps.row(k));
}

} // namespace wfpsf
