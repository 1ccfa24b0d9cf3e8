// SPDX-License-Identifier: GPL-3.0-or-later
// What the functions on IPC share, be it one kernel or one per pixel.
#pragma once

#include "detector/ipc_solve.hpp"
#include "funnel.hpp"
#include "handles.hpp"

#include <type_traits>
#include <variant>

namespace wfpsf {

KernelOptions kernel_options(const wfpsf_options *options);
Edge checked_edge(int32_t edge);
SolveLimits solve_limits(const wfpsf_options *options);

// Into the caller's places, which may be NULL; OK, or the warning that it has not converged.
wfpsf_status report(const Solution &solution, const SolveLimits &limits, double *residual,
                    double *noise_amplification, int64_t *passes, int64_t *not_finite);

int64_t not_finite_in(const wfpsf_image *image);

void copy_record(const wfpsf_image *from, wfpsf_image *to);

// call(from, to) on the pixels of two images of one type.
template <class Call> void with_pixels(const wfpsf_image *in, wfpsf_image *out, Call &&call) {
    std::visit(
        [&](auto from, auto to) {
            if constexpr (std::is_same_v<decltype(from), View<const float>> ==
                          std::is_same_v<decltype(to), View<float>>)
                call(from, to);
            else
                fail(WFPSF_ERROR_TYPE, "out: must have the pixel type of in");
        },
        in->image.pixels(), out->image.pixels());
}

} // namespace wfpsf
