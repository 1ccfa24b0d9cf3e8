// SPDX-License-Identifier: GPL-3.0-or-later
// A file that appears whole under its name or not at all.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace wfpsf {

class NewFile {
  public:
    // Makes a temporary file in path's folder. A file that is there already is an error unless
    // overwrite is set; it stays as it is until publish().
    NewFile(const std::string &path, bool overwrite);
    ~NewFile();
    NewFile(const NewFile &) = delete;
    NewFile &operator=(const NewFile &) = delete;

    // The next part of the content.
    void append(std::span<const std::byte> bytes);
    // The whole content, compressed with gzip.
    void write_compressed(std::span<const std::byte> bytes);
    void publish();

  private:
    std::string path_, temporary_;
    bool overwrite_;
    int descriptor_ = -1;
};

} // namespace wfpsf
