// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/memory.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace wfpsf {

namespace {

constexpr size_t large = size_t{1} << 16;

// Stands before each block, a cache line long.
struct Header {
    size_t capacity;
};

// Where there are huge pages, a large block is asked for in such: small ones cost more to touch for
// the first time than most sums.
constexpr size_t huge_page = size_t{1} << 21;
std::align_val_t alignment_of(size_t capacity) {
    return std::align_val_t(capacity >= 2 * huge_page ? huge_page : cache_line);
}

Header *acquire(size_t capacity) {
    void *const memory = ::operator new(capacity + cache_line, alignment_of(capacity));
#ifdef __linux__
    if (alignment_of(capacity) == std::align_val_t(huge_page))
        (void)madvise(memory, capacity + cache_line, MADV_HUGEPAGE); // a wish: it may be refused
#endif
    auto *const block = static_cast<Header *>(memory);
    block->capacity = capacity;
    return block;
}

void release(Header *block) {
    ::operator delete(block, alignment_of(block->capacity));
}

struct Kept {
    std::vector<Header *> blocks;
    int holders = 0;
    size_t owed = 0; // bytes that were asked for and are not made way for yet

    void clear() {
        std::ranges::for_each(blocks, release);
        blocks.clear();
        owed = 0;
    }
    // The smallest block that will do; nullptr if none will, and then others make way, none before
    // requests add up to its size.
    Header *take(size_t bytes) {
        auto best = blocks.end();
        for (auto block = blocks.begin(); block != blocks.end(); ++block)
            if ((*block)->capacity >= bytes && (*block)->capacity <= 2 * bytes &&
                (best == blocks.end() || (*block)->capacity < (*best)->capacity))
                best = block;
        if (best == blocks.end()) {
            owed += bytes;
            auto oldest = blocks.begin();
            for (; oldest != blocks.end() && owed >= (*oldest)->capacity; ++oldest) {
                owed -= (*oldest)->capacity;
                release(*oldest);
            }
            blocks.erase(blocks.begin(), oldest);
            if (blocks.empty())
                owed = 0;
            return nullptr;
        }
        Header *const found = *best;
        blocks.erase(best);
        return found;
    }
};

Kept &kept() {
    static thread_local Kept of_thread;
    return of_thread;
}

// Up to an eighth more, so that images of nearly equal size share their blocks.
size_t rounded(size_t bytes) {
    const size_t step = std::max<size_t>(std::bit_floor(bytes) / 8, 1);
    return (bytes + step - 1) / step * step;
}

} // namespace

KeptMemory::KeptMemory() {
    ++kept().holders;
}

KeptMemory::~KeptMemory() {
    if (--kept().holders == 0)
        kept().clear();
}

void *take_memory(size_t bytes) {
    const bool keep = bytes >= large && kept().holders > 0;
    Header *block = keep ? kept().take(bytes) : nullptr;
    if (!block)
        block = acquire(keep ? rounded(bytes) : bytes);
    return reinterpret_cast<std::byte *>(block) + cache_line;
}

void give_memory(void *memory) {
    auto *block = reinterpret_cast<Header *>(static_cast<std::byte *>(memory) - cache_line);
    if (block->capacity >= large && kept().holders > 0) {
        try {
            kept().blocks.push_back(block);
            return;
        } catch (const std::bad_alloc &) { // then it is given back at once
        }
    }
    release(block);
}

} // namespace wfpsf
