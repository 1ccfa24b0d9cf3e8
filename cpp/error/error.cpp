// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"

#include <cstdarg>
#include <cstdio>

namespace wfpsf {

void fail(wfpsf_status status, const char *format, ...) {
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    throw Error(status, line);
}

} // namespace wfpsf
