// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers, vectors and planes in a file, for what a program keeps for itself: in the machine's own
// format, and read again only by the same version of the library. Classes that are more than plain
// numbers side by side list what an archive holds of them, once for both directions:
//
//     template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
//         archive(self.first_, self.second_);
//     }
#pragma once

#include "image/new_file.hpp"
#include "image/view.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace wfpsf {

// Tells bytes from others: by words, each of which changes what its lane makes of all that follow.
class ByteSum {
  public:
    void add(std::span<const std::byte> bytes);
    uint64_t value() const;

  private:
    static constexpr size_t lanes = 4; // so that one product need not wait for another
    std::array<uint64_t, lanes> sums_{1, 2, 3, 4};
};

template <class T>
concept Archived = requires(T &self, int &archive) {
    T::archived(self, archive);
};
// Bytes as they are.
template <class T>
concept Plain = std::is_trivially_copyable_v<T> && !Archived<T>;

// A file that appears whole, at finish(), or not at all, and takes the place of one that is there.
class ArchiveWriter {
  public:
    ArchiveWriter(const std::string &path, const std::string &version); // of what is written
    void finish();

    template <class... T> void operator()(const T &...items) { (put(items), ...); }

  private:
    template <Plain T> void put(const T &item) { write(std::as_bytes(std::span(&item, 1))); }
    void put(bool flag) { put(static_cast<uint8_t>(flag)); }
    template <class T> void put(const std::vector<T> &items) {
        put(static_cast<uint64_t>(items.size()));
        if constexpr (Plain<T>)
            write(std::as_bytes(std::span(items)));
        else
            for (const T &item : items)
                put(item);
    }
    template <class T> void put(const Plane<T> &plane) {
        put(plane.nx());
        put(plane.ny());
        for (int64_t y = 0; y < plane.ny(); ++y)
            write(std::as_bytes(std::span(plane.view().row(y), static_cast<size_t>(plane.nx()))));
    }
    template <class T> void put(const std::optional<T> &item) {
        put(item.has_value());
        if (item)
            put(*item);
    }
    template <class T> void put(const std::shared_ptr<const T> &item) {
        put(item != nullptr);
        if (item)
            put(*item);
    }
    template <Archived T> void put(const T &object) { T::archived(object, *this); }
    void write(std::span<const std::byte> bytes);
    void flush();

    NewFile file_;
    ByteSum sum_;
    std::vector<std::byte> waiting_;
};

// Fails with WFPSF_ERROR_FILE_FORMAT on a file that is not whole, or of another version. What is
// read counts only once finish() finds the file whole.
class ArchiveReader {
  public:
    ArchiveReader(const std::string &path, const std::string &version);
    void finish();

    template <class... T> void operator()(T &...items) { (get(items), ...); }
    template <class T> T take() {
        T item;
        get(item);
        return item;
    }

  private:
    template <Plain T> void get(T &item) { read(std::as_writable_bytes(std::span(&item, 1))); }
    void get(bool &flag) { flag = take<uint8_t>() != 0; }
    template <class T> void get(std::vector<T> &items) {
        items.clear();
        if constexpr (Plain<T>) {
            items.resize(count(sizeof(T)));
            read(std::as_writable_bytes(std::span(items)));
        } else
            for (size_t more = count(1); more > 0; --more)
                items.push_back(take<T>());
    }
    template <class T> void get(Plane<T> &plane) {
        const size_t nx = count(sizeof(T)), ny = count(std::max<size_t>(nx, 1) * sizeof(T));
        plane = Plane<T>::unset(static_cast<int64_t>(nx), static_cast<int64_t>(ny));
        for (int64_t y = 0; y < plane.ny(); ++y)
            read(std::as_writable_bytes(std::span(plane.view().row(y), nx)));
    }
    template <class T> void get(std::optional<T> &item) {
        item.reset();
        if (take<bool>())
            item = take<T>();
    }
    template <class T> void get(std::shared_ptr<const T> &item) {
        item = take<bool>() ? std::make_shared<const T>(take<T>()) : nullptr;
    }
    template <Archived T> void get(T &object) { T::archived(object, *this); }
    // How many items follow; the rest of the file holds as many of that size.
    size_t count(size_t bytes_each);
    void read(std::span<std::byte> bytes);
    [[noreturn]] void fail_as(const char *what) const;

    std::string path_;
    std::ifstream file_;
    uint64_t left_ = 0; // bytes
    ByteSum sum_;
};

} // namespace wfpsf
