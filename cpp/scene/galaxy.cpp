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

// A galaxy that needs more pixels is a sum over levels. Level l holds the wave numbers from about
// split / ratio^l on that lower levels do not, on a grid of ratio^l pixels. One level goes over
// into the next like a Gaussian's integral: at k of relative width 1 / sharpness about the split,
// which leaves 1e-6 at twice the split and at zero, and 1e-6 of the light of that level beyond
// most_pixels / 2 steps from the centre.
constexpr int64_t ratio = 8;
constexpr double sharpness = 3.3;
constexpr double split = 3.9 / (static_cast<double>(most_pixels) / 2); // cycles per pixel
constexpr double band = 2 * split * ratio; // cycles per sample, that a coarse grid holds

constexpr double farthest = 1e9; // pixels, that a galaxy is drawn to

int64_t step_of(int level) {
    int64_t step = 1;
    for (int i = 0; i < level; ++i)
        step *= ratio;
    return step;
}

// The share of wave number k that is left to levels above `level`.
double left_by(int level, double k) {
    const double relative = k / split * static_cast<double>(step_of(level));
    return relative >= 2 ? 0 : std::erfc(sharpness * (relative - 1)) / 2;
}

// The largest value on the frame `margin` samples inside.
double largest_on_frame(View<const double> samples, int64_t margin) {
    const int64_t last = samples.nx - 1 - margin;
    double most = 0;
    for (int64_t i = margin; i <= last; ++i)
        for (const double value :
             {samples(i, margin), samples(i, last), samples(margin, i), samples(last, i)})
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
    double radius;          // half-light, pixels
    double longest;         // half axis of the half-light ellipse, pixels
    double xx, xy, yy;      // of the wave form
    double x, y, flux;      // as the galaxy's
    int64_t x0 = 0, y0 = 0; // the nearest pixel

    // The argument of the profile's transform at wave numbers k: the smallest, the largest.
    double lowest(double k) const { return 2 * pi * radius * (radius / longest) * k; }
    double highest(double k) const { return 2 * pi * longest * k; }
    // Integrals of |F| over the plane of the image's k are those of |F| k dk times that.
    double density() const { return std::abs(flux) / (2 * pi * radius * radius); }
};

struct GalaxyDrawer::Level {
    int number;
    bool top;
    double samples; // that it needs
    int64_t step() const { return step_of(number); }
    double share(double k) const {
        return (number == 0 ? 1 : left_by(number - 1, k)) - (top ? 0 : left_by(number, k));
    }
};

GalaxyDrawer::GalaxyDrawer(Transfer transfer, double pixel_scale, SersicProfiles &profiles)
    : transfer_(std::move(transfer)), pixel_scale_(pixel_scale), profiles_(profiles),
      interpolator_(band, 1e-7) {}

GalaxyDrawer::Shape GalaxyDrawer::shape_of(const Galaxy &galaxy) {
    for (const auto &[name, value] :
         {std::pair("x", galaxy.x), std::pair("y", galaxy.y), std::pair("flux", galaxy.flux)})
        if (!std::isfinite(value))
            fail(WFPSF_ERROR_NOT_FINITE, "galaxy %s = %g: must be finite", name, value);
    if (!(galaxy.half_light_radius > 0 && galaxy.half_light_radius <= Galaxy::largest_radius))
        fail(WFPSF_ERROR_RANGE, "galaxy half_light_radius = %g arcsec: must be > 0 and <= %g",
             galaxy.half_light_radius, Galaxy::largest_radius);
    const double e = std::hypot(galaxy.e1, galaxy.e2);
    if (!(e <= Galaxy::largest_ellipticity))
        fail(WFPSF_ERROR_RANGE, "galaxy (e1, e2) = (%g, %g): |e| must be <= %g", galaxy.e1,
             galaxy.e2, Galaxy::largest_ellipticity);
    const double radius = galaxy.half_light_radius / pixel_scale_;
    const double scale = 4 * pi * pi * radius * radius / (1 - e * e);
    return {profiles_.of(galaxy.sersic_index),
            radius,
            radius * std::sqrt((1 + e) / (1 - e)),
            scale * (1 + e * e + 2 * galaxy.e1),
            scale * 2 * galaxy.e2,
            scale * (1 + e * e - 2 * galaxy.e1),
            galaxy.x,
            galaxy.y,
            galaxy.flux};
}

