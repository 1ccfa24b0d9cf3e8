// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/spider_region.hpp"

namespace wfpsf {

LitRegion lit_region(const SpiderPupil &pupil) {
    const auto disc = [](double radius) { return Oval{0, 0, radius, 0, radius}; };
    LitRegion region{{disc(pupil.outer_radius)}, {}};
    if (pupil.inner_radius > 0)
        region.dark.push_back({disc(pupil.inner_radius)});
    for (const Strut &strut : pupil.struts) {
        const auto bar = sides(strut);
        region.dark.emplace_back(bar.begin(), bar.end());
    }
    return region;
}

} // namespace wfpsf
