// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/covariance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Dense>

namespace wfpsf {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using SumMatrix = Eigen::Matrix<double, change_sums, change_sums>;

SumMatrix matrix_of(const Sensitivity::SumCovariance &c) {
    return Eigen::Map<const SumMatrix>(&c[0][0]);
}

bool is_first(size_t sum) {
    return std::find(std::begin(first_sums), std::end(first_sums), sum) != std::end(first_sums);
}

// Second derivatives of every quantity by pairs of sums. One of a pair is always of first_sums: the
// weight answers to those only.
std::array<SumMatrix, quantities> curvatures(const Sensitivity &sensitivity, bool with_mean) {
    std::array<SumMatrix, quantities> result;
    result.fill(SumMatrix::Zero());
    const size_t count = with_mean ? change_sums : mean_sum;
    for (size_t i = 0; i < count; ++i)
        for (size_t k = i; k < count; ++k) {
            if (!is_first(i) && !is_first(k))
                continue;
            const auto by = quantities_of(
                sensitivity.along(Sensitivity::unit_change(i), Sensitivity::unit_change(k)));
            for (size_t q = 0; q < quantities; ++q)
                result[q](static_cast<int>(i), static_cast<int>(k)) =
                    result[q](static_cast<int>(k), static_cast<int>(i)) = by[q].dab;
        }
    return result;
}

// Half of the trace of curvature times noise: along the noise's principal axes there are fewer
// second derivatives to take than by pairs of sums.
Quantities<double> bias_of(const Sensitivity &sensitivity, const SumMatrix &noise) {
    const Eigen::SelfAdjointEigenSolver<SumMatrix> axes(noise);
    Quantities<double> bias{};
    for (int m = 0; m < static_cast<int>(change_sums); ++m) {
        const double variance = axes.eigenvalues()[m];
        if (!(variance > 0))
            continue;
        ImageChange change;
        for (size_t i = 0; i < change_sums; ++i) {
            const double part = axes.eigenvectors()(static_cast<int>(i), m);
            if (i == mean_sum)
                change.mean = part;
            else
                change.sums.sum[sum_orders[i].j][sum_orders[i].k] = part;
        }
        const auto along = quantities_of(sensitivity.along(change, change));
        for (size_t q = 0; q < quantities; ++q)
            bias[q] += along[q].dab * variance / 2;
    }
    return bias;
}

} // namespace

// With q = q0 + D n + n H n/2 + T n n n/6 and normal noise n of covariance C, the covariance of q
// and r is
//   D C D' + tr(H C H' C)/2 + (D C (T' : C) + D' C (T : C))/2
// up to noise^6, primed for r. T : C is twice the derivative of the bias H : C/2 by the pixels;
// that along the image C D comes from a central difference.
template <class T, class V>
MomentsCovariance covariance(View<const T> image, const AdaptiveMoments &solution,
                             const AdaptiveOptions &options, View<const float> missing,
                             View<const V> variance, int order) {
    const bool second = order > 1, with_mean = options.method == MomentsMethod::with_background;
    const Sensitivity sensitivity(image, solution, options, missing, second);
    const Sensitivity::Slopes slopes = sensitivity.slopes();
    const Sensitivity::SumCovariance sums = sensitivity.noise(variance);
    MomentsCovariance result{};
    for (size_t q = 0; q < quantities; ++q)
        for (size_t r = 0; r < quantities; ++r)
            for (size_t i = 0; i < std::size(first_sums); ++i)
                for (size_t k = 0; k < std::size(first_sums); ++k)
                    result[q][r] +=
                        slopes[q][i] * sums[first_sums[i]][first_sums[k]] * slopes[r][k];
    if (!second)
        return result;

    const SumMatrix noise = matrix_of(sums);
    const auto curvature = curvatures(sensitivity, with_mean);
    std::array<SumMatrix, quantities> curved;
    for (size_t q = 0; q < quantities; ++q)
        curved[q] = curvature[q] * noise;

    // The derivatives of the bias along the image change that noise makes of one sum.
    const auto biased = [&](const Plane<double> &direction, double h) {
        Plane<double> moved(image.nx, image.ny);
        for (int64_t y = 0; y < image.ny; ++y)
            for (int64_t x = 0; x < image.nx; ++x)
                moved(x, y) = static_cast<double>(image(x, y)) + h * direction(x, y);
        AdaptiveOptions precise = options;
        precise.tolerance = std::min(options.tolerance, 1e-8);
        precise.restart = false;
        const View<const double> pixels = std::as_const(moved).view();
        const AdaptiveMoments there = adaptive_moments(pixels, solution.weight, precise, missing);
        Quantities<double> bias;
        bias.fill(nan);
        if (there.status < 0)
            return bias;
        const Sensitivity at(pixels, there, options, missing, true);
        return bias_of(at, matrix_of(at.noise(variance)));
    };
    Sensitivity::Slopes bias_slopes{};
    for (size_t i = 0; i < std::size(first_sums); ++i) {
        const double deviation = std::sqrt(sums[first_sums[i]][first_sums[i]]);
        if (!(deviation > 0))
            continue;
        Plane<double> direction(image.nx, image.ny);
        std::array<double, std::size(first_sums)> one{};
        one[i] = 1;
        sensitivity.add_influence(one, direction.view());
        for (int64_t y = 0; y < image.ny; ++y)
            for (int64_t x = 0; x < image.nx; ++x)
                if (direction(x, y) != 0)
                    direction(x, y) *= static_cast<double>(variance(x, y));
        const double h = 0.1 / deviation;
        const auto up = biased(direction, h), down = biased(direction, -h);
        for (size_t q = 0; q < quantities; ++q)
            bias_slopes[q][i] = (up[q] - down[q]) / (2 * h);
    }
    for (size_t q = 0; q < quantities; ++q)
        for (size_t r = 0; r < quantities; ++r) {
            double sum = curved[q].cwiseProduct(curved[r].transpose()).sum() / 2;
            for (size_t i = 0; i < std::size(first_sums); ++i)
                sum += slopes[q][i] * bias_slopes[r][i] + slopes[r][i] * bias_slopes[q][i];
            result[q][r] += sum;
        }
    for (size_t q = 0; q < quantities; ++q)
        if (result[q][q] < 0)
            for (size_t r = 0; r < quantities; ++r)
                result[q][r] = result[r][q] = nan;
    return result;
}

template MomentsCovariance covariance(View<const float>, const AdaptiveMoments &,
                                      const AdaptiveOptions &, View<const float>, View<const float>,
                                      int);
template MomentsCovariance covariance(View<const float>, const AdaptiveMoments &,
                                      const AdaptiveOptions &, View<const float>,
                                      View<const double>, int);
template MomentsCovariance covariance(View<const double>, const AdaptiveMoments &,
                                      const AdaptiveOptions &, View<const float>, View<const float>,
                                      int);
template MomentsCovariance covariance(View<const double>, const AdaptiveMoments &,
                                      const AdaptiveOptions &, View<const float>,
                                      View<const double>, int);

} // namespace wfpsf
