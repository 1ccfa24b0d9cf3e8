// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_halo.hpp"

#include "numerics/dispatch.hpp"

#include <algorithm>
#include <complex>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

} // namespace

Halo::Halo(const FarSource &source, const PupilEdges &edges, const std::vector<RimPoint> &points)
    : nearest_(source.nearest), table_(RimTable::size) {
    const double wavelength = source.mean_wavelength();
    double spread = 0; // variance of 1 / wavelength
    for (size_t q = 0; q < source.spectrum.size(); ++q)
        spread += source.spectrum.weight[q] *
                  std::pow(1 / source.spectrum.wavelength[q] - 1 / wavelength, 2);
    const double scale =
        source.pixel() * source.pixel() / (source.area() * wavelength * wavelength * 4 * pi * pi);
    for (int i = 0; i < RimTable::directions; ++i) {
        const auto [ux, uy] = RimTable::direction(i);
        for (int j = 1; j <= RimTable::distances; ++j) {
            const size_t entry = RimTable::entry(i, j);
            const double r = RimTable::distance(j, nearest_);
            const double k = r * source.pixel() / wavelength;
            std::vector<std::complex<double>> amplitudes;
            std::vector<double> places;
            double sum = 0;
            for (const RimPoint &point : points) {
                const std::complex<double> table{point.re[entry], point.im[entry]};
                if (table == 0.0)
                    continue;
                const double place = point.place(ux, uy);
                const auto amplitude =
                    table *
                    std::polar(1.0, 2 * pi * (k * place + point.waves[static_cast<size_t>(i)]));
                sum += std::norm(amplitude);
                for (size_t b = 0; b < places.size(); ++b) {
                    const double path = (place - places[b]) * r * source.pixel();
                    const double seen = std::exp(-2 * pi * pi * spread * path * path);
                    sum += 2 * seen * (amplitude * std::conj(amplitudes[b])).real();
                }
                amplitudes.push_back(amplitude);
                places.push_back(place);
            }
            table_[entry] = scale * sum / (k * k * k) * r * r * r;
            most_ = std::max(most_, table_[entry]);
        }
    }
    RimTable::close(table_);
    const auto rounded = std::ranges::count_if(
        junctions(edges), [](const Junction &junction) { return junction.kink < smooth_kink; });
    const auto sharp = 2 * static_cast<std::ptrdiff_t>(edges.straight.size()) - rounded;
    corners_ = static_cast<double>(sharp) * source.mean_wavelength(2) /
               (8 * std::pow(pi, 4) * source.pixel() * source.pixel() * source.area());
}

namespace {

struct HaloTable {
    double nearest, corners;
    const double *table;
};

WFPSF_VECTORISED void add_halo(const HaloTable &halo, double x0, double y, size_t n,
                               double *light) {
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i);
        const double r2 = x * x + y * y, r = std::sqrt(r2);
        const auto place = RimTable::place(x, y, halo.nearest / r);
        light[i] += (place.of(halo.table) + halo.corners / r) / (r2 * r);
    }
}

} // namespace

void Halo::add(const PixelRow &row, double floor) const {
    const double square = std::pow(radius(floor), 2) - row.y * row.y;
    if (square <= 0)
        return;
    const double half = std::sqrt(square);
    const auto first = static_cast<int64_t>(std::ceil(std::max(0.0, -half - row.x)));
    const auto last = static_cast<int64_t>(
        std::floor(std::min(static_cast<double>(row.light.size()) - 1, half - row.x)));
    if (first > last)
        return;
    const PixelRow part = row.part(first, last);
    add_halo({nearest_, corners_, table_.data()}, part.x, part.y, part.light.size(),
             part.light.data());
}

double Halo::radius(double floor) const {
    double r = std::cbrt(most_ / floor);
    while (brightest(r) > floor)
        r *= 1.01;
    return r;
}

} // namespace wfpsf
