// SPDX-License-Identifier: GPL-3.0-or-later
#include "funnel.hpp"
#include "handles.hpp"

#include <span>

using namespace wfpsf;

namespace {

SedUnit unit_of(int32_t unit) {
    if (unit != WFPSF_SED_PHOTONS && unit != WFPSF_SED_ENERGY)
        fail(WFPSF_ERROR_ARGUMENT, "unit = %d: must be WFPSF_SED_PHOTONS or _ENERGY", unit);
    return unit == WFPSF_SED_PHOTONS ? SedUnit::photons : SedUnit::energy;
}

template <class Make> wfpsf_status create(wfpsf_sed **out, Make make) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        *out = new wfpsf_sed{make()};
    });
}

} // namespace

wfpsf_status wfpsf_sed_create_table(int32_t unit, int64_t count, const double *wavelength_nm,
                                    const double *density, wfpsf_sed **out) {
    return create(out, [&] {
        return tabulated_sed(unit_of(unit),
                             array_of(count, wavelength_nm, "count", "wavelength_nm"),
                             array_of(count, density, "count", "density"));
    });
}

wfpsf_status wfpsf_sed_create_power_law(int32_t unit, double exponent, wfpsf_sed **out) {
    return create(out, [&] { return power_law_sed(unit_of(unit), exponent); });
}

wfpsf_status wfpsf_sed_create_black_body(double temperature_k, wfpsf_sed **out) {
    return create(out, [&] { return black_body_sed(temperature_k); });
}

wfpsf_status wfpsf_sed_create_redshifted(const wfpsf_sed *sed, double redshift, wfpsf_sed **out) {
    return create(out, [&] {
        require_pointer(sed, "sed");
        return redshifted_sed(sed->sed, redshift);
    });
}

void wfpsf_sed_destroy(wfpsf_sed *sed) {
    delete sed;
}

wfpsf_status wfpsf_sed_photon_density(const wfpsf_sed *sed, int64_t count,
                                      const double *wavelength_nm, double *photons) {
    return guarded([&] {
        require_pointer(sed, "sed");
        const std::span<const double> nm = array_of(count, wavelength_nm, "count", "wavelength_nm");
        if (count > 0)
            require_pointer(photons, "photons");
        // Nothing is written unless all is well.
        for (size_t i = 0; i < nm.size(); ++i) {
            if (!std::isfinite(nm[i]))
                fail(WFPSF_ERROR_NOT_FINITE, "wavelength_nm[%zu] = %g: must be finite", i, nm[i]);
            if (!(nm[i] > 0))
                fail(WFPSF_ERROR_RANGE, "wavelength_nm[%zu] = %g: must be above 0", i, nm[i]);
        }
        for (size_t i = 0; i < nm.size(); ++i)
            photons[i] = sed->sed.photons(nm[i]);
    });
}