const GalaxyGrid &GalaxyDrawer::grid(const Level &level, int64_t size) {
    const std::array<int64_t, 3> key{level.number, level.top, size};
    auto found = grids_.find(key);
    if (found == grids_.end())
        found = grids_
                    .try_emplace(key, transfer_, size, level.step(),
                                 [&](double k) { return level.share(k); })
                    .first;
    return found->second;
}

// From transforms of a size whose folds hardly matter.
void GalaxyDrawer::measure_psf() {
    constexpr int64_t size = 96;
    const GalaxyGrid &all = grid({0, true, size}, size);
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
    const double part = tolerance / std::abs(shape.flux);
    const double core = shape.radius * shape.radius / shape.longest / (2 * shape.profile.index());
    const auto blur = static_cast<size_t>(std::clamp(std::ilogb(core) + 1, 0, 4));
    const std::vector<double> &wings = wings_[blur];
    const auto below = std::ranges::find_if(wings, [=](double w) { return w < part; });
    double far = static_cast<double>(below - wings.begin());
    if (below == wings.end())
        far = static_cast<double>(wings.size() - 1) * std::sqrt(wings.back() / part);
    const double profile =
        shape.longest * shape.profile.radius_of(part * shape.radius * shape.radius);
    return std::min(std::max(profile + 1, far), farthest);
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
    return std::abs(shape.flux) * pi * pi * square * curvature_ <= tolerance;
}

// Of the light of a level in any pixel.
double GalaxyDrawer::bound(const Shape &shape, const Level &level) const {
    const SersicTable &table = shape.profile.table();
    const double meeting = 2 * split / static_cast<double>(level.step());
    const double cutoff = transfer_.cutoff * std::numbers::sqrt2;
    const double most = level.number == 0 ? cutoff : std::min(cutoff, ratio * meeting);
    constexpr int parts = 16; // of the range where it meets the next level
    double sum = table.absolute_integral(shape.lowest(meeting), shape.highest(most));
    for (int i = 0; i < parts; ++i) {
        const double from = meeting * i / parts, to = meeting * (i + 1) / parts;
        sum += (level.top ? 1 : 1 - left_by(level.number, to)) *
               table.absolute_integral(shape.lowest(from), shape.lowest(to));
    }
    return shape.density() * sum;
}

// Where the profile's transform may end so that all that is left out gives no pixel more than
// `tolerance`.
double GalaxyDrawer::highest_wave(const Shape &shape, double tolerance) const {
    const SersicTable &table = shape.profile.table();
    const double end = shape.highest(transfer_.cutoff * std::numbers::sqrt2);
    double fails = 0, serves = end;
    for (int i = 0; i < 10; ++i) {
        const double middle = std::sqrt(std::max(fails, 1e-3 * serves) * serves);
        const bool serve = shape.density() * table.absolute_integral(middle, end) <= tolerance;
        (serve ? serves : fails) = middle;
    }
    return serves;
}

// The samples' frame tells what folds back from outside and what is left out there: where that is
// too much there must be more of them.
GalaxyDrawer::Samples GalaxyDrawer::sample(const Shape &shape, const Level &level,
                                           const WaveForm &form, double tolerance) {
    const int64_t margin = level.number == 0 ? 0 : interpolator_.half_width();
    for (int64_t size = size_for(level.samples);; size = size_for(static_cast<double>(size + 1))) {
        const View<double> values =
            grid(level, size)
                .draw(shape.profile.table(), form, shape.x - static_cast<double>(shape.x0),
                      shape.y - static_cast<double>(shape.y0), shape.flux, buffers_);
        const double on_frame = largest_on_frame(values, margin);
        if (on_frame < tolerance || size == sizes.back())
            return {values, on_frame};
    }
}

