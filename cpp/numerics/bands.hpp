// SPDX-License-Identifier: GPL-3.0-or-later
// Work in bands, one a thread. What a band computes must not depend on how many there are; then the
// bits do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <atomic>
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

// Calls work(i) for i = 0..count-1 on so many threads, which take the next one in turn.
template <class Work> void share_out(int64_t count, int threads, const Work &work) {
    std::atomic<int64_t> next = 0;
    for_each_band(std::clamp<int64_t>(threads, 1, std::max<int64_t>(count, 1)), [&](int64_t) {
        for (int64_t i = next++; i < count; i = next++)
            work(i);
    });
}

} // namespace wfpsf
