// SPDX-License-Identifier: GPL-3.0-or-later
// Work in bands, one a thread. What a band computes must not depend on how many there are; then the
// bits do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

namespace wfpsf {

// Calls work(band) for band = 0..bands-1, the first on the calling thread. The first exception of
// any is thrown again when all have ended.
template <class Work> void for_each_band(int64_t bands, Work &&work) {
    std::vector<std::exception_ptr> failures(static_cast<size_t>(bands));
    const auto guarded = [&](int64_t band) noexcept {
        try {
            work(band);
        } catch (...) {
            failures[static_cast<size_t>(band)] = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> others;
        for (int64_t band = 1; band < bands; ++band)
            others.emplace_back(guarded, band);
        guarded(0);
    }
    for (const std::exception_ptr &failure : failures)
        if (failure)
            std::rethrow_exception(failure);
}

} // namespace wfpsf
