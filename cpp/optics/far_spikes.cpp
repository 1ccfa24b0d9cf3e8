// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_spikes.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"
#include "numerics/quadrature.hpp"
#include "numerics/sinc.hpp"
#include "optics/fresnel.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>

namespace wfpsf {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

// ----------------------------------------------------------------------------------- interpolation

// Lagrange's cubic through the samples -1, 0, 1, 2, at 0 <= s < 1.
[[gnu::always_inline]] inline double cubic(double s, double before, double here, double next,
                                           double after) {
    const double a = s + 1, b = s - 1, c = s - 2;
    return s * b * (a * after - c * before) / 6 + a * c * (b * here - s * next) / 2;
}
[[gnu::always_inline]] inline double cubic(double s, const double *here) {
    return cubic(s, here[-1], here[0], here[1], here[2]);
}

// ----------------------------------------------------------------------------------- runs in a row

// Parts of a row between the roots of some conditions, where the middle is accepted.
template <class Accept>
std::vector<Run> accepted_runs(std::vector<double> roots, double x, int64_t n,
                               const Accept &accept) {
    const double last = x + static_cast<double>(n - 1);
    std::erase_if(roots, [&](double root) { return !(root > x && root < last); });
    roots.push_back(x);
    roots.push_back(last);
    std::ranges::sort(roots);
    std::vector<Run> runs;
    for (size_t i = 0; i + 1 < roots.size(); ++i)
        if (accept((roots[i] + roots[i + 1]) / 2)) {
            const auto first = static_cast<int64_t>(std::ceil(roots[i] - x));
            const auto end = static_cast<int64_t>(std::floor(roots[i + 1] - x));
            // A pixel on a root belongs to what is left of it.
            const int64_t begin = runs.empty() ? first : std::max(first, runs.back().last + 1);
            if (begin <= end)
                runs.push_back({begin, end});
        }
    return runs;
}

// Where a x^2 + b x + c = 0.
void add_roots(std::vector<double> &roots, double a, double b, double c) {
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0)
        return;
    const double sum = b + std::copysign(std::sqrt(discriminant), b);
    roots.push_back(-2 * c / sum);
    roots.push_back(-sum / (2 * a));
}

} // namespace

Run between(Run run, double start, double step, double low, double high) {
    const double a = (low - start) / step, b = (high - start) / step;
    if (std::isfinite(a) && std::isfinite(b)) {
        const auto first = static_cast<double>(run.first), last = static_cast<double>(run.last);
        run.first = static_cast<int64_t>(std::ceil(std::clamp(std::min(a, b), first, last + 1)));
        run.last = static_cast<int64_t>(std::floor(std::clamp(std::max(a, b), first - 1, last)));
    }
    return run;
}

std::vector<Run> runs_along(const SpikeAxes &axes, const PixelRow &row, double reach,
                            double nearest, double farthest) {
    const auto &[nx, ny] = axes;
    if (std::abs(row.y) > farthest + reach)
        return {};
    std::vector<double> roots{-ny * row.y / nx}; // along = 0
    for (const double side : {-1.0, 1.0}) {
        roots.push_back((nx * row.y - side * reach) / ny);
        for (const double end : {nearest, farthest})
            roots.push_back((side * end - ny * row.y) / nx);
    }
    return accepted_runs(std::move(roots), row.x, static_cast<int64_t>(row.light.size()),
                         [&](double x) {
                             const double along = std::abs(axes.along(x, row.y));
                             return std::abs(axes.across(x, row.y)) <= reach && along <= farthest &&
                                    along >= nearest;
                         });
}

double FarSource::bandwidth() const {
    return optics.aperture->diameter() * pixel() / std::ranges::min(spectrum.wavelength);
}

double FarSource::mean_wavelength(int power) const {
    double sum = 0;
    for (size_t q = 0; q < spectrum.size(); ++q)
        sum += spectrum.weight[q] * std::pow(spectrum.wavelength[q], power);
    return sum;
}

// --------------------------------------------------------------------------------------- one spike

