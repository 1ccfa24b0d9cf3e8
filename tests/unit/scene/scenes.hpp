// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes to test with, and what they should look like: every star drawn with a PSF of its own.
#pragma once

#include "instrument/instrument.hpp"
#include "scene/plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace wfpsf::scenes {

constexpr double pixel_scale = 0.11 * std::numbers::pi / 180 / 3600;

inline SceneOptics roman(const char *band, std::vector<Light> lights, int sca = 7) {
    const Instrument &roman = Instrument::get("roman-c9");
    const std::shared_ptr<const Aperture> aperture =
        make_aperture(std::get<RomanPupil>(roman.pupil(sca, band)));
    return {.at =
                [&roman, aperture, sca](double x, double y) {
                    std::vector<double> zernikes = roman.zernikes(sca, x, y);
                    std::fill_n(zernikes.begin(), 3, 0.0);
                    return Optics{aperture, Wavefront(zernikes, roman.diameter_m() / 2), 1293e-9};
                },
            .varies = true,
            .region = {-512, -512, 4599, 4599},
            .settings = {.wavelength = 1293e-9, .pixel_scale = pixel_scale, .eps = 0, .radius = 0},
            .pixel_scale_arcsec = 0.11,
            .lights = std::move(lights)};
}

// Stars all over an image and `margin` pixels around it, of magnitudes with counts that rise as
// 10^(slope m) from `bright` to `faint`, the first of the brightest.
struct Field {
    int64_t count;
    double bright, faint, slope, zero_flux;
};
inline std::vector<PlacedSource> stars(const Field &field, const SceneImage &image, double margin,
                                       int32_t colours = 1, unsigned seed = 1) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<PlacedSource> sources;
    const auto place = [&](double from, int64_t samples) {
        const double size = static_cast<double>(samples) / static_cast<double>(image.oversampling);
        return from - margin + uniform(random) * (size + 2 * margin);
    };
    for (int64_t i = 0; i < field.count; ++i) {
        const double low = std::pow(10, field.slope * (field.bright - field.faint));
        const double u = i == 0 ? 0 : uniform(random);
        const double m = field.faint + std::log10(low + u * (1 - low)) / field.slope;
        const double x = place(image.x0, image.nx), y = place(image.y0, image.ny);
        sources.push_back({x, y, field.zero_flux * std::pow(10.0, -0.4 * m),
                           static_cast<int32_t>(i % colours), PlacedSource::star, i});
    }
    return sources;
}

// The same sources in a window of the image by brute force, each with its own exact PSF that
// reaches all of the window.
inline Plane<double> brute_force(const SceneOptics &optics, std::span<const PlacedSource> sources,
                                 const SceneImage &window, double eps) {
    Plane<double> image(window.nx, window.ny);
    const auto n = static_cast<double>(window.oversampling);
    for (const PlacedSource &source : sources) {
        const Star star{(source.x - window.x0) * n + (n - 1) / 2,
                        (source.y - window.y0) * n + (n - 1) / 2, source.flux};
        const double reach =
            std::max({std::abs(star.x), std::abs(star.x - static_cast<double>(window.nx - 1)),
                      std::abs(star.y), std::abs(star.y - static_cast<double>(window.ny - 1))}) /
            n;
        PsfSettings settings = optics.settings;
        settings.eps = eps;
        settings.radius = std::min(reach + 1, 300.0);
        const Region &region = optics.region;
        const Optics here = optics.at(std::clamp(source.x, region.x0, region.x1),
                                      std::clamp(source.y, region.y0, region.y1));
        const Light &light = optics.lights[static_cast<size_t>(source.colour)];
        const Psf psf = std::move(make_psfs(here, {&light, 1}, settings)[0]);
        psf.draw(star, window.oversampling, image.view(), Psf::Drawing::adds);
    }
    return image;
}

} // namespace wfpsf::scenes
