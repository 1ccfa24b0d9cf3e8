// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/varying_psf.hpp"

#include "error/error.hpp"
#include "image/sampling.hpp"
#include "numerics/dispatch.hpp"
#include "optics/add_stars.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

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

// Chebyshev's polynomials at u.
std::array<double, largest_degree + 1> chebyshev(double u, int degree) {
    std::array<double, largest_degree + 1> values{1, u};
    for (int k = 2; k <= degree; ++k) {
        const auto at = static_cast<size_t>(k);
        values[at] = 2 * u * values[at - 1] - values[at - 2];
    }
    return values;
}

// From values at the nodes to the coefficients of Chebyshev's polynomials: [coefficient][node].
std::vector<std::vector<double>> to_coefficients(int degree) {
    const auto ends = [degree](int k) { return k == 0 || k == degree ? 0.5 : 1.0; };
    std::vector<std::vector<double>> matrix;
    for (int k = 0; k <= degree; ++k) {
        std::vector<double> &row = matrix.emplace_back();
        for (int j = 0; j <= degree; ++j)
            row.push_back(2.0 / degree * ends(k) * ends(j) * std::cos(pi * j * k / degree));
    }
    return matrix;
}

WFPSF_VECTORISED void add_scaled(double weight, const double *__restrict values, int64_t count,
                                 double *__restrict sums) {
    for (int64_t i = 0; i < count; ++i)
        sums[i] += weight * values[i];
}

// What of a field stamps of that radius are drawn from: rows and columns begin <= i < end.
struct Window {
    int64_t begin, end;
};
Window reach_of(const Field &field, double radius, int64_t margin = 0) {
    const auto half =
        static_cast<int64_t>(std::ceil(radius * static_cast<double>(field.per_pixel))) +
        field.interpolator.half_width() + margin;
    const int64_t size = field.value.nx();
    return {std::max<int64_t>(size / 2 - half, 0), std::min(size / 2 + half + 1, size)};
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
        mode_.push_back({0, 0, plain_.peak, plain_.value});
        find_left_out();
        return;
    }
    std::vector<Plane<double>> light_at_nodes;
    double done = 0.1; // at each level half of what was left
    double radius = settings_.radius;
    for (degree_ = 2;; degree_ *= 2) {
        manners.require_memory(2 * (degree_ + 1) * (degree_ + 1) * plain_.value.nx() *
                                   plain_.value.ny() * static_cast<int64_t>(sizeof(double)),
                               "a PSF that varies so much");
        const double next = (1 + done) / 2;
        light_at_nodes =
            refined(std::move(light_at_nodes), radius, manners.progress.between(done, next));
        done = next;
        expand(light_at_nodes, radius);
        radius = measure(radius);
        if (radius == 0 || degree_ == largest_degree)
            break;
    }
    error_ += interpolation_error_;
}

Field VaryingPsf::exact(double u, double v, double radius) {
    const auto [x, y] = place(u, v);
    Field field = make_field_like(plain_, optics_(x, y), settings_, radius);
    ++exact_psfs_;
    error_ = std::max(error_, field.error);
    return field;
}

VaryingPsf::Place VaryingPsf::place(double u, double v) const {
    return {std::lerp(region_.x0, region_.x1, (1 + u) / 2),
            std::lerp(region_.y0, region_.y1, (1 + v) / 2)};
}

std::vector<Plane<double>> VaryingPsf::refined(std::vector<Plane<double>> coarse, double radius,
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
                here = exact(node(i, degree_), node(j, degree_), radius).value;
        }
    return fine;
}

