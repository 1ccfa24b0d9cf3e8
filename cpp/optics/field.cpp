// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/field.hpp"

#include "numerics/quadrature.hpp"
#include "optics/resample.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace wfpsf {

namespace {

constexpr double pi = std::numbers::pi;

// The intensity holds no frequency above diameter / wavelength. Sampling it at twice Nyquist's rate
// or somewhat finer keeps the filters short; a whole number of samples a native pixel lets all
// pixels of a stamp share one filter.
constexpr double widest_band = 0.25; // cycles per sample

// Wavelengths against everything else: how they share eps.
constexpr double share_of_wavelengths = 0.5;

// The unaberrated peak over faintest_peak() of a PSF with few aberrations, from the former, as the
// fraction of the light in a native pixel: fits what is found from 100 nm to 10 um.
double guessed_ratio(double unaberrated_peak) {
    return 1.2 + 5.8 * unaberrated_peak;
}

// The smallest that the brightest pixel of a stamp may be, wherever between pixels the star stands:
// of samples a native pixel apart, from all places on the grid and half way between its samples.
double faintest_peak(const Plane<double> &value, int64_t per_pixel) {
    const auto faintest = [&](auto at) {
        Plane<double> brightest(per_pixel, per_pixel);
        for (int64_t y = 0; y + 1 < value.ny(); ++y)
            for (int64_t x = 0; x + 1 < value.nx(); ++x) {
                double &peak = brightest(x % per_pixel, y % per_pixel);
                peak = std::max(peak, at(x, y));
            }
        double least = INFINITY;
        for (int64_t y = 0; y < per_pixel; ++y)
            for (int64_t x = 0; x < per_pixel; ++x)
                least = std::min(least, brightest(x, y));
        return least;
    };
    constexpr double between = 0.95; // of these places
    const double on_grid = faintest([&](int64_t x, int64_t y) { return value(x, y); });
    const double half_way = faintest([&](int64_t x, int64_t y) {
        return (value(x, y) + value(x + 1, y) + value(x, y + 1) + value(x + 1, y + 1)) / 4;
    });
    return between * std::min(on_grid, half_way);
}

struct Sum;

// The image of one wavelength, and the field of a sum of such images.
class ImageMaker {
  public:
    ImageMaker(const Optics &optics, const PsfSettings &settings, double shortest_wavelength,
               double radius, double tolerance)
        : optics_(optics), settings_(settings),
          per_pixel_(
              static_cast<int64_t>(std::ceil(optics.aperture->diameter() * settings.pixel_scale /
                                             (widest_band * shortest_wavelength)))),
          step_(settings.pixel_scale / static_cast<double>(per_pixel_)),
          strength_(outline_strength(optics.aperture->outline(), optics.aperture->diameter(),
                                     optics.aperture->area())),
          samples_(bandwidth(shortest_wavelength), static_cast<double>(per_pixel_),
                   optics.aperture->outline(),
                   (settings.blur.none() ? 0.8 : 0.4) * tolerance / strength_),
          filter_{{{samples_.averaging(), samples_.averaging()}}, 0}, tolerance_(0.2 * tolerance) {
        const auto samples = static_cast<double>(per_pixel_);
        const Covariance &blur = settings.blur;
        if (!blur.none())
            filter_ = blurring_filter(bandwidth(shortest_wavelength), samples,
                                      {blur.xx * samples * samples, blur.xy * samples * samples,
                                       blur.yy * samples * samples},
                                      0.4 * tolerance / strength_);
        const auto reach = static_cast<int64_t>(std::ceil(radius * samples)) +
                           samples_.interpolator().half_width();
        const auto margin = static_cast<int64_t>(filter_.half_width());
        grid_ = {2 * (reach + margin) + 1, step_};
    }

