// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/plane_filter.hpp"

#include "numerics/fft.hpp"
#include "numerics/working_plane.hpp"

#include <memory>
#include <new>

#include <fftw3.h>

namespace wfpsf {

namespace {

struct DestroyPlan {
    void operator()(fftw_plan_s *plan) const {
        const std::lock_guard guard(fftw_planner_lock());
        fftw_destroy_plan(plan);
    }
};
using Plan = std::unique_ptr<fftw_plan_s, DestroyPlan>;

// Made by estimate, which leaves the data alone and gives equal calls equal bits.
template <class Make> Plan make_plan(Make make) {
    const std::lock_guard guard(fftw_planner_lock());
    Plan plan(make());
    if (!plan)
        throw std::bad_alloc();
    return plan;
}

void filter_periodic(View<double> image, const FilterRow &row) {
    const int nx = static_cast<int>(image.nx), ny = static_cast<int>(image.ny);
    const int64_t columns = image.nx / 2 + 1;
    WorkingPlane<std::complex<double>> memory(columns, image.ny);
    const View<std::complex<double>> spectrum = memory.view();
    double *pixels = image.data;
    auto *modes = reinterpret_cast<fftw_complex *>(spectrum.data);
    const Plan there =
        make_plan([&] { return fftw_plan_dft_r2c_2d(ny, nx, pixels, modes, FFTW_ESTIMATE); });
    const Plan back =
        make_plan([&] { return fftw_plan_dft_c2r_2d(ny, nx, modes, pixels, FFTW_ESTIMATE); });
    fftw_execute(there.get());
    const double scale = 1 / (static_cast<double>(nx) * ny);
    std::vector<std::complex<double>> factors(static_cast<size_t>(columns));
    for (int64_t k = 0; k < image.ny; ++k) {
        row(k, factors.data());
        for (int64_t j = 0; j < columns; ++j)
            spectrum(j, k) *= scale * factors[static_cast<size_t>(j)];
    }
    fftw_execute(back.get());
}

void filter_real(View<double> image, Continuation continuation, const FilterRow &row) {
    const int nx = static_cast<int>(image.nx), ny = static_cast<int>(image.ny);
    const bool odd = continuation == Continuation::odd;
    const auto plan = [&](fftw_r2r_kind kind) {
        return make_plan([&] {
            double *pixels = image.data;
            return fftw_plan_r2r_2d(ny, nx, pixels, pixels, kind, kind, FFTW_ESTIMATE);
        });
    };
    const Plan there = plan(odd ? FFTW_RODFT00 : FFTW_REDFT10);
    const Plan back = plan(odd ? FFTW_RODFT00 : FFTW_REDFT01);
    fftw_execute(there.get());
    const double length_x = 2.0 * (odd ? nx + 1 : nx), length_y = 2.0 * (odd ? ny + 1 : ny);
    std::vector<std::complex<double>> factors(static_cast<size_t>(nx));
    for (int64_t k = 0; k < image.ny; ++k) {
        row(k, factors.data());
        for (int64_t j = 0; j < image.nx; ++j)
            image(j, k) *= factors[static_cast<size_t>(j)].real() / (length_x * length_y);
    }
    fftw_execute(back.get());
}

} // namespace

std::vector<double> filter_frequencies(Continuation continuation, int64_t n, bool first_axis) {
    const bool periodic = continuation == Continuation::periodic;
    std::vector<double> frequencies(static_cast<size_t>(periodic && first_axis ? n / 2 + 1 : n));
    for (size_t j = 0; j < frequencies.size(); ++j) {
        const auto at = static_cast<double>(j), length = static_cast<double>(n);
        if (periodic)
            frequencies[j] = at / length;
        else if (continuation == Continuation::odd)
            frequencies[j] = (at + 1) / (2 * (length + 1));
        else
            frequencies[j] = at / (2 * length);
    }
    return frequencies;
}

void filter_plane(View<double> image, Continuation continuation, const FilterRow &row) {
    if (image.empty())
        return;
    if (continuation == Continuation::periodic)
        filter_periodic(image, row);
    else
        filter_real(image, continuation, row);
}

} // namespace wfpsf
