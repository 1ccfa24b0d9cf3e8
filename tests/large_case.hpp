// SPDX-License-Identifier: GPL-3.0-or-later
// A test that begins with WFPSF_LARGE_CASE() is one of the release alone: sanitizers would make it
// minutes long, and smaller tests run the same code under them.
#pragma once

#include <gtest/gtest.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WFPSF_LARGE_CASE() GTEST_SKIP() << "a large case: run in the release alone"
#else
#define WFPSF_LARGE_CASE() static_cast<void>(0)
#endif
