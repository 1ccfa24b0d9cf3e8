// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_visibility.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/elementary.hpp"
#include "numerics/phasor.hpp"
#include "numerics/quadrature.hpp"

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

// A wave that turns from one table entry to the next, and what the colours have of it.
struct TurningWave {
    double turn;
    std::array<double, far_colours> share;
};

// table[j] += sum of share exp(2 pi i (j - 1) turn)
WFPSF_VECTORISED void add_waves(std::span<const TurningWave> waves, std::span<ColourWaves> table) {
    constexpr size_t block = 32;
    for (size_t first = 0; first < table.size(); first += block) {
        std::array<std::array<double, block>, far_colours> sum_re{}, sum_im{};
        for (const TurningWave &wave : waves) {
            std::array<double, block> re, im;
            for (size_t j = 0; j < block; ++j)
                phasor((static_cast<double>(first + j) - 1) * wave.turn, re[j], im[j]);
            for (size_t m = 0; m < far_colours; ++m)
                for (size_t j = 0; j < block; ++j) {
                    sum_re[m][j] += wave.share[m] * re[j];
                    sum_im[m][j] += wave.share[m] * im[j];
                }
        }
        for (size_t j = 0; j < std::min(block, table.size() - first); ++j)
            for (size_t m = 0; m < far_colours; ++m) {
                table[first + j].re[m] = sum_re[m][j];
                table[first + j].im[m] = sum_im[m][j];
            }
    }
}

// table[j] = sum over nodes of weight wave step^j
WFPSF_VECTORISED void add_nodes(std::span<EdgeColours::Node> nodes, std::span<ColourWaves> table) {
    for (ColourWaves &entry : table) {
        ColourWaves sum{};
        for (EdgeColours::Node &node : nodes)
            for (size_t m = 0; m < far_colours; ++m) {
                const double re = node.wave.re[m], im = node.wave.im[m];
                sum.re[m] += node.weight[m] * re;
                sum.im[m] += node.weight[m] * im;
                node.wave.re[m] = re * node.step.re[m] - im * node.step.im[m];
                node.wave.im[m] = re * node.step.im[m] + im * node.step.re[m];
            }
        entry = sum;
    }
}

[[gnu::always_inline]] inline double branchless_sinc(double t) {
    const double a = std::abs(t) + 1e-12;
    double cosine, sine;
    phasor(a / 2, cosine, sine);
    return sine / (pi * a);
}

