// SPDX-License-Identifier: GPL-3.0-or-later
// The one exception of the core. The C API turns it into its status code and last-error line.
#pragma once

#include <stdexcept>
#include <string>

#include <wfpsf/status.h>

namespace wfpsf {

class Error : public std::runtime_error {
  public:
    Error(wfpsf_status status, const std::string &line)
        : std::runtime_error(line), status_(status) {}
    wfpsf_status status() const noexcept { return status_; }

  private:
    wfpsf_status status_;
};

// Throws an Error whose line is made printf-style. The line names the argument, its value and the
// allowed range: fail(WFPSF_ERROR_RANGE, "sca = %d: must be 1..18", sca).
[[noreturn, gnu::format(printf, 2, 3)]] void fail(wfpsf_status status, const char *format, ...);

} // namespace wfpsf
