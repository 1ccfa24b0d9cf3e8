// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"
#include "handles.hpp"
#include "image/overlap.hpp"
#include "optics/convolve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <variant>

using namespace wfpsf;

// band: NULL for an instrument that has one pupil for all.
std::unique_ptr<const Aperture> wfpsf::make_aperture_of(const Instrument &instrument, int32_t sca,
                                                        const char *band,
                                                        const wfpsf_options *options) {
    if (!flag(options, WFPSF_OPTION_STRUTS))
        return make_aperture(instrument.annular_pupil());
    return std::visit([](const auto &pupil) { return make_aperture(pupil); },
                      band ? instrument.pupil(sca, band) : instrument.pupils.front());
}

namespace {

constexpr int largest_sed_count = 1000;
constexpr double arcsec = std::numbers::pi / 180 / 3600;

// The instrument's own aberrations and the caller's, in waves at the reference wavelength.
Wavefront make_wavefront(const Instrument &instrument, std::span<const double> own,
                         const wfpsf_options *options) {
    const std::vector<double> &extra = extra_zernikes(options);
    std::vector<double> coefficients(std::max(own.size(), extra.size()));
    std::copy(own.begin(), own.end(), coefficients.begin());
    if (!flag(options, WFPSF_OPTION_PISTON_TILT))
        std::fill_n(coefficients.begin(), std::min<size_t>(3, coefficients.size()), 0.0);
    for (size_t i = 0; i < extra.size(); ++i)
        coefficients[i] += extra[i];
    Wavefront wavefront(coefficients, instrument.diameter_m() / 2);
    if (auto map = opd_map(options))
        wavefront.add(std::move(map), instrument.reference_wavelength_nm() * 1e-9);
    return wavefront;
}

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

PsfSettings make_settings(const Instrument &instrument, bool mirrored,
                          const wfpsf_options *options) {
    return {.wavelength = instrument.reference_wavelength_nm() * 1e-9,
            .pixel_scale = instrument.pixel_scale_arcsec() * arcsec,
            .eps = option(options, WFPSF_OPTION_EPS),
            .radius = option(options, WFPSF_OPTION_PSF_RADIUS),
            .mirrored = mirrored,
            .blur = make_blur(instrument, options)};
}

// OK, or the warning that the error estimate does not meet EPS.
wfpsf_status certify(const Psf &psf) {
    if (psf.error_estimate() <= psf.settings().eps)
        return WFPSF_OK;
    char line[128];
    std::snprintf(line, sizeof line, "EPS = %g: the error estimate is %g", psf.settings().eps,
                  psf.error_estimate());
    return record_error(WFPSF_WARNING_NOT_CERTIFIED, line);
}

// What all ways to make PSFs share, one for each light; the aperture is made only when the
// arguments are sound.
template <class MakeAperture>
wfpsf_status create(const Instrument &instrument, std::span<const double> aberrations,
                    std::span<const Light> lights, bool mirrored, const wfpsf_options *options,
                    MakeAperture make, wfpsf_psf **out) {
    const PsfSettings settings = make_settings(instrument, mirrored, options);
    const Wavefront wavefront = make_wavefront(instrument, aberrations, options);
    std::vector<Psf> psfs =
        make_psfs({make(), wavefront, settings.wavelength}, lights, settings, progress_of(options));
    std::vector<std::unique_ptr<wfpsf_psf>> handles;
    wfpsf_status status = WFPSF_OK;
    for (size_t i = 0; i < psfs.size(); ++i) {
        const double wavelength_nm = lights[i](0).mean_wavelength() * 1e9;
        if (const wfpsf_status certified = certify(psfs[i]); certified != WFPSF_OK)
            status = certified;
        handles.push_back(std::make_unique<wfpsf_psf>(
            wfpsf_psf{std::move(psfs[i]), wavelength_nm, instrument.pixel_scale_arcsec()}));
    }
    for (size_t i = 0; i < handles.size(); ++i)
        out[i] = handles[i].release();
    return status;
}

Light one_colour(double wavelength_nm) {
    require_finite(wavelength_nm, "wavelength_nm");
    if (!(wavelength_nm >= 100 && wavelength_nm <= 1e5))
        fail(WFPSF_ERROR_RANGE, "wavelength_nm = %g: must be 100..100000", wavelength_nm);
    return monochromatic(wavelength_nm * 1e-9);
}

// PSFs anywhere on a detector through the pupil of a band.
wfpsf_status create_in_band(const Instrument &instrument, const char *band, int32_t sca, double x,
                            double y, std::span<const Light> lights, const wfpsf_options *options,
                            wfpsf_psf **out) {
    const FieldRule rule =
        flag(options, WFPSF_OPTION_FIELD_RULE) ? FieldRule::corners : FieldRule::five_points;
    const bool mirrored =
        instrument.pupils.size() > 1 && !flag(options, WFPSF_OPTION_FRAME); // C5: one frame
    return create(
        instrument, instrument.zernikes(sca, x, y, rule), lights, mirrored, options,
        [&] { return make_aperture_of(instrument, sca, band, options); }, out);
}

// An image that states another pixel scale than the PSF's is refused.
void require_scale(const wfpsf_psf &psf, const Image &image, const char *argument) {
    const double scale = image.pixel_scale_arcsec();
    if (scale != 0 && std::abs(scale / psf.pixel_scale_arcsec - 1) > 1e-9)
        fail(WFPSF_ERROR_ARGUMENT, "%s: has pixels of %.10g arcsec, the PSF of %.10g", argument,
             scale, psf.pixel_scale_arcsec);
}

} // namespace

