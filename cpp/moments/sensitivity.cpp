// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/sensitivity.hpp"

#include "error/error.hpp"
#include "moments/merit.hpp"
#include "moments/weight_jet.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace wfpsf {

namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

constexpr double full_reach2 = 74; // exp(-37) is below rounding

WhitenedStep step_of(const Vector5 &p) {
    return {p[0], p[1], p[2], p[3], p[4]};
}

double half_trace(const WhitenedStep &a) {
    return (a.htt + a.hvv) / 2;
}

// The third derivative of ln S along x, y, z, from those of S.
double log_third(double S, double x, double y, double z, double xy, double xz, double yz,
                 double xyz) {
    return xyz / S - (xy * z + xz * y + yz * x) / (S * S) + 2 * x * y * z / (S * S * S);
}

// A direction in which weight and image change together.
struct Direction {
    WhitenedStep step;
    WeightJet change;
    double mean;
};

double mean_of(const WeightedSums &sums, SumOrder order) {
    return sums.sum[order.j][order.k];
}

} // namespace

struct Sensitivity::Solution {
    Gaussian weight;
    MomentsMethod method;
    bool second;
    WeightJet flux;        // of the image
    WeightJet counted;     // of w^2 over the pixels that `count` counts
    WeightJet covered;     // of w over them, if a background is fitted
    double plane, sign;    // Q = plane pi sqrt(det M) + sign counted - covered^2/seen
    double mean, per_seen; // of FitTarget, and 1/n; 0 unless a background is fitted
    Matrix5 inverse = {};  // of -Hessian, over the steps that the method allows
    std::array<WhitenedStep, 5> unit = {};

    template <class T>
    Solution(const FitTarget<T> &target, const Gaussian &at, bool second_order)
        : weight(at), method(target.method), second(second_order),
          flux(weighted_sums(target.image, at, full_reach2, 1, second ? 6 : 4), 1),
          counted(target.count.empty()
                      ? WeightedSums{}
                      : squared_weight_sums(target.count, at, full_reach2, 1, second ? 6 : 4),
                  2),
          covered(target.method == MomentsMethod::with_background
                      ? weighted_sums(target.count, at, full_reach2, 1, second ? 6 : 4)
                      : WeightedSums{},
                  1),
          plane(is_least_squares(method) ? 0 : plane_norm(at).value),
          sign(is_least_squares(method) ? 1 : -1), mean(target.mean),
          per_seen(target.seen > 0 ? 1 / target.seen : 0) {
        for (int i = 0; i < 5; ++i)
            unit[static_cast<size_t>(i)] = step_of(Vector5::Unit(i));
        Matrix5 curvature;
        for (int i = 0; i < 5; ++i)
            for (int k = 0; k < 5; ++k) {
                const WhitenedStep &a = unit[static_cast<size_t>(i)];
                const WhitenedStep &b = unit[static_cast<size_t>(k)];
                const double S = flux.value(), Q = norm();
                curvature(i, k) =
                    -(flux.along(a, b) / S - flux.along(a) * flux.along(b) / (S * S)) +
                    (norm(a, b) / Q - norm(a) * norm(b) / (Q * Q)) / 2;
            }
        if (method == MomentsMethod::round) {
            Eigen::Matrix<double, 5, 3> allowed = Eigen::Matrix<double, 5, 3>::Zero();
            allowed(0, 0) = allowed(1, 1) = 1;
            allowed(2, 2) = allowed(4, 2) = std::numbers::sqrt2 / 2;
            const Eigen::Matrix3d inner = allowed.transpose() * curvature * allowed;
            inverse = allowed * inner.inverse() * allowed.transpose();
        } else {
            inverse = curvature.inverse();
        }
    }

