// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/galaxy.hpp"

#include "error/error.hpp"
#include "optics/resample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// Sizes of transforms that are fast.
constexpr std::array<int64_t, 13> sizes{16,  24,  32,  48,  64,   96,  144,
                                        192, 288, 384, 576, 1152, 2304};
constexpr int64_t most_pixels = 576; // across an image that is drawn on one grid

int64_t size_for(double samples) {
    for (const int64_t size : sizes)
        if (static_cast<double>(size) >= samples)
            return size;
    return sizes.back();
}

// A galaxy that needs more pixels is a sum over levels. Level l holds wave numbers around
// split / ratio^l, on a grid of ratio^l pixels. The step from one level to the next is a smooth
// one, so that a level's light lies within most_pixels / 2 steps of the centre, but for 1e-6: with
// a Gaussian's integral of width split / (2 sharpness) that takes sharpness^2 = -log(1e-6) pi
// split / ...
constexpr int64_t ratio = 8;
constexpr double sharpness = 3.3;
constexpr double split = 3.9 / (static_cast<double>(most_pixels) / 2); // cycles per pixel
constexpr double band = 2 * split * ratio; // cycles per sample, that a coarse grid holds

int64_t step_of(int level) {
    int64_t step = 1;
    for (int i = 0; i < level; ++i)
        step *= ratio;
    return step;
}

// The share of the wave numbers k that levels above `level` hold.
double beyond(double k, int level) {
    const double relative = k / split * static_cast<double>(step_of(level));
    return relative >= 2 ? 0 : std::erfc(sharpness * (relative - 1)) / 2;
}

double share_of(double k, int level, bool top) {
    return (level == 0 ? 1 : beyond(k, level - 1)) - (top ? 0 : beyond(k, level));
}

const BandlimitedInterpolator &interpolator() {
    static const BandlimitedInterpolator it(band, 1e-7);
    return it;
}

// The largest value on the frame `margin` samples inside.
double largest_on_frame(View<const double> samples, int64_t margin) {
    const int64_t last = samples.nx - 1 - margin;
    double most = 0;
    for (int64_t i = margin; i <= last; ++i)
        for (const double value : {samples(i, margin), samples(i, last), samples(margin, i),
                                   samples(last, i)})
            most = std::max(most, std::abs(value));
    return most;
}

struct Range {
    int64_t first, last;
    bool empty() const { return first > last; }
    int64_t count() const { return last - first + 1; }
};

void require_tolerance(double tolerance) {
    if (!(tolerance > 0))
        fail(WFPSF_ERROR_RANGE, "tolerance = %g: must be > 0", tolerance);
}

Range overlap(int64_t centre, int64_t below, int64_t above, int64_t pixels) {
    return {std::max<int64_t>(centre - below, 0), std::min(centre + above, pixels - 1)};
}

} // namespace

Transfer transfer_of(const Otf &otf, double pixel_scale) {
    return {[&otf, pixel_scale](double kx, double ky) {
                return otf.effective(kx / pixel_scale, ky / pixel_scale);
            },
            otf.cutoff() * pixel_scale};
}

struct GalaxyDrawer::Shape {
    const Sersic &profile;
    double radius;           // half-light, pixels
    double longest;          // half axis of the half-light ellipse, pixels
    double xx, xy, yy;       // of the wave form
    double flux;             // |flux|
    double wave(double k) const { return 2 * pi * radius * (radius / longest) * k; } // smallest
    double density() const { return flux / (2 * pi * radius * radius); }
};

GalaxyDrawer::GalaxyDrawer(Transfer transfer, double pixel_scale, SersicProfiles &profiles)
    : transfer_(std::move(transfer)), pixel_scale_(pixel_scale), profiles_(profiles) {}

GalaxyDrawer::Shape GalaxyDrawer::shape_of(const Galaxy &galaxy) {
    for (const auto &[name, value] : {std::pair("x", galaxy.x), std::pair("y", galaxy.y),
                                      std::pair("flux", galaxy.flux)})
        if (!std::isfinite(value))
            fail(WFPSF_ERROR_NOT_FINITE, "galaxy %s = %g: must be finite", name, value);
    if (!(galaxy.half_light_radius > 0 && galaxy.half_light_radius < 1e6))
        fail(WFPSF_ERROR_RANGE, "galaxy half_light_radius = %g arcsec: must be > 0 and < 1e6",
             galaxy.half_light_radius);
    const double e = std::hypot(galaxy.e1, galaxy.e2);
    if (!(e < 1))
        fail(WFPSF_ERROR_RANGE, "galaxy ellipticity (e1, e2) = (%g, %g): |e| must be < 1",
             galaxy.e1, galaxy.e2);
    const double radius = galaxy.half_light_radius / pixel_scale_;
    const double scale = 4 * pi * pi * radius * radius / (1 - e * e);
    return {profiles_.of(galaxy.sersic_index),
            radius,
            radius * std::sqrt((1 + e) / (1 - e)),
            scale * (1 + e * e + 2 * galaxy.e1),
            scale * 2 * galaxy.e2,
            scale * (1 + e * e - 2 * galaxy.e1),
            std::abs(galaxy.flux)};
}

