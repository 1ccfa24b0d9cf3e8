// SPDX-License-Identifier: GPL-3.0-or-later
// An observation: a telescope that points somewhere, and where its detectors then are on the sky.
// Immutable. Pixels count from the first one's centre at (0, 0).
#pragma once

#include "image/fits.hpp"
#include "instrument/instrument.hpp"
#include "observation/tan_sip.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace wfpsf {

struct ObservationOptions {
    // As GalSim has it: terms of order 2 to 4 as they stand in its tables, so that detectors are
    // all but linear inside, and its rules of when a position is on a detector.
    bool as_galsim = false;
    bool angle_is_of_fpa = false; // position angles are the focal plane's, not the observatory's
};

class Observation {
  public:
    // WFPSF_ERROR_NO_WCS if the instrument has none; angles that are not finite or no angles:
    // WFPSF_ERROR_NOT_FINITE, WFPSF_ERROR_RANGE.
    Observation(const Instrument &instrument, const SkyPosition &pointing, double pa_deg,
                const ObservationOptions &options);

    // That which has a pixel of a detector at a place on the sky. WFPSF_ERROR_RANGE if there is
    // none, as there may be near the poles.
    static Observation aimed(const Instrument &instrument, int sca, double x, double y,
                             const SkyPosition &target, double pa_deg,
                             const ObservationOptions &options);

    const SkyPosition &pointing() const { return pointing_; }
    double observatory_angle_deg() const { return observatory_angle_; }
    double fpa_angle_deg() const { return fpa_angle_; }

    int sca_count() const { return static_cast<int>(detectors_.size()); }
    const TanSip &wcs(int sca) const;         // WFPSF_ERROR_RANGE
    double detector_angle_deg(int sca) const; // ORIENTAT of FITS headers
    PixelBounds bounds(int sca, bool with_gaps) const;

    // Which detector each position is on, the lowest if there are several, and where; 0 and NaN if
    // it is on none. Returns how many are on one. Outputs may be the inputs, x and y may be NULL.
    int64_t find(bool with_gaps, int64_t count, const double *ra_deg, const double *dec_deg,
                 int32_t *sca, double *x, double *y) const;

  private:
    struct Detector {
        TanSip wcs;
        double angle_deg;
        PixelBounds active, with_gaps;
        Vector middle;       // of all its pixels
        double least_cosine; // of directions to its pixels with the middle
    };

    void check_sca(int sca) const;
    bool holds(const PixelBounds &bounds, double x, double y) const;

    ObservationOptions options_;
    bool cuts_to_integers_ = false;
    SkyPosition pointing_;
    double observatory_angle_, fpa_angle_;
    std::vector<Detector> detectors_;
};

// The FITS keywords of a detector's image; and as cards of 80 characters one after another, no END.
std::vector<FitsKeyword> fits_keywords(const Observation &observation, int sca);
std::string fits_header(const Observation &observation, int sca);

} // namespace wfpsf
