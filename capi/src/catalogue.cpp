// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/catalogue.hpp"

#include "funnel.hpp"
#include "handles.hpp"
#include "psf_parts.hpp"

using namespace wfpsf;

namespace {

Catalogue::Columns columns_of(int64_t count, const double *x, const double *y,
                              const double *brightness, const int32_t *colour) {
    return {array_of(count, x, "count", "x"), array_of(count, y, "count", "y"),
            array_of(count, brightness, "count", "brightness"),
            colour ? std::span(colour, static_cast<size_t>(count)) : std::span<const int32_t>{}};
}

} // namespace

wfpsf_status wfpsf_catalogue_create(int32_t positions, int32_t brightness, wfpsf_catalogue **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        if (positions != WFPSF_POSITIONS_DETECTOR && positions != WFPSF_POSITIONS_SKY)
            fail(WFPSF_ERROR_ARGUMENT, "positions = %d: must be a WFPSF_POSITIONS_*", positions);
        if (brightness != WFPSF_BRIGHTNESS_ELECTRONS && brightness != WFPSF_BRIGHTNESS_AB_MAGNITUDE)
            fail(WFPSF_ERROR_ARGUMENT, "brightness = %d: must be a WFPSF_BRIGHTNESS_*", brightness);
        *out = new wfpsf_catalogue{Catalogue(static_cast<PositionKind>(positions),
                                             static_cast<BrightnessKind>(brightness))};
    });
}

void wfpsf_catalogue_destroy(wfpsf_catalogue *catalogue) {
    delete catalogue;
}

wfpsf_status wfpsf_catalogue_add_colour(wfpsf_catalogue *catalogue, double wavelength_nm,
                                        const wfpsf_sed *sed, int32_t *colour) {
    return guarded([&] {
        require_pointer(catalogue, "catalogue");
        if (sed && wavelength_nm != 0)
            fail(WFPSF_ERROR_ARGUMENT, "wavelength_nm = %g: must be 0 with an SED", wavelength_nm);
        if (wavelength_nm != 0)
            one_colour(wavelength_nm);
        SourceColour added{.wavelength_nm = wavelength_nm};
        if (sed)
            added.sed = sed->sed;
        const int32_t number = catalogue->catalogue.add_colour(std::move(added));
        if (colour)
            *colour = number;
    });
}

wfpsf_status wfpsf_catalogue_add_stars(wfpsf_catalogue *catalogue, int64_t count, const double *x,
                                       const double *y, const double *brightness,
                                       const int32_t *colour) {
    return guarded([&] {
        require_pointer(catalogue, "catalogue");
        catalogue->catalogue.add_stars(columns_of(count, x, y, brightness, colour));
    });
}

wfpsf_status wfpsf_catalogue_add_galaxies(wfpsf_catalogue *catalogue, int64_t count,
                                          const double *x, const double *y,
                                          const double *brightness, const int32_t *colour,
                                          const double *sersic_index,
                                          const double *half_light_radius_arcsec, const double *e1,
                                          const double *e2) {
    return guarded([&] {
        require_pointer(catalogue, "catalogue");
        const Catalogue::Columns columns = columns_of(count, x, y, brightness, colour);
        array_of(count, sersic_index, "count", "sersic_index");
        array_of(count, half_light_radius_arcsec, "count", "half_light_radius_arcsec");
        std::vector<GalaxyShape> shapes;
        for (int64_t i = 0; i < count; ++i)
            shapes.push_back(
                {sersic_index[i], half_light_radius_arcsec[i], e1 ? e1[i] : 0, e2 ? e2[i] : 0});
        catalogue->catalogue.add_galaxies(columns, shapes);
    });
}

wfpsf_status wfpsf_catalogue_size(const wfpsf_catalogue *catalogue, int64_t *count) {
    return guarded([&] {
        require_pointer(catalogue, "catalogue");
        require_pointer(count, "count");
        *count = static_cast<int64_t>(catalogue->catalogue.size());
    });
}

wfpsf_status wfpsf_instrument_ab_zero_rate(const wfpsf_instrument *instrument, const char *band,
                                           double *rate) {
    return guarded([&] {
        require_pointer(instrument, "instrument");
        require_pointer(band, "band");
        require_pointer(rate, "rate");
        *rate = ab_zero_rate(instrument->instrument, band);
    });
}