template <class T>
double GalaxyDrawer::add_pixels(const Shape &shape, View<double> values, View<T> image) {
    const int64_t half = values.nx / 2;
    const Range x = overlap(shape.x0, half, half - 1, image.nx);
    const Range y = overlap(shape.y0, half, half - 1, image.ny);
    double light = 0;
    for (int64_t j = y.first; j <= y.last; ++j)
        for (int64_t i = x.first; i <= x.last; ++i) {
            const double value = values(i - shape.x0 + half, j - shape.y0 + half);
            image(i, j) += static_cast<T>(value);
            light += value;
        }
    return light;
}

template <class T>
double GalaxyDrawer::add_between(const Shape &shape, int64_t step, View<double> values,
                                 View<T> image) {
    constexpr int64_t rows = 64; // at a time
    const int64_t half = values.nx / 2;
    const int64_t edge = (half - 1 - interpolator_.half_width()) * step;
    const Range x = overlap(shape.x0, edge, edge, image.nx);
    const Range y = overlap(shape.y0, edge, edge, image.ny);
    if (x.empty() || y.empty())
        return 0;
    const auto places = [=](int64_t centre, int64_t first, int64_t count) {
        return Positions{static_cast<double>(half) -
                             static_cast<double>(centre) / static_cast<double>(step),
                         first, count, 1, step};
    };
    double light = 0;
    for (int64_t first = y.first; first <= y.last; first += rows) {
        const int64_t count = std::min(rows, y.last - first + 1);
        if (strip_.nx() != x.count() || strip_.ny() != count)
            strip_ = Plane<double>::unset(x.count(), count);
        resample<double>(values, interpolator_, places(shape.x0, x.first, x.count()),
                         places(shape.y0, first, count), 1, strip_.view());
        for (int64_t j = 0; j < count; ++j)
            for (int64_t i = 0; i < x.count(); ++i) {
                image(x.first + i, first + j) += static_cast<T>(strip_(i, j));
                light += strip_(i, j);
            }
    }
    return light;
}

template <class T>
GalaxyDrawer::Drawn GalaxyDrawer::add(const Galaxy &galaxy, double tolerance, View<T> image) {
    require_tolerance(tolerance);
    Shape shape = shape_of(galaxy);
    const double far = reach(shape, tolerance / 2);
    Drawn drawn{0, 0};
    if (shape.flux == 0 || galaxy.x + far < 0 || galaxy.y + far < 0 ||
        galaxy.x - far > static_cast<double>(image.nx - 1) ||
        galaxy.y - far > static_cast<double>(image.ny - 1))
        return drawn;
    shape.x0 = std::llround(galaxy.x);
    shape.y0 = std::llround(galaxy.y);

    const double small = tolerance / 16; // what may be left out for one reason
    const double highest = highest_wave(shape, small);
    const WaveForm form{shape.xx, shape.xy, shape.yy, highest * highest};
    constexpr auto whole = static_cast<double>(most_pixels);
    int levels = 1;
    double samples = 2 * far + 1; // of the top level
    for (; samples > whole; ++levels) {
        // The light of coarse levels is smeared as far as the level below reaches.
        const auto step = static_cast<double>(step_of(levels));
        samples = (2 * far + 1) / step + whole / ratio + 2 * interpolator_.half_width() + 2;
    }
    for (int number = 0; number < levels; ++number) {
        const bool top = number == levels - 1;
        const Level level{number, top, top ? samples : whole};
        const double most = levels == 1 ? HUGE_VAL : bound(shape, level);
        if (most <= small) {
            drawn.error += most;
            continue;
        }
        const auto [values, on_frame] = sample(shape, level, form, 0.7 * tolerance);
        drawn.error += on_frame;
        drawn.light += number == 0 ? add_pixels(shape, values, image)
                                   : add_between(shape, level.step(), values, image);
    }
    return drawn;
}

template GalaxyDrawer::Drawn GalaxyDrawer::add(const Galaxy &, double, View<float>);
template GalaxyDrawer::Drawn GalaxyDrawer::add(const Galaxy &, double, View<double>);

} // namespace wfpsf
