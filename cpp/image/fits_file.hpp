// SPDX-License-Identifier: GPL-3.0-or-later
// One cfitsio file handle and the rules for using cfitsio inside somebody else's process.
#pragma once

#include <mutex>
#include <string>

#include <fitsio.h>
#include <wfpsf/status.h>

namespace wfpsf {

// While it lives, messages that cfitsio stacks up are ours; they are dropped at the end, and those
// of the host program stay. Calls are serialised where cfitsio was built without thread support.
class FitsFile {
  public:
    explicit FitsFile(const std::string &path);
    ~FitsFile();
    FitsFile(const FitsFile &) = delete;
    FitsFile &operator=(const FitsFile &) = delete;

    operator fitsfile *() const { return file_; }
    fitsfile **address() { return &file_; }
    // Fails with the path, what was tried, and cfitsio's text if its status is an error.
    void check(int fits_status, wfpsf_status error, const char *what) const;
    void close(wfpsf_status error);

  private:
    std::unique_lock<std::mutex> lock_;
    std::string path_;
    fitsfile *file_ = nullptr;
};

} // namespace wfpsf