// A row of all nodes at a time, along one axis of the detector and then the other. Farther from the
// star coefficients stay what they were.
void VaryingPsf::expand(const std::vector<Plane<double>> &nodes, double radius) {
    const int n = degree_ + 1;
    const int64_t size = plain_.value.nx();
    const std::vector<std::vector<double>> matrix = to_coefficients(degree_);
    const auto [begin, end] = reach_of(plain_, radius);
    const int64_t count = end - begin;
    std::vector<Mode> coarse = std::exchange(mode_, {});
    for (int j = 0; j < n; ++j)
        for (int i = 0; i + j < n; ++i) {
            const auto before = std::ranges::find_if(
                coarse, [i, j](const Mode &mode) { return mode.i == i && mode.j == j; });
            mode_.push_back(
                {i, j, 0,
                 before == coarse.end() ? Plane<double>(size, size) : std::move(before->light)});
        }
    Plane<double> along_x(count, n);
    for (int64_t y = begin; y < end; ++y) {
        for (Mode &mode : mode_)
            std::fill_n(mode.light.view().row(y) + begin, count, 0.0);
        for (int i = 0; i < n; ++i) {
            std::fill_n(along_x.view().data, count * n, 0.0);
            for (int row = 0; row < n; ++row)
                for (int column = 0; column < n; ++column) {
                    const Plane<double> &light = nodes[static_cast<size_t>(row * n + column)];
                    const int64_t edge = (size - light.nx()) / 2; // that it lacks
                    add_scaled(matrix[static_cast<size_t>(i)][static_cast<size_t>(column)],
                               light.view().row(y - edge) + begin - edge, count,
                               along_x.view().row(row));
                }
            for (Mode &mode : mode_)
                if (mode.i == i)
                    for (int row = 0; row < n; ++row)
                        add_scaled(matrix[static_cast<size_t>(mode.j)][static_cast<size_t>(row)],
                                   along_x.view().row(row), count,
                                   mode.light.view().row(y) + begin);
        }
    }
    for (Mode &mode : mode_)
        for (int64_t y = 0; y < size; ++y)
            for (int64_t x = 0; x < size; ++x)
                mode.largest = std::max(mode.largest, std::abs(mode.light(x, y)));
    std::ranges::stable_sort(mode_, std::ranges::greater(), &Mode::largest);
    double left_out = 0;
    while (mode_.size() > 1 && (left_out += mode_.back().largest) <
                                   share_of_modes * settings_.eps * plain_.faintest_peak)
        mode_.pop_back();
    find_left_out();
}

void VaryingPsf::find_left_out() {
    const auto rings = static_cast<size_t>(std::ceil(settings_.radius)) + 1;
    left_out_.assign(rings, std::vector<double>(mode_.size() + 1, 0));
    std::vector<double> brightest(rings);
    for (size_t k = mode_.size(); k-- > 0;) {
        const Plane<double> &light = mode_[k].light;
        const int64_t centre = light.nx() / 2;
        std::ranges::fill(brightest, 0);
        for (int64_t y = 0; y < light.ny(); ++y)
            for (int64_t x = 0; x < light.nx(); ++x) {
                const int64_t off = std::max(std::abs(x - centre), std::abs(y - centre));
                double &most =
                    brightest[std::min(static_cast<size_t>(off / plain_.per_pixel), rings - 1)];
                most = std::max(most, std::abs(light(x, y)));
            }
        for (size_t r = rings; r-- > 0;) {
            if (r + 1 < rings)
                brightest[r] = std::max(brightest[r], brightest[r + 1]);
            left_out_[r][k] = left_out_[r][k + 1] + brightest[r];
        }
    }
}

std::vector<double> VaryingPsf::field_radii(double radius, double left_out) const {
    std::vector<double> radii;
    size_t r = left_out_.size(); // beyond r - 1 all is left out that comes after the first k modes
    for (size_t k = 0; k < mode_.size(); ++k) {
        while (r > 0 && left_out_[r - 1][k] <= left_out)
            --r;
        if (r == 0)
            break;
        radii.push_back(std::min(radius, static_cast<double>(r)));
    }
    return radii;
}

// Between the nodes, where polynomials err most: near the corners and the edges, and inside.
double VaryingPsf::measure(double radius) {
    constexpr double safety = 1.5; // for all places that are not looked at
    const double outer = std::cos(pi / (2 * degree_)), inner = std::sin(pi / (2 * degree_));
    std::vector<double> by_ring(static_cast<size_t>(std::ceil(settings_.radius)) + 2);
    for (const auto &[u, v] :
         {std::pair(outer, outer), std::pair(-outer, outer), std::pair(outer, -outer),
          std::pair(-outer, -inner), std::pair(inner, outer), std::pair(inner, -inner)}) {
        const Field truth = exact(u, v, radius);
        const auto [x, y] = place(u, v);
        const Field sum = sum_at(x, y);
        const auto [begin, end] = reach_of(plain_, radius);
        const int64_t edge = (sum.value.nx() - truth.value.nx()) / 2, centre = sum.value.nx() / 2;
        for (int64_t j = begin; j < end; ++j)
            for (int64_t i = begin; i < end; ++i) {
                const int64_t off = std::max(std::abs(i - centre), std::abs(j - centre));
                double &most =
                    by_ring[std::min(static_cast<size_t>(off / sum.per_pixel), by_ring.size() - 1)];
                most = std::max(
                    most, safety * std::abs(sum.value(i, j) - truth.value(i - edge, j - edge)) /
                              truth.faintest_peak);
            }
    }
    const double allowed = share_of_places * settings_.eps;
    size_t wrong = by_ring.size(); // rings within
    while (wrong > 0 && by_ring[wrong - 1] <= allowed)
        --wrong;
    const double worst_there = *std::ranges::max_element(by_ring);
    const double worst_beyond =
        wrong < by_ring.size()
            ? *std::max_element(by_ring.begin() + static_cast<std::ptrdiff_t>(wrong), by_ring.end())
            : 0;
    interpolation_error_ = std::max(error_beyond_, worst_there);
    error_beyond_ = std::max(error_beyond_, worst_beyond);
    return std::min(radius, static_cast<double>(wrong));
}

