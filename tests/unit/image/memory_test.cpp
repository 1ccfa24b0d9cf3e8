// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/memory.hpp"
#include "image/view.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <limits>

namespace wfpsf {
namespace {

constexpr size_t block = 1 << 20;

TEST(KeptMemory, BlocksComeBackWhileItLives) {
    const KeptMemory kept;
    void *const first = take_memory(block);
    give_memory(first);
    void *const second = take_memory(block - 1000);
    EXPECT_EQ(second, first);
    void *const third = take_memory(block);
    EXPECT_NE(third, first);
    give_memory(third);
    give_memory(second);
}

// A block far too large would be wasted on a small request.
TEST(KeptMemory, SmallRequestsLeaveLargeBlocksAlone) {
    const KeptMemory kept;
    void *const large = take_memory(8 * block);
    give_memory(large);
    void *const small = take_memory(block);
    EXPECT_NE(small, large);
    give_memory(small);
}

TEST(KeptMemory, BlocksOutliveIt) {
    void *memory = nullptr;
    {
        const KeptMemory outer;
        {
            const KeptMemory inner;
            memory = take_memory(block);
        }
        static_cast<char *>(memory)[block - 1] = 1;
    }
    give_memory(memory);
}

TEST(Plane, IsZeroAlsoInMemoryThatWasUsed) {
    const KeptMemory kept;
    {
        Plane<double> used(300, 300);
        for (int64_t y = 0; y < 300; ++y)
            for (int64_t x = 0; x < 300; ++x)
                used(x, y) = 1;
    }
    const Plane<double> fresh(300, 300), aligned = Plane<double>::with_aligned_rows(299, 300);
    for (int64_t y = 0; y < 300; ++y)
        for (int64_t x = 0; x < 299; ++x)
            ASSERT_EQ(fresh(x, y), 0);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(&aligned(0, 1)) % cache_line, 0u);
}

TEST(AlignedAllocator, MoreThanThereIsIsRefused) {
    AlignedAllocator<double> allocator;
    EXPECT_THROW((void)allocator.allocate(std::numeric_limits<size_t>::max() / 9), std::bad_alloc);
}

} // namespace
} // namespace wfpsf
