// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/overlap.hpp"
#include "optics/convolve.hpp"
#include "psf_parts.hpp"

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

// What all ways to make PSFs share, one for each light; the aperture is made only when the
// arguments are sound.
template <class MakeAperture>
wfpsf_status create(const Instrument &instrument, std::span<const double> aberrations,
                    std::span<const Light> lights, bool mirrored, const wfpsf_options *options,
                    MakeAperture make, wfpsf_psf **out) {
    const PsfSettings settings = make_settings(instrument, mirrored, options);
    const Wavefront wavefront = make_wavefront(instrument, aberrations, AddedAberrations(options));
    std::vector<Psf> psfs =
        make_psfs({make(), wavefront, settings.wavelength}, lights, settings, manners_of(options));
    std::vector<std::unique_ptr<wfpsf_psf>> handles;
    wfpsf_status status = WFPSF_OK;
    for (size_t i = 0; i < psfs.size(); ++i) {
        const double wavelength_nm = lights[i](0).mean_wavelength() * 1e9;
        if (const wfpsf_status certified = certify(psfs[i].error_estimate(), settings.eps);
            certified != WFPSF_OK)
            status = certified;
        handles.push_back(std::make_unique<wfpsf_psf>(
            wfpsf_psf{std::move(psfs[i]), wavelength_nm, instrument.pixel_scale_arcsec()}));
    }
    for (size_t i = 0; i < handles.size(); ++i)
        out[i] = handles[i].release();
    return status;
}

// PSFs anywhere on a detector through the pupil of a band.
wfpsf_status create_in_band(const Instrument &instrument, const char *band, int32_t sca, double x,
                            double y, std::span<const Light> lights, const wfpsf_options *options,
                            wfpsf_psf **out) {
    return create(
        instrument, instrument.zernikes(sca, x, y, field_rule(options)), lights,
        is_mirrored(instrument, options), options,
        [&] { return make_aperture_of(instrument, sca, band, options); }, out);
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
        const Light light = one_colour_in(filter, wavelength_nm);
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

namespace {

Star checked_star(double x, double y, double flux) {
    require_finite(x, "x");
    require_finite(y, "y");
    require_finite(flux, "flux");
    return {x, y, flux};
}

wfpsf_status draw(const wfpsf_psf &psf, const Star &star, Psf::Drawing drawing,
                  const wfpsf_options *options, Image &image) {
    const double error = std::visit(
        [&](auto pixels) {
            return psf.psf.draw(star, image.oversampling(), pixels, drawing, manners_of(options));
        },
        image.pixels());
    return certify(error, psf.psf.settings().eps);
}

} // namespace

wfpsf_status wfpsf_psf_draw(const wfpsf_psf *psf, double x, double y, double flux,
                            const wfpsf_options *options, wfpsf_image *image) {
    return guarded([&] {
        require_pointer(psf, "psf");
        require_pointer(image, "image");
        const wfpsf_status status =
            draw(*psf, checked_star(x, y, flux), Psf::Drawing::overwrites, options, image->image);
        image->image.set_applied(0);
        record_light(psf->psf.settings(), psf->pixel_scale_arcsec, image->image);
        return status;
    });
}

wfpsf_status wfpsf_psf_add_bright_star(const wfpsf_psf *psf, double x, double y, double flux,
                                       const wfpsf_options *options, wfpsf_image *image) {
    return guarded([&] {
        require_pointer(psf, "psf");
        require_pointer(image, "image");
        require_light(psf->psf.settings(), psf->pixel_scale_arcsec, image->image, options);
        const wfpsf_status status =
            draw(*psf, checked_star(x, y, flux), Psf::Drawing::adds, options, image->image);
        record_light(psf->psf.settings(), psf->pixel_scale_arcsec, image->image);
        return status;
    });
}

wfpsf_status wfpsf_psf_draw_memory(const wfpsf_psf *psf, double x, double y,
                                   const wfpsf_image *image, int64_t *least, int64_t *most) {
    return guarded([&] {
        require_pointer(psf, "psf");
        require_pointer(image, "image");
        const Star star = checked_star(x, y, 1);
        const Image &target = image->image;
        const auto [smallest, largest] =
            psf->psf.draw_memory(star, target.oversampling(), target.nx(), target.ny());
        if (least)
            *least = smallest;
        if (most)
            *most = largest;
    });
}

wfpsf_status wfpsf_psf_add_stars(const wfpsf_psf *psf, int64_t count, const double *x,
                                 const double *y, const double *flux, const wfpsf_options *options,
                                 wfpsf_image *image) {
    return guarded([&] {
        require_pointer(psf, "psf");
        require_pointer(image, "image");
        const std::vector<Star> stars = checked_stars(count, x, y, flux);
        Image &target = image->image;
        require_light(psf->psf.settings(), psf->pixel_scale_arcsec, target, options);
        const auto threads = static_cast<int>(option(options, WFPSF_OPTION_THREADS));
        std::visit(
            [&](auto pixels) { psf->psf.add(stars, target.oversampling(), pixels, threads); },
            target.pixels());
        record_light(psf->psf.settings(), psf->pixel_scale_arcsec, target);
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
        require_scale(psf->pixel_scale_arcsec, galaxy->image, "galaxy");
        Image &target = image->image;
        std::visit(
            [&]<class S, class T>(View<const S> samples, View<T> pixels) {
                if (shares_memory(samples, pixels))
                    fail(WFPSF_ERROR_OVERLAP, "image: shares memory with galaxy");
                convolve(psf->psf, Source<S>{samples, galaxy->image.oversampling(), x, y, flux},
                         target.oversampling(), pixels);
            },
            galaxy->image.pixels(), target.pixels());
        target.set_applied(0);
        record_light(psf->psf.settings(), psf->pixel_scale_arcsec, target);
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
