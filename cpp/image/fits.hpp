// SPDX-License-Identifier: GPL-3.0-or-later
// Images in FITS files. NAXIS1 = nx, NAXIS2 = ny. Paths are literal: no part of one is ever taken
// for a filter, a URL or a command. Files that end in ".gz" are written compressed; compressed
// files are known by their first bytes when read.
#pragma once

#include "image/image.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace wfpsf {

// An HDU by its EXTNAME, or by its number (0 is the primary one) where the name is empty, or the
// first two-dimensional image where neither is given.
struct FitsHdu {
    std::optional<int> number;
    std::string name;
};

struct FitsKeyword {
    std::string name;
    std::variant<int64_t, double, std::string> value;
    std::string comment;
};

// What is read of a compressed file may take this much when it is unpacked.
inline constexpr uint64_t fits_gz_limit_bytes = uint64_t{4} << 30;

// The two-dimensional image in one HDU. Where no type is asked for, it is float32 if that holds
// every value (BITPIX 8, 16 and -32, without BSCALE and BZERO), else float64. Undefined pixels
// (BLANK) become NaN. The record is read from WFPSFOVR, WFPSFPIX and WFPSFAPP where they are there.
Image read_fits(const std::string &path, const FitsHdu &hdu = {},
                std::optional<PixelType> type = {});

// Writes one image as the primary HDU, with its record and the caller's keywords. The file appears
// whole or not at all, and one that is there is replaced only when overwrite is set.
void write_fits(const std::string &path, const Image &image, bool overwrite,
                const std::vector<FitsKeyword> &keywords = {});

// The text of a keyword in the primary header of a file that write_fits() made, not compressed;
// none if the file or the keyword is not there.
std::optional<std::string> read_fits_text(const std::string &path, const std::string &name);

} // namespace wfpsf
