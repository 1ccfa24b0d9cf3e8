// SPDX-License-Identifier: GPL-3.0-or-later
#include "numerics/dispatch.hpp"
#include "numerics/quadrature.hpp"
#include "numerics/sinc.hpp"
#include "optics/far_spikes.hpp"
#include "optics/far_waves.hpp"
#include "optics/fresnel.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// What is left of the light of an edge's end where an arc goes on from it smoothly, by the place of
// the arc's point of stationary phase: the end's amplitude, 1 / (pi x), less Fresnel's tail.
double rounded(double x) {
    double re, im;
    fresnel_auxiliary(x, re, im);
    return std::pow(re * pi * x, 2) + std::pow(im * pi * x - 1, 2);
}

// out[i] = sum of taps[j] values[i + j]
WFPSF_VECTORISED void convolve(std::span<const double> taps, std::span<const double> values,
                               std::span<double> out) {
    for (size_t j = 0; j < taps.size(); ++j)
        for (size_t i = 0; i < out.size(); ++i)
            out[i] += taps[j] * values[i + j];
}

// Those beyond the last have no weight.
struct Colours {
    Lanes wavelength, weight;
};

// A curved edge that goes on from the end of a straight one, in about its direction.
struct ArcEnd {
    SpikeAxes axes; // along the outward normal at the end
    double x, y;    // of the end, m
    double tangent; // +1: the edge runs along the axes' across, -1: against it
    double radius;  // of curvature; negative: the light is on the outside
    double share;   // 1; -1 where one ends: what would go on from there is missing
    bool smooth;    // without a kink
    double waves;   // wavefront there, in the unit of the optics'
};

// One that turns off from there.
struct CornerEnd {
    double s;     // of the end along the edge, m
    double share; // of the edge's own end, but for the sign
    double waves; // as an arc's
};

// An edge and its integrals by colour and position across the spike.
struct EdgeWaves {
    SpikeAxes axes;      // along the outward normal
    double x, y, length; // middle, m
    std::vector<ArcEnd> arcs = {};
    std::vector<CornerEnd> corners = {};
    std::vector<std::vector<EdgeSample>> samples = {};
};

// What the members of a group make on a row of points.
struct Row {
    std::vector<Waves> part, sum;
    std::vector<Lanes> each;
    explicit Row(size_t n) : part(n), sum(n), each(n) {}
};

} // namespace

class SpikeTables {
  public:
    SpikeTables(const FarSource &source, const PupilEdges &edges)
        : source_(source), step_(0.25 / std::max(1.0, source.bandwidth())) {
        for (size_t first = 0; first < source.spectrum.size(); first += lanes)
            colours_.push_back(colours(first));
        for (const StraightEdge &edge : edges.straight)
            edges_.push_back(edge_waves(edge));
        for (const auto &[end, other, kink] : junctions(edges))
            if (!end.is_curved && kink >= widest_kink)
                edges_[end.edge].corners.push_back(corner_end(edges_[end.edge], other));
        for (const ArcOnwards &arc : arcs_onwards(edges, widest_kink))
            edges_[arc.straight].arcs.push_back(arc_end(edges_[arc.straight], arc));
        for (EdgeWaves &edge : edges_)
            for (const Colours &colours : colours_)
                edge.samples.push_back(samples(edge, colours));
    }

    Spikes spikes() const {
        Spikes out;
        for (const EdgeWaves &edge : edges_)
            out.spikes.push_back(spike(edge));
        for (const EdgeWaves &edge : edges_)
            if (!edge.arcs.empty())
                out.fringes.push_back(fringes({&edge}));
        for (const Group &group : groups())
            if (group.size() > 1)
                out.fringes.push_back(fringes(group));
        return out;
    }

  private:
    static constexpr std::ptrdiff_t half = 256;       // of a profile, steps
    static constexpr std::ptrdiff_t filter_half = 20; // of the pixel's filter, steps
    static constexpr std::ptrdiff_t wide = half + 1 + filter_half;
    static constexpr double widest_group = 7 * pi / 180; // between neighbours in a group

