// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_halo.hpp"

#include "numerics/dispatch.hpp"
#include "optics/fresnel.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace wfpsf {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;
constexpr double smooth_kink = 0.01; // radians

// Angles about a circle: 0..4 along a square that stands on its corner, quick to find.
double diamond(double x, double y) {
    const double p = y / (std::abs(x) + std::abs(y));
    return x < 0 ? 2 - p : y < 0 ? 4 + p : p;
}
std::array<double, 2> direction(double angle) {
    const double quarter = std::floor(angle), p = angle - quarter;
    const double x = 1 - p, y = p, norm = std::hypot(x, y);
    switch (static_cast<int>(quarter) & 3) {
    case 0:
        return {x / norm, y / norm};
    case 1:
        return {-y / norm, x / norm};
    case 2:
        return {-x / norm, -y / norm};
    default:
        return {y / norm, -x / norm};
    }
}

// What a curved edge's point sends in the direction that its normal points along: all per unit of
// k = r / wavelength, and corrections by the wavefront.
struct Source {
    double place;      // along the direction, m
    double speed;      // metres a radian
    double outwards;   // +1: the direction is that of the outward normal; -1: against it
    double bend;       // second derivative of k.u by the oval's angle, over k
    double begin, end; // of the edge from there, radians
    bool closed;
    bool smooth_begin, smooth_end; // a straight edge goes on there, which has that end's light
    double slope = 0, w_slope = 0, w_bend = 0; // W along the direction, dW/da, d2W/da2
};

// A curved edge, and whether a straight one goes on at its ends, which has those ends' light.
struct Curve {
    CurvedEdge edge;
    bool smooth_begin = false, smooth_end = false;
};

std::vector<Curve> curves(const PupilEdges &edges, const std::vector<Junction> &joined) {
    std::vector<Curve> out;
    for (const CurvedEdge &edge : edges.curved)
        out.push_back({edge});
    for (const Junction &junction : joined)
        if (junction.kink < smooth_kink)
            (junction.at_begin ? out[junction.curved].smooth_begin
                               : out[junction.curved].smooth_end) = true;
    return out;
}

std::vector<Source> sources(const std::vector<Curve> &curves, const Wavefront &w, double ux,
                            double uy) {
    std::vector<Source> out;
    for (const auto &[edge, smooth_begin, smooth_end] : curves) {
        const Oval &o = edge.oval;
        const double a = ux * o.half_width + uy * o.shear, b = uy * o.half_height;
        const double middle = (edge.begin + edge.end) / 2;
        for (const double side : {1.0, -1.0}) {
            const double at =
                middle + std::remainder(std::atan2(side * b, side * a) - middle, 2 * pi);
            const double u = std::cos(at), v = std::sin(at);
            const double x = o.x + o.half_width * u, y = o.y + o.shear * u + o.half_height * v;
            const double dx = -o.half_width * v, dy = o.half_height * u - o.shear * v;
            Source source{.place = x * ux + y * uy,
                          .speed = std::hypot(dx, dy),
                          .outwards = edge.lit_inside ? side : -side,
                          .bend = -side * std::hypot(a, b),
                          .begin = edge.begin - at,
                          .end = edge.end - at,
                          .closed = edge.closed(),
                          .smooth_begin = smooth_begin,
                          .smooth_end = smooth_end};
            constexpr double beyond = 0.1; // radians; the wavefront hardly matters there
            if (source.closed || (source.begin < beyond && source.end > -beyond)) {
                constexpr double h = 5e-3, turn = 1e-2;
                const double here = w(x, y);
                const double before = w(x - turn * dx, y - turn * dy);
                const double after = w(x + turn * dx, y + turn * dy);
                source.slope = (w(x + h * ux, y + h * uy) - here) / h;
                source.w_slope = (after - before) / (2 * turn);
                source.w_bend = (after - 2 * here + before) / (turn * turn);
            }
            out.push_back(source);
        }
    }
    return out;
}

// The amplitude times 2 pi k, where k is the distance in cycles per metre.
Complex amplitude(const Source &s, double k) {
    const double bend = k * s.bend + s.w_bend;
    const double shift = -s.w_slope / bend;
    const double per_radian = std::sqrt(2 * std::abs(bend));
    Complex part = std::sqrt(2.0);
    if (s.closed) {
        part = {1, 1};
    } else {
        const double begin = (s.begin - shift) * per_radian, end = (s.end - shift) * per_radian;
        if (begin > 12 || end < -12)
            return 0;
        constexpr double far_off = 1e3;
        if ((s.smooth_begin && begin > 0) || (s.smooth_end && end < 0))
            return 0;
        part = fresnel(s.smooth_end ? far_off : end) - fresnel(s.smooth_begin ? -far_off : begin);
    }
    if (bend < 0)
        part = std::conj(part);
    return part * (s.speed / (per_radian * (1 + s.slope / k))) *
           std::polar(1.0, 2 * pi * k * s.place) * s.outwards;
}

} // namespace

