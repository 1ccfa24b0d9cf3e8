// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/resample.hpp"

#include "numerics/dispatch.hpp"

#include <algorithm>
#include <numeric>

namespace wfpsf {

namespace {

// Output row i = sum over k of weights[i % phases][k] * row(first[i] + k) of the input. Places that
// fall on the same fraction of a sample share their weights.
struct RowSums {
    std::vector<int64_t> first;
    std::vector<std::vector<double>> weights;
    int64_t rows_begin() const { return first.front(); }
    int64_t rows_end() const { return first.back() + static_cast<int64_t>(weights[0].size()); }
};

RowSums interpolating_sums(const BandlimitedInterpolator &interpolator, const Positions &p) {
    const int64_t divisor = std::gcd(p.numerator, p.denominator);
    const int64_t phases = std::min(p.denominator / divisor, p.count);
    RowSums sums;
    sums.weights.resize(static_cast<size_t>(phases));
    for (int64_t i = 0; i < p.count; ++i) {
        if (i < phases) {
            std::vector<double> &w = sums.weights[static_cast<size_t>(i)];
            w.resize(static_cast<size_t>(interpolator.taps()));
            const double place =
                p.start + static_cast<double>(i * p.numerator) / static_cast<double>(p.denominator);
            sums.first.push_back(interpolator.weights(place, w.data()));
        } else {
            const int64_t before = sums.first[static_cast<size_t>(i - phases)];
            sums.first.push_back(before + p.numerator * phases / p.denominator);
        }
    }
    return sums;
}

// Sums of whole rows (the inner loop runs along x, contiguous), written transposed, so that the
// same pass done twice treats both axes and restores the order. Input columns begin..end only.
WFPSF_VECTORISED Plane<double> sum_rows_transposed(View<const double> in, const RowSums &sums,
                                                   int64_t begin, int64_t end) {
    Plane<double> out(static_cast<int64_t>(sums.first.size()), end - begin);
    std::vector<double> line(static_cast<size_t>(end - begin));
    for (size_t j = 0; j < sums.first.size(); ++j) {
        std::fill(line.begin(), line.end(), 0.0);
        const std::vector<double> &weights = sums.weights[j % sums.weights.size()];
        for (size_t k = 0; k < weights.size(); ++k) {
            const double *row = in.row(sums.first[j] + static_cast<int64_t>(k)) + begin;
            for (size_t x = 0; x < line.size(); ++x)
                line[x] += weights[k] * row[x];
        }
        for (size_t x = 0; x < line.size(); ++x)
            out(static_cast<int64_t>(j), static_cast<int64_t>(x)) = line[x];
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

Plane<double> filter(View<const double> grid, const std::vector<double> &taps) {
    const auto shrunk = [&taps](int64_t n) {
        RowSums sums;
        sums.weights = {taps};
        sums.first.resize(static_cast<size_t>(n - static_cast<int64_t>(taps.size()) + 1));
        std::iota(sums.first.begin(), sums.first.end(), 0);
        return sums;
    };
    const Plane<double> half = sum_rows_transposed(grid, shrunk(grid.ny), 0, grid.nx);
    return sum_rows_transposed(half.view(), shrunk(grid.nx), 0, half.nx());
}

} // namespace wfpsf