void VaryingPsf::weights(double x, double y, std::span<double> out) const {
    const auto scaled = [](double at, double low, double high) {
        return std::clamp(2 * (at - low) / (high - low) - 1, -1.0, 1.0);
    };
    const auto along_x = chebyshev(scaled(x, region_.x0, region_.x1), degree_);
    const auto along_y = chebyshev(scaled(y, region_.y0, region_.y1), degree_);
    for (size_t k = 0; k < out.size(); ++k)
        out[k] =
            along_x[static_cast<size_t>(mode_[k].i)] * along_y[static_cast<size_t>(mode_[k].j)];
}

Field VaryingPsf::sum_at(double x, double y) const {
    std::vector<double> weight(mode_.size());
    weights(x, y, weight);
    Field field = plain_;
    field.value = Plane<double>(field.value.nx(), field.value.ny());
    for (size_t k = 0; k < mode_.size(); ++k)
        for (int64_t row = 0; row < field.value.ny(); ++row)
            add_scaled(weight[k], mode_[k].light.view().row(row), field.value.nx(),
                       field.value.view().row(row));
    return field;
}

bool VaryingPsf::is_inside(double x, double y) const {
    return x >= region_.x0 && x <= region_.x1 && y >= region_.y0 && y <= region_.y1;
}

Psf VaryingPsf::at(double x, double y) const {
    if (!is_inside(x, y))
        fail(WFPSF_ERROR_RANGE, "(x, y) = (%g, %g): must lie in %g..%g, %g..%g", x, y, region_.x0,
             region_.x1, region_.y0, region_.y1);
    Field field = sum_at(x, y);
    field.find_peaks();
    field.error = error_;
    return Psf(optics_(x, y), light_, settings_, std::move(field));
}

template <class T>
void VaryingPsf::add(std::span<const Star> stars, double x0, double y0, int64_t oversampling,
                     View<T> image, int threads) const {
    const auto n = static_cast<double>(oversampling);
    const double radius = settings_.radius * n;
    // Nothing is added unless all have a PSF.
    for (size_t i = 0; i < stars.size(); ++i) {
        const Star &star = stars[i];
        const double x = x0 + native_of(star.x, n), y = y0 + native_of(star.y, n);
        const bool seen = star.x >= -radius && star.x <= static_cast<double>(image.nx) + radius &&
                          star.y >= -radius && star.y <= static_cast<double>(image.ny) + radius;
        if (seen && !is_inside(x, y))
            fail(WFPSF_ERROR_RANGE,
                 "star %zu: stands at (%g, %g) of the detector, must lie in %g..%g, %g..%g", i, x,
                 y, region_.x0, region_.x1, region_.y0, region_.y1);
    }
    const std::vector<double> radii(mode_.size(), settings_.radius);
    const StarDetail all{settings_.radius, radii};
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
    Field field = plain_;
    std::vector<double> weight(mode_.size());
    std::vector<Window> windows; // of the modes
    add_stars_to_rows(
        stars, [&](size_t i) { return n * detail_of(i).radius; }, oversampling, image, first_row,
        last_row,
        [&](size_t i) -> const Field & {
            const StarDetail &detail = detail_of(i);
            const std::span first(weight.data(), detail.field_radii.size());
            weights(x0 + native_of(stars[i].x, n), y0 + native_of(stars[i].y, n), first);
            windows.clear();
            for (const double radius : detail.field_radii)
                windows.push_back(reach_of(field, radius, 1));
            const auto [begin, end] = reach_of(field, detail.radius, 1);
            for (int64_t y = begin; y < end; ++y) {
                double *const row = field.value.view().row(y);
                std::fill(row + begin, row + end, 0.0);
                for (size_t k = 0; k < first.size(); ++k)
                    if (y >= windows[k].begin && y < windows[k].end)
                        add_scaled(first[k], mode_[k].light.view().row(y) + windows[k].begin,
                                   windows[k].end - windows[k].begin, row + windows[k].begin);
            }
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
