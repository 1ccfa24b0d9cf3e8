// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/exposure.hpp"

#include "scene_parts.hpp"

using namespace wfpsf;

namespace {

void check_sca(const wfpsf_exposure &exposure, int32_t sca) {
    if (sca < 1 || sca > exposure.sca_count)
        fail(WFPSF_ERROR_RANGE, "sca = %d: must be 1..%d", sca, exposure.sca_count);
}

// What makes the optics of any detector; it outlives the options.
std::function<SceneOptics(int)> optics_of_all(const wfpsf_instrument &instrument, const char *band,
                                              const Catalogue &catalogue,
                                              const wfpsf_options *options) {
    std::vector<SceneOptics> all;
    const Instrument &i = instrument.instrument;
    for (int sca = 1; sca <= i.sca_count(); ++sca) {
        all.push_back(scene_optics(instrument, band, sca, options));
        all.back().lights = lights_of(catalogue, i.band(band));
    }
    return [all = std::move(all)](int sca) { return all[static_cast<size_t>(sca - 1)]; };
}

} // namespace

wfpsf_status wfpsf_exposure_create(const wfpsf_instrument *instrument,
                                   const wfpsf_observation *observation, const char *band,
                                   const wfpsf_catalogue *catalogue, const wfpsf_chain *chain,
                                   const wfpsf_options *options, wfpsf_exposure **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        require_pointer(observation, "observation");
        require_pointer(band, "band");
        require_pointer(catalogue, "catalogue");
        const Instrument &i = instrument->instrument;
        const Observation &o = observation->observation;
        if (o.sca_count() != i.sca_count())
            fail(WFPSF_ERROR_ARGUMENT, "observation: is not of this instrument");
        const double number = option(options, WFPSF_OPTION_STREAM);
        if (number > Exposure::largest_number)
            fail(WFPSF_ERROR_RANGE, "STREAM = %.0f: an exposure's must be 0..%u", number,
                 Exposure::largest_number);
        const Catalogue &sources = catalogue->catalogue;
        ExposureSettings settings{.instrument = i.name,
                                  .band = band,
                                  .pixel_scale_arcsec = i.pixel_scale_arcsec(),
                                  .pixels = i.pixels,
                                  .exposure_time = exposure_time(i, options),
                                  .zero_flux = zero_flux_of(sources, i, band, options),
                                  .background = option(options, WFPSF_OPTION_SCENE_BACKGROUND),
                                  .budget = budget_of(i, options),
                                  .reuse = scene_reuse(options),
                                  .seed = static_cast<uint64_t>(option(options, WFPSF_OPTION_SEED)),
                                  .number = static_cast<uint32_t>(number),
                                  .with_noise = flag(options, WFPSF_OPTION_NOISE)};
        std::optional<Chain> effects;
        if (chain)
            effects = chain->chain;
        *out = new wfpsf_exposure{Exposure(o, sources, std::move(settings),
                                           optics_of_all(*instrument, band, sources, options),
                                           std::move(effects)),
                                  i.sca_count()};
    });
}

void wfpsf_exposure_destroy(wfpsf_exposure *exposure) {
    delete exposure;
}

wfpsf_status wfpsf_exposure_path(const wfpsf_exposure *exposure, const char *folder, int32_t sca,
                                 int64_t capacity, char *text, int64_t *length) {
    return guarded([&] {
        require_pointer(exposure, "exposure");
        require_pointer(folder, "folder");
        check_sca(*exposure, sca);
        copy_text(exposure->exposure.path(folder, sca), capacity, text, length);
    });
}

wfpsf_status wfpsf_exposure_make(const wfpsf_exposure *exposure, int32_t sca, const char *folder,
                                 const wfpsf_options *options, int32_t *made) {
    return guarded([&] {
        if (made)
            *made = 0;
        require_pointer(exposure, "exposure");
        require_pointer(folder, "folder");
        check_sca(*exposure, sca);
        const bool is_new = exposure->exposure.make(
            folder, sca, flag(options, WFPSF_OPTION_FITS_OVERWRITE),
            static_cast<int>(option(options, WFPSF_OPTION_THREADS)), manners_of(options));
        if (made)
            *made = is_new;
    });
}
