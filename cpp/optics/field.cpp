// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/field.hpp"

#include "optics/colours.hpp"
#include "optics/image_maker.hpp"
#include "optics/resample.hpp"
#include "optics/scaling.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

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

// Bytes that so many fields take while they are made: the last image, and all planes of its size.
int64_t memory(const ImageMaker &maker, const Scaling &scaling, size_t fields) {
    const FocalGrid grid = scaling.grid(scaling.wavelengths()[0]);
    const auto bytes = [](const FocalGrid &of, size_t planes) {
        return static_cast<int64_t>(planes * sizeof(double)) * of.size * of.size;
    };
    return maker.memory(grid) + bytes(grid, scaling.wavelengths().size()) +
           bytes(maker.grid(), 2 * fields);
}

// What errors come from, in shares of a tolerance.
struct Shares {
    double of_images, of_scaling, of_rule, of_fewer;
    explicit Shares(bool many_colours)
        : of_images(many_colours ? 0.3 : 1), of_scaling(many_colours ? 0.3 : 0),
          of_rule(many_colours ? 0.25 : 0), of_fewer(many_colours ? 0.15 : 0) {}
};

// The images that those of all wavelengths are made of.
struct Images {
    std::vector<Plane<double>> intensity;
    std::vector<double> error, model_error;
    int64_t nodes = 0;

    Images(const ImageMaker &maker, const Scaling &scaling, const Progress &progress) {
        const std::vector<double> &wavelengths = scaling.wavelengths();
        for (Diffraction &image :
             maker.diffract(wavelengths, scaling.grid(wavelengths[0]), progress)) {
            intensity.push_back(std::move(image.intensity));
            error.push_back(image.error);
            model_error.push_back(image.model_error);
            nodes += image.nodes;
        }
    }
};

// How bright images are at most from a distance on, in grid samples, of which one of the images'
// own is `step`.
class Profile {
  public:
    Profile(std::span<const Plane<double>> images, double step, double area)
        : step_(step), peak_(area * area) {
        const double half = static_cast<double>(images[0].nx() - 1) / 2;
        brightest_.resize(static_cast<size_t>(std::numbers::sqrt2 * half) + 2);
        constexpr int64_t run = 16; // samples, all counted as if at the farther end
        for (const Plane<double> &image : images)
            for (int64_t y = 0; y < image.ny(); ++y) {
                const double *const row = image.view().row(y);
                for (int64_t x = 0; x < image.nx(); x += run) {
                    const int64_t end = std::min(x + run, image.nx());
                    const double farther = std::max(std::abs(static_cast<double>(x) - half),
                                                    std::abs(static_cast<double>(end - 1) - half));
                    const double off = static_cast<double>(y) - half;
                    double &most =
                        brightest_[static_cast<size_t>(std::sqrt(farther * farther + off * off))];
                    most = std::max(most, *std::max_element(row + x, row + end));
                }
            }
        for (size_t i = brightest_.size() - 1; i-- > 0;)
            brightest_[i] = std::max(brightest_[i], brightest_[i + 1]);
    }
    // Seen at that distance, in units of the unaberrated peak of the bluest light; `range` is its
    // wavelength over the reddest one's. Redder images are wider, and dimmer.
    double in_any_colour(double distance, double range) const {
        constexpr int steps = 8;
        double most = 0;
        for (int i = 0; i < steps; ++i) {
            const double redder = std::lerp(range, 1, static_cast<double>(i) / steps);
            const double bluer = std::lerp(range, 1, static_cast<double>(i + 1) / steps);
            most = std::max(most, bluer * bluer * beyond(distance * redder));
        }
        return most / peak_;
    }

  private:
    double beyond(double distance) const {
        return brightest_[std::min(static_cast<size_t>(distance / step_), brightest_.size() - 1)];
    }

    double step_, peak_;
    std::vector<double> brightest_; // from so many of the images' samples on
};

// By the optical path difference there, in units of the unaberrated peak of the bluest light.
Brightness brightness_of(const Images &images, const Scaling &scaling, const ImageMaker &maker,
                         double range) {
    return
        [profile = Profile(images.intensity, scaling.coarser(), maker.optics().aperture->area()),
         &maker, range](double path) { return profile.in_any_colour(maker.distance(path), range); };
}

// All colours of several spectra.
ColourSums sums_over(std::span<const Spectrum> spectra, double half) {
    ColourSums sums{half, {}, {}};
    for (const Spectrum &spectrum : spectra) {
        for (std::vector<double> &others : sums.weights)
            others.resize(others.size() + spectrum.size());
        std::vector<double> &own = sums.weights.emplace_back(sums.wavelengths.size());
        own.insert(own.end(), spectrum.weight.begin(), spectrum.weight.end());
        sums.wavelengths.insert(sums.wavelengths.end(), spectrum.wavelength.begin(),
                                spectrum.wavelength.end());
    }
    return sums;
}

