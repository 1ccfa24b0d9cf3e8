// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/fits_file.hpp"

#include "error/error.hpp"

namespace wfpsf {

namespace {

std::unique_lock<std::mutex> lock_if_needed() {
    static std::mutex mutex;
    if (fits_is_reentrant())
        return {};
    return std::unique_lock(mutex);
}

} // namespace

FitsFile::FitsFile(const std::string &path) : lock_(lock_if_needed()), path_(path) {
    fits_write_errmark();
}

FitsFile::~FitsFile() {
    int status = 0;
    if (file_)
        fits_close_file(file_, &status);
    fits_clear_errmark();
}

void FitsFile::check(int fits_status, wfpsf_status error, const char *what) const {
    if (fits_status == 0)
        return;
    if (fits_status == MEMORY_ALLOCATION)
        error = WFPSF_ERROR_NO_MEMORY;
    char text[FLEN_STATUS];
    fits_get_errstatus(fits_status, text);
    fail(error, "%s: %s: cfitsio status %d (%s)", path_.c_str(), what, fits_status, text);
}

void FitsFile::close(wfpsf_status error) {
    int status = 0;
    fits_close_file(file_, &status);
    file_ = nullptr;
    check(status, error, "closing");
}

} // namespace wfpsf
