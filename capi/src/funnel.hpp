// SPDX-License-Identifier: GPL-3.0-or-later
// The one way from exceptions to status codes. Every C entry point runs its body through guarded().
#pragma once

#include "error/error.hpp"

#include <cmath>
#include <exception>
#include <new>
#include <span>
#include <type_traits>

namespace wfpsf {

// Keeps the line for wfpsf_last_error() of this thread and returns the status.
wfpsf_status record_error(wfpsf_status status, const char *line) noexcept;

// Runs a body that returns nothing or a status (a warning it has recorded).
template <class Body> wfpsf_status guarded(Body &&body) noexcept {
    try {
        if constexpr (std::is_void_v<decltype(body())>) {
            body();
            return WFPSF_OK;
        } else {
            return body();
        }
    } catch (const Error &error) {
        return record_error(error.status(), error.what());
    } catch (const std::bad_alloc &) {
        return record_error(WFPSF_ERROR_NO_MEMORY, "memory ran out");
    } catch (const std::exception &error) {
        return record_error(WFPSF_ERROR_INTERNAL, error.what());
    } catch (...) {
        return record_error(WFPSF_ERROR_INTERNAL, "unknown exception");
    }
}

inline void require_pointer(const void *pointer, const char *argument) {
    if (!pointer)
        fail(WFPSF_ERROR_NULL, "%s = NULL: must point to something", argument);
}

inline void require_finite(double value, const char *argument) {
    if (!std::isfinite(value))
        fail(WFPSF_ERROR_NOT_FINITE, "%s = %g: must be finite", argument, value);
}

// A caller's array: its count must not be negative, and it may be NULL if that is 0.
template <class T>
std::span<T> array_of(int64_t count, T *first, const char *count_argument, const char *argument) {
    if (count < 0)
        fail(WFPSF_ERROR_SIZE, "%s = %lld: must be >= 0", count_argument,
             static_cast<long long>(count));
    if (count > 0)
        require_pointer(first, argument);
    return {first, static_cast<size_t>(count)};
}

} // namespace wfpsf
