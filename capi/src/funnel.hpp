// SPDX-License-Identifier: GPL-3.0-or-later
// The one way from exceptions to status codes. Every C entry point runs its body through guarded().
#pragma once

#include "error/error.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <span>
#include <string>
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

// A text for a caller's buffer: the first capacity - 1 characters, closed by NUL. The buffer may be
// NULL if capacity is 0, the length too.
inline void copy_text(const std::string &from, int64_t capacity, char *text, int64_t *length) {
    const std::span<char> room = array_of(capacity, text, "capacity", "text");
    if (!room.empty()) {
        const size_t copied = std::min(from.size(), room.size() - 1);
        std::copy_n(from.begin(), copied, room.begin());
        room[copied] = '\0';
    }
    if (length)
        *length = static_cast<int64_t>(from.size());
}

} // namespace wfpsf