// Times the pixel's and the blur's response to fringes with light from (x, y).
WFPSF_VECTORISED void respond(const EdgeColours::Response &to, double x, double y,
                              std::span<EdgeColours::Node> nodes) {
    const auto [xx, xy, yy] = to.blur;
    for (EdgeColours::Node &node : nodes)
        for (size_t m = 0; m < far_colours; ++m) {
            const double fx = (node.x - x) * to.cycles[m], fy = (node.y - y) * to.cycles[m];
            const double square = xx * fx * fx + 2 * xy * fx * fy + yy * fy * fy;
            constexpr double most = 300;
            node.weight[m] *= branchless_exp(-std::min(2 * pi * pi * square, most)) *
                              branchless_sinc(to.width * fx) * branchless_sinc(to.width * fy);
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
    std::vector<TurningWave> waves;
    for (size_t q = 0; q < spectrum.size(); ++q) {
        const double wavelength = spectrum.wavelength[q];
        TurningWave wave{(1 / wavelength - middle_) / per_path_,
                         lagrange(wavenumber_, 1 / wavelength)};
        for (double &share : wave.share)
            share *= spectrum.weight[q] * std::sqrt(wavelength / mean);
        waves.push_back(wave);
    }
    add_waves(waves, table_);
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
                         const Visibility &visibility, double reach, double onwards)
    : per_across_(2 * std::max(1.0, source.bandwidth())) {
    const auto &[xx, xy, yy] = source.settings.blur;
    response_ = {{xx, source.settings.mirrored ? -xy : xy, yy},
                 source.settings.pixel_response ? 1.0 : 0.0,
                 {}};
    for (size_t m = 0; m < far_colours; ++m)
        response_.cycles[m] = source.pixel() * visibility.wavenumbers()[m];
    constexpr double most_turns = 3.2; // that the ends of a piece may differ by
    double longest = 0;
    for (const auto &[x, y, to_x, to_y] : edges.straight)
        longest = std::max(longest, std::hypot(to_x - x, to_y - y));
    const std::vector<Junction> joined = junctions(edges);
    constexpr double widest = 2; // of the longest edge's
    const auto reaches = [&](double times) {
        return std::ceil(reach * std::min(times, widest) * per_across_) / per_across_;
    };
    for (size_t i = 0; i < edges.straight.size(); ++i) {
        const auto &[x, y, to_x, to_y] = edges.straight[i];
        const double length = std::hypot(to_x - x, to_y - y);
        const bool is_joined = std::ranges::any_of(joined, [i](const Junction &junction) {
            return junction.end.edge == i && goes_on(junction);
        });
        const double turns = length * (response_.cycles.back() - response_.cycles.front());
        const auto pieces_for = [&](double across) {
            return std::max(1, static_cast<int>(std::ceil(turns * across / most_turns)));
        };
        const double usual = reaches(longest / length);
        double far = is_joined ? reaches(onwards * longest / length) : usual;
        const int pieces = pieces_for(usual);
        while (pieces_for(far) > pieces) // that would cost more than it is worth
            far -= 1 / per_across_;
        for (int p = 0; p < pieces; ++p) {
            const double middle = (p + 0.5) / pieces;
            edges_.push_back({{(to_y - y) / length, (x - to_x) / length},
                              x + middle * (to_x - x),
                              y + middle * (to_y - y),
                              length / pieces,
                              i,
                              far,
                              usual});
            nodes_.push_back(nodes(source, visibility.wavenumbers(), edges_.back()));
        }
    }
}

std::vector<EdgeColours::Node> EdgeColours::nodes(const FarSource &source,
                                                  const std::array<double, far_colours> &wavenumber,
                                                  const Edge &edge) const {
    const GaussLegendre rule(
        8 + gauss_legendre_points(pi * response_.cycles.back() * edge.reach * edge.length, 1e-4));
    std::vector<Node> out(rule.x.size());
    for (size_t i = 0; i < out.size(); ++i) {
        const double s = rule.x[i] * edge.length / 2; // across the spike
        Node &node = out[i];
        node.x = edge.x - edge.axes.ny * s;
        node.y = edge.y + edge.axes.nx * s;
        node.weight.fill(rule.w[i] * edge.length / 2);
        const double path = source.optics.wavelength * source.optics.wavefront(node.x, node.y);
        for (size_t m = 0; m < far_colours; ++m) {
            const double turn = response_.cycles[m] * s;
            phasor(path * wavenumber[m] - (edge.reach + 2 / per_across_) * turn, node.wave.re[m],
                   node.wave.im[m]);
            phasor(turn / per_across_, node.step.re[m], node.step.im[m]);
        }
    }
    return out;
}

double EdgeColours::variance(double ux, double uy) const {
    const auto &[xx, xy, yy] = response_.blur;
    return response_.width / 12 + xx * ux * ux + 2 * xy * ux * uy + yy * uy * uy;
}

std::vector<ColourWaves> EdgeColours::table(std::vector<Node> nodes, double reach) const {
    std::vector<ColourWaves> out(2 * static_cast<size_t>(std::lround(reach * per_across_)) + 5);
    add_nodes(nodes, out);
    return out;
}

std::vector<ColourWaves> EdgeColours::waves(size_t edge) const {
    return table(nodes_[edge], edges_[edge].reach);
}

std::vector<ColourWaves> EdgeColours::waves(size_t edge, double x, double y) const {
    std::vector<Node> nodes = nodes_[edge];
    respond(response_, x, y, nodes);
    return table(std::move(nodes), edges_[edge].reach);
}

bool goes_on(const Junction &junction) {
    const auto &[end, other, kink] = junction;
    return !end.is_curved && !other.is_curved && kink < widest_kink;
}

double most(std::span<const ColourWaves> waves) {
    double square = 0;
    for (const ColourWaves &wave : waves)
        for (size_t m = 0; m < far_colours; ++m)
            square = std::max(square, wave.re[m] * wave.re[m] + wave.im[m] * wave.im[m]);
    return std::sqrt(square);
}

} // namespace wfpsf
