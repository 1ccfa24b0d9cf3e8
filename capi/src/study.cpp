// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/study.hpp"

#include "psf_parts.hpp"

#include <limits>
#include <string>
#include <variant>

using namespace wfpsf;

namespace {

const StudyTable *find_table(const wfpsf_study *study, int32_t table) {
    if (!study)
        return nullptr;
    const auto found = study->study.find(table);
    return found == study->study.end() ? nullptr : &found->second;
}

const StudyTable &table_of(const wfpsf_study *study, int32_t table) {
    require_pointer(study, "study");
    if (const StudyTable *found = find_table(study, table))
        return *found;
    fail(WFPSF_ERROR_UNKNOWN_NAME, "table = %d: must be one of WFPSF_STUDY_*", table);
}

bool is_within(int64_t index, size_t count) {
    return index >= 0 && index < static_cast<int64_t>(count);
}

void require_index(const char *name, int64_t index, size_t count) {
    if (!is_within(index, count))
        fail(WFPSF_ERROR_RANGE, "%s = %lld: must be 0..%lld", name, static_cast<long long>(index),
             static_cast<long long>(count) - 1);
}

const StudyCell &cell(const StudyTable &table, int64_t row, int64_t column) {
    return table.rows[static_cast<size_t>(row)][static_cast<size_t>(column)];
}

} // namespace

wfpsf_status wfpsf_study_create(const wfpsf_instrument *instrument, int32_t sca,
                                const wfpsf_options *options, wfpsf_study **out) {
    return guarded([&] {
        require_pointer(out, "out");
        *out = nullptr;
        require_pointer(instrument, "instrument");
        const Instrument &i = instrument->instrument;
        i.zernikes(sca); // refuses what is none of its SCAs
        const AddedAberrations added(options);
        const auto wavefront = [&](int of) { return make_wavefront(i, i.zernikes(of), added); };
        *out = new wfpsf_study{make_study({i, sca, flag(options, WFPSF_OPTION_STRUTS),
                                           make_settings(i, is_mirrored(i, options), options),
                                           wavefront, manners_of(options)})};
        // EPS is of pixels. An error there counts twice in a size, four times in an ellipticity.
        return certify(largest_error((*out)->study) / 4, option(options, WFPSF_OPTION_EPS));
    });
}

void wfpsf_study_destroy(wfpsf_study *study) {
    delete study;
}

wfpsf_status wfpsf_study_size(const wfpsf_study *study, int32_t table, int64_t *rows,
                              int64_t *columns) {
    return guarded([&] {
        const StudyTable &found = table_of(study, table);
        if (rows)
            *rows = static_cast<int64_t>(found.rows.size());
        if (columns)
            *columns = static_cast<int64_t>(found.columns.size());
    });
}

const char *wfpsf_study_column(const wfpsf_study *study, int32_t table, int64_t column) {
    const StudyTable *found = find_table(study, table);
    return found && is_within(column, found->columns.size())
               ? found->columns[static_cast<size_t>(column)].c_str()
               : nullptr;
}

wfpsf_status wfpsf_study_value(const wfpsf_study *study, int32_t table, int64_t row, int64_t column,
                               double *value) {
    return guarded([&] {
        const StudyTable &found = table_of(study, table);
        require_pointer(value, "value");
        require_index("row", row, found.rows.size());
        require_index("column", column, found.columns.size());
        const double *number = std::get_if<double>(&cell(found, row, column));
        *value = number ? *number : std::numeric_limits<double>::quiet_NaN();
    });
}

const char *wfpsf_study_text(const wfpsf_study *study, int32_t table, int64_t row, int64_t column) {
    const StudyTable *found = find_table(study, table);
    if (!found || !is_within(row, found->rows.size()) || !is_within(column, found->columns.size()))
        return nullptr;
    const std::string *words = std::get_if<std::string>(&cell(*found, row, column));
    return words ? words->c_str() : nullptr;
}

wfpsf_status wfpsf_study_write_csv(const wfpsf_study *study, const char *folder) {
    return guarded([&] {
        require_pointer(study, "study");
        require_pointer(folder, "folder");
        write_csv(study->study, folder);
    });
}
