// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/resample.hpp"

#include <algorithm>

namespace wfpsf {

namespace {

// One output row's recipe: out = sum_k weight[k] * row(first + k).
struct RowSum {
    int64_t first;
    std::vector<double> weight;
};

// Sums of whole rows (the inner loop runs along x, contiguous), written transposed, so that the
// same pass done twice treats both axes and restores the order.
Plane<double> sum_rows_transposed(View<const double> in, const std::vector<RowSum> &sums) {
    Plane<double> out(static_cast<int64_t>(sums.size()), in.nx);
    std::vector<double> line(static_cast<size_t>(in.nx));
    for (size_t j = 0; j < sums.size(); ++j) {
        std::fill(line.begin(), line.end(), 0.0);
        for (size_t k = 0; k < sums[j].weight.size(); ++k) {
            const double weight = sums[j].weight[k];
            const double *row = in.row(sums[j].first + static_cast<int64_t>(k));
            for (size_t x = 0; x < line.size(); ++x)
                line[x] += weight * row[x];
        }
        for (size_t x = 0; x < line.size(); ++x)
            out(static_cast<int64_t>(j), static_cast<int64_t>(x)) = line[x];
    }
    return out;
}

std::vector<RowSum> interpolating_sums(const BandlimitedInterpolator &interpolator,
                                       const std::vector<double> &positions) {
    std::vector<RowSum> sums(positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        sums[i].weight.resize(static_cast<size_t>(interpolator.taps()));
        sums[i].first = interpolator.weights(positions[i], sums[i].weight.data());
    }
    return sums;
}

} // namespace

template <class T>
void resample(View<const double> grid, const BandlimitedInterpolator &interpolator,
              const std::vector<double> &x, const std::vector<double> &y, double scale,
              View<T> out) {
    const Plane<double> half = sum_rows_transposed(grid, interpolating_sums(interpolator, y));
    const Plane<double> whole =
        sum_rows_transposed(half.view(), interpolating_sums(interpolator, x));
    for (int64_t j = 0; j < out.ny; ++j)
        for (int64_t i = 0; i < out.nx; ++i)
            out(i, j) = static_cast<T>(scale * whole(i, j));
}

template void resample(View<const double>, const BandlimitedInterpolator &,
                       const std::vector<double> &, const std::vector<double> &, double,
                       View<float>);
template void resample(View<const double>, const BandlimitedInterpolator &,
                       const std::vector<double> &, const std::vector<double> &, double,
                       View<double>);

Plane<double> filter(View<const double> grid, const std::vector<double> &taps) {
    const auto shrunk = [&taps](int64_t n) {
        std::vector<RowSum> sums;
        for (int64_t j = 0; j + static_cast<int64_t>(taps.size()) <= n; ++j)
            sums.push_back({j, taps});
        return sums;
    };
    const Plane<double> half = sum_rows_transposed(grid, shrunk(grid.ny));
    return sum_rows_transposed(half.view(), shrunk(grid.nx));
}

} // namespace wfpsf
