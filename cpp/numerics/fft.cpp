// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/fft.hpp"

#include <array>
#include <map>
#include <new>

#include <fftw3.h>

namespace wfpsf {

int64_t good_fft_length(int64_t n) {
    constexpr int64_t small = 16;
    if (n > small)
        n = (n + 3) / 4 * 4;
    for (;; n += n < small ? 1 : 4) {
        int64_t rest = n;
        while (rest % 2 == 0)
            rest /= 2;
        if (rest == 1 && n > small)
            continue;
        for (const int64_t factor : {3, 5, 7})
            while (rest % factor == 0)
                rest /= factor;
        if (rest == 1)
            return n;
    }
}

std::mutex &fftw_planner_lock() {
    static auto &lock = *new std::mutex; // outlives every thread
    return lock;
}

namespace {

// A host may use FFTW too, on another thread: the planner then takes a lock of its own. As the
// library is loaded, since a host that is planning while that lock is put in would not hold it.
[[maybe_unused]] const bool planner_is_thread_safe = (fftw_make_planner_thread_safe(), true);

// Unaligned, so that any buffer will do; an estimate does not touch the data.
constexpr unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;

using Shape = std::array<int64_t, 3>; // kind; n and how many, or nx and ny

template <class Make> fftw_plan plan_of(const Shape &shape, Make make) {
    // For the life of the process: never destroyed, so that threads may outlive main().
    static auto &plans = *new std::map<Shape, fftw_plan>;
    const std::lock_guard guard(fftw_planner_lock());
    fftw_plan &plan = plans[shape];
    if (!plan)
        plan = make();
    if (!plan)
        throw std::bad_alloc();
    return plan;
}

} // namespace

BackwardFft::BackwardFft(int64_t n, int64_t batch)
    : PlannedFft(plan_of({1, n, batch}, [&] {
          const int length = static_cast<int>(n), side_by_side = static_cast<int>(batch);
          return fftw_plan_many_dft(1, &length, side_by_side, nullptr, nullptr, side_by_side, 1,
                                    nullptr, nullptr, side_by_side, 1, FFTW_BACKWARD, flags);
      })) {}

BackwardRowFfts::BackwardRowFfts(int64_t n, int64_t count)
    : PlannedFft(plan_of({4, n, count}, [&] {
          const int length = static_cast<int>(n);
          return fftw_plan_many_dft(1, &length, static_cast<int>(count), nullptr, nullptr, 1,
                                    length, nullptr, nullptr, 1, length, FFTW_BACKWARD, flags);
      })) {}

BackwardFft2d::BackwardFft2d(int64_t nx, int64_t ny)
    : PlannedFft(plan_of({2, nx, ny}, [&] {
          return fftw_plan_dft_2d(static_cast<int>(ny), static_cast<int>(nx), nullptr, nullptr,
                                  FFTW_BACKWARD, flags);
      })) {}

RealBackwardFft2d::RealBackwardFft2d(int64_t nx, int64_t ny)
    : PlannedFft(plan_of({3, nx, ny}, [&] {
          // Told apart, so that the plan is for two buffers.
          fftw_complex *in = nullptr;
          double out = 0;
          return fftw_plan_dft_c2r_2d(static_cast<int>(ny), static_cast<int>(nx), in, &out, flags);
      })) {}

void RealBackwardFft2d::run(std::complex<double> *in, double *out) const {
    fftw_execute_dft_c2r(static_cast<fftw_plan>(plan()), reinterpret_cast<fftw_complex *>(in), out);
}

void PlannedFft::run(std::complex<double> *data) const {
    auto *buffer = reinterpret_cast<fftw_complex *>(data);
    fftw_execute_dft(static_cast<fftw_plan>(plan_), buffer, buffer);
}

} // namespace wfpsf
