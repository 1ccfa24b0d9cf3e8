// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/field_terms.hpp"

#include "numerics/bands.hpp"
#include "optics/sum_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace wfpsf {

FieldTerms::FieldTerms(const Field &middle, OpticsWithin optics, const PsfSettings &settings)
    : middle_(middle), optics_(std::move(optics)), settings_(settings), light_{middle.value},
      error_(middle.error) {}

int64_t FieldTerms::border() const {
    return 2 * middle_.interpolator.half_width() + middle_.per_pixel;
}

int64_t FieldTerms::memory(size_t more, double radius) const {
    const auto area = [this](int64_t half) {
        const int64_t size = 2 * (half + border()) + 1;
        return size * size;
    };
    const int64_t half =
        samples_within(radius, middle_.per_pixel, middle_.interpolator.half_width());
    int64_t samples = static_cast<int64_t>(more) * area(half);
    for (const Plane<double> &light : light_)
        samples += area(light.nx() / 2);
    return 2 * samples * static_cast<int64_t>(sizeof(double));
}

void FieldTerms::add(size_t more, double radius, std::vector<double> &by_ring) {
    const size_t first = count();
    if (first == LejaPolynomials::count(polynomials_.degree()))
        polynomials_.raise();
    std::vector<std::optional<Field>> exact(more);
    for_each_band(std::ssize(exact), [&](int64_t i) {
        const KeptMemory kept;
        const auto k = static_cast<size_t>(i);
        const Optics there = optics_(polynomials_.u(first + k), polynomials_.v(first + k));
        exact[k] = make_field_like(middle_, there, settings_, radius);
    });
    for (std::optional<Field> &field : exact)
        take(std::move(*field), by_ring);
}

// A row at a time all that is added to stays in the cache.
void FieldTerms::take(Field exact, std::vector<double> &by_ring) {
    const size_t own = count();
    error_ = std::max(error_, exact.error);
    const int64_t half = exact.value.nx() / 2;
    for (int64_t y = -half; y <= half; ++y)
        for (size_t k = 0; k < own; ++k) {
            const int64_t reach = light_[k].nx() / 2, width = std::min(half, reach);
            if (std::abs(y) <= reach)
                add_scaled(-polynomials_.at_place_of(k, own),
                           light_[k].view().row(reach + y) + reach - width, 2 * width + 1,
                           exact.value.view().row(half + y) + half - width);
        }
    const std::vector<double> off = brightest_by_pixel(exact.value, exact.per_pixel);
    for (size_t r = 0; r < off.size(); ++r)
        by_ring[r] = std::max(by_ring[r], off[r] / exact.faintest_peak);
    light_.push_back(std::move(exact.value));
}

std::vector<LightMode> FieldTerms::take_modes() {
    const int64_t largest = middle_.value.nx();
    std::vector<LightMode> modes;
    for (int degree = 0; LejaPolynomials::count(degree - 1) < count(); ++degree) {
        const int64_t reach = light_[LejaPolynomials::count(degree - 1)].nx();
        const int64_t size = std::min(reach + 2 * border(), largest);
        for (int j = 0; j <= degree; ++j) {
            const bool taken = modes.size() < count() && light_[modes.size()].nx() == size;
            auto light = taken ? Plane<double>() : Plane<double>::unset(size, size);
            modes.push_back({degree - j, j, std::move(light), {}});
        }
    }
    Plane<double> rows(largest, static_cast<int64_t>(count()));
    for (int64_t y = -largest / 2; y <= largest / 2; ++y)
        add_row_of_modes(y, modes, rows);
    const auto rings = static_cast<size_t>(largest / 2 / middle_.per_pixel + 1);
    for (size_t m = 0; m < modes.size(); ++m) {
        if (modes[m].light.nx() == 0)
            modes[m].light = std::move(light_[m]);
        modes[m].find_brightest(middle_.per_pixel);
        modes[m].brightest.resize(rings);
    }
    light_.clear();
    return modes;
}

// Row y from the middle of all modes. First those of all terms are set aside: modes are about to
// take their place.
void FieldTerms::add_row_of_modes(int64_t y, std::vector<LightMode> &modes, Plane<double> &rows) {
    const int64_t middle = rows.nx() / 2;
    const auto row = [&](size_t k, int64_t half) {
        return rows.view().row(static_cast<int64_t>(k)) + middle - half;
    };
    std::vector<size_t> seen;
    for (size_t k = 0; k < count(); ++k)
        if (const int64_t half = light_[k].nx() / 2; std::abs(y) <= half) {
            std::copy_n(light_[k].view().row(half + y), 2 * half + 1, row(k, half));
            seen.push_back(k);
        }
    for (size_t m = 0; m < modes.size(); ++m) {
        Plane<double> &light = modes[m].light.nx() > 0 ? modes[m].light : light_[m];
        const int64_t half = light.nx() / 2;
        if (std::abs(y) > half)
            continue;
        double *const sum = light.view().row(half + y);
        std::fill_n(sum, light.nx(), 0.0);
        for (const size_t k : seen)
            if (const double part = polynomials_.coefficient(k, m); part != 0) {
                const int64_t reach = light_[k].nx() / 2;
                add_scaled(part, row(k, reach), 2 * reach + 1, sum + half - reach);
            }
    }
}

} // namespace wfpsf
