// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "image/fits.hpp"
#include "image/fits_file.hpp"
#include "image/fits_source.hpp"

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <optional>

namespace wfpsf {

namespace {

constexpr wfpsf_status bad_format = WFPSF_ERROR_FILE_FORMAT;

bool is_wanted(const FitsHeader &header, int number, const FitsHdu &hdu) {
    if (!hdu.name.empty())
        return header.name == hdu.name;
    return hdu.number ? number == *hdu.number : header.is_image && header.axes.size() == 2;
}

FitsHeader find_hdu(FitsSource &source, const std::string &path, const FitsHdu &hdu) {
    if (hdu.number.value_or(0) < 0)
        fail(WFPSF_ERROR_RANGE, "hdu = %d: must be >= 0", *hdu.number);
    FitsHeader header;
    for (int number = 0; source.next(header); ++number) {
        if (!is_wanted(header, number, hdu))
            continue;
        if (!header.is_image)
            fail(bad_format, "%s: HDU %d is a table: must be an image", path.c_str(), number);
        return header;
    }
    if (!source.started())
        fail(bad_format, "%s: not a FITS file: must begin with \"SIMPLE  =\"", path.c_str());
    if (!hdu.name.empty())
        fail(bad_format, "%s: has no HDU with EXTNAME \"%s\"", path.c_str(), hdu.name.c_str());
    if (hdu.number)
        fail(bad_format, "%s: has no HDU %d", path.c_str(), *hdu.number);
    fail(bad_format, "%s: has no two-dimensional image", path.c_str());
}

void require_plain_image(const std::string &path, const FitsHeader &header) {
    if (header.axes.size() != 2)
        fail(bad_format, "%s: NAXIS = %zu: must be 2", path.c_str(), header.axes.size());
    const int64_t nx = header.axes[0], ny = header.axes[1];
    if (nx < 1 || ny < 1)
        fail(bad_format, "%s: %" PRId64 " x %" PRId64 " pixels: must be 1 x 1 or more",
             path.c_str(), nx, ny);
    const auto width = static_cast<uint64_t>(std::abs(header.bitpix) / 8);
    if (header.data_bytes / width / static_cast<uint64_t>(nx) != static_cast<uint64_t>(ny) ||
        header.data_bytes != static_cast<uint64_t>(nx * ny) * width)
        fail(bad_format, "%s: PCOUNT and GCOUNT of an image must be 0 and 1", path.c_str());
}

// One HDU as a file in memory: the cards that say how to read the pixels, and the pixels.
std::vector<char> single_hdu(FitsSource &source, const FitsHeader &header) {
    std::vector<char> bytes(fits_block_bytes, ' ');
    char *end = bytes.data();
    const auto add = [&end](std::string_view card) {
        std::memcpy(end, card.data(), card.size());
        end += 80;
    };
    char card[81];
    add("SIMPLE  =                    T");
    std::snprintf(card, sizeof card, "BITPIX  = %20d", header.bitpix);
    add(card);
    add("NAXIS   =                    2");
    std::snprintf(card, sizeof card, "NAXIS1  = %20" PRId64, header.axes[0]);
    add(card);
    std::snprintf(card, sizeof card, "NAXIS2  = %20" PRId64, header.axes[1]);
    add(card);
    for (const char *keyword : {"BSCALE", "BZERO", "BLANK", "WFPSFOVR", "WFPSFPIX", "WFPSFAPP"})
        if (const std::string_view found = header.card(keyword); !found.empty())
            add(found);
    add("END");
    const uint64_t blocks = (header.data_bytes + fits_block_bytes - 1) / fits_block_bytes;
    bytes.resize((1 + blocks) * fits_block_bytes);
    source.read_data(bytes.data() + fits_block_bytes);
    return bytes;
}

template <class T> std::optional<T> read_key(const FitsFile &file, const char *name, int type) {
    T value{};
    int status = 0;
    fits_read_key(file, type, name, &value, nullptr, &status);
    if (status == KEY_NO_EXIST || status == VALUE_UNDEFINED)
        return std::nullopt;
    file.check(status, bad_format, name);
    return value;
}

void read_record(const FitsFile &file, const std::string &path, Image &image) {
    if (const auto n = read_key<LONGLONG>(file, "WFPSFOVR", TLONGLONG)) {
        if (*n < 1 || *n > std::numeric_limits<int>::max())
            fail(bad_format, "%s: WFPSFOVR = %lld: must be >= 1", path.c_str(), *n);
        image.set_oversampling(static_cast<int>(*n));
    }
    if (const auto scale = read_key<double>(file, "WFPSFPIX", TDOUBLE)) {
        if (!std::isfinite(*scale) || *scale < 0)
            fail(bad_format, "%s: WFPSFPIX = %g: must be >= 0", path.c_str(), *scale);
        image.set_pixel_scale_arcsec(*scale);
    }
    if (const auto effects = read_key<LONGLONG>(file, "WFPSFAPP", TLONGLONG)) {
        if (*effects < 0 || *effects > std::numeric_limits<uint32_t>::max())
            fail(bad_format, "%s: WFPSFAPP = %lld: must be 0..2^32-1", path.c_str(), *effects);
        image.set_applied(static_cast<uint32_t>(*effects));
    }
}

Image read_pixels(const FitsFile &file, const FitsHeader &header, std::optional<PixelType> type) {
    const bool scaled = read_key<double>(file, "BSCALE", TDOUBLE).value_or(1) != 1 ||
                        read_key<double>(file, "BZERO", TDOUBLE).value_or(0) != 0;
    const bool fits_single =
        !scaled && (header.bitpix == 8 || header.bitpix == 16 || header.bitpix == -32);
    const PixelType kind = type.value_or(fits_single ? PixelType::float32 : PixelType::float64);
    Image image(kind, header.axes[0], header.axes[1]);
    // A null value makes cfitsio look for BLANK. Among floating-point pixels it would also turn
    // infinities to NaN and subnormal numbers to 0, so there it is not given.
    double nan = std::numeric_limits<double>::quiet_NaN();
    double *undefined = header.bitpix > 0 ? &nan : nullptr;
    int status = 0, any_undefined = 0;
    std::visit(
        [&](auto view) {
            fits_read_img(file, kind == PixelType::float32 ? TFLOAT : TDOUBLE, 1, view.nx * view.ny,
                          undefined, view.data, &any_undefined, &status);
        },
        image.pixels());
    file.check(status, bad_format, "reading pixels");
    return image;
}

} // namespace

Image read_fits(const std::string &path, const FitsHdu &hdu, std::optional<PixelType> type) {
    FitsSource source(path);
    const FitsHeader header = find_hdu(source, path, hdu);
    require_plain_image(path, header);
    std::vector<char> bytes = single_hdu(source, header);

    void *memory = bytes.data();
    size_t size = bytes.size();
    FitsFile file(path);
    int status = 0;
    fits_open_memfile(file.address(), "memory", READONLY, &memory, &size, 0, nullptr, &status);
    file.check(status, bad_format, "opening");
    Image image = read_pixels(file, header, type);
    read_record(file, path, image);
    return image;
}

std::optional<std::string> read_fits_text(const std::string &path, const std::string &name) {
    constexpr size_t card_length = 80;
    std::ifstream file(path, std::ios::binary);
    std::string key = name;
    key.resize(8, ' ');
    key += "= '";
    for (std::string card(card_length, ' '); file.read(card.data(), card_length);) {
        if (card.starts_with("END     "))
            break;
        if (!card.starts_with(key))
            continue;
        std::string text = card.substr(key.size());
        text = text.substr(0, text.find('\''));
        const size_t last = text.find_last_not_of(' ');
        return text.substr(0, last == std::string::npos ? 0 : last + 1);
    }
    return {};
}

} // namespace wfpsf
