// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/memory.hpp"

#include <algorithm>
#include <bit>
#include <vector>

namespace wfpsf {

namespace {

constexpr size_t large = size_t{1} << 16;

// Stands before each block, a cache line long.
struct Header {
    size_t capacity;
};

void release(Header *block) {
    ::operator delete(block, std::align_val_t(cache_line));
}

struct Kept {
    std::vector<Header *> blocks;
    int holders = 0;

    void clear() {
        std::ranges::for_each(blocks, release);
        blocks.clear();
    }
    // The smallest block that will do; nullptr if none will, and then they make way.
    Header *take(size_t bytes) {
        auto best = blocks.end();
        for (auto block = blocks.begin(); block != blocks.end(); ++block)
            if ((*block)->capacity >= bytes && (*block)->capacity <= 2 * bytes &&
                (best == blocks.end() || (*block)->capacity < (*best)->capacity))
                best = block;
        if (best == blocks.end()) {
            clear();
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
    if (!block) {
        const size_t capacity = keep ? rounded(bytes) : bytes;
        block = static_cast<Header *>(
            ::operator new(capacity + cache_line, std::align_val_t(cache_line)));
        block->capacity = capacity;
    }
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
