// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"

#include <algorithm>
#include <cstring>

#include <wfpsf/status.h>

namespace wfpsf {

namespace {

thread_local char last_line[1024];

} // namespace

wfpsf_status record_error(wfpsf_status status, const char *line) noexcept {
    const size_t length = std::min(std::strlen(line), sizeof last_line - 1);
    std::memcpy(last_line, line, length);
    last_line[length] = '\0';
    return status;
}

} // namespace wfpsf

const char *wfpsf_status_name(wfpsf_status status) {
    switch (status) {
#define WFPSF_CASE(name, value, text)                                                              \
    case value:                                                                                    \
        return "WFPSF_" #name;
        WFPSF_STATUS_LIST(WFPSF_CASE)
#undef WFPSF_CASE
    default:
        return "unknown status";
    }
}

const char *wfpsf_status_string(wfpsf_status status) {
    switch (status) {
#define WFPSF_CASE(name, value, text)                                                              \
    case value:                                                                                    \
        return text;
        WFPSF_STATUS_LIST(WFPSF_CASE)
#undef WFPSF_CASE
    default:
        return "unknown status";
    }
}

int64_t wfpsf_last_error(char *buffer, int64_t length) {
    const size_t whole = std::strlen(wfpsf::last_line);
    if (buffer && length > 0) {
        const size_t copied = std::min(whole, static_cast<size_t>(length) - 1);
        std::memcpy(buffer, wfpsf::last_line, copied);
        buffer[copied] = '\0';
    }
    return static_cast<int64_t>(whole);
}
