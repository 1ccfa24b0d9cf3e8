// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/chain.hpp"

#include "detector/effects.hpp"
#include "error/error.hpp"
#include "numerics/bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace wfpsf {

namespace {

constexpr size_t any_count = std::numeric_limits<size_t>::max();

enum class Takes { numbers, kernel, map };

struct Description {
    StepKind kind;
    Effect effect;
    const char *name;
    Takes takes;
    unsigned positive; // bit i: parameter i must be > 0
    size_t parameters; // or any_count: at least one
};

constexpr Description descriptions[] = {
    {StepKind::clip_negative, Effect::none, "clip_negative", Takes::numbers, 0, 0},
    {StepKind::charge_diffusion, Effect::charge_diffusion, "charge_diffusion", Takes::numbers, 1,
     1},
    {StepKind::background, Effect::background, "background", Takes::numbers, 0, 1},
    {StepKind::poisson_noise, Effect::poisson_noise, "poisson_noise", Takes::numbers, 0, 0},
    {StepKind::quantisation, Effect::none, "quantisation", Takes::numbers, 1, 1},
    {StepKind::reciprocity_failure, Effect::reciprocity_failure, "reciprocity_failure",
     Takes::numbers, 0b110, 3},
    {StepKind::dark_current, Effect::dark_current, "dark_current", Takes::numbers, 0b10, 2},
    {StepKind::dark_current_map, Effect::dark_current, "dark_current_map", Takes::map, 1, 1},
    {StepKind::persistence_linear, Effect::persistence, "persistence_linear", Takes::numbers, 0,
     any_count},
    {StepKind::persistence_fermi, Effect::persistence, "persistence_fermi", Takes::numbers,
     0b1100110, 7},
    {StepKind::nonlinearity, Effect::nonlinearity, "nonlinearity", Takes::numbers, 0, any_count},
    {StepKind::nonlinearity_inverse, Effect::nonlinearity_correction, "nonlinearity_inverse",
     Takes::numbers, 0, any_count},
    {StepKind::capacitance_map, Effect::capacitance, "capacitance_map", Takes::map, 0, 0},
    {StepKind::ipc, Effect::ipc, "ipc", Takes::kernel, 0, 0},
    {StepKind::read_noise, Effect::read_noise, "read_noise", Takes::numbers, 1, 1},
    {StepKind::saturation, Effect::none, "saturation", Takes::numbers, 1, 1},
    {StepKind::gain, Effect::gain, "gain", Takes::numbers, 1, 1},
    {StepKind::pixel_mask, Effect::none, "pixel_mask", Takes::map, 0, 2},
};

const Description &describe(StepKind kind) {
    for (const Description &d : descriptions)
        if (d.kind == kind)
            return d;
    fail(WFPSF_ERROR_ARGUMENT, "step = %d: must be one of WFPSF_STEP_*", static_cast<int>(kind));
}

void check(const Description &d, Takes takes, std::span<const double> parameters) {
    if (d.takes != takes)
        fail(WFPSF_ERROR_ARGUMENT, "step = %s: takes %s", d.name,
             d.takes == Takes::kernel ? "a kernel"
             : d.takes == Takes::map  ? "a map"
                                      : "numbers alone");
    const bool fits =
        d.parameters == any_count ? !parameters.empty() : parameters.size() == d.parameters;
    if (!fits)
        fail(WFPSF_ERROR_SIZE, "count = %zu: %s takes %s%zu numbers", parameters.size(), d.name,
             d.parameters == any_count ? "at least " : "",
             d.parameters == any_count ? 1 : d.parameters);
    for (size_t i = 0; i < parameters.size(); ++i) {
        if (!std::isfinite(parameters[i]))
            fail(WFPSF_ERROR_NOT_FINITE, "parameters[%zu] = %g: %s takes finite numbers", i,
                 parameters[i], d.name);
        if (i < 8 && (d.positive >> i & 1) != 0 && !(parameters[i] > 0))
            fail(WFPSF_ERROR_RANGE, "parameters[%zu] = %g: must be > 0 for %s", i, parameters[i],
                 d.name);
    }
}

// The discrete Gaussian exp(-t) I_n(t), t = sigma^2, of an axis: positive taps of sum 1 and
// variance sigma^2 exactly, and two in a row are one of the sum of their variances.
std::vector<double> discrete_gaussian(double sigma) {
    const double t = sigma * sigma;
    std::vector<double> half;
    for (int n = 0; n <= 500; ++n) {
        half.push_back(std::exp(-t) * std::cyl_bessel_i(static_cast<double>(n), t));
        if (half.back() < 1e-17)
            break;
    }
    std::vector<double> taps(half.rbegin(), half.rend());
    taps.insert(taps.end(), half.begin() + 1, half.end());
    return taps;
}

IpcKernel diffusion_kernel(double sigma) {
    constexpr double widest = 20; // pixels: I_n and exp stay far from overflow
    if (sigma > widest)
        fail(WFPSF_ERROR_RANGE, "parameters[0] = %g: charge_diffusion takes at most %g pixels",
             sigma, widest);
    const std::vector<double> along = discrete_gaussian(sigma);
    const auto n = static_cast<int64_t>(along.size());
    Plane<double> taps(n, n);
    for (int64_t y = 0; y < n; ++y)
        for (int64_t x = 0; x < n; ++x)
            taps(x, y) = along[static_cast<size_t>(x)] * along[static_cast<size_t>(y)];
    return IpcKernel::from_table(std::as_const(taps).view(), {.normalise = true});
}

bool is_pixelwise(const Step &step) {
    return !step.kernel && !step.varying;
}

// A block of a row on its way through the steps of one pass.
struct Block {
    int64_t x, y;
    std::span<double> pixels;
    std::span<double> scratch; // as long
};

class PixelSteps {
  public:
    PixelSteps(const ChainRun &how, std::span<const Step> steps, uint32_t first_draw)
        : how_(how), steps_(steps), first_draw_(first_draw) {}

