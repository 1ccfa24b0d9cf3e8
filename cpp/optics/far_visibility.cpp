// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_visibility.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"
#include "numerics/quadrature.hpp"
#include "numerics/sinc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// Lagrange's polynomials of the nodes at x.
std::array<double, far_colours> lagrange(const std::array<double, far_colours> &nodes, double x) {
    std::array<double, far_colours> out{};
    for (size_t m = 0; m < far_colours; ++m) {
        out[m] = 1;
        for (size_t n = 0; n < far_colours; ++n)
            if (n != m)
                out[m] *= (x - nodes[n]) / (nodes[m] - nodes[n]);
    }
    return out;
}

// Of some wavelengths: the shares in the colours, and the phase between a table's entries.
struct Turning {
    static constexpr size_t most = 128;
    std::array<std::array<double, far_colours>, most> share;
    std::array<double, most> turn;
    size_t size = 0;
};

// table[j] += sum of share exp(2 pi i (j - 1) turn), by rotation.
WFPSF_VECTORISED void add_turning(const Turning &waves, std::span<ColourWaves> table) {
    std::array<double, Turning::most> re, im, cosine, sine;
    for (size_t q = 0; q < waves.size; ++q) {
        phasor(waves.turn[q], cosine[q], sine[q]);
        re[q] = cosine[q];
        im[q] = -sine[q];
    }
    for (ColourWaves &entry : table) {
        ColourWaves sum = entry;
        for (size_t q = 0; q < waves.size; ++q)
            for (size_t m = 0; m < far_colours; ++m) {
                sum.re[m] += waves.share[q][m] * re[q];
                sum.im[m] += waves.share[q][m] * im[q];
            }
        entry = sum;
        for (size_t q = 0; q < waves.size; ++q) {
            const double turned = re[q] * cosine[q] - im[q] * sine[q];
            im[q] = re[q] * sine[q] + im[q] * cosine[q];
            re[q] = turned;
        }
    }
}

// table[j] += weight exp(2 pi i (start + j turn)) of one colour.
WFPSF_VECTORISED void add_turning(size_t colour, double weight, double start, double turn,
                                  std::span<ColourWaves> table) {
    for (size_t j = 0; j < table.size(); ++j) {
        double cosine, sine;
        phasor(start + static_cast<double>(j) * turn, cosine, sine);
        table[j].re[colour] += weight * cosine;
        table[j].im[colour] += weight * sine;
    }
}

} // namespace

Visibility::Visibility(const FarSource &source, double longest) {
    const Spectrum spectrum = source.light(longest);
    const auto [blue, red] = std::ranges::minmax(spectrum.wavelength);
    middle_ = (1 / blue + 1 / red) / 2;
    const double half = (1 / blue - 1 / red) / 2, mean = source.mean_wavelength();
    constexpr double per_fringe = 6;
    per_path_ = per_fringe * 2 * half;
    for (size_t m = 0; m < far_colours; ++m) // Chebyshev's nodes
        wavenumber_[m] = middle_ - half * std::cos(pi * (static_cast<double>(m) + 0.5) /
                                                   static_cast<double>(far_colours));
    table_.resize(static_cast<size_t>(longest * per_path_) + 4);
    Turning waves;
    for (size_t q = 0; q < spectrum.size(); ++q) {
        const double wavelength = spectrum.wavelength[q];
        auto share = lagrange(wavenumber_, 1 / wavelength);
        for (double &value : share)
            value *= spectrum.weight[q] * std::sqrt(wavelength / mean);
        waves.share[waves.size] = share;
        waves.turn[waves.size++] = (1 / wavelength - middle_) / per_path_;
        if (waves.size == Turning::most || q + 1 == spectrum.size()) {
            add_turning(waves, table_);
            waves.size = 0;
        }
    }
    most_.resize(table_.size());
    for (size_t j = table_.size(); j-- > 0;) {
        double re = 0, im = 0;
        for (size_t m = 0; m < far_colours; ++m) {
            re += table_[j].re[m];
            im += table_[j].im[m];
        }
        most_[j] = std::max(std::hypot(re, im), j + 1 < table_.size() ? most_[j + 1] : 0);
    }
}

