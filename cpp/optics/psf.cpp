// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/psf.hpp"

#include "error/error.hpp"
#include "optics/add_stars.hpp"

#include <algorithm>
#include <cmath>
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

Otf Psf::otf(double eps) const {
    return {components(), settings_.pixel_scale, settings_.mirrored,
            eps,          settings_.blur,        settings_.pixel_response};
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
        return add_large_stamp(optics_, light_, settings_, field_.faintest_peak, star,
                               {reach, oversampling, image.nx, image.ny}, image, manners);
    }
    if (drawing == Drawing::overwrites) {
        field_.draw(star, oversampling, 0, 0, image);
    } else {
        Plane<double> stamp(image.nx, image.ny);
        field_.draw(star, oversampling, 0, 0, stamp.view());
        fill([&stamp](T before, int64_t x, int64_t y) { return before + stamp(x, y); });
    }
    return field_.error;
}

StampMemory Psf::draw_memory(const Star &star, int64_t oversampling, int64_t nx, int64_t ny) const {
    const double reach = checked_reach(star, oversampling, nx, ny);
    if (reach <= settings_.radius)
        return {0, 0};
    return stamp_memory(optics_, light_, settings_, field_.faintest_peak,
                        {reach, oversampling, nx, ny});
}

template <class T>
void Psf::add(std::span<const Star> stars, int64_t oversampling, View<T> image, int threads) const {
    on_bands_of_rows(image.ny, threads, [&](int64_t first_row, int64_t last_row) {
        StarRows<T> rows(oversampling, image, first_row, last_row);
        for (const Star &star : stars)
            rows.add(field_, star, settings_.radius);
    });
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
