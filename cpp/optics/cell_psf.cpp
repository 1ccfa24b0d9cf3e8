// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/cell_psf.hpp"

#include "numerics/chebyshev.hpp"
#include "optics/resample.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace wfpsf {

namespace {

constexpr int degree = 2; // of the polynomials within a cell

// T_i along one axis of a cell, i = 0, 1, ...: coefficients of T_0, T_1 and T_2 of -1..1 within it,
// by Chebyshev's roots.
using Within = std::array<std::array<double, degree + 1>, largest_chebyshev_degree + 1>;
Within within(double middle, double half) {
    constexpr int nodes = degree + 1;
    Within of{};
    for (int k = 0; k < nodes; ++k) {
        const double node = std::cos(std::numbers::pi * (k + 0.5) / nodes);
        const auto basis = chebyshev(node, degree);
        const auto value = chebyshev(middle + half * node, largest_chebyshev_degree);
        for (size_t i = 0; i < of.size(); ++i)
            for (size_t a = 0; a < of[i].size(); ++a)
                of[i][a] += (a == 0 ? 1.0 : 2.0) / nodes * value[i] * basis[a];
    }
    return of;
}

// In any of so many cells along an axis: the largest coefficients of T_i within, and how far they
// are off.
struct Largest {
    std::array<double, largest_chebyshev_degree + 1> linear{}, square{}, missed{};

    explicit Largest(int64_t cells) {
        const double half = 1.0 / static_cast<double>(cells);
        for (int64_t cell = 0; cell < cells; ++cell)
            look_at(half * static_cast<double>(2 * cell + 1 - cells), half);
    }
    // Of T_i(u) T_j(v).
    double misses(int i, int j) const {
        const auto at_u = static_cast<size_t>(i), at_v = static_cast<size_t>(j);
        return missed[at_u] + (1 + missed[at_u]) * missed[at_v] + linear[at_u] * square[at_v] +
               square[at_u] * linear[at_v] + square[at_u] * square[at_v];
    }

  private:
    void look_at(double middle, double half) {
        constexpr int places = 16;
        const Within of = within(middle, half);
        for (size_t i = 0; i < of.size(); ++i) {
            linear[i] = std::max(linear[i], std::abs(of[i][1]));
            square[i] = std::max(square[i], std::abs(of[i][2]));
        }
        for (int k = 0; k <= places; ++k) {
            const double at = 2.0 * k / places - 1;
            const auto basis = chebyshev(at, degree);
            const auto value = chebyshev(middle + half * at, largest_chebyshev_degree);
            for (size_t i = 0; i < of.size(); ++i)
                missed[i] = std::max(missed[i], std::abs(value[i] - of[i][0] - of[i][1] * basis[1] -
                                                         of[i][2] * basis[2]));
        }
    }
};

Field without_light(const Field &like, int64_t half) {
    Field field(like.interpolator);
    field.per_pixel = like.per_pixel;
    field.value = Plane<double>(2 * half + 1, 2 * half + 1);
    return field;
}

int64_t half_of(const Field &field, double radius) {
    return samples_within(radius, field.per_pixel, field.interpolator.half_width() + 1);
}

// Samples of an image that stamps of a radius take on either side of the one next to the star.
int64_t stamp_half(double radius, int64_t oversampling) {
    constexpr double rounding = 1e-6;
    return static_cast<int64_t>(radius * static_cast<double>(oversampling) + 0.5 + rounding);
}

} // namespace

int64_t cells_across(std::span<const LightMode> modes, double lacks) {
    constexpr int64_t most = 64;
    for (int64_t cells = 1; cells <= most; cells *= 2) {
        const Largest largest(cells);
        double missed = 0;
        for (const LightMode &mode : modes)
            missed += mode.largest() * largest.misses(mode.i, mode.j);
        if (missed <= lacks)
            return cells;
    }
    return 0;
}

Field field_at(std::span<const LightMode> modes, double u, double v, const Field &like,
               double radius, double lacks) {
    const auto along_u = chebyshev(u, largest_chebyshev_degree);
    const auto along_v = chebyshev(v, largest_chebyshev_degree);
    std::vector<double> weights;
    for (const LightMode &mode : modes)
        weights.push_back(along_u[static_cast<size_t>(mode.i)] *
                          along_v[static_cast<size_t>(mode.j)]);
    const std::vector<double> radii = LeftOut(modes, weights).radii(radius, lacks);
    Field field = without_light(like, half_of(like, radius));
    for (size_t k = 0; k < radii.size(); ++k)
        add_within(weights[k], modes[k].light, half_of(like, radii[k]), field.value);
    return field;
}

namespace {

std::vector<double> by_distance(const Plane<double> &light) {
    const int64_t half = light.nx() / 2;
    std::vector<double> brightest(static_cast<size_t>(half + 1), 0.0);
    for (int64_t y = -half; y <= half; ++y)
        for (int64_t x = -half; x <= half; ++x) {
            double &most = brightest[static_cast<size_t>(std::max(std::abs(x), std::abs(y)))];
            most = std::max(most, std::abs(light(x + half, y + half)));
        }
    for (size_t r = brightest.size() - 1; r-- > 0;)
        brightest[r] = std::max(brightest[r], brightest[r + 1]);
    return brightest;
}

// What a mode is in stamps.
struct Expansion {
    std::vector<StampCoefficient> coefficients;
    double missed = 0;

