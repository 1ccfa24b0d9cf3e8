// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/varying_psf.hpp"

#include "error/error.hpp"
#include "image/sampling.hpp"
#include "numerics/chebyshev.hpp"
#include "optics/add_stars.hpp"
#include "optics/cell_psf.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace wfpsf {

namespace {

constexpr int largest_degree = largest_chebyshev_degree;

// Native pixels beyond the radius that fields reach: a stamp's pixels are polynomials of the star's
// place all over the pixel that holds it.
constexpr double margin = 1;

// How eps is shared out: to the exact PSFs, to the fields that are left out, to the interpolation,
// and to what is left out of single stars.
constexpr double share_of_exact = 0.4, share_of_modes = 0.05, share_of_places = 0.45,
                 share_of_stars = 0.1;
// How that is shared out in turn: to the coefficients for all places, to a cell's polynomials, to its
// coefficients, and to stars.
constexpr double share_of_all = 0.1, share_of_cells = 0.25, share_of_building = 0.25,
                 share_of_drawing = 0.4;

// Rows and columns begin <= i < end of a field that stamps of that radius are drawn from.
struct Window {
    int64_t begin, end;
};
Window reach_of(const Field &field, double radius) {
    const auto half = samples_within(radius, field.per_pixel, field.interpolator.half_width());
    const int64_t size = field.value.nx();
    return {std::max<int64_t>(size / 2 - half, 0), std::min(size / 2 + half + 1, size)};
}

PsfSettings exact_settings(PsfSettings settings, bool varies) {
    if (varies)
        settings.eps *= share_of_exact;
    return settings;
}

// Chebyshev's extreme points of all degrees, and those half way between, are among those of twice
// the largest one: at the cosines of multiples of pi / finest.
constexpr int finest = 2 * largest_degree;
struct Node {
    int a, b;
    double u() const { return chebyshev_node(a, finest); }
    double v() const { return chebyshev_node(b, finest); }
    auto operator<=>(const Node &) const = default;
};

Node node_of(int i, int j, int degree) {
    if (degree == 0)
        return {finest / 2, finest / 2};
    return {finest / degree * i, finest / degree * j};
}

// Where polynomials through the nodes err most: half way between them near the corners and the
// edges, and inside. Many are nodes of the next degree.
std::vector<Node> tests_of(int degree) {
    constexpr int middle = finest / 2, last = finest;
    if (degree == 0)
        return {{0, 0}, {last, last}};
    if (degree == 1) // which lacks T_1(x) T_1(y): the nodes too
        return {{middle, middle}, {0, middle}, {middle, 0}, {0, 0}, {last, 0}, {0, last}};
    const int outer = finest / (2 * degree), inner = middle - outer;
    return {{outer, outer},        {last - outer, outer},
            {outer, last - outer}, {last - outer, last - inner},
            {inner, outer},        {inner, last - inner}};
}

} // namespace

// Exact fields, each made once.
class VaryingPsf::ExactFields {
  public:
    explicit ExactFields(const VaryingPsf &of) : of_(of), error_(of.plain_.error) {
        fields_.emplace(node_of(0, 0, 0), of.plain_);
    }

    // Made to reach `radius` native pixels, where it was not made before.
    const Field &at(const Node &node, double radius) {
        const auto found = fields_.find(node);
        if (found != fields_.end())
            return found->second;
        const auto [x, y] = of_.place(node.u(), node.v());
        const Field &field = fields_
                                 .emplace(node, make_field_like(of_.plain_, of_.optics_(x, y),
                                                                of_.settings_, radius))
                                 .first->second;
        error_ = std::max(error_, field.error);
        return field;
    }
    int64_t count() const { return static_cast<int64_t>(fields_.size()); }
    double error() const { return error_; } // of any

  private:
    const VaryingPsf &of_;
    std::map<Node, Field> fields_;
    double error_;
};