double Visibility::most(double path) const {
    const double at = std::max(path, 0.0) * per_path_;
    return most_[std::min(static_cast<size_t>(at), most_.size() - 1)];
}

EdgeColours::EdgeColours(const FarSource &source, const PupilEdges &edges,
                         const Visibility &visibility, double reach)
    : source_(source), wavenumber_(visibility.wavenumbers()),
      per_across_(2 * std::max(1.0, source.bandwidth())) {
    reach_ = std::ceil(reach * per_across_) / per_across_;
    constexpr double most_turns = 3.2; // that the ends of a piece may differ by
    const double turns = reach_ * source.pixel() * (wavenumber_.back() - wavenumber_.front());
    for (size_t i = 0; i < edges.straight.size(); ++i) {
        const auto &[x, y, to_x, to_y] = edges.straight[i];
        const double length = std::hypot(to_x - x, to_y - y);
        const int pieces = std::max(1, static_cast<int>(std::ceil(length * turns / most_turns)));
        for (int p = 0; p < pieces; ++p) {
            const double middle = (p + 0.5) / pieces;
            edges_.push_back({{(to_y - y) / length, (x - to_x) / length},
                              x + middle * (to_x - x),
                              y + middle * (to_y - y),
                              length / pieces,
                              i});
        }
    }
}

double EdgeColours::variance(double ux, double uy) const {
    const Covariance &blur = source_.settings.blur;
    const double mirror = source_.settings.mirrored ? -1 : 1;
    const double pixel = source_.settings.pixel_response ? 1.0 / 12 : 0;
    return pixel + blur.xx * ux * ux + 2 * blur.xy * mirror * ux * uy + blur.yy * uy * uy;
}

// To fringes between points of the pupil so far apart.
double EdgeColours::response(double x, double y, double wavenumber) const {
    const double fx = x * source_.pixel() * wavenumber, fy = y * source_.pixel() * wavenumber;
    const Covariance &blur = source_.settings.blur;
    const double mirror = source_.settings.mirrored ? -1 : 1;
    const double square = blur.xx * fx * fx + 2 * blur.xy * mirror * fx * fy + blur.yy * fy * fy;
    const double blurred = std::exp(-2 * pi * pi * square);
    return source_.settings.pixel_response ? blurred * sinc(fx) * sinc(fy) : blurred;
}

template <class Response>
std::vector<ColourWaves> EdgeColours::integral(const Edge &edge,
                                               const Response &response_to) const {
    const auto &[nx, ny] = edge.axes;
    const auto half = std::lround(reach_ * per_across_) + 2;
    const double bluest = wavenumber_.back();
    const GaussLegendre rule(
        8 + gauss_legendre_points(pi * bluest * source_.pixel() * reach_ * edge.length, 1e-4));
    std::vector<ColourWaves> out(static_cast<size_t>(2 * half + 1));
    for (size_t i = 0; i < rule.x.size(); ++i) {
        const double s = rule.x[i] * edge.length / 2; // across the spike
        const double at_x = edge.x - ny * s, at_y = edge.y + nx * s;
        const double path = source_.optics.wavelength * source_.optics.wavefront(at_x, at_y);
        for (size_t m = 0; m < far_colours; ++m) {
            const double turn = source_.pixel() * wavenumber_[m] * s / per_across_;
            const double weight =
                rule.w[i] * edge.length / 2 * response_to(at_x, at_y, wavenumber_[m]);
            add_turning(m, weight, path * wavenumber_[m] - static_cast<double>(half) * turn, turn,
                        out);
        }
    }
    return out;
}

std::vector<ColourWaves> EdgeColours::waves(const Edge &edge) const {
    return integral(edge, [](double, double, double) { return 1.0; });
}

std::vector<ColourWaves> EdgeColours::waves(const Edge &edge, double x, double y) const {
    return integral(edge, [&](double at_x, double at_y, double wavenumber) {
        return response(at_x - x, at_y - y, wavenumber);
    });
}

double most(std::span<const ColourWaves> waves) {
    double square = 0;
    for (const ColourWaves &wave : waves)
        for (size_t m = 0; m < far_colours; ++m)
            square = std::max(square, wave.re[m] * wave.re[m] + wave.im[m] * wave.im[m]);
    return std::sqrt(square);
}

} // namespace wfpsf
