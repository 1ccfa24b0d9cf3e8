// SPDX-License-Identifier: GPL-3.0-or-later
#include "instrument/design.hpp"

#include "funnel.hpp"
#include "handles.hpp"

using namespace wfpsf;

struct wfpsf_design {
    Design design;
};

namespace {

// Every entry point that changes a design.
template <class Change> wfpsf_status change(wfpsf_design *design, Change how) {
    return guarded([&] {
        require_pointer(design, "design");
        how(design->design);
    });
}

} // namespace

wfpsf_status wfpsf_design_create(wfpsf_design **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        *out = new wfpsf_design{};
    });
}

void wfpsf_design_destroy(wfpsf_design *design) {
    delete design;
}

wfpsf_status wfpsf_design_set_telescope(wfpsf_design *design, double diameter_m, double obscuration,
                                        double reference_wavelength_nm) {
    return change(design, [&](Design &d) {
        d.set_telescope(diameter_m, obscuration, reference_wavelength_nm);
    });
}

wfpsf_status wfpsf_design_add_strut(wfpsf_design *design, double azimuth_deg, double width_m,
                                    double offset_m) {
    return change(design, [&](Design &d) { d.add_strut(azimuth_deg, width_m, offset_m); });
}

wfpsf_status wfpsf_design_set_detector(wfpsf_design *design, int32_t sca_count,
                                       double pixel_scale_arcsec, int64_t n_pix_x,
                                       int64_t n_pix_y) {
    return change(design, [&](Design &d) {
        d.set_detector(sca_count, pixel_scale_arcsec, {n_pix_x, n_pix_y});
    });
}

wfpsf_status wfpsf_design_set_zernikes(wfpsf_design *design, int32_t sca, int64_t count,
                                       const double *coefficients) {
    return change(design,
                  [&](Design &d) { d.set_zernikes(sca, checked_zernikes(count, coefficients)); });
}

wfpsf_status wfpsf_design_set_field(wfpsf_design *design, int32_t sca, const double *x,
                                    const double *y, int64_t count, const double *coefficients) {
    return change(design, [&](Design &d) {
        require_pointer(x, "x");
        require_pointer(y, "y");
        d.set_zernikes(sca, std::span<const double, 5>(x, 5), std::span<const double, 5>(y, 5),
                       checked_zernikes(count, coefficients, 5));
    });
}

wfpsf_status wfpsf_design_add_band(wfpsf_design *design, const char *name, double first_nm,
                                   double step_nm, int64_t count, const double *throughput) {
    return change(design, [&](Design &d) {
        require_pointer(name, "name");
        d.add_band(name, first_nm, step_nm, array_of(count, throughput, "count", "throughput"));
    });
}

wfpsf_status wfpsf_instrument_create_from_design(const wfpsf_design *design,
                                                 wfpsf_instrument **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(design, "design");
        const std::shared_ptr<const Instrument> made = design->design.instrument();
        // Struts that leave no light are refused here, not by every PSF.
        std::visit([](const auto &pupil) { make_aperture(pupil); }, made->pupils.front());
        *out = new wfpsf_instrument{made, *made};
    });
}