namespace {

// What is left of the light of an edge's end where an arc goes on from it smoothly, by the place of
// the arc's point of stationary phase: the end's amplitude, 1 / (pi x), less Fresnel's tail.
double rounded(double x) {
    if (x < 1e-6)
        return 1;
    const auto tail = fresnel_tail(x) * pi * x;
    return std::pow(tail.real(), 2) + std::pow(tail.imag() - 1, 2);
}

struct SpikeTable {
    SpikeAxes axes;
    double scale, tail, per_pixel, reach, fringe_reach, rounding;
    const double *constant, *slope; // at the position -reach
    const double *rounded;
};

WFPSF_VECTORISED void add_spike(const SpikeTable &spike, double x0, double y, size_t n,
                                double *light) {
    const auto [nx, ny] = spike.axes;
    const double y2 = y * y;
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i);
        const double along = nx * x + ny * y, across = nx * y - ny * x;
        const double inverse = along / (x * x + y2);
        const double square = across * across;
        const bool near = square < spike.reach * spike.reach;
        const double place = near ? (across + spike.reach) * spike.per_pixel : 0;
        const auto cell = static_cast<int32_t>(place);
        const double s = place - cell;
        const double in_table =
            cubic(s, spike.constant + cell) + inverse * cubic(s, spike.slope + cell);
        const double value = near ? in_table : spike.tail / square;
        // Between the fringes' table and the rounding of the edge's ends.
        const double x_of_arc = std::min(std::sqrt(spike.rounding * square / std::abs(along)),
                                         Spike::rounded_size - 2.0);
        const auto arc_cell = static_cast<int32_t>(x_of_arc);
        const double *left = spike.rounded + arc_cell;
        const double share = left[0] + (x_of_arc - arc_cell) * (left[1] - left[0]);
        const double inner = within(across / spike.fringe_reach);
        light[i] += spike.scale * inverse * inverse * value * (inner + (1 - inner) * share);
    }
}

} // namespace

void Spike::add(const PixelRow &row, double floor) const {
    const auto &[nx, ny] = axes_;
    const double product = std::sqrt(2 * scale_ * tail_ / floor); // of along and across
    const double farthest = std::sqrt(2 * scale_ * most_ / floor);
    std::vector<double> roots;
    for (const double side : {-1.0, 1.0}) {
        add_roots(roots, -nx * ny, (nx * nx - ny * ny) * row.y,
                  nx * ny * row.y * row.y - side * product);
        roots.push_back((side * farthest - ny * row.y) / nx);         // along = side * farthest
        roots.push_back(row.y * (nx - side * ny) / (ny + side * nx)); // across = side * along
    }
    const auto runs = accepted_runs(
        std::move(roots), row.x, static_cast<int64_t>(row.light.size()), [&](double x) {
            const double along = std::abs(axes_.along(x, row.y));
            const double across = std::abs(axes_.across(x, row.y));
            return along * across <= product && along <= farthest && across <= along;
        });
    const SpikeTable table{axes_,
                           scale_,
                           tail_,
                           per_pixel_,
                           reach_,
                           fringe_reach_,
                           rounding_,
                           constant_.data() + 1,
                           slope_.data() + 1,
                           rounded_.data()};
    for (const Run &run : runs) {
        const PixelRow part = row.part(run.first, run.last);
        add_spike(table, part.x, part.y, part.light.size(), part.light.data());
    }
}

double Spike::brightest_off(double r, const SpikeAxes &other) const {
    const double sine = std::abs(axes_.across(other.nx, other.ny));
    const double cosine = std::abs(axes_.along(other.nx, other.ny));
    if (sine < same_direction)
        return brightest(r);
    // Its own tail, and the other spike's ends at either side of its line.
    const double nearest = (sine - same_direction / 2) * r;
    return cosine < same_direction ? 0 : 2 * scale_ * tail_ / std::pow(nearest * r * cosine, 2);
}

double Spike::half_width(double r, double floor) const {
    return brightest(r) < floor ? 0 : std::sqrt(scale_ * tail_ / floor) / r;
}

// ----------------------------------------------------------------------------------------- fringes

namespace {

struct FringeTable {
    SpikeAxes axes;
    double nearest, per_along, per_across;
    int64_t rows, columns;
    const double *table;
};

// On one side of the star: `side` is -1 or 1.
WFPSF_VECTORISED void add_fringes(const FringeTable &fringes, double side, double x0, double y,
                                  size_t n, double *light) {
    const auto [nx, ny] = fringes.axes;
    const int64_t half = fringes.columns / 2;
    const auto middle = static_cast<double>(half);
    const double last = static_cast<double>(fringes.rows) - 2.001;
    const double last_column = static_cast<double>(fringes.columns) - 2.001;
    for (size_t i = 0; i < n; ++i) {
        const double x = x0 + static_cast<double>(i);
        const double along = side * (nx * x + ny * y), across = nx * y - ny * x;
        const double column = std::clamp(across * fringes.per_across + middle, 1.0, last_column);
        const double row = std::clamp((along - fringes.nearest) * fringes.per_along + 1, 1.0, last);
        const auto j = static_cast<int32_t>(row), c = static_cast<int32_t>(column);
        const double s = column - c, t = row - j;
        const double *entry = fringes.table + j * fringes.columns + c;
        const double value =
            cubic(t, cubic(s, entry - fringes.columns), cubic(s, entry),
                  cubic(s, entry + fringes.columns), cubic(s, entry + 2 * fringes.columns));
        light[i] += value / (x * x + y * y);
    }
}

} // namespace