Halo::Halo(const FarSource &source, const PupilEdges &edges)
    : nearest_(source.nearest), most_(0),
      table_(static_cast<size_t>((directions + 1) * (distances + 1))) {
    const double wavelength = source.mean_wavelength();
    const Wavefront w = source.wavefront(wavelength);
    double spread = 0; // variance of 1 / wavelength
    for (size_t q = 0; q < source.spectrum.size(); ++q)
        spread += source.spectrum.weight[q] *
                  std::pow(1 / source.spectrum.wavelength[q] - 1 / wavelength, 2);
    const double scale =
        source.pixel() * source.pixel() / (source.area() * wavelength * wavelength * 4 * pi * pi);
    const std::vector<Junction> joined = junctions(edges);
    const std::vector<Curve> all = curves(edges, joined);
    for (int i = 0; i < directions; ++i) {
        const auto [ux, uy] = direction(4.0 * i / directions);
        const std::vector<Source> points = sources(all, w, ux, uy);
        for (int j = 1; j <= distances; ++j) {
            const double v = static_cast<double>(j) / distances, r = nearest_ / (v * v);
            const double k = r * source.pixel() / wavelength;
            std::vector<Complex> amplitudes;
            std::vector<double> places;
            for (const Source &s : points)
                if (const Complex a = amplitude(s, k); a != 0.0) {
                    amplitudes.push_back(a);
                    places.push_back(s.place);
                }
            double sum = 0;
            for (size_t a = 0; a < places.size(); ++a) {
                sum += std::norm(amplitudes[a]);
                for (size_t b = 0; b < a; ++b) {
                    const double path = (places[a] - places[b]) * r * source.pixel();
                    const double seen = std::exp(-2 * pi * pi * spread * path * path);
                    sum += 2 * seen * (amplitudes[a] * std::conj(amplitudes[b])).real();
                }
            }
            table_[static_cast<size_t>(i * (distances + 1) + j)] =
                scale * sum / (k * k) * r * r * r;
        }
        const auto row = table_.begin() + i * (distances + 1);
        row[0] = row[1];
        most_ = std::max(most_, *std::max_element(row, row + distances + 1));
    }
    std::copy_n(table_.begin(), distances + 1, table_.end() - (distances + 1));
    const auto rounded = std::ranges::count_if(
        joined, [](const Junction &junction) { return junction.kink < smooth_kink; });
    const auto sharp = 2 * static_cast<std::ptrdiff_t>(edges.straight.size()) - rounded;
    corners_ = static_cast<double>(sharp) * source.mean_wavelength(2) /
               (8 * std::pow(pi, 4) * source.pixel() * source.pixel() * source.area());
}

namespace {

struct HaloTable {
    double nearest, per_angle, distances, corners;
    ptrdiff_t columns;
    const double *table;
};

WFPSF_VECTORISED void add_halo(const HaloTable &halo, double x0, double y, size_t n,
                               double *light) {
    const double most_row = 4 * halo.per_angle - 1e-6, most_column = halo.distances - 1e-6;
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i);
        const double r2 = x * x + y * y, r = std::sqrt(r2);
        const double row = std::min(diamond(x, y) * halo.per_angle, most_row);
        const double column = std::min(std::sqrt(halo.nearest / r) * halo.distances, most_column);
        const auto j = static_cast<int32_t>(row), c = static_cast<int32_t>(column);
        const double s = row - j, t = column - c;
        const double *entry = halo.table + j * halo.columns + c;
        const double low = entry[0] + t * (entry[1] - entry[0]);
        entry += halo.columns;
        const double high = entry[0] + t * (entry[1] - entry[0]);
        light[i] += (low + s * (high - low) + halo.corners / r) / (r2 * r);
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
    add_halo({nearest_, directions / 4.0, distances, corners_, distances + 1, table_.data()},
             part.x, part.y, part.light.size(), part.light.data());
}

double Halo::radius(double floor) const {
    double r = std::cbrt(most_ / floor);
    while (brightest(r) > floor)
        r *= 1.01;
    return r;
}

} // namespace wfpsf
