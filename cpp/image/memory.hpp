// SPDX-License-Identifier: GPL-3.0-or-later
// Memory of planes: aligned, not cleared by itself, and kept from one image to the next on request.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>

namespace wfpsf {

// While one lives, large blocks that its thread gives back wait for the thread's next requests:
// when image after image is made, touching fresh pages would cost as much as the sums. What waits
// was in use before, and makes way when a request is larger; so the peak hardly grows.
class KeptMemory {
  public:
    KeptMemory();
    ~KeptMemory();
    KeptMemory(const KeptMemory &) = delete;
    KeptMemory &operator=(const KeptMemory &) = delete;
};

void *take_memory(size_t bytes);
void give_memory(void *memory);

// Wide vector instructions are slow where they straddle two lines of the cache.
inline constexpr size_t cache_line = 64;
template <class T> struct AlignedAllocator {
    using value_type = T;
    AlignedAllocator() = default;
    template <class U> AlignedAllocator(const AlignedAllocator<U> &) {}
    T *allocate(size_t n) {
        if (n > static_cast<size_t>(-1) / (2 * sizeof(T)))
            throw std::bad_alloc();
        return static_cast<T *>(take_memory(n * sizeof(T)));
    }
    void deallocate(T *memory, size_t) { give_memory(memory); }
    // Elements without a value are left as they are.
    void construct(T *) { static_assert(std::is_trivially_copyable_v<T>); }
    template <class... Value> void construct(T *at, Value &&...value) {
        ::new (static_cast<void *>(at)) T(static_cast<Value &&>(value)...);
    }
    bool operator==(const AlignedAllocator &) const { return true; }
};

} // namespace wfpsf
