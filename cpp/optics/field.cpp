// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/field.hpp"

#include "optics/colours.hpp"
#include "optics/image_maker.hpp"
#include "optics/resample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

// The unaberrated peak over the faintest one of a PSF with few aberrations, from the former, as the
// fraction of the light in a native pixel: fits what is found from 100 nm to 10 um.
double guessed_ratio(double unaberrated_peak) {
    return 1.2 + 5.8 * unaberrated_peak;
}

// The smallest that the brightest pixel of a stamp may be, wherever between pixels the star stands:
// of samples a native pixel apart near the peak, from all places on the grid and half way between
// its samples.
double faintest_near(const Plane<double> &value, int64_t per_pixel, int64_t peak_x,
                     int64_t peak_y) {
    constexpr int64_t reach = 2;     // native pixels
    constexpr double between = 0.95; // of these places
    const auto window = [&](int64_t peak, int64_t size) {
        return std::pair{std::max<int64_t>(0, peak - reach * per_pixel),
                         std::min(size - 1, peak + reach * per_pixel)};
    };
    const auto [left, right] = window(peak_x, value.nx());
    const auto [low, top] = window(peak_y, value.ny());
    const auto faintest = [&, left = left, right = right, low = low, top = top](auto at) {
        Plane<double> brightest(per_pixel, per_pixel);
        for (int64_t y = low; y < top; ++y)
            for (int64_t x = left; x < right; ++x) {
                double &peak = brightest(x % per_pixel, y % per_pixel);
                peak = std::max(peak, at(x, y));
            }
        double least = INFINITY;
        for (int64_t y = 0; y < per_pixel; ++y)
            for (int64_t x = 0; x < per_pixel; ++x)
                least = std::min(least, brightest(x, y));
        return least;
    };
    const double on_grid = faintest([&](int64_t x, int64_t y) { return value(x, y); });
    const double half_way = faintest([&](int64_t x, int64_t y) {
        return (value(x, y) + value(x + 1, y) + value(x, y + 1) + value(x + 1, y + 1)) / 4;
    });
    return between * std::min(on_grid, half_way);
}

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
    double error(const Spectrum &spectrum, const std::vector<double> &weights,
                 const ImageMaker &maker) const {
        if (rule_.exact())
            return 0;
        const FringeErrors fringes(rule_, weights, spectrum, maker.longest_path());
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

    void add(const Diffraction &d, double scale_of_light, double peak_of_light, double weight) {
        const int64_t nx = d.intensity.nx(), ny = d.intensity.ny();
        if (intensity.nx() == 0)
            intensity = Plane<double>(nx, ny);
        const double scale = weight * scale_of_light;
        for (int64_t y = 0; y < ny; ++y)
            for (int64_t x = 0; x < nx; ++x)
                intensity(x, y) += scale * d.intensity(x, y);
        const double peak = std::abs(weight) * peak_of_light;
        unaberrated_peak += peak;
        error += peak * d.error;
        model_error += peak * d.model_error;
    }
};

Field field_of(const ImageMaker &maker, const Sum &sum) {
    Field field(maker.interpolator());
    field.per_pixel = maker.per_pixel();
    field.grid_size = maker.grid().size;
    field.value = maker.averaged(sum.intensity);
    field.find_peaks();
    field.error = (sum.error + sum.unaberrated_peak * maker.filter_error()) / field.faintest_peak;
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
        const double wavelength = rule.wavelengths()[k];
        const Diffraction image = maker.diffract(wavelength);
        if (!rule.exact())
            check.see(maker.averaged(image.intensity, ColourCheck::stride),
                      maker.scale(wavelength));
        nodes += image.nodes;
        for (Sum &sum : sums)
            sum.add(image, maker.scale(wavelength), maker.unaberrated_peak(wavelength),
                    sum.weights[k]);
    }
    Attempt result;
    for (size_t s = 0; s < spectra.size(); ++s) {
        Field &field = result.fields.emplace_back(field_of(maker, sums[s]));
        field.nodes = nodes;
        for (size_t k = 0; k < rule.size(); ++k)
            field.colours.push_back({rule.wavelengths()[k], sums[s].weights[k]});
        result.error = std::max(result.error, field.error);
        const double colour_error =
            check.error(spectra[s], sums[s].weights, maker) / field.faintest_peak;
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
                               const PsfSettings &settings, double radius, const Manners &manners) {
    const KeptMemory kept;
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
    const auto [for_colour, for_the_rest] = shares_of(settings.eps, all);
    double tolerance = for_the_rest / ratio;
    double for_rule = 2 * for_colour; // the rule's own bound is wide
    for (int count = 0;; ++count) {
        const ImageMaker maker(optics, settings, blue, radius, tolerance);
        manners.require_memory(maker.memory(lights.size()), "a field of that radius");
        const std::vector<Spectrum> spectra = colours(maker.longest_path());
        all = together(spectra);
        const WavelengthRule rule = choose_wavelengths(all, maker.longest_path(), for_rule).rule;
        Attempt made = attempt(maker, rule, spectra, manners.progress);
        const bool good = made.error <= for_the_rest && made.colour_error <= for_colour;
        if (good || count == 4 || tolerance < 1e-15) {
            for (Field &field : made.fields) {
                field.shortest_wavelength = blue;
                field.tolerance = tolerance;
            }
            return std::move(made.fields);
        }
        if (made.error > for_the_rest)
            tolerance *= 0.7 * for_the_rest / made.error;
        if (made.colour_error > for_colour)
            for_rule /= 3;
    }
}

