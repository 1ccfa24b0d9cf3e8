// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/far_spikes.hpp"

#include "numerics/dispatch.hpp"
#include "numerics/phasor.hpp"
#include "numerics/quadrature.hpp"
#include "numerics/sinc.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace wfpsf {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

// ------------------------------------------------------------------------------------ interpolation

// Lagrange's cubic through four samples.
struct Cubic {
    std::ptrdiff_t first;
    std::array<double, 4> w;
    explicit Cubic(double position) {
        const double cell = std::floor(position), s = position - cell;
        first = static_cast<std::ptrdiff_t>(cell) - 1;
        w = {-s * (s - 1) * (s - 2) / 6, (s + 1) * (s - 1) * (s - 2) / 2,
             -(s + 1) * s * (s - 2) / 2, (s + 1) * s * (s - 1) / 6};
    }
};

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
            if (!runs.empty() && runs.back().last >= first - 1)
                runs.back().last = end;
            else if (first <= end)
                runs.push_back({first, end});
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

// All within 45 degrees of the spike; what is left is no spike.
double Spike::at(double x, double y) const {
    const double along = axes_.along(x, y), across = axes_.across(x, y);
    if (std::abs(across) > std::abs(along))
        return 0;
    const double inverse = along / (x * x + y * y);
    if (std::abs(across) >= reach_)
        return scale_ * inverse * inverse * tail_ / (across * across);
    const Cubic cubic((across + reach_) * per_step_ + 1);
    double constant = 0, slope = 0;
    for (size_t i = 0; i < 4; ++i) {
        const auto &entry = profile_[static_cast<size_t>(cubic.first) + i];
        constant += cubic.w[i] * entry[0];
        slope += cubic.w[i] * entry[1];
    }
    return scale_ * inverse * inverse * (constant + slope * inverse);
}

std::vector<Run> Spike::runs(double x, double y, int64_t n, double floor) const {
    const auto &[nx, ny] = axes_;
    const double product = std::sqrt(scale_ * 2 * tail_ / floor); // of along and across
    const double farthest = std::sqrt(2 * scale_ * most_ / floor);
    std::vector<double> roots;
    for (const double side : {-1.0, 1.0}) {
        // along * across = side * product
        add_roots(roots, -nx * ny, (nx * nx - ny * ny) * y, nx * ny * y * y - side * product);
        roots.push_back((side * farthest - ny * y) / nx);          // along = side * farthest
        roots.push_back(y * (nx - side * ny) / (ny + side * nx)); // across = side * along
    }
    return accepted_runs(std::move(roots), x, n, [&](double at) {
        const double along = std::abs(axes_.along(at, y)), across = std::abs(axes_.across(at, y));
        return along * across <= product && along <= farthest && across <= along;
    });
}

template <class T> void Spike::add(double x, double y, double flux, std::span<T> image) const {
    for (size_t i = 0; i < image.size(); ++i)
        image[i] += static_cast<T>(flux * at(x + static_cast<double>(i), y));
}

double Spike::half_width(double r, double floor) const {
    return brightest(r) < floor ? 0 : std::sqrt(scale_ * tail_ / floor) / r;
}

// ----------------------------------------------------------------------------------------- fringes

double Fringes::at(double x, double y) const {
    const double along = axes_.along(x, y), across = axes_.across(x, y);
    const double column = across * per_across_ + static_cast<double>(columns_ / 2);
    const double row = std::min((std::abs(along) - nearest_) * per_along_ + 1,
                                static_cast<double>(rows_ - 3));
    if (!(column >= 1 && column < static_cast<double>(columns_ - 2) && row >= 1))
        return 0;
    const Cubic in_row(column), over_rows(row);
    const double *entry = table_[along < 0].data() + over_rows.first * columns_ + in_row.first;
    double sum = 0;
    for (size_t j = 0; j < 4; ++j, entry += columns_)
        sum += over_rows.w[j] * (in_row.w[0] * entry[0] + in_row.w[1] * entry[1] +
                                 in_row.w[2] * entry[2] + in_row.w[3] * entry[3]);
    return sum / (x * x + y * y);
}

std::vector<Run> Fringes::runs(double x, double y, int64_t n, double floor) const {
    const auto &[nx, ny] = axes_;
    const double reach = static_cast<double>(columns_ / 2) / per_across_;
    const double farthest = std::sqrt(most_ / floor);
    std::vector<double> roots;
    for (const double side : {-1.0, 1.0}) {
        roots.push_back((nx * y - side * reach) / ny);
        roots.push_back((side * farthest - ny * y) / nx);
    }
    return accepted_runs(std::move(roots), x, n, [&](double at) {
        return std::abs(axes_.across(at, y)) <= reach && std::abs(axes_.along(at, y)) <= farthest;
    });
}