    Colours colours(size_t first) const {
        const auto &[wavelength, weight] = source_.spectrum;
        Colours out{};
        for (size_t q = 0; q < lanes; ++q)
            out.wavelength[q] = wavelength[std::min(first + q, wavelength.size() - 1)];
        std::copy_n(weight.begin() + static_cast<std::ptrdiff_t>(first),
                    std::min(lanes, weight.size() - first), out.weight.begin());
        return out;
    }

    static EdgeWaves edge_waves(const StraightEdge &edge) {
        const double dx = edge.to_x - edge.from_x, dy = edge.to_y - edge.from_y;
        const double length = std::hypot(dx, dy);
        return {{dy / length, -dx / length},
                (edge.from_x + edge.to_x) / 2,
                (edge.from_y + edge.to_y) / 2,
                length};
    }

    std::vector<EdgeSample> samples(const EdgeWaves &edge, const Colours &colours) const {
        Lanes per_metre, per_wave;
        for (size_t q = 0; q < lanes; ++q) {
            per_metre[q] = source_.pixel() * step_ / colours.wavelength[q];
            per_wave[q] = source_.optics.wavelength / colours.wavelength[q];
        }
        const double most_turns = std::ranges::max(per_metre) * static_cast<double>(wide);
        const GaussLegendre rule(8 + gauss_legendre_points(pi * most_turns * edge.length, 1e-8));
        const auto &[nx, ny] = edge.axes;
        const Wavefront &w = source_.optics.wavefront;
        std::vector<EdgeNode> nodes;
        for (size_t i = 0; i < rule.x.size(); ++i) {
            // Across the spike: (nx, ny) turned by 90 degrees.
            const double s = rule.x[i] * edge.length / 2;
            const double x = edge.x - ny * s, y = edge.y + nx * s;
            constexpr double h = 1e-3;
            const double slope = (w(x + h * nx, y + h * ny) - w(x - h * nx, y - h * ny)) / (2 * h);
            const double waves = w(x, y);
            EdgeNode &node = nodes.emplace_back(EdgeNode{s, rule.w[i] * edge.length / 2, {}, {}});
            for (size_t q = 0; q < lanes; ++q) {
                node.slope[q] = node.weight * slope * per_wave[q];
                node.turns[q] = waves * per_wave[q];
            }
        }
        for (const CornerEnd &corner : edge.corners) {
            EdgeNode &node = nodes.emplace_back(EdgeNode{corner.s, 0, {}, {}});
            for (size_t q = 0; q < lanes; ++q) {
                node.slope[q] = corner.share;
                node.turns[q] = corner.waves * per_wave[q] - 0.25;
            }
        }
        std::vector<EdgeSample> out(2 * wide + 1);
        integrate(nodes, per_metre, static_cast<double>(wide), out);
        return out;
    }

    // What another edge that turns off from the edge's end sends from there. It goes as the inverse
    // of k, like the slope.
    CornerEnd corner_end(const EdgeWaves &edge, const EdgeEnd &other) const {
        constexpr double least = 0.2; // where it turns back its spike is about the edge's own
        const double normal = edge.axes.along(other.nx, other.ny);
        const double tangent = edge.axes.along(other.tx, other.ty);
        const double share = std::abs(tangent) < least ? 0 : normal / tangent / (2 * pi);
        return {edge.axes.across(other.x - edge.x, other.y - edge.y), share,
                source_.optics.wavefront(other.x, other.y)};
    }

    ArcEnd arc_end(const EdgeWaves &edge, const ArcOnwards &arc) const {
        const EdgeEnd &at = arc.at;
        const double share = arc.ends ? -1 : 1;
        return {{at.nx, at.ny},
                at.x,
                at.y,
                std::copysign(1.0, share * edge.axes.across(at.tx, at.ty)),
                at.radius,
                share,
                arc.kink < smooth_kink,
                source_.optics.wavefront(at.x, at.y)};
    }