    // The largest optical path difference between two parts of the pupil, as seen at a distance of
    // so many grid samples from the axis.
    double path(double distance) const {
        return optics_.aperture->diameter() *
               (distance * step_ + optics_.wavefront.slope_bound() * optics_.wavelength);
    }
    double longest_path() const { return path(std::numbers::sqrt2 * grid_.half()); }

    // An intensity averaged over the pixel and blurred, on the axes of the image.
    Plane<double> averaged(const Plane<double> &intensity, int64_t stride = 1) const {
        View<const double> image = intensity.view();
        if (settings_.mirrored)
            image = {image.row(image.ny - 1), image.nx, image.ny, 1, -image.stride_y};
        return filtered(image, filter_, stride);
    }

    struct Image {
        Diffraction diffraction;
        double scale; // intensity to the fraction of the light in a native pixel's solid angle
        double unaberrated_peak;
    };

    Image at(double wavelength) const {
        const double area = optics_.aperture->area();
        const double wavelengths = settings_.pixel_scale / wavelength;
        const double scale = wavelengths * wavelengths / area;
        return {
            optics_.aperture->diffract(optics_.wavefront.scaled(optics_.wavelength / wavelength),
                                       wavelength, grid_, tolerance_),
            scale, scale * area * area};
    }

    Field field(const Sum &sum) const;

  private:
    double bandwidth(double shortest_wavelength) const {
        return optics_.aperture->diameter() * step_ / shortest_wavelength;
    }

    const Optics &optics_;
    const PsfSettings &settings_;
    int64_t per_pixel_;
    double step_;
    double strength_; // of the spectrum that bounds the image's
    AveragedSamples samples_;
    SeparableFilter filter_;
    FocalGrid grid_{};
    double tolerance_; // of an intensity in units of the unaberrated peak
};

// How many wavelengths the image needs at its corner, where it changes fastest with colour, and
// nearer to the core, where it is brighter: spikes fall as the square of the radius, rings as the
// cube. `path` is the optical path difference across the pupil at the corner.
size_t first_guess(const Spectrum &spectrum, double path, double eps) {
    constexpr double soft_edges = 0.82; // of a band: they let so many do
    const auto [blue, red] = std::ranges::minmax(spectrum.wavelength);
    int points = 3;
    for (double part = 1; part > 0.02; part *= 0.8) {
        const double phase = pi * part * path / blue;
        const double tolerance = eps * (1 + phase * phase);
        const double turns = pi * part * path * (1 / blue - 1 / red);
        if (tolerance < 1)
            points = std::max(points, gauss_legendre_points(turns, std::min(0.1, tolerance)));
    }
    return static_cast<size_t>(soft_edges * points + 0.5);
}

// What a rule's sum over a spectrum misses of a wave in 1 / wavelength, by optical path difference:
// of any wave up to that path, since light at a distance from the axis mixes them all.
class FringeErrors {
  public:
    FringeErrors(const WavelengthRule &rule, const Spectrum &spectrum, double longest_path)
        // An eighth of a turn over half the range of 1 / wavelength.
        : step_(1 / (8 * rule.half_range())),
          worst_(static_cast<size_t>(longest_path / step_) + 2) {
        std::vector<std::complex<double>> sum(worst_.size());
        const auto add = [&](double wavelength, double weight) {
            const std::complex<double> turn = std::polar(1.0, 2 * pi * step_ / wavelength);
            std::complex<double> wave = weight;
            for (std::complex<double> &s : sum) {
                s += wave;
                wave *= turn;
            }
        };
        for (size_t i = 0; i < spectrum.size(); ++i)
            add(spectrum.wavelength[i], spectrum.weight[i]);
        const std::vector<double> weights = rule.weights(spectrum);
        for (size_t k = 0; k < rule.size(); ++k)
            add(rule.wavelengths()[k], -weights[k]);
        for (size_t i = 1; i < sum.size(); ++i)
            worst_[i] = std::max(worst_[i - 1], std::abs(sum[i]));
    }

    double up_to(double path) const {
        return worst_[std::min(static_cast<size_t>(path / step_) + 1, worst_.size() - 1)];
    }