VaryingPsf::VaryingPsf(OpticsAt optics, bool varies, Light light, const PsfSettings &settings,
                       const Region &region, const Manners &manners)
    : optics_(std::move(optics)), light_(std::move(light)), settings_(settings), region_(region),
      plain_(std::move(make_fields(
          optics_((region.x0 + region.x1) / 2, (region.y0 + region.y1) / 2), {&light_, 1},
          exact_settings(settings, varies), settings.radius + margin, manners)[0])) {
    const KeptMemory kept;
    exact_psfs_ = 1;
    error_ = plain_.error;
    mode_.push_back({0, 0, plain_.value, {}});
    mode_[0].find_brightest(plain_.per_pixel);
    if (!varies)
        return;
    for (const double brightest : mode_[0].brightest)
        falls_.push_back(std::max(error_far_off, std::sqrt(brightest / mode_[0].largest())));
    ExactFields exact(*this);
    double done = 0.1; // at each level half of what was left
    double radius = settings_.radius + margin;
    for (const int degree : {0, 1, 2, 4, 8, largest_degree}) {
        degree_ = degree;
        manners.require_memory(2 * (degree_ + 1) * (degree_ + 1) * plain_.value.nx() *
                                   plain_.value.ny() * static_cast<int64_t>(sizeof(double)),
                               "a PSF that varies so much");
        const double next = (1 + done) / 2;
        expand(exact, radius, manners.progress.between(done, next));
        done = next;
        radius = measure(exact, radius);
        if (radius == 0)
            break;
    }
    exact_psfs_ = exact.count();
    left_out_ = share_of_stars * settings_.eps * plain_.faintest_peak;
    error_ = exact.error() + interpolation_error_ + share_of_stars * settings_.eps;
}

VaryingPsf::Place VaryingPsf::place(double u, double v) const {
    return {std::lerp(region_.x0, region_.x1, (1 + u) / 2),
            std::lerp(region_.y0, region_.y1, (1 + v) / 2)};
}

// A row of all nodes at a time, along one axis of the detector and then the other. Farther from the
// star coefficients stay what they were.
void VaryingPsf::expand(ExactFields &exact, double radius, const Progress &progress) {
    const int n = degree_ + 1;
    std::vector<const Plane<double> *> nodes;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            progress.report(static_cast<double>(j * n + i) / (n * n));
            nodes.push_back(&exact.at(node_of(i, j, degree_), radius).value);
        }
    const int64_t size = plain_.value.nx();
    const std::vector<std::vector<double>> matrix = chebyshev_coefficients(degree_);
    const auto [begin, end] = reach_of(plain_, radius);
    const int64_t count = end - begin;
    std::vector<LightMode> coarse = std::exchange(mode_, {});
    for (int j = 0; j < n; ++j)
        for (int i = 0; i + j < n; ++i) {
            const auto before = std::ranges::find_if(
                coarse, [i, j](const LightMode &mode) { return mode.i == i && mode.j == j; });
            mode_.push_back(
                {i,
                 j,
                 before == coarse.end() ? Plane<double>(size, size) : std::move(before->light),
                 {}});
        }
    Plane<double> along_x(count, n);
    for (int64_t y = begin; y < end; ++y) {
        for (LightMode &mode : mode_)
            std::fill_n(mode.light.view().row(y) + begin, count, 0.0);
        for (int i = 0; i < n; ++i) {
            std::fill_n(along_x.view().data, count * n, 0.0);
            for (int row = 0; row < n; ++row)
                for (int column = 0; column < n; ++column) {
                    const Plane<double> &light = *nodes[static_cast<size_t>(row * n + column)];
                    const int64_t edge = (size - light.nx()) / 2; // that it lacks
                    add_scaled(matrix[static_cast<size_t>(i)][static_cast<size_t>(column)],
                               light.view().row(y - edge) + begin - edge, count,
                               along_x.view().row(row));
                }
            for (LightMode &mode : mode_)
                if (mode.i == i)
                    for (int row = 0; row < n; ++row)
                        add_scaled(matrix[static_cast<size_t>(mode.j)][static_cast<size_t>(row)],
                                   along_x.view().row(row), count,
                                   mode.light.view().row(y) + begin);
        }
    }
    for (LightMode &mode : mode_)
        mode.find_brightest(plain_.per_pixel);
    std::ranges::stable_sort(mode_, std::ranges::greater(), &LightMode::largest);
    const LeftOut left_out(mode_, std::vector<double>(mode_.size(), 1));
    const double little = share_of_modes * settings_.eps * plain_.faintest_peak;
    while (mode_.size() > 1 && left_out.but_for(mode_.size() - 1) < little)
        mode_.pop_back();
}

