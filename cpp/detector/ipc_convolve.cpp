// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_convolve.hpp"

#include "error/error.hpp"
#include "image/overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace wfpsf {

namespace {

// One axis of the pass. Output i stands at input sample first + i; taps are `step` samples apart
// and reach out to `reach` of them.
struct Axis {
    int64_t input_size, first, count, reach, step;
    int64_t margin() const { return reach * step; }
};

int64_t floor_mod(int64_t i, int64_t n) {
    return (i % n + n) % n;
}

// The input sample that stands at index i of an axis, -1 if there is none.
int64_t source_index(int64_t i, const Axis &axis, Edge edge) {
    const int64_t n = axis.input_size;
    if (i >= 0 && i < n)
        return i;
    if (edge == Edge::wrap)
        return floor_mod(i, n);
    if (edge == Edge::replicate)
        return floor_mod(i < 0 ? i : i - n, axis.step) + (i < 0 ? 0 : n - axis.step);
    return -1;
}

struct Tap {
    int64_t dx, dy;
    double value;
};

std::vector<Tap> nonzero_taps(const IpcKernel &kernel) {
    std::vector<Tap> taps;
    for (int64_t dy = -kernel.reach_y(); dy <= kernel.reach_y(); ++dy)
        for (int64_t dx = -kernel.reach_x(); dx <= kernel.reach_x(); ++dx)
            if (kernel(dx, dy) != 0)
                taps.push_back({dx, dy, kernel(dx, dy)});
    return taps;
}

// sum += value[0] samples[0] + value[1] samples[1] + ..., for `count` samples. Several taps at a
// time spare loads and stores of the sums; nine are a 3 x 3 kernel in one go.
constexpr size_t most_taps_at_once = 9;
using AddTaps = void (*)(const double *value, const double *const *samples, int64_t count,
                         double *sum);

template <size_t... tap>
void add_taps(const double *value, const double *const *samples, int64_t count,
              double *__restrict sum) {
    const double v[] = {value[tap]...};
    const double *const s[] = {samples[tap]...};
    for (int64_t i = 0; i < count; ++i)
        sum[i] += (... + (v[tap] * s[tap][i]));
}

template <size_t... tap> constexpr AddTaps add_taps_of(std::index_sequence<tap...>) {
    return add_taps<tap...>;
}

template <size_t... n>
constexpr std::array<AddTaps, sizeof...(n)> make_add_taps(std::index_sequence<n...>) {
    return {add_taps_of(std::make_index_sequence<n + 1>())...};
}

// add_some_taps[n - 1] adds n taps.
constexpr auto add_some_taps = make_add_taps(std::make_index_sequence<most_taps_at_once>());

// The pass itself. Each input row that the taps of an output row meet is held as double, extended
// by the margin on both sides, so that the sums know nothing of strides, types and edges. Output
// rows are taken in the order y, y + step, y + 2 step, ..., so that each needs one new input row.
template <class T> class Pass {
  public:
    Pass(const IpcKernel &kernel, View<const T> in, Edge edge, Axis x, Axis y)
        : taps_(nonzero_taps(kernel)), in_(in), edge_(edge), x_(x), y_(y),
          rows_(x.count + 2 * x.margin(), 2 * y.reach + 1) {
        for (const Tap &tap : taps_)
            values_.push_back(tap.value);
    }

    void run(View<T> out) {
        for (int64_t phase = 0; phase < std::min(y_.step, y_.count); ++phase) {
            for (int64_t k = 0; phase + (k - 2 * y_.reach) * y_.step < y_.count; ++k) {
                load_row(y_.first + phase + (k - y_.reach) * y_.step, row(k));
                if (k >= 2 * y_.reach)
                    sum_row(k - y_.reach, phase + (k - 2 * y_.reach) * y_.step, out);
            }
        }
    }

  private:
    double *row(int64_t k) { return rows_.view().row(k % rows_.ny()); }

    void load_row(int64_t y, double *row) const {
        const int64_t source_y = source_index(y, y_, edge_);
        if (source_y < 0) {
            std::fill_n(row, rows_.nx(), 0.0);
            return;
        }
        const T *source = in_.row(source_y);
        const int64_t begin = x_.first - x_.margin();
        const int64_t inside_begin = std::max<int64_t>(begin, 0);
        const int64_t inside_end = std::min(begin + rows_.nx(), x_.input_size);
        const auto load_outside = [&](int64_t from, int64_t to) {
            for (int64_t x = from; x < to; ++x) {
                const int64_t source_x = source_index(x, x_, edge_);
                row[x - begin] =
                    source_x < 0 ? 0.0 : static_cast<double>(source[source_x * in_.stride_x]);
            }
        };
        load_outside(begin, inside_begin);
        if (in_.stride_x == 1)
            std::copy(source + inside_begin, source + inside_end, row + inside_begin - begin);
        else
            for (int64_t x = inside_begin; x < inside_end; ++x)
                row[x - begin] = static_cast<double>(source[x * in_.stride_x]);
        load_outside(inside_end, begin + rows_.nx());
    }

    // Row y of out, which has row k of the phase at its middle.
    void sum_row(int64_t k, int64_t y, View<T> out) {
        for (int64_t x = 0; x < x_.count; x += block) {
            const int64_t count = std::min<int64_t>(block, x_.count - x);
            sum_.fill(0);
            for (size_t t = 0; t < taps_.size(); t += most_taps_at_once) {
                const size_t n = std::min(most_taps_at_once, taps_.size() - t);
                std::array<const double *, most_taps_at_once> samples;
                for (size_t i = 0; i < n; ++i)
                    samples[i] =
                        row(k - taps_[t + i].dy) + x_.margin() + x - taps_[t + i].dx * x_.step;
                add_some_taps[n - 1](&values_[t], samples.data(), count, sum_.data());
            }
            T *target = out.row(y) + x * out.stride_x;
            if (out.stride_x == 1)
                for (int64_t i = 0; i < count; ++i)
                    target[i] = static_cast<T>(sum_[static_cast<size_t>(i)]);
            else
                for (int64_t i = 0; i < count; ++i)
                    target[i * out.stride_x] = static_cast<T>(sum_[static_cast<size_t>(i)]);
        }
    }

    static constexpr int64_t block = 512; // samples; the sums stay in the first-level cache
    std::vector<Tap> taps_;
    std::vector<double> values_;
    View<const T> in_;
    Edge edge_;
    Axis x_, y_;
    Plane<double> rows_;
    std::array<double, block> sum_;
};

void require_size(int64_t nx, int64_t ny, int64_t required_nx, int64_t required_ny) {
    if (nx != required_nx || ny != required_ny)
        fail(WFPSF_ERROR_SIZE, "out has %lld x %lld pixels: must have %lld x %lld",
             static_cast<long long>(nx), static_cast<long long>(ny),
             static_cast<long long>(required_nx), static_cast<long long>(required_ny));
}

// Steps longer than the image act as one of its length does, which bounds the margins.
Axis make_axis(int64_t n, int64_t reach, int64_t tap_step, Edge edge) {
    const int64_t step = edge == Edge::wrap ? (tap_step - 1) % n + 1 : std::min(tap_step, n);
    Axis axis{n, 0, n, reach, step};
    if (edge == Edge::crop || edge == Edge::fill || edge == Edge::valid) {
        axis.first = axis.margin();
        axis.count = std::max<int64_t>(n - 2 * axis.margin(), 0);
    }
    return axis;
}

template <class T, class Value>
void set_border(const Axis &x_axis, const Axis &y_axis, Value value, View<T> out) {
    const int64_t right = x_axis.first + x_axis.count;
    for (int64_t y = 0; y < out.ny; ++y) {
        const bool inside_y = y >= y_axis.first && y < y_axis.first + y_axis.count;
        for (int64_t x = 0; x < out.nx; ++x) {
            if (inside_y && x == x_axis.first)
                x = right;
            if (x < out.nx)
                out(x, y) = value(x, y);
        }
    }
}

template <class T>
void convolve_any(const IpcKernel &kernel, View<const T> in, Edge edge, double fill,
                  int64_t tap_step, View<T> out) {
    if (edge < Edge::zero || edge > Edge::valid)
        fail(WFPSF_ERROR_ARGUMENT, "edge = %d: must be 0..%d", static_cast<int>(edge),
             static_cast<int>(Edge::valid));
    if (tap_step < 1)
        fail(WFPSF_ERROR_RANGE, "tap_step = %lld: must be at least 1",
             static_cast<long long>(tap_step));
    if (edge == Edge::fill && std::isfinite(fill) &&
        std::fabs(fill) > static_cast<double>(std::numeric_limits<T>::max()))
        fail(WFPSF_ERROR_RANGE, "fill = %g: too large for the pixel type", fill);
    const Axis x = make_axis(std::max<int64_t>(in.nx, 1), kernel.reach_x(), tap_step, edge);
    const Axis y = make_axis(std::max<int64_t>(in.ny, 1), kernel.reach_y(), tap_step, edge);
    if (edge == Edge::valid)
        require_size(out.nx, out.ny, in.nx == 0 ? 0 : x.count, in.ny == 0 ? 0 : y.count);
    else
        require_size(out.nx, out.ny, in.nx, in.ny);
    if (out.empty())
        return;
    if (shares_memory(in, out))
        fail(WFPSF_ERROR_OVERLAP, "in and out share memory: give out its own");

    if (edge == Edge::crop)
        set_border(
            x, y, [&](int64_t i, int64_t j) { return in(i, j); }, out);
    if (edge == Edge::fill)
        set_border(
            x, y, [&](int64_t, int64_t) { return static_cast<T>(fill); }, out);
    if (x.count == 0 || y.count == 0)
        return;
    if (edge == Edge::crop || edge == Edge::fill)
        out = {&out(x.first, y.first), x.count, y.count, out.stride_x, out.stride_y};
    Pass<T>(kernel, in, edge, x, y).run(out);
}

} // namespace

void convolve(const IpcKernel &kernel, View<const float> in, Edge edge, double fill,
              int64_t tap_step, View<float> out) {
    convolve_any(kernel, in, edge, fill, tap_step, out);
}

void convolve(const IpcKernel &kernel, View<const double> in, Edge edge, double fill,
              int64_t tap_step, View<double> out) {
    convolve_any(kernel, in, edge, fill, tap_step, out);
}

} // namespace wfpsf
