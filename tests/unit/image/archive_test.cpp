// SPDX-License-Identifier: GPL-3.0-or-later
// Archives give back what they were given, and nothing at all of files that are not whole.
#include "image/archive.hpp"
#include "status_of.hpp"
#include "temporary_folder.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace wfpsf {
namespace {

struct Pair {
    double first, second;
    bool operator==(const Pair &) const = default;
};

class Everything {
  public:
    int number = 0;
    bool flag = false;
    Pair pair{};
    std::vector<float> numbers = {};
    std::vector<Pair> pairs = {};
    std::vector<std::vector<size_t>> nested = {};
    Plane<double> plane = {};
    std::optional<double> something = {}, nothing = 1;
    std::shared_ptr<const std::vector<double>> shared = {}, none = {};

    template <class Self, class Archive> static void archived(Self &self, Archive &archive) {
        archive(self.number, self.flag, self.pair, self.numbers, self.pairs, self.nested,
                self.plane, self.something, self.nothing, self.shared, self.none);
    }
};

// With a plane whose rows are apart.
Everything everything() {
    Everything all{.number = -7,
                   .flag = true,
                   .pair = {1.5, -INFINITY},
                   .numbers = std::vector<float>(400000, 0.25f),
                   .pairs = {{1, 2}, {3, std::numeric_limits<double>::denorm_min()}},
                   .nested = {{}, {1, 2, 3}, {std::numeric_limits<size_t>::max()}},
                   .plane = Plane<double>::with_aligned_rows(5, 3),
                   .something = 0.1,
                   .nothing = {},
                   .shared = std::make_shared<const std::vector<double>>(3, 2.5),
                   .none = {}};
    for (int64_t y = 0; y < 3; ++y)
        for (int64_t x = 0; x < 5; ++x)
            all.plane(x, y) = static_cast<double>(10 * y + x);
    return all;
}

void write(const std::string &path, const Everything &all) {
    ArchiveWriter archive(path, "test 1");
    archive(all);
    archive.finish();
}

Everything read(const std::string &path, const std::string &version = "test 1") {
    ArchiveReader archive(path, version);
    auto all = archive.take<Everything>();
    archive.finish();
    return all;
}

TEST(Archive, GivesBackWhatItWasGiven) {
    const TemporaryFolder folder;
    const std::string path = folder.path("all");
    const Everything all = everything();
    write(path, all);
    const Everything again = read(path);
    EXPECT_EQ(again.number, all.number);
    EXPECT_EQ(again.flag, all.flag);
    EXPECT_EQ(again.pair, all.pair);
    EXPECT_EQ(again.numbers, all.numbers);
    EXPECT_EQ(again.pairs, all.pairs);
    EXPECT_EQ(again.nested, all.nested);
    ASSERT_EQ(again.plane.nx(), 5);
    ASSERT_EQ(again.plane.ny(), 3);
    for (int64_t y = 0; y < 3; ++y)
        for (int64_t x = 0; x < 5; ++x)
            EXPECT_EQ(again.plane(x, y), all.plane(x, y));
    EXPECT_EQ(again.something, all.something);
    EXPECT_FALSE(again.nothing);
    EXPECT_EQ(*again.shared, *all.shared);
    EXPECT_FALSE(again.none);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"all"}); // nothing temporary is left
}

TEST(Archive, RefusesWhatIsNotWhole) {
    const TemporaryFolder folder;
    const std::string path = folder.path("all");
    Everything small = everything();
    small.numbers.resize(3);
    write(path, small);
    const std::string whole = read_text(path);
    const auto status = [&](const std::string &text) {
        write_text(path, text);
        return status_of([&] { read(path); });
    };
    ASSERT_EQ(status(whole), WFPSF_OK);
    for (size_t size = 0; size < whole.size(); ++size)
        ASSERT_EQ(status(whole.substr(0, size)), WFPSF_ERROR_FILE_FORMAT) << size;
    EXPECT_EQ(status(whole + ' '), WFPSF_ERROR_FILE_FORMAT);
    // Whatever byte is another one: lengths that no memory would hold among them.
    for (size_t at = 0; at < whole.size(); ++at)
        for (const int bits : {1, 0x80, 0xff}) {
            std::string damaged = whole;
            damaged[at] = static_cast<char>(damaged[at] ^ bits);
            ASSERT_EQ(status(damaged), WFPSF_ERROR_FILE_FORMAT) << at;
        }
}

TEST(Archive, RefusesOtherVersionsAndFiles) {
    const TemporaryFolder folder;
    const std::string path = folder.path("all");
    write(path, everything());
    EXPECT_EQ(status_of([&] { read(path, "test 2"); }), WFPSF_ERROR_FILE_FORMAT);
    EXPECT_EQ(status_of([&] { read(folder.path("none")); }), WFPSF_ERROR_FILE_OPEN);
    EXPECT_NE(status_of([&] { read(folder.path("")); }), WFPSF_OK); // a folder
    EXPECT_EQ(status_of([&] { ArchiveWriter(folder.path("no/file"), "test 1"); }),
              WFPSF_ERROR_FILE_WRITE);
}

TEST(Archive, WhatIsThereStaysUntilAllIsWritten) {
    const TemporaryFolder folder;
    const std::string path = folder.path("all");
    write(path, everything());
    {
        ArchiveWriter archive(path, "test 1"); // broken off
        archive(1.0);
    }
    EXPECT_EQ(read(path).number, -7);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"all"});
}

} // namespace
} // namespace wfpsf
