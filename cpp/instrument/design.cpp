// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/design.hpp"

#include "error/error.hpp"
#include "instrument/field_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace wfpsf {

namespace {

constexpr double shortest_nm = 100, longest_nm = 1e5;

void check_range(const char *argument, double value, double smallest, double largest) {
    if (!std::isfinite(value))
        fail(WFPSF_ERROR_NOT_FINITE, "%s = %g: must be finite", argument, value);
    if (!(value >= smallest && value <= largest))
        fail(WFPSF_ERROR_RANGE, "%s = %.10g: must be %g..%g", argument, value, smallest, largest);
}

void check_range(const char *argument, std::span<const double> values, double smallest,
                 double largest) {
    for (size_t i = 0; i < values.size(); ++i)
        if (!(values[i] >= smallest && values[i] <= largest)) {
            std::string element(argument);
            element.append("[").append(std::to_string(i)).append("]");
            check_range(element.c_str(), values[i], smallest, largest);
        }
}

} // namespace

FieldPoint Design::Field::point(size_t i) const {
    const size_t count = coefficients.size() / x.size();
    return {x[i], y[i], std::span(coefficients).subspan(i * count, count)};
}

// The instrument and what its spans point to.
struct Design::Built {
    Design design;
    std::vector<Constant> constants;
    std::vector<Band> bands;
    std::vector<FieldPoint> field_points;
    Pupil pupil;
    Instrument instrument;
};

void Design::set_telescope(double diameter_m, double obscuration, double reference_wavelength_nm) {
    check_range("diameter_m", diameter_m, 0.01, 100);
    check_range("obscuration", obscuration, 0, 0.99);
    check_range("reference_wavelength_nm", reference_wavelength_nm, shortest_nm, longest_nm);
    diameter_m_ = diameter_m;
    obscuration_ = obscuration;
    reference_wavelength_nm_ = reference_wavelength_nm;
}

void Design::add_strut(double azimuth_deg, double width_m, double offset_m) {
    check_range("azimuth_deg", azimuth_deg, -360, 360);
    check_range("width_m", width_m, 0, 100);
    check_range("offset_m", offset_m, -100, 100);
    if (struts_.size() == largest_strut_count)
        fail(WFPSF_ERROR_SIZE, "struts: there are %zu, no more fit", struts_.size());
    const double azimuth = azimuth_deg * std::numbers::pi / 180;
    if (width_m > 0) // a Strut's normal points to smaller azimuths
        struts_.push_back({std::sin(azimuth), -std::cos(azimuth), -offset_m, width_m});
}

void Design::set_detector(int sca_count, double pixel_scale_arcsec, PixelCounts pixels) {
    check_range("sca_count", sca_count, 1, largest_sca_count);
    check_range("pixel_scale_arcsec", pixel_scale_arcsec, 1e-4, 10);
    check_range("n_pix_x", static_cast<double>(pixels.x), 1, 1e5);
    check_range("n_pix_y", static_cast<double>(pixels.y), 1, 1e5);
    sca_count_ = sca_count;
    pixel_scale_arcsec_ = pixel_scale_arcsec;
    pixels_ = pixels;
}

void Design::set_field(int sca, Field field) {
    check_range("sca", sca, 1, largest_sca_count);
    check_range("coefficients", field.coefficients, -1e6, 1e6);
    fields_.insert_or_assign(sca, std::move(field));
}

void Design::set_zernikes(int sca, std::span<const double> coefficients) {
    set_field(sca, {{0}, {0}, {coefficients.begin(), coefficients.end()}});
}

void Design::set_zernikes(int sca, std::span<const double, 5> x_pix,
                          std::span<const double, 5> y_pix, std::span<const double> coefficients) {
    check_range("x_pix", x_pix, -1e6, 1e6);
    check_range("y_pix", y_pix, -1e6, 1e6);
    std::array<FieldPoint, 5> points{};
    for (size_t i = 0; i < points.size(); ++i)
        points[i] = {x_pix[i], y_pix[i], {}};
    check_field_points(points);
    set_field(sca, {{x_pix.begin(), x_pix.end()},
                    {y_pix.begin(), y_pix.end()},
                    {coefficients.begin(), coefficients.end()}});
}

