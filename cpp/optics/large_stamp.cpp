// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/large_stamp.hpp"

#include "optics/colours.hpp"
#include "optics/image_maker.hpp"
#include "optics/resample.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

namespace {

constexpr auto number = static_cast<int64_t>(sizeof(double));

// The grid, the filters and the memory of a stamp.
class Plan {
  public:
    Plan(const Optics &optics, const Light &light, const PsfSettings &settings,
         double faintest_peak, const StampSize &size)
        : spectrum_(light(0)), for_colour_(spectrum_.size() > 1 ? settings.eps / 2 : 0),
          peak_(faintest_peak), maker_(optics, settings, blue(), size.reach,
                                       std::min(0.1, (settings.eps - for_colour_) * peak_ /
                                                         unaberrated_peak(optics, settings))),
          size_(size) {}

    const ImageMaker &maker() const { return maker_; }
    double for_colour() const { return for_colour_; }
    double blue() const { return std::ranges::min(spectrum_.wavelength); }
    // An error in units of the unaberrated peak, in those of the stamp's brightest pixel.
    double in_peaks(double error) const { return error / peak_; }

    int64_t field_size() const { return maker_.grid().size - 2 * maker_.margin(); }
    // Samples of the field between two rows of the stamp.
    double row_step() const {
        return static_cast<double>(maker_.per_pixel()) / static_cast<double>(size_.oversampling);
    }
    // Rows of the field that `rows` rows of the stamp are interpolated from.
    int64_t field_rows(int64_t rows) const {
        return static_cast<int64_t>(std::ceil(static_cast<double>(rows - 1) * row_step())) +
               2 * maker_.interpolator().half_width() + 2;
    }

    int64_t memory(int64_t rows) const {
        const auto [fixed, per_row] = maker_.strip_memory(blue());
        const int64_t field_row = field_size() * number;
        const int64_t of_field = (maker_.filter_terms() > 1 ? 2 : 1) * field_row;
        return fixed + (field_rows(rows) + 2 * maker_.margin()) * per_row +
               field_rows(rows) * of_field + rows * size_.nx * number;
    }

    // The most rows of the stamp that may be drawn at a time.
    int64_t rows_within(int64_t limit) const {
        int64_t rows = size_.ny;
        while (rows > 1 && memory(rows) > limit)
            rows = (rows + 1) / 2;
        return rows;
    }

  private:
    // Of the bluest light, the largest.
    double unaberrated_peak(const Optics &optics, const PsfSettings &settings) const {
        const double wavelengths = settings.pixel_scale / blue();
        return wavelengths * wavelengths * optics.aperture->area();
    }

    Spectrum spectrum_;
    double for_colour_, peak_;
    ImageMaker maker_;
    StampSize size_;
};

// Adds rows first..first+image.ny-1 of the stamp, of which `image` holds those alone.
template <class T>
void add_rows(const Plan &plan, const DiffractionStrips &strips, const Star &star, double scale,
              int64_t oversampling, int64_t first, View<T> image) {
    const ImageMaker &maker = plan.maker();
    const int64_t half_width = maker.interpolator().half_width(), per_pixel = maker.per_pixel();
    const double centre = static_cast<double>(plan.field_size() - 1) / 2;
    const auto start = [&](double place) { return centre - place * plan.row_step(); };
    const int64_t begin = static_cast<int64_t>(std::floor(
                              start(star.y) + static_cast<double>(first) * plan.row_step())) -
                          half_width;
    const int64_t rows = plan.field_rows(image.ny) + 2 * maker.margin();
    // Images that are mirrored have their first row where the diffraction has its last.
    const int64_t origin = maker.mirrored() ? maker.grid().size - begin - rows : begin;
    const int64_t low = std::max<int64_t>(origin, 0);
    const int64_t high = std::min(origin + rows, maker.grid().size);
    const Plane<double> field = maker.averaged(strips.rows(low, high - low));
    const int64_t field_begin =
        maker.mirrored() ? begin + origin + rows - high : begin + low - origin;
    Plane<double> stamp(image.nx, image.ny);
    resample(field.view(), maker.interpolator(),
             Positions{start(star.x), 0, image.nx, per_pixel, oversampling},
             Positions{start(star.y) - static_cast<double>(field_begin), first, image.ny, per_pixel,
                       oversampling},
             scale, stamp.view());
    for (int64_t y = 0; y < image.ny; ++y)
        for (int64_t x = 0; x < image.nx; ++x)
            image(x, y) += static_cast<T>(stamp(x, y));
}

} // namespace

StampMemory stamp_memory(const Optics &optics, const Light &light, const PsfSettings &settings,
                         double faintest_peak, const StampSize &size) {
    const Plan plan(optics, light, settings, faintest_peak, size);
    return {plan.memory(1), plan.memory(size.ny)};
}

template <class T>
double add_large_stamp(const Optics &optics, const Light &light, const PsfSettings &settings,
                       double faintest_peak, const Star &star, const StampSize &size, View<T> image,
                       const Manners &manners) {
    const Plan plan(optics, light, settings, faintest_peak, size);
    const KeptMemory kept;
    manners.require_memory(plan.memory(1), "a stamp that large, a row at a time,");
    const int64_t height = plan.rows_within(manners.memory_limit);
    const ImageMaker &maker = plan.maker();
    const Spectrum spectrum = light(maker.longest_path());
    const double in_peaks = plan.in_peaks(maker.unaberrated_peak(plan.blue()));
    const auto [rule, all_weights, colour_error] =
        choose_wavelengths({&spectrum, 1}, maker.longest_path(), usual_brightness(plan.blue()),
                           plan.for_colour() / in_peaks);
    const std::vector<double> &weights = all_weights[0];

    const auto n = static_cast<double>(size.oversampling);
    double error = 0, unaberrated_peak = 0;
    for (size_t k = 0; k < rule.size(); ++k) {
        const Progress progress =
            manners.progress.between(static_cast<double>(k) / static_cast<double>(rule.size()),
                                     static_cast<double>(k + 1) / static_cast<double>(rule.size()));
        progress.report(0);
        const double wavelength = rule.wavelengths()[k];
        const auto strips = maker.diffract_in_strips(wavelength);
        const double scale = star.flux / (n * n) * weights[k] * maker.scale(wavelength);
        for (int64_t first = 0; first < image.ny; first += height) {
            progress.report(static_cast<double>(first) / static_cast<double>(image.ny));
            add_rows(plan, *strips, star, scale, size.oversampling, first,
                     View<T>{image.row(first), image.nx, std::min(height, image.ny - first),
                             image.stride_x, image.stride_y});
        }
        const double at_peak = std::abs(weights[k]) * maker.unaberrated_peak(wavelength);
        error += at_peak * strips->error();
        unaberrated_peak += at_peak;
    }
    return plan.in_peaks(error + unaberrated_peak * maker.filter_error()) + in_peaks * colour_error;
}

template double add_large_stamp(const Optics &, const Light &, const PsfSettings &, double,
                                const Star &, const StampSize &, View<float>, const Manners &);
template double add_large_stamp(const Optics &, const Light &, const PsfSettings &, double,
                                const Star &, const StampSize &, View<double>, const Manners &);

} // namespace wfpsf