const GalaxyGrid &GalaxyDrawer::grid(int64_t size, int level, bool top) {
    const std::array<int64_t, 3> key{size, level, top};
    auto found = grids_.find(key);
    if (found == grids_.end())
        found = grids_
                    .try_emplace(key, transfer_, size, step_of(level),
                                 [=](double k) { return share_of(k, level, top); })
                    .first;
    return found->second;
}

// From transforms of a size whose folds hardly matter.
void GalaxyDrawer::measure_psf() {
    constexpr int64_t size = 96;
    const GalaxyGrid &all = grid(size, 0, true);
    curvature_ = all.curvature();
    const SersicTable &gaussian = profiles_.of(0.5).table();
    for (const double radius : {1e-9, 1.0, 2.0, 4.0, 8.0}) {
        const double square = 4 * pi * pi * radius * radius;
        const View<double> psf =
            all.draw(gaussian, {square, 0, square, gaussian.highest()}, 0, 0, 1, buffers_);
        std::vector<double> &wings = wings_.emplace_back(size / 2 + 1, 0.0);
        for (int64_t y = 0; y < size; ++y)
            for (int64_t x = 0; x < size; ++x) {
                const auto far =
                    static_cast<size_t>(std::max(std::abs(x - size / 2), std::abs(y - size / 2)));
                wings[far] = std::max(wings[far], std::abs(psf(x, y)));
            }
        for (size_t i = wings.size() - 1; i-- > 0;)
            wings[i] = std::max(wings[i], wings[i + 1]);
    }
}

// An estimate of where the image stays below `tolerance`: that of the profile, and that of the
// PSF's wings. These are measured up to a distance, and fall like spikes beyond.
double GalaxyDrawer::reach(const Shape &shape, double tolerance) {
    if (shape.flux == 0)
        return 0;
    if (wings_.empty())
        measure_psf();
    const double part = tolerance / shape.flux;
    const double core = shape.radius * shape.radius / shape.longest / (2 * shape.profile.index());
    const auto blur = static_cast<size_t>(std::clamp(std::ilogb(core) + 1, 0, 4));
    const std::vector<double> &wings = wings_[blur];
    const auto below = std::ranges::find_if(wings, [=](double w) { return w < part; });
    double far = static_cast<double>(below - wings.begin());
    if (below == wings.end())
        far = static_cast<double>(wings.size() - 1) * std::sqrt(wings.back() / part);
    const double profile =
        shape.longest * shape.profile.radius_of(part * shape.radius * shape.radius);
    return std::max(profile + 1, far);
}

double GalaxyDrawer::radius(const Galaxy &galaxy, double tolerance) {
    require_tolerance(tolerance);
    return reach(shape_of(galaxy), tolerance / 2);
}

// 1 - F(k) <= k^2 <r^2> / 4, over all wave numbers.
bool GalaxyDrawer::is_point_like(const Galaxy &galaxy, double tolerance) {
    require_tolerance(tolerance);
    const Shape shape = shape_of(galaxy);
    if (wings_.empty())
        measure_psf();
    const double square = shape.longest * shape.longest * shape.profile.mean_square_radius();
    return shape.flux * pi * pi * square * curvature_ <= tolerance;
}

// Of the light of a level in any pixel.
double GalaxyDrawer::level_bound(const Shape &shape, int level, bool top) const {
    const SersicTable &table = shape.profile.table();
    const double least = split / static_cast<double>(step_of(level));
    const double most = level == 0 ? transfer_.cutoff * std::numbers::sqrt2
                                   : 2 * split / static_cast<double>(step_of(level - 1));
    constexpr int parts = 16; // of the range where levels meet
    double sum = 0;
    const double longest = shape.longest / shape.radius;
    const double end = std::sqrt(table.highest());
    for (int i = 0; i < parts; ++i) {
        const double from = least * 2 * i / parts, to = least * 2 * (i + 1) / parts;
        sum += (top ? 1 : 1 - beyond(to, level)) *
               table.absolute_integral(shape.wave(from), std::min(shape.wave(to), end));
    }
    return shape.density() *
           (sum + table.absolute_integral(shape.wave(2 * least),
                                          std::min(shape.wave(most) * longest * longest, end)));
}

