// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/ipc_border.hpp"
#include "detector/random.hpp"
#include "detector/varying_ipc.hpp"
#include "error/error.hpp"
#include "image/overlap.hpp"
#include "numerics/bands.hpp"
#include "numerics/dispatch.hpp"
#include "numerics/working_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace wfpsf {

namespace {

// sum += weights values, pixel by pixel.
WFPSF_VECTORISED void add_products(const double *weights, const double *values, int64_t count,
                                   double *__restrict sum) {
    for (int64_t i = 0; i < count; ++i)
        sum[i] += weights[i] * values[i];
}

// A band of output rows. Rows are held with the margin that the kernels reach on both sides, so
// that the sums know nothing of strides, types and edges.
template <class T> class VaryingPass {
  public:
    VaryingPass(const VaryingIpc &ipc, View<const T> in, Edge edge, Axis x, Axis y)
        : ipc_(ipc), in_(in), edge_(edge), x_(x), y_(y),
          taps_(in.nx + 2 * x.reach, std::ssize(ipc.offsets())), sum_(x.count, 1) {}

    // Every source row is spread, once, into the 2 reach + 1 rows around it: the ring keeps what it
    // leaves in each until all that leave something there are known.
    void scatter(View<T> out) {
        const int64_t depth = 2 * y_.reach + 1;
        Plane<double> charge(taps_.nx(), 1), ring(x_.count, depth * depth);
        const auto share = [&](int64_t source, int64_t dy) {
            return ring.view().row(floor_mod(source, depth) * depth + dy + y_.reach);
        };
        int64_t spread = y_.first - y_.reach;
        for (int64_t j = 0; j < y_.count; ++j) {
            const int64_t y = y_.first + j;
            for (; spread <= y + y_.reach; ++spread) {
                for (int64_t dy = -y_.reach; dy <= y_.reach; ++dy)
                    std::fill_n(share(spread, dy), x_.count, 0);
                const int64_t source = source_index(spread, y_, edge_);
                if (source < 0)
                    continue;
                load(source, charge.view().row(0));
                load_taps(source);
                add_taps([&](VaryingIpc::Offset d) {
                    return Term{x_.reach - d.dx, charge.view().row(0) + x_.reach - d.dx,
                                share(spread, d.dy)};
                });
            }
            double *sum = sum_.view().row(0);
            std::fill_n(sum, x_.count, 0);
            for (int64_t dy = -y_.reach; dy <= y_.reach; ++dy) {
                const double *from = share(y - dy, dy);
                for (int64_t i = 0; i < x_.count; ++i)
                    sum[i] += from[i];
            }
            store(j, out);
        }
    }

    void gather(View<T> out) {
        const int64_t depth = 2 * y_.reach + 1;
        Plane<double> ring(taps_.nx(), depth);
        const auto row = [&](int64_t y) { return ring.view().row(floor_mod(y, depth)); };
        int64_t loaded = y_.first - y_.reach;
        for (int64_t j = 0; j < y_.count; ++j) {
            const int64_t y = y_.first + j;
            for (; loaded <= y + y_.reach; ++loaded)
                load(source_index(loaded, y_, edge_), row(loaded));
            load_taps(y);
            std::fill_n(sum_.view().row(0), x_.count, 0);
            add_taps([&](VaryingIpc::Offset d) {
                return Term{x_.reach, row(y + d.dy) + x_.reach + d.dx, sum_.view().row(0)};
            });
            store(j, out);
        }
    }

  private:
    // What an offset adds: taps from a column on, times values, to a sum. All for output column 0.
    struct Term {
        int64_t first_tap;
        const double *values;
        double *sum;
    };

    template <class TermOf> void add_taps(const TermOf &term_of) {
        constexpr int64_t block = 512; // the sums stay in the first-level cache
        for (int64_t i = 0; i < x_.count; i += block)
            for (size_t k = 0; k < ipc_.offsets().size(); ++k) {
                const Term term = term_of(ipc_.offsets()[k]);
                const int64_t at = x_.first + i;
                add_products(taps_.view().row(static_cast<int64_t>(k)) + term.first_tap + at,
                             term.values + at, std::min(block, x_.count - i), term.sum + i);
            }
    }

    template <class Value> void fill_margins(double *row, const Value &value) const {
        for (int64_t i = 0; i < x_.reach; ++i)
            for (const int64_t x : {-1 - i, in_.nx + i})
                row[x_.reach + x] = value(source_index(x, x_, edge_));
    }

    void load(int64_t source, double *row) const {
        if (source < 0) {
            std::fill_n(row, taps_.nx(), 0);
            return;
        }
        const T *from = in_.row(source);
        if (in_.stride_x == 1)
            std::copy_n(from, in_.nx, row + x_.reach);
        else
            for (int64_t x = 0; x < in_.nx; ++x)
                row[x_.reach + x] = static_cast<double>(from[x * in_.stride_x]);
        fill_margins(row, [&](int64_t x) { return x < 0 ? 0 : row[x_.reach + x]; });
    }

    void load_taps(int64_t y) {
        const View<double> padded = taps_.view();
        ipc_.taps(y, {padded.data + x_.reach, in_.nx, padded.ny, 1, padded.stride_y});
        for (int64_t k = 0; k < padded.ny; ++k) {
            double *row = padded.row(k);
            fill_margins(row, [&](int64_t x) { return x < 0 ? 0 : row[x_.reach + x]; });
        }
    }

    void store(int64_t j, View<T> out) {
        const double *sum = sum_.view().row(0);
        T *to = out.row(j);
        if (out.stride_x == 1)
            std::transform(sum, sum + x_.count, to, [](double s) { return static_cast<T>(s); });
        else
            for (int64_t i = 0; i < x_.count; ++i)
                to[i * out.stride_x] = static_cast<T>(sum[i]);
    }

    const VaryingIpc &ipc_;
    View<const T> in_;
    Edge edge_;
    Axis x_, y_;
    Plane<double> taps_; // of one row, by offset
    Plane<double> sum_;
};

template <class T>
void run_passes(const VaryingIpc &ipc, View<const T> in, const VaryingConvolution &how,
                const Axis &x, const Axis &y, View<T> out) {
    const int64_t bands = std::clamp<int64_t>(how.threads, 1, y.count);
    for_each_band(bands, [&](int64_t band) {
        const int64_t first = y.count * band / bands, end = y.count * (band + 1) / bands;
        Axis rows = y;
        rows.first += first;
        rows.count = end - first;
        VaryingPass<T> pass(ipc, in, how.edge, x, rows);
        View<T> to = out;
        to.data = out.row(first);
        how.form == IpcForm::scatter ? pass.scatter(to) : pass.gather(to);
    });
}

template <class T>
void convolve_any(const VaryingIpc &ipc, View<const T> in, const VaryingConvolution &how,
                  View<T> out) {
    const Edge edge = how.edge;
    if (edge < Edge::zero || edge > Edge::valid)
        fail(WFPSF_ERROR_ARGUMENT, "edge = %d: must be 0..%d", static_cast<int>(edge),
             static_cast<int>(Edge::valid));
    if (edge == Edge::fill && std::isfinite(how.fill) &&
        std::fabs(how.fill) > static_cast<double>(std::numeric_limits<T>::max()))
        fail(WFPSF_ERROR_RANGE, "fill = %g: too large for the pixel type", how.fill);
    if (in.nx != ipc.nx() || in.ny != ipc.ny())
        fail(WFPSF_ERROR_SIZE, "in has %lld x %lld pixels: the detector has %lld x %lld",
             static_cast<long long>(in.nx), static_cast<long long>(in.ny),
             static_cast<long long>(ipc.nx()), static_cast<long long>(ipc.ny()));
    const Axis x = make_axis(std::max<int64_t>(in.nx, 1), ipc.reach_x(), 1, edge);
    const Axis y = make_axis(std::max<int64_t>(in.ny, 1), ipc.reach_y(), 1, edge);
    require_out_size(in, x, y, edge, out);
    if (out.empty())
        return;
    const bool in_place = are_same(in, out);
    if (!in_place && shares_memory(in, out))
        fail(WFPSF_ERROR_OVERLAP,
             "in and out share memory in part: give out its own, or the very pixels of in");

    if (x.count > 0 && y.count > 0) {
        const bool bordered = edge == Edge::crop || edge == Edge::fill;
        const View<T> target =
            bordered ? View<T>{&out(x.first, y.first), x.count, y.count, out.stride_x, out.stride_y}
                     : out;
        if (in_place) {
            WorkingPlane<T> copy(in.nx, in.ny);
            const View<T> pixels = copy.view();
            for (int64_t j = 0; j < in.ny; ++j)
                for (int64_t i = 0; i < in.nx; ++i)
                    pixels(i, j) = in(i, j);
            run_passes<T>(ipc, pixels, how, x, y, target);
        } else {
            run_passes<T>(ipc, in, how, x, y, target);
        }
    }
    if (edge == Edge::crop && !in_place)
        set_border(
            x, y, [&](int64_t i, int64_t j) { return in(i, j); }, out);
    if (edge == Edge::fill)
        set_border(
            x, y, [&](int64_t, int64_t) { return static_cast<T>(how.fill); }, out);
}

double largest(View<const double> image) {
    double most = 0;
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x)
            most = std::max(most, std::fabs(image(x, y)));
    return most;
}