wfpsf_status wfpsf_psf_create(const wfpsf_instrument *instrument, int32_t sca, double wavelength_nm,
                              const wfpsf_options *options, wfpsf_psf **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        const Instrument &i = instrument->instrument;
        if (i.pupils.size() > 1)
            fail(WFPSF_ERROR_ARGUMENT,
                 "instrument: the pupil of %s depends on the band; use "
                 "wfpsf_psf_create_in_band()",
                 i.name);
        const Light light = one_colour(wavelength_nm);
        return create(
            i, i.zernikes(sca), {&light, 1}, false, options,
            [&] { return make_aperture_of(i, sca, nullptr, options); }, out);
    });
}

wfpsf_status wfpsf_psf_create_in_band(const wfpsf_instrument *instrument, const char *band,
                                      int32_t sca, double x, double y, double wavelength_nm,
                                      const wfpsf_options *options, wfpsf_psf **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        require_pointer(band, "band");
        require_finite(x, "x");
        require_finite(y, "y");
        const Instrument &i = instrument->instrument;
        const Band &filter = i.band(band);
        const Light light = one_colour(
            wavelength_nm == 0 ? tabulated_wavelengths(filter).effective_nm : wavelength_nm);
        return create_in_band(i, band, sca, x, y, {&light, 1}, options, out);
    });
}

wfpsf_status wfpsf_psf_create_chromatic(const wfpsf_instrument *instrument, const char *band,
                                        int32_t sca, double x, double y, int64_t count,
                                        const wfpsf_sed *const *seds, const wfpsf_options *options,
                                        wfpsf_psf **out) {
    return guarded([&] {
        require_pointer(out, "out");
        if (!(count >= 1 && count <= largest_sed_count))
            fail(WFPSF_ERROR_SIZE, "count = %lld: must be 1..%d", static_cast<long long>(count),
                 largest_sed_count);
        std::fill_n(out, count, nullptr);
        require_pointer(instrument, "instrument");
        require_pointer(band, "band");
        require_finite(x, "x");
        require_finite(y, "y");
        require_pointer(seds, "seds");
        const Instrument &i = instrument->instrument;
        const Band &filter = i.band(band);
        std::vector<Light> lights;
        for (int64_t s = 0; s < count; ++s) {
            require_pointer(seds[s], "seds[i]");
            lights.push_back(detected_light(filter, seds[s]->sed));
        }
        return create_in_band(i, band, sca, x, y, lights, options, out);
    });
}

wfpsf_status wfpsf_psf_create_from_mask(const wfpsf_instrument *instrument, const wfpsf_image *mask,
                                        double mask_scale_m, double axis_x, double axis_y,
                                        int32_t sca, double wavelength_nm,
                                        const wfpsf_options *options, wfpsf_psf **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        require_pointer(mask, "mask");
        check_pupil_sampling("mask_scale_m", mask_scale_m, axis_x, axis_y);
        const Instrument &i = instrument->instrument;
        const Light light = one_colour(wavelength_nm);
        const auto aperture = [&] {
            const Plane<double> copy = copy_of(*mask);
            return make_aperture(copy.view(), mask_scale_m, axis_x, axis_y,
                                 flag(options, WFPSF_OPTION_MASK_POINTS) ? MaskPixels::points
                                                                         : MaskPixels::squares);
        };
        return create(i, i.zernikes(sca), {&light, 1}, false, options, aperture, out);
    });
}

void wfpsf_psf_destroy(wfpsf_psf *psf) {
    delete psf;
}

wfpsf_status wfpsf_psf_draw(const wfpsf_psf *psf, double x, double y, double flux,
                            wfpsf_image *image) {
    return guarded([&] {
        require_pointer(psf, "psf");
        require_pointer(image, "image");
        require_finite(x, "x");
        require_finite(y, "y");
        require_finite(flux, "flux");
        std::visit(
            [&](auto pixels) { psf->psf.draw(x, y, flux, image->image.oversampling(), pixels); },
            image->image.pixels());
        image->image.set_pixel_scale_arcsec(psf->pixel_scale_arcsec);
        image->image.set_applied(0);
        image->image.record_applied(Effect::pixel_response);
    });
}

