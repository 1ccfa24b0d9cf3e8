// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/study.hpp"

#include "image/new_file.hpp"
#include "study/tables.hpp"

#include <algorithm>
#include <span>

#include <wfpsf/study.h>

namespace wfpsf {

std::string study_file(int32_t table) {
    switch (table) {
#define WFPSF_STUDY_FILE(name, key, file, text)                                                    \
    case key:                                                                                      \
        return file;
        WFPSF_STUDY_TABLE_LIST(WFPSF_STUDY_FILE)
#undef WFPSF_STUDY_FILE
    default:
        return {};
    }
}

Study make_study(const StudySource &source) {
    const Progress &progress = source.manners.progress;
    const KeptMemory kept;
    StarMaker maker(source);
    std::vector<BandStar> stars;
    for (const bool struts : {true, false})
        for (const Band &band : source.instrument.bands) {
            progress.report(0.3 * static_cast<double>(stars.size()) /
                            (2 * static_cast<double>(source.instrument.bands.size())));
            stars.emplace_back(maker, band, struts);
        }
    Study study;
    study[WFPSF_STUDY_BANDS] = bands_table(source);
    study[WFPSF_STUDY_SIZES] = sizes_table(source, stars);
    progress.report(0.3);
    add_sensitivities(source, stars, study);
    progress.report(0.5);
    add_figures(source, stars, study);
    progress.report(0.7);
    study[WFPSF_STUDY_REQUIREMENTS] = requirements_table(maker, progress.between(0.7, 0.95));
    study[WFPSF_STUDY_COMPARISON] = comparison_table(source, study);
    study[WFPSF_STUDY_CONVERGENCE] = convergence_table(source, stars);
    progress.report(1);
    return study;
}

double largest_error(const Study &study) {
    double largest = 0;
    for (const auto &row : study.at(WFPSF_STUDY_SIZES).rows) { // ..., unit, paper, value, error
        const double error = std::get<double>(row[7]);
        const bool is_size = std::get<std::string>(row[4]) == "mas";
        largest = std::max(largest, is_size ? error / std::get<double>(row[6]) : error);
    }
    return largest;
}

void write_csv(const Study &study, const std::string &folder) {
    for (const auto &[key, table] : study) {
        const std::string text = as_csv(table);
        NewFile file(folder + "/" + study_file(key) + ".csv", true);
        file.append(std::as_bytes(std::span(text)));
        file.publish();
    }
}

} // namespace wfpsf