    // Returns the count of saturated pixels.
    int64_t run(const Block &block) const {
        int64_t saturated = 0;
        RandomSource random = how_.random;
        random.draw = first_draw_;
        for (const Step &step : steps_) {
            saturated += run(step, random, block);
            ++random.draw;
        }
        return saturated;
    }

  private:
    int64_t run(const Step &step, const RandomSource &random, const Block &block) const {
        const std::span<double> row = block.pixels;
        const std::vector<double> &p = step.parameters;
        const double first = p.empty() ? 0 : p[0]; // no pixel can alias it
        switch (step.kind) {
        case StepKind::clip_negative:
            for (double &pixel : row)
                pixel = pixel < 0 ? 0 : pixel;
            break;
        case StepKind::background:
            for (double &pixel : row)
                pixel += first;
            break;
        case StepKind::poisson_noise:
            if (how_.with_noise)
                poisson(random, block, row);
            break;
        case StepKind::quantisation:
            quantize(p[0], row);
            break;
        case StepKind::reciprocity_failure:
            reciprocity_failure(p[0], p[1], p[2], row);
            break;
        case StepKind::dark_current:
            std::ranges::fill(block.scratch, p[0] * p[1]);
            add_dark(random, block);
            break;
        case StepKind::dark_current_map:
            for (size_t i = 0; i < row.size(); ++i)
                block.scratch[i] = p[0] * at(step.map, block, i);
            add_dark(random, block);
            break;
        case StepKind::persistence_linear:
            for (size_t k = 0; k < std::min(p.size(), how_.previous.size()); ++k)
                add_previous(k, block, [&](double level) { return p[k] * level; });
            break;
        case StepKind::persistence_fermi: {
            const double time = p[6];
            for (size_t k = 0; k < how_.previous.size(); ++k) {
                const FermiPersistence model({p[0], p[1], p[2], p[3], p[4], p[5]},
                                             (static_cast<double>(k) + 0.5) * time);
                add_previous(k, block, [&](double level) { return model.rate(level) * time; });
            }
            break;
        }
        case StepKind::nonlinearity:
            nonlinearity(p, row);
            break;
        case StepKind::nonlinearity_inverse:
            nonlinearity_inverse(p, row);
            break;
        case StepKind::capacitance_map:
            for (size_t i = 0; i < row.size(); ++i)
                row[i] /= at(step.map, block, i);
            break;
        case StepKind::read_noise:
            if (how_.with_noise) {
                fill_normal(random, block.x, block.y, std::ssize(row), block.scratch.data());
                for (size_t i = 0; i < row.size(); ++i)
                    row[i] += first * block.scratch[i];
            }
            break;
        case StepKind::saturation:
            return saturate(p[0], row);
        case StepKind::gain:
            for (double &pixel : row)
                pixel /= first;
            break;
        case StepKind::pixel_mask:
            for (size_t i = 0; i < row.size(); ++i) {
                const double mark = at(step.map, block, i);
                row[i] = mark == 1 ? p[0] : mark == 2 ? p[1] : row[i];
            }
            break;
        case StepKind::ipc:
        case StepKind::charge_diffusion:
            break; // not here: they meet neighbours
        }
        return 0;
    }

