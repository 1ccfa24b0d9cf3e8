// SPDX-License-Identifier: GPL-3.0-or-later
// A table of the study: named columns, each of numbers or of words.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace wfpsf {

using StudyCell = std::variant<double, std::string>; // NaN: nothing known

struct StudyTable {
    std::vector<std::string> columns;
    std::vector<std::vector<StudyCell>> rows;

    void add(std::vector<StudyCell> row) { rows.push_back(std::move(row)); }
};

// A header line and the rows: numbers so that they read back as they are, nothing for NaN, words in
// quotes where they hold a comma.
std::string as_csv(const StudyTable &table);

} // namespace wfpsf