// x with A x = b. It starts from what is in x.
Iteration solve(const VaryingIpc &ipc, const VaryingConvolution &how, View<const double> b,
                double tolerance, int64_t most_passes, View<double> x, View<double> scratch) {
    const double scale = std::max(largest(b), std::numeric_limits<double>::min());
    const auto set_difference = [&] {
        convolve(ipc, View<const double>(x), how, scratch);
        for (int64_t j = 0; j < b.ny; ++j)
            for (int64_t i = 0; i < b.nx; ++i)
                scratch(i, j) = b(i, j) - scratch(i, j);
    };
    const auto step = [&](double weight) {
        set_difference();
        for (int64_t j = 0; j < b.ny; ++j)
            for (int64_t i = 0; i < b.nx; ++i)
                x(i, j) += weight * scratch(i, j);
    };
    const auto residual = [&] {
        set_difference();
        return largest(scratch) / scale;
    };
    return solve_by_chebyshev(step, residual, ipc.spectrum(), tolerance, most_passes);
}

// The rms of what the inverse makes of random signs: in the mean over all signs it is that of any
// white noise. Small images are tried again and again.
double measured_noise(const VaryingIpc &ipc, const VaryingConvolution &how, int64_t most_passes,
                      View<double> signs, View<double> x, View<double> scratch) {
    constexpr int64_t enough = 1 << 16, most_trials = 64;
    const int64_t pixels = x.nx * x.ny;
    const int64_t trials = std::clamp<int64_t>(enough / pixels, 1, most_trials);
    constexpr double tolerance = 1e-4; // the sampling error is no smaller
    double sum = 0;
    for (int64_t trial = 0; trial < trials; ++trial) {
        const RandomSource random{.stream = static_cast<uint32_t>(trial)};
        for (int64_t j = 0; j < x.ny; ++j) {
            fill_normal(random, 0, j, x.nx, signs.row(j));
            for (int64_t i = 0; i < x.nx; ++i)
                x(i, j) = signs(i, j) = std::copysign(1.0, signs(i, j));
        }
        solve(ipc, how, signs, tolerance, most_passes, x, scratch);
        for (int64_t j = 0; j < x.ny; ++j)
            for (int64_t i = 0; i < x.nx; ++i)
                sum += x(i, j) * x(i, j);
    }
    return std::sqrt(sum / static_cast<double>(pixels * trials));
}

