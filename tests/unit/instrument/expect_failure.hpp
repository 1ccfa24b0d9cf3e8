// SPDX-License-Identifier: GPL-3.0-or-later
// A call must fail with this status and a line that begins so.
#pragma once

#include "error/error.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <string>

namespace wfpsf {

inline void expect_failure(const std::function<void()> &call, wfpsf_status status,
                           const std::string &line) {
    try {
        call();
        ADD_FAILURE() << "no failure: " << line;
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), status);
        EXPECT_EQ(std::string(error.what()).substr(0, line.size()), line);
    }
}

} // namespace wfpsf