template <class T> void Fringes::add(double x, double y, double flux, std::span<T> image) const {
    for (size_t i = 0; i < image.size(); ++i)
        image[i] += static_cast<T>(flux * at(x + static_cast<double>(i), y));
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

struct Waves {
    std::vector<double> re, im;
    explicit Waves(size_t n) : re(n), im(n) {}
    Complex operator[](size_t j) const { return {re[j], im[j]}; }
    Complex at(double position) const {
        if (!(position >= 1 && position < static_cast<double>(re.size() - 2)))
            return 0;
        const Cubic cubic(position);
        Complex sum = 0;
        for (size_t i = 0; i < 4; ++i)
            sum += cubic.w[i] * (*this)[static_cast<size_t>(cubic.first) + i];
        return sum;
    }
};

// An edge and its integrals by colour and position across the spike.
struct EdgeWaves {
    SpikeAxes axes; // along the outward normal
    double x, y, length; // middle, m
    std::vector<Waves> constant, slope; // of 1 and of W_n
};

} // namespace

class SpikeTables {
  public:
    SpikeTables(const FarSource &source, const std::vector<StraightEdge> &edges)
        : source_(source), step_(0.25 / std::max(1.0, source.bandwidth())) {
        for (const StraightEdge &edge : edges)
            edges_.push_back(waves(edge));
    }

    Spikes spikes() const {
        Spikes out;
        for (const EdgeWaves &edge : edges_)
            out.spikes.push_back(spike(edge));
        for (const std::vector<const EdgeWaves *> &group : groups())
            if (group.size() > 1)
                out.fringes.push_back(fringes(group));
        return out;
    }

  private:
    static constexpr std::ptrdiff_t half = 256;          // of a profile, steps
    static constexpr std::ptrdiff_t filter_half = 24;    // of the pixel's filter, steps
    static constexpr std::ptrdiff_t wide = half + 2 + filter_half;
    static constexpr double widest_group = 7 * pi / 180; // between neighbours in a group

    EdgeWaves waves(const StraightEdge &edge) const {
        const double dx = edge.to_x - edge.from_x, dy = edge.to_y - edge.from_y;
        const double length = std::hypot(dx, dy);
        EdgeWaves out{{dy / length, -dx / length}, (edge.from_x + edge.to_x) / 2,
                      (edge.from_y + edge.to_y) / 2, length, {}, {}};
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

    // The pixel and the blur across a spike, for waves up to the bandwidth.
    std::vector<double> filter(const SpikeAxes &axes) const {
        const auto &[nx, ny] = axes;
        const Covariance &blur = source_.settings.blur;
        const double variance = blur.xx * ny * ny - 2 * blur.xy * mirror() * nx * ny +
                                blur.yy * nx * nx;
        const double highest = 0.5 / step_;
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
                taps[j] += rule.w[i] * highest * step_ * response *
                           std::cos(2 * pi * f * step_ *
                                    (static_cast<double>(j) - static_cast<double>(filter_half)));
        }
        return taps;
    }
    double mirror() const { return source_.settings.mirrored ? -1 : 1; }

    static std::vector<double> filtered(const std::vector<double> &values,
                                        const std::vector<double> &taps) {
        std::vector<double> out(values.size() - taps.size() + 1);
        for (size_t i = 0; i < out.size(); ++i)
            out[i] = std::inner_product(taps.begin(), taps.end(), values.begin() +
                                        static_cast<std::ptrdiff_t>(i), 0.0);
        return out;
    }