// Nearer to the axis an image changes less with colour: rules for ever smaller squares about it,
// each with no more wavelengths than the one that they are made of, which is for them all.
struct Rules {
    ColourSums all; // colours that the wavelengths stand for
    std::vector<ColourSums> of;
    double missed = 0; // of the one that they are made of, as in choose_wavelengths()

    Rules(const ImageMaker &maker, ColourSums of_all, std::span<const double> wavelengths,
          std::span<const std::vector<double>> weights, const Brightness &brightness, double eps)
        : all(std::move(of_all)) {
        std::vector<Spectrum> spectra;
        for (const std::vector<double> &own : weights)
            spectra.push_back({{wavelengths.begin(), wavelengths.end()}, own});
        // Of several lights one by itself may have weights that are negative, and no Gauss rule.
        const bool all_positive = std::ranges::all_of(together(spectra).weight,
                                                      [](double weight) { return weight >= 0; });
        constexpr double smaller = 0.75, smallest = 64; // samples
        constexpr double worthwhile = 0.9;              // of the wavelengths
        for (double half = maker.grid().half(); of.empty() || half >= smallest; half *= smaller) {
            const auto [rule, own, error] =
                choose_wavelengths(spectra, maker.path(std::numbers::sqrt2 * half), brightness, eps,
                                   all_positive ? worthwhile : 0);
            if (of.empty() || static_cast<double>(rule.size()) <
                                  worthwhile * static_cast<double>(of.back().wavelengths.size()))
                of.push_back({half, rule.wavelengths(), own});
            missed = std::max(missed, error);
        }
    }
};

// The sums over the rules' wavelengths, one a row of weights.
std::vector<Field> fields_of(const ImageMaker &maker, const Scaling &scaling, Images images,
                             const Rules &rules, const Progress &progress) {
    const auto scaled = [&maker](ColourSums sums) {
        for (std::vector<double> &own : sums.weights)
            for (size_t k = 0; k < own.size(); ++k)
                own[k] *= maker.scale(sums.wavelengths[k]);
        return sums;
    };
    std::vector<ColourSums> by_rules;
    std::ranges::transform(rules.of, std::back_inserter(by_rules), scaled);
    std::vector<Field> fields;
    auto all = scaling.sums(std::move(images.intensity), scaled(rules.all), by_rules, progress);
    for (Plane<double> &sum : all) {
        Field &field = fields.emplace_back(maker.interpolator());
        field.per_pixel = maker.per_pixel();
        field.grid_size = maker.grid().size;
        field.nodes = images.nodes;
        field.value = maker.averaged(std::exchange(sum, {}));
        field.find_peaks();
    }
    const ColourSums &outermost = rules.of[0];
    for (size_t k = 0; k < outermost.wavelengths.size(); ++k) {
        const double wavelength = outermost.wavelengths[k];
        const std::vector<double> shares = scaling.shares(wavelength);
        double error = scaling.error() + maker.filter_error(), model_error = 0;
        for (size_t j = 0; j < shares.size(); ++j) {
            error += std::abs(shares[j]) * images.error[j];
            model_error += shares[j] * images.model_error[j];
        }
        for (size_t s = 0; s < fields.size(); ++s) {
            Field &field = fields[s];
            const double weight = outermost.weights[s][k];
            const double in_peaks =
                std::abs(weight) * maker.unaberrated_peak(wavelength) / field.faintest_peak;
            field.error += in_peaks * error;
            field.model_error += in_peaks * std::abs(model_error);
            field.colours.push_back({wavelength, weight});
        }
    }
    return fields;
}

// What the field of other optics is made by as one was.
struct Remaking {
    ImageMaker maker;
    Scaling scaling;
    std::vector<double> wavelengths, weights;

    Remaking(const Field &like, const Optics &optics, const PsfSettings &settings, double radius)
        : maker(optics, settings, like.shortest_wavelength, radius,
                shares(like).of_images * like.tolerance),
          scaling(maker, like.shortest_wavelength, like.longest_wavelength,
                  shares(like).of_scaling * like.tolerance) {
        for (const Colour &colour : like.colours) {
            wavelengths.push_back(colour.wavelength);
            weights.push_back(colour.weight);
        }
    }
    static Shares shares(const Field &like) {
        return Shares(like.shortest_wavelength < like.longest_wavelength);
    }
};

} // namespace