    double norm() const {
        return plane + sign * counted.value() - per_seen * covered.value() * covered.value();
    }
    double norm(const WhitenedStep &a) const {
        return plane * half_trace(a) + sign * counted.along(a) -
               2 * per_seen * covered.value() * covered.along(a);
    }
    double norm(const WhitenedStep &a, const WhitenedStep &b) const {
        return plane * half_trace(a) * half_trace(b) + sign * counted.along(a, b) -
               2 * per_seen *
                   (covered.value() * covered.along(a, b) + covered.along(a) * covered.along(b));
    }
    double norm(const WhitenedStep &a, const WhitenedStep &b, const WhitenedStep &c) const {
        return plane * half_trace(a) * half_trace(b) * half_trace(c) +
               sign * counted.along(a, b, c) -
               2 * per_seen *
                   (covered.value() * covered.along(a, b, c) +
                    covered.along(a) * covered.along(b, c) +
                    covered.along(b) * covered.along(a, c) +
                    covered.along(c) * covered.along(a, b));
    }

    // The sum of I w along a direction, and along a step and a direction, and so on.
    double along(const Direction &z) const { return flux.along(z.step) + z.change.value(); }
    double along(const WhitenedStep &a, const Direction &z) const {
        return flux.along(a, z.step) + z.change.along(a);
    }
    double along(const Direction &y, const Direction &z) const {
        return flux.along(y.step, z.step) + y.change.along(z.step) + z.change.along(y.step);
    }
    double along(const WhitenedStep &a, const Direction &y, const Direction &z) const {
        return flux.along(a, y.step, z.step) + y.change.along(a, z.step) +
               z.change.along(a, y.step);
    }

    // The step that keeps the gradient at zero when the image changes.
    WhitenedStep answer(const WeightJet &change) const {
        Vector5 slope;
        for (int i = 0; i < 5; ++i) {
            const WhitenedStep &a = unit[static_cast<size_t>(i)];
            slope[i] =
                (change.along(a) - change.value() * flux.along(a) / flux.value()) / flux.value();
        }
        return step_of(inverse * slope);
    }

    // The mixed second one: Hessian times it is minus the third derivative of phi along both
    // directions.
    WhitenedStep answer(const Direction &y, const Direction &z) const {
        if (!second)
            return {};
        Vector5 third;
        const double Sy = along(y), Sz = along(z), Syz = along(y, z);
        for (int i = 0; i < 5; ++i) {
            const WhitenedStep &a = unit[static_cast<size_t>(i)];
            third[i] = log_third(flux.value(), flux.along(a), Sy, Sz, along(a, y), along(a, z), Syz,
                                 along(a, y, z)) -
                       log_third(norm(), norm(a), norm(y.step), norm(z.step), norm(a, y.step),
                                 norm(a, z.step), norm(y.step, z.step), norm(a, y.step, z.step)) /
                           2;
        }
        return step_of(inverse * third);
    }

    MomentSet<HyperDual> ellipse(const Direction &y, const Direction &z) const {
        const WhitenedStep mixed = answer(y, z);
        const HyperDual t(0, y.step.t, z.step.t, mixed.t), v(0, y.step.v, z.step.v, mixed.v);
        const HyperDual htt(0, y.step.htt, z.step.htt, mixed.htt);
        const HyperDual hvv(0, y.step.hvv, z.step.hvv, mixed.hvv);
        const HyperDual off = HyperDual(0, y.step.hs, z.step.hs, mixed.hs) / std::numbers::sqrt2;
        const double s = weight.s(), l = weight.root_yy(), k = weight.shear() * l;
        const HyperDual S(flux.value(), along(y), along(z),
                          second ? along(y, z) + flux.along(mixed) : 0);
        const HyperDual Q(norm(), norm(y.step), norm(z.step),
                          second ? norm(y.step, z.step) + norm(mixed) : 0);

        MomentSet<HyperDual> m;
        m.x = weight.x + s * t + k * v;
        m.y = weight.y + l * v;
        // L exp(H) L^T, exp(H) to second order.
        const HyperDual tt = 1.0 + htt + (htt * htt + off * off) / 2.0;
        const HyperDual tv = off + off * (htt + hvv) / 2.0;
        const HyperDual vv = 1.0 + hvv + (hvv * hvv + off * off) / 2.0;
        m.Mxx = s * s * tt + 2 * s * k * tv + k * k * vv;
        m.Mxy = l * (s * tv + k * vv);
        m.Myy = l * l * vv;
        m.flux = 2 * std::numbers::pi * s * l * exp((htt + hvv) / 2.0) * S / Q;
        m.background = mean;
        if (method == MomentsMethod::with_background) {
            const HyperDual P(covered.value(), covered.along(y.step), covered.along(z.step),
                              second ? covered.along(y.step, z.step) + covered.along(mixed) : 0);
            m.background = HyperDual(mean, y.mean, z.mean, 0) - S / Q * P * per_seen;
        }
        if (method == MomentsMethod::round)
            set_round(m, y, z, mixed, S / Q);
        return m;
    }

