// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/sky.hpp"

#include "error/error.hpp"
#include "instrument/detector.hpp"
#include "instrument/roman_c9/tables.hpp"
#include "instrument/wfirst_afta_c5/tables.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wfpsf {

namespace {

constexpr size_t latitudes = 42, longitudes = 46;
constexpr double longitude_step = 4;

bool is_c5(const Instrument &instrument) {
    return std::string_view(instrument.name) == "wfirst-afta-c5";
}

// A place between two samples of an axis.
struct Between {
    size_t index;
    double share; // of the next sample
};

Between between(double place, size_t count) {
    const auto last = static_cast<double>(count - 2);
    const double index = std::clamp(std::floor(place), 0.0, last);
    return {static_cast<size_t>(index), place - index};
}

} // namespace

DetectorFigures detector_figures(const Instrument &instrument) {
    return is_c5(instrument) ? wfirst_afta_c5::detector() : roman_c9::detector();
}

double sky_level(const Instrument &instrument, std::string_view band, double longitude,
                 double latitude) {
    instrument.band(band); // the names' own error
    if (!std::isfinite(longitude))
        fail(WFPSF_ERROR_NOT_FINITE, "longitude = %g: must be finite", longitude);
    if (!(std::fabs(latitude) <= 90))
        fail(WFPSF_ERROR_RANGE, "latitude = %g: must be -90..90", latitude);
    const auto curves = is_c5(instrument) ? wfirst_afta_c5::sky() : roman_c9::sky();
    const auto curve = std::ranges::find(curves, band, &SkyCurve::name);
    if (curve == curves.end())
        fail(WFPSF_ERROR_UNKNOWN_NAME, "band = %.20s: has no table of the sky",
             std::string(band).c_str());

    const double sine = std::sin(std::fabs(latitude) * std::numbers::pi / 180);
    const Between y = between(sine * (latitudes - 1), latitudes);
    const Between x =
        between(std::fabs(std::remainder(longitude, 360)) / longitude_step, longitudes);
    const auto at = [&](size_t i, size_t j) { // what the Sun hides counts as very bright
        const double value = curve->values[i * latitudes + j];
        return value > 0 ? value : 1e6;
    };
    const double level =
        (1 - x.share) *
            ((1 - y.share) * at(x.index, y.index) + y.share * at(x.index, y.index + 1)) +
        x.share *
            ((1 - y.share) * at(x.index + 1, y.index) + y.share * at(x.index + 1, y.index + 1));
    if (level > std::ranges::max(curve->values))
        fail(WFPSF_ERROR_SKY_SUN,
             "longitude = %g, latitude = %g: too close to the Sun, no zodiacal light is tabulated",
             longitude, latitude);
    if (!is_c5(instrument))
        return level;
    const double diameter = instrument.diameter_m(), obscuration = instrument.obscuration();
    return level * std::numbers::pi / 4 * diameter * diameter * (1 - obscuration * obscuration);
}

} // namespace wfpsf