template <class T>
Solution solve_any(const VaryingIpc &ipc, View<const T> in, const VaryingConvolution &how,
                   const SolveLimits &limits, bool with_noise, View<T> out) {
    require_invertible_edge(how.edge);
    for (const auto &[nx, ny] : {std::pair(in.nx, in.ny), std::pair(out.nx, out.ny)})
        if (nx != ipc.nx() || ny != ipc.ny())
            fail(WFPSF_ERROR_SIZE,
                 "in and out have %lld x %lld pixels: the detector has %lld x %lld",
                 static_cast<long long>(nx), static_cast<long long>(ny),
                 static_cast<long long>(ipc.nx()), static_cast<long long>(ipc.ny()));
    const VaryingIpc::Weakest &weakest = ipc.weakest();
    if (!(weakest.margin >= limits.least_margin) || !(ipc.spectrum().lowest > 0))
        fail(WFPSF_ERROR_KERNEL_SINGULAR,
             "min |K^| = %.3g at pixel (%lld, %lld): must be at least %.3g, the least margin, and "
             "every transform positive, for an inverse",
             weakest.margin, static_cast<long long>(weakest.x), static_cast<long long>(weakest.y),
             limits.least_margin);
    Solution solution;
    solution.margin = weakest.margin;
    if (in.empty())
        return solution;

    WorkingPlane<double> charge(in.nx, in.ny), observed(in.nx, in.ny), scratch(in.nx, in.ny);
    const View<double> x = charge.view(), b = observed.view();
    if (with_noise)
        solution.noise_amplification =
            measured_noise(ipc, how, limits.most_passes, b, x, scratch.view());
    for (int64_t j = 0; j < in.ny; ++j)
        for (int64_t i = 0; i < in.nx; ++i) {
            const bool finite = std::isfinite(in(i, j));
            x(i, j) = b(i, j) = finite ? static_cast<double>(in(i, j)) : 0;
            solution.not_finite += finite ? 0 : 1;
        }
    const double tolerance = std::max(limits.tolerance, least_tolerance<T>);
    const Iteration iteration =
        solve(ipc, how, b, tolerance, limits.most_passes, x, scratch.view());
    solution.residual = iteration.residual;
    solution.passes = iteration.passes;
    solution.converged = iteration.converged;
    for (int64_t j = 0; j < in.ny; ++j)
        for (int64_t i = 0; i < in.nx; ++i)
            out(i, j) = std::isfinite(in(i, j)) ? static_cast<T>(x(i, j)) : in(i, j);
    return solution;
}

} // namespace

void convolve(const VaryingIpc &ipc, View<const float> in, const VaryingConvolution &how,
              View<float> out) {
    convolve_any(ipc, in, how, out);
}

void convolve(const VaryingIpc &ipc, View<const double> in, const VaryingConvolution &how,
              View<double> out) {
    convolve_any(ipc, in, how, out);
}

Solution solve_ipc(const VaryingIpc &ipc, View<const float> in, const VaryingConvolution &how,
                   const SolveLimits &limits, bool with_noise, View<float> out) {
    return solve_any(ipc, in, how, limits, with_noise, out);
}

Solution solve_ipc(const VaryingIpc &ipc, View<const double> in, const VaryingConvolution &how,
                   const SolveLimits &limits, bool with_noise, View<double> out) {
    return solve_any(ipc, in, how, limits, with_noise, out);
}

} // namespace wfpsf
