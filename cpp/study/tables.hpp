// SPDX-License-Identifier: GPL-3.0-or-later
// The study's tables, each from the stars of all bands, with and without struts.
#pragma once

#include "error/progress.hpp"
#include "study/band_star.hpp"
#include "study/study.hpp"

#include <vector>

namespace wfpsf {

using Stars = std::vector<BandStar>;

StudyTable bands_table(const StudySource &source);
StudyTable sizes_table(const StudySource &source, const Stars &stars);
// SENSITIVITIES and LINEAR_LAW.
void add_sensitivities(const StudySource &source, const Stars &stars, Study &study);
void add_figures(const StudySource &source, const Stars &stars, Study &study);
StudyTable requirements_table(StarMaker &maker, const Progress &progress);
// After the others.
StudyTable comparison_table(const StudySource &source, const Study &study);
StudyTable convergence_table(const StudySource &source, const Stars &stars);

// Of the weak-lensing survey, which the paper's figures are of; all bands if the instrument lacks
// one of them.
bool is_shown(const Instrument &instrument, const Band &band);
bool is_papers(const StudySource &source);

} // namespace wfpsf
