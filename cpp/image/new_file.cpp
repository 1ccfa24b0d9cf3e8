// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/new_file.hpp"

#include "error/error.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <zlib.h>

namespace wfpsf {

namespace {

constexpr size_t largest_step = size_t{1} << 30;

[[noreturn]] void fail_with_errno(const std::string &path) {
    fail(WFPSF_ERROR_FILE_WRITE, "%s: %s", path.c_str(), std::strerror(errno));
}

[[noreturn]] void fail_because_there(const std::string &path) {
    fail(WFPSF_ERROR_FILE_WRITE, "%s: is there already: must be new, or overwriting allowed",
         path.c_str());
}

// Hands the bytes to write_some(), which takes a pointer and a length and returns how many it
// wrote, 0 or less at an error.
template <class WriteSome>
bool write_in_steps(std::span<const std::byte> bytes, WriteSome write_some) {
    while (!bytes.empty()) {
        const auto written = write_some(bytes.data(), std::min(bytes.size(), largest_step));
        if (written <= 0)
            return false;
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return true;
}

} // namespace

NewFile::NewFile(const std::string &path, bool overwrite) : path_(path), overwrite_(overwrite) {
    struct stat facts;
    if (lstat(path.c_str(), &facts) == 0) {
        if (S_ISDIR(facts.st_mode))
            fail(WFPSF_ERROR_FILE_WRITE, "%s: is a folder", path.c_str());
        if (!overwrite)
            fail_because_there(path);
    }
    static std::atomic<unsigned> count = 0;
    const std::string folder = path.substr(0, path.find_last_of('/') + 1);
    do {
        temporary_ = folder + ".wfpsf-" + std::to_string(getpid()) + "-" + std::to_string(count++);
        descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0)
        fail_with_errno(path);
}

NewFile::~NewFile() {
    if (descriptor_ >= 0)
        close(descriptor_);
    if (!temporary_.empty())
        unlink(temporary_.c_str());
}

void NewFile::append(std::span<const std::byte> bytes) {
    if (!write_in_steps(bytes, [this](const std::byte *data, size_t size) {
            return ::write(descriptor_, data, size);
        }))
        fail_with_errno(path_);
}

void NewFile::write_compressed(std::span<const std::byte> bytes) {
    gzFile file = gzdopen(descriptor_, "wb");
    if (!file)
        fail_with_errno(path_);
    descriptor_ = -1; // zlib closes it from here on
    const bool whole = write_in_steps(bytes, [file](const std::byte *data, size_t size) {
        return gzwrite(file, data, static_cast<unsigned>(size));
    });
    if (gzclose_w(file) != Z_OK || !whole)
        fail_with_errno(path_);
}

void NewFile::publish() {
    if (descriptor_ >= 0 && close(std::exchange(descriptor_, -1)) != 0)
        fail_with_errno(path_);
    if (!overwrite_) {
        // A link is refused where the name was taken in the meantime; a rename would replace it.
        if (link(temporary_.c_str(), path_.c_str()) == 0)
            return;
        if (errno == EEXIST)
            fail_because_there(path_);
        // This file system has no hard links.
    }
    if (rename(temporary_.c_str(), path_.c_str()) != 0)
        fail_with_errno(path_);
    temporary_.clear();
}

} // namespace wfpsf