double Fringes::brightest(double r) const {
    if (r > end_)
        return 0;
    const double row = (r - nearest_) * per_along_;
    const auto last = static_cast<double>(rows_ - 1);
    return most_[static_cast<size_t>(std::clamp(row, 0.0, last))] / (r * r);
}

void Fringes::add(const PixelRow &row, double floor) const {
    const int64_t half = columns_ / 2;
    const double reach = static_cast<double>(half - 2) / per_across_;
    const double farthest = std::min(end_, std::sqrt(most_.front() / floor));
    const auto runs = runs_along(axes_, row, reach, nearest_, farthest);
    for (const Run &run : runs) {
        const PixelRow part = row.part(run.first, run.last);
        const double middle = part.x + static_cast<double>(part.light.size() - 1) / 2;
        const bool behind = axes_.along(middle, part.y) < 0;
        add_fringes(
            {axes_, nearest_, per_along_, per_across_, rows_, columns_, table_[behind].data()},
            behind ? -1 : 1, part.x, part.y, part.light.size(), part.light.data());
    }
}

// ---------------------------------------------------------------------------------- making of them

namespace {

// re + i im += weight exp(2 pi i (start + j turn))
WFPSF_VECTORISED void add_wave(Complex weight, double start, double turn, std::span<double> re,
                               std::span<double> im) {
    const double a = weight.real(), b = weight.imag();
    for (size_t j = 0; j < re.size(); ++j) {
        double cosine, sine;
        phasor(start + turn * static_cast<double>(j), cosine, sine);
        re[j] += a * cosine - b * sine;
        im[j] += a * sine + b * cosine;
    }
}

// Complex samples of a function.
struct Waves {
    std::vector<double> re, im;
    explicit Waves(size_t n) : re(n), im(n) {}
};

// Equal steps along a line of points: of a position in a table, or of a phase.
struct Ramp {
    double start, step;
    double at(size_t j) const { return start + step * static_cast<double>(j); }
};

// What the members of a group make on a row of points: the sum of their amplitudes, and of the
// light of each.
struct Row {
    std::vector<double> re, im, each;
    explicit Row(size_t n) : re(n), im(n), each(n) {}
};

// Adds factor * wave(position) * exp(2 pi i turns); outside its table the wave is zero.
WFPSF_VECTORISED void add_member(const Waves &wave, Ramp position, Ramp turns,
                                 std::span<const double> factor, Row &row) {
    const double last = static_cast<double>(wave.re.size()) - 3;
    const double *wave_re = wave.re.data(), *wave_im = wave.im.data();
    for (size_t j = 0; j < row.re.size(); ++j) {
        const double at = position.at(j), inside = at >= 1 && at < last ? 1 : 0;
        const double cell = inside > 0 ? at : 1;
        const auto first = static_cast<int32_t>(cell);
        const double s = cell - first;
        const double a = cubic(s, wave_re + first), b = cubic(s, wave_im + first);
        double cosine, sine;
        phasor(turns.at(j), cosine, sine);
        const double f = inside * factor[j];
        row.re[j] += f * (a * cosine - b * sine);
        row.im[j] += f * (a * sine + b * cosine);
        row.each[j] += f * f * (a * a + b * b);
    }
}

// A curved edge that goes on from the end of a straight one, in about its direction.
struct ArcEnd {
    SpikeAxes axes; // along the outward normal at the end
    double x, y;    // of the end, m
    double tangent; // +1: the edge runs along the axes' across, -1: against it
    double radius;  // of curvature; negative: the light is on the outside
    bool smooth;    // without a kink
    double waves;   // wavefront there, in the unit of the optics'
};

// exp(-i pi x^2 / 2) times Fresnel's integral from x to infinity: an arc's amplitude by where its
// point of stationary phase stands before its end.
class ArcWave {
  public:
    static const ArcWave &get() {
        static const ArcWave wave;
        return wave;
    }
    const Waves &of(bool conjugate) const { return conjugate ? conjugate_ : plain_; }
    // Where an argument stands in the table.
    static double position(double x) { return (x + before) * per_unit; }