    // Under a round weight e is that of the weighted moments, missing pixels filled by the fit.
    void set_round(MomentSet<HyperDual> &m, const Direction &y, const Direction &z,
                   const WhitenedStep &mixed, const HyperDual &amplitude) const {
        const auto moment = [&](int i) {
            const WhitenedStep &a = unit[static_cast<size_t>(i)];
            HyperDual seen(flux.along(a), along(a, y), along(a, z), 0);
            HyperDual filled(counted.along(a), counted.along(a, y.step), counted.along(a, z.step),
                             0);
            if (second) {
                seen.dab = along(a, y, z) + flux.along(a, mixed);
                filled.dab = counted.along(a, y.step, z.step) + counted.along(a, mixed);
            }
            return seen + amplitude * filled / 2.0;
        };
        const HyperDual tt = moment(2), tv = moment(3), vv = moment(4);
        set_matrix<HyperDual>(m, m.Mxx, (tt - vv) / (tt + vv),
                              std::numbers::sqrt2 * tv / (tt + vv));
    }
};

template <class T>
Sensitivity::Sensitivity(View<const T> image, const AdaptiveMoments &solution,
                         const AdaptiveOptions &options, View<const float> missing, bool second)
    : solution_(with_target(image, missing, options.background, options.method,
                            [&](const auto &target) {
                                return std::make_unique<const Solution>(target, solution.weight,
                                                                        second);
                            })),
      missing_(missing) {}

Sensitivity::~Sensitivity() = default;
Sensitivity::Sensitivity(Sensitivity &&) noexcept = default;
Sensitivity &Sensitivity::operator=(Sensitivity &&) noexcept = default;

template <class T> ImageChange Sensitivity::change_of(View<const T> change) const {
    return with_target(change, missing_, 0, solution_->method, [&](const auto &target) {
        return ImageChange{weighted_sums(target.image, solution_->weight, full_reach2, 1,
                                         solution_->second ? 4 : 2),
                           target.mean};
    });
}

ImageChange Sensitivity::unit_change(size_t sum) {
    ImageChange change;
    if (sum == mean_sum)
        change.mean = 1;
    else
        change.sums.sum[sum_orders[sum].j][sum_orders[sum].k] = 1;
    return change;
}

MomentSet<HyperDual> Sensitivity::along(const ImageChange &a, const ImageChange &b) const {
    const auto direction = [this](const ImageChange &change) {
        const WeightJet jet(change.sums, 1);
        return Direction{solution_->answer(jet), jet, change.mean};
    };
    return solution_->ellipse(direction(a), direction(b));
}

Sensitivity::Slopes Sensitivity::slopes() const {
    Slopes result;
    for (size_t i = 0; i < std::size(first_sums); ++i) {
        const ImageChange change = unit_change(first_sums[i]);
        const Quantities<HyperDual> by = quantities_of(along(change, change));
        for (size_t q = 0; q < quantities; ++q)
            result[q][i] = by[q].da;
    }
    return result;
}