    // The pixel and the blur across a spike, for waves up to the bandwidth.
    std::vector<double> filter(const SpikeAxes &axes, double step) const {
        const auto &[nx, ny] = axes;
        const Covariance &blur = source_.settings.blur;
        const double variance =
            blur.xx * ny * ny - 2 * blur.xy * mirror() * nx * ny + blur.yy * nx * nx;
        const double highest = 0.5 / step;
        const GaussLegendre rule(64);
        std::vector<double> taps(2 * filter_half + 1);
        for (size_t i = 0; i < rule.x.size(); ++i) {
            const double f = highest * (1 + rule.x[i]) / 2;
            const double fade = std::clamp((f - 0.55 * highest) / (0.45 * highest), 0.0, 1.0);
            double response = std::pow(std::cos(pi / 2 * fade), 2);
            if (source_.settings.pixel_response)
                response *= sinc(f * nx) * sinc(f * ny);
            response *= std::exp(-2 * pi * pi * variance * f * f);
            for (size_t j = 0; j < taps.size(); ++j)
                taps[j] += rule.w[i] * highest * step * response *
                           std::cos(2 * pi * f * step *
                                    (static_cast<double>(j) - static_cast<double>(filter_half)));
        }
        return taps;
    }
    double mirror() const { return source_.settings.mirrored ? -1 : 1; }

    static std::vector<double> filtered(const std::vector<double> &values,
                                        const std::vector<double> &taps) {
        std::vector<double> out(values.size() - taps.size() + 1);
        convolve(taps, values, out);
        return out;
    }

    Spike spike(const EdgeWaves &edge) const {
        std::vector<double> constant(2 * wide + 1), slope(2 * wide + 1);
        for (size_t c = 0; c < colours_.size(); ++c)
            for (size_t j = 0; j < constant.size(); ++j) {
                const auto &[a, b] = edge.samples[c][j];
                for (size_t q = 0; q < lanes; ++q) {
                    const double weight = colours_[c].weight[q];
                    const double per_along = 2 * colours_[c].wavelength[q] / source_.pixel();
                    constant[j] += weight * (a.re[q] * a.re[q] + a.im[q] * a.im[q]);
                    slope[j] -= weight * per_along * (a.re[q] * b.re[q] + a.im[q] * b.im[q]);
                }
            }
        const std::vector<double> taps = filter(edge.axes, step_);
        constant = filtered(constant, taps);
        slope = filtered(slope, taps);
        Spike out;
        out.axes_ = edge.axes;
        out.scale_ = 1 / (4 * pi * pi * source_.area());
        out.tail_ = source_.mean_wavelength(2) / (2 * pi * pi * std::pow(source_.pixel(), 2));
        out.per_pixel_ = 1 / step_;
        out.reach_ = static_cast<double>(half) * step_;
        out.fringe_reach_ = source_.fringe_reach();
        // Mean over the edge's two ends; entries `per_unit` to a unit of x.
        constexpr double per_unit = 32;
        out.rounded_.assign(Spike::rounded_size, 1);
        for (const ArcEnd &arc : edge.arcs)
            if (arc.smooth) {
                out.rounding_ = per_unit * per_unit * 2 * std::abs(arc.radius) * source_.pixel() /
                                source_.mean_wavelength();
                for (size_t j = 0; j < Spike::rounded_size; ++j)
                    out.rounded_[j] -= (1 - rounded(static_cast<double>(j) / per_unit)) / 2;
            }
        out.most_ = std::ranges::max(constant);
        for (const double value : slope)
            out.steepest_ = std::max(out.steepest_, std::abs(value));
        out.constant_ = std::move(constant);
        out.slope_ = std::move(slope);
        return out;
    }

    using Group = std::vector<const EdgeWaves *>;
    std::vector<Group> groups() const {
        const auto direction = [](const EdgeWaves *e) {
            const double a = std::atan2(e->axes.ny, e->axes.nx);
            return a < 0 ? a + pi : a;
        };
        Group sorted;
        for (const EdgeWaves &edge : edges_)
            sorted.push_back(&edge);
        std::ranges::sort(sorted, {}, direction);
        std::vector<Group> groups;
        for (const EdgeWaves *edge : sorted) {
            if (groups.empty() || direction(edge) - direction(groups.back().back()) > widest_group)
                groups.emplace_back();
            groups.back().push_back(edge);
        }
        // Directions meet again after half a turn.
        if (groups.size() > 1 &&
            direction(groups.front().front()) + pi - direction(groups.back().back()) <
                widest_group) {
            groups.front().insert(groups.front().end(), groups.back().begin(), groups.back().end());
            groups.pop_back();
        }
        return groups;
    }

