// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/archive.hpp"

#include "error/error.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>
#include <string_view>

namespace wfpsf {

namespace {

constexpr std::string_view mark = "wfpsf kept\n";
constexpr uint64_t of_machine = 0x0102030405060708; // other byte orders read something else

uint64_t mixed(uint64_t sum, uint64_t word) {
    sum = (sum ^ word) * 0x9e3779b97f4a7c15;
    return sum ^ sum >> 32;
}

} // namespace

void ByteSum::add(std::span<const std::byte> bytes) {
    const auto add_words = [this](const std::array<uint64_t, lanes> &words) {
        for (size_t lane = 0; lane < lanes; ++lane)
            sums_[lane] = mixed(sums_[lane], words[lane]);
    };
    std::array<uint64_t, lanes> words;
    for (; bytes.size() >= sizeof(words); bytes = bytes.subspan(sizeof(words))) {
        std::memcpy(&words, bytes.data(), sizeof(words));
        add_words(words);
    }
    if (bytes.empty())
        return;
    words = {};
    std::memcpy(&words, bytes.data(), bytes.size());
    add_words(words);
}

uint64_t ByteSum::value() const {
    return std::accumulate(sums_.begin(), sums_.end(), uint64_t{0}, mixed);
}

ArchiveWriter::ArchiveWriter(const std::string &path, const std::string &version)
    : file_(path, true) {
    write(std::as_bytes(std::span(mark)));
    put(of_machine);
    put(std::vector(version.begin(), version.end()));
}

void ArchiveWriter::write(std::span<const std::byte> bytes) {
    constexpr size_t enough = size_t{1} << 20;
    sum_.add(bytes);
    if (waiting_.size() + bytes.size() > enough)
        flush();
    if (bytes.size() > enough)
        file_.append(bytes);
    else
        std::ranges::copy(bytes, std::back_inserter(waiting_));
}

void ArchiveWriter::flush() {
    file_.append(waiting_);
    waiting_.clear();
}

void ArchiveWriter::finish() {
    put(sum_.value());
    flush();
    file_.publish();
}

ArchiveReader::ArchiveReader(const std::string &path, const std::string &version)
    : path_(path), file_(path, std::ios::binary | std::ios::ate) {
    const auto size = file_ ? static_cast<std::streamoff>(file_.tellg()) : -1;
    if (size < 0)
        fail(WFPSF_ERROR_FILE_OPEN, "%s: cannot be opened", path.c_str());
    left_ = static_cast<uint64_t>(size);
    file_.seekg(0);
    std::string begins(std::min<size_t>(mark.size(), left_), ' ');
    read(std::as_writable_bytes(std::span(begins)));
    if (begins != mark)
        fail_as("is not a file of wfpsf's own");
    if (take<uint64_t>() != of_machine)
        fail_as("was written on another kind of machine");
    const auto own = take<std::vector<char>>();
    if (std::string(own.begin(), own.end()) != version)
        fail_as("was written by another version of wfpsf");
}

void ArchiveReader::finish() {
    const uint64_t found = sum_.value();
    if (take<uint64_t>() != found || left_ != 0)
        fail_as("is damaged");
}

size_t ArchiveReader::count(size_t bytes_each) {
    const auto count = take<uint64_t>();
    if (count > left_ / bytes_each)
        fail_as("is damaged");
    return count;
}

void ArchiveReader::read(std::span<std::byte> bytes) {
    if (bytes.size() > left_)
        fail_as("ends too early");
    file_.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file_)
        fail_as("cannot be read");
    left_ -= bytes.size();
    sum_.add(bytes);
}

void ArchiveReader::fail_as(const char *what) const {
    fail(WFPSF_ERROR_FILE_FORMAT, "%s: %s", path_.c_str(), what);
}

} // namespace wfpsf
