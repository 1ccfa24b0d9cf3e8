// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/varying_psf.hpp"

#include "error/error.hpp"
#include "numerics/dispatch.hpp"
#include "optics/add_stars.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Dense>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int largest_degree = 16;

// How eps is shared out: to the exact PSFs, to the fields that are left out, to the interpolation.
constexpr double share_of_exact = 0.4, share_of_modes = 0.05, share_of_places = 0.55;

// Chebyshev's extreme points: those of twice the degree hold those of the degree.
double node(int k, int degree) {
    return degree == 0 ? 0 : std::cos(pi * k / degree);
}

// The values at u of the polynomials that are one at one node and zero at the others (Berrut &
// Trefethen 2004, SIAM Review 46, 501).
std::array<double, largest_degree + 1> lagrange(double u, int degree) {
    std::array<double, largest_degree + 1> values{};
    double sum = 0;
    for (int k = 0; k <= degree; ++k) {
        const double distance = u - node(k, degree);
        if (distance == 0) {
            values.fill(0);
            values[static_cast<size_t>(k)] = 1;
            return values;
        }
        const double weight = (k % 2 ? -1 : 1) * (k == 0 || k == degree ? 0.5 : 1.0) / distance;
        values[static_cast<size_t>(k)] = weight;
        sum += weight;
    }
    for (double &value : values)
        value /= sum;
    return values;
}

// The sum of the first planes on a window, x0 <= x < x1 and the same of y.
struct Window {
    int64_t x0, y0, x1, y1;
};
WFPSF_VECTORISED void sum_planes(const std::vector<Plane<double>> &planes,
                                 std::span<const double> weights, const Window &window,
                                 View<double> out) {
    for (int64_t y = window.y0; y < window.y1; ++y) {
        double *const row = out.row(y);
        std::fill(row + window.x0, row + window.x1, 0.0);
        for (size_t p = 0; p < weights.size(); ++p) {
            const double *const from = planes[p].view().row(y);
            for (int64_t x = window.x0; x < window.x1; ++x)
                row[x] += weights[p] * from[x];
        }
    }
}

Window all_of(View<const double> plane) {
    return {0, 0, plane.nx, plane.ny};
}

// What of a field stamps of that radius are drawn from.
Window reach_of(const Field &field, double radius) {
    const auto half =
        static_cast<int64_t>(std::ceil(radius * static_cast<double>(field.per_pixel))) +
        field.interpolator.half_width() + 1;
    const auto begin = [half](int64_t size) { return std::max<int64_t>(size / 2 - half, 0); };
    const auto end = [half](int64_t size) { return std::min(size / 2 + half + 1, size); };
    const View<const double> all = field.value.view();
    return {begin(all.nx), begin(all.ny), end(all.nx), end(all.ny)};
}

double largest_difference(const Plane<double> &a, const Plane<double> &b) {
    double most = 0;
    for (int64_t y = 0; y < a.ny(); ++y)
        for (int64_t x = 0; x < a.nx(); ++x)
            most = std::max(most, std::abs(a(x, y) - b(x, y)));
    return most;
}

PsfSettings exact_settings(PsfSettings settings, bool varies) {
    if (varies)
        settings.eps *= share_of_exact;
    return settings;
}

} // namespace

VaryingPsf::VaryingPsf(OpticsAt optics, bool varies, Light light, const PsfSettings &settings,
                       const Region &region, const Manners &manners)
    : optics_(std::move(optics)), light_(std::move(light)), settings_(settings), region_(region),
      plain_(std::move(make_fields(
          optics_((region.x0 + region.x1) / 2, (region.y0 + region.y1) / 2), {&light_, 1},
          exact_settings(settings, varies), settings.radius, manners)[0])) {
    const KeptMemory kept;
    exact_psfs_ = 1;
    error_ = plain_.error;
    if (!varies) {
        mode_.push_back(plain_.value);
        share_ = {{1}};
        left_out_ = {plain_.peak, 0};
        return;
    }
    std::vector<Plane<double>> light_at_nodes;
    double done = 0.1; // at each level half of what was left
    for (degree_ = 2;; degree_ *= 2) {
        manners.require_memory(2 * (degree_ + 1) * (degree_ + 1) * plain_.value.nx() *
                                   plain_.value.ny() * static_cast<int64_t>(sizeof(double)),
                               "a PSF that varies so much");
        const double next = (1 + done) / 2;
        light_at_nodes = refined(std::move(light_at_nodes), manners.progress.between(done, next));
        done = next;
        compress(light_at_nodes);
        interpolation_error_ = measured_error();
        if (interpolation_error_ <= share_of_places * settings_.eps || degree_ == largest_degree)
            break;
    }
    error_ += interpolation_error_;
}

