// SPDX-License-Identifier: GPL-3.0-or-later
#include "psf_parts.hpp"

#include <variant>

using namespace wfpsf;

wfpsf_status wfpsf_varying_psf_create(const wfpsf_instrument *instrument, const char *band,
                                      int32_t sca, double wavelength_nm, const wfpsf_sed *sed,
                                      const wfpsf_options *options, wfpsf_varying_psf **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        require_pointer(band, "band");
        const Instrument &i = instrument->instrument;
        const Light light = light_of(i.band(band), wavelength_nm, sed ? &sed->sed : nullptr);
        const PsfSettings settings = make_settings(i, is_mirrored(i, options), options);
        const auto [at, varies, region] = detector_optics(*instrument, band, sca, options);
        auto made = std::make_unique<wfpsf_varying_psf>(
            wfpsf_varying_psf{VaryingPsf(at, varies, light, settings, region, manners_of(options)),
                              light(0).mean_wavelength() * 1e9, i.pixel_scale_arcsec()});
        const double estimate = made->varying.error_estimate();
        *out = made.release();
        return certify(estimate, settings.eps);
    });
}

void wfpsf_varying_psf_destroy(wfpsf_varying_psf *varying) {
    delete varying;
}

wfpsf_status wfpsf_varying_psf_at(const wfpsf_varying_psf *varying, double x, double y,
                                  wfpsf_psf **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(varying, "varying");
        require_finite(x, "x");
        require_finite(y, "y");
        *out = new wfpsf_psf{varying->varying.at(x, y), varying->wavelength_nm,
                             varying->pixel_scale_arcsec};
    });
}

wfpsf_status wfpsf_varying_psf_add_stars(const wfpsf_varying_psf *varying, double x0, double y0,
                                         int64_t count, const double *x, const double *y,
                                         const double *flux, const wfpsf_options *options,
                                         wfpsf_image *image) {
    return guarded([&] {
        require_pointer(varying, "varying");
        require_pointer(image, "image");
        require_finite(x0, "x0");
        require_finite(y0, "y0");
        const std::vector<Star> stars = checked_stars(count, x, y, flux);
        Image &target = image->image;
        require_light(varying->varying.settings(), varying->pixel_scale_arcsec, target, options);
        const auto threads = static_cast<int>(option(options, WFPSF_OPTION_THREADS));
        std::visit(
            [&](auto pixels) {
                varying->varying.add(stars, x0, y0, target.oversampling(), pixels, threads);
            },
            target.pixels());
        record_light(varying->varying.settings(), varying->pixel_scale_arcsec, target);
    });
}

wfpsf_status wfpsf_varying_psf_get(const wfpsf_varying_psf *varying, int32_t key, double *value) {
    return guarded([&] {
        require_pointer(varying, "varying");
        require_pointer(value, "value");
        const VaryingPsf &v = varying->varying;
        switch (key) {
        case WFPSF_VARYING_PSF_ERROR_ESTIMATE:
            *value = v.error_estimate();
            return;
        case WFPSF_VARYING_PSF_INTERPOLATION_ERROR:
            *value = v.interpolation_error();
            return;
        case WFPSF_VARYING_PSF_DEGREE:
            *value = v.degree();
            return;
        case WFPSF_VARYING_PSF_RANK:
            *value = static_cast<double>(v.rank());
            return;
        case WFPSF_VARYING_PSF_EXACT_PSFS:
            *value = static_cast<double>(v.exact_psfs());
            return;
        case WFPSF_VARYING_PSF_MEMORY_BYTES:
            *value = static_cast<double>(v.memory());
            return;
        case WFPSF_VARYING_PSF_MARGIN:
            *value = Instrument::field_margin_pix;
            return;
        default:
            fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: a varying PSF has no property of that key",
                 key);
        }
    });
}
