// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/couplings.hpp"
#include "detector/ipc_border.hpp"
#include "error/error.hpp"
#include "numerics/bands.hpp"
#include "numerics/dispatch.hpp"
#include "numerics/working_plane.hpp"

#include <algorithm>

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
    VaryingPass(Couplings couplings, View<const T> in, Edge edge, Axis x, Axis y)
        : couplings_(std::move(couplings)), in_(in), edge_(edge), x_(x), y_(y),
          taps_(in.nx + 2 * x.reach, std::ssize(couplings_.offsets)), sum_(x.count, 1) {}

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
            for (size_t k = 0; k < couplings_.offsets.size(); ++k) {
                const Term term = term_of(couplings_.offsets[k]);
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
        couplings_.taps(y, {padded.data + x_.reach, in_.nx, padded.ny, 1, padded.stride_y});
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

    Couplings couplings_;
    View<const T> in_;
    Edge edge_;
    Axis x_, y_;
    Plane<double> taps_; // of one row, by offset
    Plane<double> sum_;
};

template <class T>
void run_passes(const Couplings &couplings, View<const T> in, const VaryingConvolution &how,
                const Axis &x, const Axis &y, View<T> out) {
    const int64_t bands = std::clamp<int64_t>(how.threads, 1, y.count);
    for_each_band(bands, [&](int64_t band) {
        const int64_t first = y.count * band / bands, end = y.count * (band + 1) / bands;
        Axis rows = y;
        rows.first += first;
        rows.count = end - first;
        VaryingPass<T> pass(couplings, in, how.edge, x, rows);
        View<T> to = out;
        to.data = out.row(first);
        how.form == IpcForm::scatter ? pass.scatter(to) : pass.gather(to);
    });
}

template <class T>
void convolve_any(const Couplings &couplings, View<const T> in, const VaryingConvolution &how,
                  View<T> out) {
    if (in.nx != couplings.nx || in.ny != couplings.ny)
        fail(WFPSF_ERROR_SIZE, "in has %lld x %lld pixels: the detector has %lld x %lld",
             static_cast<long long>(in.nx), static_cast<long long>(in.ny),
             static_cast<long long>(couplings.nx), static_cast<long long>(couplings.ny));
    const auto pass = [&](const Axis &x, const Axis &y, bool in_place, View<T> target) {
        if (!in_place) {
            run_passes<T>(couplings, in, how, x, y, target);
            return;
        }
        WorkingPlane<T> copy(in.nx, in.ny);
        const View<T> pixels = copy.view();
        for (int64_t j = 0; j < in.ny; ++j)
            for (int64_t i = 0; i < in.nx; ++i)
                pixels(i, j) = in(i, j);
        run_passes<T>(couplings, pixels, how, x, y, target);
    };
    run_framed(in, {couplings.reach_x, couplings.reach_y},
               {.edge = how.edge, .fill = how.fill, .threads = how.threads}, out, pass);
}

Couplings couplings_of(const VaryingIpc &ipc) {
    return {ipc.nx(),
            ipc.ny(),
            ipc.reach_x(),
            ipc.reach_y(),
            {ipc.offsets().begin(), ipc.offsets().end()},
            [&ipc](int64_t y, View<double> taps) { ipc.taps(y, taps); }};
}

} // namespace

void convolve(const Couplings &couplings, View<const float> in, const VaryingConvolution &how,
              View<float> out) {
    convolve_any(couplings, in, how, out);
}

void convolve(const Couplings &couplings, View<const double> in, const VaryingConvolution &how,
              View<double> out) {
    convolve_any(couplings, in, how, out);
}

void convolve(const VaryingIpc &ipc, View<const float> in, const VaryingConvolution &how,
              View<float> out) {
    convolve(couplings_of(ipc), in, how, out);
}

void convolve(const VaryingIpc &ipc, View<const double> in, const VaryingConvolution &how,
              View<double> out) {
    convolve(couplings_of(ipc), in, how, out);
}

} // namespace wfpsf
