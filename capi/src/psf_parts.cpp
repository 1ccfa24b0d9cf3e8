// SPDX-License-Identifier: GPL-3.0-or-later
#include "psf_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace wfpsf {

AddedAberrations::AddedAberrations(const wfpsf_options *options)
    : zernikes(extra_zernikes(options)), map(opd_map(options)),
      keeps_piston_tilt(flag(options, WFPSF_OPTION_PISTON_TILT)) {}

Wavefront make_wavefront(const Instrument &instrument, std::span<const double> own,
                         const AddedAberrations &added) {
    std::vector<double> coefficients(std::max(own.size(), added.zernikes.size()));
    std::copy(own.begin(), own.end(), coefficients.begin());
    if (!added.keeps_piston_tilt)
        std::fill_n(coefficients.begin(), std::min<size_t>(3, coefficients.size()), 0.0);
    for (size_t i = 0; i < added.zernikes.size(); ++i)
        coefficients[i] += added.zernikes[i];
    Wavefront wavefront(coefficients, instrument.diameter_m() / 2);
    if (added.map)
        wavefront.add(added.map, instrument.reference_wavelength_nm() * 1e-9);
    return wavefront;
}

namespace {

// Jitter and charge diffusion, native pixels^2.
Covariance make_blur(const Instrument &instrument, const wfpsf_options *options) {
    constexpr double largest = 16; // native pixels
    const double scale = instrument.pixel_scale_arcsec();
    const double xx = option(options, WFPSF_OPTION_JITTER_XX) / (scale * scale);
    const double xy = option(options, WFPSF_OPTION_JITTER_XY) / (scale * scale);
    const double yy = option(options, WFPSF_OPTION_JITTER_YY) / (scale * scale);
    if (!(xy * xy <= xx * yy * (1 + 1e-12)))
        fail(WFPSF_ERROR_RANGE,
             "JITTER_XY = %g: its square must not exceed JITTER_XX * JITTER_YY = %g",
             option(options, WFPSF_OPTION_JITTER_XY),
             option(options, WFPSF_OPTION_JITTER_XX) * option(options, WFPSF_OPTION_JITTER_YY));
    const double diffusion = option(options, WFPSF_OPTION_CHARGE_DIFFUSION);
    const Covariance blur{xx + diffusion * diffusion, xy, yy + diffusion * diffusion};
    if (!(std::max(blur.xx, blur.yy) <= largest * largest))
        fail(WFPSF_ERROR_RANGE,
             "JITTER and CHARGE_DIFFUSION: %g native pixels rms along an axis, must be up to %g",
             std::sqrt(std::max(blur.xx, blur.yy)), largest);
    return blur;
}

} // namespace

PsfSettings make_settings(const Instrument &instrument, bool mirrored,
                          const wfpsf_options *options) {
    constexpr double arcsec = std::numbers::pi / 180 / 3600;
    return {.wavelength = instrument.reference_wavelength_nm() * 1e-9,
            .pixel_scale = instrument.pixel_scale_arcsec() * arcsec,
            .eps = option(options, WFPSF_OPTION_EPS),
            .radius = option(options, WFPSF_OPTION_PSF_RADIUS),
            .mirrored = mirrored,
            .blur = make_blur(instrument, options),
            .pixel_response = flag(options, WFPSF_OPTION_PIXEL_RESPONSE)};
}

FieldRule field_rule(const wfpsf_options *options) {
    return flag(options, WFPSF_OPTION_FIELD_RULE) ? FieldRule::corners : FieldRule::five_points;
}

bool is_mirrored(const Instrument &instrument, const wfpsf_options *options) {
    return instrument.pupils.size() > 1 && !flag(options, WFPSF_OPTION_FRAME);
}

Light one_colour(double wavelength_nm) {
    require_finite(wavelength_nm, "wavelength_nm");
    if (!(wavelength_nm >= 100 && wavelength_nm <= 1e5))
        fail(WFPSF_ERROR_RANGE, "wavelength_nm = %g: must be 100..100000", wavelength_nm);
    return monochromatic(wavelength_nm * 1e-9);
}

