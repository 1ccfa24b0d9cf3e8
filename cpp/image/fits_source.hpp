// SPDX-License-Identifier: GPL-3.0-or-later
// Walks a FITS file, plain or gzip-compressed, HDU by HDU. It trusts nothing that a header says:
// cfitsio reads and writes out of bounds on damaged ones, so it gets to see none of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>
#include <zlib.h>

namespace wfpsf {

inline constexpr size_t fits_block_bytes = 2880;

struct FitsHeader {
    std::vector<std::string> cards; // 80 characters each, END left out
    bool is_image = false;
    int bitpix = 0;
    std::vector<int64_t> axes;
    std::string name;        // EXTNAME
    uint64_t data_bytes = 0; // without padding; the file can hold them

    // The first card of that keyword, or an empty string.
    std::string_view card(std::string_view keyword) const;
};

class FitsSource {
  public:
    explicit FitsSource(const std::string &path);

    // Whether the file begins as a FITS file does; known after the first next().
    bool started() const { return started_; }
    // The next HDU's header; false where the file ends or something else than an HDU follows.
    bool next(FitsHeader &header);
    // The pixels of the HDU that next() found, big-endian, to memory for data_bytes. The last call.
    void read_data(void *memory);

  private:
    size_t read(char *to, size_t size);
    void measure(FitsHeader &header) const;

    std::string path_;
    std::unique_ptr<gzFile_s, int (*)(gzFile)> file_;
    uint64_t longest_ = 0; // no more bytes than this can come out of the file
    uint64_t position_ = 0, data_bytes_ = 0;
    bool started_ = false;
};

} // namespace wfpsf