    Spike spike(const EdgeWaves &edge) const {
        std::vector<double> constant(2 * wide + 1), slope(2 * wide + 1);
        for (size_t q = 0; q < source_.spectrum.size(); ++q) {
            const double weight = source_.spectrum.weight[q];
            const double per_along = 2 * source_.spectrum.wavelength[q] / source_.pixel();
            for (size_t j = 0; j < constant.size(); ++j) {
                constant[j] += weight * std::norm(edge.constant[q][j]);
                slope[j] -= weight * per_along *
                            (edge.constant[q][j] * std::conj(edge.slope[q][j])).real();
            }
        }
        const std::vector<double> taps = filter(edge.axes);
        constant = filtered(constant, taps);
        slope = filtered(slope, taps);
        Spike out;
        out.axes_ = edge.axes;
        out.scale_ = 1 / (4 * pi * pi * source_.area());
        out.tail_ = source_.mean_wavelength(2) / (2 * pi * pi * std::pow(source_.pixel(), 2));
        out.per_step_ = 1 / step_;
        out.reach_ = static_cast<double>(half) * step_;
        for (size_t j = 1; j + 1 < constant.size(); ++j)
            out.profile_.push_back({constant[j], slope[j]});
        out.profile_.push_back({constant.back(), slope.back()});
        out.most_ = std::ranges::max(constant);
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
            if (groups.empty() ||
                direction(edge) - direction(groups.back().back()) > widest_group)
                groups.emplace_back();
            groups.back().push_back(edge);
        }
        // Directions meet again after half a turn.
        if (groups.size() > 1 && direction(groups.front().front()) + pi -
                                         direction(groups.back().back()) <
                                     widest_group) {
            groups.front().insert(groups.front().end(), groups.back().begin(),
                                  groups.back().end());
            groups.pop_back();
        }
        return groups;
    }

    Fringes fringes(const std::vector<const EdgeWaves *> &group) const {
        Fringes out;
        double nx = 0, ny = 0;
        for (const EdgeWaves *e : group) {
            const double side = e->axes.nx * group[0]->axes.nx + e->axes.ny * group[0]->axes.ny;
            nx += std::copysign(e->length, side) * e->axes.nx;
            ny += std::copysign(e->length, side) * e->axes.ny;
        }
        out.axes_ = {nx / std::hypot(nx, ny), ny / std::hypot(nx, ny)};
        double low = 1e9, high = -1e9;
        for (const EdgeWaves *e : group) {
            const double offset = out.axes_.along(e->x, e->y);
            low = std::min(low, offset);
            high = std::max(high, offset);
        }
        const auto [blue, red] = std::ranges::minmax(source_.spectrum.wavelength);
        constexpr double per_fringe = 11, most_fringes = 7;
        const double per_pixel = std::max(high - low, 1e-3) * source_.pixel();
        const double step = std::min(20.0, blue / per_pixel / per_fringe);
        const double end = most_fringes / (per_pixel * (1 / blue - 1 / red));
        out.nearest_ = source_.nearest;
        out.per_along_ = 1 / step;
        out.per_across_ = 1 / step_;
        out.rows_ = std::min<int64_t>(400, static_cast<int64_t>((end - out.nearest_) / step) + 4);
        constexpr std::ptrdiff_t across = 96;
        out.columns_ = 2 * across + 1;
        const std::vector<double> taps = filter(out.axes_);
        out.most_ = 0;
        for (const int side : {0, 1}) {
            std::vector<double> &table = out.table_[static_cast<size_t>(side)];
            for (int64_t row = 0; row < out.rows_; ++row) {
                const double along = (side ? -1 : 1) *
                                     (out.nearest_ + static_cast<double>(row - 1) * step);
                std::vector<double> values;
                for (std::ptrdiff_t j = -across - filter_half; j <= across + filter_half; ++j)
                    values.push_back(together(group, out.axes_, along, static_cast<double>(j) * step_));
                values = filtered(values, taps);
                for (const double value : values)
                    out.most_ = std::max(out.most_, std::abs(value));
                table.insert(table.end(), values.begin(), values.end());
            }
        }
        return out;
    }

    // Light there beyond the sum of the edges', times the distance's square.
    double together(const std::vector<const EdgeWaves *> &group, const SpikeAxes &axes,
                    double along, double across) const {
        const double x = axes.nx * along - axes.ny * across, y = axes.ny * along + axes.nx * across;
        const double r2 = x * x + y * y;
        double sum = 0;
        for (size_t q = 0; q < source_.spectrum.size(); ++q) {
            const double per_metre = source_.pixel() / source_.spectrum.wavelength[q];
            Complex all = 0;
            double each = 0;
            for (const EdgeWaves *e : group) {
                const double k_n = e->axes.along(x, y);
                const double position = e->axes.across(x, y) / step_ + static_cast<double>(wide);
                const Complex wave =
                    k_n / r2 *
                    (e->constant[q].at(position) - e->slope[q].at(position) / (k_n * per_metre));
                const double turns = per_metre * (x * e->x + y * e->y);
                all += wave * std::polar(1.0, 2 * pi * turns);
                each += std::norm(wave);
            }
            sum += source_.spectrum.weight[q] * (std::norm(all) - each);
        }
        return sum * r2 / (4 * pi * pi * source_.area());
    }

    const FarSource &source_;
    double step_; // across, native pixels
    std::vector<EdgeWaves> edges_;
};

Spikes make_spikes(const FarSource &source, const std::vector<StraightEdge> &edges) {
    return SpikeTables(source, edges).spikes();
}

template void Spike::add(double, double, double, std::span<float>) const;
template void Spike::add(double, double, double, std::span<double>) const;
template void Fringes::add(double, double, double, std::span<float>) const;
template void Fringes::add(double, double, double, std::span<double>) const;

} // namespace wfpsf
