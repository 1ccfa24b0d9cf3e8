// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/resample.hpp"

#include "numerics/chebyshev.hpp"
#include "numerics/dispatch.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
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

// Some columns of a grid, which is a block wide at least: a row of sums along y at a time, sorted for
// the sums along x.
class Columns {
  public:
    Columns(View<const double> in, int64_t begin, int64_t end, int64_t step)
        // Whole cache lines, where the grid's rows are such.
        : in_(in), step_(step), origin_(std::min(begin / 8 * 8, in.nx - block)),
          count_(end - origin_),
          inside_(std::min(blocks_for(count_), (in.nx - origin_) / block * block)),
          run_((count_ + step - 1) / step), line_(step == 1 ? 0 : length(), 1) {}

    // Of a sorted row. A block may read beyond the samples: zeros, or another remainder's.
    int64_t length() const { return blocks_for(run_ * step_) + block; }
    // Where a sorted row holds an input.
    int64_t at(int64_t input) const {
        return (input - origin_) % step_ * run_ + (input - origin_) / step_;
    }
    void sum(const Sums &y, int64_t j, double *sorted) {
        double *const line = step_ == 1 ? sorted : line_.view().data;
        const double *const rows = in_.row(y.first_of(j)) + origin_;
        sum_blocks(y.weights_of(j), y.taps, &rows, 1, in_.stride_y, inside_, line);
        if (inside_ < count_) {
            const int64_t last = in_.nx - origin_ - block;
            const double *const there = rows + last;
            sum_blocks(y.weights_of(j), y.taps, &there, 1, in_.stride_y, block, line + last);
        }
        if (step_ > 1)
            sort_by_remainder(line, step_, run_, sorted);
    }

  private:
    View<const double> in_;
    int64_t step_, origin_, count_, inside_, run_;
    Plane<double> line_;
};

// The sums along x of one such row after another.
class SumsAlongX {
  public:
    SumsAlongX(const Sums &x, const Columns &columns)
        : x_(x), phases_(std::min(x.phases, x.count)), sums_(blocks_for(x.count), 1) {
        for (int64_t phase = 0; phase < phases_; ++phase)
            for (int64_t remainder = 0; remainder < x.step; ++remainder)
                at_.push_back(columns.at(x.first_of(phase) + remainder));
        starts_.resize(static_cast<size_t>(x.step));
    }
    template <class T> void sum(const double *sorted, double scale, T *out, int64_t stride) {
        double *const sums = sums_.view().data;
        auto at = at_.begin();
        for (int64_t phase = 0; phase < phases_; ++phase) {
            for (const double *&start : starts_)
                start = sorted + *at++;
            const int64_t count = (x_.count - phase + x_.phases - 1) / x_.phases;
            sum_blocks(x_.weights_of(phase), x_.taps, starts_.data(), x_.step, 1, count, sums);
            T *pixel = out + phase * stride;
            for (int64_t i = 0; i < count; ++i, pixel += stride * x_.phases)
                *pixel = static_cast<T>(scale * sums[i]);
        }
    }

  private:
    const Sums &x_;
    int64_t phases_;
    std::vector<int64_t> at_; // [phase * step + remainder]
    std::vector<const double *> starts_;
    Plane<double> sums_;
};

Columns columns_of(View<const double> in, const Sums &x) {
    return {in, x.inputs_begin(), x.first_of(x.count - 1) + x.taps, x.step};
}

template <class T>
void sum_both_axes(View<const double> in, const Sums &x, const Sums &y, double scale, View<T> out) {
    Columns columns = columns_of(in, x);
    Plane<double> sorted(columns.length(), 1);
    SumsAlongX along_x(x, columns);
    for (int64_t j = 0; j < y.count; ++j) {
        columns.sum(y, j, sorted.view().data);
        along_x.sum(sorted.view().data, scale, out.row(j), out.stride_x);
    }
}

// What a grid narrower than a block is made.
Plane<double> beside_zeros(View<const double> in) {
    Plane<double> wide(block, in.ny);
    for (int64_t j = 0; j < in.ny; ++j)
        std::copy_n(in.row(j), in.nx, wide.view().row(j));
    return wide;
}