  private:
    double step_; // of the path
    std::vector<double> worst_;
};

// Some pixels of the images of all wavelengths, and what they tell of the rule.
class ColourCheck {
  public:
    explicit ColourCheck(const WavelengthRule &rule) : rule_(rule) {}

    // `stride` grid samples lie between two of the pixels.
    static constexpr int64_t stride = 5;
    void see(Plane<double> pixels, double scale) {
        for (int64_t y = 0; y < pixels.ny(); ++y)
            for (int64_t x = 0; x < pixels.nx(); ++x)
                pixels(x, y) *= scale;
        images_.push_back(std::move(pixels));
    }

    // The largest error of any pixel, by two measures of which the smaller counts.
    double error(const Spectrum &spectrum, const ImageMaker &maker) const {
        if (rule_.exact())
            return 0;
        const FringeErrors fringes(rule_, spectrum, maker.longest_path());
        const double high = rule_.high_moment(spectrum);
        const double middle = static_cast<double>(images_[0].nx() - 1) / 2;
        double most = 0;
        for (int64_t y = 0; y < images_[0].ny(); ++y)
            for (int64_t x = 0; x < images_[0].nx(); ++x) {
                const double distance =
                    std::hypot(static_cast<double>(x) - middle, static_cast<double>(y) - middle);
                const double missed = fringes.up_to(maker.path(distance * stride));
                most = std::max(most, std::min(range(x, y) * missed, beyond(x, y, high)));
            }
        return most;
    }

  private:
    // A pixel varies with 1 / wavelength like waves of optical path differences up to the one
    // across the pupil: as much as it is seen to vary, times what the rule misses of those.
    double range(int64_t x, int64_t y) const {
        double low = INFINITY, top = -INFINITY;
        for (const Plane<double> &image : images_) {
            low = std::min(low, image(x, y));
            top = std::max(top, image(x, y));
        }
        return top - low;
    }

    // A pixel's components along polynomials fall ever faster with their degree: those of degree n
    // to 2n at least as steeply as the half below, of which half the credit is taken. Those of
    // degree n count as far as a spectrum holds the like.
    double beyond(int64_t x, int64_t y, double high) const {
        const size_t n = rule_.size();
        const auto component = [&](size_t degree) {
            double sum = 0;
            for (size_t k = 0; k < n; ++k)
                sum += rule_.component(degree, k) * images_[k](x, y);
            return std::abs(sum);
        };
        const double last = std::max(component(n - 1), component(n - 2));
        const double half = std::max({component(n / 2), component(n / 2 - 1), last});
        return half > 0 ? 2 * last * (last / half + high) : 0;
    }

    const WavelengthRule &rule_;
    std::vector<Plane<double>> images_;
};

// A sum of images of several wavelengths for one spectrum, as fractions of the light.
struct Sum {
    Plane<double> intensity;
    std::vector<double> weights;
    double unaberrated_peak = 0, error = 0, model_error = 0;