  private:
    static constexpr double before = 6, after = 60, per_unit = 32;
    static constexpr auto samples = static_cast<size_t>((before + after) * per_unit);
    ArcWave() : plain_(samples), conjugate_(samples) {
        for (size_t j = 0; j < samples; ++j) {
            const Complex value = fresnel_tail(static_cast<double>(j) / per_unit - before);
            plain_.re[j] = conjugate_.re[j] = value.real();
            plain_.im[j] = value.imag();
            conjugate_.im[j] = -value.imag();
        }
    }
    Waves plain_, conjugate_;
};

// An edge and its integrals by colour and position across the spike.
struct EdgeWaves {
    SpikeAxes axes;                     // along the outward normal
    double x, y, length;                // middle, m
    std::vector<Waves> constant, slope; // of 1 and of W_n
    std::vector<ArcEnd> arcs = {};
};

} // namespace

class SpikeTables {
  public:
    SpikeTables(const FarSource &source, const PupilEdges &edges)
        : source_(source), step_(0.25 / std::max(1.0, source.bandwidth())) {
        for (const StraightEdge &edge : edges.straight)
            edges_.push_back(waves(edge));
        for (const Junction &junction : junctions(edges)) {
            EdgeWaves &edge = edges_[junction.straight];
            const CurvedEdge &arc = edges.curved[junction.curved];
            if (junction.kink < widest_kink)
                add_arc(edge, arc, junction);
            else
                add_corner(edge, arc, junction);
        }
    }

    Spikes spikes() const {
        Spikes out;
        for (const EdgeWaves &edge : edges_)
            out.spikes.push_back(spike(edge));
        for (const EdgeWaves &edge : edges_)
            if (!edge.arcs.empty())
                out.fringes.push_back(fringes({&edge}));
        for (const std::vector<const EdgeWaves *> &group : groups())
            if (group.size() > 1)
                out.fringes.push_back(fringes(group));
        return out;
    }

  private:
    static constexpr std::ptrdiff_t half = 256;       // of a profile, steps
    static constexpr std::ptrdiff_t filter_half = 20; // of the pixel's filter, steps
    static constexpr std::ptrdiff_t wide = half + 1 + filter_half;
    static constexpr double widest_group = 7 * pi / 180; // between neighbours in a group
    static constexpr double smooth = 0.01;               // radians

    EdgeWaves waves(const StraightEdge &edge) const {
        const double dx = edge.to_x - edge.from_x, dy = edge.to_y - edge.from_y;
        const double length = std::hypot(dx, dy);
        EdgeWaves out{{dy / length, -dx / length},
                      (edge.from_x + edge.to_x) / 2,
                      (edge.from_y + edge.to_y) / 2,
                      length,
                      {},
                      {}};
        const auto &[nx, ny] = out.axes;
        for (const double wavelength : source_.spectrum.wavelength) {
            const Wavefront w = source_.wavefront(wavelength);
            const double turn = source_.pixel() * step_ / wavelength; // per metre
            const GaussLegendre rule(
                8 + gauss_legendre_points(pi * turn * static_cast<double>(wide) * length, 1e-8));
            Waves &constant = out.constant.emplace_back(2 * wide + 1);
            Waves &slope = out.slope.emplace_back(2 * wide + 1);
            for (size_t i = 0; i < rule.x.size(); ++i) {
                // Across the spike: (nx, ny) turned by 90 degrees.
                const double s = rule.x[i] * length / 2;
                const double x = out.x - ny * s, y = out.y + nx * s;
                constexpr double h = 1e-3;
                const double normal_slope =
                    (w(x + h * nx, y + h * ny) - w(x - h * nx, y - h * ny)) / (2 * h);
                const Complex wave = std::polar(rule.w[i] * length / 2, 2 * pi * w(x, y));
                const double start = -turn * static_cast<double>(wide) * s;
                add_wave(wave, start, turn * s, constant.re, constant.im);
                add_wave(wave * normal_slope, start, turn * s, slope.re, slope.im);
            }
        }
        return out;
    }

