// SPDX-License-Identifier: GPL-3.0-or-later
// The whole of Kannawadi et al. 2016 for one detector, as tables; the requirements for all.
#pragma once

#include "instrument/instrument.hpp"
#include "optics/psf.hpp"
#include "study/table.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace wfpsf {

struct StudySource {
    const Instrument &instrument;
    int sca;
    bool struts;          // in tables that have one pupil only
    PsfSettings settings; // but for the radius, which is as large as a table needs
    std::function<Wavefront(int sca)> wavefront; // at the detector's centre
    Manners manners = {};
};

// By WFPSF_STUDY_*. Throws Error: the status of adaptive moments that do not exist.
using Study = std::map<int32_t, StudyTable>;
Study make_study(const StudySource &source);

// The largest error estimate of the table of sizes: relative, or of an ellipticity.
double largest_error(const Study &study);

// The name of a table's file, without its ending; empty if there is no such table.
std::string study_file(int32_t table);

void write_csv(const Study &study, const std::string &folder);

} // namespace wfpsf
