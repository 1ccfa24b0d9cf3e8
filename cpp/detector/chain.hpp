// SPDX-License-Identifier: GPL-3.0-or-later
// A detector's effects in a stated order. Runs of steps that act on each pixel by itself share one
// pass over memory; IPC and charge diffusion take one each, in place.
#pragma once

#include "detector/ipc_convolve.hpp"
#include "detector/random.hpp"
#include "detector/varying_ipc.hpp"
#include "image/image.hpp"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace wfpsf {

// The numbers are those of the C API. Parameters in brackets.
enum class StepKind : int32_t {
    clip_negative = 10,         // negative pixels become 0
    charge_diffusion = 20,      // [sigma, native pixels]
    background = 30,            // [electrons]: their mean is added
    poisson_noise = 40,         // each pixel is the mean of its own
    quantisation = 50,          // [unit]
    reciprocity_failure = 60,   // [alpha per decade, exposure time s, base flux e-/s]
    dark_current = 70,          // [e-/s, exposure time s]: Poisson of their product is added
    dark_current_map = 71,      // [exposure time s] and a map in e-/s
    persistence_linear = 80,    // [share of the latest exposure, of that before, ...]
    persistence_fermi = 81,     // [A, x0, dx, a, r, half_well, exposure time s]
    nonlinearity = 90,          // [c2, c3, ...]
    nonlinearity_inverse = 100, // [c2, c3, ...]
    capacitance_map = 110,      // a map that divides: V = Q / C
    ipc = 120,                  // a kernel, or one for each pixel
    read_noise = 130,           // [rms]
    saturation = 140,           // [level]
    gain = 150,                 // [e-/ADU]: divides
    pixel_mask = 160,           // [dead, hot] and a map: 1 is set to dead, 2 to hot, the rest stays
};

struct Step {
    StepKind kind;
    std::vector<double> parameters = {};
    std::optional<IpcKernel> kernel = {};           // of ipc and charge diffusion
    std::shared_ptr<const VaryingIpc> varying = {}; // or of ipc in place of the kernel
    IpcForm form = IpcForm::scatter;                // of the varying one
    Edge edge = Edge::zero;
    Plane<float> map = {};
};

using PreviousImage = Image::ConstPixels;

struct ChainRun {
    RandomSource random = {}; // draw is not used: every step has its own
    bool with_noise = true;   // else means are added, and Poisson and read noise left out
    std::span<const PreviousImage> previous = {}; // exposures before this one, the latest first
    bool force = false;
    int threads = 1;
};

struct ChainCounts {
    int64_t not_finite = 0; // pixels NaN or infinite at the end
    int64_t saturated = 0;
};

class Chain {
  public:
    static constexpr size_t most_steps = 255;

    // Bad parameters: WFPSF_ERROR_RANGE, _NOT_FINITE or _SIZE. An effect that is applied once and
    // is in the chain already: WFPSF_ERROR_ALREADY_APPLIED.
    void add(StepKind kind, std::span<const double> parameters);
    void add_ipc(const IpcKernel &kernel, Edge edge);
    void add_ipc(std::shared_ptr<const VaryingIpc> ipc, IpcForm form, Edge edge);
    void add_map(StepKind kind, std::span<const double> parameters, const Image &map);

    std::span<const Step> steps() const { return steps_; }

    // In place. Nothing is changed if the image records one of the effects, unless forced. The bits
    // depend neither on threads nor, in noise, on the tile of a detector that the image is.
    ChainCounts run(const ChainRun &how, Image &image) const;

  private:
    void append(Step step);

    std::vector<Step> steps_;
};

const char *step_name(StepKind kind) noexcept; // nullptr if there is no such step

// What its application is recorded as; Effect::none if it may be applied again.
Effect effect_of(StepKind kind);

} // namespace wfpsf