Field VaryingPsf::exact(double u, double v) {
    const auto [x, y] = place(u, v);
    Field field = make_field_like(plain_, optics_(x, y), settings_, settings_.radius);
    ++exact_psfs_;
    error_ = std::max(error_, field.error);
    return field;
}

VaryingPsf::Place VaryingPsf::place(double u, double v) const {
    return {std::lerp(region_.x0, region_.x1, (1 + u) / 2),
            std::lerp(region_.y0, region_.y1, (1 + v) / 2)};
}

std::vector<Plane<double>> VaryingPsf::refined(std::vector<Plane<double>> coarse,
                                               const Progress &progress) {
    const int n = degree_ + 1, coarse_n = degree_ / 2 + 1;
    std::vector<Plane<double>> fine(static_cast<size_t>(n * n));
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            progress.report(static_cast<double>(j * n + i) / (n * n));
            Plane<double> &here = fine[static_cast<size_t>(j * n + i)];
            if (!coarse.empty() && i % 2 == 0 && j % 2 == 0)
                here = std::move(coarse[static_cast<size_t>(j / 2 * coarse_n + i / 2)]);
            else
                here = exact(node(i, degree_), node(j, degree_)).value;
        }
    return fine;
}

// The fields at all nodes as sums of as few as will do: their singular vectors.
void VaryingPsf::compress(const std::vector<Plane<double>> &nodes) {
    const int64_t nx = plain_.value.nx(), ny = plain_.value.ny();
    const auto count = static_cast<Eigen::Index>(nodes.size());
    Eigen::MatrixXd fields(nx * ny, count);
    for (Eigen::Index i = 0; i < count; ++i)
        for (int64_t y = 0; y < ny; ++y)
            for (int64_t x = 0; x < nx; ++x)
                fields(y * nx + x, i) = nodes[static_cast<size_t>(i)](x, y);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(fields);
    const Eigen::MatrixXd r = qr.matrixQR().topRows(count).triangularView<Eigen::Upper>();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(r, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::MatrixXd modes = (qr.householderQ() * Eigen::MatrixXd::Identity(nx * ny, count)) *
                                  (svd.matrixU() * svd.singularValues().asDiagonal());
    const auto reach = [&](Eigen::Index k) {
        return modes.col(k).lpNorm<Eigen::Infinity>() *
               svd.matrixV().col(k).lpNorm<Eigen::Infinity>();
    };
    Eigen::Index kept = count;
    for (double left_out = 0;
         kept > 1 &&
         (left_out += reach(kept - 1)) < share_of_modes * settings_.eps * plain_.faintest_peak;)
        --kept;
    left_out_.assign(static_cast<size_t>(kept) + 1, 0);
    for (Eigen::Index k = kept; k-- > 0;)
        left_out_[static_cast<size_t>(k)] = left_out_[static_cast<size_t>(k) + 1] + reach(k);
    mode_.clear();
    share_.assign(nodes.size(), {});
    for (Eigen::Index k = 0; k < kept; ++k) {
        Plane<double> &mode = mode_.emplace_back(Plane<double>::with_aligned_rows(nx, ny));
        for (int64_t y = 0; y < ny; ++y)
            for (int64_t x = 0; x < nx; ++x)
                mode(x, y) = modes(y * nx + x, k);
        for (Eigen::Index i = 0; i < count; ++i)
            share_[static_cast<size_t>(i)].push_back(svd.matrixV()(i, k));
    }
}

// Between the nodes, where polynomials err most: near the corners and the edges, and inside.
double VaryingPsf::measured_error() {
    constexpr double safety = 1.5; // for all places that are not looked at
    const double outer = std::cos(pi / (2 * degree_)), inner = std::sin(pi / (2 * degree_));
    double worst = 0;
    for (const auto &[u, v] :
         {std::pair(outer, outer), std::pair(-outer, outer), std::pair(outer, -outer),
          std::pair(-outer, -inner), std::pair(inner, outer), std::pair(inner, -inner)}) {
        const Field truth = exact(u, v);
        const auto [x, y] = place(u, v);
        Plane<double> light(plain_.value.nx(), plain_.value.ny());
        std::vector<double> weight(mode_.size());
        weights(x, y, weight);
        sum_planes(mode_, weight, all_of(light.view()), light.view());
        worst = std::max(worst, largest_difference(light, truth.value) / truth.faintest_peak);
    }
    return safety * worst;
}

void VaryingPsf::weights(double x, double y, std::span<double> out) const {
    const auto scaled = [](double at, double low, double high) {
        return std::clamp(2 * (at - low) / (high - low) - 1, -1.0, 1.0);
    };
    const auto along_x = lagrange(scaled(x, region_.x0, region_.x1), degree_);
    const auto along_y = lagrange(scaled(y, region_.y0, region_.y1), degree_);
    std::ranges::fill(out, 0.0);
    const auto n = static_cast<size_t>(degree_) + 1;
    for (size_t j = 0; j < n; ++j)
        for (size_t i = 0; i < n; ++i) {
            const double weight = along_x[i] * along_y[j];
            const std::vector<double> &shares = share_[j * n + i];
            for (size_t k = 0; k < out.size(); ++k)
                out[k] += weight * shares[k];
        }
}

bool VaryingPsf::is_inside(double x, double y) const {
    return x >= region_.x0 && x <= region_.x1 && y >= region_.y0 && y <= region_.y1;
}

Psf VaryingPsf::at(double x, double y) const {
    if (!is_inside(x, y))
        fail(WFPSF_ERROR_RANGE, "(x, y) = (%g, %g): must lie in %g..%g, %g..%g", x, y, region_.x0,
             region_.x1, region_.y0, region_.y1);
    Field field = plain_;
    std::vector<double> weight(mode_.size());
    weights(x, y, weight);
    sum_planes(mode_, weight, all_of(field.value.view()), field.value.view());
    field.find_peaks();
    field.error = error_;
    return Psf(optics_(x, y), light_, settings_, std::move(field));
}

template <class T>
void VaryingPsf::add(std::span<const Star> stars, double x0, double y0, int64_t oversampling,
                     View<T> image, int threads) const {
    const auto n = static_cast<double>(oversampling);
    const double radius = settings_.radius * n;
    const auto native = [n](double sample) { return (sample - (n - 1) / 2) / n; };
    // Nothing is added unless all have a PSF.
    for (size_t i = 0; i < stars.size(); ++i) {
        const Star &star = stars[i];
        const double x = x0 + native(star.x), y = y0 + native(star.y);
        const bool seen = star.x >= -radius && star.x <= static_cast<double>(image.nx) + radius &&
                          star.y >= -radius && star.y <= static_cast<double>(image.ny) + radius;
        if (seen && !is_inside(x, y))
            fail(WFPSF_ERROR_RANGE,
                 "star %zu: stands at (%g, %g) of the detector, must lie in %g..%g, %g..%g", i, x,
                 y, region_.x0, region_.x1, region_.y0, region_.y1);
    }
    const StarDetail all{settings_.radius, mode_.size()};
    on_bands_of_rows(image.ny, threads, [&](int64_t first_row, int64_t last_row) {
        add_rows(
            stars, [&all](size_t) -> const StarDetail & { return all; }, x0, y0, oversampling,
            image, first_row, last_row);
    });
}

template <class T>
void VaryingPsf::add_to_rows(std::span<const Star> stars, std::span<const StarDetail> details,
                             double x0, double y0, int64_t oversampling, View<T> image,
                             int64_t first_row, int64_t last_row) const {
    add_rows(
        stars, [&details](size_t i) -> const StarDetail & { return details[i]; }, x0, y0,
        oversampling, image, first_row, last_row);
}

template <class T, class DetailOf>
void VaryingPsf::add_rows(std::span<const Star> stars, DetailOf detail_of, double x0, double y0,
                          int64_t oversampling, View<T> image, int64_t first_row,
                          int64_t last_row) const {
    const auto n = static_cast<double>(oversampling);
    const auto native = [n](double sample) { return (sample - (n - 1) / 2) / n; };
    Field field = plain_;
    std::vector<double> weight(mode_.size());
    add_stars_to_rows(
        stars, [&](size_t i) { return n * detail_of(i).radius; }, oversampling, image, first_row,
        last_row,
        [&](size_t i) -> const Field & {
            const StarDetail &detail = detail_of(i);
            const std::span first(weight.data(), detail.rank);
            weights(x0 + native(stars[i].x), y0 + native(stars[i].y), first);
            sum_planes(mode_, first, reach_of(field, detail.radius), field.value.view());
            return field;
        });
}

int64_t VaryingPsf::memory() const {
    return static_cast<int64_t>((mode_.size() + 1) * sizeof(double)) * plain_.value.nx() *
           plain_.value.ny();
}

template void VaryingPsf::add_to_rows(std::span<const Star>, std::span<const StarDetail>, double,
                                      double, int64_t, View<float>, int64_t, int64_t) const;
template void VaryingPsf::add_to_rows(std::span<const Star>, std::span<const StarDetail>, double,
                                      double, int64_t, View<double>, int64_t, int64_t) const;
template void VaryingPsf::add(std::span<const Star>, double, double, int64_t, View<float>,
                              int) const;
template void VaryingPsf::add(std::span<const Star>, double, double, int64_t, View<double>,
                              int) const;

} // namespace wfpsf