template <class T>
void sum_both_axes_of_any(View<const double> in, const Sums &x, const Sums &y, double scale,
                          View<T> out) {
    if (in.nx >= block)
        return sum_both_axes(in, x, y, scale, out);
    const Plane<double> wide = beside_zeros(in);
    sum_both_axes(wide.view(), x, y, scale, out);
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

struct ShiftedImage::Tables {
    Plane<double> wide; // of a grid narrower than a block
    View<const double> grid;
    int64_t half;           // of the outputs
    std::vector<Sums> sums; // by degree
    // Those along y of one degree.
    int b = -1;
    int64_t half_of_rows = -1;
    std::optional<Columns> columns;
    Plane<double> rows;

    Sums part(int degree, int64_t of) const {
        Sums part = sums[static_cast<size_t>(degree)];
        part.begin = half - of;
        part.count = 2 * of + 1;
        return part;
    }
};

ShiftedImage::ShiftedImage(View<const double> grid, const BandlimitedInterpolator &interpolator,
                           int64_t numerator, int64_t denominator, int64_t half)
    : tables_(std::make_unique<Tables>()) {
    tables_->grid = grid;
    tables_->half = half;
    if (grid.nx < block) {
        tables_->wide = beside_zeros(grid);
        tables_->grid = std::as_const(tables_->wide).view();
    }
    constexpr int nodes = largest_degree + 4;
    const double step = static_cast<double>(numerator) / static_cast<double>(denominator);
    const int64_t middle = grid.nx / 2;
    std::vector<double> shift;
    std::vector<Sums> at;
    for (int k = 0; k < nodes; ++k) {
        shift.push_back(std::cos(std::numbers::pi * (k + 0.5) / nodes));
        at.push_back(interpolating_sums(
            interpolator,
            {static_cast<double>(middle) - (static_cast<double>(half) + shift.back() / 2) * step, 0,
             2 * half + 1, numerator, denominator}));
    }
    // Places move back as the shift grows: the first are those of the first node.
    Sums none = at[0];
    const auto phases = static_cast<size_t>(std::min(none.phases, none.count));
    for (size_t phase = 0; phase < phases; ++phase)
        none.taps =
            std::max(none.taps, at.back().first[phase] - at[0].first[phase] + interpolator.taps());
    none.weights.assign(static_cast<size_t>(none.phases * none.taps), 0.0);
    tables_->sums.assign(largest_degree + 1, none);
    for (size_t k = 0; k < at.size(); ++k) {
        const auto basis = chebyshev(shift[k], largest_degree);
        for (size_t phase = 0; phase < phases; ++phase) {
            const double *const weights = &at[k].weights[phase * static_cast<size_t>(at[k].taps)];
            const size_t begin = phase * static_cast<size_t>(none.taps) +
                                 static_cast<size_t>(at[k].first[phase] - none.first[phase]);
            for (size_t a = 0; a <= largest_degree; ++a)
                for (size_t tap = 0; tap < static_cast<size_t>(at[k].taps); ++tap)
                    tables_->sums[a].weights[begin + tap] +=
                        (a == 0 ? 1.0 : 2.0) / nodes * basis[a] * weights[tap];
        }
    }
}

ShiftedImage::~ShiftedImage() = default;

Plane<double> ShiftedImage::coefficients(int a, int b, int64_t half) {
    Tables &t = *tables_;
    if (b != t.b || half > t.half_of_rows) {
        t.b = b;
        t.half_of_rows = half;
        t.columns.emplace(columns_of(t.grid, t.part(0, half)));
        const Sums y = t.part(b, half);
        if (t.columns->length() > t.rows.nx() || y.count > t.rows.ny())
            t.rows = Plane<double>(t.columns->length(), y.count);
        for (int64_t j = 0; j < y.count; ++j)
            t.columns->sum(y, j, t.rows.view().row(j));
    }
    const Sums x = t.part(a, half);
    SumsAlongX along_x(x, *t.columns);
    auto out = Plane<double>::unset(x.count, x.count);
    for (int64_t j = 0; j < x.count; ++j)
        along_x.sum(t.rows.view().row(t.half_of_rows - half + j), 1, out.view().row(j), 1);
    return out;
}

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