    void add(const ImageMaker::Image &image, double weight) {
        const Diffraction &d = image.diffraction;
        const int64_t nx = d.intensity.nx(), ny = d.intensity.ny();
        if (intensity.nx() == 0)
            intensity = Plane<double>(nx, ny);
        const double scale = weight * image.scale;
        for (int64_t y = 0; y < ny; ++y)
            for (int64_t x = 0; x < nx; ++x)
                intensity(x, y) += scale * d.intensity(x, y);
        const double peak = std::abs(weight) * image.unaberrated_peak;
        unaberrated_peak += peak;
        error += peak * d.error;
        model_error += peak * d.model_error;
    }
};

Field ImageMaker::field(const Sum &sum) const {
    Field field(samples_.interpolator());
    field.per_pixel = per_pixel_;
    field.grid_size = grid_.size;
    field.value = averaged(sum.intensity);
    for (int64_t y = 0; y < field.value.ny(); ++y)
        for (int64_t x = 0; x < field.value.nx(); ++x)
            field.peak = std::max(field.peak, field.value(x, y));
    field.faintest_peak = faintest_peak(field.value, per_pixel_);
    const double filters = strength_ * (samples_.missed() + filter_.error) + samples_.rounding;
    field.error = (sum.error + sum.unaberrated_peak * filters) / field.faintest_peak;
    field.model_error = sum.model_error / field.faintest_peak;
    return field;
}

struct Attempt {
    std::vector<Field> fields;
    double error = 0, colour_error = 0; // the largest ones; the first without the second
};

Attempt attempt(const ImageMaker &maker, const WavelengthRule &rule,
                std::span<const Spectrum> spectra, const Progress &progress) {
    std::vector<Sum> sums(spectra.size());
    for (size_t s = 0; s < spectra.size(); ++s)
        sums[s].weights = rule.weights(spectra[s]);
    ColourCheck check(rule);
    int64_t nodes = 0;
    for (size_t k = 0; k < rule.size(); ++k) {
        progress.report(static_cast<double>(k) / static_cast<double>(rule.size()));
        const ImageMaker::Image image = maker.at(rule.wavelengths()[k]);
        if (!rule.exact())
            check.see(maker.averaged(image.diffraction.intensity, ColourCheck::stride),
                      image.scale);
        nodes += image.diffraction.nodes;
        for (Sum &sum : sums)
            sum.add(image, sum.weights[k]);
    }
    Attempt result;
    for (size_t s = 0; s < spectra.size(); ++s) {
        Field &field = result.fields.emplace_back(maker.field(sums[s]));
        field.nodes = nodes;
        for (size_t k = 0; k < rule.size(); ++k)
            field.colours.push_back({rule.wavelengths()[k], sums[s].weights[k]});
        result.error = std::max(result.error, field.error);
        const double colour_error = check.error(spectra[s], maker) / field.faintest_peak;
        result.colour_error = std::max(result.colour_error, colour_error);
        field.error += colour_error;
    }
    return result;
}

} // namespace

// All errors arise in units of the unaberrated peak before the pixel's average; eps counts in the
// stamp's brightest pixel. Their ratio is guessed, and made up for where the guess was too good (an
// aberrated wavefront): once more is the rule, several times for the hardest ones.
std::vector<Field> make_fields(const Optics &optics, std::span<const Light> lights,
                               const PsfSettings &settings, double radius,
                               const Progress &progress) {
    const auto colours = [&lights](double path) {
        std::vector<Spectrum> spectra;
        for (const Light &light : lights)
            spectra.push_back(light(path));
        return spectra;
    };
    Spectrum all = together(colours(0));
    const double blue = std::ranges::min(all.wavelength);
    const double pixel = settings.pixel_scale / blue;
    const double ratio = guessed_ratio(optics.aperture->area() * pixel * pixel);
    const double for_colour = all.size() > 1 ? share_of_wavelengths * settings.eps : 0;
    const double for_the_rest = settings.eps - for_colour;
    double tolerance = for_the_rest / ratio;
    size_t n = 0;
    for (int count = 0;; ++count) {
        const ImageMaker maker(optics, settings, blue, radius, tolerance);
        const std::vector<Spectrum> spectra = colours(maker.longest_path());
        all = together(spectra);
        if (n == 0)
            n = first_guess(all, maker.longest_path(), for_colour);
        const WavelengthRule rule(all, n);
        Attempt made = attempt(maker, rule, spectra, progress);
        const bool good = made.error <= for_the_rest && made.colour_error <= for_colour;
        if (good || count == 4 || tolerance < 1e-15)
            return std::move(made.fields);
        if (made.error > for_the_rest)
            tolerance *= 0.7 * for_the_rest / made.error;
        if (made.colour_error > for_colour)
            n = rule.size() * 6 / 5 + 2;
    }
}

} // namespace wfpsf
