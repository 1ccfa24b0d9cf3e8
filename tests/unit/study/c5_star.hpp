// SPDX-License-Identifier: GPL-3.0-or-later
// Stars of wfirst-afta-c5 for the tests of the study.
#pragma once

#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "study/study.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

namespace wfpsf {

inline const Instrument &c5() {
    return Instrument::get("wfirst-afta-c5");
}

inline constexpr double reference = 1293e-9, pixel_arcsec = 0.11;

inline Wavefront c5_wavefront(int sca, size_t j = 4, double more = 0) {
    const auto own = c5().zernikes(sca);
    std::vector<double> waves(own.begin(), own.end());
    std::fill_n(waves.begin(), 3, 0.0);
    waves[j - 1] += more;
    return Wavefront(waves, 1.18);
}

inline PsfSettings c5_settings(double eps, double radius, const Covariance &blur = {}) {
    return {.wavelength = reference,
            .pixel_scale = pixel_arcsec * std::numbers::pi / 180 / 3600,
            .eps = eps,
            .radius = radius,
            .blur = blur};
}

inline Psf c5_psf(double wavelength, const Wavefront &wavefront, const PsfSettings &settings) {
    static const std::shared_ptr<const Aperture> aperture =
        make_aperture(std::get<SegmentedPupil>(c5().pupil(7, "J129")));
    const Light light = monochromatic(wavelength);
    return make_psfs({aperture, wavefront, reference}, {&light, 1}, settings)[0];
}

inline StudySource c5_source(double eps, int sca = 7) {
    return {c5(), sca, true, c5_settings(eps, 16), [](int of) { return c5_wavefront(of); }};
}

} // namespace wfpsf
