// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_parts.hpp"

#include <cmath>

namespace wfpsf {

double exposure_time(const Instrument &instrument, const wfpsf_options *options) {
    const double given = option(options, WFPSF_OPTION_EXPOSURE_TIME);
    return std::isnan(given) ? instrument.constant("exptime").value : given;
}

SceneBudget budget_of(const Instrument &instrument, const wfpsf_options *options) {
    SceneBudget budget{.noise = option(options, WFPSF_OPTION_SCENE_NOISE),
                       .variance = option(options, WFPSF_OPTION_SCENE_VARIANCE),
                       .flux = option(options, WFPSF_OPTION_SCENE_FLUX)};
    if (std::isnan(budget.variance)) {
        const double read_noise = instrument.constant("read_noise").value;
        budget.variance =
            read_noise * read_noise +
            instrument.constant("dark_current").value * exposure_time(instrument, options) +
            option(options, WFPSF_OPTION_SCENE_BACKGROUND);
    }
    return budget;
}

std::vector<Light> lights_of(const Catalogue &catalogue, const Band &band) {
    std::vector<Light> lights;
    for (const SourceColour &colour : catalogue.colours())
        lights.push_back(light_of(band, colour.wavelength_nm, colour.sed ? &*colour.sed : nullptr));
    if (lights.empty())
        lights.push_back(one_colour_in(band, 0));
    return lights;
}

SceneOptics scene_optics(const wfpsf_instrument &instrument, const char *band, int32_t sca,
                         const wfpsf_options *options) {
    if (!flag(options, WFPSF_OPTION_PIXEL_RESPONSE))
        fail(WFPSF_ERROR_ARGUMENT, "PIXEL_RESPONSE = 0: scenes are averaged over pixels");
    const Instrument &i = instrument.instrument;
    const auto [at, varies, region] = detector_optics(instrument, band, sca, options);
    return {at,
            varies,
            region,
            make_settings(i, is_mirrored(i, options), options),
            i.pixel_scale_arcsec(),
            {}};
}

double zero_flux_of(const Catalogue &catalogue, const Instrument &instrument, const char *band,
                    const wfpsf_options *options) {
    if (catalogue.brightness() != BrightnessKind::ab_magnitude)
        return 1;
    return ab_zero_rate(instrument, band) * exposure_time(instrument, options);
}

} // namespace wfpsf