    // Of their lines, long edges' counting most.
    static SpikeAxes mean_axes(const Group &group) {
        double nx = 0, ny = 0;
        for (const EdgeWaves *e : group) {
            const double side = e->axes.nx * group[0]->axes.nx + e->axes.ny * group[0]->axes.ny;
            nx += std::copysign(e->length, side) * e->axes.nx;
            ny += std::copysign(e->length, side) * e->axes.ny;
        }
        return {nx / std::hypot(nx, ny), ny / std::hypot(nx, ny)};
    }

    // The distance from which on the middle of an edge's spike leaves the table.
    double leaves(const EdgeWaves &edge, const SpikeAxes &axes) const {
        constexpr double least = 4; // native pixels
        const double half_width = source_.mean_wavelength() / (source_.pixel() * edge.length);
        const double aside = std::max(least, 2.0 / 3 * source_.fringe_reach() - half_width);
        return aside / std::abs(axes.across(edge.axes.nx, edge.axes.ny));
    }

    Fringes fringes(const Group &group) const {
        Fringes out;
        for (const EdgeWaves *e : group)
            out.members_.push_back(static_cast<size_t>(e - edges_.data()));
        out.axes_ = mean_axes(group);
        // How far the group reaches along the spike and across it, in the pupil.
        double low = 1e9, high = -1e9, left = 1e9, right = -1e9;
        for (const EdgeWaves *e : group) {
            const double offset = out.axes_.along(e->x, e->y);
            low = std::min(low, offset);
            high = std::max(high, offset);
            const double middle = out.axes_.across(e->x, e->y);
            left = std::min(left, middle - e->length / 2);
            right = std::max(right, middle + e->length / 2);
        }
        const auto [blue, red] = std::ranges::minmax(source_.spectrum.wavelength);
        constexpr double per_fringe = 10, most_fringes = 3.5, nearest_end = 60, farthest = 1200,
                         per_wave = 4.5;
        const double per_pixel = std::max(high - low, 1e-3) * source_.pixel();
        const double along_step = std::min(20.0, blue / per_pixel / per_fringe);
        double end = std::min(farthest, most_fringes / (per_pixel * (1 / blue - 1 / red)));
        // Arcs are in tables alone.
        if (std::ranges::all_of(group, [](const EdgeWaves *e) { return e->arcs.empty(); }))
            for (const EdgeWaves *e : group)
                end = std::max(nearest_end, std::min(end, leaves(*e, out.axes_)));
        const double steps = std::clamp(
            std::floor(blue / ((right - left) * source_.pixel() * per_wave * step_)), 1.0, 4.0);
        const double step = steps * step_;
        out.nearest_ = source_.nearest;
        // What an edge makes with its arcs stays the same from there on.
        out.end_ = group.size() > 1 ? end : std::numeric_limits<double>::infinity();
        out.per_along_ = 1 / along_step;
        out.per_across_ = 1 / step;
        out.rows_ =
            std::max<int64_t>(8, static_cast<int64_t>((end - out.nearest_) / along_step) + 4);
        const double reach = source_.fringe_reach();
        const auto across = static_cast<std::ptrdiff_t>(reach / step);
        out.columns_ = 2 * across + 1;
        const std::vector<double> taps = filter(out.axes_, step);
        out.most_.assign(static_cast<size_t>(out.rows_), 0.0);
        for (const int side : {0, 1}) {
            std::vector<double> &table = out.table_[static_cast<size_t>(side)];
            for (int64_t row = 0; row < out.rows_; ++row) {
                const double along =
                    (side ? -1 : 1) * (out.nearest_ + static_cast<double>(row - 1) * along_step);
                std::vector<double> values =
                    filtered(together(group, out.axes_, along, across + filter_half, step), taps);
                for (std::ptrdiff_t j = -across; j <= across; ++j)
                    values[static_cast<size_t>(j + across)] *=
                        within(static_cast<double>(j) * step / reach);
                double &most = out.most_[static_cast<size_t>(row)];
                for (const double value : values)
                    most = std::max(most, std::abs(value));
                table.insert(table.end(), values.begin(), values.end());
            }
        }
        for (size_t row = out.most_.size() - 1; row-- > 0;)
            out.most_[row] = std::max(out.most_[row], out.most_[row + 1]);
        return out;
    }

