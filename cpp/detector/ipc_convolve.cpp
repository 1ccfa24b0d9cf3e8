// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_convolve.hpp"

#include "detector/ipc_border.hpp"
#include "numerics/bands.hpp"
#include "numerics/dispatch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace wfpsf {

namespace {

struct Tap {
    int64_t dx, dy;
    double value;
};

struct TapList {
    std::vector<Tap> taps; // none of them zero
    int64_t reach_x, reach_y;

    explicit TapList(View<const double> table) : reach_x(table.nx / 2), reach_y(table.ny / 2) {
        for (int64_t y = 0; y < table.ny; ++y)
            for (int64_t x = 0; x < table.nx; ++x)
                if (table(x, y) != 0)
                    taps.push_back({x - reach_x, y - reach_y, table(x, y)});
    }

    // A whole 3 x 3 kernel, or a whole cross?
    bool is_3x3() const {
        return reach_x == 1 && reach_y == 1 &&
               (taps.size() == 9 || (taps.size() == 5 && std::ranges::all_of(taps, [](Tap t) {
                                         return t.dx == 0 || t.dy == 0;
                                     })));
    }

    // Do the neighbours weigh so little that their share may be summed in single precision? It then
    // errs by less than 2^-24 of the largest of them.
    bool is_light() const {
        double weight = 0;
        for (const Tap &tap : taps)
            weight += tap.dx == 0 && tap.dy == 0 ? 0 : std::fabs(tap.value);
        return weight <= 0.125;
    }
};

// Several taps at a time spare loads and stores of the sums; nine are a 3 x 3 kernel in one go.
constexpr size_t most_taps_at_once = 9;

template <size_t... tap>
[[gnu::always_inline]] inline void add_taps(std::index_sequence<tap...>, const double *value,
                                            const double *const *samples, int64_t count, bool anew,
                                            double *__restrict sum) {
    const double v[] = {value[tap]...};
    const double *const s[] = {samples[tap]...};
    if (anew)
        for (int64_t i = 0; i < count; ++i)
            sum[i] = (... + (v[tap] * s[tap][i]));
    else
        for (int64_t i = 0; i < count; ++i)
            sum[i] += (... + (v[tap] * s[tap][i]));
}

template <size_t most = most_taps_at_once>
[[gnu::always_inline]] inline void add_some_taps(size_t taps, const double *value,
                                                 const double *const *samples, int64_t count,
                                                 bool anew, double *sum) {
    if (taps == most)
        add_taps(std::make_index_sequence<most>(), value, samples, count, anew, sum);
    else if constexpr (most > 1)
        add_some_taps<most - 1>(taps, value, samples, count, anew, sum);
}

// sum = or += value[0] samples[0] + value[1] samples[1] + ..., over 1..9 taps.
WFPSF_VECTORISED void sum_taps(size_t taps, const double *value, const double *const *samples,
                               int64_t count, bool anew, double *sum) {
    add_some_taps(taps, value, samples, count, anew, sum);
}

// A 3 x 3 kernel, its centre apart: whole, or a cross when its corners are zero.
template <class S> struct Taps3x3 {
    S neighbours[9]; // the centre's place is left out
    double centre;
    bool cross;
};

// Over several output rows at once, so that samples are loaded once for three rows. Row j - 1 of
// the samples has output row j at its middle. Every sum starts from 0 and takes its terms in the
// same order, however many rows there are: so the bits are the same.
constexpr size_t most_rows_at_once = 4;

template <size_t rows, bool cross, class S, class T>
[[gnu::always_inline]] inline void sum_3x3_any(const Taps3x3<S> &taps, const S *const *samples,
                                               int64_t step, int64_t count, T *const *out) {
    S v[9];
    std::copy_n(taps.neighbours, 9, v);
    const double centre = taps.centre;
    const S *s[rows + 2];
    std::copy_n(samples, rows + 2, s);
    T *to[rows];
    std::copy_n(out, rows, to);
#pragma GCC ivdep
    for (int64_t i = 0; i < count; ++i) {
        S sum[rows] = {};
        double middle_share[rows];
#pragma GCC unroll 6
        for (size_t j = 0; j < rows + 2; ++j) {
            const S left = s[j][i - step], middle = s[j][i], right = s[j][i + step];
#pragma GCC unroll 4
            for (size_t r = 0; r < rows; ++r) {
                if (j < r || j > r + 2)
                    continue;
                const S *k = v + 3 * (2 - (j - r));
                if (j == r + 1)
                    middle_share[r] = centre * static_cast<double>(middle);
                else
                    sum[r] += k[1] * middle;
                if (!cross || j == r + 1) {
                    sum[r] += k[2] * left;
                    sum[r] += k[0] * right;
                }
            }
        }
#pragma GCC unroll 4
        for (size_t r = 0; r < rows; ++r)
            to[r][i] = static_cast<T>(middle_share[r] + static_cast<double>(sum[r]));
    }
}

template <bool cross, class S, class T>
[[gnu::always_inline]] inline void sum_3x3_rows(const Taps3x3<S> &taps, const S *const *samples,
                                                int64_t step, size_t rows, int64_t count,
                                                T *const *out) {
    if (rows == 4)
        sum_3x3_any<4, cross>(taps, samples, step, count, out);
    else if (rows == 3)
        sum_3x3_any<3, cross>(taps, samples, step, count, out);
    else if (rows == 2)
        sum_3x3_any<2, cross>(taps, samples, step, count, out);
    else
        sum_3x3_any<1, cross>(taps, samples, step, count, out);
}

template <class S, class T>
[[gnu::always_inline]] inline void sum_3x3_inline(const Taps3x3<S> &taps, const S *const *samples,
                                                  int64_t step, size_t rows, int64_t count,
                                                  T *const *out) {
    if (taps.cross)
        sum_3x3_rows<true>(taps, samples, step, rows, count, out);
    else
        sum_3x3_rows<false>(taps, samples, step, rows, count, out);
}

WFPSF_VECTORISED void sum_3x3(const Taps3x3<float> &taps, const float *const *samples, int64_t step,
                              size_t rows, int64_t count, float *const *out) {
    sum_3x3_inline(taps, samples, step, rows, count, out);
}
WFPSF_VECTORISED void sum_3x3(const Taps3x3<double> &taps, const double *const *samples,
                              int64_t step, size_t rows, int64_t count, float *const *out) {
    sum_3x3_inline(taps, samples, step, rows, count, out);
}
WFPSF_VECTORISED void sum_3x3(const Taps3x3<double> &taps, const double *const *samples,
                              int64_t step, size_t rows, int64_t count, double *const *out) {
    sum_3x3_inline(taps, samples, step, rows, count, out);
}

template <class From, class To>
[[gnu::always_inline]] inline void convert_any(const From *from, int64_t count, To *__restrict to) {
    for (int64_t i = 0; i < count; ++i)
        to[i] = static_cast<To>(from[i]);
}

WFPSF_VECTORISED void add_scaled(const double *from, double weight, int64_t count,
                                 double *__restrict to) {
    for (int64_t i = 0; i < count; ++i)
        to[i] += weight * from[i];
}

WFPSF_VECTORISED void convert(const float *from, int64_t count, double *to) {
    convert_any(from, count, to);
}
WFPSF_VECTORISED void convert(const double *from, int64_t count, float *to) {
    convert_any(from, count, to);
}
template <class T> void convert(const T *from, int64_t count, T *to) {
    std::copy_n(from, count, to);
}

// One band of output rows. Each input row that the taps of an output row meet is held as S,
// extended by the margin on both sides, so that the sums know nothing of strides, types and edges.
// Output rows are taken in the order y, y + step, y + 2 step, ..., so that each needs one new input
// row, which is read before any row that it reaches is written: out may stand where in does. What
// lies outside the band is kept from the start then, for others write there.
template <class T, class S> class Pass {
  public:
    Pass(const TapList &kernel, View<const T> in, Edge edge, Axis x, Axis y, bool in_place)
        : taps_(kernel.taps), in_(in), edge_(edge), x_(x), y_(y),
          rows_(x.count + 2 * x.margin(), 2 * y.reach + most_rows), is_3x3_(kernel.is_3x3()) {
        for (const Tap &tap : taps_)
            values_.push_back(tap.value);
        if (is_3x3_)
            set_taps_3x3();
        if (in_place)
            for (int64_t i = 0; i < y.margin(); ++i)
                for (const int64_t row_y : {y.first - 1 - i, y.first + y.count + i})
                    keep_row(row_y);
    }

    // addend: of the band's own rows; its image may be empty.
    void run(const Addend &addend, View<T> out) {
        for (int64_t phase = 0; phase < std::min(y_.step, y_.count); ++phase) {
            const int64_t count = (y_.count - phase + y_.step - 1) / y_.step;
            int64_t loaded = 0;
            for (int64_t k = 0; k < count; k += most_rows) {
                const int64_t rows = std::min(most_rows, count - k);
                for (; loaded < k + rows + 2 * y_.reach; ++loaded)
                    load_row(y_.first + phase + (loaded - y_.reach) * y_.step, row(loaded));
                for (int64_t x = 0; x < x_.count; x += block)
                    sum_block(k, rows, x, std::min<int64_t>(block, x_.count - x),
                              phase + k * y_.step, addend, out);
            }
        }
    }

  private:
    // Rounded neighbours keep the kernel's sum: the centre takes the difference.
    void set_taps_3x3() {
        for (const Tap &tap : taps_) {
            S &place = taps_3x3_.neighbours[3 * (tap.dy + 1) + tap.dx + 1];
            const bool is_centre = tap.dx == 0 && tap.dy == 0;
            place = is_centre ? S(0) : static_cast<S>(tap.value);
            taps_3x3_.centre += tap.value - static_cast<double>(place);
        }
        taps_3x3_.cross = taps_.size() == 5;
    }

    S *row(int64_t k) { return rows_.view().row(k % rows_.ny()); }

    void keep_row(int64_t y) {
        const int64_t source_y = source_index(y, y_, edge_);
        if (source_y < 0 || kept_.contains(source_y))
            return;
        std::vector<S> copy(static_cast<size_t>(rows_.nx()));
        read_row(source_y, copy.data());
        kept_.emplace(source_y, std::move(copy));
    }

    void load_row(int64_t y, S *row) const {
        const int64_t source_y = source_index(y, y_, edge_);
        const bool outside = y < y_.first || y >= y_.first + y_.count;
        const auto kept = outside ? kept_.find(source_y) : kept_.end();
        if (kept != kept_.end())
            std::copy(kept->second.begin(), kept->second.end(), row);
        else if (source_y < 0)
            std::fill_n(row, rows_.nx(), S(0));
        else
            read_row(source_y, row);
    }

    void read_row(int64_t source_y, S *row) const {
        const T *source = in_.row(source_y);
        const int64_t begin = x_.first - x_.margin();
        const int64_t inside_begin = std::max<int64_t>(begin, 0);
        const int64_t inside_end = std::min(begin + rows_.nx(), x_.input_size);
        const auto load_outside = [&](int64_t from, int64_t to) {
            for (int64_t x = from; x < to; ++x) {
                const int64_t source_x = source_index(x, x_, edge_);
                row[x - begin] =
                    source_x < 0 ? S(0) : static_cast<S>(source[source_x * in_.stride_x]);
            }
        };
        load_outside(begin, inside_begin);
        if (in_.stride_x == 1)
            convert(source + inside_begin, inside_end - inside_begin, row + inside_begin - begin);
        else
            for (int64_t x = inside_begin; x < inside_end; ++x)
                row[x - begin] = static_cast<S>(source[x * in_.stride_x]);
        load_outside(inside_end, begin + rows_.nx());
    }

    // Some rows of out, every step-th from y on, in a block of columns from x on. The first is the
    // phase's row k.
    void sum_block(int64_t k, int64_t rows, int64_t x, int64_t count, int64_t y,
                   const Addend &addend, View<T> out) {
        std::array<T *, most_rows> to;
        for (size_t r = 0; r < most_rows; ++r)
            to[r] = out.stride_x == 1 ? out.row(y + static_cast<int64_t>(r) * y_.step) + x
                                      : buffer_[r].data();
        if (is_3x3_) {
            std::array<const S *, most_rows + 2> samples{};
            for (int64_t j = 0; j < rows + 2; ++j)
                samples[static_cast<size_t>(j)] = row(k + j) + x_.margin() + x;
            sum_3x3(taps_3x3_, samples.data(), x_.step, static_cast<size_t>(rows), count,
                    to.data());
        } else if constexpr (std::is_same_v<S, double>) {
            for (int64_t r = 0; r < rows; ++r)
                sum_row(k + r + y_.reach, x, count, to[static_cast<size_t>(r)]);
        }
        for (int64_t r = 0; r < rows; ++r) {
            T *sums = to[static_cast<size_t>(r)];
            const int64_t row_y = y + r * y_.step;
            if constexpr (std::is_same_v<T, double>)
                if (!addend.image.empty())
                    add_scaled(addend.image.row(row_y) + x, addend.weight, count, sums);
            if (out.stride_x != 1)
                for (int64_t i = 0; i < count; ++i)
                    out(x + i, row_y) = sums[i];
        }
    }

    // A block of one row, with row k of the phase at its middle.
    void sum_row(int64_t k, int64_t x, int64_t count, T *to) requires std::is_same_v<S, double> {
        if (taps_.empty())
            sum_.fill(0);
        for (size_t t = 0; t < taps_.size(); t += most_taps_at_once) {
            const size_t n = std::min(most_taps_at_once, taps_.size() - t);
            std::array<const double *, most_taps_at_once> samples;
            for (size_t i = 0; i < n; ++i)
                samples[i] = row(k - taps_[t + i].dy) + x_.margin() + x - taps_[t + i].dx * x_.step;
            sum_taps(n, &values_[t], samples.data(), count, t == 0, sum_.data());
        }
        convert(sum_.data(), count, to);
    }

    static constexpr int64_t block = 512; // samples; the sums stay in the first-level cache
    static constexpr int64_t most_rows = most_rows_at_once;
    const std::vector<Tap> &taps_;
    std::vector<double> values_;
    View<const T> in_;
    Edge edge_;
    Axis x_, y_;
    Plane<S> rows_;
    std::map<int64_t, std::vector<S>> kept_; // by the row of in that they copy
    bool is_3x3_;
    Taps3x3<S> taps_3x3_{};
    std::array<double, block> sum_;
    std::array<std::array<T, block>, most_rows> buffer_;
};

// The rows and columns x, y of in's pixels into out, whose first pixel is theirs.
template <class T, class S>
void run_passes(const TapList &kernel, View<const T> in, const Convolution &how, const Axis &x,
                const Axis &y, bool in_place, const Addend &addend, View<T> out) {
    const int64_t bands = std::min<int64_t>(how.threads, y.count);
    std::vector<Pass<T, S>> passes;
    for (int64_t band = 0; band < bands; ++band) {
        Axis rows = y;
        rows.first += y.count * band / bands;
        rows.count = y.count * (band + 1) / bands - y.count * band / bands;
        passes.emplace_back(kernel, in, how.edge, x, rows, in_place);
    }
    for_each_band(bands, [&](int64_t band) {
        const int64_t first = y.count * band / bands;
        View<T> rows = out;
        rows.data = out.row(first);
        Addend added = addend;
        if (!added.image.empty())
            added.image.data = addend.image.row(first);
        passes[static_cast<size_t>(band)].run(added, rows);
    });
}

template <class T>
void convolve_any(View<const double> table, View<const T> in, const Convolution &how,
                  const Addend &addend, View<T> out) {
    const auto pass = [&](const Axis &x, const Axis &y, bool in_place, View<T> target) {
        const TapList kernel(table);
        if (std::is_same_v<T, float> && kernel.is_3x3() && kernel.is_light())
            run_passes<T, T>(kernel, in, how, x, y, in_place, addend, target);
        else
            run_passes<T, double>(kernel, in, how, x, y, in_place, addend, target);
    };
    run_framed(in, {table.nx / 2, table.ny / 2}, how, out, pass);
}

} // namespace

void convolve(View<const double> taps, View<const float> in, const Convolution &how,
              View<float> out) {
    convolve_any(taps, in, how, {}, out);
}

void convolve(View<const double> taps, View<const double> in, const Convolution &how,
              View<double> out) {
    convolve_any(taps, in, how, {}, out);
}

void convolve_and_add(View<const double> taps, View<const double> in, const Convolution &how,
                      const Addend &addend, View<double> out) {
    convolve_any(taps, in, how, addend, out);
}

} // namespace wfpsf