Light one_colour_in(const Band &band, double wavelength_nm) {
    return one_colour(wavelength_nm == 0 ? tabulated_wavelengths(band).effective_nm
                                         : wavelength_nm);
}

Light light_of(const Band &band, double wavelength_nm, const Sed *sed) {
    if (!sed)
        return one_colour_in(band, wavelength_nm);
    if (wavelength_nm != 0)
        fail(WFPSF_ERROR_ARGUMENT, "wavelength_nm = %g: must be 0 with an SED", wavelength_nm);
    return detected_light(band, *sed);
}

DetectorOptics detector_optics(const wfpsf_instrument &instrument, const char *band, int32_t sca,
                               const wfpsf_options *options) {
    constexpr double margin = Instrument::field_margin_pix;
    const Instrument &i = instrument.instrument;
    const bool varies = i.field_points(sca).size() > 1;
    const std::shared_ptr<const Aperture> aperture = make_aperture_of(i, sca, band, options);
    const auto at = [owner = instrument, aperture, sca, rule = field_rule(options),
                     added = AddedAberrations(options),
                     wavelength = i.reference_wavelength_nm() * 1e-9](double x, double y) {
        const Instrument &its = owner.instrument;
        return Optics{aperture, make_wavefront(its, its.zernikes(sca, x, y, rule), added),
                      wavelength};
    };
    return {at,
            varies,
            {-margin, -margin, static_cast<double>(i.pixels.x - 1) + margin,
             static_cast<double>(i.pixels.y - 1) + margin}};
}

wfpsf_status certify(double estimate, double eps) {
    if (estimate <= eps)
        return WFPSF_OK;
    char line[128];
    std::snprintf(line, sizeof line, "EPS = %g: the error estimate is %g", eps, estimate);
    return record_error(WFPSF_WARNING_NOT_CERTIFIED, line);
}

void require_light(const PsfSettings &settings, double pixel_scale_arcsec, const Image &image,
                   const wfpsf_options *options) {
    for (uint32_t bit = 1; bit <= all_effects; bit <<= 1) {
        const auto effect = static_cast<Effect>(bit);
        const bool of_light = effect == Effect::background ||
                              (effect == Effect::pixel_response && settings.pixel_response);
        if (!of_light)
            image.require_not_applied(effect, flag(options, WFPSF_OPTION_FORCE));
    }
    require_scale(pixel_scale_arcsec, image, "image");
}

void record_light(const PsfSettings &settings, double pixel_scale_arcsec, Image &image) {
    image.set_pixel_scale_arcsec(pixel_scale_arcsec);
    if (settings.pixel_response)
        image.record_applied(Effect::pixel_response);
}

void require_scale(double pixel_scale_arcsec, const Image &image, const char *argument) {
    const double scale = image.pixel_scale_arcsec();
    if (scale != 0 && std::abs(scale / pixel_scale_arcsec - 1) > 1e-9)
        fail(WFPSF_ERROR_ARGUMENT, "%s: has pixels of %.10g arcsec, the PSF of %.10g", argument,
             scale, pixel_scale_arcsec);
}

std::vector<Star> checked_stars(int64_t count, const double *x, const double *y,
                                const double *flux) {
    array_of(count, x, "count", "x");
    array_of(count, y, "count", "y");
    array_of(count, flux, "count", "flux");
    std::vector<Star> stars;
    for (int64_t i = 0; i < count; ++i) {
        for (const auto &[name, value] :
             {std::pair("x", x[i]), std::pair("y", y[i]), std::pair("flux", flux[i])})
            if (!std::isfinite(value))
                fail(WFPSF_ERROR_NOT_FINITE, "%s[%lld] = %g: must be finite", name,
                     static_cast<long long>(i), value);
        stars.push_back({x[i], y[i], flux[i]});
    }
    return stars;
}

} // namespace wfpsf