double VaryingPsf::measure(ExactFields &exact, double radius) {
    const double safety = degree_ == 0 ? 2 : 1.5; // for all places that are not looked at
    std::vector<double> by_ring(falls_.size());
    for (const Node &node : tests_of(degree_)) {
        const Field &truth = exact.at(node, radius);
        const auto [x, y] = place(node.u(), node.v());
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
    size_t wrong = by_ring.size(); // rings within
    while (wrong > 0 && by_ring[wrong - 1] <= share_of_places * settings_.eps * falls_[wrong - 1])
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

VaryingPsf::Place VaryingPsf::scaled(double x, double y) const {
    const auto scaled = [](double at, double low, double high) {
        return std::clamp(2 * (at - low) / (high - low) - 1, -1.0, 1.0);
    };
    return {scaled(x, region_.x0, region_.x1), scaled(y, region_.y0, region_.y1)};
}

Field VaryingPsf::sum_at(double x, double y) const {
    const auto [u, v] = scaled(x, y);
    const auto along_u = chebyshev(u, degree_), along_v = chebyshev(v, degree_);
    Field field = plain_;
    field.value = Plane<double>(field.value.nx(), field.value.ny());
    for (const LightMode &mode : mode_)
        add_within(along_u[static_cast<size_t>(mode.i)] * along_v[static_cast<size_t>(mode.j)],
                   mode.light, mode.light.nx(), field.value);
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
    const StarDetail all{settings_.radius, share_of_stars * settings_.eps * plain_.faintest_peak};
    add(stars, std::vector(stars.size(), all), x0, y0, oversampling, image, threads);
}

// Stars whose PSFs are those of one cell.
struct VaryingPsf::CellStars {
    DetectorCell cell;
    double radius = 0, left_out = INFINITY; // of any
    std::vector<size_t> stars;
};

std::vector<VaryingPsf::CellStars> VaryingPsf::by_cell(std::span<const size_t> which,
                                                       std::span<const Place> places,
                                                       std::span<const StarDetail> details) const {
    // Stars that may lack little need small cells, and have theirs apart from others. Many stars
    // are worth more cells than they need: nearer to the middle fewer corrections count.
    struct Class {
        size_t stars = 0;
        int64_t across = 0; // cells along each axis
    };
    std::map<double, Class> classes; // by left_out
    for (const size_t i : which)
        ++classes[details[i].left_out].stars;
    constexpr size_t enough = 400; // in a cell
    constexpr int64_t most = 64;
    for (auto &[left_out, own] : classes) {
        own.across = cells_across(mode_, share_of_cells * left_out, most);
        while (own.across > 0 && 2 * own.across <= most &&
               own.stars > enough * static_cast<size_t>(4 * own.across * own.across))
            own.across *= 2;
    }
    struct Key {
        int64_t across, b, a; // cells along each axis, and which
        auto operator<=>(const Key &) const = default;
    };
    std::map<Key, CellStars> cells;
    std::vector<CellStars> all;
    const auto alone = [&](size_t i) {
        all.push_back({{places[i].x, places[i].y, 0}, details[i].radius, details[i].left_out, {i}});
    };
    for (const size_t i : which) {
        const StarDetail &detail = details[i];
        const int64_t across = classes[detail.left_out].across;
        if (across == 0) {
            alone(i);
            continue;
        }
        const double half = 1 / static_cast<double>(across);
        const auto along = [across, half](double at) {
            return std::min(static_cast<int64_t>((at + 1) / (2 * half)), across - 1);
        };
        const Key key{across, along(places[i].y), along(places[i].x)};
        CellStars &cell = cells[key];
        cell.cell = {half * static_cast<double>(2 * key.a + 1 - across),
                     half * static_cast<double>(2 * key.b + 1 - across), half};
        cell.radius = std::max(cell.radius, detail.radius);
        cell.left_out = std::min(cell.left_out, detail.left_out);
        cell.stars.push_back(i);
    }
    constexpr size_t few = 30; // stars, that take no longer one by one
    for (auto &[key, cell] : cells) {
        if (cell.stars.size() > few)
            all.push_back(std::move(cell));
        else
            std::ranges::for_each(cell.stars, alone);
    }
    return all;
}

template <class T>
void VaryingPsf::add(std::span<const Star> stars, std::span<const StarDetail> details, double x0,
                     double y0, int64_t oversampling, View<T> image, int threads) const {
    const auto n = static_cast<double>(oversampling);
    std::vector<Place> places;
    double low = INFINITY, high = -INFINITY; // rows
    for (size_t i = 0; i < stars.size(); ++i) {
        const Star &star = stars[i];
        places.push_back(scaled(x0 + native_of(star.x, n), y0 + native_of(star.y, n)));
        low = std::min(low, star.y - n * details[i].radius);
        high = std::max(high, star.y + n * details[i].radius);
    }
    if (image.empty() || stars.empty())
        return;
    const auto on_rows = [&](const auto &work) {
        on_bands_of_rows(low, high, image.ny, threads, [&](int64_t first_row, int64_t last_row) {
            const KeptMemory kept;
            StarRows<T> rows(oversampling, image, first_row, last_row);
            work(rows);
        });
    };
    // From coefficients of type S, unless they are so few that making those takes longer; returns
    // the others, and those that coefficients will not do for.
    const auto by_cells = [&]<class S>(S, const std::vector<size_t> &which) {
        constexpr size_t few = 100;
        if (which.size() < few)
            return which;
        StarDetail most{0, INFINITY};
        for (const size_t i : which) {
            most.radius = std::max(most.radius, details[i].radius);
            most.left_out = std::min(most.left_out, details[i].left_out);
        }
        const CellPsf<S> all(mode_, plain_, most.radius, oversampling, share_of_all * most.left_out,
                             threads);
        std::vector<size_t> served, others;
        for (const size_t i : which)
            (all.serves(share_of_all * details[i].left_out) ? served : others).push_back(i);
        const std::vector<CellStars> cells = by_cell(served, places, details);
        on_rows([&](StarRows<T> &rows) {
            CellPsf<S> anywhere(all);
            for (const CellStars &cell : cells) {
                const bool alone = cell.cell.half == 0;
                std::optional<CellPsf<S>> own;
                for (const size_t i : cell.stars) {
                    if (!rows.reached_by(stars[i], details[i].radius))
                        continue;
                    if (!alone && !own)
                        own.emplace(all, cell.cell, share_of_building * cell.left_out);
                    (alone ? anywhere : *own)
                        .add(stars[i], places[i].x, places[i].y, details[i].radius,
                             share_of_drawing * details[i].left_out, rows);
                }
            }
        });
        return others;
    };
    std::vector<size_t> loose, tight;
    constexpr double rounding = 1e-6; // of a few sums
    for (size_t i = 0; i < stars.size(); ++i)
        (details[i].left_out > rounding * mode_[0].largest() ? loose : tight).push_back(i);
    std::vector<size_t> alone = by_cells(float(), loose);
    std::ranges::copy(by_cells(double(), tight), std::back_inserter(alone));
    on_rows([&](StarRows<T> &rows) {
        for (const size_t i : alone) {
            const auto &[radius, left_out] = details[i];
            if (!rows.reached_by(stars[i], radius))
                continue;
            if (mode_.size() == 1)
                rows.add(plain_, stars[i], radius);
            else
                rows.add(field_at(mode_, places[i].x, places[i].y, plain_, radius, left_out),
                         stars[i], radius);
        }
    });
}

int64_t VaryingPsf::memory() const {
    return static_cast<int64_t>((mode_.size() + 1) * sizeof(double)) * plain_.value.nx() *
           plain_.value.ny();
}

template void VaryingPsf::add(std::span<const Star>, std::span<const StarDetail>, double, double,
                              int64_t, View<float>, int) const;
template void VaryingPsf::add(std::span<const Star>, std::span<const StarDetail>, double, double,
                              int64_t, View<double>, int) const;
template void VaryingPsf::add(std::span<const Star>, double, double, int64_t, View<float>,
                              int) const;
template void VaryingPsf::add(std::span<const Star>, double, double, int64_t, View<double>,
                              int) const;

} // namespace wfpsf
