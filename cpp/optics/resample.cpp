// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/resample.hpp"

#include "numerics/dispatch.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace wfpsf {

namespace {

// Sums along one axis: output i = q * phases + r takes weights[r] from input first[r] + q * step
// on. Places that fall on the same fraction of a sample share their weights.
struct Sums {
    int64_t begin, count; // outputs begin..begin+count-1
    int64_t phases, step; // outputs and inputs after which the weights repeat
    int64_t taps;
    std::vector<double> weights; // [phase * taps + tap]
    std::vector<int64_t> first;  // input of tap 0, by phase

    int64_t phase_of(int64_t i) const { return (begin + i) % phases; }
    const double *weights_of(int64_t i) const {
        return &weights[static_cast<size_t>(phase_of(i) * taps)];
    }
    int64_t first_of(int64_t i) const {
        return first[static_cast<size_t>(phase_of(i))] + (begin + i) / phases * step;
    }
    int64_t inputs_begin() const { return first_of(0); }
};

Sums interpolating_sums(const BandlimitedInterpolator &interpolator, const Positions &p) {
    const int64_t common = std::gcd(p.numerator, p.denominator);
    const int64_t phases = p.denominator / common;
    Sums sums{p.first, p.count, phases, p.numerator / common, interpolator.taps(), {}, {}};
    sums.weights.resize(static_cast<size_t>(phases * sums.taps));
    sums.first.resize(static_cast<size_t>(phases));
    for (int64_t r = 0; r < std::min(phases, p.first + p.count); ++r) {
        const double place =
            p.start + static_cast<double>(r * p.numerator) / static_cast<double>(p.denominator);
        sums.first[static_cast<size_t>(r)] =
            interpolator.weights(place, &sums.weights[static_cast<size_t>(r * sums.taps)]);
    }
    return sums;
}

// Samples of a row, sorted by their remainder modulo the step: sample i is at
// (i % step) * run + i / step. Neighbouring outputs then take neighbouring inputs.
template <int64_t step>
[[gnu::always_inline]] inline void sort_by_known(const double *__restrict line, int64_t run,
                                                 double *__restrict sorted) {
    for (int64_t i = 0; i < run; ++i)
        for (int64_t remainder = 0; remainder < step; ++remainder)
            sorted[remainder * run + i] = line[i * step + remainder];
}

WFPSF_VECTORISED void sort_by_remainder(const double *line, int64_t step, int64_t run,
                                        double *sorted) {
    switch (step) { // the usual ones: vector instructions
    case 2:
        return sort_by_known<2>(line, run, sorted);
    case 3:
        return sort_by_known<3>(line, run, sorted);
    case 4:
        return sort_by_known<4>(line, run, sorted);
    case 5:
        return sort_by_known<5>(line, run, sorted);
    case 6:
        return sort_by_known<6>(line, run, sorted);
    default:
        for (int64_t remainder = 0; remainder < step; ++remainder)
            for (int64_t i = 0; i < run; ++i)
                sorted[remainder * run + i] = line[i * step + remainder];
    }
}

// A row of sums along y at a time, then the sums along x. The grid is a block wide at least.
template <class T>
void sum_both_axes(View<const double> in, const Sums &x, const Sums &y, double scale, View<T> out) {
    // Whole cache lines, where the grid's rows are such.
    const int64_t origin = std::min(x.inputs_begin() / 8 * 8, in.nx - block);
    const int64_t columns = x.first_of(x.count - 1) + x.taps - origin;
    const int64_t inside = std::min(blocks_for(columns), (in.nx - origin) / block * block);
    const int64_t step = x.step, run = (columns + step - 1) / step;
    // A block may read beyond the samples: zeros, or another remainder's.
    Plane<double> buffers(blocks_for(std::max(run * step, x.count)) + block, 3);
    double *const sorted = buffers.view().row(0), *const sums = buffers.view().row(1);
    double *const line = step == 1 ? sorted : buffers.view().row(2);
    const int64_t phases = std::min(x.phases, x.count);
    std::vector<const double *> starts; // [phase * step + remainder]
    for (int64_t phase = 0; phase < phases; ++phase)
        for (int64_t remainder = 0; remainder < step; ++remainder) {
            const int64_t input = x.first_of(phase) - origin + remainder;
            starts.push_back(sorted + input % step * run + input / step);
        }
    for (int64_t j = 0; j < y.count; ++j) {
        const double *const rows = in.row(y.first_of(j)) + origin;
        sum_blocks(y.weights_of(j), y.taps, &rows, 1, in.stride_y, inside, line);
        if (inside < columns) {
            const double *const last = rows + in.nx - origin - block;
            sum_blocks(y.weights_of(j), y.taps, &last, 1, in.stride_y, block,
                       line + in.nx - origin - block);
        }
        if (step > 1)
            sort_by_remainder(line, step, run, sorted);
        for (int64_t phase = 0; phase < phases; ++phase) {
            const int64_t count = (x.count - phase + x.phases - 1) / x.phases;
            sum_blocks(x.weights_of(phase), x.taps, &starts[static_cast<size_t>(phase * step)],
                       step, 1, count, sums);
            T *pixel = &out(phase, j);
            for (int64_t i = 0; i < count; ++i, pixel += out.stride_x * x.phases)
                *pixel = static_cast<T>(scale * sums[i]);
        }
    }
}

// A grid narrower than a block gets zeros beside it.
template <class T>
void sum_both_axes_of_any(View<const double> in, const Sums &x, const Sums &y, double scale,
                          View<T> out) {
    if (in.nx >= block)
        return sum_both_axes(in, x, y, scale, out);
    Plane<double> wide(block, in.ny);
    for (int64_t j = 0; j < in.ny; ++j)
        std::copy_n(in.row(j), in.nx, wide.view().row(j));
    sum_both_axes(std::as_const(wide).view(), x, y, scale, out);
}

} // namespace

template <class T>
void resample(View<const double> grid, const BandlimitedInterpolator &interpolator,
              const Positions &x, const Positions &y, double scale, View<T> out) {
    sum_both_axes_of_any(grid, interpolating_sums(interpolator, x),
                         interpolating_sums(interpolator, y), scale, out);
}

template void resample(View<const double>, const BandlimitedInterpolator &, const Positions &,
                       const Positions &, double, View<float>);
template void resample(View<const double>, const BandlimitedInterpolator &, const Positions &,
                       const Positions &, double, View<double>);

Plane<double> filtered(View<const double> grid, const SeparableFilter &filter) {
    const auto shrunk = [](int64_t n, const std::vector<double> &taps) {
        const auto count = static_cast<int64_t>(taps.size());
        return Sums{0, n - count + 1, 1, 1, count, taps, {0}};
    };
    Plane<double> sum;
    for (const SeparableFilter::Term &term : filter.terms) {
        const Sums x = shrunk(grid.nx, term.x), y = shrunk(grid.ny, term.y);
        auto product = Plane<double>::with_aligned_rows(x.count, y.count);
        sum_both_axes_of_any(grid, x, y, 1, product.view());
        if (sum.nx() == 0) {
            sum = std::move(product);
            continue;
        }
        for (int64_t j = 0; j < sum.ny(); ++j)
            for (int64_t i = 0; i < sum.nx(); ++i)
                sum(i, j) += product(i, j);
    }
    return sum;
}

} // namespace wfpsf
