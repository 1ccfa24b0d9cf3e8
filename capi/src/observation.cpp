// SPDX-License-Identifier: GPL-3.0-or-later
#include "observation/observation.hpp"

#include "funnel.hpp"
#include "handles.hpp"
#include "observation/sun.hpp"

#include <algorithm>

using namespace wfpsf;

namespace {

ObservationOptions options_of(const wfpsf_options *options) {
    return {.as_galsim = flag(options, WFPSF_OPTION_WCS_RULE),
            .angle_is_of_fpa = flag(options, WFPSF_OPTION_PA_OF_FPA)};
}

SunRule sun_rule(const wfpsf_options *options) {
    return flag(options, WFPSF_OPTION_WCS_RULE) ? SunRule::galsim : SunRule::precise;
}

bool checked_gaps(int32_t with_gaps) {
    if (with_gaps != 0 && with_gaps != 1)
        fail(WFPSF_ERROR_ARGUMENT, "with_gaps = %d: must be 0 or 1", with_gaps);
    return with_gaps == 1;
}

SkyPosition checked_position(double ra_deg, double dec_deg) {
    require_finite(ra_deg, "ra_deg");
    require_finite(dec_deg, "dec_deg");
    if (!(std::abs(ra_deg) <= 1e6))
        fail(WFPSF_ERROR_RANGE, "ra_deg = %g: must be -1e6..1e6", ra_deg);
    if (!(std::abs(dec_deg) <= 90))
        fail(WFPSF_ERROR_RANGE, "dec_deg = %g: must be -90..90", dec_deg);
    return {ra_deg, dec_deg};
}

double value_of(const Observation &observation, int32_t sca, int32_t key) {
    const TanSip &wcs = observation.wcs(sca);
    switch (key) {
    case WFPSF_OBSERVATION_RA:
        return observation.pointing().ra_deg;
    case WFPSF_OBSERVATION_DEC:
        return observation.pointing().dec_deg;
    case WFPSF_OBSERVATION_PA:
        return observation.observatory_angle_deg();
    case WFPSF_OBSERVATION_PA_FPA:
        return observation.fpa_angle_deg();
    case WFPSF_OBSERVATION_CRPIX1:
    case WFPSF_OBSERVATION_CRPIX2:
        return WcsTables::reference_pixel + 1;
    case WFPSF_OBSERVATION_CRVAL1:
        return wcs.reference().ra_deg;
    case WFPSF_OBSERVATION_CRVAL2:
        return wcs.reference().dec_deg;
    case WFPSF_OBSERVATION_CD1_1:
        return wcs.cd()[0];
    case WFPSF_OBSERVATION_CD1_2:
        return wcs.cd()[1];
    case WFPSF_OBSERVATION_CD2_1:
        return wcs.cd()[2];
    case WFPSF_OBSERVATION_CD2_2:
        return wcs.cd()[3];
    case WFPSF_OBSERVATION_ORIENTAT:
        return observation.detector_angle_deg(sca);
    default:
        fail(WFPSF_ERROR_UNKNOWN_NAME, "key = %d: must be one of WFPSF_OBSERVATION_*", key);
    }
}

} // namespace

wfpsf_status wfpsf_observation_create(const wfpsf_instrument *instrument, double ra_deg,
                                      double dec_deg, double pa_deg, const wfpsf_options *options,
                                      wfpsf_observation **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        *out = new wfpsf_observation{
            Observation(instrument->instrument, {ra_deg, dec_deg}, pa_deg, options_of(options))};
    });
}

wfpsf_status wfpsf_observation_create_on_date(const wfpsf_instrument *instrument, double ra_deg,
                                              double dec_deg, double julian_date,
                                              const wfpsf_options *options,
                                              wfpsf_observation **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        const SkyPosition pointing = checked_position(ra_deg, dec_deg);
        const Instrument &i = instrument->instrument;
        ObservationOptions chosen = options_of(options);
        chosen.angle_is_of_fpa = false;
        if (!i.wcs) // its error, not that of a constant that a design lacks
            Observation(i, pointing, 0, chosen);
        const double pa = best_position_angle(i, pointing, julian_date, sun_rule(options));
        *out = new wfpsf_observation{Observation(i, pointing, pa, chosen)};
    });
}

wfpsf_status wfpsf_observation_create_aimed(const wfpsf_instrument *instrument, int32_t sca,
                                            double x, double y, double ra_deg, double dec_deg,
                                            double pa_deg, const wfpsf_options *options,
                                            wfpsf_observation **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        require_finite(x, "x");
        require_finite(y, "y");
        *out = new wfpsf_observation{Observation::aimed(instrument->instrument, sca, x, y,
                                                        checked_position(ra_deg, dec_deg), pa_deg,
                                                        options_of(options))};
    });
}

void wfpsf_observation_destroy(wfpsf_observation *observation) {
    delete observation;
}

wfpsf_status wfpsf_observation_get(const wfpsf_observation *observation, int32_t sca, int32_t key,
                                   double *value) {
    return guarded([&] {
        require_pointer(observation, "observation");
        require_pointer(value, "value");
        *value = value_of(observation->observation, sca, key);
    });
}

wfpsf_status wfpsf_observation_sky_to_pixel(const wfpsf_observation *observation, int32_t sca,
                                            int64_t count, const double *ra_deg,
                                            const double *dec_deg, double *x, double *y,
                                            int64_t *undefined) {
    return guarded([&] {
        require_pointer(observation, "observation");
        const TanSip &wcs = observation->observation.wcs(sca);
        array_of(count, ra_deg, "count", "ra_deg");
        array_of(count, dec_deg, "count", "dec_deg");
        array_of(count, x, "count", "x");
        array_of(count, y, "count", "y");
        const int64_t without = wcs.to_pixel(count, ra_deg, dec_deg, x, y);
        if (undefined)
            *undefined = without;
    });
}

