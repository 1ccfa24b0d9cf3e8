// SPDX-License-Identifier: GPL-3.0-or-later
// What scenes and exposures share.
#pragma once

#include "psf_parts.hpp"

#include <vector>

namespace wfpsf {

double exposure_time(const Instrument &instrument, const wfpsf_options *options);
SceneBudget budget_of(const Instrument &instrument, const wfpsf_options *options);

// Without its lights.
SceneOptics scene_optics(const wfpsf_instrument &instrument, const char *band, int32_t sca,
                         const wfpsf_options *options);
std::vector<Light> lights_of(const Catalogue &catalogue, const Band &band);

// Electrons of a source of magnitude 0, for a catalogue of magnitudes.
double zero_flux_of(const Catalogue &catalogue, const Instrument &instrument, const char *band,
                    const wfpsf_options *options);

} // namespace wfpsf
