// SPDX-License-Identifier: GPL-3.0-or-later
// What all functions that make PSFs or draw from them share.
#pragma once

#include "funnel.hpp"
#include "handles.hpp"

#include <span>
#include <vector>

namespace wfpsf {

// What the caller's options do to the wavefront: a copy that outlives them.
struct AddedAberrations {
    std::vector<double> zernikes;
    std::shared_ptr<const OpdMap> map;
    bool keeps_piston_tilt;
    explicit AddedAberrations(const wfpsf_options *options);
};

// The instrument's own aberrations and those, in waves at the reference wavelength.
Wavefront make_wavefront(const Instrument &instrument, std::span<const double> own,
                         const AddedAberrations &added);
PsfSettings make_settings(const Instrument &instrument, bool mirrored,
                          const wfpsf_options *options);

FieldRule field_rule(const wfpsf_options *options);
// Roman's pupils are seen mirrored, unless FRAME asks for the exit pupil's axes; C5 has one frame.
bool is_mirrored(const Instrument &instrument, const wfpsf_options *options);

Light one_colour(double wavelength_nm);
// wavelength_nm = 0: the band's effective wavelength.
Light one_colour_in(const Band &band, double wavelength_nm);

// One colour, or an SED seen through the band; wavelength_nm must be 0 then.
Light light_of(const Band &band, double wavelength_nm, const Sed *sed);

// The optics at any place of a detector and the region that has them; copies, which outlive the
// options and the instrument's handle.
struct DetectorOptics {
    OpticsAt at;
    bool varies;
    Region region;
};
DetectorOptics detector_optics(const wfpsf_instrument &instrument, const char *band, int32_t sca,
                               const wfpsf_options *options);

// OK, or the warning that the error estimate does not meet EPS.
wfpsf_status certify(double estimate, double eps);

// An image that states another pixel scale is refused.
void require_scale(double pixel_scale_arcsec, const Image &image, const char *argument);

// Light is added before what the detector does to it, to pixels of the PSF's scale.
void require_light(const PsfSettings &settings, double pixel_scale_arcsec, const Image &image,
                   const wfpsf_options *options);
void record_light(const PsfSettings &settings, double pixel_scale_arcsec, Image &image);

// The caller's arrays, once they are sound.
std::vector<Star> checked_stars(int64_t count, const double *x, const double *y,
                                const double *flux);

} // namespace wfpsf
