// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/blur.hpp"

#include "numerics/bandlimited.hpp"
#include "numerics/quadrature.hpp"
#include "numerics/sinc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/SVD>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// The interpolator's kernel averaged over a window and a Gaussian, anywhere along one axis, as the
// Fourier integral of what the three do to each frequency.
class BlurredKernel {
  public:
    // The interpolator's kernel holds no frequency above `last`.
    BlurredKernel(const BandlimitedInterpolator &interpolator, double last, double width,
                  double variance, double reach) {
        const GaussLegendre in_frequency(gauss_legendre_points(
            pi * last * (reach + interpolator.half_width() + width / 2), 1e-15));
        const GaussLegendre in_panel(16);
        for (size_t i = 0; i < in_frequency.x.size(); ++i) {
            const double f = last * (1 + in_frequency.x[i]) / 2;
            double transform = 0;
            for (int panel = 0; panel < interpolator.half_width(); ++panel)
                for (size_t k = 0; k < in_panel.x.size(); ++k) {
                    const double t = panel + (1 + in_panel.x[k]) / 2;
                    transform += in_panel.w[k] * interpolator.kernel(t) * std::cos(2 * pi * f * t);
                }
            turn_.push_back(2 * pi * f);
            weight_.push_back(in_frequency.w[i] * last * transform * sinc(width * f) *
                              std::exp(-2 * pi * pi * variance * f * f));
        }
    }

    double operator()(double t) const {
        double sum = 0;
        for (size_t i = 0; i < turn_.size(); ++i)
            sum += weight_[i] * std::cos(turn_[i] * t);
        return sum;
    }

    // At all whole numbers -m..m, moved by `shift`.
    Eigen::VectorXd taps(int m, double shift = 0) const {
        Eigen::VectorXd out(2 * m + 1);
        for (int i = -m; i <= m; ++i)
            out[m + i] = (*this)(i - shift);
        return out;
    }

  private:
    std::vector<double> turn_, weight_;
};

std::vector<double> to_vector(const Eigen::VectorXd &taps) {
    return {taps.begin(), taps.end()};
}

// As few products as the filter allows: its singular vectors, down to `error` in all.
SeparableFilter in_few_terms(const Eigen::MatrixXd &filter, double error) {
    const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> svd(
        filter, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::VectorXd &value = svd.singularValues();
    const auto size = [&](Eigen::Index i) {
        return value[i] * svd.matrixU().col(i).lpNorm<1>() * svd.matrixV().col(i).lpNorm<1>();
    };
    Eigen::Index kept = value.size();
    for (double dropped = 0; kept > 1 && (dropped += size(kept - 1)) < error;)
        --kept;
    SeparableFilter out{{}, 4 * error};
    for (Eigen::Index i = 0; i < kept; ++i)
        out.terms.push_back(
            {to_vector(value[i] * svd.matrixU().col(i)), to_vector(svd.matrixV().col(i))});
    return out;
}

} // namespace

SeparableFilter blurring_filter(double bandwidth, double width, const Covariance &blur,
                                double eps) {
    const BandlimitedInterpolator interpolator(bandwidth, eps / 4);
    const double error = interpolator.error(), last = 1 - bandwidth;
    // Beyond so many standard deviations, and above so many standard deviations in frequency, a
    // Gaussian is below the error.
    const double tail = std::sqrt(2 * std::log(10 / error));
    const double reach = tail * std::sqrt(std::max(blur.xx, blur.yy));
    const int m = static_cast<int>(std::ceil(interpolator.half_width() + width / 2 + reach));
    if (blur.xy == 0)
        return {{{to_vector(BlurredKernel(interpolator, last, width, blur.xx, m).taps(m)),
                  to_vector(BlurredKernel(interpolator, last, width, blur.yy, m).taps(m))}},
                4 * error};

    // The covariance is that of a round Gaussian, which is separable, and one along a line.
    const double middle = (blur.xx + blur.yy) / 2;
    const double excess = std::hypot((blur.xx - blur.yy) / 2, blur.xy);
    const double along = std::sqrt(2 * excess);
    const double angle = std::atan2(blur.xy, (blur.xx - blur.yy) / 2) / 2;
    const BlurredKernel round(interpolator, last, width, std::max(0.0, middle - excess), m + reach);
    // Equal steps along the line: what aliases is a frequency that the Gaussian does not hold.
    const double highest = std::numbers::sqrt2 * last;
    const double step = 1 / (tail / (2 * pi * along) + highest);
    const int steps = static_cast<int>(std::ceil(tail * along / step));
    Eigen::MatrixXd filter = Eigen::MatrixXd::Zero(2 * m + 1, 2 * m + 1);
    for (int i = -steps; i <= steps; ++i) {
        const double t = i * step / along;
        const double weight = step / along / std::sqrt(2 * pi) * std::exp(-t * t / 2);
        filter += weight * round.taps(m, i * step * std::cos(angle)) *
                  round.taps(m, i * step * std::sin(angle)).transpose();
    }
    return in_few_terms(filter, error);
}

} // namespace wfpsf