void Design::add_band(std::string_view name, double first_nm, double step_nm,
                      std::span<const double> throughput) {
    const std::string shown(name.substr(0, 64));
    if (name.empty() || name.size() > 63)
        fail(WFPSF_ERROR_ARGUMENT, "name = \"%s\": must have 1..63 bytes", shown.c_str());
    if (std::ranges::any_of(bands_, [name](const Curve &band) { return band.name == name; }))
        fail(WFPSF_ERROR_ARGUMENT, "name = \"%s\": there is a band of that name", shown.c_str());
    if (throughput.size() < 2 || throughput.size() > 1'000'000)
        fail(WFPSF_ERROR_SIZE, "count = %zu: must be 2..1000000", throughput.size());
    const auto steps = static_cast<double>(throughput.size() - 1);
    check_range("first_nm", first_nm, shortest_nm, longest_nm);
    check_range("step_nm", step_nm, 1e-6, (longest_nm - first_nm) / steps);
    check_range("throughput", throughput, 0, 1);
    // Of the zeros at either end, one stays.
    size_t first = 0, last = throughput.size() - 1;
    while (first < last && throughput[first] == 0 && throughput[first + 1] == 0)
        ++first;
    while (last > first && throughput[last] == 0 && throughput[last - 1] == 0)
        --last;
    if (first == last)
        fail(WFPSF_ERROR_ARGUMENT, "throughput: is zero everywhere");
    bands_.push_back({std::string(name),
                      first_nm + step_nm * static_cast<double>(first),
                      step_nm,
                      {throughput.begin() + static_cast<ptrdiff_t>(first),
                       throughput.begin() + static_cast<ptrdiff_t>(last) + 1}});
}

std::shared_ptr<const Instrument> Design::instrument() const {
    if (diameter_m_ == 0)
        fail(WFPSF_ERROR_ARGUMENT, "design: the telescope has not been set");
    if (sca_count_ == 0)
        fail(WFPSF_ERROR_ARGUMENT, "design: the detector has not been set");
    // Every SCA gets as many field points.
    const Field none{{0}, {0}, {}};
    const Field &model = fields_.empty() ? none : fields_.begin()->second;
    size_t most_zernikes = 0;
    for (const auto &[sca, field] : fields_) {
        if (sca > sca_count_)
            fail(WFPSF_ERROR_RANGE, "zernikes of sca = %d: there are %d", sca, sca_count_);
        if (field.x.size() != model.x.size())
            fail(WFPSF_ERROR_ARGUMENT,
                 "zernikes of sca = %d: at %zu field points, those of others at %zu", sca,
                 field.x.size(), model.x.size());
        most_zernikes = std::max(most_zernikes, field.coefficients.size() / field.x.size());
    }

    const auto built = std::make_shared<Built>();
    built->design = *this;
    const Design &own = built->design;
    const auto pixels_x = static_cast<double>(pixels_.x), pixels_y = static_cast<double>(pixels_.y);
    built->constants = {
        {"pixel_scale", pixel_scale_arcsec_, "arcsec/pixel", "pixel scale"},
        {"diameter", diameter_m_, "m", "primary mirror diameter"},
        {"obscuration", obscuration_, "1",
         "linear central obscuration as a fraction of the diameter"},
        {"n_sca", static_cast<double>(sca_count_), "1", "number of detectors (SCAs)"},
        {"n_pix", std::max(pixels_x, pixels_y), "pixel", "active detector side, the longer one"},
        {"n_pix_x", pixels_x, "pixel", "active detector side along x"},
        {"n_pix_y", pixels_y, "pixel", "active detector side along y"},
        {"zemax_wavelength", reference_wavelength_nm_, "nm",
         "wavelength at which the Zernike coefficients are given"},
        {"zernike_jmax", static_cast<double>(most_zernikes), "1",
         "highest Noll index j among the coefficients"},
    };
    for (const Curve &band : own.bands_)
        built->bands.push_back(
            {band.name.c_str(), band.first_nm, band.step_nm, band.throughput, 0});
    for (int sca = 1; sca <= sca_count_; ++sca) {
        const auto found = own.fields_.find(sca);
        for (size_t i = 0; i < model.x.size(); ++i)
            built->field_points.push_back(found == own.fields_.end()
                                              ? FieldPoint{model.x[i], model.y[i], {}}
                                              : found->second.point(i));
    }
    const double radius = diameter_m_ / 2;
    built->pupil = SpiderPupil{radius, radius * obscuration_, struts_};
    built->instrument = {.name = "design",
                         .constants = built->constants,
                         .bands = built->bands,
                         .all_field_points = built->field_points,
                         .pupils = {&built->pupil, 1},
                         .ipc_kernel = {},
                         .pixels = pixels_,
                         .wcs = {}};
    return {built, &built->instrument};
}

} // namespace wfpsf
