// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/fft.hpp"

#include <map>
#include <mutex>
#include <new>
#include <utility>

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

BackwardFft::BackwardFft(int64_t nx, int64_t ny) {
    static std::mutex lock;
    // For the life of the process: never destroyed, so that threads may outlive main().
    static auto &plans = *new std::map<std::pair<int64_t, int64_t>, fftw_plan>;
    const std::lock_guard guard(lock);
    fftw_plan &plan = plans[{nx, ny}];
    if (!plan) {
        // Unaligned, so that any buffer will do; an estimate does not touch the data.
        const int sizes[] = {static_cast<int>(ny), static_cast<int>(nx)};
        const int skipped = ny == 1 ? 1 : 0;
        plan = fftw_plan_dft(2 - skipped, sizes + skipped, nullptr, nullptr, FFTW_BACKWARD,
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