// All errors arise in units of the unaberrated peak before the pixel's average; eps counts in the
// stamp's brightest pixel. Their ratio is guessed, and made up for where the guess was too good (an
// aberrated wavefront): once more is the rule, several times for the hardest ones.
std::vector<Field> make_fields(const Optics &optics, std::span<const Light> lights,
                               const PsfSettings &settings, double radius, const Manners &manners) {
    const KeptMemory kept;
    const auto spectra_for = [&lights](double path) {
        std::vector<Spectrum> spectra;
        for (const Light &light : lights)
            spectra.push_back(light(path));
        return spectra;
    };
    const Spectrum all = together(spectra_for(0));
    const auto [blue, red] = std::ranges::minmax(all.wavelength);
    const Shares shares(blue < red);
    const double pixel = settings.pixel_scale / blue;
    const double ratio = guessed_ratio(optics.aperture->area() * pixel * pixel);
    double tolerance = settings.eps / ratio;
    for (int count = 0;; ++count) {
        const ImageMaker maker(optics, settings, blue, radius, shares.of_images * tolerance);
        const std::vector<Spectrum> spectra = spectra_for(maker.longest_path());
        const auto [bluest, reddest] = std::ranges::minmax(together(spectra).wavelength);
        const Scaling scaling(maker, bluest, reddest, shares.of_scaling * tolerance);
        manners.require_memory(memory(maker, scaling, lights.size()), "a field of that radius");
        Images images(maker, scaling, manners.progress.between(0, 0.6));
        const Brightness brightness = brightness_of(images, scaling, maker, bluest / reddest);
        const auto [rule, weights, missed] = choose_wavelengths(
            spectra, maker.longest_path(), brightness, shares.of_rule * tolerance);
        const Rules rules(maker, sums_over(spectra, maker.grid().half()), rule.wavelengths(),
                          weights, brightness, shares.of_fewer * tolerance);
        std::vector<Field> fields =
            fields_of(maker, scaling, std::move(images), rules, manners.progress.between(0.6, 1));
        double error = 0;
        for (Field &field : fields) {
            field.shortest_wavelength = bluest;
            field.longest_wavelength = reddest;
            field.tolerance = tolerance;
            field.error +=
                (missed + rules.missed) * maker.unaberrated_peak(bluest) / field.faintest_peak;
            error = std::max(error, field.error);
        }
        if (error <= settings.eps || count == 4 || tolerance < 1e-15)
            return fields;
        tolerance *= 0.7 * settings.eps / error;
    }
}

Field make_field_like(const Field &like, const Optics &optics, const PsfSettings &settings,
                      double radius) {
    const Remaking as(like, optics, settings, radius);
    Images images(as.maker, as.scaling, {});
    const Brightness brightness = brightness_of(images, as.scaling, as.maker,
                                                like.shortest_wavelength / like.longest_wavelength);
    const Rules rules(as.maker, {as.maker.grid().half(), as.wavelengths, {as.weights}},
                      as.wavelengths, {&as.weights, 1}, brightness,
                      Remaking::shares(like).of_fewer * like.tolerance);
    Field field = std::move(fields_of(as.maker, as.scaling, std::move(images), rules, {})[0]);
    field.error +=
        rules.missed * as.maker.unaberrated_peak(like.shortest_wavelength) / field.faintest_peak;
    field.shortest_wavelength = like.shortest_wavelength;
    field.longest_wavelength = like.longest_wavelength;
    field.tolerance = like.tolerance;
    return field;
}

std::vector<Field> make_field_changes(const Field &like, const Optics &optics,
                                      std::span<const Wavefront> by, const PsfSettings &settings,
                                      double radius) {
    const Remaking as(like, optics, settings, radius);
    // By waves at each wavelength, an image changes as smoothly with it as it does itself.
    std::vector<double> weights = as.weights;
    for (size_t k = 0; k < weights.size(); ++k)
        weights[k] *= as.maker.scale(as.wavelengths[k]) * optics.wavelength / as.wavelengths[k];
    std::vector<std::vector<Plane<double>>> changes(by.size()); // by wavelength
    for (const double wavelength : as.scaling.wavelengths()) {
        auto of_all = as.maker.changes(wavelength, by, as.scaling.grid(wavelength));
        for (size_t i = 0; i < by.size(); ++i)
            changes[i].push_back(std::move(of_all[i]));
    }
    std::vector<Field> fields;
    const ColourSums rule{as.maker.grid().half(), as.wavelengths, {weights}};
    for (std::vector<Plane<double>> &images : changes) {
        Field &field = fields.emplace_back(as.maker.interpolator());
        field.per_pixel = as.maker.per_pixel();
        field.value =
            as.maker.averaged(as.scaling.sums(std::exchange(images, {}), rule, {&rule, 1})[0]);
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
