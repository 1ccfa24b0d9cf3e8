// SPDX-License-Identifier: GPL-3.0-or-later
// How long work tells its caller how far it is, and is told to stop.
#pragma once

#include "error/error.hpp"

#include <functional>

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

} // namespace wfpsf
