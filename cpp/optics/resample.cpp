// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/resample.hpp"

#include "numerics/dispatch.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace wfpsf {

namespace {

// Output row i = sum over k of weights[(phase + i) % phases][k] * row(first[i] + k) of the input.
// Places that fall on the same fraction of a sample share their weights.
struct RowSums {
    std::vector<int64_t> first;
    std::vector<std::vector<double>> weights;
    int64_t phase = 0;

    const std::vector<double> &weights_of(int64_t i) const {
        return weights[static_cast<size_t>(phase + i) % weights.size()];
    }
    int64_t rows_begin() const { return first.front(); }
    int64_t rows_end() const { return first.back() + static_cast<int64_t>(weights[0].size()); }
};

RowSums interpolating_sums(const BandlimitedInterpolator &interpolator, const Positions &p) {
    const int64_t phases =
        std::max<int64_t>(1, p.denominator / std::gcd(p.numerator, p.denominator));
    RowSums sums;
    sums.phase = p.first % phases;
    std::vector<int64_t> first_of_phase;
    for (int64_t i = 0; i < std::min(phases, p.first + p.count); ++i) {
        std::vector<double> &w =
            sums.weights.emplace_back(static_cast<size_t>(interpolator.taps()));
        const double place =
            p.start + static_cast<double>(i * p.numerator) / static_cast<double>(p.denominator);
        first_of_phase.push_back(interpolator.weights(place, w.data()));
    }
    for (int64_t i = p.first; i < p.first + p.count; ++i) {
        const int64_t phase = i % phases;
        sums.first.push_back(first_of_phase[static_cast<size_t>(phase)] +
                             (i - phase) * p.numerator / p.denominator);
    }
    return sums;
}

typedef double Two
    __attribute__((vector_size(16))); // wider ones are lowered badly where they are split
constexpr int64_t block = 16;

// sums[x] = sum over k of weights[k] * rows[k * stride + x] for a block of columns, which stays in
// registers over all rows.
[[gnu::always_inline]] inline void sum_block(const double *rows, int64_t stride,
                                             const std::vector<double> &weights, double *sums) {
    Two a{}, b{}, c{}, d{}, e{}, f{}, g{}, h{};
    const auto add =
        [](Two & sum, double weight, const double *pixels) __attribute__((always_inline)) {
        Two two;
        std::memcpy(&two, pixels, sizeof two);
        sum += weight * two;
    };
    for (const double weight : weights) {
        add(a, weight, rows);
        add(b, weight, rows + 2);
        add(c, weight, rows + 4);
        add(d, weight, rows + 6);
        add(e, weight, rows + 8);
        add(f, weight, rows + 10);
        add(g, weight, rows + 12);
        add(h, weight, rows + 14);
        rows += stride;
    }
    for (const Two &sum : {a, b, c, d, e, f, g, h}) {
        std::memcpy(sums, &sum, sizeof sum);
        sums += 2;
    }
}

// The same for the last columns, fewer than a block; inline, so that it rounds as the block does.
[[gnu::always_inline]] inline void sum_rest(const double *rows, int64_t stride,
                                            const std::vector<double> &weights, int64_t columns,
                                            double *sums) {
    std::fill_n(sums, columns, 0.0);
    for (const double weight : weights) {
        for (int64_t x = 0; x < columns; ++x)
            sums[x] += weight * rows[x];
        rows += stride;
    }
}

// Sums of whole rows, written transposed, so that the same pass done twice treats both axes and
// restores the order. Input columns begin..end only.
WFPSF_VECTORISED Plane<double> sum_rows_transposed(View<const double> in, const RowSums &sums,
                                                   int64_t begin, int64_t end) {
    const auto count = static_cast<int64_t>(sums.first.size());
    Plane<double> out(count, end - begin);
    double *const pixels = out.view().data;
    for (int64_t j = 0; j < count; ++j) {
        const std::vector<double> &weights = sums.weights_of(j);
        const double *rows = in.row(sums.first[static_cast<size_t>(j)]) + begin;
        for (int64_t x = 0; x < out.ny(); x += block) {
            double line[block];
            const int64_t columns = std::min(block, out.ny() - x);
            if (columns == block)
                sum_block(rows + x, in.stride_y, weights, line);
            else
                sum_rest(rows + x, in.stride_y, weights, columns, line);
            for (int64_t i = 0; i < columns; ++i)
                pixels[(x + i) * count + j] = line[i];
        }
    }
    return out;
}

} // namespace

template <class T>
void resample(View<const double> grid, const BandlimitedInterpolator &interpolator,
              const Positions &x, const Positions &y, double scale, View<T> out) {
    RowSums along_x = interpolating_sums(interpolator, x);
    const int64_t begin = along_x.rows_begin();
    const Plane<double> half =
        sum_rows_transposed(grid, interpolating_sums(interpolator, y), begin, along_x.rows_end());
    for (int64_t &first : along_x.first)
        first -= begin;
    const Plane<double> whole = sum_rows_transposed(half.view(), along_x, 0, half.nx());
    for (int64_t j = 0; j < out.ny; ++j)
        for (int64_t i = 0; i < out.nx; ++i)
            out(i, j) = static_cast<T>(scale * whole(i, j));
}

template void resample(View<const double>, const BandlimitedInterpolator &, const Positions &,
                       const Positions &, double, View<float>);
template void resample(View<const double>, const BandlimitedInterpolator &, const Positions &,
                       const Positions &, double, View<double>);

Plane<double> filtered(View<const double> grid, const SeparableFilter &filter, int64_t stride) {
    const auto shrunk = [stride](int64_t n, const std::vector<double> &taps) {
        RowSums sums;
        sums.weights = {taps};
        for (int64_t first = 0; first + static_cast<int64_t>(taps.size()) <= n; first += stride)
            sums.first.push_back(first);
        return sums;
    };
    Plane<double> sum;
    for (const SeparableFilter::Term &term : filter.terms) {
        const Plane<double> half = sum_rows_transposed(grid, shrunk(grid.ny, term.y), 0, grid.nx);
        Plane<double> product =
            sum_rows_transposed(half.view(), shrunk(grid.nx, term.x), 0, half.nx());
        if (sum.nx() == 0) {
            sum = std::move(product);
            continue;
        }
        for (int64_t y = 0; y < sum.ny(); ++y)
            for (int64_t x = 0; x < sum.nx(); ++x)
                sum(x, y) += product(x, y);
    }
    return sum;
}

} // namespace wfpsf
