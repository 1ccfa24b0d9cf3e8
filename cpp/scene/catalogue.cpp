// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/catalogue.hpp"

#include "error/error.hpp"
#include "instrument/band.hpp"
#include "scene/sersic.hpp"

#include <algorithm>
#include <cmath>

namespace wfpsf {

namespace {

void require_range(const char *name, size_t i, double value, double low, double high) {
    if (!std::isfinite(value))
        fail(WFPSF_ERROR_NOT_FINITE, "%s[%zu] = %g: must be finite", name, i, value);
    if (!(value >= low && value <= high))
        fail(WFPSF_ERROR_RANGE, "%s[%zu] = %g: must be %g..%g", name, i, value, low, high);
}

void check_shapes(std::span<const GalaxyShape> shapes) {
    for (size_t i = 0; i < shapes.size(); ++i) {
        const GalaxyShape &s = shapes[i];
        require_range("sersic_index", i, s.sersic_index, Sersic::smallest_index,
                      Sersic::largest_index);
        require_range("half_light_radius", i, s.half_light_radius_arcsec, 1e-6, 1e3);
        require_range("e1", i, s.e1, -1, 1);
        require_range("e2", i, s.e2, -1, 1);
        if (!(std::hypot(s.e1, s.e2) <= 0.95))
            fail(WFPSF_ERROR_RANGE, "e1[%zu], e2[%zu] = %g, %g: their hypotenuse must be 0..0.95",
                 i, i, s.e1, s.e2);
    }
}

} // namespace

int32_t Catalogue::add_colour(SourceColour colour) {
    colours_.push_back(std::move(colour));
    return static_cast<int32_t>(colours_.size() - 1);
}

void Catalogue::check(const Columns &columns) const {
    constexpr double far = 1e9;
    const bool on_sky = positions_ == PositionKind::sky;
    const bool magnitudes = brightness_ == BrightnessKind::ab_magnitude;
    const auto colours = static_cast<double>(std::max<size_t>(colours_.size(), 1));
    for (size_t i = 0; i < columns.x.size(); ++i) {
        require_range("x", i, columns.x[i], on_sky ? -1e6 : -far, on_sky ? 1e6 : far);
        require_range("y", i, columns.y[i], on_sky ? -90 : -far, on_sky ? 90 : far);
        // 1e18 e-: more than a full detector of saturated pixels holds.
        require_range("brightness", i, columns.brightness[i], magnitudes ? -20 : -1e18,
                      magnitudes ? 100 : 1e18);
        if (!columns.colour.empty())
            require_range("colour", i, columns.colour[i], 0, colours - 1);
    }
}

void Catalogue::append(const Columns &columns) {
    const auto add = [](std::vector<double> &to, std::span<const double> from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    add(x_, columns.x);
    add(y_, columns.y);
    add(bright_, columns.brightness);
    if (columns.colour.empty())
        colour_.resize(x_.size(), 0);
    else
        colour_.insert(colour_.end(), columns.colour.begin(), columns.colour.end());
}

void Catalogue::add_stars(const Columns &stars) {
    check(stars);
    append(stars);
    shape_.resize(x_.size(), PlacedSource::star);
}

void Catalogue::add_galaxies(const Columns &galaxies, std::span<const GalaxyShape> shapes) {
    check(galaxies);
    check_shapes(shapes);
    append(galaxies);
    for (const GalaxyShape &shape : shapes) {
        shape_.push_back(static_cast<int32_t>(shapes_.size()));
        shapes_.push_back(shape);
    }
}

std::vector<PlacedSource> Catalogue::placed(const Observation *observation, int sca,
                                            double zero_flux) const {
    std::vector<double> sky_x, sky_y;
    std::span<const double> x = x_, y = y_;
    if (positions_ == PositionKind::sky) {
        if (!observation)
            fail(WFPSF_ERROR_ARGUMENT, "observation = NULL: positions on the sky need one");
        sky_x.resize(size());
        sky_y.resize(size());
        observation->wcs(sca).to_pixel(static_cast<int64_t>(size()), x_.data(), y_.data(),
                                       sky_x.data(), sky_y.data());
        x = sky_x;
        y = sky_y;
    }
    const bool magnitudes = brightness_ == BrightnessKind::ab_magnitude;
    std::vector<PlacedSource> sources;
    sources.reserve(size());
    for (size_t i = 0; i < size(); ++i) {
        const double flux = magnitudes ? zero_flux * std::pow(10.0, -0.4 * bright_[i]) : bright_[i];
        if (std::isfinite(x[i]) && std::isfinite(y[i]))
            sources.push_back({x[i], y[i], flux, colour_[i], shape_[i], static_cast<int64_t>(i)});
    }
    return sources;
}

void Catalogue::add_to(Fingerprint &print) const {
    print.add(static_cast<int32_t>(positions_));
    print.add(static_cast<int32_t>(brightness_));
    for (size_t i = 0; i < size(); ++i) {
        for (const double value : {x_[i], y_[i], bright_[i]})
            print.add(value);
        print.add(colour_[i]);
        print.add(shape_[i]);
    }
    for (const GalaxyShape &s : shapes_)
        for (const double value : {s.sersic_index, s.half_light_radius_arcsec, s.e1, s.e2})
            print.add(value);
}

double ab_zero_rate(const Instrument &instrument, std::string_view band_name) {
    constexpr double planck = 6.62607015e-34, zero_flux = 3631e-26;          // J s; W/m^2/Hz
    const double area = 1e-4 * instrument.constant("collecting_area").value; // m^2
    const Band &band = instrument.band(band_name);
    // Photons: f_nu dnu / (h nu) = f_nu / h dlambda / lambda, throughput linear between samples.
    double integral = 0;
    for (size_t i = 0; i + 1 < band.throughput.size(); ++i) {
        const double a = band.wavelength_nm(i), b = band.wavelength_nm(i + 1);
        const double slope = (band.throughput[i + 1] - band.throughput[i]) / (b - a);
        integral += (band.throughput[i] - slope * a) * std::log(b / a) + slope * (b - a);
    }
    return area * zero_flux / planck * integral;
}

} // namespace wfpsf