    // What an arc that turns off from the edge's end sends from there. It goes as the inverse of k,
    // like the slope.
    void add_corner(EdgeWaves &edge, const CurvedEdge &arc, const Junction &junction) const {
        const Oval &o = arc.oval;
        const double a = junction.at_begin ? arc.begin : arc.end;
        const double u = std::cos(a), v = std::sin(a);
        const double x = o.x + o.half_width * u, y = o.y + o.shear * u + o.half_height * v;
        // Out of the lit side, and away from the corner.
        const double way = arc.lit_inside ? 1 : -1, onwards = junction.at_begin ? 1 : -1;
        const double dx = -o.half_width * v, dy = o.half_height * u - o.shear * v;
        const double normal = way * edge.axes.along(dy, -dx);
        const double tangent = onwards * edge.axes.along(dx, dy);
        const double s = edge.axes.across(x - edge.x, y - edge.y);
        for (size_t q = 0; q < source_.spectrum.size(); ++q) {
            const double wavelength = source_.spectrum.wavelength[q];
            const double turn = source_.pixel() * step_ / wavelength;
            const Complex wave = std::polar(normal / tangent / (2 * pi),
                                            2 * pi * source_.wavefront(wavelength)(x, y) - pi / 2);
            add_wave(wave, -turn * static_cast<double>(wide) * s, turn * s, edge.slope[q].re,
                     edge.slope[q].im);
        }
    }