// With a background to fit the i-th sum answers to a pixel as f_i - mean f_i, f_i = w t^j v^k, and
// the mean as 1/n.
template <class T> Sensitivity::SumCovariance Sensitivity::noise(View<const T> variance) const {
    const auto is_lost = [&](int64_t x, int64_t y) {
        return !missing_.empty() && missing_(x, y) != 0;
    };
    double total = 0;
    for (int64_t y = 0; y < variance.ny; ++y)
        for (int64_t x = 0; x < variance.nx; ++x) {
            const auto value = static_cast<double>(variance(x, y));
            if (is_lost(x, y))
                continue;
            if (!(value >= 0 && std::isfinite(value)))
                fail(std::isfinite(value) ? WFPSF_ERROR_RANGE : WFPSF_ERROR_NOT_FINITE,
                     "variance (%lld, %lld) = %g: must be finite, 0 or more",
                     static_cast<long long>(x), static_cast<long long>(y), value);
            total += value;
        }
    const int order = solution_->second ? 4 : 2;
    const bool with_mean = solution_->method == MomentsMethod::with_background;
    WeightedSums squared, linear;
    with_target(variance, missing_, 0, MomentsMethod::adaptive, [&](const auto &target) {
        squared = squared_weight_sums(target.image, solution_->weight, full_reach2, 1, 2 * order);
        if (with_mean)
            linear = weighted_sums(target.image, solution_->weight, full_reach2, 1, order);
    });
    const double per_seen = solution_->per_seen;
    SumCovariance result{};
    for (size_t a = 0; a < mean_sum; ++a) {
        const SumOrder p = sum_orders[a];
        if (p.j + p.k > order)
            continue;
        const double mean_a = per_seen * mean_of(solution_->covered.sums(), p);
        for (size_t b = 0; b < mean_sum; ++b) {
            const SumOrder q = sum_orders[b];
            if (q.j + q.k > order)
                continue;
            const double mean_b = per_seen * mean_of(solution_->covered.sums(), q);
            result[a][b] = squared.sum[p.j + q.j][p.k + q.k] - mean_a * mean_of(linear, q) -
                           mean_b * mean_of(linear, p) + mean_a * mean_b * total;
        }
        result[a][mean_sum] = result[mean_sum][a] =
            per_seen * (mean_of(linear, p) - mean_a * total);
    }
    result[mean_sum][mean_sum] = per_seen * per_seen * total;
    return result;
}

void Sensitivity::add_influence(const std::array<double, std::size(first_sums)> &c,
                                View<double> out) const {
    const Gaussian &weight = solution_->weight;
    double constant = c[6];
    for (size_t i = 0; i < 6; ++i)
        constant -= c[i] * mean_of(solution_->covered.sums(), sum_orders[first_sums[i]]);
    constant *= solution_->per_seen;
    const double s = weight.s(), l = weight.root_yy(), k = weight.shear();
    for (int64_t y = 0; y < out.ny; ++y)
        for (int64_t x = 0; x < out.nx; ++x) {
            if (!missing_.empty() && missing_(x, y) != 0)
                continue;
            const double dy = static_cast<double>(y) - weight.y, v = dy / l;
            const double t = (static_cast<double>(x) - weight.x - k * dy) / s;
            out(x, y) += constant + std::exp(-(t * t + v * v) / 2) *
                                        (c[0] + c[1] * t + c[2] * v + c[3] * t * t + c[4] * t * v +
                                         c[5] * v * v);
        }
}

template Sensitivity::Sensitivity(View<const float>, const AdaptiveMoments &,
                                  const AdaptiveOptions &, View<const float>, bool);
template Sensitivity::Sensitivity(View<const double>, const AdaptiveMoments &,
                                  const AdaptiveOptions &, View<const float>, bool);
template ImageChange Sensitivity::change_of(View<const float>) const;
template ImageChange Sensitivity::change_of(View<const double>) const;
template Sensitivity::SumCovariance Sensitivity::noise(View<const float>) const;
template Sensitivity::SumCovariance Sensitivity::noise(View<const double>) const;

} // namespace wfpsf
