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

// The distance of an image's farthest pixel from a star, along an axis, native pixels.
double checked_reach(const Star &star, int64_t oversampling, int64_t nx, int64_t ny) {
    constexpr double largest = 4096;
    const double reach =
        std::max({std::abs(star.x), std::abs(static_cast<double>(nx - 1) - star.x),
                  std::abs(star.y), std::abs(static_cast<double>(ny - 1) - star.y)}) /
        static_cast<double>(oversampling);
    if (!(reach <= largest))
        fail(WFPSF_ERROR_RANGE,
             "star at (%g, %g): farther than %g native pixels from a pixel of the image", star.x,
             star.y, largest);
    return reach;
}

} // namespace

Psf::Psf(std::shared_ptr<const Aperture> aperture, const Wavefront &wavefront,
         const PsfSettings &settings)
    : optics_{std::move(aperture), wavefront, settings.wavelength},
      light_(monochromatic(settings.wavelength)), settings_(settings),
      field_(std::move(make_fields(optics_, {&light_, 1}, settings_, settings_.radius)[0])) {}

Psf::Psf(const Optics &optics, Light light, const PsfSettings &settings, Field field)
    : optics_(optics), light_(std::move(light)), settings_(settings), field_(std::move(field)) {}

std::vector<Component> Psf::components() const {
    std::vector<Component> parts;
    for (const Colour &colour : field_.colours)
        parts.push_back({optics_.aperture,
                         optics_.wavefront.scaled(optics_.wavelength / colour.wavelength),
                         colour.wavelength, colour.weight});
    return parts;
}

template <class T>
double Psf::draw(const Star &star, int64_t oversampling, View<T> image, Drawing drawing,
                 const Manners &manners) const {
    if (image.empty())
        return 0;
    const double reach = checked_reach(star, oversampling, image.nx, image.ny);
    const auto fill = [&image](const auto &value) {
        for (int64_t y = 0; y < image.ny; ++y)
            for (int64_t x = 0; x < image.nx; ++x)
                image(x, y) = static_cast<T>(value(image(x, y), x, y));
    };
    if (reach > settings_.radius) {
        if (drawing == Drawing::overwrites)
            fill([](T, int64_t, int64_t) { return 0; });
        return add_large_stamp(optics_, light_, settings_, field_.peak, star,
                               {reach, oversampling, image.nx, image.ny}, image, manners);
    }
    if (drawing == Drawing::overwrites) {
        draw_from(field_, star, oversampling, 0, 0, image);
    } else {
        Plane<double> stamp(image.nx, image.ny);
        draw_from(field_, star, oversampling, 0, 0, stamp.view());
        fill([&stamp](T before, int64_t x, int64_t y) { return before + stamp(x, y); });
    }
    return field_.error;
}

StampMemory Psf::draw_memory(const Star &star, int64_t oversampling, int64_t nx, int64_t ny) const {
    const double reach = checked_reach(star, oversampling, nx, ny);
    if (reach <= settings_.radius)
        return {0, 0};
    return stamp_memory(optics_, light_, settings_, field_.peak, {reach, oversampling, nx, ny});
}

// The star counts from a pixel of which out's first one is (first_x, first_y).
template <class T>
void Psf::draw_from(const Field &field, const Star &star, int64_t oversampling, int64_t first_x,
                    int64_t first_y, View<T> out) const {
    const auto n = static_cast<double>(oversampling);
    const double centre = static_cast<double>(field.value.nx() - 1) / 2;
    const auto positions = [&](double place, int64_t first, int64_t count) {
        return Positions{centre - place * static_cast<double>(field.per_pixel) / n, first, count,
                         field.per_pixel, oversampling};
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

std::vector<Psf> make_psfs(const Optics &optics, std::span<const Light> lights,
                           const PsfSettings &settings, const Manners &manners) {
    std::vector<Field> fields = make_fields(optics, lights, settings, settings.radius, manners);
    std::vector<Psf> psfs;
    for (size_t s = 0; s < lights.size(); ++s)
        psfs.emplace_back(optics, lights[s], settings, std::move(fields[s]));
    return psfs;
}

template void Psf::add(std::span<const Star>, int64_t, View<float>, int) const;
template void Psf::add(std::span<const Star>, int64_t, View<double>, int) const;
template double Psf::draw(const Star &, int64_t, View<float>, Drawing, const Manners &) const;
template double Psf::draw(const Star &, int64_t, View<double>, Drawing, const Manners &) const;

} // namespace wfpsf
