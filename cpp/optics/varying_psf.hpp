// SPDX-License-Identifier: GPL-3.0-or-later
// The PSF all over a detector: the light of its places, and PSFs of single ones.
#pragma once

#include "optics/psf.hpp"
#include "optics/varying_light.hpp"

namespace wfpsf {

// Immutable once made.
class VaryingPsf : public VaryingLight {
  public:
    // `varies`: whether the optics differ from place to place at all.
    VaryingPsf(OpticsAt optics, bool varies, Light light, const PsfSettings &settings,
               const Region &region, const Manners &manners = {});

    // Outside the region: WFPSF_ERROR_RANGE.
    Psf at(double x, double y) const;

  private:
    OpticsAt optics_;
    Light light_;
};

} // namespace wfpsf