    // Coefficients reach as far as either of the two before them, in a row of rising degrees, is
    // brighter than `little`: they fall fast, the faster the higher the degree.
    Expansion(const LightMode &mode, const Field &like, int64_t oversampling, int64_t half,
              double little) {
        constexpr int highest = ShiftedImage::largest_degree;
        ShiftedImage image(mode.light.view(), like.interpolator, like.per_pixel, oversampling,
                           half);
        int64_t before_b = half, reach_b = half;
        for (int b = 0; b <= highest && std::max(before_b, reach_b) >= 0; ++b) {
            int64_t before = std::max(before_b, reach_b), reach = before, widest = -1;
            for (int a = 0; a + b <= highest && std::max(before, reach) >= 0; ++a) {
                StampCoefficient c{
                    {mode.i, mode.j, a, b}, image.coefficients(a, b, std::max(before, reach)), {}};
                c.brightest = by_distance(c.light);
                before = reach;
                reach = static_cast<int64_t>(c.brightest.size()) - 1;
                while (reach >= 0 && c.brightest[static_cast<size_t>(reach)] <= little)
                    --reach;
                widest = std::max(widest, reach);
                if (a + b == highest)
                    missed += c.brightest[0];
                if (reach >= 0)
                    coefficients.push_back(std::move(c));
            }
            before_b = std::exchange(reach_b, widest);
        }
        for (StampCoefficient &c : coefficients)
            c.brightest.resize(static_cast<size_t>(half + 1), 0.0);
    }
};

} // namespace

template <class S>
CellPsf<S>::CellPsf(std::span<const LightMode> modes, const Field &like, double radius,
                    int64_t oversampling, double lacks, int threads)
    : cell_{0, 0, 1}, oversampling_(oversampling), half_(stamp_half(radius, oversampling)),
      width_(blocks_for(2 * half_ + 1)) {
    constexpr double in_a_row = 8; // coefficients that may be cut short at once
    const double little = lacks / (in_a_row * static_cast<double>(modes.size()));
    std::vector<std::optional<Expansion>> expansions(modes.size());
    const auto bands = std::min<int64_t>(std::max(threads, 1), std::ssize(modes));
    for_each_band(bands, [&](int64_t band) {
        const KeptMemory kept;
        for (auto k = static_cast<size_t>(band); k < modes.size(); k += static_cast<size_t>(bands))
            expansions[k].emplace(modes[k], like, oversampling, half_, little);
    });
    std::vector<StampCoefficient> all;
    double missed = 0;
    for (std::optional<Expansion> &expansion : expansions) {
        missed += expansion->missed;
        std::ranges::move(expansion->coefficients, std::back_inserter(all));
    }
    serves_ = missed <= lacks;
    keep(std::move(all), lacks);
}

template <class S>
CellPsf<S>::CellPsf(const CellPsf &all, const DetectorCell &cell, double lacks)
    : cell_(cell), oversampling_(all.oversampling_), half_(all.half_), width_(all.width_) {
    constexpr int fields = (degree + 1) * (degree + 2) / 2;
    constexpr double of_fields = 0.5;
    const Within along_u = within(cell_.u, cell_.half), along_v = within(cell_.v, cell_.half);
    std::vector<StampCoefficient> coefficients;
    for (int i = 0; i <= degree; ++i)
        for (int j = 0; i + j <= degree; ++j) {
            std::vector<double> weights;
            for (const StampDegrees &of : all.degrees_)
                weights.push_back(along_u[static_cast<size_t>(of.i)][static_cast<size_t>(i)] *
                                  along_v[static_cast<size_t>(of.j)][static_cast<size_t>(j)]);
            const std::vector<double> reach =
                LeftOut(all.brightest_, weights)
                    .radii(static_cast<double>(half_ + 1), of_fields * lacks / fields);
            std::map<std::pair<int, int>, size_t> known;
            for (size_t k = 0; k < reach.size(); ++k) {
                const StampDegrees &of = all.degrees_[k];
                auto half = static_cast<int64_t>(reach[k]) - 1;
                while (all.held_[static_cast<size_t>(half)] <= static_cast<int64_t>(k) && half > 0)
                    --half;
                const auto [at, first] = known.try_emplace({of.a, of.b}, coefficients.size());
                if (first)
                    coefficients.push_back(
                        {{i, j, of.a, of.b}, Plane<double>(2 * half + 1, 2 * half + 1), {}});
                Plane<double> &sum = coefficients[at->second].light;
                const int64_t middle = sum.nx() / 2;
                for (int64_t y = -half; y <= half; ++y) {
                    const S *const light = all.row(k, y) + half_ - half;
                    double *const row = sum.view().row(middle + y) + middle - half;
                    for (int64_t x = 0; x <= 2 * half; ++x)
                        row[x] += weights[k] * static_cast<double>(light[x]);
                }
            }
        }
    for (StampCoefficient &c : coefficients) {
        c.brightest = by_distance(c.light);
        c.brightest.resize(static_cast<size_t>(half_ + 1), 0.0);
    }
    keep(std::move(coefficients), (1 - of_fields) * lacks);
}