template <class T>
GalaxyDrawer::Drawn GalaxyDrawer::add(const Galaxy &galaxy, double tolerance, View<T> image) {
    require_tolerance(tolerance);
    const Shape shape = shape_of(galaxy);
    const double far = reach(shape, tolerance / 2);
    Drawn drawn{0, 0};
    if (shape.flux == 0 || galaxy.x + far < 0 || galaxy.y + far < 0 ||
        galaxy.x - far > static_cast<double>(image.nx - 1) ||
        galaxy.y - far > static_cast<double>(image.ny - 1))
        return drawn;

    // Wave numbers from where on all together give no pixel a sixteenth of the tolerance.
    const SersicTable &table = shape.profile.table();
    const double end =
        std::min(std::sqrt(table.highest()), 2 * pi * shape.longest * transfer_.cutoff * 1.5);
    double lowest = 0, highest = end;
    for (int i = 0; i < 10; ++i) {
        const double middle = std::sqrt(std::max(lowest, 1e-3 * highest) * highest);
        (shape.density() * table.absolute_integral(middle, end) < tolerance / 16 ? highest
                                                                                : lowest) = middle;
    }
    const WaveForm form{shape.xx, shape.xy, shape.yy, highest * highest};

    const auto x0 = static_cast<int64_t>(std::llround(galaxy.x));
    const auto y0 = static_cast<int64_t>(std::llround(galaxy.y));
    const auto margin = static_cast<int64_t>(interpolator().half_width());
    int levels = 1;
    double size = 2 * far + 1;
    while (size > static_cast<double>(most_pixels)) {
        // The coarser light has margins as wide as the levels' meeting.
        const auto step = static_cast<double>(step_of(levels));
        size = (2 * far + 1 + static_cast<double>(most_pixels) * step / ratio) / step +
               static_cast<double>(2 * margin + 2);
        ++levels;
    }
    for (int level = 0; level < levels; ++level) {
        const bool top = level == levels - 1;
        const int64_t step = step_of(level), frame = level == 0 ? 0 : margin;
        const double bound = levels == 1 ? HUGE_VAL : level_bound(shape, level, top);
        if (bound < tolerance / 16) {
            drawn.error += bound;
            continue;
        }
        View<double> samples;
        double left_out = 0;
        for (int64_t n = size_for(top ? size : static_cast<double>(most_pixels));;
             n = size_for(static_cast<double>(n + 1))) {
            samples = grid(n, level, top)
                          .draw(table, form, galaxy.x - static_cast<double>(x0),
                                galaxy.y - static_cast<double>(y0), galaxy.flux, buffers_);
            left_out = largest_on_frame(samples, frame);
            if (left_out < 0.7 * tolerance || n == sizes.back())
                break;
        }
        drawn.error += left_out;
        const int64_t half = samples.nx / 2;
        if (level == 0) {
            const Range x = overlap(x0, half, half - 1, image.nx);
            const Range y = overlap(y0, half, half - 1, image.ny);
            for (int64_t j = y.first; j <= y.last; ++j)
                for (int64_t i = x.first; i <= x.last; ++i) {
                    const double value = samples(i - x0 + half, j - y0 + half);
                    image(i, j) += static_cast<T>(value);
                    drawn.light += value;
                }
            continue;
        }
        const int64_t edge = (half - 1 - margin) * step;
        const Range x = overlap(x0, edge, edge, image.nx), y = overlap(y0, edge, edge, image.ny);
        if (x.empty() || y.empty())
            continue;
        constexpr int64_t rows = 64;
        const auto places = [&](int64_t centre, int64_t first, int64_t count) {
            return Positions{static_cast<double>(half) -
                                 static_cast<double>(centre) / static_cast<double>(step),
                             first, count, 1, step};
        };
        for (int64_t j = y.first; j <= y.last; j += rows) {
            const int64_t count = std::min(rows, y.last - j + 1);
            if (strip_.nx() != x.count() || strip_.ny() != count)
                strip_ = Plane<double>::unset(x.count(), count);
            resample<double>(samples, interpolator(), places(x0, x.first, x.count()),
                             places(y0, j, count), 1, strip_.view());
            for (int64_t b = 0; b < count; ++b)
                for (int64_t a = 0; a < x.count(); ++a) {
                    image(x.first + a, j + b) += static_cast<T>(strip_(a, b));
                    drawn.light += strip_(a, b);
                }
        }
    }
    return drawn;
}

template GalaxyDrawer::Drawn GalaxyDrawer::add(const Galaxy &, double, View<float>);
template GalaxyDrawer::Drawn GalaxyDrawer::add(const Galaxy &, double, View<double>);

} // namespace wfpsf
