// SPDX-License-Identifier: GPL-3.0-or-later
// Scalar constants, as in the roman module of GalSim 2.8.4.
#include "instrument/roman_c9/tables.hpp"

namespace wfpsf::roman_c9 {
namespace {

constexpr Constant table[] = {
    {"gain", 1.0, "e-/ADU", "gain, one value for all SCAs"},
    {"pixel_scale", 0.11, "arcsec/pixel", "nominal pixel scale, distortion left out"},
    {"diameter", 2.36, "m", "primary mirror diameter"},
    {"obscuration", 0.32, "1", "linear central obscuration as a fraction of the diameter"},
    {"collecting_area", collecting_area_cm2, "cm2",
     "nominal collecting area used to turn effective areas into throughputs"},
    {"exptime", 139.8, "s", "typical exposure time of one dither"},
    {"dark_current", 0.015, "e-/pixel/s", "dark current"},
    {"nonlinearity_beta", -6e-07, "1/e-", "counts_out = counts_in + beta*counts_in**2"},
    {"reciprocity_alpha", 0.0065, "1/decade", "reciprocity failure per decade of flux"},
    {"read_noise", 8.5, "e-", "total read noise"},
    {"n_dithers", 6, "1", "typical number of dithers per filter"},
    {"stray_light_fraction", 0.1, "1",
     "stray light allowed, as a fraction of the zodiacal background"},
    {"n_sca", 18, "1", "number of detectors (SCAs), numbered 1..18"},
    {"n_pix_tot", 4096, "pixel", "full detector side, reference pixels included"},
    {"n_pix", 4088, "pixel", "active detector side"},
    {"jitter_rms", 0.014, "arcsec", "pointing jitter, rms per axis"},
    {"charge_diffusion", 0.1, "pixel", "charge diffusion, Gaussian sigma per axis"},
    {"max_sun_angle", 36.0, "deg",
     "largest tilt away from 90 deg of the angle between line of sight and Sun"},
    {"zemax_wavelength", 1293.0, "nm", "wavelength at which the Zernike coefficients are given"},
    {"zernike_jmax", 22, "1", "highest Noll index j in the table of coefficients"},
    {"pixel_size_mm", 0.01, "mm", "physical pixel pitch"},
    {"focal_length", 18714.0, "mm", "focal length"},
    {"fpa_xc_mm", 0.0, "mm", "focal plane centre, local x, from the boresight"},
    {"fpa_yc_mm", 160.484, "mm", "focal plane centre, local y, from the boresight"},
    {"theta_fpa", 120.0, "deg", "PA of focal plane = PA of observatory + theta_fpa"},
};

} // namespace

std::span<const Constant> constants() {
    return table;
}

} // namespace wfpsf::roman_c9