template <class S> void CellPsf<S>::keep(std::vector<StampCoefficient> coefficients, double lacks) {
    std::ranges::stable_sort(coefficients, std::ranges::greater(),
                             [](const StampCoefficient &c) { return c.brightest[0]; });
    for (StampCoefficient &c : coefficients) {
        degrees_.push_back(c.of);
        brightest_.push_back(std::move(c.brightest));
    }
    left_out_ = LeftOut(brightest_, std::vector<double>(brightest_.size(), 1));
    held_ = counts(lacks);
    const auto kept = static_cast<size_t>(held_[0]);
    degrees_.resize(kept);
    brightest_.resize(kept);
    known_.clear();
    int64_t rows = 0;
    for (int64_t y = -half_; y <= half_; ++y) {
        first_.push_back(rows * width_);
        rows += held_[static_cast<size_t>(std::abs(y))];
    }
    light_ = Plane<S>(width_, rows);
    for (size_t k = 0; k < kept; ++k) {
        const View<const double> light = std::as_const(coefficients[k].light).view();
        const int64_t half = light.nx / 2;
        for (int64_t y = -half; y <= half; ++y)
            if (static_cast<int64_t>(k) < held_[static_cast<size_t>(std::abs(y))]) {
                S *const to = light_.view().data + (row(k, y) - light_.view().data) + half_ - half;
                for (int64_t x = 0; x < light.nx; ++x)
                    to[x] = static_cast<S>(light(x, y + half));
            }
    }
    weights_.resize(kept);
    line_ = Plane<S>(width_, 1);
}

template <class S> const std::vector<int64_t> &CellPsf<S>::counts(double lacks) {
    const auto known = std::ranges::find(known_, lacks, &Counts::lacks);
    if (known != known_.end())
        return known->by_distance;
    std::vector<int64_t> counts(static_cast<size_t>(half_ + 1), 0);
    int64_t count = 0;
    for (const double reach : left_out_.radii(static_cast<double>(half_ + 1), lacks)) {
        ++count;
        std::fill_n(counts.begin(), static_cast<size_t>(reach), count);
    }
    if (!held_.empty())
        for (size_t r = 0; r < counts.size(); ++r)
            counts[r] = std::min(counts[r], held_[r]);
    return known_.emplace_back(Counts{lacks, std::move(counts)}).by_distance;
}

template <class S>
template <class T>
void CellPsf<S>::add(const Star &star, double u, double v, double radius, double lacks,
                     StarRows<T> &rows) {
    const std::vector<int64_t> &counted = counts(lacks);
    const double x = std::round(star.x), y = std::round(star.y);
    const auto along_u = chebyshev((u - cell_.u) / cell_.half, largest_chebyshev_degree);
    const auto along_v = chebyshev((v - cell_.v) / cell_.half, largest_chebyshev_degree);
    const auto along_x = chebyshev(2 * (star.x - x), ShiftedImage::largest_degree);
    const auto along_y = chebyshev(2 * (star.y - y), ShiftedImage::largest_degree);
    const double flux = star.flux / static_cast<double>(oversampling_ * oversampling_);
    for (size_t k = 0; k < static_cast<size_t>(counted[0]); ++k) {
        const StampDegrees &of = degrees_[k];
        weights_[k] = static_cast<S>(
            flux * along_u[static_cast<size_t>(of.i)] * along_v[static_cast<size_t>(of.j)] *
            along_x[static_cast<size_t>(of.a)] * along_y[static_cast<size_t>(of.b)]);
    }
    const auto left = static_cast<int64_t>(x) - half_, middle = static_cast<int64_t>(y);
    S *const line = line_.view().data;
    rows.add_lines(star, radius, [&](int64_t first, int64_t last, int64_t at) {
        const int64_t off = std::abs(at - middle);
        const S *const light = row(0, at - middle);
        for (int64_t begin = (first - left) / block * block; begin <= last - left; begin += block) {
            const int64_t nearest = std::max({begin - half_, half_ - (begin + block - 1), off});
            const S *const start = light + begin;
            sum_blocks(weights_.data(), counted[static_cast<size_t>(nearest)], &start, 1, width_,
                       block, line + begin);
        }
        return line + (first - left);
    });
}

template class CellPsf<float>;
template class CellPsf<double>;
template void CellPsf<float>::add(const Star &, double, double, double, double, StarRows<float> &);
template void CellPsf<float>::add(const Star &, double, double, double, double, StarRows<double> &);
template void CellPsf<double>::add(const Star &, double, double, double, double, StarRows<float> &);
template void CellPsf<double>::add(const Star &, double, double, double, double,
                                   StarRows<double> &);

} // namespace wfpsf
