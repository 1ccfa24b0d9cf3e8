// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "error/error.hpp"

// The status that an action fails with, or WFPSF_OK.
template <class Action> wfpsf_status status_of(Action action) {
    try {
        action();
    } catch (const wfpsf::Error &error) {
        return error.status();
    }
    return WFPSF_OK;
}
