// SPDX-License-Identifier: GPL-3.0-or-later
// Working memory of the size of an image, not initialised. On Linux it asks for huge pages:
// touching a detector's worth of small pages for the first time can cost more than the work on
// them.
#pragma once

#include "image/view.hpp"

#include <cstdlib>
#include <memory>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace wfpsf {

template <class T> class WorkingPlane {
  public:
    WorkingPlane(int64_t nx, int64_t ny) : nx_(nx), ny_(ny) {
        constexpr size_t huge_page = size_t{1} << 21;
        const size_t bytes = static_cast<size_t>(nx) * static_cast<size_t>(ny) * sizeof(T);
        const size_t alignment = bytes >= huge_page ? huge_page : 64;
        const size_t whole = (bytes + alignment) / alignment * alignment;
        memory_.reset(static_cast<T *>(std::aligned_alloc(alignment, whole)));
        if (!memory_)
            throw std::bad_alloc();
#ifdef __linux__
        if (bytes >= huge_page)
            (void)madvise(memory_.get(), whole, MADV_HUGEPAGE); // a wish: it may be refused
#endif
    }
    View<T> view() {
        return {memory_.get(), nx_, ny_, 1, nx_};
    }
    View<const T> view() const {
        return {memory_.get(), nx_, ny_, 1, nx_};
    }

  private:
    struct Free {
        void operator()(T *memory) const { std::free(memory); }
    };

    int64_t nx_, ny_;
    std::unique_ptr<T, Free> memory_;
};

} // namespace wfpsf