    void add_arc(EdgeWaves &edge, const CurvedEdge &arc, const Junction &junction) const {
        const Oval &o = arc.oval;
        const double a = junction.at_begin ? arc.begin : arc.end;
        const double u = std::cos(a), v = std::sin(a), way = junction.at_begin ? 1 : -1;
        const double x = o.half_width * u, y = o.shear * u + o.half_height * v;
        const double dx = -way * o.half_width * v;
        const double dy = way * (o.half_height * u - o.shear * v);
        const double speed = std::hypot(dx, dy), tangent = junction.at_to ? 1 : -1;
        const SpikeAxes normal{tangent * dy / speed, -tangent * dx / speed};
        const double radius = std::pow(speed, 3) / (o.half_width * o.half_height);
        edge.arcs.push_back({normal, o.x + x, o.y + y, tangent,
                             std::copysign(radius, normal.along(x, y)), junction.kink < smooth,
                             source_.optics.wavefront(o.x + x, o.y + y)});
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
    double fringe_reach() const { return 96 * step_; }
    double mirror() const { return source_.settings.mirrored ? -1 : 1; }

    static std::vector<double> filtered(const std::vector<double> &values,
                                        const std::vector<double> &taps) {
        std::vector<double> out(values.size() - taps.size() + 1);
        for (size_t i = 0; i < out.size(); ++i)
            out[i] = std::inner_product(taps.begin(), taps.end(),
                                        values.begin() + static_cast<std::ptrdiff_t>(i), 0.0);
        return out;
    }

    Spike spike(const EdgeWaves &edge) const {
        std::vector<double> constant(2 * wide + 1), slope(2 * wide + 1);
        for (size_t q = 0; q < source_.spectrum.size(); ++q) {
            const double weight = source_.spectrum.weight[q];
            const double per_along = 2 * source_.spectrum.wavelength[q] / source_.pixel();
            for (size_t j = 0; j < constant.size(); ++j) {
                const Waves &c = edge.constant[q], &s = edge.slope[q];
                constant[j] += weight * (c.re[j] * c.re[j] + c.im[j] * c.im[j]);
                slope[j] -= weight * per_along * (c.re[j] * s.re[j] + c.im[j] * s.im[j]);
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
        out.fringe_reach_ = fringe_reach();
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

    std::vector<std::vector<const EdgeWaves *>> groups() const {
        const auto direction = [](const EdgeWaves *e) {
            const double a = std::atan2(e->axes.ny, e->axes.nx);
            return a < 0 ? a + pi : a;
        };
        std::vector<const EdgeWaves *> sorted;
        for (const EdgeWaves &edge : edges_)
            sorted.push_back(&edge);
        std::ranges::sort(sorted, {}, direction);
        std::vector<std::vector<const EdgeWaves *>> groups;
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

    Fringes fringes(const std::vector<const EdgeWaves *> &group) const {
        Fringes out;
        double nx = 0, ny = 0;
        for (const EdgeWaves *e : group) {
            out.members_.push_back(static_cast<size_t>(e - edges_.data()));
            const double side = e->axes.nx * group[0]->axes.nx + e->axes.ny * group[0]->axes.ny;
            nx += std::copysign(e->length, side) * e->axes.nx;
            ny += std::copysign(e->length, side) * e->axes.ny;
        }
        out.axes_ = {nx / std::hypot(nx, ny), ny / std::hypot(nx, ny)};
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
        constexpr double per_fringe = 10, most_fringes = 3.5, farthest = 1200, per_wave = 4.5;
        const double per_pixel = std::max(high - low, 1e-3) * source_.pixel();
        const double along_step = std::min(20.0, blue / per_pixel / per_fringe);
        const double end = std::min(farthest, most_fringes / (per_pixel * (1 / blue - 1 / red)));
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
        const auto across = static_cast<std::ptrdiff_t>(fringe_reach() / step);
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
                        within(static_cast<double>(j) * step / fringe_reach());
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
    std::vector<double> together(const std::vector<const EdgeWaves *> &group, const SpikeAxes &axes,
                                 double along, std::ptrdiff_t reach, double step) const {
        const auto n = static_cast<size_t>(2 * reach + 1);
        const double first = -static_cast<double>(reach) * step;
        const double x0 = axes.nx * along - axes.ny * first, y0 = axes.ny * along + axes.nx * first;
        const double dx = -axes.ny * step, dy = axes.nx * step;
        std::vector<double> sum(n), factor(n);
        for (size_t q = 0; q < source_.spectrum.size(); ++q) {
            const double wavelength = source_.spectrum.wavelength[q];
            const double per_metre = source_.pixel() / wavelength;
            Row row(n), own(n);
            const auto add = [&](const Waves &wave, const SpikeAxes &facing, Ramp position,
                                 double px, double py, double phase, double scale) {
                for (size_t j = 0; j < n; ++j) {
                    const double x = x0 + dx * static_cast<double>(j);
                    const double y = y0 + dy * static_cast<double>(j);
                    factor[j] = scale * facing.along(x, y) / (x * x + y * y);
                }
                add_member(
                    wave, position,
                    {phase + per_metre * (x0 * px + y0 * py), per_metre * (dx * px + dy * py)},
                    factor, own);
            };
            for (const EdgeWaves *e : group) {
                const double k_n = e->axes.along(axes.nx, axes.ny) * along * per_metre;
                Waves wave = e->constant[q];
                const double share = 1 / k_n;
                for (size_t j = 0; j < wave.re.size(); ++j) {
                    wave.re[j] -= share * e->slope[q].re[j];
                    wave.im[j] -= share * e->slope[q].im[j];
                }
                add(wave, e->axes,
                    {e->axes.across(x0, y0) / step_ + static_cast<double>(wide),
                     e->axes.across(dx, dy) / step_},
                    e->x, e->y, 0, 1);
                for (const ArcEnd &arc : e->arcs) {
                    const double normal = arc.axes.along(axes.nx, axes.ny) * along * per_metre;
                    const double bend = std::abs(normal / arc.radius);
                    const bool conjugate = normal * arc.radius > 0;
                    const double per_across =
                        (conjugate ? -1 : 1) * arc.tangent * per_metre * std::sqrt(2 / bend);
                    const double start = per_across * arc.axes.across(x0, y0);
                    const double turn = per_across * arc.axes.across(dx, dy);
                    add(ArcWave::get().of(conjugate), arc.axes,
                        {ArcWave::position(start),
                         ArcWave::position(start + turn) - ArcWave::position(start)},
                        arc.x, arc.y, arc.waves * source_.optics.wavelength / wavelength,
                        1 / std::sqrt(2 * bend));
                }
                // Of one edge: what it makes with its arcs. Of a group: what its edges make.
                for (size_t j = 0; j < n; ++j) {
                    row.re[j] += own.re[j];
                    row.im[j] += own.im[j];
                    row.each[j] += group.size() == 1
                                       ? own.each[j]
                                       : own.re[j] * own.re[j] + own.im[j] * own.im[j];
                    own.re[j] = own.im[j] = own.each[j] = 0;
                }
            }
            for (size_t j = 0; j < n; ++j)
                sum[j] += source_.spectrum.weight[q] *
                          (row.re[j] * row.re[j] + row.im[j] * row.im[j] - row.each[j]);
        }
        for (size_t j = 0; j < n; ++j) {
            const double x = x0 + dx * static_cast<double>(j), y = y0 + dy * static_cast<double>(j);
            sum[j] *= (x * x + y * y) / (4 * pi * pi * source_.area());
        }
        return sum;
    }

    const FarSource &source_;
    double step_; // across, native pixels
    std::vector<EdgeWaves> edges_;
};

Spikes make_spikes(const FarSource &source, const PupilEdges &edges) {
    return SpikeTables(source, edges).spikes();
}

} // namespace wfpsf
