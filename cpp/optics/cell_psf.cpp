// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/cell_psf.hpp"

#include "numerics/chebyshev.hpp"
#include "optics/resample.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace wfpsf {

namespace {

constexpr int degree = 3; // of the polynomials within a cell

// T_i along one axis of a cell, i = 0, 1, ...: coefficients of T_0, T_1, ... of -1..1 within it,
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
    Within coefficient{};
    std::array<double, largest_chebyshev_degree + 1> missed{};

    explicit Largest(int64_t cells) {
        const double half = 1.0 / static_cast<double>(cells);
        for (int64_t cell = 0; cell < cells; ++cell)
            look_at(half * static_cast<double>(2 * cell + 1 - cells), half);
    }
    // Of T_i(u) T_j(v).
    double misses(int i, int j) const {
        const auto at_u = static_cast<size_t>(i), at_v = static_cast<size_t>(j);
        double misses = missed[at_u] + (1 + missed[at_u]) * missed[at_v];
        for (size_t a = 1; a <= degree; ++a)
            for (size_t b = degree + 1 - a; b <= degree; ++b)
                misses += coefficient[at_u][a] * coefficient[at_v][b];
        return misses;
    }

  private:
    void look_at(double middle, double half) {
        constexpr int places = 16;
        const Within of = within(middle, half);
        for (size_t i = 0; i < of.size(); ++i)
            for (size_t a = 0; a <= degree; ++a)
                coefficient[i][a] = std::max(coefficient[i][a], std::abs(of[i][a]));
        for (int k = 0; k <= places; ++k) {
            const double at = 2.0 * k / places - 1;
            const auto basis = chebyshev(at, degree);
            const auto value = chebyshev(middle + half * at, largest_chebyshev_degree);
            for (size_t i = 0; i < of.size(); ++i) {
                double off = value[i];
                for (size_t a = 0; a <= degree; ++a)
                    off -= of[i][a] * basis[a];
                missed[i] = std::max(missed[i], std::abs(off));
            }
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

int64_t cells_across(std::span<const LightMode> modes, double lacks, int64_t most) {
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

struct Coefficient {
    StampDegrees of;
    Plane<double> light;
    std::vector<double> brightest;
};

// Samples of a stamp that a plane tells.
int64_t half_within(const Plane<double> &light, const Field &like, int64_t oversampling) {
    const int64_t samples = light.nx() / 2 - like.interpolator.half_width();
    return static_cast<int64_t>(
        static_cast<double>(samples * oversampling) / static_cast<double>(like.per_pixel) - 0.5);
}

// What a mode is in stamps.
struct Expansion {
    std::vector<Coefficient> coefficients;
    double missed = 0;

    // Coefficients reach as far as either of the two before them, in a row of rising degrees, is
    // brighter than `little`: they fall fast, the faster the higher the degree.
    Expansion(const LightMode &mode, const Field &like, int64_t oversampling, int64_t half,
              double little) {
        constexpr int highest = ShiftedImage::largest_degree;
        half = std::min(half, half_within(mode.light, like, oversampling));
        ShiftedImage image(mode.light.view(), like.interpolator, like.per_pixel, oversampling,
                           half);
        int64_t before_b = half, reach_b = half;
        for (int b = 0; b <= highest && std::max(before_b, reach_b) >= 0; ++b) {
            int64_t before = std::max(before_b, reach_b), reach = before, widest = -1;
            for (int a = 0; a + b <= highest && std::max(before, reach) >= 0; ++a) {
                const int64_t size = std::max(before, reach);
                Coefficient c{{mode.i, mode.j, a, b}, image.coefficients(a, b, size), {}};
                c.brightest = brightest_beyond<double>(
                    size, [&](int64_t y) { return c.light.view().row(size + y); });
                before = reach;
                reach = size;
                while (reach >= 0 && c.brightest[static_cast<size_t>(reach)] <= little)
                    --reach;
                widest = std::max(widest, reach);
                if (reach < 0)
                    continue;
                if (a + b == highest)
                    missed += c.brightest[0];
                coefficients.push_back(std::move(c));
            }
            before_b = std::exchange(reach_b, widest);
        }
    }
};

constexpr size_t cell_degrees = (degree + 1) * (degree + 2) / 2;

// All places' coefficients of one polynomial of the place in a pixel, and the sums of them that a
// cell has.
template <class S> struct Sums {
    std::vector<size_t> parts; // the widest first
    std::vector<int64_t> reach;
    struct Sum {
        std::vector<S> weights;
        std::vector<double> brightest; // at most
        size_t kept_as;
    };
    std::array<Sum, cell_degrees> of_degree;
};

// How far blocks of a row are at least from sample `half` of it.
int64_t distance(int64_t begin, int64_t half) {
    return std::max({begin - half, half - (begin + block - 1), int64_t{0}});
}

} // namespace

template <class S>
CellPsf<S>::CellPsf(std::span<const LightMode> modes, const Field &like, double radius,
                    int64_t oversampling, double lacks, int threads)
    : cell_{0, 0, 1}, oversampling_(oversampling), half_(stamp_half(radius, oversampling)),
      width_(blocks_for(2 * half_ + 1)) {
    // A third each for modes, for what they are expanded to, and for that in turn.
    const std::vector<double> radii =
        LeftOut(modes, std::vector<double>(modes.size(), 1)).radii(radius, lacks / 3);
    constexpr double at_once = 16; // coefficients that may be cut short there
    const double little = lacks / (3 * at_once * static_cast<double>(radii.size() + 1));
    std::vector<std::optional<Expansion>> expansions(radii.size());
    const auto bands = std::clamp<int64_t>(std::ssize(radii), 1, std::max(threads, 1));
    for_each_band(bands, [&](int64_t band) {
        const KeptMemory kept;
        for (auto k = static_cast<size_t>(band); k < radii.size(); k += static_cast<size_t>(bands))
            expansions[k].emplace(modes[k], like, oversampling,
                                  stamp_half(std::min(radii[k] + 1, radius), oversampling), little);
    });
    std::vector<Coefficient> all;
    for (std::optional<Expansion> &expansion : expansions) {
        missed_ += expansion->missed;
        for (Coefficient &c : expansion->coefficients) {
            c.brightest.resize(static_cast<size_t>(half_ + 1), 0.0);
            all.push_back(std::move(c));
        }
    }
    std::ranges::stable_sort(all, std::ranges::greater(),
                             [](const Coefficient &c) { return c.brightest[0]; });
    for (Coefficient &c : all) {
        degrees_.push_back(c.of);
        brightest_.push_back(std::move(c.brightest));
    }
    make_rows(lacks / 3);
    for (size_t k = 0; k < degrees_.size(); ++k) {
        const View<const double> light = std::as_const(all[k].light).view();
        const int64_t half = light.nx / 2;
        for (int64_t y = -reach_[k]; y <= reach_[k]; ++y) {
            S *const to = std::fill_n(row(k, y), width_, S(0)) - width_;
            if (std::abs(y) <= half)
                std::transform(light.row(half + y), light.row(half + y) + light.nx,
                               to + half_ - half,
                               [](double value) { return static_cast<S>(value); });
        }
    }
}

template <class S>
CellPsf<S>::CellPsf(const CellPsf &all, const DetectorCell &cell, double lacks)
    : cell_(cell), oversampling_(all.oversampling_), half_(all.half_), width_(all.width_) {
    const Within along_u = within(cell_.u, cell_.half), along_v = within(cell_.v, cell_.half);
    std::array<std::pair<size_t, size_t>, cell_degrees> degrees;
    for (size_t i = 0, d = 0; i <= degree; ++i)
        for (size_t j = 0; i + j <= degree; ++j)
            degrees[d++] = {i, j};
    std::vector<std::array<double, cell_degrees>> weights;
    std::vector<double> most;
    for (const StampDegrees &of : all.degrees_) {
        double &sum = most.emplace_back(0);
        auto &own = weights.emplace_back();
        for (size_t d = 0; d < cell_degrees; ++d) {
            own[d] = along_u[static_cast<size_t>(of.i)][degrees[d].first] *
                     along_v[static_cast<size_t>(of.j)][degrees[d].second];
            sum += std::abs(own[d]);
        }
    }
    const std::vector<double> reach =
        LeftOut(all.brightest_, most).radii(static_cast<double>(half_ + 1), lacks / 2);
    std::map<std::pair<int, int>, Sums<S>> sums;
    for (size_t k = 0; k < reach.size(); ++k) {
        Sums<S> &own = sums[{all.degrees_[k].a, all.degrees_[k].b}];
        own.parts.push_back(k);
        own.reach.push_back(std::min(all.reach_[k], static_cast<int64_t>(reach[k]) - 1));
        for (size_t d = 0; d < cell_degrees; ++d) {
            auto &sum = own.of_degree[d];
            sum.weights.push_back(static_cast<S>(weights[k][d]));
            sum.brightest.resize(static_cast<size_t>(half_ + 1), 0.0);
            for (size_t r = 0; r <= static_cast<size_t>(own.reach.back()); ++r)
                sum.brightest[r] += std::abs(weights[k][d]) * all.brightest_[k][r];
        }
    }
    struct Found {
        StampDegrees of;
        typename Sums<S>::Sum *sum;
    };
    std::vector<Found> found;
    for (auto &[within_pixel, own] : sums)
        for (size_t d = 0; d < cell_degrees; ++d)
            found.push_back(
                {{static_cast<int>(degrees[d].first), static_cast<int>(degrees[d].second),
                  within_pixel.first, within_pixel.second},
                 &own.of_degree[d]});
    std::ranges::stable_sort(found, std::ranges::greater(),
                             [](const Found &f) { return f.sum->brightest[0]; });
    for (const Found &f : found) {
        f.sum->kept_as = degrees_.size();
        degrees_.push_back(f.of);
        brightest_.push_back(std::move(f.sum->brightest));
    }
    make_rows(lacks / 2);
    std::vector<const S *> starts;
    for (int64_t y = -half_; y <= half_; ++y) {
        const auto held = static_cast<size_t>(held_[static_cast<size_t>(std::abs(y))]);
        for (const auto &[within_pixel, own] : sums)
            for (int64_t begin = 0; begin < width_; begin += block) {
                const int64_t nearest = std::max(distance(begin, half_), std::abs(y));
                starts.clear();
                while (starts.size() < own.parts.size() && own.reach[starts.size()] >= nearest)
                    starts.push_back(all.row(own.parts[starts.size()], y) + begin);
                for (const auto &sum : own.of_degree)
                    if (sum.kept_as < held)
                        sum_blocks(sum.weights.data(), std::ssize(starts), starts.data(),
                                   std::ssize(starts), 0, block, row(sum.kept_as, y) + begin);
            }
    }
    for (size_t k = 0; k < degrees_.size(); ++k) {
        brightest_[k] = brightest_beyond<S>(
            reach_[k], [&](int64_t y) { return row(k, y) + half_ - reach_[k]; });
        brightest_[k].resize(static_cast<size_t>(half_ + 1), 0.0);
    }
    left_out_ = LeftOut(brightest_, std::vector<double>(brightest_.size(), 1));
    known_.clear();
}

// Coefficients beyond `lacks` are dropped.
template <class S> void CellPsf<S>::make_rows(double lacks) {
    left_out_ = LeftOut(brightest_, std::vector<double>(brightest_.size(), 1));
    held_ = counts(lacks);
    const auto kept = static_cast<size_t>(held_[0]);
    degrees_.resize(kept);
    brightest_.resize(kept);
    reach_.assign(kept, 0);
    for (size_t r = 0; r < held_.size(); ++r)
        std::fill_n(reach_.begin(), held_[r], static_cast<int64_t>(r));
    int64_t rows = 0;
    for (int64_t y = -half_; y <= half_; ++y) {
        first_.push_back(rows);
        rows += held_[static_cast<size_t>(std::abs(y))];
    }
    light_ = std::make_shared<Plane<S>>(Plane<S>::unset(width_, rows));
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
    for (size_t r = 0; r < held_.size(); ++r)
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
        const auto count_at = [&](int64_t begin) {
            return counted[static_cast<size_t>(std::max(distance(begin, half_), off))];
        };
        for (int64_t begin = (first - left) / block * block; begin <= last - left;) {
            int64_t end = begin + block; // of blocks that take as many
            while (end <= last - left && count_at(end) == count_at(begin))
                end += block;
            const S *const start = light + begin;
            sum_blocks(weights_.data(), count_at(begin), &start, 1, width_, end - begin,
                       line + begin);
            begin = end;
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
