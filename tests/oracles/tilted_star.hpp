// SPDX-License-Identifier: GPL-3.0-or-later
// Light far from a star by a small field of the exact engine: a tilt of the wavefront takes the
// place (x, y) native pixels off the star to the axis.
#pragma once

#include "instrument/instrument.hpp"
#include "optics/field.hpp"
#include "optics/spectrum.hpp"

#include <memory>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

namespace wfpsf::oracle {

// Of both telescopes.
constexpr double native_pixel = 0.11 * std::numbers::pi / 180 / 3600; // rad
constexpr double reference_wavelength = 1293e-9, pupil_radius = 1.18; // m

// `waves`: Noll's terms from 1 on, of which the first three are replaced.
inline Optics tilted(std::shared_ptr<const Aperture> aperture, std::vector<double> waves, double x,
                     double y) {
    const double a_pixel = native_pixel * pupil_radius / (2 * reference_wavelength);
    waves[0] = 0;
    waves[1] = x * a_pixel;
    waves[2] = y * a_pixel;
    return {std::move(aperture), Wavefront(waves, pupil_radius), reference_wavelength};
}

// Seen through a band in the middle of a telescope's seventh detector.
struct TiltedStar {
    const Instrument &instrument;
    std::shared_ptr<const Aperture> aperture;
    Light light; // a black body of 5000 K

    TiltedStar(const char *name, const char *band, std::shared_ptr<const Aperture> behind)
        : instrument(Instrument::get(name)), aperture(std::move(behind)),
          light(detected_light(instrument.band(band), black_body_sed(5000))) {}
    TiltedStar(const char *name, const char *band)
        : TiltedStar(name, band,
                     std::visit(
                         [](const auto &pupil) {
                             return std::shared_ptr<const Aperture>(make_aperture(pupil));
                         },
                         Instrument::get(name).pupil(7, band))) {}

    Optics optics(double x = 0, double y = 0) const {
        const auto zernikes = instrument.zernikes(7);
        return tilted(aperture, {zernikes.begin(), zernikes.end()}, x, y);
    }
};

} // namespace wfpsf::oracle
