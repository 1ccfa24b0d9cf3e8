// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/fft.hpp"

#include <map>
#include <new>

#include <fftw3.h>

namespace wfpsf {

int64_t good_fft_length(int64_t n) {
    for (;; ++n) {
        int64_t rest = n;
        while (rest % 2 == 0)
            rest /= 2;
        if (rest == 1 && n > 16)
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

BackwardFft::BackwardFft(int64_t n) {
    // For the life of the process: never destroyed, so that threads may outlive main().
    static auto &plans = *new std::map<int64_t, fftw_plan>;
    const std::lock_guard guard(fftw_planner_lock());
    fftw_plan &plan = plans[n];
    if (!plan) {
        // Unaligned, so that any buffer will do; an estimate does not touch the data.
        plan = fftw_plan_dft_1d(static_cast<int>(n), nullptr, nullptr, FFTW_BACKWARD,
                                FFTW_ESTIMATE | FFTW_UNALIGNED);
        if (!plan)
            throw std::bad_alloc();
    }
    plan_ = plan;
}

void BackwardFft::run(std::complex<double> *data) const {
    auto *buffer = reinterpret_cast<fftw_complex *>(data);
    fftw_execute_dft(static_cast<fftw_plan>(plan_), buffer, buffer);
}

} // namespace wfpsf
