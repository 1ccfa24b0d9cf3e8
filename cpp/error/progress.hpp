// SPDX-License-Identifier: GPL-3.0-or-later
// How long work tells its caller how far it is and is told to stop, and how much memory it may
// take.
#pragma once

#include "error/error.hpp"

#include <cstdint>
#include <functional>
#include <limits>

namespace wfpsf {

struct Progress {
    // Called with the part done, 0..1, on the thread that asked for the work; false: stop.
    std::function<bool(double)> go_on = {};

    void report(double part) const {
        if (go_on && !go_on(part))
            fail(WFPSF_ERROR_CANCELLED, "progress: the caller asked to stop at %.0f %%",
                 100 * part);
    }

    // For a step that goes from part `from` to part `to` of the whole.
    Progress between(double from, double to) const {
        if (!go_on)
            return {};
        return {[this, from, to](double part) { return go_on(from + part * (to - from)); }};
    }
};

// How work of any length is to be done.
struct Manners {
    Progress progress = {};
    int64_t memory_limit = std::numeric_limits<int64_t>::max(); // bytes, beside the caller's own
    int threads = 1; // that it may use; the bits do not depend on their number

    // What needs more memory than that is not begun.
    void require_memory(int64_t bytes, const char *work) const {
        if (bytes > memory_limit)
            fail(WFPSF_ERROR_MEMORY_LIMIT, "MEMORY_LIMIT = %lld: %s takes %lld bytes",
                 static_cast<long long>(memory_limit), work, static_cast<long long>(bytes));
    }
};

} // namespace wfpsf