wfpsf_status wfpsf_observation_pixel_to_sky(const wfpsf_observation *observation, int32_t sca,
                                            int64_t count, const double *x, const double *y,
                                            double *ra_deg, double *dec_deg, int64_t *undefined) {
    return guarded([&] {
        require_pointer(observation, "observation");
        const TanSip &wcs = observation->observation.wcs(sca);
        array_of(count, x, "count", "x");
        array_of(count, y, "count", "y");
        array_of(count, ra_deg, "count", "ra_deg");
        array_of(count, dec_deg, "count", "dec_deg");
        const int64_t without = wcs.to_sky(count, x, y, ra_deg, dec_deg);
        if (undefined)
            *undefined = without;
    });
}

wfpsf_status wfpsf_observation_find_sca(const wfpsf_observation *observation, int32_t with_gaps,
                                        int64_t count, const double *ra_deg, const double *dec_deg,
                                        int32_t *sca, double *x, double *y, int64_t *found) {
    return guarded([&] {
        require_pointer(observation, "observation");
        const bool gaps = checked_gaps(with_gaps);
        array_of(count, ra_deg, "count", "ra_deg");
        array_of(count, dec_deg, "count", "dec_deg");
        array_of(count, sca, "count", "sca");
        const int64_t hits = observation->observation.find(gaps, count, ra_deg, dec_deg, sca, x, y);
        if (found)
            *found = hits;
    });
}

wfpsf_status wfpsf_observation_bounds(const wfpsf_observation *observation, int32_t sca,
                                      int32_t with_gaps, int64_t *x_first, int64_t *x_last,
                                      int64_t *y_first, int64_t *y_last) {
    return guarded([&] {
        require_pointer(observation, "observation");
        require_pointer(x_first, "x_first");
        require_pointer(x_last, "x_last");
        require_pointer(y_first, "y_first");
        require_pointer(y_last, "y_last");
        const PixelBounds bounds = observation->observation.bounds(sca, checked_gaps(with_gaps));
        *x_first = bounds.x_first;
        *x_last = bounds.x_last;
        *y_first = bounds.y_first;
        *y_last = bounds.y_last;
    });
}

wfpsf_status wfpsf_observation_jacobian(const wfpsf_observation *observation, int32_t sca,
                                        int64_t count, const double *x, const double *y,
                                        double *jacobian, double *pixel_area, double *y_angle_deg,
                                        int64_t *undefined) {
    return guarded([&] {
        require_pointer(observation, "observation");
        const TanSip &wcs = observation->observation.wcs(sca);
        array_of(count, x, "count", "x");
        array_of(count, y, "count", "y");
        int64_t without = 0;
        for (int64_t i = 0; i < count; ++i) {
            const PixelJacobian j = wcs.jacobian(x[i], y[i]);
            without += std::isnan(j.east_x) ? 1 : 0;
            if (pixel_area)
                pixel_area[i] = j.area_arcsec2();
            if (y_angle_deg)
                y_angle_deg[i] = j.y_position_angle_deg();
            if (jacobian)
                std::ranges::copy(std::array{j.east_x, j.east_y, j.north_x, j.north_y},
                                  jacobian + 4 * i);
        }
        if (undefined)
            *undefined = without;
    });
}

wfpsf_status wfpsf_observation_fits_header(const wfpsf_observation *observation, int32_t sca,
                                           int64_t capacity, char *text, int64_t *length) {
    return guarded([&] {
        require_pointer(observation, "observation");
        copy_text(fits_header(observation->observation, sca), capacity, text, length);
    });
}

wfpsf_status wfpsf_julian_date(int32_t year, int32_t month, int32_t day, int32_t hour,
                               int32_t minute, double second, double *julian_date) {
    return guarded([&] {
        require_pointer(julian_date, "julian_date");
        *julian_date = wfpsf::julian_date(year, month, day, hour, minute, second);
    });
}

wfpsf_status wfpsf_sun_position(double julian_date, const wfpsf_options *options, double *ra_deg,
                                double *dec_deg) {
    return guarded([&] {
        require_pointer(ra_deg, "ra_deg");
        require_pointer(dec_deg, "dec_deg");
        const SkyPosition sun = sun_position(julian_date, sun_rule(options));
        *ra_deg = sun.ra_deg;
        *dec_deg = sun.dec_deg;
    });
}

wfpsf_status wfpsf_pointing_allowed(const wfpsf_instrument *instrument, double ra_deg,
                                    double dec_deg, double julian_date,
                                    const wfpsf_options *options, double *sun_angle_deg,
                                    int32_t *allowed) {
    return guarded([&] {
        require_pointer(instrument, "instrument");
        const Pointing pointing =
            check_pointing(instrument->instrument, checked_position(ra_deg, dec_deg), julian_date,
                           sun_rule(options));
        if (sun_angle_deg)
            *sun_angle_deg = pointing.sun_angle_deg;
        if (allowed)
            *allowed = pointing.allowed ? 1 : 0;
    });
}

wfpsf_status wfpsf_pointing_best_pa(const wfpsf_instrument *instrument, double ra_deg,
                                    double dec_deg, double julian_date,
                                    const wfpsf_options *options, double *pa_deg) {
    return guarded([&] {
        require_pointer(instrument, "instrument");
        require_pointer(pa_deg, "pa_deg");
        *pa_deg = best_position_angle(instrument->instrument, checked_position(ra_deg, dec_deg),
                                      julian_date, sun_rule(options));
    });
}
