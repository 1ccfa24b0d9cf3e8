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
};

} // namespace

struct Sensitivity::Solution {
    Gaussian weight;
    MomentsMethod method;
    bool second;
    WeightJet flux;       // of the image
    WeightJet counted;    // of w^2 over the pixels that `count` counts
    double plane, sign;   // Q = plane pi sqrt(det M) + sign times the above
    Matrix5 inverse = {}; // of -Hessian, over the steps that the method allows
    std::array<WhitenedStep, 5> unit = {};

    template <class T>
    Solution(const FitTarget<T> &target, const Gaussian &at, bool second_order)
        : weight(at), method(target.method), second(second_order),
          flux(weighted_sums(target.image, at, full_reach2, 1, second ? 6 : 4), 1),
          counted(target.count.empty()
                      ? WeightedSums{}
                      : squared_weight_sums(target.count, at, full_reach2, 1, second ? 6 : 4),
                  2),
          plane(method == MomentsMethod::least_squares ? 0 : plane_norm(at).value),
          sign(method == MomentsMethod::least_squares ? 1 : -1) {
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

    double norm() const { return plane + sign * counted.value(); }
    double norm(const WhitenedStep &a) const {
        return plane * half_trace(a) + sign * counted.along(a);
    }
    double norm(const WhitenedStep &a, const WhitenedStep &b) const {
        return plane * half_trace(a) * half_trace(b) + sign * counted.along(a, b);
    }
    double norm(const WhitenedStep &a, const WhitenedStep &b, const WhitenedStep &c) const {
        return plane * half_trace(a) * half_trace(b) * half_trace(c) +
               sign * counted.along(a, b, c);
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

template <class T> WeightedSums Sensitivity::sums_of(View<const T> change) const {
    return with_target(change, missing_, 0, MomentsMethod::adaptive, [&](const auto &target) {
        return weighted_sums(target.image, solution_->weight, full_reach2, 1,
                             solution_->second ? 4 : 2);
    });
}

MomentSet<HyperDual> Sensitivity::along(const WeightedSums &a, const WeightedSums &b) const {
    const WeightJet first(a, 1), second(b, 1);
    return solution_->ellipse({solution_->answer(first), first},
                              {solution_->answer(second), second});
}

MomentSet<HyperDual> Sensitivity::by_sum(int i) const {
    WeightedSums sums;
    switch (i) {
    case 0:
        sums.sum[0][0] = 1;
        break;
    case 1:
        sums.sum[1][0] = 1;
        break;
    case 2:
        sums.sum[0][1] = 1;
        break;
    case 3:
        sums.sum[2][0] = 2;
        break;
    case 4:
        sums.sum[1][1] = std::numbers::sqrt2;
        break;
    default:
        sums.sum[0][2] = 2;
    }
    const WeightJet change(sums, 1);
    const Direction direction{solution_->answer(change), change};
    return solution_->ellipse(direction, direction);
}

template <class T>
std::array<std::array<double, 6>, 6> Sensitivity::noise(View<const T> variance) const {
    for (int64_t y = 0; y < variance.ny; ++y)
        for (int64_t x = 0; x < variance.nx; ++x) {
            const auto value = static_cast<double>(variance(x, y));
            const bool lost = !missing_.empty() && missing_(x, y) != 0;
            if (!lost && !(value >= 0 && std::isfinite(value)))
                fail(std::isfinite(value) ? WFPSF_ERROR_RANGE : WFPSF_ERROR_NOT_FINITE,
                     "variance (%lld, %lld) = %g: must be finite, 0 or more",
                     static_cast<long long>(x), static_cast<long long>(y), value);
        }
    const WeightedSums sums =
        with_target(variance, missing_, 0, MomentsMethod::adaptive, [&](const auto &target) {
            return squared_weight_sums(target.image, solution_->weight, full_reach2);
        });
    // The six functions are scale t^j v^k.
    constexpr double half = 0.5, root = std::numbers::sqrt2 / 2;
    constexpr int j[6] = {0, 1, 0, 2, 1, 0}, k[6] = {0, 0, 1, 0, 1, 2};
    constexpr double scale[6] = {1, 1, 1, half, root, half};
    std::array<std::array<double, 6>, 6> result{};
    for (size_t a = 0; a < 6; ++a)
        for (size_t b = 0; b < 6; ++b)
            result[a][b] = scale[a] * scale[b] * sums.sum[j[a] + j[b]][k[a] + k[b]];
    return result;
}

void influence_image(const Gaussian &weight, const std::array<double, 6> &coefficients,
                     View<const float> missing, View<double> out) {
    const double s = weight.s(), l = weight.root_yy(), k = weight.shear();
    for (int64_t y = 0; y < out.ny; ++y)
        for (int64_t x = 0; x < out.nx; ++x) {
            if (!missing.empty() && missing(x, y) != 0) {
                out(x, y) = 0;
                continue;
            }
            const double dy = static_cast<double>(y) - weight.y, v = dy / l;
            const double t = (static_cast<double>(x) - weight.x - k * dy) / s;
            const auto &c = coefficients;
            out(x, y) = std::exp(-(t * t + v * v) / 2) *
                        (c[0] + c[1] * t + c[2] * v + c[3] * t * t / 2 +
                         c[4] * t * v / std::numbers::sqrt2 + c[5] * v * v / 2);
        }
}

template Sensitivity::Sensitivity(View<const float>, const AdaptiveMoments &,
                                  const AdaptiveOptions &, View<const float>, bool);
template Sensitivity::Sensitivity(View<const double>, const AdaptiveMoments &,
                                  const AdaptiveOptions &, View<const float>, bool);
template WeightedSums Sensitivity::sums_of(View<const float>) const;
template WeightedSums Sensitivity::sums_of(View<const double>) const;
template std::array<std::array<double, 6>, 6> Sensitivity::noise(View<const float>) const;
template std::array<std::array<double, 6>, 6> Sensitivity::noise(View<const double>) const;

} // namespace wfpsf