    // Light at -reach..reach steps across beyond the sum of the members', times the distance's
    // square.
    std::vector<double> together(const Group &group, const SpikeAxes &axes, double along,
                                 std::ptrdiff_t reach, double step) const {
        const auto n = static_cast<size_t>(2 * reach + 1);
        const double first = -static_cast<double>(reach) * step;
        const double x0 = axes.nx * along - axes.ny * first, y0 = axes.ny * along + axes.nx * first;
        const double dx = -axes.ny * step, dy = axes.nx * step;
        const auto factor = [&](const SpikeAxes &facing) {
            return Ramp{facing.along(x0, y0), facing.along(dx, dy)};
        };
        std::vector<double> light(n);
        for (size_t c = 0; c < colours_.size(); ++c) {
            Lanes per_metre, per_wave;
            for (size_t q = 0; q < lanes; ++q) {
                per_metre[q] = source_.pixel() / colours_[c].wavelength[q];
                per_wave[q] = source_.optics.wavelength / colours_[c].wavelength[q];
            }
            const auto turns = [&](double x, double y, double waves) {
                Ramps out;
                for (size_t q = 0; q < lanes; ++q) {
                    out.start[q] = per_wave[q] * waves + per_metre[q] * (x0 * x + y0 * y);
                    out.step[q] = per_metre[q] * (dx * x + dy * y);
                }
                return out;
            };
            std::vector<Waves> sum(n);
            std::vector<Lanes> each(n);
            // Of one edge: what it makes with its arcs. Of a group: what its edges make.
            std::vector<Waves> part(n);
            const auto end_part = [&] {
                add_part(part, sum, each);
                std::ranges::fill(part, Waves{});
            };
            for (const EdgeWaves *e : group) {
                Lanes share;
                for (size_t q = 0; q < lanes; ++q)
                    share[q] = 1 / (e->axes.along(axes.nx, axes.ny) * along * per_metre[q]);
                add_edge(e->samples[c],
                         {e->axes.across(x0, y0) / step_ + static_cast<double>(wide),
                          e->axes.across(dx, dy) / step_},
                         share, factor(e->axes), turns(e->x, e->y, 0), part);
                if (group.size() == 1)
                    end_part();
                for (const ArcEnd &arc : e->arcs) {
                    const double normal = arc.axes.along(axes.nx, axes.ny) * along;
                    const bool conjugate = normal * arc.radius > 0;
                    Ramps x;
                    Lanes scale;
                    for (size_t q = 0; q < lanes; ++q) {
                        const double bend = std::abs(normal * per_metre[q] / arc.radius);
                        const double per_across =
                            (conjugate ? -1 : 1) * arc.tangent * per_metre[q] * std::sqrt(2 / bend);
                        x.start[q] = per_across * arc.axes.across(x0, y0);
                        x.step[q] = per_across * arc.axes.across(dx, dy);
                        scale[q] = arc.share / std::sqrt(2 * bend);
                    }
                    add_arc(x, conjugate, scale, factor(arc.axes), turns(arc.x, arc.y, arc.waves),
                            part);
                }
                end_part();
            }
            add_together(sum, each, colours_[c].weight, light);
        }
        for (size_t j = 0; j < n; ++j) {
            const double x = x0 + dx * static_cast<double>(j), y = y0 + dy * static_cast<double>(j);
            light[j] /= (x * x + y * y) * 4 * pi * pi * source_.area();
        }
        return light;
    }

    const FarSource &source_;
    double step_; // across, native pixels
    std::vector<Colours> colours_;
    std::vector<EdgeWaves> edges_;
};

Spikes make_spikes(const FarSource &source, const PupilEdges &edges) {
    return SpikeTables(source, edges).spikes();
}

} // namespace wfpsf
