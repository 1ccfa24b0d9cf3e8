// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"
#include "handles.hpp"

#include <algorithm>
#include <cmath>

using namespace wfpsf;

wfpsf_status wfpsf_instrument_create(const char *name, wfpsf_instrument **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(name, "name");
        *out = new wfpsf_instrument{nullptr, Instrument::get(name)};
    });
}

void wfpsf_instrument_destroy(wfpsf_instrument *instrument) {
    delete instrument;
}

wfpsf_status wfpsf_instrument_constant(const wfpsf_instrument *instrument, const char *name,
                                       double *value, const char **unit) {
    return guarded([&] {
        require_pointer(instrument, "instrument");
        require_pointer(name, "name");
        require_pointer(value, "value");
        const Constant &constant = instrument->instrument.constant(name);
        *value = constant.value;
        if (unit)
            *unit = constant.unit;
    });
}

namespace {

template <class List> const char *name_at(const List &list, int64_t index) {
    if (index < 0 || index >= static_cast<int64_t>(list.size()))
        return nullptr;
    return list[static_cast<size_t>(index)].name;
}

} // namespace

const char *wfpsf_instrument_constant_name(const wfpsf_instrument *instrument, int64_t index) {
    return instrument ? name_at(instrument->instrument.constants, index) : nullptr;
}

const char *wfpsf_instrument_band_name(const wfpsf_instrument *instrument, int64_t index) {
    return instrument ? name_at(instrument->instrument.bands, index) : nullptr;
}

wfpsf_status wfpsf_instrument_band(const wfpsf_instrument *instrument, const char *band,
                                   int32_t rule, double *blue_nm, double *red_nm,
                                   double *effective_nm) {
    return guarded([&] {
        require_pointer(instrument, "instrument");
        require_pointer(band, "band");
        const Band &b = instrument->instrument.band(band);
        if (rule != WFPSF_BAND_TABULATED && rule != WFPSF_BAND_PAPER)
            fail(WFPSF_ERROR_ARGUMENT, "rule = %d: must be WFPSF_BAND_TABULATED or _PAPER", rule);
        const BandWavelengths w =
            rule == WFPSF_BAND_PAPER ? thinned_wavelengths(b) : tabulated_wavelengths(b);
        if (blue_nm)
            *blue_nm = w.blue_nm;
        if (red_nm)
            *red_nm = w.red_nm;
        if (effective_nm)
            *effective_nm = w.effective_nm;
    });
}

wfpsf_status wfpsf_instrument_throughput(const wfpsf_instrument *instrument, const char *band,
                                         int64_t count, const double *wavelength_nm,
                                         double *throughput) {
    return guarded([&] {
        require_pointer(instrument, "instrument");
        require_pointer(band, "band");
        array_of(count, wavelength_nm, "count", "wavelength_nm");
        array_of(count, throughput, "count", "throughput");
        const Band &b = instrument->instrument.band(band);
        // Nothing is written unless all is well.
        for (int64_t i = 0; i < count; ++i)
            if (!std::isfinite(wavelength_nm[i]))
                fail(WFPSF_ERROR_NOT_FINITE, "wavelength_nm[%lld] = %g: must be finite",
                     static_cast<long long>(i), wavelength_nm[i]);
        for (int64_t i = 0; i < count; ++i)
            throughput[i] = wfpsf::throughput(b, wavelength_nm[i]);
    });
}

wfpsf_status wfpsf_instrument_zernikes(const wfpsf_instrument *instrument, int32_t sca,
                                       int64_t capacity, double *coefficients, int64_t *count) {
    return guarded([&] {
        require_pointer(instrument, "instrument");
        const auto room = array_of(capacity, coefficients, "capacity", "coefficients");
        const auto zernikes = instrument->instrument.zernikes(sca);
        std::copy_n(zernikes.begin(), std::min(zernikes.size(), room.size()), room.begin());
        if (count)
            *count = static_cast<int64_t>(zernikes.size());
    });
}

wfpsf_status wfpsf_instrument_pupil(const wfpsf_instrument *instrument, const char *band,
                                    int32_t sca, const wfpsf_options *options, wfpsf_image *out,
                                    double *scale_m, double *axis_x, double *axis_y) {
    return guarded([&] {
        require_pointer(instrument, "instrument");
        require_pointer(band, "band");
        require_pointer(out, "out");
        require_pointer(scale_m, "scale_m");
        require_pointer(axis_x, "axis_x");
        require_pointer(axis_y, "axis_y");
        const Instrument &i = instrument->instrument;
        (void)i.pupil(sca, band); // refuses what it does not know, struts or not
        if (out->image.nx() < 1 || out->image.ny() < 1)
            fail(WFPSF_ERROR_SIZE, "out: is %lld x %lld pixels: must not be empty",
                 static_cast<long long>(out->image.nx()), static_cast<long long>(out->image.ny()));
        const PupilRaster raster =
            make_aperture_of(i, sca, band, options)->raster(out->image.nx(), out->image.ny());
        std::visit(
            [&]<class T>(View<T> pixels) {
                for (int64_t y = 0; y < pixels.ny; ++y)
                    for (int64_t x = 0; x < pixels.nx; ++x)
                        pixels(x, y) = static_cast<T>(raster.lit(x, y));
            },
            out->image.pixels());
        *scale_m = raster.scale;
        *axis_x = raster.axis_x;
        *axis_y = raster.axis_y;
    });
}
