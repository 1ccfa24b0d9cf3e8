// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/cell_psf.hpp"

#include "numerics/chebyshev.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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

Field without_light(const Field &like) {
    Field field(like.interpolator);
    field.per_pixel = like.per_pixel;
    return field;
}

int64_t half_of(const Field &field, double radius) {
    return samples_within(radius, field.per_pixel, field.interpolator.half_width() + 1);
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

CellPsf::CellPsf(std::span<const LightMode> modes, const DetectorCell &cell, const Field &like,
                 double radius, double lacks)
    : cell_(cell), middle_(without_light(like)), sum_(without_light(like)) {
    middle_.value = Plane<double>(like.value.nx(), like.value.ny());
    if (cell.half == 0) {
        add_degree(0, 0, modes, radius, lacks);
        return;
    }
    constexpr int fields = (degree + 1) * (degree + 2) / 2;
    for (int a = 0; a <= degree; ++a)
        for (int b = 0; a + b <= degree; ++b)
            add_degree(a, b, modes, radius, lacks / fields);
    std::ranges::stable_sort(corrections_, std::ranges::greater(), &LightMode::largest);
    left_out_ = LeftOut(corrections_, std::vector<double>(corrections_.size(), 1));
    int64_t widest = 1;
    for (const LightMode &correction : corrections_)
        widest = std::max(widest, correction.light.nx());
    sum_.value = Plane<double>(widest, widest);
}

void CellPsf::add_degree(int a, int b, std::span<const LightMode> modes, double radius,
                         double lacks) {
    const Within along_u = within(cell_.u, cell_.half), along_v = within(cell_.v, cell_.half);
    std::vector<double> weights;
    for (const LightMode &mode : modes)
        weights.push_back(along_u[static_cast<size_t>(mode.i)][static_cast<size_t>(a)] *
                          along_v[static_cast<size_t>(mode.j)][static_cast<size_t>(b)]);
    const LeftOut left_out(modes, weights);
    const std::vector<double> radii = left_out.radii(radius, lacks);
    if (radii.empty())
        return;
    const auto sum = [&](Plane<double> &light) {
        for (size_t k = 0; k < radii.size(); ++k)
            add_within(weights[k], modes[k].light, half_of(middle_, radii[k]), light);
    };
    if (a + b == 0)
        return sum(middle_.value);
    const int64_t half = std::min(half_of(middle_, radii[0]), middle_.value.nx() / 2);
    Plane<double> light(2 * half + 1, 2 * half + 1);
    sum(light);
    corrections_.push_back({a, b, std::move(light), left_out.all()});
}

const std::vector<double> &CellPsf::radii(double radius, double lacks) {
    const auto known = std::ranges::find_if(
        known_, [=](const Radii &r) { return r.radius == radius && r.lacks == lacks; });
    if (known != known_.end())
        return known->of_corrections;
    return known_.emplace_back(Radii{radius, lacks, left_out_.radii(radius, lacks)}).of_corrections;
}

template <class T>
void CellPsf::add(const Star &star, double u, double v, double radius, double lacks,
                  StarRows<T> &rows) {
    rows.add(middle_, star, radius);
    if (corrections_.empty())
        return;
    const std::vector<double> &needed = radii(radius, lacks);
    if (needed.empty())
        return;
    const auto along_u = chebyshev((u - cell_.u) / cell_.half, degree);
    const auto along_v = chebyshev((v - cell_.v) / cell_.half, degree);
    const int64_t middle = sum_.value.nx() / 2, widest = std::min(half_of(sum_, needed[0]), middle);
    for (int64_t y = middle - widest; y <= middle + widest; ++y)
        std::fill_n(sum_.value.view().row(y) + middle - widest, 2 * widest + 1, 0.0);
    for (size_t k = 0; k < needed.size(); ++k) {
        const LightMode &correction = corrections_[k];
        add_within(along_u[static_cast<size_t>(correction.i)] *
                       along_v[static_cast<size_t>(correction.j)],
                   correction.light, half_of(sum_, needed[k]), sum_.value);
    }
    rows.add(sum_, star, needed[0]);
}

template void CellPsf::add(const Star &, double, double, double, double, StarRows<float> &);
template void CellPsf::add(const Star &, double, double, double, double, StarRows<double> &);

} // namespace wfpsf
