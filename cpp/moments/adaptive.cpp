// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments/adaptive.hpp"

#include "error/error.hpp"
#include "moments/merit.hpp"
#include "moments/start.hpp"
#include "moments/weighted_sums.hpp"
#include "numerics/quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <numbers>

#include <Eigen/Dense>

namespace wfpsf {

namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

// Projects on the steps that a method may take.
Matrix5 allowed_steps(MomentsMethod method) {
    Matrix5 projector = Matrix5::Identity();
    if (method == MomentsMethod::round) {
        projector(3, 3) = 0;
        projector(2, 2) = projector(2, 4) = projector(4, 2) = projector(4, 4) = 0.5;
    }
    return projector;
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double longest_step = 0.7;
constexpr double narrowest_start = 1.2; // pixels; below, iterations fall onto single pixels
// Sums over pixels of a Gaussian of sigma/sqrt(2) differ from integrals by 2 exp(-(pi sigma)^2),
// and second moments by 2 (pi sigma)^2 times that: 1% here.
constexpr double narrowest_sampled = 0.9;
constexpr double samples_per_sigma = 1.7; // thin grids keep that: aliasing then is about 1e-3
constexpr double longest_reach2 = 90;
constexpr double rounding = 1e-13;
constexpr double least_seen = 1e-9; // of the integral of w^2
constexpr double degenerate = 1e-3; // smallest curvature that counts as well determined

// Far from the solution a pass may see fewer pixels: a shorter reach, and a thin grid if the weight
// is wide. Both are wrong by less than the step that follows.
struct Plan {
    double reach2;
    int64_t stride;
    bool final;
};

[[gnu::format(printf, 3, 4)]] void report(AdaptiveMoments &result, wfpsf_status status,
                                          const char *format, ...) {
    char text[240];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    result.status = status;
    result.line = text;
}

// By how much pixels beyond the reach could move the solution if they are as bright as the rim's.
// Their share of the gradient is at most the integral of rho^2 exp(-rho^2/2) beyond the reach,
// 2 pi sqrt(det M)(reach2 + 2) exp(-reach2/2), times |I|/sum(w I); the inverse Hessian is about 8.
// `rim` is 2 pi sqrt(det M)|I|/sum(w I).
double truncation_error(double reach2, double rim) {
    return 8 * rim * (reach2 + 2) * std::exp(-reach2 / 2);
}

double reach2_for(double error, double rim) {
    double reach2 = std::max(24.0, 2 * std::log(3 / error));
    while (truncation_error(reach2, rim) > error / 3 && reach2 < longest_reach2)
        reach2 += 1;
    return reach2;
}

// Integral over y of the normal density times the share of each row inside [-1/2, nx - 1/2].
double edge_fraction(const Gaussian &g, int64_t nx, int64_t ny) {
    const double reach = 6;
    const auto width = static_cast<double>(nx), height = static_cast<double>(ny);
    const double rx = reach * std::sqrt(g.Mxx), ry = reach * std::sqrt(g.Myy);
    if (g.x - rx > -0.5 && g.x + rx < width - 0.5 && g.y - ry > -0.5 && g.y + ry < height - 0.5)
        return 0;
    static const GaussLegendre rule(32);
    const double root = g.root_yy(), s = g.s(), shear = g.shear();
    const double low = std::max(-reach, (-0.5 - g.y) / root);
    const double high = std::min(reach, (height - 0.5 - g.y) / root);
    double inside = 0;
    for (int i = 0; i < rule.size() && low < high; ++i) {
        const auto k = static_cast<size_t>(i);
        const double v = (low + high) / 2 + (high - low) / 2 * rule.x[k];
        const double centre = g.x + shear * root * v, scale = s * std::numbers::sqrt2;
        const double row =
            (std::erf((width - 0.5 - centre) / scale) - std::erf((-0.5 - centre) / scale)) / 2;
        inside += rule.w[k] * (high - low) / 2 * row * std::exp(-v * v / 2);
    }
    return 1 - inside / std::sqrt(2 * std::numbers::pi);
}

// Names the first pixel that is seen and no number, if there is one.
template <class T>
bool report_not_finite(View<const T> image, View<const float> missing, AdaptiveMoments &result) {
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x)
            if (!std::isfinite(image(x, y)) && (missing.empty() || missing(x, y) == 0)) {
                report(result, WFPSF_ERROR_NOT_FINITE, "pixel (%lld, %lld) = %g: must be finite",
                       static_cast<long long>(x), static_cast<long long>(y),
                       static_cast<double>(image(x, y)));
                return true;
            }
    return false;
}

// Why no start was found: pixels that are not numbers, or no light.
template <class T> void report_no_start(View<const T> image, AdaptiveMoments &result) {
    if (report_not_finite(image, {}, result))
        return;
    report(result, WFPSF_ERROR_MOMENTS_FLUX, "no weight finds positive flux in the image");
}

template <class T> class Iteration {
  public:
    Iteration(const FitTarget<T> &target, const AdaptiveOptions &options, AdaptiveMoments &result)
        : target_(target), image_(target.image), options_(options), result_(result),
          allowed_(allowed_steps(options.method)) {}

    void run(const Gaussian &start) {
        here_ = start;
        result_.status = WFPSF_OK;
        result_.line.clear();
        result_.error_estimate = result_.curvature = 0;
        first_pass_ = result_.passes;
        while (result_.status == WFPSF_OK && !done_)
            pass();
        set_ellipticity();
        result_.missing_fraction = target_.missing_fraction(result_.weight, longest_reach2);
        result_.background =
            target_.background(result_.weight, result_.amplitude(), longest_reach2);
        result_.edge_fraction = edge_fraction(result_.weight, image_.nx, image_.ny);
        if (done_ && result_.edge_fraction > 0.5)
            report(result_, WFPSF_ERROR_MOMENTS_FILLS_IMAGE,
                   "edge_fraction = %.3g: more than half of the weight lies beyond the border",
                   result_.edge_fraction);
    }

  private:
    const FitTarget<T> &target_;
    View<const T> image_;
    const AdaptiveOptions &options_;
    AdaptiveMoments &result_;
    Matrix5 allowed_;

    Gaussian here_, base_; // the iterate, and the one it was stepped from
    WhitenedStep step_;    // from base_ to here_
    double last_step_ = infinity;
    bool last_was_newton_ = false;
    double last_value_ = -infinity;
    Plan plan_{0, 0, false};
    double rim_ = 0;       // largest relative rim of all passes
    double stiffness_ = 1; // a Gaussian's curvature over the smallest here
    double round_e1_ = 0, round_e2_ = 0;
    int first_pass_ = 0, thin_passes_ = 0, shrinks_ = 0;
    bool done_ = false;

    Plan next_plan() {
        const double width = std::sqrt(here_.minor_variance());
        const double reach2 = std::max(plan_.final ? plan_.reach2 : 0,
                                       reach2_for(options_.tolerance / stiffness_, rim_));
        const auto coarse = static_cast<int64_t>(width / samples_per_sigma);
        // All but exact on a smooth image: then one pass over all pixels remains.
        const auto fine = static_cast<int64_t>(width / (2 * samples_per_sigma));
        const bool far = last_step_ > 0.02;
        if (thin_passes_ < 6 && (far ? coarse : fine) > 1 && last_step_ > 1e-4) {
            ++thin_passes_;
            return far ? Plan{24, coarse, false} : Plan{reach2, fine, false};
        }
        if (far)
            return {24, 1, false};
        return {reach2, 1, true};
    }

    void pass() {
        if (result_.passes - first_pass_ >= options_.max_passes) {
            report(result_, WFPSF_WARNING_NOT_CONVERGED,
                   "max_passes = %d: reached with a step of %.3g", options_.max_passes, last_step_);
            return;
        }
        const Plan plan = next_plan();
        const WeightedSums sums = weighted_sums(image_, here_, plan.reach2, plan.stride);
        const Merit norm = target_.norm(here_, plan.reach2, plan.stride);
        ++result_.passes;
        result_.pixels += sums.pixels;
        record(sums, norm);
        const bool comparable = plan.stride == plan_.stride && plan.reach2 == plan_.reach2;
        plan_ = plan;
        if (sums.pixels == 0 || !(norm.value > least_seen * plane_norm(here_).value))
            report(result_, WFPSF_ERROR_MOMENTS_NO_PIXELS,
                   "no pixel within reach of the weight at (%.6g, %.6g)", here_.x, here_.y);
        else if (!all_finite(sums))
            name_bad_pixel(plan);
        else if (!(sums.sum[0][0] > 0))
            shrink(WFPSF_ERROR_MOMENTS_FLUX);
        else
            improve(sums, norm, comparable);
    }

    // The amplitude of the fit is sum(w I)/Q. Missing pixels count as filled by the fit.
    void record(const WeightedSums &sums, const Merit &norm) {
        const double amplitude = sums.sum[0][0] / norm.value;
        const double plane = plane_norm(here_).value;
        result_.weight = here_;
        result_.flux = 2 * plane * amplitude;
        WeightedSums filled = sums;
        if (!is_least_squares(target_.method) && !target_.count.empty()) {
            const WeightedSums missing =
                squared_weight_sums(target_.count, here_, plan_.reach2, plan_.stride);
            for (int j = 0; j <= 4; ++j)
                for (int k = 0; j + k <= 4; ++k)
                    filled.sum[j][k] += amplitude * missing.sum[j][k];
        }
        result_.rho4 = filled.mean(4, 0) + 2 * filled.mean(2, 2) + filled.mean(0, 4);
        round_e1_ =
            (filled.mean(2, 0) - filled.mean(0, 2)) / (filled.mean(2, 0) + filled.mean(0, 2));
        round_e2_ = 2 * filled.mean(1, 1) / (filled.mean(2, 0) + filled.mean(0, 2));
    }

    static bool all_finite(const WeightedSums &sums) {
        double total = 0;
        for (int j = 0; j < 5; ++j)
            for (int k = 0; j + k < 5; ++k)
                total += 0 * sums.sum[j][k];
        return total == 0;
    }

    void name_bad_pixel(const Plan &plan) {
        const Span rows = rows_within(here_, plan.reach2, image_.ny);
        for (int64_t y = rows.first; y <= rows.last; ++y) {
            const Span columns = columns_within(here_, plan.reach2, image_.nx, y);
            for (int64_t x = columns.first; x <= columns.last; ++x)
                if (!std::isfinite(image_(x, y))) {
                    report(result_, WFPSF_ERROR_NOT_FINITE,
                           "pixel (%lld, %lld) = %g: must be finite within reach of the weight",
                           static_cast<long long>(x), static_cast<long long>(y),
                           static_cast<double>(image_(x, y)));
                    return;
                }
        }
        report(result_, WFPSF_ERROR_NOT_FINITE,
               "the weighted sums overflow at (%.6g, %.6g): scale the image down", here_.x,
               here_.y);
    }

    void set_ellipticity() {
        const Gaussian &w = result_.weight;
        const bool round = options_.method == MomentsMethod::round;
        result_.e1 = round ? round_e1_ : (w.Mxx - w.Myy) / (w.Mxx + w.Myy);
        result_.e2 = round ? round_e2_ : 2 * w.Mxy / (w.Mxx + w.Myy);
    }

    // Goes back to a quarter of the last step.
    void shrink(wfpsf_status reason) {
        if (last_step_ == infinity || ++shrinks_ > 12) {
            report(result_, reason,
                   reason == WFPSF_ERROR_MOMENTS_FLUX
                       ? "the weighted flux is not positive near (%.6g, %.6g)"
                       : "no step from (%.6g, %.6g) improves the fit",
                   here_.x, here_.y);
            return;
        }
        step_ = step_ * 0.25;
        last_was_newton_ = false;
        here_ = base_.moved(step_);
    }

    void improve(const WeightedSums &sums, const Merit &norm, bool comparable) {
        const Merit phi = merit(sums, norm);
        // Far out phi must not fall. Near the solution its changes drown in the truncation error.
        if (comparable && last_step_ > 1e-3 && phi.value < last_value_ - 1e-6) {
            shrink(WFPSF_ERROR_MOMENTS_STALLED);
            return;
        }
        last_value_ = phi.value;
        shrinks_ = 0;
        rim_ = std::max(rim_,
                        sums.rim * 2 * std::numbers::pi * std::sqrt(here_.det()) / sums.sum[0][0]);

        const Vector5 gradient = allowed_ * Eigen::Map<const Vector5>(phi.gradient);
        const Matrix5 hessian = Eigen::Map<const Matrix5>(&phi.hessian[0][0]);
        const Matrix5 curvature =
            -allowed_ * hessian * allowed_ + (Matrix5::Identity() - allowed_) / 2;
        result_.gradient = gradient.norm();
        const Eigen::LLT<Matrix5> factor(curvature);
        const bool newton = factor.info() == Eigen::Success;
        Vector5 change;
        if (newton)
            change = factor.solve(gradient);
        else // the Hessian of a Gaussian: the over-relaxed fixed-point step
            change << 2 * gradient.head<2>(), 8 * gradient.tail<3>();
        WhitenedStep step{change[0], change[1], change[2], change[3], change[4]};
        const double length = step.norm();
        if (length > longest_step)
            step = step * (longest_step / length);

        result_.last_step = length;
        if (newton)
            finish_if_good(gradient, log(norm), curvature, step, length);
        else if (plan_.final && length < options_.tolerance)
            report(result_, WFPSF_ERROR_MOMENTS_STALLED,
                   "the solution at (%.6g, %.6g) is a saddle point, not a maximum", here_.x,
                   here_.y);
        if (done_ || result_.status != WFPSF_OK)
            return;
        last_was_newton_ = newton && length <= longest_step;
        last_step_ = std::min(length, longest_step);
        step_ = step;
        base_ = here_;
        here_ = here_.moved(step);
        check_bounds();
    }

    // Newton's steps shrink quadratically: after a step d_k the error is kappa d_k^2, with
    // kappa = d_k/d_(k-1)^2 of the last two.
    void finish_if_good(const Vector5 &gradient, const Merit &log_norm, const Matrix5 &curvature,
                        const WhitenedStep &step, double length) {
        if (!plan_.final || length > longest_step)
            return;
        const double kappa =
            last_was_newton_ ? std::max(1.0, length / (last_step_ * last_step_)) : 2;
        const double remaining = std::min(length, kappa * length * length);
        // The factor 100 serves rho4, which is not corrected for the last step.
        if (remaining > 0.3 * options_.tolerance || length > 100 * options_.tolerance)
            return;
        const double smallest =
            Eigen::SelfAdjointEigenSolver<Matrix5>(curvature, Eigen::EigenvaluesOnly)
                .eigenvalues()[0];
        stiffness_ = std::max(1.0, 0.125 / smallest);
        const double truncation = stiffness_ * truncation_error(plan_.reach2, rim_);
        if (truncation > options_.tolerance / 2 && plan_.reach2 < longest_reach2)
            return; // again with a longer reach, now that rim and stiffness are known
        result_.curvature = smallest;
        result_.error_estimate = remaining + truncation + stiffness_ * rounding;
        // The step's effect on the flux, to second order: ln F = phi - ln(Q)/2 + ln(det M)/2 + ...
        const Vector5 change(step.t, step.v, step.htt, step.hs, step.hvv);
        const Vector5 norm_gradient = Eigen::Map<const Vector5>(log_norm.gradient);
        result_.flux *=
            std::exp(0.5 * (gradient - norm_gradient).dot(change) + (step.htt + step.hvv) / 2);
        result_.weight = here_.moved(step);
        done_ = true;
    }

    void check_bounds() {
        const double minor = here_.minor_variance(), major = here_.major_variance();
        const auto nx = static_cast<double>(image_.nx), ny = static_cast<double>(image_.ny);
        const double minimum = options_.sigma_min * options_.sigma_min;
        if (!(minor >= minimum))
            report(result_, WFPSF_ERROR_MOMENTS_UNRESOLVED,
                   "the minor axis fell to %.3g pixels at (%.6g, %.6g): must stay above "
                   "sigma_min = %.3g",
                   std::sqrt(std::max(0.0, minor)), here_.x, here_.y, options_.sigma_min);
        else if (!(std::sqrt(major) <= std::max({nx, ny, 10.0})))
            report(result_, WFPSF_ERROR_MOMENTS_FILLS_IMAGE,
                   "the major axis grew to %.3g pixels: the image has %.0f x %.0f",
                   std::sqrt(major), nx, ny);
        else if (!(here_.x >= -0.5 && here_.x <= nx - 0.5 && here_.y >= -0.5 &&
                   here_.y <= ny - 0.5))
            report(result_, WFPSF_ERROR_MOMENTS_OUTSIDE,
                   "the centroid went to (%.6g, %.6g): the image has %.0f x %.0f", here_.x, here_.y,
                   nx, ny);
    }
};

void check(const std::optional<Gaussian> &guess, const AdaptiveOptions &options) {
    if (!(options.tolerance >= 1e-12 && options.tolerance <= 0.1))
        fail(WFPSF_ERROR_RANGE, "tolerance = %g: must be 1e-12..0.1", options.tolerance);
    if (options.max_passes < 1)
        fail(WFPSF_ERROR_RANGE, "max_passes = %d: must be 1 or more", options.max_passes);
    if (!(options.sigma_min > 0 && options.sigma_min <= narrowest_start))
        fail(WFPSF_ERROR_RANGE, "sigma_min = %g: must be above 0 and at most %g", options.sigma_min,
             narrowest_start);
    if (!std::isfinite(options.background))
        fail(WFPSF_ERROR_NOT_FINITE, "background = %g: must be finite", options.background);
    if (!guess)
        return;
    if (!std::isfinite(guess->x + guess->y + guess->Mxx + guess->Mxy + guess->Myy))
        fail(WFPSF_ERROR_NOT_FINITE, "guess = (%g, %g; %g, %g, %g): must be finite", guess->x,
             guess->y, guess->Mxx, guess->Mxy, guess->Myy);
    if (!(guess->Mxx > 0 && guess->Myy > 0 && guess->det() > 0))
        fail(WFPSF_ERROR_RANGE, "guess M = (%g, %g, %g): must be positive definite", guess->Mxx,
             guess->Mxy, guess->Myy);
}

Gaussian widened(Gaussian guess) {
    const double missing = narrowest_start * narrowest_start - guess.minor_variance();
    if (missing > 0) {
        guess.Mxx += missing;
        guess.Myy += missing;
    }
    return guess;
}

} // namespace

