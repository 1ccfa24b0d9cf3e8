// SPDX-License-Identifier: GPL-3.0-or-later
#include "ipc_parts.hpp"

#include "detector/effects.hpp"

#include <cstdio>

namespace wfpsf {

KernelOptions kernel_options(const wfpsf_options *options) {
    return {.allow_negative = flag(options, WFPSF_OPTION_KERNEL_NEGATIVE),
            .normalise = flag(options, WFPSF_OPTION_KERNEL_NORMALISE)};
}

Edge checked_edge(int32_t edge) {
    if (edge < WFPSF_EDGE_ZERO || edge > WFPSF_EDGE_VALID)
        fail(WFPSF_ERROR_ARGUMENT, "edge = %d: must be one of WFPSF_EDGE_*, %d..%d", edge,
             WFPSF_EDGE_ZERO, WFPSF_EDGE_VALID);
    return static_cast<Edge>(edge);
}

SolveLimits solve_limits(const wfpsf_options *options) {
    return {.least_margin = option(options, WFPSF_OPTION_IPC_LEAST_MARGIN),
            .tolerance = option(options, WFPSF_OPTION_IPC_TOLERANCE),
            .most_passes = static_cast<int64_t>(option(options, WFPSF_OPTION_IPC_MAX_PASSES))};
}

wfpsf_status report(const Solution &solution, const SolveLimits &limits, double *residual,
                    double *noise_amplification, int64_t *passes, int64_t *not_finite) {
    if (residual)
        *residual = solution.residual;
    if (noise_amplification)
        *noise_amplification = solution.noise_amplification;
    if (passes)
        *passes = solution.passes;
    if (not_finite)
        *not_finite = solution.not_finite;
    if (solution.converged)
        return wfpsf_status{WFPSF_OK};
    char line[128];
    std::snprintf(line, sizeof line, "residual = %.3g after %lld passes: IPC_TOLERANCE is %g",
                  solution.residual, static_cast<long long>(solution.passes), limits.tolerance);
    return record_error(WFPSF_WARNING_NOT_CONVERGED, line);
}

int64_t not_finite_in(const wfpsf_image *image) {
    return std::visit([](auto pixels) { return count_not_finite(pixels); }, image->image.pixels());
}

void copy_record(const wfpsf_image *from, wfpsf_image *to) {
    to->image.set_oversampling(from->image.oversampling());
    to->image.set_pixel_scale_arcsec(from->image.pixel_scale_arcsec());
    to->image.set_applied(from->image.applied());
}

} // namespace wfpsf
