// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/varying_psf.hpp"

#include <utility>

namespace wfpsf {

VaryingPsf::VaryingPsf(OpticsAt optics, bool varies, Light light, const PsfSettings &settings,
                       const Region &region, const Manners &manners)
    : VaryingLight(optics, varies, light, settings, region, manners), optics_(std::move(optics)),
      light_(std::move(light)) {}

Psf VaryingPsf::at(double x, double y) const {
    return Psf(optics_(x, y), light_, settings(), field(x, y));
}

} // namespace wfpsf
