// SPDX-License-Identifier: GPL-3.0-or-later
#include "error/error.hpp"
#include "image/fits.hpp"
#include "image/fits_file.hpp"
#include "image/fits_source.hpp"
#include "image/new_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <type_traits>

namespace wfpsf {

namespace {

bool is_printable(std::string_view text) {
    return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

bool is_reserved(std::string_view name) {
    static constexpr std::array<std::string_view, 17> names = {
        "SIMPLE",  "XTENSION", "BITPIX", "EXTEND",   "PCOUNT", "GCOUNT",
        "GROUPS",  "BSCALE",   "BZERO",  "BLANK",    "END",    "COMMENT",
        "HISTORY", "CONTINUE", "ZIMAGE", "CHECKSUM", "DATASUM"};
    return name.starts_with("NAXIS") || name.starts_with("WFPSF") ||
           std::ranges::find(names, name) != names.end();
}

void require_keyword(const FitsKeyword &keyword) {
    const auto allowed = [](char c) {
        return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    const std::string &name = keyword.name;
    if (name.empty() || name.size() > 8 || !std::ranges::all_of(name, allowed))
        fail(WFPSF_ERROR_ARGUMENT, "keyword \"%s\": must be 1 to 8 of A-Z, 0-9, - and _",
             name.c_str());
    if (is_reserved(name))
        fail(WFPSF_ERROR_ARGUMENT, "keyword \"%s\": is kept for the file's own use", name.c_str());
    if (!is_printable(keyword.comment))
        fail(WFPSF_ERROR_ARGUMENT, "comment of keyword \"%s\": must be printable ASCII",
             name.c_str());
    if (const double *number = std::get_if<double>(&keyword.value);
        number && !std::isfinite(*number))
        fail(WFPSF_ERROR_NOT_FINITE, "keyword \"%s\" = %g: must be finite", name.c_str(), *number);
    if (const auto *text = std::get_if<std::string>(&keyword.value)) {
        // A card holds 68 characters of text, in which a quote counts twice.
        const auto quotes = static_cast<size_t>(std::ranges::count(*text, '\''));
        if (text->size() + quotes > 68 || !is_printable(*text))
            fail(WFPSF_ERROR_ARGUMENT,
                 "keyword \"%s\" = \"%s\": must be at most 68 printable "
                 "ASCII characters",
                 name.c_str(), text->c_str());
    }
}

void write_keyword(const FitsFile &file, const FitsKeyword &keyword) {
    int status = 0;
    const char *name = keyword.name.c_str();
    const char *comment = keyword.comment.empty() ? nullptr : keyword.comment.c_str();
    std::visit(
        [&](const auto &value) {
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, int64_t>)
                fits_update_key_lng(file, name, value, comment, &status);
            else if constexpr (std::is_same_v<Value, double>)
                fits_update_key_dbl(file, name, value, -17, comment, &status); // 17 digits, %G
            else
                fits_update_key_str(file, name, value.c_str(), comment, &status);
        },
        keyword.value);
    file.check(status, WFPSF_ERROR_FILE_WRITE, name);
}

void write_record(const FitsFile &file, const Image &image) {
    write_keyword(file, {"WFPSFOVR", int64_t{image.oversampling()}, "samples per native pixel"});
    if (image.pixel_scale_arcsec() > 0)
        write_keyword(file, {"WFPSFPIX", image.pixel_scale_arcsec(), "[arcsec] native pixel"});
    write_keyword(file, {"WFPSFAPP", int64_t{image.applied()}, "effects applied, one bit each"});
}

template <class T> void write_pixels(const FitsFile &file, View<const T> view) {
    const int type = std::is_same_v<T, float> ? TFLOAT : TDOUBLE;
    std::vector<T> row(static_cast<size_t>(view.nx));
    int status = 0;
    for (int64_t y = 0; y < view.ny && status == 0; ++y) {
        for (int64_t x = 0; x < view.nx; ++x)
            row[static_cast<size_t>(x)] = view(x, y);
        fits_write_img(file, type, y * view.nx + 1, view.nx, row.data(), &status);
    }
    file.check(status, WFPSF_ERROR_FILE_WRITE, "writing pixels");
}

struct Memory {
    void *data = nullptr;
    size_t size = 0;
    ~Memory() { std::free(data); }
};

// The bytes of the whole file; the result's size is what the file takes of the memory.
void make_file(const std::string &path, const Image &image,
               const std::vector<FitsKeyword> &keywords, Memory &memory) {
    const bool single = image.type() == PixelType::float32;
    const size_t pixel_bytes = static_cast<size_t>(image.nx() * image.ny()) * (single ? 4 : 8);
    const size_t header_blocks = keywords.size() / 36 + 2;
    memory.size = pixel_bytes + (header_blocks + 1) * fits_block_bytes;
    memory.data = std::malloc(memory.size);
    if (!memory.data)
        throw std::bad_alloc();

    FitsFile file(path);
    int status = 0;
    fits_create_memfile(file.address(), &memory.data, &memory.size, fits_block_bytes, std::realloc,
                        &status);
    LONGLONG sizes[2] = {image.nx(), image.ny()};
    fits_create_imgll(file, single ? FLOAT_IMG : DOUBLE_IMG, 2, sizes, &status);
    file.check(status, WFPSF_ERROR_FILE_WRITE, "making the header");
    write_record(file, image);
    for (const FitsKeyword &keyword : keywords)
        write_keyword(file, keyword);
    std::visit([&](auto view) { write_pixels(file, view); }, image.pixels());

    LONGLONG header = 0, data = 0, end = 0;
    fits_flush_file(file, &status);
    fits_get_hduaddrll(file, &header, &data, &end, &status);
    file.check(status, WFPSF_ERROR_FILE_WRITE, "finishing");
    file.close(WFPSF_ERROR_FILE_WRITE);
    memory.size = static_cast<size_t>(end);
}

} // namespace

void write_fits(const std::string &path, const Image &image, bool overwrite,
                const std::vector<FitsKeyword> &keywords) {
    if (image.nx() == 0 || image.ny() == 0)
        fail(WFPSF_ERROR_SIZE, "image: is empty, and cannot be written to %s", path.c_str());
    for (const FitsKeyword &keyword : keywords)
        require_keyword(keyword);
    NewFile target(path, overwrite);
    Memory memory;
    make_file(path, image, keywords, memory);
    const std::span bytes(static_cast<const std::byte *>(memory.data), memory.size);
    if (path.ends_with(".gz"))
        target.write_compressed(bytes);
    else
        target.append(bytes);
    target.publish();
}

} // namespace wfpsf
