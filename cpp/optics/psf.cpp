// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/psf.hpp"

#include "error/error.hpp"
#include "optics/resample.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <thread>
#include <vector>

namespace wfpsf {

namespace {

// The intensity holds no frequency above diameter / wavelength. Sampling it at twice Nyquist's rate
// or somewhat finer keeps the filters short; a whole number of samples a native pixel lets all
// pixels of a stamp share one filter.
constexpr double widest_band = 0.25; // cycles per sample

constexpr double largest_reach = 4096; // native pixels

} // namespace

Psf::Psf(std::shared_ptr<const Aperture> aperture, const Wavefront &wavefront,
         const PsfSettings &settings)
    : aperture_(std::move(aperture)), wavefront_(wavefront), settings_(settings),
      per_pixel_(static_cast<int64_t>(std::ceil(aperture_->diameter() * settings.pixel_scale /
                                                (widest_band * settings.wavelength)))),
      field_(make_field(settings.radius)) {}

// All errors arise in units of the unaberrated peak before the pixel's average; eps counts in the
// stamp's brightest pixel. Their ratio is guessed, and made up for where the guess was too good (an
// aberrated wavefront): once more is the rule, several times for the hardest ones.
Psf::Field Psf::make_field(double radius) const {
    const double pixel = settings_.pixel_scale / settings_.wavelength;
    const double ratio = 2 * (1 + 1.7 * aperture_->area() * pixel * pixel);
    double tolerance = settings_.eps / ratio;
    for (int attempt = 0;; ++attempt) {
        Field field = make_field(radius, tolerance);
        if (field.error <= settings_.eps || attempt == 4 || tolerance < 1e-15)
            return field;
        tolerance *= 0.7 * settings_.eps / field.error;
    }
}

// `tolerance` in units of the unaberrated peak.
Psf::Field Psf::make_field(double radius, double tolerance) const {
    const double bandwidth = aperture_->diameter() * grid_step() / settings_.wavelength;
    const auto per_pixel = static_cast<double>(per_pixel_);
    const double strength =
        outline_strength(aperture_->outline(), aperture_->diameter(), aperture_->area());
    const AveragedSamples samples(bandwidth, per_pixel, aperture_->outline(),
                                  0.8 * tolerance / strength);
    Field field(samples.interpolator());
    const std::vector<double> &pixel = samples.averaging();
    const auto margin = static_cast<int64_t>(pixel.size()) / 2;
    const auto reach =
        static_cast<int64_t>(std::ceil(radius * per_pixel)) + field.interpolator.half_width();
    const FocalGrid grid{2 * (reach + margin) + 1, grid_step()};
    const Diffraction diffraction =
        aperture_->diffract(wavefront_, settings_.wavelength, grid, 0.2 * tolerance);
    View<const double> intensity = diffraction.intensity.view();
    if (settings_.mirrored)
        intensity = {intensity.row(grid.size - 1), grid.size, grid.size, 1, -grid.size};

    field.value = filter(intensity, pixel);
    field.nodes = diffraction.nodes;
    // Fraction of the light in a pixel: its solid angle times |A|^2 / (area lambda^2).
    const double wavelengths = settings_.pixel_scale / settings_.wavelength;
    const double scale = wavelengths * wavelengths / aperture_->area();
    for (int64_t y = 0; y < field.value.ny(); ++y)
        for (int64_t x = 0; x < field.value.nx(); ++x) {
            field.value(x, y) *= scale;
            field.peak = std::max(field.peak, field.value(x, y));
        }
    // A stamp's brightest pixel may be half the largest possible one.
    const double ratio = 2 * scale * aperture_->area() * aperture_->area() / field.peak;
    field.error = ratio * (diffraction.error + strength * samples.error());
    field.model_error = ratio * diffraction.model_error;
    return field;
}

template <class T>
void Psf::draw(double x, double y, double flux, int64_t oversampling, View<T> out) const {
    if (out.empty())
        return;
    const double reach = std::max({std::abs(x), std::abs(static_cast<double>(out.nx - 1) - x),
                                   std::abs(y), std::abs(static_cast<double>(out.ny - 1) - y)}) /
                         static_cast<double>(oversampling);
    if (!(reach <= largest_reach))
        fail(WFPSF_ERROR_RANGE,
             "star at (%g, %g): farther than %g native pixels from a pixel of the image", x, y,
             largest_reach);
    if (reach > settings_.radius)
        draw_from(make_field(reach), {x, y, flux}, oversampling, 0, 0, out);
    else
        draw_from(field_, {x, y, flux}, oversampling, 0, 0, out);
}

// The star counts from a pixel of which out's first one is (first_x, first_y).
template <class T>
void Psf::draw_from(const Field &field, const Star &star, int64_t oversampling, int64_t first_x,
                    int64_t first_y, View<T> out) const {
    const auto n = static_cast<double>(oversampling);
    const double centre = static_cast<double>(field.value.nx() - 1) / 2;
    const auto positions = [&](double place, int64_t first, int64_t count) {
        return Positions{centre - place * static_cast<double>(per_pixel_) / n, first, count,
                         per_pixel_, oversampling};
    };
    resample(field.value.view(), field.interpolator, positions(star.x, first_x, out.nx),
             positions(star.y, first_y, out.ny), star.flux / (n * n), out);
}

template <class T>
void Psf::add(std::span<const Star> stars, int64_t oversampling, View<T> image, int threads) const {
    const auto bands = std::clamp<int64_t>(threads, 1, std::max<int64_t>(image.ny, 1));
    std::vector<std::exception_ptr> failures(static_cast<size_t>(bands));
    const auto work = [&](int64_t band) noexcept {
        try {
            add_to_rows(stars, oversampling, image, image.ny * band / bands,
                        image.ny * (band + 1) / bands - 1);
        } catch (...) {
            failures[static_cast<size_t>(band)] = std::current_exception();
        }
    };
    std::vector<std::jthread> others;
    for (int64_t band = 1; band < bands; ++band)
        others.emplace_back(work, band);
    work(0);
    for (std::jthread &other : others)
        other.join();
    for (const std::exception_ptr &failure : failures)
        if (failure)
            std::rethrow_exception(failure);
}

template <class T>
void Psf::add_to_rows(std::span<const Star> stars, int64_t oversampling, View<T> image,
                      int64_t first_row, int64_t last_row) const {
    const double radius = settings_.radius * static_cast<double>(oversampling);
    Plane<double> stamp;
    for (const Star &star : stars) {
        // Far from the image nothing is done, and nothing overflows.
        if (star.x < -radius || star.x > static_cast<double>(image.nx) + radius ||
            star.y < -radius || star.y > static_cast<double>(image.ny) + radius)
            continue;
        const auto window_x = static_cast<int64_t>(std::ceil(star.x - radius));
        const auto window_y = static_cast<int64_t>(std::ceil(star.y - radius));
        const int64_t x0 = std::max<int64_t>(window_x, 0), y0 = std::max(window_y, first_row);
        const int64_t x1 =
            std::min(static_cast<int64_t>(std::floor(star.x + radius)), image.nx - 1);
        const int64_t y1 = std::min(static_cast<int64_t>(std::floor(star.y + radius)), last_row);
        if (x0 > x1 || y0 > y1)
            continue;
        if (stamp.nx() != x1 - x0 + 1 || stamp.ny() != y1 - y0 + 1)
            stamp = Plane<double>(x1 - x0 + 1, y1 - y0 + 1);
        const Star in_window{star.x - static_cast<double>(window_x),
                             star.y - static_cast<double>(window_y), star.flux};
        draw_from(field_, in_window, oversampling, x0 - window_x, y0 - window_y, stamp.view());
        for (int64_t y = y0; y <= y1; ++y)
            for (int64_t x = x0; x <= x1; ++x)
                image(x, y) += static_cast<T>(stamp(x - x0, y - y0));
    }
}

template void Psf::add(std::span<const Star>, int64_t, View<float>, int) const;
template void Psf::add(std::span<const Star>, int64_t, View<double>, int) const;
template void Psf::draw(double, double, double, int64_t, View<float>) const;
template void Psf::draw(double, double, double, int64_t, View<double>) const;

} // namespace wfpsf