    static double at(const Plane<float> &map, const Block &block, size_t i) {
        return map(block.x + static_cast<int64_t>(i), block.y);
    }

    static void poisson(const RandomSource &random, const Block &block, std::span<double> means) {
        draw_poisson(random, block.x, block.y, std::ssize(means), means.data());
    }

    void add_dark(const RandomSource &random, const Block &block) const {
        if (how_.with_noise)
            poisson(random, block, block.scratch);
        for (size_t i = 0; i < block.pixels.size(); ++i)
            block.pixels[i] += block.scratch[i];
    }

    template <class Left>
    void add_previous(size_t k, const Block &block, const Left &left_behind) const {
        std::visit(
            [&](const auto &pixels) {
                for (size_t i = 0; i < block.pixels.size(); ++i)
                    block.pixels[i] += left_behind(
                        static_cast<double>(pixels(block.x + static_cast<int64_t>(i), block.y)));
            },
            how_.previous[k]);
    }

    const ChainRun &how_;
    std::span<const Step> steps_;
    uint32_t first_draw_;
};

constexpr int64_t block_size = 512;

template <class From, class To>
void convert(const From *from, int64_t from_stride, size_t n, To *__restrict to,
             int64_t to_stride) {
    if (from_stride == 1 && to_stride == 1)
        for (size_t i = 0; i < n; ++i)
            to[i] = static_cast<To>(from[i]);
    else
        for (int64_t i = 0; i < static_cast<int64_t>(n); ++i)
            to[i * to_stride] = static_cast<To>(from[i * from_stride]);
}

// Runs steps over all pixels, in bands of rows. `run` returns how many it saturated; those that are
// not finite are counted if that is asked for.
template <class T, class Run>
ChainCounts for_each_block(View<T> image, int threads, bool counts_not_finite, const Run &run) {
    const int64_t bands = std::clamp<int64_t>(threads, 1, image.ny);
    std::vector<ChainCounts> counts(static_cast<size_t>(bands));
    for_each_band(bands, [&](int64_t band) {
        std::array<double, block_size> pixels, scratch;
        ChainCounts count;
        for (int64_t y = image.ny * band / bands; y < image.ny * (band + 1) / bands; ++y)
            for (int64_t x = 0; x < image.nx; x += block_size) {
                const int64_t n = std::min(block_size, image.nx - x);
                const auto size = static_cast<size_t>(n);
                T *first = &image(x, y);
                convert(first, image.stride_x, size, pixels.data(), 1);
                count.saturated +=
                    run(Block{x, y, std::span(pixels).first(size), std::span(scratch).first(size)});
                convert(pixels.data(), 1, size, first, image.stride_x);
                if (counts_not_finite)
                    count.not_finite +=
                        count_not_finite(View<const T>{first, n, 1, image.stride_x, 0});
            }
        counts[static_cast<size_t>(band)] = count;
    });
    ChainCounts total;
    for (const ChainCounts &count : counts) {
        total.not_finite += count.not_finite;
        total.saturated += count.saturated;
    }
    return total;
}

template <class T>
ChainCounts run_steps(std::span<const Step> steps, const ChainRun &how, View<T> image) {
    ChainCounts counts;
    if (image.empty())
        return counts;
    for (size_t next = 0; next < steps.size();) {
        if (!is_pixelwise(steps[next])) {
            const Step &step = steps[next];
            if (step.varying)
                convolve(*step.varying, View<const T>(image),
                         {.form = step.form, .edge = step.edge, .threads = how.threads}, image);
            else
                convolve(*step.kernel, image, {.edge = step.edge, .threads = how.threads}, image);
            ++next;
            continue;
        }
        size_t end = next;
        while (end < steps.size() && is_pixelwise(steps[end]))
            ++end;
        const PixelSteps together(how, steps.subspan(next, end - next),
                                  static_cast<uint32_t>(next));
        const bool is_last = end == steps.size();
        const ChainCounts found = for_each_block(
            image, how.threads, is_last, [&](const Block &block) { return together.run(block); });
        counts.saturated += found.saturated;
        counts.not_finite = found.not_finite;
        next = end;
    }
    if (steps.empty() || !is_pixelwise(steps.back()))
        counts.not_finite = count_not_finite(image);
    return counts;
}

void require_size(const char *what, int64_t nx, int64_t ny, const Image &image) {
    if (nx != image.nx() || ny != image.ny())
        fail(WFPSF_ERROR_SIZE, "%s has %lld x %lld pixels: the image has %lld x %lld", what,
             static_cast<long long>(nx), static_cast<long long>(ny),
             static_cast<long long>(image.nx()), static_cast<long long>(image.ny()));
}

} // namespace

