// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/instrument.hpp"

#include "error/error.hpp"
#include "instrument/field_interpolation.hpp"
#include "instrument/roman_c9/tables.hpp"
#include "instrument/wfirst_afta_c5/tables.hpp"

#include <cmath>
#include <string>

namespace wfpsf {
namespace {

template <class T>
const T &find_by_name(std::span<const T> items, std::string_view name, const char *argument) {
    for (const T &item : items)
        if (item.name == name)
            return item;
    std::string known;
    for (const T &item : items)
        known.append(known.empty() ? "" : ", ").append(item.name);
    const std::string shown(name.substr(0, 64)); // leaves room for the list
    fail(WFPSF_ERROR_UNKNOWN_NAME, "%s = \"%s\": must be one of %s", argument, shown.c_str(),
         known.c_str());
}

void check_sca(int sca, int count) {
    if (sca < 1 || sca > count)
        fail(WFPSF_ERROR_RANGE, "sca = %d: must be 1..%d", sca, count);
}

void check_position(const char *argument, double value, double last) {
    constexpr double margin = Instrument::field_margin_pix;
    if (!std::isfinite(value))
        fail(WFPSF_ERROR_NOT_FINITE, "%s = %g: must be finite", argument, value);
    if (!(value >= -margin && value <= last + margin))
        fail(WFPSF_ERROR_RANGE, "%s = %g: must be %g..%g, the detector and %g pixels around it",
             argument, value, -margin, last + margin, margin);
}

} // namespace

std::span<const Instrument> instruments() {
    static const Instrument all[] = {wfirst_afta_c5::instrument(), roman_c9::instrument()};
    return all;
}

const Instrument &Instrument::get(std::string_view instrument_name) {
    return find_by_name(instruments(), instrument_name, "instrument");
}

const Constant &Instrument::constant(std::string_view constant_name) const {
    return find_by_name(constants, constant_name, "constant");
}

const Band &Instrument::band(std::string_view band_name) const {
    return find_by_name(bands, band_name, "band");
}

int Instrument::sca_count() const {
    return static_cast<int>(constant("n_sca").value);
}

std::span<const FieldPoint> Instrument::field_points(int sca) const {
    check_sca(sca, sca_count());
    const size_t per_sca = all_field_points.size() / static_cast<size_t>(sca_count());
    return all_field_points.subspan(static_cast<size_t>(sca - 1) * per_sca, per_sca);
}

std::span<const double> Instrument::zernikes(int sca) const {
    return field_points(sca).front().zernikes;
}

std::vector<double> Instrument::zernikes(int sca, double x_pix, double y_pix,
                                         FieldRule rule) const {
    const std::span<const FieldPoint> points = field_points(sca);
    check_position("x_pix", x_pix, static_cast<double>(pixels.x - 1));
    check_position("y_pix", y_pix, static_cast<double>(pixels.y - 1));
    return interpolate_field(points, x_pix, y_pix, rule);
}

const Pupil &Instrument::pupil(int sca, std::string_view band_name) const {
    const int count = sca_count();
    check_sca(sca, count);
    const size_t mask = band(band_name).pupil_mask;
    if (pupils.size() == 1)
        return pupils.front();
    return pupils[mask * static_cast<size_t>(count) + static_cast<size_t>(sca - 1)];
}

AnnularPupil Instrument::annular_pupil() const {
    const double radius = diameter_m() / 2;
    return {radius, radius * obscuration()};
}

} // namespace wfpsf
