// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/scaling_terms.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wfpsf {

namespace {

constexpr int64_t spot = ScalingTerms::spot;

// The largest absolute value in each spot.
Plane<double> brightest_in(const Plane<double> &term) {
    const int64_t size = term.nx(), spots = (size + spot - 1) / spot;
    Plane<double> most(spots, spots);
    for (int64_t y = 0; y < size; ++y)
        for (int64_t b = 0; b < spots; ++b) {
            const double *const row = term.view().row(y);
            double here = most(b, y / spot);
            for (int64_t x = b * spot; x < std::min((b + 1) * spot, size); ++x)
                here = std::max(here, std::abs(row[x]));
            most(b, y / spot) = here;
        }
    return most;
}

// The same with the spots around.
Plane<double> brightest_around(const Plane<double> &most) {
    const int64_t spots = most.nx();
    Plane<double> around(spots, spots);
    for (int64_t y = 0; y < spots; ++y)
        for (int64_t x = 0; x < spots; ++x)
            for (int64_t j = std::max<int64_t>(y - 1, 0); j <= std::min(y + 1, spots - 1); ++j)
                for (int64_t i = std::max<int64_t>(x - 1, 0); i <= std::min(x + 1, spots - 1); ++i)
                    around(x, y) = std::max(around(x, y), most(i, j));
    return around;
}

} // namespace

ScalingTerms::ScalingTerms(std::vector<Plane<double>> terms) : terms_(std::move(terms)) {
    for (const Plane<double> &term : terms_) {
        const Plane<double> most = brightest_in(term);
        brightest_.push_back(brightest_around(most));
        std::vector<double> &beyond = beyond_.emplace_back(static_cast<size_t>(2 * most.nx()));
        const auto farthest = [this](int64_t i) { // of a spot along an axis
            return std::max(std::abs(static_cast<double>(i * spot) - middle()),
                            std::abs(static_cast<double>((i + 1) * spot) - middle()));
        };
        for (int64_t y = 0; y < most.ny(); ++y)
            for (int64_t x = 0; x < most.nx(); ++x) {
                double &brightest =
                    beyond[static_cast<size_t>(std::hypot(farthest(x), farthest(y)) / spot)];
                brightest = std::max(brightest, most(x, y));
            }
        for (size_t i = beyond.size() - 1; i-- > 0;)
            beyond[i] = std::max(beyond[i], beyond[i + 1]);
    }
}

ScalingTerms::Light ScalingTerms::light(Range x, Range y, double negligible) const {
    Light light{count(), 0};
    double left_out = 0;
    for (size_t m = count(); m-- > 0;) {
        double most = 0;
        for (int64_t j = y.begin / spot; j <= (y.end - 1) / spot; ++j)
            for (int64_t i = x.begin / spot; i <= (x.end - 1) / spot; ++i)
                most = std::max(most, brightest_[m](i, j));
        light.most += most;
        if (m > 0 && light.terms == m + 1 && left_out + most <= negligible) {
            left_out += most;
            light.terms = m;
        }
    }
    return light;
}

double ScalingTerms::largest_beyond(size_t m, double distance) const {
    return beyond_[m][std::min(static_cast<size_t>(distance / spot), beyond_[m].size() - 1)];
}

} // namespace wfpsf