const char *step_name(StepKind kind) noexcept {
    for (const Description &d : descriptions)
        if (d.kind == kind)
            return d.name;
    return nullptr;
}

Effect effect_of(StepKind kind) {
    return describe(kind).effect;
}

void Chain::append(Step step) {
    const Description &d = describe(step.kind);
    if (steps_.size() == most_steps)
        fail(WFPSF_ERROR_SIZE, "a chain has at most %zu steps", most_steps);
    for (const Step &before : steps_)
        if (d.effect != Effect::none && effect_of(before.kind) == d.effect)
            fail(WFPSF_ERROR_ALREADY_APPLIED, "step = %s: the chain has %s already", d.name,
                 effect_name(d.effect));
    steps_.push_back(std::move(step));
}

void Chain::add(StepKind kind, std::span<const double> parameters) {
    check(describe(kind), Takes::numbers, parameters);
    Step step{.kind = kind, .parameters = {parameters.begin(), parameters.end()}};
    if (kind == StepKind::charge_diffusion)
        step.kernel = diffusion_kernel(parameters[0]);
    append(std::move(step));
}

namespace {

void require_edge(Edge edge) {
    if (edge < Edge::zero || edge > Edge::crop)
        fail(WFPSF_ERROR_ARGUMENT, "edge = %d: must be zero, replicate, wrap or crop, %d..%d",
             static_cast<int>(edge), static_cast<int>(Edge::zero), static_cast<int>(Edge::crop));
}

} // namespace

void Chain::add_ipc(const IpcKernel &kernel, Edge edge) {
    require_edge(edge);
    Step step{.kind = StepKind::ipc};
    step.kernel = kernel;
    step.edge = edge;
    append(std::move(step));
}

void Chain::add_ipc(std::shared_ptr<const VaryingIpc> ipc, IpcForm form, Edge edge) {
    require_edge(edge);
    Step step{.kind = StepKind::ipc};
    step.varying = std::move(ipc);
    step.form = form;
    step.edge = edge;
    append(std::move(step));
}

void Chain::add_map(StepKind kind, std::span<const double> parameters, const Image &map) {
    check(describe(kind), Takes::map, parameters);
    Step step{.kind = kind, .parameters = {parameters.begin(), parameters.end()}};
    step.map = {map.nx(), map.ny()};
    std::visit(
        [&](const auto &pixels) {
            for (int64_t y = 0; y < pixels.ny; ++y)
                for (int64_t x = 0; x < pixels.nx; ++x)
                    step.map(x, y) = static_cast<float>(pixels(x, y));
        },
        map.pixels());
    append(std::move(step));
}

ChainCounts Chain::run(const ChainRun &how, Image &image) const {
    if (image.oversampling() != 1)
        fail(WFPSF_ERROR_ARGUMENT,
             "image: oversampling = %d: a chain acts on native pixels, oversampling 1",
             image.oversampling());
    for (const Step &step : steps_) {
        const Effect effect = effect_of(step.kind);
        if (effect != Effect::none)
            image.require_not_applied(effect, how.force);
        if (describe(step.kind).takes == Takes::map)
            require_size("a map of the chain", step.map.nx(), step.map.ny(), image);
        if (step.varying)
            require_size("varying IPC of the chain", step.varying->nx(), step.varying->ny(), image);
    }
    for (const PreviousImage &previous : how.previous)
        std::visit(
            [&](const auto &pixels) {
                require_size("a previous image", pixels.nx, pixels.ny, image);
            },
            previous);
    const ChainCounts counts =
        std::visit([&](auto pixels) { return run_steps(steps(), how, pixels); }, image.pixels());
    for (const Step &step : steps_)
        image.record_applied(effect_of(step.kind));
    return counts;
}

} // namespace wfpsf