Field make_field_like(const Field &like, const Optics &optics, const PsfSettings &settings,
                      double radius) {
    const ImageMaker maker(optics, settings, like.shortest_wavelength, radius, like.tolerance);
    Sum sum;
    int64_t nodes = 0;
    for (const Colour &colour : like.colours) {
        const Diffraction image = maker.diffract(colour.wavelength);
        nodes += image.nodes;
        sum.add(image, maker.scale(colour.wavelength), maker.unaberrated_peak(colour.wavelength),
                colour.weight);
    }
    Field field = field_of(maker, sum);
    field.nodes = nodes;
    field.colours = like.colours;
    field.shortest_wavelength = like.shortest_wavelength;
    field.tolerance = like.tolerance;
    return field;
}

std::vector<Field> make_field_changes(const Field &like, const Optics &optics,
                                      std::span<const Wavefront> by, const PsfSettings &settings,
                                      double radius) {
    const ImageMaker maker(optics, settings, like.shortest_wavelength, radius, like.tolerance);
    const int64_t size = maker.grid().size;
    std::vector<Plane<double>> sums(by.size(), Plane<double>(size, size));
    for (const Colour &colour : like.colours) {
        const double scale = colour.weight * maker.scale(colour.wavelength);
        const std::vector<Plane<double>> changes = maker.changes(colour.wavelength, by);
        for (size_t i = 0; i < by.size(); ++i)
            for (int64_t y = 0; y < size; ++y)
                for (int64_t x = 0; x < size; ++x)
                    sums[i](x, y) += scale * changes[i](x, y);
    }
    std::vector<Field> fields;
    for (const Plane<double> &sum : sums) {
        Field &field = fields.emplace_back(maker.interpolator());
        field.per_pixel = maker.per_pixel();
        field.value = maker.averaged(sum);
    }
    return fields;
}

void Field::find_peaks() {
    peak = 0;
    int64_t peak_x = 0, peak_y = 0;
    for (int64_t y = 0; y < value.ny(); ++y)
        for (int64_t x = 0; x < value.nx(); ++x)
            if (value(x, y) > peak) {
                peak = value(x, y);
                peak_x = x;
                peak_y = y;
            }
    faintest_peak = faintest_near(value, per_pixel, peak_x, peak_y);
}

template <class T>
void Field::draw(const Star &star, int64_t oversampling, int64_t first_x, int64_t first_y,
                 View<T> out) const {
    const auto n = static_cast<double>(oversampling);
    const double centre = static_cast<double>(value.nx() - 1) / 2;
    const auto positions = [&](double place, int64_t first, int64_t count) {
        return Positions{centre - place * static_cast<double>(per_pixel) / n, first, count,
                         per_pixel, oversampling};
    };
    resample(value.view(), interpolator, positions(star.x, first_x, out.nx),
             positions(star.y, first_y, out.ny), star.flux / (n * n), out);
}

template void Field::draw(const Star &, int64_t, int64_t, int64_t, View<float>) const;
template void Field::draw(const Star &, int64_t, int64_t, int64_t, View<double>) const;

} // namespace wfpsf