double AdaptiveMoments::sigma() const {
    return std::sqrt(std::sqrt(weight.det()));
}
double AdaptiveMoments::sigma_trace() const {
    return std::sqrt(weight.Mxx + weight.Myy);
}
double AdaptiveMoments::e() const {
    return std::hypot(e1, e2);
}
double AdaptiveMoments::beta() const {
    return std::atan2(e2, e1) / 2;
}
double AdaptiveMoments::amplitude() const {
    return flux / (2 * std::numbers::pi * std::sqrt(weight.det()));
}

namespace {

template <class T>
AdaptiveMoments solve(const FitTarget<T> &target, const std::optional<Gaussian> &guess,
                      const AdaptiveOptions &options) {
    AdaptiveMoments result;
    if (guess)
        Iteration<T>(target, options, result).run(widened(*guess));
    if (!guess || (options.restart && result.status != WFPSF_OK)) {
        const std::optional<Gaussian> start = scale_space_start(target.image);
        if (start)
            Iteration<T>(target, options, result).run(widened(*start));
        else
            report_no_start(target.image, result);
        if (guess && result.status == WFPSF_OK)
            report(result, WFPSF_WARNING_RESTARTED,
                   "no solution from the guess at (%.6g, %.6g); found one at (%.6g, %.6g)",
                   guess->x, guess->y, result.weight.x, result.weight.y);
    }
    if (result.status < 0 || result.status == WFPSF_WARNING_NOT_CONVERGED)
        return result;
    if (result.curvature < degenerate)
        report(result, WFPSF_WARNING_NEAR_DEGENERATE,
               "curvature = %.3g: the moments are poorly determined below %g", result.curvature,
               degenerate);
    else if (!is_least_squares(options.method) &&
             result.weight.minor_variance() < narrowest_sampled * narrowest_sampled)
        report(
            result, WFPSF_WARNING_UNDERSAMPLED,
            "the minor axis is %.3g pixels: below %g the moments depend on where the pixels fall",
            std::sqrt(result.weight.minor_variance()), narrowest_sampled);
    else if (result.error_estimate > options.tolerance)
        report(result, WFPSF_WARNING_NOT_CONVERGED, "error_estimate = %.3g: above tolerance = %.3g",
               result.error_estimate, options.tolerance);
    return result;
}

bool none_seen(View<const float> missing) {
    for (int64_t y = 0; y < missing.ny; ++y)
        for (int64_t x = 0; x < missing.nx; ++x)
            if (missing(x, y) == 0)
                return false;
    return !missing.empty();
}

} // namespace

template <class T>
AdaptiveMoments adaptive_moments(View<const T> image, const std::optional<Gaussian> &guess,
                                 const AdaptiveOptions &options, View<const float> missing) {
    check(guess, options);
    if (image.empty() || none_seen(missing)) {
        AdaptiveMoments result;
        report(result, WFPSF_ERROR_MOMENTS_NO_PIXELS, "the image has %lld x %lld pixels%s",
               static_cast<long long>(image.nx), static_cast<long long>(image.ny),
               image.empty() ? "" : ", all of them missing");
        return result;
    }
    // Every pixel tells of the background, beyond the weight's reach too.
    if (options.method == MomentsMethod::with_background) {
        AdaptiveMoments result;
        if (report_not_finite(image, missing, result))
            return result;
    }
    return with_target(image, missing, options.background, options.method,
                       [&](const auto &target) { return solve(target, guess, options); });
}

template AdaptiveMoments adaptive_moments(View<const float>, const std::optional<Gaussian> &,
                                          const AdaptiveOptions &, View<const float>);
template AdaptiveMoments adaptive_moments(View<const double>, const std::optional<Gaussian> &,
                                          const AdaptiveOptions &, View<const float>);

} // namespace wfpsf