wfpsf_status wfpsf_psf_add_stars(const wfpsf_psf *psf, int64_t count, const double *x,
                                 const double *y, const double *flux, const wfpsf_options *options,
                                 wfpsf_image *image) {
    return guarded([&] {
        require_pointer(psf, "psf");
        require_pointer(image, "image");
        if (count < 0)
            fail(WFPSF_ERROR_SIZE, "count = %lld: must be >= 0", static_cast<long long>(count));
        if (count > 0) {
            require_pointer(x, "x");
            require_pointer(y, "y");
            require_pointer(flux, "flux");
        }
        Image &target = image->image;
        for (const Effect later : {Effect::ipc, Effect::ipc_correction})
            target.require_not_applied(later, flag(options, WFPSF_OPTION_FORCE));
        require_scale(*psf, target, "image");
        std::vector<Star> stars;
        for (int64_t i = 0; i < count; ++i) {
            for (const auto &[name, value] :
                 {std::pair("x", x[i]), std::pair("y", y[i]), std::pair("flux", flux[i])})
                if (!std::isfinite(value))
                    fail(WFPSF_ERROR_NOT_FINITE, "%s[%lld] = %g: must be finite", name,
                         static_cast<long long>(i), value);
            stars.push_back({x[i], y[i], flux[i]});
        }
        const auto threads = static_cast<int>(option(options, WFPSF_OPTION_THREADS));
        std::visit(
            [&](auto pixels) { psf->psf.add(stars, target.oversampling(), pixels, threads); },
            target.pixels());
        target.set_pixel_scale_arcsec(psf->pixel_scale_arcsec);
        target.record_applied(Effect::pixel_response);
    });
}

wfpsf_status wfpsf_psf_convolve(const wfpsf_psf *psf, const wfpsf_image *galaxy, double x, double y,
                                double flux, const wfpsf_options *options, wfpsf_image *image) {
    return guarded([&] {
        require_pointer(psf, "psf");
        require_pointer(galaxy, "galaxy");
        require_pointer(image, "image");
        require_finite(x, "x");
        require_finite(y, "y");
        require_finite(flux, "flux");
        for (const Effect effect : {Effect::pixel_response, Effect::ipc, Effect::ipc_correction})
            galaxy->image.require_not_applied(effect, flag(options, WFPSF_OPTION_FORCE));
        require_scale(*psf, galaxy->image, "galaxy");
        Image &target = image->image;
        std::visit(
            [&]<class S, class T>(View<const S> samples, View<T> pixels) {
                if (shares_memory(samples, pixels))
                    fail(WFPSF_ERROR_OVERLAP, "image: shares memory with galaxy");
                convolve(psf->psf, Source<S>{samples, galaxy->image.oversampling(), x, y, flux},
                         target.oversampling(), pixels);
            },
            galaxy->image.pixels(), target.pixels());
        target.set_pixel_scale_arcsec(psf->pixel_scale_arcsec);
        target.set_applied(0);
        target.record_applied(Effect::pixel_response);
    });
}

wfpsf_status wfpsf_psf_get(const wfpsf_psf *psf, int32_t key, double *value) {
    return guarded([&] {
        require_pointer(psf, "psf");
        require_pointer(value, "value");
        const Psf &p = psf->psf;
        switch (key) {
        case WFPSF_PSF_WAVELENGTH_NM:
            *value = psf->wavelength_nm;
            return;
        case WFPSF_PSF_PIXEL_SCALE_ARCSEC:
            *value = psf->pixel_scale_arcsec;
            return;
        case WFPSF_PSF_ERROR_ESTIMATE:
            *value = p.error_estimate();
            return;
        case WFPSF_PSF_MODEL_ERROR:
            *value = p.model_error();
            return;
        case WFPSF_PSF_PEAK:
            *value = p.peak();
            return;
        case WFPSF_PSF_NODES:
            *value = static_cast<double>(p.nodes());
            return;
        case WFPSF_PSF_GRID_SIZE:
            *value = static_cast<double>(p.grid_size());
            return;
        case WFPSF_PSF_GRID_STEP_ARCSEC:
            *value = p.grid_step() / arcsec;
            return;
        case WFPSF_PSF_RADIUS:
            *value = p.settings().radius;
            return;
        case WFPSF_PSF_WAVELENGTHS:
            *value = static_cast<double>(p.components().size());
            return;
        case WFPSF_PSF_LIT_AREA_M2:
            *value = p.lit_area();
            return;
        default:
            fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: a PSF has no property of that key", key);
        }
    });
}
