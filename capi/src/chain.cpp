// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/default_chain.hpp"
#include "detector/noise.hpp"
#include "funnel.hpp"
#include "handles.hpp"
#include "image/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>
#include <vector>

using namespace wfpsf;

namespace {

RandomSource random_source(const wfpsf_options *options) {
    return {.seed = static_cast<uint64_t>(option(options, WFPSF_OPTION_SEED)),
            .stream = static_cast<uint32_t>(option(options, WFPSF_OPTION_STREAM)),
            .draw = 0,
            .x0 = static_cast<int64_t>(option(options, WFPSF_OPTION_ORIGIN_X)),
            .y0 = static_cast<int64_t>(option(options, WFPSF_OPTION_ORIGIN_Y))};
}

int threads_of(const wfpsf_options *options) {
    return static_cast<int>(option(options, WFPSF_OPTION_THREADS));
}

} // namespace

wfpsf_status wfpsf_chain_create(wfpsf_chain **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        *out = new wfpsf_chain{};
    });
}

wfpsf_status wfpsf_chain_create_default(const wfpsf_instrument *instrument, double exposure_time,
                                        wfpsf_chain **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        const Instrument &i = instrument->instrument;
        const double time = std::isnan(exposure_time) ? i.constant("exptime").value : exposure_time;
        require_finite(time, "exposure_time");
        if (!(time > 0))
            fail(WFPSF_ERROR_RANGE, "exposure_time = %g: must be > 0", time);
        *out = new wfpsf_chain{default_chain(i, time)};
    });
}

void wfpsf_chain_destroy(wfpsf_chain *chain) {
    delete chain;
}

wfpsf_status wfpsf_chain_add(wfpsf_chain *chain, int32_t step, int64_t count,
                             const double *parameters) {
    return guarded([&] {
        require_pointer(chain, "chain");
        chain->chain.add(static_cast<StepKind>(step),
                         array_of(count, parameters, "count", "parameters"));
    });
}

wfpsf_status wfpsf_chain_add_ipc(wfpsf_chain *chain, const wfpsf_ipc_kernel *kernel, int32_t edge) {
    return guarded([&] {
        require_pointer(chain, "chain");
        require_pointer(kernel, "kernel");
        chain->chain.add_ipc(kernel->kernel, static_cast<Edge>(edge));
    });
}

wfpsf_status wfpsf_chain_add_varying_ipc(wfpsf_chain *chain, const wfpsf_varying_ipc *varying,
                                         int32_t form, int32_t edge) {
    return guarded([&] {
        require_pointer(chain, "chain");
        require_pointer(varying, "varying");
        if (form != WFPSF_IPC_SCATTER && form != WFPSF_IPC_GATHER)
            fail(WFPSF_ERROR_ARGUMENT, "form = %d: must be WFPSF_IPC_SCATTER or _GATHER", form);
        chain->chain.add_ipc(varying->ipc, static_cast<IpcForm>(form), static_cast<Edge>(edge));
    });
}

wfpsf_status wfpsf_chain_add_map(wfpsf_chain *chain, int32_t step, int64_t count,
                                 const double *parameters, const wfpsf_image *map) {
    return guarded([&] {
        require_pointer(chain, "chain");
        require_pointer(map, "map");
        chain->chain.add_map(static_cast<StepKind>(step),
                             array_of(count, parameters, "count", "parameters"), map->image);
    });
}

wfpsf_status wfpsf_chain_step(const wfpsf_chain *chain, int64_t index, int64_t capacity,
                              double *parameters, int64_t *count, int32_t *step) {
    return guarded([&] {
        require_pointer(chain, "chain");
        require_pointer(step, "step");
        if (index < 0)
            fail(WFPSF_ERROR_RANGE, "index = %lld: must be >= 0", static_cast<long long>(index));
        const auto room = array_of(capacity, parameters, "capacity", "parameters");
        const auto steps = chain->chain.steps();
        const bool there = index < std::ssize(steps);
        const std::vector<double> none;
        const auto &numbers = there ? steps[static_cast<size_t>(index)].parameters : none;
        std::copy_n(numbers.begin(), std::min(room.size(), numbers.size()), room.begin());
        if (count)
            *count = std::ssize(numbers);
        *step = there ? static_cast<int32_t>(steps[static_cast<size_t>(index)].kind) : 0;
    });
}

const char *wfpsf_step_name(int32_t step) {
    return step_name(static_cast<StepKind>(step));
}

wfpsf_status wfpsf_chain_apply(const wfpsf_chain *chain, wfpsf_image *image, int64_t previous_count,
                               const wfpsf_image *const *previous, const wfpsf_options *options,
                               int64_t *not_finite, int64_t *saturated) {
    return guarded([&] {
        require_pointer(chain, "chain");
        require_pointer(image, "image");
        std::vector<PreviousImage> before;
        for (const wfpsf_image *exposure :
             array_of(previous_count, previous, "previous_count", "previous")) {
            require_pointer(exposure, "previous[]");
            const size_t k = before.size();
            before.push_back(exposure->image.pixels());
            std::visit(
                [&](const auto &a, const auto &b) {
                    if (shares_memory(a, b))
                        fail(WFPSF_ERROR_OVERLAP, "previous[%zu] shares memory with image", k);
                },
                before.back(), image->image.pixels());
        }
        const ChainCounts counts =
            chain->chain.run({.random = random_source(options),
                              .with_noise = flag(options, WFPSF_OPTION_NOISE),
                              .previous = before,
                              .force = flag(options, WFPSF_OPTION_FORCE),
                              .threads = threads_of(options)},
                             image->image);
        if (not_finite)
            *not_finite = counts.not_finite;
        if (saturated)
            *saturated = counts.saturated;
    });
}

wfpsf_status wfpsf_noise_add(wfpsf_image *image, double rms, const wfpsf_ipc_kernel *kernel,
                             const wfpsf_options *options) {
    return guarded([&] {
        require_pointer(image, "image");
        require_finite(rms, "rms");
        if (rms < 0)
            fail(WFPSF_ERROR_RANGE, "rms = %g: must be >= 0", rms);
        std::visit(
            [&](auto pixels) {
                add_noise(rms, kernel ? &kernel->kernel : nullptr, random_source(options),
                          threads_of(options), pixels);
            },
            image->image.pixels());
    });
}
