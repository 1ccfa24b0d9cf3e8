// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/fits_source.hpp"

#include "error/error.hpp"
#include "image/fits.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cinttypes>
#include <cstring>
#include <optional>
#include <sys/stat.h>

namespace wfpsf {

namespace {

constexpr size_t card_bytes = 80;
constexpr size_t longest_header_cards = 100000;
constexpr uint64_t deflate_ratio = 1032; // no deflate stream unpacks to more

std::string_view keyword_of(std::string_view card) {
    return card.substr(0, card.substr(0, 8).find_last_not_of(' ') + 1);
}

// What stands between "= " and the end of the card, without leading blanks.
std::string_view value_of(std::string_view card) {
    if (card.size() < 10 || card.substr(8, 2) != "= ")
        return {};
    const size_t start = card.find_first_not_of(' ', 10);
    return start == std::string_view::npos ? std::string_view() : card.substr(start);
}

std::optional<int64_t> integer_of(std::string_view card) {
    const std::string_view text = value_of(card);
    int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool closed = end == text.data() + text.size() || *end == ' ' || *end == '/';
    return error == std::errc() && closed ? std::optional(value) : std::nullopt;
}

std::string text_of(std::string_view card) {
    const std::string_view text = value_of(card);
    if (!text.starts_with('\''))
        return {};
    const std::string_view inside = text.substr(1, text.find('\'', 1) - 1);
    return std::string(inside.substr(0, inside.find_last_not_of(' ') + 1));
}

// A factor of an HDU's size, which must not be negative.
uint64_t count_of(const std::string &path, std::string_view card) {
    const std::optional<int64_t> value = integer_of(card);
    if (!value || *value < 0)
        fail(WFPSF_ERROR_FILE_FORMAT, "%s: \"%.40s\": must be a number >= 0", path.c_str(),
             std::string(card).c_str());
    return static_cast<uint64_t>(*value);
}

} // namespace

std::string_view FitsHeader::card(std::string_view keyword) const {
    for (const std::string &each : cards)
        if (keyword_of(each) == keyword)
            return each;
    return {};
}

FitsSource::FitsSource(const std::string &path) : path_(path), file_(nullptr, gzclose_r) {
    struct stat facts;
    if (stat(path.c_str(), &facts) != 0)
        fail(WFPSF_ERROR_FILE_OPEN, "%s: %s", path.c_str(), std::strerror(errno));
    if (!S_ISREG(facts.st_mode))
        fail(WFPSF_ERROR_FILE_OPEN, "%s: must be an ordinary file", path.c_str());
    file_.reset(gzopen(path.c_str(), "rb"));
    if (!file_)
        fail(WFPSF_ERROR_FILE_OPEN, "%s: %s", path.c_str(), std::strerror(errno));
    gzbuffer(file_.get(), 1 << 17);
    longest_ = static_cast<uint64_t>(facts.st_size);
    if (!gzdirect(file_.get()))
        longest_ = std::min(fits_gz_limit_bytes, longest_ * deflate_ratio);
}

// As many bytes as there are, up to size.
size_t FitsSource::read(char *to, size_t size) {
    const int got = gzread(file_.get(), to, static_cast<unsigned>(size));
    int error = Z_OK;
    const char *text = gzerror(file_.get(), &error);
    if (got < 0 || error != Z_OK)
        fail(WFPSF_ERROR_FILE_FORMAT, "%s: cannot be unpacked: %s", path_.c_str(), text);
    position_ += static_cast<uint64_t>(got);
    return static_cast<size_t>(got);
}

bool FitsSource::next(FitsHeader &header) {
    const uint64_t padded =
        (data_bytes_ + fits_block_bytes - 1) / fits_block_bytes * fits_block_bytes;
    if (padded > 0) {
        if (gzseek(file_.get(), static_cast<z_off_t>(padded), SEEK_CUR) < 0)
            return false;
        position_ += padded;
    }
    header = {};
    data_bytes_ = 0;
    std::array<char, fits_block_bytes> block;
    while (read(block.data(), block.size()) == block.size()) {
        for (size_t at = 0; at < block.size(); at += card_bytes) {
            std::string card(block.data() + at, card_bytes);
            if (header.cards.empty()) {
                if (!card.starts_with(started_ ? "XTENSION= " : "SIMPLE  = "))
                    return false;
                header.is_image = !started_ || text_of(card) == "IMAGE";
                started_ = true;
            }
            if (keyword_of(card) == "END") {
                measure(header);
                data_bytes_ = header.data_bytes;
                return true;
            }
            if (header.cards.size() == longest_header_cards)
                fail(WFPSF_ERROR_FILE_FORMAT, "%s: a header of more than %zu cards", path_.c_str(),
                     longest_header_cards);
            header.cards.push_back(std::move(card));
        }
    }
    if (!header.cards.empty())
        fail(WFPSF_ERROR_FILE_FORMAT, "%s: a header without END", path_.c_str());
    return false;
}

// The standard's first keywords, which stand in fixed places, and the size that follows from them.
void FitsSource::measure(FitsHeader &header) const {
    const auto card = [&](size_t index, const std::string &keyword) {
        if (index >= header.cards.size() || keyword_of(header.cards[index]) != keyword)
            fail(WFPSF_ERROR_FILE_FORMAT, "%s: card %zu of a header must be %s", path_.c_str(),
                 index + 1, keyword.c_str());
        return std::string_view(header.cards[index]);
    };
    const int64_t bitpix = integer_of(card(1, "BITPIX")).value_or(0);
    static constexpr std::array<int64_t, 6> allowed = {8, 16, 32, 64, -32, -64};
    if (std::ranges::find(allowed, bitpix) == allowed.end())
        fail(WFPSF_ERROR_FILE_FORMAT, "%s: BITPIX = %" PRId64 ": must be 8, 16, 32, 64, -32 or -64",
             path_.c_str(), bitpix);
    header.bitpix = static_cast<int>(bitpix);
    const uint64_t axes = count_of(path_, card(2, "NAXIS"));
    if (axes > 999)
        fail(WFPSF_ERROR_FILE_FORMAT, "%s: NAXIS = %" PRIu64 ": must be 0..999", path_.c_str(),
             axes);
    for (size_t axis = 1; axis <= axes; ++axis)
        header.axes.push_back(
            static_cast<int64_t>(count_of(path_, card(2 + axis, "NAXIS" + std::to_string(axis)))));
    header.name = text_of(header.card("EXTNAME"));

    // Random groups say NAXIS1 = 0 and mean the other axes.
    const bool groups = axes > 1 && header.axes[0] == 0 && !header.card("GROUPS").empty();
    uint64_t bytes = axes > 0 ? 1 : 0;
    bool overflow = false;
    for (size_t axis = groups; axis < axes; ++axis)
        overflow |= __builtin_mul_overflow(bytes, static_cast<uint64_t>(header.axes[axis]), &bytes);
    if (const auto count = header.card("PCOUNT"); !count.empty())
        overflow |= __builtin_add_overflow(bytes, count_of(path_, count), &bytes);
    if (const auto count = header.card("GCOUNT"); !count.empty())
        overflow |= __builtin_mul_overflow(bytes, count_of(path_, count), &bytes);
    const auto width = static_cast<uint64_t>(std::abs(header.bitpix) / 8);
    overflow |= __builtin_mul_overflow(bytes, width, &bytes);
    if (overflow || position_ > longest_ || bytes > longest_ - position_)
        fail(WFPSF_ERROR_FILE_FORMAT, "%s: the file is too short for what its header says",
             path_.c_str());
    header.data_bytes = bytes;
}

void FitsSource::read_data(void *memory) {
    auto *to = static_cast<char *>(memory);
    constexpr uint64_t step = 1 << 30;
    while (data_bytes_ > 0) {
        const size_t got = read(to, std::min(data_bytes_, step));
        if (got == 0)
            fail(WFPSF_ERROR_FILE_FORMAT, "%s: the file is too short for what its header says",
                 path_.c_str());
        to += got;
        data_bytes_ -= got;
    }
    if (gzdirect(file_.get()))
        return;
    // The check sum stands at the end of a compressed file.
    std::array<char, 1 << 14> rest;
    while (position_ < longest_ && read(rest.data(), rest.size()) > 0)
        continue;
}

} // namespace wfpsf
