// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_halo.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/elementary.hpp"
#include "numerics/phasor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// What a rim's point sends in one direction, by distance from the farthest on.
struct Ray {
    const float *re, *im;
    double place, waves;
    bool dark() const {
        return std::ranges::all_of(std::array{0, RimTable::distances - 1},
                                   [&](int j) { return re[j] == 0 && im[j] == 0; });
    }
};

// Of two rays, by the path between them.
struct Coherence {
    double turns; // per path
    double fade;  // per path squared: logarithm
};

// Adds 2 Re(a conj(b)) times the coherence.
WFPSF_VECTORISED void add_fringes(const Ray &a, const Ray &b, const Coherence &coherence,
                                  const Distances &distance, double *light) {
    const double apart = a.place - b.place, waves = a.waves - b.waves;
    const float *a_re = a.re, *a_im = a.im, *b_re = b.re, *b_im = b.im;
    const auto [turns, fade] = coherence;
    constexpr double most = 36; // what is left is rounding
    size_t first = 0;
    while (first < distance.size() && fade * std::pow(distance[first] * apart, 2) > most)
        ++first;
    for (size_t j = first; j < distance.size(); ++j) {
        const double path = distance[j] * apart;
        double cosine, sine;
        phasor(path * turns + waves, cosine, sine);
        const double re = a_re[j] * b_re[j] + a_im[j] * b_im[j];
        const double im = a_im[j] * b_re[j] - a_re[j] * b_im[j];
        light[j] += 2 * branchless_exp(-fade * path * path) * (re * cosine - im * sine);
    }
}

} // namespace

Halo::Halo(const FarSource &source, const PupilEdges &edges, const RimPoints &points)
    : nearest_(source.nearest), table_(RimTable::size) {
    const double wavelength = source.mean_wavelength();
    double spread = 0; // variance of 1 / wavelength
    for (size_t q = 0; q < source.spectrum.size(); ++q)
        spread += source.spectrum.weight[q] *
                  std::pow(1 / source.spectrum.wavelength[q] - 1 / wavelength, 2);
    const Coherence coherence{1 / wavelength, 2 * pi * pi * spread};
    // Over (k / r)^3.
    const double scale = wavelength / (source.pixel() * source.area() * 4 * pi * pi);
    Distances distance;
    for (size_t j = 0; j < distance.size(); ++j)
        distance[j] = source.pixel() * RimTable::distance(static_cast<int>(j + 1), nearest_);
    for (int i = 0; i < RimTable::directions; ++i) {
        const auto [ux, uy] = RimTable::direction(i);
        const size_t first = RimTable::entry(i, 1);
        Distances light{};
        std::vector<Ray> rays;
        for (size_t p = 0; p < points.own.size(); ++p) {
            const RimPoint &own = points.own[p], &point = points.with_edges[p];
            const Ray ray{point.re.data() + first, point.im.data() + first, point.place(ux, uy),
                          point.waves[static_cast<size_t>(i)]};
            if (ray.dark())
                continue;
            // What edges' ends send by themselves is elsewhere.
            for (size_t j = 0; j < distance.size(); ++j) {
                const double re = ray.re[j], im = ray.im[j];
                const double turned_re = re - own.re[first + j], turned_im = im - own.im[first + j];
                light[j] += re * re + im * im - turned_re * turned_re - turned_im * turned_im;
            }
            for (const Ray &other : rays)
                add_fringes(ray, other, coherence, distance, light.data());
            rays.push_back(ray);
        }
        for (size_t j = 0; j < distance.size(); ++j) {
            table_[first + j] = static_cast<float>(scale * light[j]);
            most_ = std::max(most_, scale * light[j]);
        }
    }
    RimTable::close(table_);
    const auto rounded = std::ranges::count_if(junctions(edges), [](const Junction &junction) {
        return !junction.end.is_curved && junction.other.is_curved && junction.kink < smooth_kink;
    });
    const auto sharp = 2 * static_cast<std::ptrdiff_t>(edges.straight.size()) - rounded;
    corners_ = static_cast<double>(sharp) * source.mean_wavelength(2) /
               (8 * std::pow(pi, 4) * source.pixel() * source.pixel() * source.area());
}

namespace {

struct HaloTable {
    double nearest, corners;
    const float *table;
};

WFPSF_VECTORISED void add_halo(const HaloTable &halo, double x0, double y, size_t n,
                               double *light) {
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i);
        const double r2 = x * x + y * y, r = std::sqrt(r2);
        const auto place =
            RimTable::place(RimTable::row_of(x, y), RimTable::column_of(halo.nearest / r));
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
        std::floor(std::min(static_cast<double>(row.size() - 1), half - row.x)));
    if (first > last)
        return;
    const PixelRow::Part part = row.part({first, last});
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
